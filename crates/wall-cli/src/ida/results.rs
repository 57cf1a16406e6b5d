//! What the runs of a study say together, and its tables.

use std::fmt::Write;

use anyhow::Result;
use ground_motion::STANDARD_GRAVITY;
use study::fragility::{Bootstrap, Interval, Observing, Summary, compare};
use study::ida::{Curve, Occurrence};
use study::parallel;

use super::folder::{Contents, Manifest};

/// A study whose runs are all there.
pub(crate) struct Results {
    pub(crate) manifest: Manifest,
    curves: Vec<Curve>,
    /// Wall by wall, fraction by fraction: one summary for each model.
    summaries: Vec<Vec<Summary>>,
}

impl Results {
    pub(super) fn new(manifest: Manifest, curves: Vec<Curve>, threads: usize) -> Result<Self> {
        let (walls, fractions) = (manifest.contents.walls.len(), manifest.report.fractions.len());
        let mut results = Self { manifest, curves, summaries: Vec::new() };
        let report = &results.manifest.report;
        let bootstrap =
            Bootstrap::new(results.contents().records.len(), report.resamples as usize, report.seed);
        let observing = results.observing();
        let models = &results.contents().models;
        let reference = models.iter().position(|model| model.name == report.reference).unwrap_or(0);
        let summaries = parallel::map(walls * fractions, threads, |index| -> Result<_> {
            let (wall, fraction) = (index / fractions, report.fractions[index % fractions]);
            let occurrences: Vec<_> =
                (0..models.len()).map(|model| results.occurrences(wall, model, fraction)).collect();
            Ok(compare(&occurrences, reference, &observing, &bootstrap))
        })?;
        results.summaries = summaries;
        Ok(results)
    }

    pub(crate) fn contents(&self) -> &Contents {
        &self.manifest.contents
    }

    /// Levels that all records share make stripes; levels of each record's own tell its intensity itself.
    fn observing(&self) -> Observing {
        self.contents().grid.clone().map_or(Observing::Exactly, Observing::InStripes)
    }

    /// The curves of a wall and model, record by record.
    pub(crate) fn curves(&self, wall: usize, model: usize) -> &[Curve] {
        let (records, models) = (self.contents().records.len(), self.contents().models.len());
        let start = (wall * models + model) * records;
        &self.curves[start..start + records]
    }

    /// Where each record first exceeds a fraction of `u_ins`.
    pub(crate) fn occurrences(&self, wall: usize, model: usize, fraction: f64) -> Vec<Occurrence> {
        let at_levels = self.contents().grid.is_some();
        self.curves(wall, model).iter().map(|curve| curve.exceedance(fraction, at_levels)).collect()
    }

    /// The fragilities of a wall at the fraction of a place, one for each model.
    pub(crate) fn summaries(&self, wall: usize, fraction: usize) -> &[Summary] {
        &self.summaries[wall * self.manifest.report.fractions.len() + fraction]
    }

    /// Number of runs.
    pub(crate) fn runs(&self) -> usize {
        self.curves.iter().map(|curve| curve.levels().len()).sum()
    }

    /// The names of a combination, for the first columns of a table.
    fn names(&self, index: usize) -> String {
        let (contents, case) = (self.contents(), self.contents().case(index));
        format!(
            "{},{},{}",
            quoted(&contents.walls[case.wall].name),
            quoted(&contents.models[case.model].name),
            quoted(&contents.records[case.record].name)
        )
    }

    /// Every run.
    pub(super) fn levels_csv(&self) -> String {
        let mut text =
            "wall,model,record,intensity_g,u_max_over_u_ins,overturned,overturn_time_s\n".to_owned();
        for (index, curve) in self.curves.iter().enumerate() {
            let names = self.names(index);
            for level in curve.levels() {
                let time = level.overturning.map_or_else(String::new, |time| time.to_string());
                let _ = writeln!(
                    text,
                    "{names},{},{},{},{time}",
                    in_g(level.intensity),
                    level.demand,
                    u8::from(level.overturning.is_some())
                );
            }
        }
        text
    }

    /// The collapse of every wall, model and record.
    pub(super) fn collapses_csv(&self) -> String {
        let mut text =
            "wall,model,record,collapse_g,standing_below_g,highest_level_g,runs,resurrections\n".to_owned();
        for (index, curve) in self.curves.iter().enumerate() {
            let collapse = match curve.collapse() {
                Occurrence::At(intensity) => in_g(intensity).to_string(),
                Occurrence::Above(_) => String::new(),
            };
            let _ = writeln!(
                text,
                "{},{collapse},{},{},{},{}",
                self.names(index),
                in_g(curve.standing()),
                in_g(curve.top()),
                curve.levels().len(),
                curve.resurrections()
            );
        }
        text
    }

    /// The fragilities of every wall, model and fraction.
    pub(super) fn fragilities_csv(&self) -> String {
        let mut text = "wall,model,u_max_over_u_ins,records,censored,median_g,median_low_g,median_high_g,theta_g,theta_low_g,\
                        theta_high_g,beta,median_ratio,median_ratio_low,median_ratio_high,theta_ratio,theta_ratio_low,\
                        theta_ratio_high\n"
            .to_owned();
        let interval = |interval: &Interval, unit: f64| {
            let [low, high] = interval.range;
            format!("{},{},{}", cell(interval.estimate / unit), cell(low / unit), cell(high / unit))
        };
        for (w, wall) in self.contents().walls.iter().enumerate() {
            for (m, model) in self.contents().models.iter().enumerate() {
                for (f, fraction) in self.manifest.report.fractions.iter().enumerate() {
                    let summary = &self.summaries(w, f)[m];
                    let beta = summary.fitted.map_or(f64::NAN, |fit| fit.dispersion);
                    let _ = writeln!(
                        text,
                        "{},{},{fraction},{},{},{},{},{},{},{}",
                        quoted(&wall.name),
                        quoted(&model.name),
                        summary.records,
                        summary.censored,
                        interval(&summary.median, STANDARD_GRAVITY),
                        interval(&summary.theta, STANDARD_GRAVITY),
                        cell(beta),
                        interval(&summary.median_ratio, 1.0),
                        interval(&summary.theta_ratio, 1.0)
                    );
                }
            }
        }
        text
    }
}

/// An acceleration in g.
pub(crate) fn in_g(acceleration: f64) -> f64 {
    acceleration / STANDARD_GRAVITY
}

/// A number, `inf` for what lies above the levels, nothing for what is not known.
fn cell(value: f64) -> String {
    if value.is_nan() { String::new() } else { value.to_string() }
}

/// A name as a field of CSV.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_owned()
    }
}
