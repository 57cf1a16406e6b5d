//! `wall building --record`: the summary and the history of a building under a record.

use std::path::PathBuf;

use anyhow::{Context, Result};
use building::coupled::{Coupled, Settings};
use building::page::render;
use building::{Building, Parts, table};
use clap::Args;
use ground_motion::GroundMotion;
use rocking_wall::scene::DEFAULT_TAIL;

use crate::output::{self, Console};

#[derive(Debug, Args)]
pub(crate) struct Options {
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
    pub(super) fn outputs(&self) -> impl Iterator<Item = &PathBuf> {
        self.csv.iter().chain(&self.html)
    }
}

/// Runs a building, writes what was asked for and returns the text to print.
pub(super) fn run(
    console: &Console<'_>,
    building: &Building,
    parts: &Parts,
    ground: &GroundMotion,
    note: &str,
    options: &Options,
) -> Result<String> {
    let &Options { tail, tolerance, .. } = options;
    let settings = Settings::new(ground, tail, tolerance).context("--tail or --tolerance")?;
    let run = Coupled::run(parts, ground, settings, &|| true)?;
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
