//! Fragilities of several models beside that of a reference.

use super::bootstrap::{Bootstrap, Interval};
use super::fit::{FitError, Lognormal, fit};
use super::observation::ObservationKind;
use super::sample::median;
use crate::ida::Exceedance;

/// Fraction of the resamples within an interval.
pub const CONFIDENCE: f64 = 0.95;

/// Fragility of one model beside a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of records.
    pub records: usize,
    /// Number of records that do not exceed the limit state at any level.
    pub censored: usize,
    /// Intensity that half of the records need.
    pub median: Interval,
    /// Fitted curve.
    pub fitted: Result<Lognormal, FitError>,
    /// θ of the fitted curve; NaN where there is none.
    pub theta: Interval,
    /// Median over that of the reference.
    pub median_ratio: Interval,
    /// θ over that of the reference.
    pub theta_ratio: Interval,
}

/// Compares the exceedances of some models, over the same records, with those of the model number
/// `reference`. Intervals hold 95 % of the resamples.
///
/// # Panics
/// If there is no such model, or the models differ in their number of records.
#[must_use]
pub fn compare(
    models: &[Vec<Exceedance>],
    reference: usize,
    kind: &ObservationKind,
    bootstrap: &Bootstrap,
) -> Vec<Summary> {
    let records = models[reference].len();
    assert!(models.iter().all(|model| model.len() == records), "each model has a result for each record");
    let all: Vec<Resampled> = models.iter().map(|model| Resampled::new(model, kind, bootstrap)).collect();
    let base = &all[reference];
    let ratio = |[a, b]: [f64; 2], [above, below]: [&Vec<f64>; 2]| {
        Interval::new(a / b, above.iter().zip(below).map(|(a, b)| a / b), CONFIDENCE)
    };
    let summary = |(model, own): (&Vec<Exceedance>, &Resampled)| Summary {
        records,
        censored: model.iter().filter(|exceedance| matches!(exceedance, Exceedance::Above(_))).count(),
        median: Interval::new(own.median, own.medians.iter().copied(), CONFIDENCE),
        fitted: own.fitted,
        theta: Interval::new(own.theta(), own.thetas.iter().copied(), CONFIDENCE),
        median_ratio: ratio([own.median, base.median], [&own.medians, &base.medians]),
        theta_ratio: ratio([own.theta(), base.theta()], [&own.thetas, &base.thetas]),
    };
    models.iter().zip(&all).map(summary).collect()
}

/// Median and fit of one model, and those of its resamples.
struct Resampled {
    median: f64,
    medians: Vec<f64>,
    fitted: Result<Lognormal, FitError>,
    thetas: Vec<f64>,
}

impl Resampled {
    fn new(model: &[Exceedance], kind: &ObservationKind, bootstrap: &Bootstrap) -> Self {
        let fitted = fit(&kind.observations(model));
        // where all records give no curve, resamples are not fitted
        let thetas = fitted.map_or(Vec::new(), |_| bootstrap.fitted_medians(model, kind));
        Self { median: median(model), medians: bootstrap.medians(model), fitted, thetas }
    }

    fn theta(&self) -> f64 {
        self.fitted.map_or(f64::NAN, |fit| fit.median)
    }
}
