//! Models side by side.

use super::{Bootstrap, FitError, Interval, Lognormal, Observing, fit, median};
use crate::study::ida::Occurrence;

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
    let of = |model: &Vec<Occurrence>| {
        let fitted = fit(&observing.observations(model));
        // without a curve of all records there is none to resample
        let thetas = match &fitted {
            Ok(_) => bootstrap.fitted_medians(model, observing),
            Err(_) => Vec::new(),
        };
        (median(model), bootstrap.medians(model), fitted, thetas)
    };
    let all: Vec<_> = models.iter().map(of).collect();
    let (base, bases, base_fit, base_thetas) = &all[reference];
    let theta_of = |fitted: &Result<Lognormal, FitError>| fitted.as_ref().map_or(f64::NAN, |fit| fit.median);
    let ratios = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a / b).collect::<Vec<_>>();
    let summary =
        |(model, (median, medians, fitted, thetas)): (&Vec<Occurrence>, &(f64, Vec<f64>, _, Vec<f64>))| {
            let theta = theta_of(fitted);
            Summary {
                records,
                censored: model
                    .iter()
                    .filter(|occurrence| matches!(occurrence, Occurrence::Above(_)))
                    .count(),
                median: Interval::new(*median, medians.iter().copied(), CONFIDENCE),
                fitted: *fitted,
                theta: Interval::new(theta, thetas.iter().copied(), CONFIDENCE),
                median_ratio: Interval::new(median / base, ratios(medians, bases), CONFIDENCE),
                theta_ratio: Interval::new(
                    theta / theta_of(base_fit),
                    ratios(thetas, base_thetas),
                    CONFIDENCE,
                ),
            }
        };
    models.iter().zip(&all).map(summary).collect()
}
