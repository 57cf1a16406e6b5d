//! Models side by side.

use super::{Bootstrap, FitError, Interval, Lognormal, Observing, fit, median};
use crate::ida::Occurrence;

/// Part of the resamples within an interval.
pub const CONFIDENCE: f64 = 0.95;

/// The fragility of one model beside a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of records.
    pub records: usize,
    /// Records that do not exceed the demand at any level.
    pub censored: usize,
    /// The intensity that half of the records need.
    pub median: Interval,
    /// The fitted curve.
    pub fitted: Result<Lognormal, FitError>,
    /// θ of the fitted curve; NaN where there is none.
    pub theta: Interval,
    /// The median over the reference's.
    pub median_ratio: Interval,
    /// θ over the reference's.
    pub theta_ratio: Interval,
}

/// Compares the first exceedances of some models, record by record the same, with those of the `reference`; intervals hold
/// 95 % of the resamples.
///
/// # Panics
/// If there is no model of the number `reference`, or the models differ in their number of records.
#[must_use]
pub fn compare(
    models: &[Vec<Occurrence>],
    reference: usize,
    observing: &Observing,
    bootstrap: &Bootstrap,
) -> Vec<Summary> {
    let records = models[reference].len();
    assert!(models.iter().all(|model| model.len() == records), "each model has seen each record");
    let all: Vec<Resampled> =
        models.iter().map(|model| Resampled::new(model, observing, bootstrap)).collect();
    let base = &all[reference];
    let ratio = |[a, b]: [f64; 2], [above, below]: [&Vec<f64>; 2]| {
        Interval::new(a / b, above.iter().zip(below).map(|(a, b)| a / b), CONFIDENCE)
    };
    let summary = |(model, own): (&Vec<Occurrence>, &Resampled)| Summary {
        records,
        censored: model.iter().filter(|occurrence| matches!(occurrence, Occurrence::Above(_))).count(),
        median: Interval::new(own.median, own.medians.iter().copied(), CONFIDENCE),
        fitted: own.fitted,
        theta: Interval::new(own.theta(), own.thetas.iter().copied(), CONFIDENCE),
        median_ratio: ratio([own.median, base.median], [&own.medians, &base.medians]),
        theta_ratio: ratio([own.theta(), base.theta()], [&own.thetas, &base.thetas]),
    };
    models.iter().zip(&all).map(summary).collect()
}

/// One model's median and fit, and those of the resamples.
struct Resampled {
    median: f64,
    medians: Vec<f64>,
    fitted: Result<Lognormal, FitError>,
    thetas: Vec<f64>,
}

impl Resampled {
    fn new(model: &[Occurrence], observing: &Observing, bootstrap: &Bootstrap) -> Self {
        let fitted = fit(&observing.observations(model));
        // without a curve of all records there is none to resample
        let thetas = match &fitted {
            Ok(_) => bootstrap.fitted_medians(model, observing),
            Err(_) => Vec::new(),
        };
        Self { median: median(model), medians: bootstrap.medians(model), fitted, thetas }
    }

    fn theta(&self) -> f64 {
        self.fitted.map_or(f64::NAN, |fit| fit.median)
    }
}
