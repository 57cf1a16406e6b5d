//! The walls of a large study together: distributions of their medians and dispersions.

use std::fmt::Write;

use crate::results::WallResults;
use report::escaped;
use report::plot::Axis;
use report::table::{Cell, Digits, Table};
use run::sample::{fractile, sorted};

use super::contents::Manifest;
use super::legend::looks;
use super::plots::{POINTS, marked_line, probabilities};
use super::tables::OF_INTENSITY;

/// Fractiles that the tables list.
const FRACTILES: [f64; 5] = [0.05, 0.16, 0.5, 0.84, 0.95];
/// Weakest walls that the page lists.
const WEAKEST: usize = 10;

/// What the page of a large study shows, wall by wall.
#[derive(Debug)]
pub(crate) struct Population {
    /// Medians of each limit state and model, infinite above the levels.
    medians: Vec<Vec<Vec<f64>>>,
    /// Dispersions of each model at the last limit state, where there is a fit.
    dispersions: Vec<Vec<f64>>,
    /// Place of the last limit state to be exceeded.
    last: usize,
}

impl Population {
    pub(crate) fn new(manifest: &Manifest) -> Self {
        let models = manifest.contents.models.len();
        let medians = vec![vec![Vec::new(); models]; manifest.report.fractions.len()];
        let last = manifest.report.rising().pop().unwrap_or(0);
        Self { medians, dispersions: vec![Vec::new(); models], last }
    }

    /// Adds the next wall.
    pub(crate) fn add(&mut self, results: &WallResults) {
        for (state, medians) in self.medians.iter_mut().enumerate() {
            for (medians, summary) in medians.iter_mut().zip(results.summaries(state)) {
                medians.push(summary.median.estimate);
            }
        }
        for (dispersions, summary) in self.dispersions.iter_mut().zip(results.summaries(self.last)) {
            dispersions.extend(summary.fitted.ok().map(|fit| fit.dispersion));
        }
    }

    /// Draws the distributions as sections of the page.
    pub(crate) fn sections(&self, manifest: &Manifest) -> String {
        let walls = manifest.contents.walls.len();
        let mut html = format!(
            "<section><h2>{walls} walls</h2><p class=\"subtitle\">Each curve is the fraction of the walls \
             whose median intensity is at most that of the axis. The runs of each wall are in the parts, its \
             fragilities in fragilities.csv.</p><div class=\"row\">"
        );
        let (measure, unit) = (manifest.contents.axis(), manifest.contents.unit);
        for (place, fraction) in manifest.report.fractions.iter().enumerate() {
            let medians =
                self.medians[place].iter().map(|medians| sorted(medians.iter().map(|x| unit.of(*x))));
            let medians: Vec<_> = medians.collect();
            let _ = write!(
                html,
                "<figure><figcaption>Medians of u<sub>max</sub>/u<sub>ins</sub> {}</figcaption>{}</figure>",
                if *fraction < 1.0 { format!("&gt; {fraction}") } else { "≥ 1: collapse".to_owned() },
                distribution(manifest, &medians, &measure)
            );
        }
        let dispersions: Vec<_> =
            self.dispersions.iter().map(|values| sorted(values.iter().copied())).collect();
        let _ = write!(
            html,
            "<figure><figcaption>Dispersions β at {}</figcaption>{}</figure></div></section>\n{}",
            manifest.report.fractions[self.last],
            distribution(manifest, &dispersions, "β"),
            self.tables(manifest)
        );
        html
    }

    /// Lists fractiles of the medians, and the walls with the lowest medians of the last limit state with the
    /// first model.
    fn tables(&self, manifest: &Manifest) -> String {
        let all: Vec<_> = (0..self.medians.len()).collect();
        let fractiles = self.fractiles(manifest, &all).html();
        let unit = manifest.contents.unit;
        let name = unit.name();
        let mut html = format!(
            "<section><h2>Fractiles of the medians over the walls ({name})</h2>{fractiles}</section>\n"
        );
        let Some(medians) = self.medians.last().and_then(|medians| medians.first()) else {
            return html;
        };
        let mut order: Vec<usize> = (0..medians.len()).collect();
        order.sort_by(|&a, &b| medians[a].total_cmp(&medians[b]));
        let weakest = Table::over(order.into_iter().take(WEAKEST))
            .text("", "wall", |wall| manifest.contents.walls[*wall].name.clone())
            .number("", format!("median ({name})"), OF_INTENSITY, |wall| known(Some(unit.of(medians[*wall]))))
            .done();
        let _ = writeln!(
            html,
            "<section><h2>Walls with the lowest medians of u<sub>max</sub>/u<sub>ins</sub> = {}, {}</h2>\
             {}</section>",
            manifest.report.fractions.last().copied().unwrap_or(1.0),
            escaped(&manifest.contents.models[0].name),
            weakest.html()
        );
        html
    }

    /// Returns the fractiles of the medians over the walls, in the unit of results, by limit states, given by
    /// their places, and models.
    pub(crate) fn fractiles(&self, manifest: &Manifest, places: &[usize]) -> Table {
        let rows = places.iter().flat_map(|&place| {
            let models = manifest.contents.models.iter().zip(&self.medians[place]);
            let unit = manifest.contents.unit;
            models.map(move |(model, medians)| (place, model, sorted(medians.iter().map(|x| unit.of(*x)))))
        });
        let mut table = Table::over(rows)
            .number("", "u_max/u_ins", Digits::AtMost(6), |(place, ..)| manifest.report.fractions[*place])
            .text("", "model", |(_, model, _)| model.name.clone());
        for part in FRACTILES {
            let heading = format!("{:.0} %", 100.0 * part);
            table = table.number("", heading, OF_INTENSITY, |(.., all)| known(fractile(all, part)));
        }
        table
            .number("", "above the levels", Digits::AtMost(6), |(.., all)| {
                all.iter().filter(|median| median.is_infinite()).count()
            })
            .done()
    }
}

/// Returns a median, `open` above the levels.
fn known(median: Option<f64>) -> Cell<'static> {
    median.filter(|median| median.is_finite()).map_or("open".into(), Cell::Number)
}

/// Draws sorted values of each model as distributions.
fn distribution(manifest: &Manifest, values: &[Vec<f64>], label: &str) -> String {
    let finite = |values: &Vec<f64>| values.iter().rfind(|value| value.is_finite()).copied();
    let top = 1.05 * values.iter().filter_map(finite).fold(1e-6, f64::max);
    let lines = values.iter().zip(looks(manifest)).flat_map(|(values, (color, mark))| {
        let point = |k: u32| {
            let part = f64::from(k) / f64::from(POINTS);
            Some((fractile(values, part).filter(|value| value.is_finite())?, part))
        };
        marked_line((1..=POINTS).filter_map(point).collect(), color, mark)
    });
    probabilities(Axis::over(label, [0.0, top]), "fraction of the walls", lines.collect())
}
