//! The commands of `wall`: each reads its arguments, calls the library and reports.

mod building;
mod calibrate;
mod check;
mod describe;
mod ida;
mod motion;
mod package;
mod record;
mod schema;
mod simulate;
mod spectrum;
mod tie;
mod verify;

use anyhow::Result;
use clap::{CommandFactory, Parser, Subcommand};

use crate::output::Console;

/// The version with commit and profile, which `build.rs` states.
const VERSION: &str = env!("PROGRAM_VERSION");

/// Out-of-plane rocking of masonry walls under earthquakes.
#[derive(Debug, Parser)]
#[command(name = "wall", version = VERSION, arg_required_else_help = true, max_term_width = 100)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a scene, or the default wall, and write its history and its page
    #[command(allow_negative_numbers = true)]
    Simulate(simulate::Arguments),
    /// Make an FMU of a scene, with only the variables it uses and its ground motion inside
    Package(package::Arguments),
    /// Run storeys and walls as one system under a record, or make it an SSP of connected FMUs
    Building(building::Arguments),
    /// Print what follows from a wall's parameters: masses, F0, `u_ins`, omega1, e, xi ...
    Describe(describe::Arguments),
    /// Check a wall by Circolare 7/2019, or its capacity curve over a spectrum
    Check(check::Arguments),
    /// Compute the force of a parapet's tie and the displacement of the wall over the tie's stiffness
    Tie(tie::Arguments),
    /// Write a ground motion as CSV: a record in m/s2, or the synthetic one
    #[command(allow_negative_numbers = true)]
    Motion(motion::Arguments),
    /// Print what record files hold: format, points, step, duration, PGA, AvgSA, Sa, and a quick check
    Record(record::Arguments),
    /// Run an incremental dynamic analysis: walls x records x damping models, with fragilities and a page
    Ida(ida::Arguments),
    /// Merge the shards of an incremental dynamic analysis and write its results
    Merge(ida::MergeArguments),
    /// Compute rocking spectra: `u_max/u_ins` of rocking walls over size and slenderness, or over pulses
    #[command(allow_negative_numbers = true)]
    Spectrum(spectrum::Arguments),
    /// Match viscous damping to restitution, as section 5 of the paper does, for any wall
    Calibrate(calibrate::Arguments),
    /// Ask whether the program is right: formulas, published tests, the paper, accuracy, stability
    #[command(subcommand)]
    Verify(verify::Subject),
    /// Print the JSON schema of scenes, studies or buildings
    Schema(schema::Arguments),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

impl Arguments {
    /// Runs the command with its arguments.
    pub(crate) fn run(&self, console: &Console<'_>) -> Result<u8> {
        match &self.command {
            Command::Simulate(arguments) => simulate::run(console, arguments),
            Command::Package(arguments) => package::run(console, arguments),
            Command::Building(arguments) => building::run(console, arguments),
            Command::Describe(arguments) => describe::run(console, arguments),
            Command::Check(arguments) => check::run(console, arguments),
            Command::Tie(arguments) => tie::run(console, arguments),
            Command::Motion(arguments) => motion::run(console, arguments),
            Command::Record(arguments) => record::run(console, arguments),
            Command::Ida(arguments) => ida::run(console, arguments),
            Command::Merge(arguments) => ida::merge(console, arguments),
            Command::Spectrum(arguments) => spectrum::run(console, arguments),
            Command::Calibrate(arguments) => calibrate::run(console, arguments),
            Command::Verify(subject) => return verify::run(console, subject),
            Command::Schema(arguments) => schema::run(console, arguments),
            Command::Completions { shell } => {
                let mut script = Vec::new();
                clap_complete::generate(*shell, &mut Self::command(), "wall", &mut script);
                console.print(&String::from_utf8_lossy(&script))
            }
        }
        .map(|()| 0)
    }
}
