//! `wall building --record`: the summary and the history of a building under a record.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Context, Result};
use building::coupled::{Coupled, History, Peak, Settings};
use building::{Building, Parts};
use clap::Args;
use ground_motion::GroundMotion;
use rocking_wall::scene::DEFAULT_TAIL;
use serde_json::json;

use crate::output::{self, Console};
use building::page::render;
use run::demands;

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
    let run = Coupled::run(building, parts, ground, settings)?;
    console.save(options.csv.as_ref(), || csv(building, &run))?;
    console.save(options.html.as_ref(), || render(building, parts, &run, note))?;
    if options.json {
        return Ok(serde_json::to_string_pretty(&json(building, parts, &run))? + "\n");
    }
    Ok(table(building, parts, &run, note) + &output::written("written  ", options.outputs()))
}

fn table(building: &Building, parts: &Parts, run: &Coupled, note: &str) -> String {
    let names = building.floors.iter().map(|floor| &floor.name);
    let names = names.chain(building.walls.iter().map(|wall| &wall.name));
    let width = names.map(String::len).max().unwrap_or(0).max("ground".len());
    let mut text = format!(
        "{}\n{note}, peak acceleration {:.4} m/s²; step {} ms, at which halving changed peaks by {:.2} %\n\n",
        building.title,
        run.ground.peak.value.abs(),
        report::number(1000.0 * run.step, 4),
        100.0 * run.change
    );
    let at = |Peak { value, time }: Peak, scale: f64, digits: usize| {
        format!("{:+.digits$} at {time:.2} s", scale * value)
    };
    let _ = writeln!(text, "{:width$}  {:>19}  {:>19}", "floor", "acceleration [m/s²]", "drift [mm]");
    for (floor, history) in building.floors.iter().zip(&run.floors) {
        let (a, d) = (at(history.acceleration.peak, 1.0, 3), at(history.drift.peak, 1000.0, 2));
        let _ = writeln!(text, "{:width$}  {a:>19}  {d:>19}", floor.name);
    }
    if run.walls.is_empty() {
        return text;
    }
    let _ = writeln!(
        text,
        "\n{:width$}  {:>19}  {:>7}  {:>19}  {:>19}  overturned",
        "wall", "u [mm]", "u/u_ins", "bottom force [kN]", "top force [kN]"
    );
    for ((wall, history), own) in building.walls.iter().zip(&run.walls).zip(&parts.walls) {
        let (peak, [_, ratio]) = history.reported(own, &run.times);
        let u = at(peak, 1000.0, 1);
        let top = if wall.top.is_some() { at(history.reaction_top.peak, 1e-3, 2) } else { "-".to_owned() };
        let _ = writeln!(
            text,
            "{:width$}  {u:>19}  {ratio:>7.3}  {:>19}  {top:>19}  {}",
            wall.name,
            at(history.reaction_bottom.peak, 1e-3, 2),
            demands::overturned(history.fate(&run.times), 3)
        );
    }
    text
}

/// One row for each sample of the record, and on at its step; the header names the columns with their units.
fn csv(building: &Building, run: &Coupled) -> String {
    let mut columns: Vec<(String, &History)> = vec![("ground.acceleration_m_s2".into(), &run.ground)];
    for (floor, history) in building.floors.iter().zip(&run.floors) {
        columns.push((format!("{}.acceleration_m_s2", floor.name), &history.acceleration));
        columns.push((format!("{}.drift_m", floor.name), &history.drift));
    }
    for (wall, history) in building.walls.iter().zip(&run.walls) {
        let name = &wall.name;
        columns.push((format!("{name}.u_m"), &history.displacement));
        columns.push((format!("{name}.u_ratio"), &history.ratio));
        columns.push((format!("{name}.reaction_bottom_n"), &history.reaction_bottom));
        if wall.top.is_some() {
            columns.push((format!("{name}.reaction_top_n"), &history.reaction_top));
        }
    }
    let mut text = String::from("time_s");
    for (name, _) in &columns {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    for (row, time) in run.times.iter().enumerate() {
        let _ = write!(text, "{time:.9}");
        for (_, history) in &columns {
            let _ = write!(text, ",{:?}", history.values[row]);
        }
        text.push('\n');
    }
    text
}

fn json(building: &Building, parts: &Parts, run: &Coupled) -> serde_json::Value {
    let peak = |history: &History| json!({ "value": history.peak.value, "time": history.peak.time });
    let floors = building.floors.iter().zip(&run.floors).map(|(floor, history)| {
        let (acceleration, drift) = (peak(&history.acceleration), peak(&history.drift));
        json!({ "name": floor.name, "acceleration": acceleration, "drift": drift })
    });
    let walls = building.walls.iter().zip(&run.walls).zip(&parts.walls).map(|((wall, history), own)| {
        let (at, [u_max, ratio]) = history.reported(own, &run.times);
        json!({
            "name": wall.name,
            "u_max": u_max,
            "u_ratio": { "value": ratio.copysign(at.value), "time": at.time },
            "reaction_bottom": peak(&history.reaction_bottom),
            "reaction_top": peak(&history.reaction_top),
            "overturn_time": history.overturn_time,
            "falls": history.fate(&run.times).falls(),
        })
    });
    json!({
        "title": building.title,
        "step": run.step,
        "change": run.change,
        "floors": floors.collect::<Vec<_>>(),
        "walls": walls.collect::<Vec<_>>(),
    })
}
