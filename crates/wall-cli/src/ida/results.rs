//! The tables of a study.

use std::fmt::Write;

use ground_motion::STANDARD_GRAVITY;
use study::fragility::{FitError, Interval, Lognormal};
use study::ida::{Curve, Exceedance};
use study::results;

use crate::csv::{self, quoted};

use super::folder::{Contents, Manifest};

/// A study whose runs are complete.
pub(crate) struct Results {
    pub(crate) manifest: Manifest,
    pub(crate) data: results::Results,
}

impl Results {
    pub(super) fn new(manifest: Manifest, curves: Vec<Curve>, threads: usize) -> Self {
        let Contents { records, models, grid, .. } = &manifest.contents;
        let models: Vec<_> = models.iter().map(|model| model.name.as_str()).collect();
        let grid = grid.clone();
        let data = results::Results::new(curves, records.len(), &models, grid, &manifest.report, threads);
        Self { manifest, data }
    }

    pub(crate) fn contents(&self) -> &Contents {
        &self.manifest.contents
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
        for (index, curve) in self.data.all_curves().iter().enumerate() {
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
        for (index, curve) in self.data.all_curves().iter().enumerate() {
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
                    let summary = &self.data.summaries(w, f)[m];
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
