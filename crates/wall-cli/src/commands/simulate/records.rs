//! `wall simulate --records` and `--both-polarities`: one wall under several motions, as a table.

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use ground_motion::GroundMotion;
use report::counted;
use rocking_wall::response::{Response, Summary};
use rocking_wall::wall::Wall;
use run::parallel;
use serde_json::json;

use super::arguments::Arguments;
use crate::args::short_name;
use crate::output::optional;
use crate::output::progress::{self, Progress};
use crate::output::{self, Console};
use report::table::quoted;
use run::demands;
use run::polarity::Polarities;

/// A record, scaled.
struct Shaking {
    name: String,
    note: String,
    motion: GroundMotion,
}

/// A record and what the wall did under it.
struct Row {
    name: String,
    sign: &'static str,
    peak_acceleration: f64,
    summary: Summary,
}

pub(super) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    if arguments.html.is_some() {
        bail!("--html shows one run; give its record with --record, without --both-polarities");
    }
    let scene = arguments.scene.load(console)?;
    let inputs = arguments.scene.inputs(&scene).chain(arguments.table());
    console.check_distinct(inputs, &arguments.csv)?;
    let motions = motions(console, arguments)?;
    let first = motions.first().map(|first| (first.motion.clone(), first.note.clone()));
    let first = arguments.shaken(scene.clone(), first)?;
    let wall = arguments.scene.named(Wall::new(&first.parameters))?;
    let polarities = Polarities::of(arguments.both_polarities, &first.parameters, &wall);
    let signs = polarities.signs();
    wall.warnings().iter().for_each(|warning| console.warn(&warning.to_string()));
    for warning in first.floors.iter().flat_map(|floors| floors.warnings(&wall)) {
        console.warn(&warning);
    }
    let runs = signs.len() * motions.len();
    let row = |index: usize, progress: &Progress| {
        let (Shaking { name, note, motion }, (sign, factor)) =
            (&motions[index / signs.len()], signs[index % signs.len()]);
        let motion = motion.checked_scaled(factor)?;
        let peak_acceleration = motion.peak();
        let mut scene = arguments.shaken(scene.clone(), Some((motion, note.clone())))?;
        // peaks and times come from the motion itself, not from samples
        scene.output_step = scene.stop_time;
        let response = Response::of(&scene).with_context(|| name.clone())?;
        progress.add(runs, 1);
        anyhow::Ok(Row { name: name.clone(), sign, peak_acceleration, summary: response.summary })
    };
    let threads = parallel::threads(None).get();
    let rows = progress::shown(|progress| parallel::map(runs, threads, |index| row(index, progress)))?;
    console.save(arguments.csv.as_ref(), || csv(&rows))?;
    if arguments.json {
        let rows: Vec<_> = rows.iter().map(Row::json).collect();
        let value = json!({
            "title": first.title,
            "alike_on_both_sides": polarities == Polarities::Alike,
            "runs": rows,
        });
        return console.print(&(serde_json::to_string_pretty(&value)? + "\n"));
    }
    let text = format!("{}\n{}{}", first.title, table(&rows), polarities.note());
    console.print(&(text + &output::written("written  ", &arguments.csv)))
}

/// Reads the records and scales them.
fn motions(console: &Console<'_>, arguments: &Arguments) -> Result<Vec<Shaking>> {
    let shaking = |path: &PathBuf| {
        let (motion, note) = arguments.record.read(console, path)?;
        let motion = arguments.record.motion.scaled(console, motion)?;
        let name = short_name(path);
        Ok(Shaking { name, note, motion })
    };
    arguments.table().iter().map(shaking).collect()
}

impl Row {
    fn json(&self) -> serde_json::Value {
        json!({
            "record": self.name,
            "sign": self.sign,
            "pga": self.peak_acceleration,
            "u_max": self.summary.u_max,
            "u_ratio_max": self.summary.u_ratio_max,
            "overturned": self.summary.overturned,
            "overturn_time": self.summary.overturn_time,
            "falls": self.summary.fate.falls(),
        })
    }
}

fn table(rows: &[Row]) -> String {
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or(0).max("record".len());
    let mut text = format!(
        "{:width$}  sign  {:>10}  {:>10}  {:>7}  overturned\n",
        "record", "PGA [m/s²]", "|u| [mm]", "|u|/u_ins"
    );
    for Row { name, sign, peak_acceleration, summary } in rows {
        let _ = writeln!(
            text,
            "{name:width$}  {sign:>4}  {peak_acceleration:>10.4}  {:>10.2}  {:>9.4}  {}",
            1000.0 * summary.u_max,
            summary.u_ratio_max,
            demands::overturned(summary.fate, 3)
        );
    }
    let count = |is: fn(&Summary) -> bool| rows.iter().filter(|row| is(&row.summary)).count();
    let overturned = count(|summary| summary.overturned);
    let _ = write!(text, "overturned: {overturned} of {}", counted(rows.len(), "run"));
    let back = overturned - count(|summary| summary.fate.falls());
    if back > 0 {
        let _ = write!(text, ", of which {back} came back");
    }
    text.push('\n');
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text =
        String::from("record,sign,pga_m_s2,u_max_m,u_ratio_max,overturned,overturn_time_s,falls\n");
    for Row { name, sign, peak_acceleration, summary } in rows {
        let (u_max, ratio, overturned) = (summary.u_max, summary.u_ratio_max, summary.overturned);
        let time = optional(summary.overturn_time);
        // one run stands for both signs
        let sign = sign.replace('±', "+");
        let name = quoted(name);
        let _ = writeln!(
            text,
            "{name},{sign}1,{peak_acceleration:?},{u_max:?},{ratio:?},{overturned},{time},{}",
            summary.fate.falls()
        );
    }
    text
}
