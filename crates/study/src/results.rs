//! The results of a complete study: its curves, and the fragilities that follow from them.

use std::convert::Infallible;

use crate::document::ReportOptions;
use crate::fragility::{Bootstrap, ObservationKind, Summary, compare};
use crate::ida::{Curve, Exceedance};
use crate::parallel;

/// Curves of every wall, model and record, and a fragility of every wall, model and limit state.
#[derive(Clone, Debug)]
pub struct Results {
    records: usize,
    models: usize,
    states: usize,
    at_levels: bool,
    curves: Vec<Curve>,
    /// Wall by wall, limit state by limit state: one summary for each model.
    summaries: Vec<Summary>,
}

impl Results {
    /// Fits the fragilities of a study with some records and damping models, by name, on `threads` threads.
    /// `curves` has walls outermost, then models, records innermost. `grid` are the levels that all records
    /// share, if they do.
    pub fn new(
        curves: Vec<Curve>,
        records: usize,
        models: &[&str],
        grid: Option<Vec<f64>>,
        report: &ReportOptions,
        threads: usize,
    ) -> Self {
        let bootstrap = Bootstrap::new(records, report.resamples as usize, report.seed);
        let walls = curves.len() / (records * models.len());
        let at_levels = grid.is_some();
        let kind = grid.map_or(ObservationKind::Records, ObservationKind::Stripes);
        let reference = models.iter().position(|name| *name == report.reference).unwrap_or(0);
        let (models, states) = (models.len(), report.fractions.len());
        let mut results = Self { records, models, states, at_levels, curves, summaries: Vec::new() };
        let summaries = parallel::map(walls, threads, |wall| {
            let exceedances = |model: usize| {
                let at = |&fraction: &f64| results.exceedances(wall, model, fraction);
                report.fractions.iter().map(at).collect()
            };
            let exceedances: Vec<Vec<_>> = (0..models).map(exceedances).collect();
            Ok::<_, Infallible>(compare(&exceedances, reference, &kind, &bootstrap).concat())
        });
        let Ok(summaries) = summaries;
        results.summaries = summaries.concat();
        results
    }

    /// Returns all curves, walls outermost, then models, records innermost.
    pub fn all_curves(&self) -> &[Curve] {
        &self.curves
    }

    /// Returns the curves of a wall and model, record by record.
    pub fn curves(&self, wall: usize, model: usize) -> &[Curve] {
        let start = (wall * self.models + model) * self.records;
        &self.curves[start..start + self.records]
    }

    /// Returns where each record first exceeds a fraction of `u_ins`.
    pub fn exceedances(&self, wall: usize, model: usize, fraction: f64) -> Vec<Exceedance> {
        self.curves(wall, model).iter().map(|curve| curve.exceedance(fraction, self.at_levels)).collect()
    }

    /// Returns the fragilities of a wall at the limit state of a place, one for each model.
    pub fn summaries(&self, wall: usize, state: usize) -> &[Summary] {
        let start = (wall * self.states + state) * self.models;
        &self.summaries[start..start + self.models]
    }

    /// Lists the walls and models, by index, whose limit states contradict a common β.
    pub fn contradicted(&self) -> Vec<[usize; 2]> {
        let pairs =
            (0..self.curves.len() / self.records).map(|pair| [pair / self.models, pair % self.models]);
        pairs
            .filter(|&[wall, model]| self.states > 0 && self.summaries(wall, 0)[model].contradicted)
            .collect()
    }

    /// Counts the runs.
    pub fn runs(&self) -> usize {
        self.curves.iter().map(|curve| curve.runs().len()).sum()
    }
}
