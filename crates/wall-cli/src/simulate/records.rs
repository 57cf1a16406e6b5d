//! `wall simulate --records`: one wall under several records, as a table.

use std::fmt::Write;

use anyhow::{Context, Result, bail};
use ground_motion::GroundMotion;
use rocking_wall::response::{Response, Summary};
use rocking_wall::wall::Wall;
use serde_json::json;
use study::parallel;

use super::arguments::Arguments;
use crate::output;
use crate::progress::Progress;
use study_folder::csv::{optional, quoted};

/// A record with its sign.
struct Shaking {
    name: String,
    note: String,
    sign: char,
    motion: GroundMotion,
}

/// A record and what the wall did under it.
struct Row {
    name: String,
    sign: char,
    peak_acceleration: f64,
    summary: Summary,
}

pub(super) fn run(arguments: &Arguments) -> Result<()> {
    if arguments.html.is_some() || arguments.svg.is_some() {
        bail!("--html and --svg show one run; give its record with --record");
    }
    let scene = arguments.scene.load()?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.records);
    output::check_distinct(inputs, &arguments.csv)?;
    let motions = motions(arguments)?;
    let first = motions.first().map(|first| (first.motion.clone(), first.note.clone()));
    let first = arguments.shaken(scene.clone(), first)?;
    let wall = arguments.scene.named(Wall::new(&first.parameters))?;
    for warning in wall.warnings() {
        output::warn(&warning.to_string());
    }
    if let Some(warning) = first.floors.as_ref().and_then(|floors| floors.warning(&wall)) {
        output::warn(&warning);
    }
    let progress = Progress::new();
    let rows = parallel::map(motions.len(), parallel::threads(None).get(), |index| {
        let Shaking { name, note, sign, motion } = &motions[index];
        let mut scene = arguments.shaken(scene.clone(), Some((motion.clone(), note.clone())))?;
        // peaks and times come from the motion itself, not from samples
        scene.output_step = scene.stop_time;
        let response = Response::of(&scene).with_context(|| name.clone())?;
        progress.add(motions.len(), 1);
        let (name, peak_acceleration) = (name.clone(), motion.peak());
        anyhow::Ok(Row { name, sign: *sign, peak_acceleration, summary: response.summary })
    });
    progress.finish();
    let rows = rows?;
    output::save(arguments.csv.as_ref(), || csv(&rows))?;
    if arguments.json {
        let rows: Vec<_> = rows.iter().map(Row::json).collect();
        let value = json!({ "title": first.title, "runs": rows });
        return output::to_stdout(&(serde_json::to_string_pretty(&value)? + "\n"));
    }
    let mut text = format!("{}\n{}", first.title, table(&rows));
    if let Some(path) = &arguments.csv {
        let _ = writeln!(text, "written  {}", path.display());
    }
    output::to_stdout(&text)
}

/// Reads the records and scales them; with both signs if wanted.
fn motions(arguments: &Arguments) -> Result<Vec<Shaking>> {
    let signs: &[(char, f64)] =
        if arguments.both_polarities { &[('+', 1.0), ('-', -1.0)] } else { &[('+', 1.0)] };
    let mut motions = Vec::with_capacity(signs.len() * arguments.records.len());
    for path in &arguments.records {
        let (motion, note) = arguments.record.read(path)?;
        let motion = arguments.record.scaled(motion)?;
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        for &(sign, factor) in signs {
            let (name, note, motion) = (name.clone(), note.clone(), motion.checked_scaled(factor)?);
            motions.push(Shaking { name, note, sign, motion });
        }
    }
    Ok(motions)
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
        let [largest, ratio, overturned] = match summary.overturn_time {
            // beyond u_ins the peak is that of the fall
            Some(time) => ["-".to_owned(), "1".to_owned(), format!("at {time:.3} s")],
            None => [
                format!("{:.2}", 1000.0 * summary.u_max),
                format!("{:.4}", summary.u_ratio_max),
                "no".to_owned(),
            ],
        };
        let _ = writeln!(
            text,
            "{name:width$}  {sign:>4}  {peak_acceleration:>10.4}  {largest:>10}  {ratio:>9}  {overturned}"
        );
    }
    let fallen = rows.iter().filter(|row| row.summary.overturned).count();
    let _ = writeln!(text, "{fallen} of {} runs overturn", rows.len());
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text = String::from("record,sign,pga,u_max,u_ratio_max,overturned,overturn_time\n");
    for Row { name, sign, peak_acceleration, summary } in rows {
        let (u_max, ratio, overturned) = (summary.u_max, summary.u_ratio_max, summary.overturned);
        let time = optional(summary.overturn_time);
        let name = quoted(name);
        let _ =
            writeln!(text, "{name},{sign}1,{peak_acceleration:?},{u_max:?},{ratio:?},{overturned},{time}");
    }
    text
}
