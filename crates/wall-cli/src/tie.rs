//! `wall tie`: force of a parapet's tie and displacement of the wall against the stiffness of the tie.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use figures::palette::{BLUE, Mark, RED};
use figures::plot::{Axis, Look, Picture, Plot, Scale, Series};
use ground_motion::{RecordOptions, Unit, read};
use rocking_wall::response::{Fate, Response};
use rocking_wall::scene::{DEFAULT_TAIL, Scene};
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::TieDemands;
use rocking_wall::variables::TieSide;
use rocking_wall::wall::{Parameters, Wall};
use serde_json::{Value, json};
use study::parallel;

use crate::args::SceneArguments;
use crate::capacity::significant;
use crate::output;
use crate::polarity::Polarities;

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
    /// Stiffnesses in N/m, from 0 for no tie [default: 0, and 1e-2 to 1e3 of 2 W/h at the tie]
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
    /// Draw force and displacement over the stiffness, as SVG or PNG by the file's ending
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// What one motion asks of the tie, and of the wall with it.
#[derive(Clone, Copy)]
struct Outcome {
    /// \[N\]
    force: f64,
    /// Largest |u|/`u_ins`; 1 where the wall falls.
    u_ratio: f64,
    fate: Fate,
    /// The wall falls to the side on which no tie holds it.
    away: bool,
    /// The force reached the tie's strength.
    reached: bool,
}

/// The outcomes for one stiffness \[N/m\].
struct Row {
    stiffness: f64,
    outcomes: Vec<Outcome>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.scene.apply(&mut scene)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.records);
    output::check_distinct(inputs, arguments.csv.iter().chain(&arguments.plot))?;
    if scene.parameters.tie_height <= 0.0 {
        bail!("the scene has no tie_height; set it in [tie] or with --set tie_height=3");
    }
    let tied = Parameters { tie_stiffness: 1.0, ..scene.parameters.clone() };
    let tied = arguments.scene.named(Wall::new(&tied))?;
    let stiffnesses = stiffnesses(arguments, &tied)?;
    let (scenes, polarities) = scenes(arguments, scene, &tied)?;
    let threads = parallel::threads(arguments.threads).get();
    let outcomes = parallel::map(stiffnesses.len() * scenes.len(), threads, |index| {
        let stiffness = stiffnesses[index / scenes.len()];
        outcome(&scenes[index % scenes.len()], stiffness)
    })?;
    let rows = stiffnesses.iter().zip(outcomes.chunks(scenes.len()));
    let rows: Vec<Row> =
        rows.map(|(&stiffness, chunk)| Row { stiffness, outcomes: chunk.to_vec() }).collect();
    if let Some(path) = &arguments.plot {
        output::picture(path, || Ok(picture(&rows)))?;
    }
    output::save(arguments.csv.as_ref(), || csv(&rows))?;
    let text = if arguments.json {
        serde_json::to_string_pretty(&json(&scenes[0], polarities, &rows))? + "\n"
    } else {
        let mut text = table(&scenes[0], &rows) + polarities.note();
        for path in [&arguments.csv, &arguments.plot].into_iter().flatten() {
            let _ = writeln!(text, "\nwritten {}", path.display());
        }
        text
    };
    output::to_stdout(&text)
}

/// The stiffnesses asked for, in order; `wall` has the tie.
fn stiffnesses(arguments: &Arguments, wall: &Wall) -> Result<Vec<f64>> {
    let mut stiffnesses = arguments.stiffness.clone();
    if let Some(wrong) = stiffnesses.iter().find(|stiffness| !(stiffness.is_finite() && **stiffness >= 0.0)) {
        bail!("--stiffness {wrong}: must be 0 or above, in N/m");
    }
    if stiffnesses.is_empty() {
        let lever = wall.tie().map_or(1.0, |tie| tie.lever);
        let unit = wall.body().geometric_stiffness / (lever * lever);
        stiffnesses.push(0.0);
        stiffnesses.extend((-8..=12).map(|exponent| unit * 10.0_f64.powf(f64::from(exponent) / 4.0)));
    }
    stiffnesses.sort_by(f64::total_cmp);
    stiffnesses.dedup();
    Ok(stiffnesses)
}

/// The scene under each motion and its signs, with as few samples as possible; `wall` has the tie.
fn scenes(arguments: &Arguments, scene: Scene, wall: &Wall) -> Result<(Vec<Scene>, Polarities)> {
    let unit = arguments.unit.as_deref().map(str::parse::<Unit>).transpose()?;
    let options = RecordOptions { unit, ..RecordOptions::default() };
    let mut scenes = Vec::new();
    for path in &arguments.records {
        let record = read(path, &options)?;
        for warning in &record.check().warnings {
            output::warn(&format!("{}: {warning}", path.display()));
        }
        let mut shaken = scene.clone();
        let motion = record.motion.checked_scaled(arguments.scale)?;
        // at the scale 1 its reading has warned
        if let Some(warning) = motion.warning().filter(|_| arguments.scale.abs() > 1.0) {
            output::warn(&format!("{}: {warning}", path.display()));
        }
        shaken.shake(Excitation::new(motion, None), DEFAULT_TAIL, Vec::new());
        scenes.push(shaken);
    }
    if scenes.is_empty() {
        if scene.excitation.is_none() {
            bail!("the scene has no motion; give records with --records");
        }
        scenes.push(scene);
    }
    let polarities = Polarities::of(arguments.both_polarities, &scenes[0].parameters, wall);
    if polarities == Polarities::Both {
        for index in 0..scenes.len() {
            let mut other = scenes[index].clone();
            other.excitation = other.excitation.map(|motion| motion.reversed()).transpose()?;
            scenes.push(other);
        }
    }
    for scene in &mut scenes {
        scene.output_step = scene.stop_time;
    }
    Ok((scenes, polarities))
}

fn outcome(scene: &Scene, stiffness: f64) -> Result<Outcome> {
    let mut scene = scene.clone();
    scene.parameters.tie_stiffness = stiffness;
    let free = match scene.parameters.tie_side {
        TieSide::Positive => -1.0,
        TieSide::Negative => 1.0,
        TieSide::Both => 0.0,
    };
    let Response { summary, demands, residual, .. } = Response::of(&scene)?;
    let tie = demands.tie;
    Ok(Outcome {
        force: tie.map_or(0.0, |TieDemands { force, .. }| force.value),
        u_ratio: summary.u_ratio_max,
        fate: summary.fate,
        away: summary.fate.falls() && residual * free > 0.0,
        reached: tie.is_some_and(|tie| tie.strength.is_some()),
    })
}

impl Row {
    /// Median and largest of a quantity.
    fn of(&self, pick: fn(&Outcome) -> f64) -> [f64; 2] {
        let mut values: Vec<f64> = self.outcomes.iter().map(pick).collect();
        values.sort_by(f64::total_cmp);
        let (middle, last) = (values.len() / 2, values.len() - 1);
        let even = values.len().is_multiple_of(2);
        [if even { 0.5 * (values[middle - 1] + values[middle]) } else { values[middle] }, values[last]]
    }

    fn count(&self, pick: fn(&Outcome) -> bool) -> usize {
        self.outcomes.iter().filter(|outcome| pick(outcome)).count()
    }

    /// Median and largest force \[N\] and u/`u_ins`; walls that fall, those of them that fall away from the
    /// tie, walls beyond `u_ins` and back, strengths reached.
    fn values(&self) -> ([f64; 4], [usize; 4]) {
        let ([force, most], [ratio, largest]) = (self.of(|o| o.force), self.of(|o| o.u_ratio));
        let counts: [fn(&Outcome) -> bool; 4] = [
            |outcome| outcome.fate.falls(),
            |outcome| outcome.away,
            |outcome| matches!(outcome.fate, Fate::ComesBack { .. }),
            |outcome| outcome.reached,
        ];
        ([force, most, ratio, largest], counts.map(|pick| self.count(pick)))
    }
}

const COLUMNS: [&str; 9] = [
    "stiffness_n_m",
    "force_median_n",
    "force_max_n",
    "u_ratio_median",
    "u_ratio_max",
    "falls",
    "falls_away_from_tie",
    "beyond_u_ins_and_back",
    "strength_reached",
];

fn table(scene: &Scene, rows: &[Row]) -> String {
    let Parameters { tie_height, tie_side, .. } = scene.parameters;
    let side = match tie_side {
        TieSide::Positive => "u > 0",
        TieSide::Negative => "u < 0",
        TieSide::Both => "both sides",
    };
    let count = rows[0].outcomes.len();
    let motions = if count == 1 { "motion" } else { "motions" };
    let mut text = format!("{}, tie at {tie_height} m against {side}, {count} {motions}\n\n", scene.title);
    let _ = writeln!(
        text,
        "{:>13} {:>14} {:>13} {:>14} {:>13} {:>6} {:>14} {:>22} {:>17}",
        "K [N/m]",
        "N median [kN]",
        "N max [kN]",
        "u/u_ins median",
        "u/u_ins max",
        "falls",
        "away from tie",
        "beyond u_ins and back",
        "strength reached"
    );
    for row in rows {
        let ([force, most, ratio, largest], [falls, away, back, reached]) = row.values();
        let _ = writeln!(
            text,
            "{} {:>14} {} {:>14} {} {falls:>6} {away:>14} {back:>22} {reached:>17}",
            significant(row.stiffness),
            significant(1e-3 * force),
            significant(1e-3 * most),
            significant(ratio),
            significant(largest)
        );
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

fn json(scene: &Scene, polarities: Polarities, rows: &[Row]) -> Value {
    let object = |row: &Row| {
        let (numbers, counts) = row.values();
        let values = [json!(row.stiffness)].into_iter().chain(numbers.map(|number| json!(number)));
        let values = values.chain(counts.map(|count| json!(count)));
        COLUMNS.iter().map(|name| (*name).to_owned()).zip(values).collect::<serde_json::Map<_, _>>()
    };
    json!({
        "title": scene.title,
        "tie_height": scene.parameters.tie_height,
        "tie_side": scene.parameters.tie_side.name(),
        "motions": rows[0].outcomes.len(),
        "alike_on_both_sides": polarities == Polarities::Alike,
        "rows": rows.iter().map(|row| Value::Object(object(row))).collect::<Vec<_>>(),
    })
}

/// Medians (lines) and largest values (marks) of force and displacement over the stiffness.
fn picture(rows: &[Row]) -> Picture {
    let tied: Vec<&Row> = rows.iter().filter(|row| row.stiffness > 0.0).collect();
    let panel = |label: &str, color, pick: fn(&Outcome) -> f64, scale: f64| {
        let points = |part: usize| -> Vec<(f64, f64)> {
            tied.iter().map(|row| (row.stiffness.log10(), scale * row.of(pick)[part])).collect()
        };
        let largest = points(1);
        let top = 1.08 * largest.iter().map(|point| point.1).fold(0.0, f64::max);
        let marks = Series { look: Look::Marks(Mark::Circle), ..Series::line(color, 3.0, largest) };
        let series = vec![Series::line(color, 1.6, points(0)), marks];
        let x = [points(0).first().map_or(0.0, |p| p.0 - 0.1), points(0).last().map_or(1.0, |p| p.0 + 0.1)];
        let axes = [Axis::over("log10 of the stiffness (N/m)", x), Axis::over(label, [-0.02 * top, top])];
        Plot { scale: Scale::Linear, ..Plot::new([820.0, 320.0], axes, series) }
    };
    Picture::stacked(&[
        Plot {
            title: "Line: median of the motions; dots: largest".to_owned(),
            ..panel("force of the tie (kN)", RED, |outcome| outcome.force, 1e-3)
        },
        panel("largest |u|/u_ins", BLUE, |outcome| outcome.u_ratio, 1.0),
    ])
}
