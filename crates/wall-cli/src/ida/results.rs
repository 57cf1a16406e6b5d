//! The results of a study, and its tables.

use std::fmt::Write;

use anyhow::Result;
use ground_motion::STANDARD_GRAVITY;
use study::fragility::{Bootstrap, FitError, Interval, Lognormal, ObservationKind, Summary, compare};
use study::ida::{Curve, Exceedance};
use study::parallel;

use crate::csv::{self, quoted};

use super::folder::{Contents, Manifest};

/// A study whose runs are complete.
pub(crate) struct Results {
    pub(crate) manifest: Manifest,
    curves: Vec<Curve>,
    /// Wall by wall, fraction by fraction: one summary for each model.
    summaries: Vec<Vec<Summary>>,
}

impl Results {
    pub(super) fn new(manifest: Manifest, curves: Vec<Curve>, threads: usize) -> Result<Self> {
        let walls = manifest.contents.walls.len();
        let mut results = Self { manifest, curves, summaries: Vec::new() };
        let report = &results.manifest.report;
        let bootstrap =
            Bootstrap::new(results.contents().records.len(), report.resamples as usize, report.seed);
        let kind = results.observation_kind();
        let models = &results.contents().models;
        let reference = models.iter().position(|model| model.name == report.reference).unwrap_or(0);
        let summaries = parallel::map(walls, threads, |wall| -> Result<_> {
            let exceedances = |model: usize| {
                let at = |&fraction: &f64| results.exceedances(wall, model, fraction);
                report.fractions.iter().map(at).collect()
            };
            let exceedances: Vec<Vec<_>> = (0..models.len()).map(exceedances).collect();
            Ok(compare(&exceedances, reference, &kind, &bootstrap))
        })?;
        results.summaries = summaries.concat();
        Ok(results)
    }

    pub(crate) fn contents(&self) -> &Contents {
        &self.manifest.contents
    }

    /// Returns stripes at levels that all records share, or the records' own intensities.
    fn observation_kind(&self) -> ObservationKind {
        self.contents().grid.clone().map_or(ObservationKind::Records, ObservationKind::Stripes)
    }

    /// The curves of a wall and model, record by record.
    pub(crate) fn curves(&self, wall: usize, model: usize) -> &[Curve] {
        let (records, models) = (self.contents().records.len(), self.contents().models.len());
        let start = (wall * models + model) * records;
        &self.curves[start..start + records]
    }

    /// Where each record first exceeds a fraction of `u_ins`.
    pub(crate) fn exceedances(&self, wall: usize, model: usize, fraction: f64) -> Vec<Exceedance> {
        let at_levels = self.contents().grid.is_some();
        self.curves(wall, model).iter().map(|curve| curve.exceedance(fraction, at_levels)).collect()
    }

    /// The fragilities of a wall at the fraction of a place, one for each model.
    pub(crate) fn summaries(&self, wall: usize, fraction: usize) -> &[Summary] {
        &self.summaries[wall * self.manifest.report.fractions.len() + fraction]
    }

    /// The walls and models, by index, whose limit states contradict a common β.
    pub(super) fn contradicted(&self) -> Vec<[usize; 2]> {
        let models = self.contents().models.len();
        let pairs = (0..self.contents().walls.len() * models).map(|pair| [pair / models, pair % models]);
        pairs.filter(|&[wall, model]| self.summaries(wall, 0)[model].contradicted).collect()
    }

    /// Number of runs.
    pub(crate) fn runs(&self) -> usize {
        self.curves.iter().map(|curve| curve.runs().len()).sum()
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
            for run in curve.runs() {
                let time = run.overturning.map_or_else(String::new, |time| time.to_string());
                let _ = writeln!(
                    text,
                    "{names},{},{},{},{time}",
                    in_g(run.intensity),
                    run.demand,
                    u8::from(run.overturning.is_some())
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
                Exceedance::At(intensity) => in_g(intensity).to_string(),
                Exceedance::Above(_) => String::new(),
            };
            let _ = writeln!(
                text,
                "{},{collapse},{},{},{},{}",
                self.names(index),
                in_g(curve.level_below_collapse()),
                in_g(curve.top()),
                curve.runs().len(),
                curve.resurrections()
            );
        }
        text
    }

    /// The fragilities of every wall, model and fraction.
    pub(super) fn fragilities_csv(&self) -> String {
        let mut text = "wall,model,u_max_over_u_ins,records,censored,median_g,median_low_g,\
                        median_high_g,theta_g,theta_low_g,theta_high_g,beta,beta_alone,median_ratio,\
                        median_ratio_low,median_ratio_high,theta_ratio,theta_ratio_low,theta_ratio_high\n"
            .to_owned();
        // nothing for what is not known
        let interval = |interval: &Interval, unit: f64| interval.texts(unit, None).join(",").replace('–', "");
        let beta = |fit: Result<Lognormal, FitError>| csv::optional(fit.ok().map(|fit| fit.dispersion));
        for (w, wall) in self.contents().walls.iter().enumerate() {
            for (m, model) in self.contents().models.iter().enumerate() {
                for (f, fraction) in self.manifest.report.fractions.iter().enumerate() {
                    let summary = &self.summaries(w, f)[m];
                    let _ = writeln!(
                        text,
                        "{},{},{fraction},{},{},{},{},{},{},{},{}",
                        quoted(&wall.name),
                        quoted(&model.name),
                        summary.records,
                        summary.censored,
                        interval(&summary.median, STANDARD_GRAVITY),
                        interval(&summary.theta, STANDARD_GRAVITY),
                        beta(summary.fitted),
                        beta(summary.alone),
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
