//! `wall tie`: force of a parapet's tie and displacement of the wall against the stiffness of the tie.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use figures::palette::{BLUE, Mark, RED};
use figures::plot::{Axis, Look, Picture, Plot, Scale, Series};
use ground_motion::{RecordOptions, Unit, read};
use rocking_wall::response::Response;
use rocking_wall::scene::{DEFAULT_TAIL, Scene};
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::TieDemands;
use rocking_wall::wall::Wall;
use serde_json::{Value, json};
use study::parallel;

use crate::args::SceneArguments;
use crate::capacity::significant;
use crate::output;

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
    /// Largest |u|/`u_ins`; 1 where the wall overturned.
    u_ratio: f64,
    overturned: bool,
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
    let stiffnesses = stiffnesses(arguments, &scene)?;
    let scenes = scenes(arguments, scene)?;
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
        serde_json::to_string_pretty(&json(&rows))? + "\n"
    } else {
        let mut text = table(&scenes[0], &rows);
        for path in [&arguments.csv, &arguments.plot].into_iter().flatten() {
            let _ = writeln!(text, "\nwritten {}", path.display());
        }
        text
    };
    output::to_stdout(&text)
}

/// The stiffnesses asked for, in order.
fn stiffnesses(arguments: &Arguments, scene: &Scene) -> Result<Vec<f64>> {
    if scene.parameters.tie_height <= 0.0 {
        bail!("the scene has no tie_height; set it in [tie] or with --set tie_height=3");
    }
    let mut stiffnesses = arguments.stiffness.clone();
    if let Some(wrong) = stiffnesses.iter().find(|stiffness| !(stiffness.is_finite() && **stiffness >= 0.0)) {
        bail!("--stiffness {wrong}: must be 0 or above, in N/m");
    }
    if stiffnesses.is_empty() {
        let mut probe = scene.parameters.clone();
        probe.tie_stiffness = 1.0;
        let wall = arguments.scene.named(Wall::new(&probe))?;
        let lever = wall.tie().map_or(1.0, |tie| tie.lever);
        let unit = wall.body().geometric_stiffness / (lever * lever);
        stiffnesses.push(0.0);
        stiffnesses.extend((-8..=12).map(|exponent| unit * 10.0_f64.powf(f64::from(exponent) / 4.0)));
    }
    stiffnesses.sort_by(f64::total_cmp);
    stiffnesses.dedup();
    Ok(stiffnesses)
}

/// The scene under each motion, with as few samples as possible.
fn scenes(arguments: &Arguments, scene: Scene) -> Result<Vec<Scene>> {
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
        shaken.shake(Excitation::new(motion, None), DEFAULT_TAIL, Vec::new());
        scenes.push(shaken);
    }
    if scenes.is_empty() {
        if scene.excitation.is_none() {
            bail!("the scene has no motion; give records with --records");
        }
        scenes.push(scene);
    }
    for scene in &mut scenes {
        scene.output_step = scene.stop_time;
    }
    Ok(scenes)
}

fn outcome(scene: &Scene, stiffness: f64) -> Result<Outcome> {
    let mut scene = scene.clone();
    scene.parameters.tie_stiffness = stiffness;
    let Response { summary, demands, .. } = Response::of(&scene)?;
    let tie = demands.tie;
    Ok(Outcome {
        force: tie.map_or(0.0, |TieDemands { force, .. }| force.value),
        u_ratio: if summary.overturned { 1.0 } else { summary.u_ratio_max },
        overturned: summary.overturned,
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

    /// Median and largest force \[N\] and u/`u_ins`, walls overturned, strengths reached.
    fn values(&self) -> ([f64; 4], [usize; 2]) {
        let ([force, most], [ratio, largest]) = (self.of(|o| o.force), self.of(|o| o.u_ratio));
        ([force, most, ratio, largest], [self.count(|o| o.overturned), self.count(|o| o.reached)])
    }
}

const COLUMNS: [&str; 7] = [
    "stiffness_n_m",
    "force_median_n",
    "force_max_n",
    "u_ratio_median",
    "u_ratio_max",
    "overturned",
    "strength_reached",
];

fn table(scene: &Scene, rows: &[Row]) -> String {
    let mut text = format!("{}, tie at {} m", scene.title, scene.parameters.tie_height);
    let count = rows[0].outcomes.len();
    let _ = writeln!(text, ", {count} motion{}\n", if count == 1 { "" } else { "s" });
    let _ = writeln!(
        text,
        "{:>13} {:>13} {:>13} {:>13} {:>13} {:>10} {:>8}",
        "K [N/m]", "N median [N]", "N max [N]", "u/u_ins med.", "u/u_ins max", "overturned", "strength"
    );
    for row in rows {
        let (numbers, [overturned, reached]) = row.values();
        let numbers = numbers.map(significant).join(" ");
        let _ = writeln!(text, "{} {numbers} {overturned:>10} {reached:>8}", significant(row.stiffness));
    }
    text
}

fn csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",") + "\n";
    for row in rows {
        let (numbers, [overturned, reached]) = row.values();
        let numbers = numbers.map(|number| format!("{number:?}")).join(",");
        let _ = writeln!(text, "{:?},{numbers},{overturned},{reached}", row.stiffness);
    }
    text
}

fn json(rows: &[Row]) -> Value {
    let object = |row: &Row| {
        let ([force, most, ratio, largest], [overturned, reached]) = row.values();
        let values = [
            json!(row.stiffness),
            json!(force),
            json!(most),
            json!(ratio),
            json!(largest),
            json!(overturned),
            json!(reached),
        ];
        COLUMNS.iter().map(|name| (*name).to_owned()).zip(values).collect::<serde_json::Map<_, _>>()
    };
    rows.iter().map(|row| Value::Object(object(row))).collect()
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
