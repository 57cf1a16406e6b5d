//! `wall study tie`: demands on a tie and displacement of the wall over a parameter of the tie.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use anyhow::{Context as _, Result};
use check::{AtLevel, CheckFile, at_level, read};
use clap::Args;
use ground_motion::{RecordOptions, Unit};
use report::{counted, number};
use rocking_wall::variables::TieSide;
use rocking_wall::wall::Parameters;
use run::parallel;
use run::polarity::Polarities;
use run::records::NamedRecord;
use scene::Scene;
use serde_json::json;
use study::tie::figure::picture;
use study::tie::{BAR_DIAMETER, HEIGHT, SLACK, STIFFNESS, STRENGTH, TieStudy, ULTIMATE, Varied, table};

use crate::args::{SceneArguments, apply_set, read_record, short_name, svg_file};
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
    /// Bring the records to the level of a limit state of the table [check], as its dynamic check does: SLD,
    /// SLV or SLC; without --records those of [check.records]
    #[arg(long, value_name = "LIMIT_STATE", requires = "scene", conflicts_with = "scale")]
    #[arg(value_parser = ["SLD", "SLV", "SLC"])]
    level: Option<String>,
    /// Stiffnesses in N/m, separated by commas, from 0 for no tie [default: 0, and 1e-2 to 1e3 of
    /// 2 W/h at the tie]
    #[arg(long, value_name = "N_PER_M", value_delimiter = ',', group = "varied")]
    stiffness: Vec<f64>,
    /// Strengths in N instead, 0 for none
    #[arg(long, value_name = "N", value_delimiter = ',', group = "varied")]
    strength: Vec<f64>,
    /// Slacks in m instead
    #[arg(long, value_name = "M", value_delimiter = ',', group = "varied")]
    slack: Vec<f64>,
    /// Heights of the tie in m instead
    #[arg(long, value_name = "M", value_delimiter = ',', group = "varied")]
    height: Vec<f64>,
    /// Plastic elongations in m at which the tie breaks instead, -1 for one that stays elastic
    #[arg(long, value_name = "M", value_delimiter = ',', group = "varied", allow_negative_numbers = true)]
    ultimate: Vec<f64>,
    /// Diameters in m of the bar that the scene has instead
    #[arg(long, value_name = "M", value_delimiter = ',', group = "varied")]
    bar_diameter: Vec<f64>,
    /// Number of threads [default: one for each core]
    #[arg(long)]
    threads: Option<NonZeroUsize>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the table as CSV
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw demands and displacement over what is varied, as SVG
    #[arg(long, value_name = "FILE", value_parser = svg_file())]
    plot: Option<PathBuf>,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let mut scene = arguments.scene.load(console)?;
    apply_set(&arguments.scene.set, &mut scene)?;
    let inputs = arguments.scene.inputs(&scene).chain(&arguments.records);
    console.check_distinct(inputs, arguments.csv.iter().chain(&arguments.plot))?;
    let named = records(console, arguments)?;
    let AtLevel { scene, motions, factors, both_signs, .. } = if let Some(state) = &arguments.level {
        of_check(console, arguments, &scene, named, state)?
    } else {
        AtLevel::as_given(scene, named.into_iter().map(|record| record.motion).collect())
    };
    let (varied, values) = varied(arguments);
    let both_polarities = arguments.both_polarities || both_signs;
    let study = TieStudy::new(scene, varied, values, motions, both_polarities);
    let study = arguments.scene.named(study)?;
    let rows = study.rows(parallel::threads(arguments.threads).get())?;
    console.save(arguments.plot.as_ref(), || picture(&study, &rows))?;
    let table = table(&study, &rows);
    console.save(arguments.csv.as_ref(), || table.csv())?;
    let Parameters { tie_height, tie_side, .. } = study.scene().parameters;
    let title = &study.scene().title;
    if arguments.json {
        return console.json(&json!({
            "title": title,
            "tie_height": (*study.varied() != HEIGHT).then_some(tie_height),
            "tie_side": tie_side.name(),
            "motions": study.motions(),
            "level": arguments.level,
            "factors": factors,
            "alike_on_both_sides": study.polarities() == Polarities::Alike,
            "rows": table.json(),
        }));
    }
    let side = match tie_side {
        TieSide::Positive => "u > 0",
        TieSide::Negative => "u < 0",
        TieSide::Both => "both sides",
    };
    let (motions, note) = (counted(study.motions(), "motion"), study.polarities().note());
    let written = output::written("\nwritten ", arguments.csv.iter().chain(&arguments.plot));
    let place = if *study.varied() == HEIGHT { String::new() } else { format!(" at {tie_height} m") };
    let table = table.text();
    let level = arguments.level.as_ref().map_or_else(String::new, |state| {
        let [least, largest] = [f64::min, f64::max].map(|of| factors.iter().copied().reduce(of));
        let ends = [least, largest].map(|end| number(end.unwrap_or(f64::NAN), 3));
        format!(" at {state} (factors {} to {})", ends[0], ends[1])
    });
    console.print(&format!("{title}, tie{place} against {side}, {motions}{level}\n\n{table}{note}{written}"))
}

/// The wall and its records at the level of a limit state of the check in the scene's file.
fn of_check(
    console: &Console<'_>,
    arguments: &Arguments,
    scene: &Scene,
    named: Vec<NamedRecord>,
    state: &str,
) -> Result<AtLevel> {
    let path = arguments.scene.scene.as_ref().context("--level needs a scene with a table [check]")?;
    let (name, text) = (path.display().to_string(), Scene::text(path)?);
    let file = CheckFile::parse(&name, &text)?.with_records(named);
    let code = read(&file).map_err(|error| file.located(error))?;
    let assumed = file.assumed(&arguments.scene.set);
    let found = at_level(&*code, scene, &assumed, state).map_err(|error| file.located(error))?;
    console.warn(&found.warnings);
    Ok(found)
}

/// What is varied, and its values.
fn varied(arguments: &Arguments) -> (&'static Varied, &[f64]) {
    let Arguments { stiffness, strength, slack, height, ultimate, bar_diameter, .. } = arguments;
    let others: [(_, &[f64]); 5] = [
        (&STRENGTH, strength),
        (&SLACK, slack),
        (&HEIGHT, height),
        (&ULTIMATE, ultimate),
        (&BAR_DIAMETER, bar_diameter),
    ];
    others.into_iter().find(|(_, values)| !values.is_empty()).unwrap_or((&STIFFNESS, stiffness))
}

/// The records asked for, scaled.
fn records(console: &Console<'_>, arguments: &Arguments) -> Result<Vec<NamedRecord>> {
    let unit = arguments.unit.as_deref().map(str::parse::<Unit>).transpose()?;
    let options = RecordOptions { unit, ..RecordOptions::default() };
    let mut motions = Vec::new();
    for path in &arguments.records {
        let motion = read_record(console, path, &options)?.motion.checked_scaled(arguments.scale)?;
        // at a scale of 1 the reader has already warned
        let warning = motion.warning().filter(|_| arguments.scale.abs() > 1.0);
        console.warn(warning.map(|warning| format!("{}: {warning}", path.display())));
        motions.push(NamedRecord::new(short_name(path), motion));
    }
    Ok(motions)
}
