//! `wall building`: storeys and walls as one system, under a record or as an SSP 1.0 archive.
//!
//! In the archive each wall is the FMU of its scene, and each storey an FMU with its values inside: importers
//! do not agree on how an enumeration is set from outside, and some ignore the parameters of a system.

mod run;

use std::fmt::Write;
use std::path::PathBuf;

use ::run::file::make_folder;
use anyhow::{Result, bail};
use building::trial::{Trial, trial};
use building::{Building, Parts};
use clap::Args;
use report::counted;

use crate::args::RecordArguments;
use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The building (TOML): its storeys, and its walls with their scenes
    building: PathBuf,
    /// The SSP to write [default: `fmu_out/building.ssp`, without a record]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The general FMU of walls; `fmu_out/fmi3/wall.fmu` makes FMI 3.0 units
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    wall_fmu: PathBuf,
    /// The FMU of floors; `fmu_out/fmi3/floor.fmu` makes FMI 3.0 units
    #[arg(long, value_name = "FILE", default_value = "fmu_out/floor.fmu")]
    floor_fmu: PathBuf,
    #[command(flatten)]
    record: RecordArguments,
    #[command(flatten)]
    run: run::Options,
}

/// Where the SSP goes by default.
const OUTPUT: &str = "fmu_out/building.ssp";

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let building = Building::read(&arguments.building)?;
    let motion = arguments.record.load(console)?;
    let output = match (&arguments.output, &motion) {
        (None, None) => Some(PathBuf::from(OUTPUT)),
        (output, _) => output.clone(),
    };
    let inputs = [&arguments.building].into_iter().chain(building.walls.iter().map(|wall| &wall.scene));
    let inputs = inputs.chain(&arguments.record.record);
    let fmus = output.iter().flat_map(|_| [&arguments.wall_fmu, &arguments.floor_fmu]);
    console.check_distinct(inputs.chain(fmus), output.iter().chain(arguments.run.outputs()))?;
    if motion.is_none() && arguments.run.outputs().next().is_some() {
        bail!("--csv and --html show a run; give its motion with --record or --synthetic");
    }
    let parts = Parts::read(&building)?;
    console.report_all(parts.warnings.iter().map(|warning| format!("warning: {warning}")));
    let mut text = String::new();
    if let Some(path) = &output {
        let trial = trial(&building, &parts);
        let step = trial.step(&building);
        let archive = parts.archive(&building, step, &arguments.wall_fmu, &arguments.floor_fmu)?;
        let bytes = archive.to_bytes()?;
        if let (None, Some(folder)) = (&arguments.output, path.parent()) {
            make_folder(folder)?;
        }
        console.write(path, &bytes)?;
        let (units, connections) = parts.counts();
        let _ = writeln!(
            text,
            "{}: {}, {}, {}",
            path.display(),
            building.title,
            counted(units, "unit"),
            counted(connections, "connection")
        );
        text.push_str(&advice(&trial, step));
    }
    if let Some((motion, note)) = motion {
        text.push_str(&run::run(console, &building, &parts, &motion, &note, &arguments.run)?);
    }
    console.print(&text)
}

/// Describes which steps the building needs, and which one the SSP states.
fn advice(trial: &Trial, stated: f64) -> String {
    let milliseconds = |step: f64| format!("{} ms", (1e9 * step).round() / 1e6);
    let found = |step: Option<f64>| {
        step.map_or_else(|| format!("none down to {}", milliseconds(trial.least)), milliseconds)
    };
    let motion = if trial.is_shaken { "under a pulse of the ground" } else { "from its start values" };
    let mut text = format!(
        "step for an error of 1 % of the peak of each u, displacement and acceleration, in a run of {} s\n\
         {motion}, by a master that passes all outputs on at once:\n\
         held inputs    {}\nlinear inputs  {}\n",
        trial.duration,
        found(trial.held),
        found(trial.linear)
    );
    let is_long = trial.held.is_none_or(|held| stated > held);
    let remark = if is_long { ", which is too long for held inputs" } else { "" };
    // writing to a String cannot fail
    let _ = writeln!(text, "the SSP states {}{remark}", milliseconds(stated));
    text
}
