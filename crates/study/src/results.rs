//! The results of a study, wall by wall: its curves, and the fragilities that follow from them.

use crate::document::ReportOptions;
use crate::fragility::{Bootstrap, ObservationKind, Summary, compare};
use crate::ida::{Curve, Exceedance};

/// Makes the results of each wall of a study.
#[derive(Clone, Debug)]
pub struct Fitting {
    records: usize,
    models: usize,
    reference: usize,
    fractions: Vec<f64>,
    kind: ObservationKind,
    bootstrap: Bootstrap,
}

/// Curves of one wall with every model and record, and a fragility of every model and limit state.
#[derive(Clone, Debug)]
pub struct WallResults {
    records: usize,
    at_levels: bool,
    curves: Vec<Curve>,
    /// Limit state by limit state: one summary for each model.
    summaries: Vec<Vec<Summary>>,
}

impl Fitting {
    /// Prepares the fits of a study from the names of its records and damping models. `grid` holds the levels
    /// that all records share, if they share them.
    pub fn new(records: usize, models: &[&str], grid: Option<Vec<f64>>, report: &ReportOptions) -> Self {
        Self {
            records,
            models: models.len(),
            reference: models.iter().position(|name| *name == report.reference).unwrap_or(0),
            fractions: report.fractions.clone(),
            kind: grid.map_or(ObservationKind::Records, ObservationKind::Stripes),
            bootstrap: Bootstrap::new(records, report.resamples as usize, report.seed),
        }
    }

    /// Fits the fragilities of a wall. `curves` has models outermost, records innermost.
    ///
    /// # Panics
    /// If there is not one curve for each model and record.
    pub fn results(&self, curves: Vec<Curve>) -> WallResults {
        assert_eq!(curves.len(), self.models * self.records, "one curve for each model and record");
        let at_levels = matches!(self.kind, ObservationKind::Stripes(_));
        let mut results = WallResults { records: self.records, at_levels, curves, summaries: Vec::new() };
        let exceedances = |model: usize| {
            self.fractions.iter().map(|&fraction| results.exceedances(model, fraction)).collect()
        };
        let exceedances: Vec<Vec<_>> = (0..self.models).map(exceedances).collect();
        results.summaries = compare(&exceedances, self.reference, &self.kind, &self.bootstrap);
        results
    }
}

impl WallResults {
    /// Returns all curves, models outermost, records innermost.
    pub fn all_curves(&self) -> &[Curve] {
        &self.curves
    }

    /// Returns the curves of a model, record by record.
    pub fn curves(&self, model: usize) -> &[Curve] {
        &self.curves[model * self.records..(model + 1) * self.records]
    }

    /// Returns whether all records have the same levels.
    pub fn are_levels_shared(&self) -> bool {
        self.at_levels
    }

    /// Returns where each record first exceeds a fraction of `u_ins`.
    pub fn exceedances(&self, model: usize, fraction: f64) -> Vec<Exceedance> {
        self.curves(model).iter().map(|curve| curve.exceedance(fraction, self.at_levels)).collect()
    }

    /// Returns the fragilities at a limit state, given by its index: one for each model.
    pub fn summaries(&self, state: usize) -> &[Summary] {
        &self.summaries[state]
    }

    /// Returns whether the limit states of a model contradict a common β.
    pub fn is_contradicted(&self, model: usize) -> bool {
        self.summaries.first().is_some_and(|summaries| summaries[model].contradicted)
    }
}
