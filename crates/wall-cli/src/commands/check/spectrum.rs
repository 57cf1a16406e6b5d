//! `wall check` without a table `[check]`: capacity against demand, from a wall's own capacity curve.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use check::circolare::Side;
use check::points::over_demand;
use check::points::{CapacityOverDemand, CheckError, Demand, Fractions, SideCheck, check, governing};
use clap::Args;
use ground_motion::spectrum::DAMPING;
use ground_motion::{RecordOptions, SpectrumFile, Unit};
use report::escaped;
use report::plot::Plot;
use rocking_wall::scene::Floors;
use rocking_wall::wall::Wall;
use serde_json::{Value, json};

use crate::args::{read_records, record_files, refuse};
use crate::output::significant;
use crate::output::{self, Console};
use report::template;

#[derive(Debug, Args)]
pub(super) struct SpectrumArguments {
    /// Demand: a response spectrum as CSV or text, T in s and Sa, from T = 0 on; of the ground or of a floor
    #[arg(long, value_name = "FILE", conflicts_with = "records")]
    spectrum: Option<PathBuf>,
    /// Demand: the median spectrum of these records, or of those in a folder; felt on the floor of a scene
    /// with storeys
    #[arg(long, value_name = "FILE", num_args = 1..)]
    records: Vec<PathBuf>,
    /// Unit of a spectrum or of records that do not state theirs: m/s2, cm/s2, mm/s2 or g
    #[arg(long)]
    unit: Option<String>,
    /// Name of the column with Sa, for a spectrum with several
    #[arg(long, value_name = "NAME", requires = "spectrum")]
    column: Option<String>,
    /// Damping ratio of the spectrum [default: that of the column's name, `Sa (5 %)`, or 0.05]
    #[arg(long, value_name = "RATIO")]
    damping: Option<f64>,
    /// Displacement capacity over the displacement at which the force of the wall vanishes [default: 0.4]
    #[arg(long, value_name = "FRACTION")]
    displacement_fraction: Option<f64>,
    /// Displacement of the secant period over the displacement capacity [default: 0.4]
    #[arg(long, value_name = "FRACTION")]
    secant_fraction: Option<f64>,
}

impl SpectrumArguments {
    /// Refuses these options beside a table `[check]`, which has its own.
    pub(super) fn refuse(&self, name: &str) -> Result<()> {
        let given = [
            ("--spectrum", self.spectrum.is_some()),
            ("--records", !self.records.is_empty()),
            ("--unit", self.unit.is_some()),
            ("--column", self.column.is_some()),
            ("--damping", self.damping.is_some()),
            ("--displacement-fraction", self.displacement_fraction.is_some()),
            ("--secant-fraction", self.secant_fraction.is_some()),
        ];
        let why = "is for a scene without a table [check]; leave it out";
        refuse(given, why).with_context(|| name.to_owned())
    }

    fn fractions(&self) -> Fractions {
        let Fractions { displacement, secant } = Fractions::default();
        Fractions {
            displacement: self.displacement_fraction.unwrap_or(displacement),
            secant: self.secant_fraction.unwrap_or(secant),
        }
    }
}

pub(super) fn run(console: &Console<'_>, all: &super::Arguments) -> Result<()> {
    let arguments = &all.spectrum;
    if arguments.spectrum.is_none() && arguments.records.is_empty() {
        bail!(
            "there is no demand; give the scene a table [check] with code = \"circolare-2019\", or give \
             --spectrum or --records"
        );
    }
    let mut scene = all.scene.load_unshaken()?;
    all.scene.apply(&mut scene)?;
    let records = record_files(&arguments.records)?;
    let inputs = all.scene.inputs(&scene).chain(&arguments.spectrum).chain(&records);
    console.check_distinct(inputs, &all.html)?;
    let wall = all.scene.named(Wall::new(&scene.parameters))?;
    let source = Source::read(console, arguments, scene.floors.as_ref(), &wall)?;
    let sides = check(&wall, arguments.fractions(), |period| source.demand.at(period))?;
    let alike = wall.has_equal_sides();
    if let Some(path) = &all.html {
        let table = escaped(&table(&scene.title, &source, arguments, &sides, alike));
        let wide = over_demand(&CapacityOverDemand::new(&wall, &source.demand, &sides)?);
        // on a narrow screen the legend would hide the curves
        let mut narrow = Plot { size: [390.0, 330.0], ..wide.clone() };
        narrow.series.iter_mut().for_each(|series| series.name.clear());
        let [wide, narrow] = [wide.svg(), narrow.svg()];
        let title = format!("{}: capacity against demand", escaped(&scene.title));
        let parts = [("title", &*title), ("wide", &wide), ("narrow", &narrow), ("table", &table)];
        console.write(
            path,
            template::page(include_str!("../../../../check/src/points.html"), &parts).as_bytes(),
        )?;
    }
    let text = if all.json {
        serde_json::to_string_pretty(&json(&scene.title, &source, arguments, &sides))? + "\n"
    } else {
        table(&scene.title, &source, arguments, &sides, alike) + &output::written("\nwritten  ", &all.html)
    };
    console.print(&text)
}

/// Where the demand comes from.
struct Source {
    name: String,
    damping: f64,
    demand: Demand,
}

impl Source {
    fn read(
        console: &Console<'_>,
        arguments: &SpectrumArguments,
        floors: Option<&Floors>,
        wall: &Wall,
    ) -> Result<Self> {
        let unit = arguments.unit.as_deref().map(str::parse::<Unit>).transpose()?;
        if let Some(path) = &arguments.spectrum {
            if floors.is_some() {
                console.warn(
                    "the storeys are not applied to --spectrum; it must be the spectrum of the wall's floor",
                );
            }
            let file = SpectrumFile::read(path, unit, arguments.column.as_deref())?;
            if let Some(warning) = file.warning() {
                console.warn(&format!("{}: {warning}", path.display()));
            }
            let damping = match (arguments.damping, file.damping) {
                // a file may round it: 0.9 % for 0.0087
                (Some(given), Some(stated)) if (given - stated).abs() > 0.05 * stated => bail!(
                    "{}: expected the damping ratio that the column of Sa states, {stated}, found --damping \
                     {given}; leave out --damping, or use the spectrum of that damping",
                    path.display()
                ),
                (given, stated) => given.or(stated).unwrap_or(DAMPING),
            };
            let (note, demand) = points(path, file)?;
            return Ok(Self { name: format!("{}, {note}", path.display()), damping, demand });
        }
        let damping = arguments.damping.unwrap_or(DAMPING);
        let options = RecordOptions { unit, ..RecordOptions::default() };
        let records = read_records(console, &arguments.records, &options)?;
        let motions: Vec<_> = records.into_iter().map(|record| record.motion).collect();
        let count = motions.len();
        let mut name = format!("median of {count} record{}", if count == 1 { "" } else { "s" });
        if let Some(floors) = floors {
            floors.warnings(wall).for_each(|warning| console.warn(&warning));
            let _ = write!(name, " {}", floors.note());
        }
        Ok(Self { name, damping, demand: Demand::of_records(motions, floors, wall, damping)? })
    }
}

/// Makes a note on the column and unit of a spectrum, and the demand.
fn points(path: &Path, file: SpectrumFile) -> Result<(String, Demand)> {
    let SpectrumFile { points, lines, unit, column, .. } = file;
    let demand = Demand::of_points(points).map_err(|error| match error {
        CheckError::Point { number, expected, found } => {
            anyhow!("{}, line {}: expected {expected}, found {found}", path.display(), lines[number - 1])
        }
        other => anyhow!("{}: {other}", path.display()),
    })?;
    let column = column.map_or_else(String::new, |column| format!("column {column}, "));
    Ok((format!("{column}Sa in {unit}"), demand))
}

fn side_name(side: &SideCheck) -> &'static str {
    Side::of(side.sign).name()
}

/// A name, a unit, and the number of a side.
type Line = (&'static str, &'static str, fn(&SideCheck) -> f64);

fn table(
    title: &str,
    source: &Source,
    arguments: &SpectrumArguments,
    sides: &[SideCheck],
    alike: bool,
) -> String {
    let shown = if alike { &sides[..1] } else { sides };
    let name = |side: &SideCheck| if alike { "both sides" } else { side_name(side) };
    let mut text = format!("{title}\n");
    let _ = writeln!(text, "demand   {}, {} % damping", source.name, 100.0 * source.damping);
    let Fractions { displacement, secant } = arguments.fractions();
    let _ =
        writeln!(text, "fractions: d_u* at {displacement} of the zero of F, secant at {secant} of d_u*\n");
    let heads = shown.iter().fold(String::new(), |names, side| names + &format!("{:>13} ", name(side)));
    let _ = writeln!(text, "{:<22}{:>6}{heads}", "", "");
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
        let values: Vec<_> = shown.iter().map(|side| significant(value(side))).collect();
        let _ = writeln!(text, "{name:<22}{unit:>6}{}", values.join(" "));
    }
    text.push('\n');
    for (what, ratio, [holds, fails]) in VERDICTS {
        let worst = governing(sides, ratio);
        let side = if alike { "both sides alike" } else { side_name(worst) };
        let verdict = if ratio(worst) >= 1.0 { holds } else { fails };
        let _ = writeln!(text, "{what}: {verdict}, ratio {} ({side})", significant(ratio(worst)).trim());
    }
    for side in shown.iter().filter(|side| side.limited_by_tie) {
        let _ = writeln!(text, "{}: the strength of the tie limits d_u*", name(side));
    }
    text
}

/// A name, its ratio, and what it says.
type Named = (&'static str, fn(&SideCheck) -> f64, [&'static str; 2]);

/// Both verdicts: they mean different things, and neither stands for the other.
const VERDICTS: [Named; 2] = [
    ("onset", |side| side.acceleration_ratio, ["the wall does not rock", "the wall rocks"]),
    ("displacement", |side| side.displacement_ratio, ["within the capacity", "beyond the capacity"]),
];

fn json(title: &str, source: &Source, arguments: &SpectrumArguments, sides: &[SideCheck]) -> Value {
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
    let governs = VERDICTS.map(|(name, ratio, _)| {
        let worst = governing(sides, ratio);
        (name.to_owned(), json!({ "side": side_name(worst), "ratio": ratio(worst) }))
    });
    let Fractions { displacement, secant } = arguments.fractions();
    json!({
        "title": title,
        "demand": source.name,
        "damping": source.damping,
        "displacement_fraction": displacement,
        "secant_fraction": secant,
        "sides": sides.iter().map(side).collect::<Vec<_>>(),
        "governs": governs.into_iter().collect::<serde_json::Map<_, _>>(),
    })
}
