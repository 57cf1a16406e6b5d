//! The tables of a study, wall by wall.

use std::io::{self, Write};

use ground_motion::STANDARD_GRAVITY;
use study::fragility::{FitError, Interval, Lognormal};
use study::ida::Exceedance;
use study::results::WallResults;

use crate::contents::{Contents, Manifest};
use crate::csv::{self, quoted};

/// Most combinations of a study whose runs and collapses are written as CSV too: the parts hold them.
const MOST_CASES: usize = 10_000;

/// A table: its file, its header, and what writes the rows of a wall.
pub(crate) struct Table {
    pub(crate) name: &'static str,
    pub(crate) header: &'static str,
    pub(crate) rows: fn(&mut dyn Write, &Manifest, usize, &WallResults) -> io::Result<()>,
}

const LEVELS: Table = Table {
    name: "levels.csv",
    header: "wall,model,record,intensity_g,u_max_over_u_ins,overturned,overturn_time_s",
    rows: levels,
};
const COLLAPSES: Table = Table {
    name: "collapses.csv",
    header: "wall,model,record,collapse_g,standing_below_g,highest_level_g,runs,resurrections",
    rows: collapses,
};
const FRAGILITIES: Table = Table {
    name: "fragilities.csv",
    header: "wall,model,u_max_over_u_ins,records,censored,median_g,median_low_g,median_high_g,theta_g,\
             theta_low_g,theta_high_g,beta,beta_alone,median_ratio,median_ratio_low,median_ratio_high,\
             theta_ratio,theta_ratio_low,theta_ratio_high",
    rows: fragilities,
};

/// Returns the tables of a study.
pub(crate) fn tables(contents: &Contents) -> Vec<Table> {
    if contents.count() <= MOST_CASES { vec![LEVELS, COLLAPSES, FRAGILITIES] } else { vec![FRAGILITIES] }
}

/// Returns the names of a combination, for the first columns of a table.
fn names(contents: &Contents, wall: usize, curve: usize) -> String {
    let (model, record) = (curve / contents.records.len(), curve % contents.records.len());
    format!(
        "{},{},{}",
        quoted(&contents.walls[wall].name),
        quoted(&contents.models[model].name),
        quoted(&contents.records[record].name)
    )
}

/// Every run.
fn levels(out: &mut dyn Write, manifest: &Manifest, wall: usize, results: &WallResults) -> io::Result<()> {
    for (index, curve) in results.all_curves().iter().enumerate() {
        let names = names(&manifest.contents, wall, index);
        for run in curve.runs() {
            let time = run.overturning.map_or_else(String::new, |time| time.to_string());
            let overturned = u8::from(run.overturning.is_some());
            writeln!(out, "{names},{},{},{overturned},{time}", in_g(run.intensity), run.demand)?;
        }
    }
    Ok(())
}

/// The collapse with every model and record.
fn collapses(out: &mut dyn Write, manifest: &Manifest, wall: usize, results: &WallResults) -> io::Result<()> {
    for (index, curve) in results.all_curves().iter().enumerate() {
        let collapse = match curve.collapse() {
            Exceedance::At(intensity) => in_g(intensity).to_string(),
            Exceedance::Above(_) => String::new(),
        };
        writeln!(
            out,
            "{},{collapse},{},{},{},{}",
            names(&manifest.contents, wall, index),
            in_g(curve.level_below_collapse()),
            in_g(curve.top()),
            curve.runs().len(),
            curve.resurrections()
        )?;
    }
    Ok(())
}

/// The fragilities of every model and fraction.
fn fragilities(
    out: &mut dyn Write,
    manifest: &Manifest,
    wall: usize,
    results: &WallResults,
) -> io::Result<()> {
    // nothing for what is not known
    let interval = |interval: &Interval, unit: f64| interval.texts(unit, None).join(",").replace('–', "");
    let beta = |fit: Result<Lognormal, FitError>| csv::optional(fit.ok().map(|fit| fit.dispersion));
    for (m, model) in manifest.contents.models.iter().enumerate() {
        for (f, fraction) in manifest.report.fractions.iter().enumerate() {
            let summary = &results.summaries(f)[m];
            writeln!(
                out,
                "{},{},{fraction},{},{},{},{},{},{},{},{}",
                quoted(&manifest.contents.walls[wall].name),
                quoted(&model.name),
                summary.records,
                summary.censored,
                interval(&summary.median, STANDARD_GRAVITY),
                interval(&summary.theta, STANDARD_GRAVITY),
                beta(summary.fitted),
                beta(summary.alone),
                interval(&summary.median_ratio, 1.0),
                interval(&summary.theta_ratio, 1.0)
            )?;
        }
    }
    Ok(())
}

/// Returns an acceleration in g.
pub(crate) fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}
