//! `wall study tie`: force of a parapet's tie and displacement of the wall against the stiffness of the tie.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use ground_motion::{GroundMotion, RecordOptions, Unit};
use report::counted;
use rocking_wall::scene::Scene;
use rocking_wall::variables::TieSide;
use rocking_wall::wall::Parameters;
use run::parallel;
use run::polarity::Polarities;
use serde_json::{Value, json};
use study::tie::figure::picture;
use study::tie::{COLUMNS, Row, TieStudy};

use crate::args::{SceneArguments, read_record};
use crate::output::significant;
use crate::output::{self, Console};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Records instead of the scene's own motion
    #[arg(long, value_name = "FILE", num_args = 1..)]
    records: Vec<PathBuf>,
    /// Unit of records that do not state theirs: m/s2, cm/s2, mm/s2 or g
    #[arg(long, requires = "records")]
    unit: Option<String>,
    /// Run each motion with both signs
    #[arg(long)]
    both_polarities: bool,
    /// Factor on the records
    #[arg(long, requires = "records", value_name = "FACTOR", default_value_t = 1.0)]
    scale: f64,
    /// Stiffnesses in N/m, separated by commas, from 0 for no tie [default: 0, and 1e-2 to 1e3 of
    /// 2 W/h at the tie]
    #[arg(long, value_name = "N_PER_M", value_delimiter = ',')]
    stiffness: Vec<f64>,
    /// Number of threads [default: one for each core]
    #[arg(long)]
    threads: Option<NonZeroUsize>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the table as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw force and displacement over the stiffness, as SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load(console)?;
    arguments.scene.apply(&mut scene)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.records);
    console.check_distinct(inputs, arguments.csv.iter().chain(&arguments.plot))?;
    let records = records(console, arguments)?;
    let study = arguments.scene.named(TieStudy::new(scene, records, arguments.both_polarities))?;
    let stiffnesses = study.stiffnesses(&arguments.stiffness)?;
    let rows = study.rows(&stiffnesses, parallel::threads(arguments.threads).get())?;
    console.picture(arguments.plot.as_ref(), || Ok(picture(&rows)))?;
    console.save(arguments.csv.as_ref(), || csv(&rows))?;
    let text = if arguments.json {
        serde_json::to_string_pretty(&json(&study, &rows))? + "\n"
    } else {
        let written = output::written("\nwritten ", arguments.csv.iter().chain(&arguments.plot));
        table(study.scene(), &rows) + study.polarities().note() + &written
    };
    console.print(&text)
}

/// The records asked for, scaled.
fn records(console: &Console<'_>, arguments: &Arguments) -> Result<Vec<GroundMotion>> {
    let unit = arguments.unit.as_deref().map(str::parse::<Unit>).transpose()?;
    let options = RecordOptions { unit, ..RecordOptions::default() };
    let mut motions = Vec::new();
    for path in &arguments.records {
        let motion = read_record(console, path, &options)?.motion.checked_scaled(arguments.scale)?;
        // at a scale of 1 the reader has already warned
        if let Some(warning) = motion.warning().filter(|_| arguments.scale.abs() > 1.0) {
            console.warn(&format!("{}: {warning}", path.display()));
        }
        motions.push(motion);
    }
    Ok(motions)
}

/// The columns of [`table`]: two lines of heads, so that a row fits on a screen, and widths.
const HEADS: [[&str; 9]; 2] = [
    ["", "N median", "N max", "u/u_ins", "u/u_ins", "", "away", "beyond u_ins", "strength"],
    ["K [N/m]", "[kN]", "[kN]", "median", "max", "falls", "from tie", "and back", "reached"],
];
const WIDTHS: [usize; 9] = [13, 13, 13, 13, 13, 6, 9, 13, 9];

fn table(scene: &Scene, rows: &[Row]) -> String {
    let Parameters { tie_height, tie_side, .. } = scene.parameters;
    let side = match tie_side {
        TieSide::Positive => "u > 0",
        TieSide::Negative => "u < 0",
        TieSide::Both => "both sides",
    };
    let motions = counted(rows[0].outcomes.len(), "motion");
    let mut text = format!("{}, tie at {tie_height} m against {side}, {motions}\n\n", scene.title);
    for heads in HEADS {
        let cells = heads.iter().zip(WIDTHS).map(|(head, width)| format!("{head:>width$}"));
        text += &(cells.collect::<Vec<_>>().join(" ") + "\n");
    }
    for row in rows {
        let ([force, most, ratio, largest], [falls, away, back, reached]) = row.values();
        let numbers = [row.stiffness, 1e-3 * force, 1e-3 * most, ratio, largest].map(significant).join(" ");
        let _ = writeln!(text, "{numbers} {falls:>6} {away:>9} {back:>13} {reached:>9}");
    }
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for row in rows {
        let (numbers, counts) = row.values();
        let (numbers, counts) = (numbers.map(|number| format!("{number:?}")), counts.map(|n| n.to_string()));
        let _ = writeln!(text, "{:?},{},{}", row.stiffness, numbers.join(","), counts.join(","));
    }
    text
}

fn json(study: &TieStudy, rows: &[Row]) -> Value {
    let Parameters { tie_height, tie_side, .. } = study.scene().parameters;
    let object = |row: &Row| {
        let (numbers, counts) = row.values();
        let values = [json!(row.stiffness)].into_iter().chain(numbers.map(|number| json!(number)));
        let values = values.chain(counts.map(|count| json!(count)));
        COLUMNS.iter().map(|name| (*name).to_owned()).zip(values).collect::<serde_json::Map<_, _>>()
    };
    json!({
        "title": study.scene().title,
        "tie_height": tie_height,
        "tie_side": tie_side.name(),
        "motions": rows[0].outcomes.len(),
        "alike_on_both_sides": study.polarities() == Polarities::Alike,
        "rows": rows.iter().map(|row| Value::Object(object(row))).collect::<Vec<_>>(),
    })
}
