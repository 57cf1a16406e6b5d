//! `wall check`: capacity against demand, from a wall's own capacity curve.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use figures::capacity::over_demand;
use figures::escaped;
use figures::plot::Plot;
use ground_motion::spectrum::DAMPING;
use ground_motion::{RecordOptions, Unit};
use rocking_wall::scene::{Floors, read_text};
use rocking_wall::wall::Wall;
use serde_json::{Value, json};
use study::check::{CapacityOverDemand, CheckError, Demand, Fractions, POINTS, SideCheck, check, governing};

use crate::args::{SceneArguments, read_record};
use crate::output;
use crate::output::capacity::significant;
use figures::template;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Demand: a response spectrum as CSV, T in s and Sa, from T = 0 on; of the ground or of a floor
    #[arg(long, value_name = "FILE", required_unless_present = "records", conflicts_with = "records")]
    spectrum: Option<PathBuf>,
    /// Demand: the median spectrum of these records, felt on the floor of a scene with storeys
    #[arg(long, value_name = "FILE", num_args = 1..)]
    records: Vec<PathBuf>,
    /// Unit of a spectrum or of records that do not state theirs: m/s2, cm/s2, mm/s2 or g
    #[arg(long)]
    unit: Option<String>,
    /// Damping ratio of the spectrum
    #[arg(long, value_name = "RATIO", default_value_t = DAMPING)]
    damping: f64,
    /// Displacement capacity over the displacement at which the force of the wall vanishes
    #[arg(long, value_name = "FRACTION", default_value_t = Fractions::default().displacement)]
    displacement_fraction: f64,
    /// Displacement of the secant period over the displacement capacity
    #[arg(long, value_name = "FRACTION", default_value_t = Fractions::default().secant)]
    secant_fraction: f64,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write a page with the capacity curve over the demand
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load()?;
    arguments.scene.apply(&mut scene)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.spectrum).chain(&arguments.records);
    output::check_distinct(inputs, &arguments.html)?;
    let wall = arguments.scene.named(Wall::new(&scene.parameters))?;
    let source = Source::read(arguments, scene.floors.as_ref(), &wall)?;
    let fractions =
        Fractions { displacement: arguments.displacement_fraction, secant: arguments.secant_fraction };
    let sides = check(&wall, fractions, |period| source.demand.at(period))?;
    if let Some(path) = &arguments.html {
        let table = escaped(&table(&scene.title, &source, arguments, &sides));
        let wide = over_demand(&CapacityOverDemand::new(&wall, &source.demand, &sides)?);
        // on a narrow screen the legend would hide the curves
        let mut narrow = Plot { size: [390.0, 330.0], ..wide.clone() };
        narrow.series.iter_mut().for_each(|series| series.name.clear());
        let [wide, narrow] = [wide.svg(), narrow.svg()];
        let title = format!("{}: capacity against demand", escaped(&scene.title));
        let parts = [("title", &*title), ("wide", &wide), ("narrow", &narrow), ("table", &table)];
        output::to_file(path, template::page(include_str!("../pages/check.html"), &parts).as_bytes())?;
    }
    let text = if arguments.json {
        serde_json::to_string_pretty(&json(&scene.title, &source, arguments, &sides))? + "\n"
    } else {
        let mut text = table(&scene.title, &source, arguments, &sides);
        if let Some(path) = &arguments.html {
            let _ = writeln!(text, "\nwritten {}", path.display());
        }
        text
    };
    output::to_stdout(&text)
}

/// Where the demand comes from.
struct Source {
    name: String,
    damping: f64,
    demand: Demand,
}

/// Largest spectrum file that is read.
const MAX_FILE_BYTES: u64 = 1 << 20;

impl Source {
    fn read(arguments: &Arguments, floors: Option<&Floors>, wall: &Wall) -> Result<Self> {
        let unit = arguments.unit.as_deref().map(str::parse::<Unit>).transpose()?;
        let damping = arguments.damping;
        if let Some(path) = &arguments.spectrum {
            if floors.is_some() {
                output::warn(
                    "the storeys are not applied to --spectrum; it must be the spectrum of the wall's floor",
                );
            }
            let (unit, demand) = points(path, unit)?;
            return Ok(Self { name: format!("{}, Sa in {unit}", path.display()), damping, demand });
        }
        let options = RecordOptions { unit, ..RecordOptions::default() };
        let motion = |path: &PathBuf| Ok(read_record(path, &options)?.motion);
        let motions = arguments.records.iter().map(motion).collect::<Result<Vec<_>>>()?;
        let count = motions.len();
        let mut name = format!("median of {count} record{}", if count == 1 { "" } else { "s" });
        if let Some(floors) = floors {
            floors.warning(wall).iter().for_each(|warning| output::warn(warning));
            let _ = write!(name, " {}", floors.note());
        }
        Ok(Self { name, damping, demand: Demand::of_records(motions, floors, wall, damping)? })
    }
}

/// Reads a spectrum and its unit, which the file states in its header line, or the arguments do.
fn points(path: &Path, given: Option<Unit>) -> Result<(Unit, Demand)> {
    let text = read_text(path, "a spectrum (CSV)", MAX_FILE_BYTES)?;
    let unit = match (stated_unit(&text), given) {
        (Some(stated), Some(given)) if stated != given => {
            bail!("{}: line 1: states {stated}, and --unit {given}; leave --unit out", path.display());
        }
        (stated, given) => stated.or(given).with_context(|| {
            let path = path.display();
            format!("{path}: states no unit; give --unit, or write it into a header line, T [s],Sa [g]")
        })?,
    };
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    for (index, line) in text.lines().enumerate() {
        let number = |field: &str| field.trim().parse::<f64>().ok();
        let fields: Vec<_> = line.split([',', ';', '\t']).collect();
        let pair = match fields[..] {
            [period, value] => number(period).zip(number(value)),
            _ => None,
        };
        let Some((period, value)) = pair else {
            if index == 0 || line.trim().is_empty() {
                continue;
            }
            bail!("{}: line {}: expected T in s and Sa, such as 0.5,0.42", path.display(), index + 1);
        };
        points.push((period, unit.to_si(value)));
        lines.push(index + 1);
    }
    let demand = Demand::of_points(points).map_err(|error| match error {
        CheckError::Point { number, .. } => {
            anyhow!("{}: line {}: expected {POINTS}", path.display(), lines[number - 1])
        }
        other => anyhow!("{}: {other}", path.display()),
    })?;
    Ok((unit, demand))
}

/// Finds the unit in brackets at the end of a header line, `T [s],Sa [g]`; `Sa (5 %)` states none.
fn stated_unit(text: &str) -> Option<Unit> {
    let header = text.lines().next()?.trim().trim_end_matches('"');
    let bracket = |(opening, closing)| header.strip_suffix(closing)?.rsplit_once(opening);
    [('[', ']'), ('(', ')')].into_iter().find_map(bracket)?.1.parse().ok()
}

fn side_name(side: &SideCheck) -> &'static str {
    if side.sign > 0.0 { "u > 0" } else { "u < 0" }
}

/// A name, a unit, and the number of a side.
type Line = (&'static str, &'static str, fn(&SideCheck) -> f64);

fn table(title: &str, source: &Source, arguments: &Arguments, sides: &[SideCheck]) -> String {
    let mut text = format!("{title}\n");
    let _ = writeln!(text, "demand   {}, {} % damping", source.name, 100.0 * source.damping);
    let _ = writeln!(
        text,
        "fractions: d_u* at {} of the zero of F, secant at {} of d_u*\n",
        arguments.displacement_fraction, arguments.secant_fraction
    );
    let _ = writeln!(
        text,
        "{:<22}{:>6}{}",
        "",
        "",
        sides.iter().fold(String::new(), |names, side| { names + &format!("{:>13} ", side_name(side)) })
    );
    let rows: [Line; 10] = [
        ("onset a0*", "m/s2", |side| side.onset_acceleration),
        ("zero of F d0*", "m", |side| side.zero_displacement),
        ("capacity d_u*", "m", |side| side.displacement_capacity),
        ("secant d_s*", "m", |side| side.secant[0]),
        ("secant a_s*", "m/s2", |side| side.secant[1]),
        ("secant period T_s", "s", |side| side.secant_period),
        ("demand Sa(0)", "m/s2", |side| side.peak_acceleration),
        ("demand Sd(T_s)", "m", |side| side.displacement_demand),
        ("a0*/Sa(0)", "-", |side| side.acceleration_ratio),
        ("d_u*/Sd(T_s)", "-", |side| side.displacement_ratio),
    ];
    for (name, unit, value) in rows {
        let values: Vec<_> = sides.iter().map(|side| significant(value(side))).collect();
        let _ = writeln!(text, "{name:<22}{unit:>6}{}", values.join(" "));
    }
    let worst = governing(sides);
    let _ = writeln!(text, "\n{} governs with {}", side_name(worst), significant(worst.ratio()).trim());
    for side in sides.iter().filter(|side| side.limited_by_tie) {
        let _ = writeln!(text, "{}: the strength of the tie limits d_u*", side_name(side));
    }
    text
}

fn json(title: &str, source: &Source, arguments: &Arguments, sides: &[SideCheck]) -> Value {
    let side = |side: &SideCheck| {
        json!({
            "side": side_name(side),
            "onset_acceleration": side.onset_acceleration,
            "zero_displacement": side.zero_displacement,
            "displacement_capacity": side.displacement_capacity,
            "limited_by_tie": side.limited_by_tie,
            "secant_displacement": side.secant[0],
            "secant_acceleration": side.secant[1],
            "secant_period": side.secant_period,
            "peak_acceleration": side.peak_acceleration,
            "displacement_demand": side.displacement_demand,
            "acceleration_ratio": side.acceleration_ratio,
            "displacement_ratio": side.displacement_ratio,
        })
    };
    json!({
        "title": title,
        "demand": source.name,
        "damping": source.damping,
        "displacement_fraction": arguments.displacement_fraction,
        "secant_fraction": arguments.secant_fraction,
        "sides": sides.iter().map(side).collect::<Vec<_>>(),
        "governing": side_name(governing(sides)),
    })
}
