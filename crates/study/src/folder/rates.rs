//! Annual rates of the limit states of walls and classes: `rates.csv`, `rate_shares.csv`, and what the page
//! and the terminal show of them.

use std::fmt::Write as _;
use std::path::Path;

use fragility::hazard::{AgainstTarget, Hazard, Rate, probability};
use fragility::{CONFIDENCE, Interval};
use report::escaped;
use report::table::{Column, Digits, Table};

use crate::ida::IntensityUnit;

use super::contents::Manifest;
use super::error::FolderError;
use super::finished::Finished;
use super::rows::Rows;
use super::shown::Shown;
use super::subject::{Fragilities, State, Subject};
use super::tables::OF_INTENSITY;

/// Part of the rates that may lie beyond the last point without a word.
const MOST_BEYOND: f64 = 0.05;
/// Part by which the rate of a class may differ from the mean of its walls' rates without a word.
const MOST_APART: f64 = 0.1;

/// The files under construction.
pub(crate) struct Rates<'a> {
    manifest: &'a Manifest,
    hazard: &'a Hazard,
    files: [Rows; 2],
    /// Rates, and plots of the last limit state.
    shown: Shown<'a>,
    /// Number of rates, and of those of which much lies beyond the last point.
    beyond: [usize; 2],
    /// Number of rates of classes, and of those that are not about the mean of their walls' rates.
    apart: [usize; 2],
}

/// A row: limit state, curve and rate.
struct Row {
    model: usize,
    fraction: f64,
    curve: [f64; 2],
    rate: Rate,
    interval: [f64; 2],
    /// The least and the most of the rate, with the interval and with what lies outside the hazard curve.
    ends: [f64; 2],
    resamples: usize,
    /// Of a class, the mean of its walls' rates.
    of_walls: Option<f64>,
}

impl<'a> Rates<'a> {
    /// Begins the files in a folder.
    pub(crate) fn new(
        folder: &Path,
        manifest: &'a Manifest,
        hazard: &'a Hazard,
    ) -> Result<Self, FolderError> {
        let files = [Rows::new(&folder.join("rates.csv"))?, Rows::new(&folder.join("rate_shares.csv"))?];
        let shown = Shown::new(manifest, "share of the rate up to there");
        Ok(Self { manifest, hazard, files, shown, beyond: [0; 2], apart: [0; 2] })
    }

    /// Adds a wall or a class.
    pub(crate) fn add(&mut self, subject: &Subject<'_>) -> Result<(), FolderError> {
        let (hazard, contents) = (self.hazard, &self.manifest.contents);
        let rows = subject.models.iter().enumerate().flat_map(|(model, one)| {
            let row = move |place| Row::of(hazard, model, one, place);
            (0..one.states.len()).filter_map(row)
        });
        let rows: Vec<Row> = rows.collect();
        for Row { rate, of_walls, .. } in &rows {
            self.beyond[0] += 1;
            self.beyond[1] += usize::from(rate.beyond[1] > MOST_BEYOND * rate.within());
            self.apart[0] += usize::from(of_walls.is_some());
            let is_apart = |mean: f64| (rate.within() - mean).abs() > MOST_APART * mean;
            self.apart[1] += usize::from(of_walls.is_some_and(is_apart));
        }
        let table = rates(self.manifest, hazard, subject, &rows);
        self.files[0].add(&table)?;
        self.files[1].add(&shares(self.manifest, hazard, subject, &rows))?;
        if subject.is_shown(self.manifest) {
            let of_model = |model: usize| {
                let last = rows.iter().rfind(|row| row.model == model);
                last.map_or_else(Vec::new, |row| cumulated(hazard, contents.unit, &row.rate))
            };
            let lines = (0..contents.models.len()).map(of_model).collect();
            self.shown.add(subject, table, self.ends(), lines);
        }
        Ok(())
    }

    /// The first and the last intensity of the hazard curve, in the unit of results.
    fn ends(&self) -> [f64; 2] {
        let points = self.hazard.curve.points();
        [points[0][0], points[points.len() - 1][0]].map(|x| self.manifest.contents.unit.of(x))
    }

    /// Says how many rates may lie beyond the hazard curve for a good part, and how many classes are not
    /// lognormal.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let ([all, much], [_, last]) = (self.beyond, self.ends());
        let beyond = (much > 0).then(|| {
            format!(
                "{much} of {all} rates may have more than {:.0} % beyond the last point of the hazard curve, \
                 at {} {}; give points of higher intensities",
                100.0 * MOST_BEYOND,
                OF_INTENSITY.of(last),
                self.manifest.contents.unit.name()
            )
        });
        let [classes, apart] = self.apart;
        let apart = (apart > 0).then(|| {
            format!(
                "{apart} of {classes} rates of classes differ by more than {:.0} % from the mean of their \
                 walls' rates, as walls that differ have together no lognormal curve; annual_rate_of_walls \
                 in rates.csv is that mean, the rate of the class",
                100.0 * MOST_APART
            )
        });
        beyond.into_iter().chain(apart).collect()
    }

    /// Completes the files.
    pub(crate) fn finish(mut self) -> Result<Finished, FolderError> {
        let (contents, [from, to]) = (&self.manifest.contents, self.ends().map(|x| OF_INTENSITY.of(x)));
        let mut words = format!(
            "annual rates from {} of {from} to {to} {}, {:.0} % intervals of the records, studentised; \
             \"at most\" adds what may lie outside",
            contents.measure,
            contents.unit.name(),
            100.0 * CONFIDENCE
        );
        if let Some(target) = self.hazard.target {
            let _ = write!(words, "; target {target:e} a year");
        }
        let warnings = self.warnings().iter().fold(String::new(), |all, one| all + " " + &escaped(one) + ".");
        let table = self.shown.table();
        let html = format!(
            "<section><h2>Annual rates</h2><p class=\"subtitle\">{}.{warnings}</p>{}\
             <h3>Share of the rate of the last limit state, by intensity</h3>{}</section>\n",
            escaped(&words),
            table.html(),
            self.shown.plots()
        );
        let files = self.files.into_iter().map(Rows::commit).collect::<Result<_, _>>()?;
        Ok(Finished { files, words: format!("{words}\n{}", table.text()), html })
    }
}

impl Row {
    /// Takes a limit state, given by its place; `None` without a curve.
    fn of(hazard: &Hazard, model: usize, all: &Fragilities, place: usize) -> Option<Self> {
        let State { fraction, curve, resamples, .. } = &all.states[place];
        let curve = (*curve)?;
        let of_walls = all.mean_of_walls(place, |theta, beta| hazard.curve.rate(theta, beta).within());
        let rate = hazard.curve.rate(curve[0], curve[1]);
        let known = resamples.iter().filter(|pair| pair.iter().all(|value| value.is_finite()));
        let rates: Vec<Rate> = known.map(|[theta, beta]| hazard.curve.rate(*theta, *beta)).collect();
        let range = |of: fn(&Rate) -> f64| Interval::new(of(&rate), rates.iter().map(of), CONFIDENCE).range;
        let interval = range(Rate::within);
        // without resamples nothing is known
        let [[least, _], [_, most]] = [range(Rate::least), range(Rate::most)];
        let ends =
            if least.is_nan() { [least, most] } else { [least.min(rate.least()), most.max(rate.most())] };
        let resamples = rates.len();
        Some(Self { model, fraction: *fraction, curve, rate, interval, ends, resamples, of_walls })
    }
}

/// The rates, for files in every digit.
fn rates(manifest: &Manifest, hazard: &Hazard, subject: &Subject<'_>, rows: &[Row]) -> Table {
    let (unit, years) = (manifest.contents.unit, hazard.years);
    let (two, three) = (Digits::Exponent(2), Digits::Significant(3));
    let percent = format!("P in {years} years\n[%]");
    let finite = |rate: f64| Some(rate).filter(|rate| rate.is_finite());
    Table::over(rows)
        .text("", "kind", |_| if subject.class.is_some() { "class" } else { "wall" })
        .text("wall", "wall or class", |_| subject.name.to_owned())
        .text("model", "model", |row| manifest.contents.models[row.model].name.clone())
        .number("u_max_over_u_ins", "u_max/u_ins", Digits::AtMost(6), |row| row.fraction)
        .value(format!("theta{}", unit.ending()), |row| unit.of(row.curve[0]))
        .value("beta", |row| row.curve[1])
        .number("annual_rate", "rate\n[1/year]", two, |row| row.rate.within())
        .value("annual_rate_low", |row| finite(row.interval[0]))
        .value("annual_rate_high", |row| finite(row.interval[1]))
        .number("", "interval", two, |row| between(row.interval))
        .value("resamples", |row| row.resamples)
        .value("below_first_point", |row| row.rate.below)
        .value("beyond_last_point_least", |row| row.rate.beyond[0])
        .value("beyond_last_point_continued", |row| row.rate.beyond_continued)
        .value("beyond_last_point_most", |row| row.rate.beyond[1])
        .number("annual_rate_most", "at most", two, |row| row.rate.most())
        .value("annual_rate_of_walls", |row| row.of_walls)
        .number("return_period_years", "return period\n[years]", three, |row| 1.0 / row.rate.within())
        .value("return_period_years_least", |row| 1.0 / row.rate.most())
        .value("years", |_| years)
        .column(Column::number("probability", percent, three).shown(100.0), |row| {
            probability(row.rate.within(), years)
        })
        .value("probability_most", |row| probability(row.rate.most(), years))
        .value("target", |_| hazard.target)
        .text("target_met", if hazard.target.is_some() { "target met" } else { "" }, |row| {
            hazard.target.map_or("", |target| AgainstTarget::of(row.ends, target).word())
        })
        .done()
}

/// The parts of the rates by the segments of the hazard curve.
fn shares(manifest: &Manifest, hazard: &Hazard, subject: &Subject<'_>, rows: &[Row]) -> Table {
    let unit = manifest.contents.unit;
    let segments = rows.iter().flat_map(|row| {
        let parts = row.rate.segments.iter().zip(row.rate.shares());
        parts.zip(hazard.curve.points().windows(2)).map(move |(part, ends)| (row, part, ends))
    });
    Table::over(segments)
        .text("wall", "", |_| subject.name.to_owned())
        .text("model", "", |(row, ..)| manifest.contents.models[row.model].name.clone())
        .value("u_max_over_u_ins", |(row, ..)| row.fraction)
        .value(format!("from{}", unit.ending()), |(.., ends)| unit.of(ends[0][0]))
        .value(format!("to{}", unit.ending()), |(.., ends)| unit.of(ends[1][0]))
        .value("annual_rate", |(_, part, _)| *part.0)
        .value("share", |(_, part, _)| Some(part.1).filter(|share| share.is_finite()))
        .done()
}

/// Writes an interval; a dash where it is not known.
pub(super) fn between([low, high]: [f64; 2]) -> String {
    if low.is_finite() && high.is_finite() { format!("{low:.2e} … {high:.2e}") } else { "-".to_owned() }
}

/// The part of the rate from intensities up to each point, these in a unit.
fn cumulated(hazard: &Hazard, unit: IntensityUnit, rate: &Rate) -> Vec<(f64, f64)> {
    let mut sum = 0.0;
    let mut line = vec![(unit.of(hazard.curve.points()[0][0]), 0.0)];
    for (share, point) in rate.shares().into_iter().zip(&hazard.curve.points()[1..]) {
        sum += share;
        line.push((unit.of(point[0]), if sum.is_finite() { sum } else { 0.0 }));
    }
    line
}
