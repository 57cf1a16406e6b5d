//! `wall study`: many runs, of many walls, records, pulses or ties.

mod calibrate;
mod ida;
mod spectrum;
mod tie;

use anyhow::Result;
use clap::Subcommand;

use crate::output::Console;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Incremental dynamic analysis: walls x records x damping models
    Ida(ida::Arguments),
    /// Merge the shards of an incremental dynamic analysis
    Merge(ida::MergeArguments),
    /// How safe a wall is that just passes a check by a code
    Reliability(ida::Arguments),
    /// Rocking spectra: `u_max/u_ins` over walls, or over pulses
    #[command(allow_negative_numbers = true)]
    Spectrum(Box<spectrum::Arguments>),
    /// Force of a tie over its stiffness
    Tie(tie::Arguments),
    /// Match viscous damping to restitution, as section 5 of the paper
    Calibrate(calibrate::Arguments),
}

pub(crate) fn run(console: &Console<'_>, command: &Command) -> Result<()> {
    match command {
        Command::Ida(arguments) => ida::run(console, arguments),
        Command::Reliability(arguments) => ida::reliability(console, arguments),
        Command::Merge(arguments) => ida::merge(console, arguments),
        Command::Spectrum(arguments) => spectrum::run(console, arguments),
        Command::Tie(arguments) => tie::run(console, arguments),
        Command::Calibrate(arguments) => calibrate::run(console, arguments),
    }
}
