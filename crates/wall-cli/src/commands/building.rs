//! `wall building`: storeys and walls as one system, under a record or as an SSP 1.0 archive.
//!
//! In the archive each wall is the FMU of its scene, and each storey an FMU with its values inside: importers
//! do not agree on how an enumeration is set from outside, and some ignore the parameters of a system.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use building::coupled::{Coupled, Settings};
use building::page::render;
use building::trial::{Trial, trial};
use building::{Building, Parts, table};
use clap::Args;
use ground_motion::GroundMotion;
use report::counted;
use run::file::make_folder;
use scene::DEFAULT_TAIL;

use crate::args::RecordArguments;
use crate::output::{self, Console};

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
    run: Options,
}

#[derive(Debug, Args)]
struct Options {
    /// Free vibration in s after the record
    #[arg(long, value_name = "SECONDS", default_value_t = DEFAULT_TAIL)]
    tail: f64,
    /// Change of any peak by halving the step, over the peak, at which the step is short enough
    #[arg(long, value_name = "RATIO", default_value_t = 0.01)]
    tolerance: f64,
    /// Write the histories of floors and walls as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write a page on which the storeys sway and the walls rock
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Print the peaks as JSON
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Returns the files that a run writes.
    fn outputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.csv.iter().chain(&self.html)
    }
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
        text.push_str(&shaken(console, &building, &parts, &motion, &note, &arguments.run)?);
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

/// Runs a building, writes what was asked for and returns the text to print.
fn shaken(
    console: &Console<'_>,
    building: &Building,
    parts: &Parts,
    ground: &GroundMotion,
    note: &str,
    options: &Options,
) -> Result<String> {
    let &Options { tail, tolerance, .. } = options;
    let settings = Settings::new(ground, tail, tolerance).context("--tail or --tolerance")?;
    let run = Coupled::run(parts, ground, settings)?;
    console.save(options.csv.as_ref(), || table::histories(building, &run).csv())?;
    console.save(options.html.as_ref(), || render(building, parts, &run, note))?;
    if options.json {
        return Ok(serde_json::to_string_pretty(&table::json(building, parts, &run))? + "\n");
    }
    let mut text = format!(
        "{}\n{note}, peak acceleration {:.4} m/s²; step {} ms, at which halving changed peaks by \
         {:.2} %\n\n{}",
        building.title,
        run.ground.peak.value.abs(),
        report::number(1000.0 * run.step, 4),
        100.0 * run.change,
        table::floors(building, &run).text()
    );
    if !run.walls.is_empty() {
        text = text + "\n" + &table::walls(building, parts, &run).text();
    }
    Ok(text + &output::written("written  ", options.outputs()))
}
