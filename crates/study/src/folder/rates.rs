//! Annual rates of the limit states of walls and classes: `rates.csv`, `rate_shares.csv`, and what the page
//! and the terminal show of them.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::fragility::{CONFIDENCE, Interval};
use crate::hazard::{Hazard, Rate, probability};
use crate::ida::IntensityUnit;
use crate::tables::OF_INTENSITY;
use report::escaped;
use report::many_lines::ManyLines;
use report::table::{Column, Digits, Table};
use run::file;

use super::contents::Manifest;
use super::error::FolderError;
use super::legend::looks;
use super::nrml::limit_states;
use super::plots::SIZE;
use super::report::MOST_WALLS;
use super::rows::Rows;

/// Names of the files.
const FILES: [&str; 2] = ["rates.csv", "rate_shares.csv"];
/// Most plots of shares.
const MOST_PLOTS: usize = 12;
/// Part of the rates that may lie beyond the last point without a word.
const MOST_BEYOND: f64 = 0.05;

/// A limit state of a wall or class with one model: θ in SI units and β with all its parts, and those of each
/// resample.
pub(crate) struct Fitted {
    pub(crate) curve: Option<[f64; 2]>,
    pub(crate) resamples: Vec<[f64; 2]>,
}

/// The files under construction.
pub(crate) struct Rates<'a> {
    manifest: &'a Manifest,
    hazard: &'a Hazard,
    files: [Rows; 2],
    /// Rows of the walls and of the classes that are shown.
    shown: Option<Table>,
    /// Plots of the last limit state, by names.
    plots: Vec<(String, String)>,
    /// Lines of the plot under construction, one for each model.
    lines: Vec<(usize, Vec<[f64; 2]>)>,
    /// Number of rates, and of those of which much lies beyond the last point.
    beyond: [usize; 2],
}

/// A row: limit state, curve and rate.
struct Row {
    fraction: f64,
    curve: [f64; 2],
    rate: Rate,
    interval: [f64; 2],
    resamples: usize,
}

impl<'a> Rates<'a> {
    /// Begins the files in a folder; `None` for a study without a hazard.
    pub(crate) fn new(folder: &Path, manifest: &'a Manifest) -> Result<Option<Self>, FolderError> {
        let paths = FILES.map(|name| folder.join(name));
        let Some(hazard) = &manifest.report.hazard else {
            // those that an earlier study has left
            paths.iter().try_for_each(|path| file::remove(path))?;
            return Ok(None);
        };
        let [rates, shares] = paths.map(|path| Rows::new(&path));
        Ok(Some(Self {
            manifest,
            hazard,
            files: [rates?, shares?],
            shown: None,
            plots: Vec::new(),
            lines: Vec::new(),
            beyond: [0; 2],
        }))
    }

    /// Adds a wall or a class with one model; limit states rise.
    pub(crate) fn add(
        &mut self,
        name: &str,
        is_class: bool,
        model: usize,
        states: &[Fitted],
    ) -> Result<(), FolderError> {
        let (manifest, hazard) = (self.manifest, self.hazard);
        let rows =
            limit_states(&manifest.report).into_iter().zip(states).filter_map(|((place, _), fitted)| {
                let curve = fitted.curve?;
                let rate = hazard.curve.rate(curve[0], curve[1]);
                let resamples =
                    fitted.resamples.iter().filter(|pair| pair.iter().all(|value| value.is_finite()));
                let resamples: Vec<_> =
                    resamples.map(|[theta, beta]| hazard.curve.rate(*theta, *beta).within()).collect();
                let count = resamples.len();
                let interval = Interval::new(rate.within(), resamples, CONFIDENCE).range;
                let fraction = manifest.report.fractions[place];
                Some(Row { fraction, curve, rate, interval, resamples: count })
            });
        let rows: Vec<Row> = rows.collect();
        for Row { rate, .. } in &rows {
            self.beyond[0] += 1;
            self.beyond[1] += usize::from(rate.beyond[1] > MOST_BEYOND * rate.within());
        }
        let model_name = &manifest.contents.models[model].name;
        let (unit, names) = (manifest.contents.unit, [name, model_name]);
        let [of_rates, of_shares] = &mut self.files;
        of_rates.add(&rates(hazard, unit, names, &rows))?;
        of_shares.add(&shares(hazard, unit, names, &rows))?;
        if !is_class && manifest.contents.walls.len() > MOST_WALLS {
            return Ok(());
        }
        let table = shown(hazard, name, model_name, &rows);
        match &mut self.shown {
            // classes come after all walls, and are shown before them
            Some(all) if is_class => {
                let at = all.rows.iter().take_while(|row| row[0] == "class".into()).count();
                all.rows.splice(at..at, with_kind(table, is_class).rows);
            }
            Some(all) => all.rows.extend(with_kind(table, is_class).rows),
            None => self.shown = Some(with_kind(table, is_class)),
        }
        self.draw(name, model, rows.last());
        Ok(())
    }

    /// Adds the shares of the last limit state to the plot of a wall or class.
    fn draw(&mut self, name: &str, model: usize, row: Option<&Row>) {
        let unit = self.manifest.contents.unit;
        self.lines.extend(row.map(|row| (model, cumulated(self.hazard, unit, &row.rate))));
        if model + 1 < self.manifest.contents.models.len() {
            return;
        }
        let points = self.hazard.curve.points();
        let ends = [points[0][0], points[points.len() - 1][0]].map(|x| unit.of(x));
        let mut plot = ManyLines::new(SIZE, ends, [0.0, 1.0]);
        let looks = looks(self.manifest);
        for (model, line) in self.lines.drain(..) {
            plot.line(&line, "fit", looks[model].0);
            plot.marks(&line, looks[model].1, looks[model].0);
        }
        let axis = self.manifest.contents.axis();
        self.plots.push((name.to_owned(), plot.svg([&axis, "share of the rate up to there"])));
    }

    /// Says how many rates may lie beyond the hazard curve for a good part.
    pub(crate) fn warning(&self) -> Option<String> {
        let ([all, much], unit) = (self.beyond, self.manifest.contents.unit);
        let last = self.hazard.curve.points().last().map_or(0.0, |[x, _]| unit.of(*x));
        (much > 0).then(|| {
            format!(
                "{much} of {all} rates may have more than {:.0} % beyond the last point of the hazard curve, \
                 at {} {}; give points of higher intensities",
                100.0 * MOST_BEYOND,
                OF_INTENSITY.of(last),
                unit.name()
            )
        })
    }

    /// Completes the files; returns their paths, what is to be said, and the section of the page.
    pub(crate) fn finish(self) -> Result<(Vec<PathBuf>, String, String), FolderError> {
        let warning = self.warning();
        let Self { manifest, hazard, files, shown, plots, .. } = self;
        let paths = files.into_iter().map(Rows::commit).collect::<Result<_, _>>()?;
        let (points, unit) = (hazard.curve.points(), manifest.contents.unit);
        let [from, to] = [points[0][0], points[points.len() - 1][0]].map(|x| OF_INTENSITY.of(unit.of(x)));
        let mut words = format!(
            "annual rates from {} of {from} to {to} {}, {:.0} % intervals of the records; \"at most\" \
             adds what may lie outside",
            manifest.contents.measure,
            unit.name(),
            100.0 * CONFIDENCE
        );
        if let Some(target) = hazard.target {
            let _ = write!(words, "; target {target:e} a year");
        }
        let (mut told, mut html) = (words.clone() + "\n", String::new());
        let _ = write!(html, "<section><h2>Annual rates</h2><p class=\"subtitle\">{}.", escaped(&words));
        if let Some(table) = shown {
            told.push_str(&table.text());
            if let Some(warning) = warning {
                let _ = write!(html, " {}.", escaped(&warning));
            }
            let _ = write!(html, "</p><div class=\"scroll\">{}</div>", table.html());
        } else {
            html.push_str("</p>");
        }
        html.push_str("<h3>Share of the rate of the last limit state, by intensity</h3><div class=\"row\">");
        // classes come last
        for (name, svg) in plots.iter().rev().take(MOST_PLOTS) {
            let _ = write!(html, "<figure><figcaption>{}</figcaption>{svg}</figure>", escaped(name));
        }
        html.push_str("</div></section>\n");
        Ok((paths, told, html))
    }
}

/// The rates in every digit.
fn rates(hazard: &Hazard, unit: IntensityUnit, [name, model]: [&str; 2], rows: &[Row]) -> Table {
    let years = hazard.years;
    Table::over(rows)
        .text("wall", "", |_| name.to_owned())
        .text("model", "", |_| model.to_owned())
        .value("u_max_over_u_ins", |row| row.fraction)
        .value(format!("theta{}", unit.ending()), |row| unit.of(row.curve[0]))
        .value("beta", |row| row.curve[1])
        .value("annual_rate", |row| row.rate.within())
        .value("annual_rate_low", |row| Some(row.interval[0]).filter(|rate| rate.is_finite()))
        .value("annual_rate_high", |row| Some(row.interval[1]).filter(|rate| rate.is_finite()))
        .value("resamples", |row| row.resamples)
        .value("below_first_point", |row| row.rate.below)
        .value("beyond_last_point_least", |row| row.rate.beyond[0])
        .value("beyond_last_point_continued", |row| row.rate.beyond_continued)
        .value("beyond_last_point_most", |row| row.rate.beyond[1])
        .value("annual_rate_most", |row| row.rate.most())
        .value("return_period_years", |row| 1.0 / row.rate.within())
        .value("return_period_years_least", |row| 1.0 / row.rate.most())
        .value("years", |_| years)
        .value("probability", |row| probability(row.rate.within(), years))
        .value("probability_most", |row| probability(row.rate.most(), years))
        .value("target", |_| hazard.target)
        .text("target_met", "", |row| met(hazard, row))
        .done()
}

/// The parts of the rates by the segments of the hazard curve.
fn shares(hazard: &Hazard, unit: IntensityUnit, [name, model]: [&str; 2], rows: &[Row]) -> Table {
    let segments = rows.iter().flat_map(|row| {
        let parts = row.rate.segments.iter().zip(row.rate.shares());
        parts.zip(hazard.curve.points().windows(2)).map(move |(part, ends)| (row, part, ends))
    });
    Table::over(segments)
        .text("wall", "", |_| name.to_owned())
        .text("model", "", |_| model.to_owned())
        .value("u_max_over_u_ins", |(row, ..)| row.fraction)
        .value(format!("from{}", unit.ending()), |(.., ends)| unit.of(ends[0][0]))
        .value(format!("to{}", unit.ending()), |(.., ends)| unit.of(ends[1][0]))
        .value("annual_rate", |(_, part, _)| *part.0)
        .value("share", |(_, part, _)| Some(part.1).filter(|share| share.is_finite()))
        .done()
}

/// What people see of the rates.
fn shown(hazard: &Hazard, name: &str, model: &str, rows: &[Row]) -> Table {
    let (years, two) = (hazard.years, Digits::Exponent(2));
    let table = Table::over(rows)
        .text("", "wall or class", |_| name.to_owned())
        .text("", "model", |_| model.to_owned())
        .number("", "u_max/u_ins", Digits::AtMost(6), |row| row.fraction)
        .number("", "rate\n[1/year]", two, |row| row.rate.within())
        .number("", "interval", two, |row| between(row.interval))
        .number("", "at most", two, |row| row.rate.most())
        .number("", "return period\n[years]", Digits::Significant(3), |row| 1.0 / row.rate.within())
        .number("", format!("P in {years} years\n[%]"), Digits::Significant(3), |row| {
            100.0 * probability(row.rate.within(), years)
        });
    match hazard.target {
        Some(_) => table.text("", "target met", |row| met(hazard, row)).done(),
        None => table.done(),
    }
}

/// Writes an interval; a dash where it is not known.
pub(super) fn between([low, high]: [f64; 2]) -> String {
    if low.is_finite() && high.is_finite() { format!("{low:.2e} … {high:.2e}") } else { "-".to_owned() }
}

/// Puts the kind of the rows before them.
fn with_kind(mut table: Table, is_class: bool) -> Table {
    table.columns.insert(0, Column::text("", "kind"));
    for row in &mut table.rows {
        row.insert(0, if is_class { "class" } else { "wall" }.into());
    }
    table
}

fn met(hazard: &Hazard, row: &Row) -> &'static str {
    hazard.target.map_or("", |target| row.rate.against(target).word())
}

/// The part of the rate from intensities up to each point, these in a unit.
fn cumulated(hazard: &Hazard, unit: IntensityUnit, rate: &Rate) -> Vec<[f64; 2]> {
    let mut sum = 0.0;
    let mut line = vec![[unit.of(hazard.curve.points()[0][0]), 0.0]];
    for (share, point) in rate.shares().into_iter().zip(&hazard.curve.points()[1..]) {
        sum += share;
        line.push([unit.of(point[0]), if sum.is_finite() { sum } else { 0.0 }]);
    }
    line
}
