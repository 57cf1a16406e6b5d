//! Fragilities of several models beside that of a reference.

use super::bootstrap::{Bootstrap, Interval, Resampled};
use super::fit::{FitError, Lognormal, fit, fit_jointly, log_likelihood};
use super::observation::{Observation, ObservationKind};
use crate::ida::Exceedance;

/// Fraction of the resamples within an interval.
pub const CONFIDENCE: f64 = 0.95;

/// Fragility of one model at one limit state, beside a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of records.
    pub records: usize,
    /// Number of records that do not exceed the limit state at any level.
    pub censored: usize,
    /// Intensity that half of the records need.
    pub median: Interval,
    /// Curve of the joint fit, with one β for all limit states of the model.
    pub fitted: Result<Lognormal, FitError>,
    /// Curve of this limit state alone.
    pub alone: Result<Lognormal, FitError>,
    /// Whether the limit states of the model contradict a common β.
    pub contradicted: bool,
    /// θ of the joint fit; its bounds where there is none.
    pub theta: Interval,
    /// Median over that of the reference.
    pub median_ratio: Interval,
    /// θ over that of the reference.
    pub theta_ratio: Interval,
}

/// Compares the exceedances of some models, over the same records, with those of the model number
/// `reference`. Intervals hold 95 % of the resamples.
///
/// Each model has one list of exceedances for each limit state, record by record. Returns one list of
/// summaries for each limit state, model by model.
///
/// # Panics
/// If there is no such model, or the models differ in their number of limit states or records.
pub fn compare(
    models: &[Vec<Vec<Exceedance>>],
    reference: usize,
    kind: &ObservationKind,
    bootstrap: &Bootstrap,
) -> Vec<Vec<Summary>> {
    let shape = |model: &Vec<Vec<Exceedance>>| model.iter().map(Vec::len).collect::<Vec<_>>();
    let states = shape(&models[reference]);
    assert!(models.iter().all(|model| shape(model) == states), "each model has a result for each record");
    let all: Vec<Vec<Fragility>> =
        models.iter().map(|model| Fragility::of_states(model, kind, bootstrap)).collect();
    let at = |state: usize| {
        let base = &all[reference][state];
        let summary = |(model, fragilities): (usize, &Vec<Fragility>)| {
            let own = &fragilities[state];
            let ratio = |own: &Resampled, base: &Resampled| {
                if model == reference {
                    Interval::new(1.0, [1.0], CONFIDENCE)
                } else {
                    own.over(base).interval(CONFIDENCE)
                }
            };
            let censored = |exceedance: &&Exceedance| matches!(exceedance, Exceedance::Above(_));
            Summary {
                records: states[state],
                censored: models[model][state].iter().filter(censored).count(),
                median: own.median.interval(CONFIDENCE),
                fitted: own.fitted,
                alone: own.alone,
                contradicted: own.contradicted,
                theta: own.theta.interval(CONFIDENCE),
                median_ratio: ratio(&own.median, &base.median),
                theta_ratio: ratio(&own.theta, &base.theta),
            }
        };
        all.iter().enumerate().map(summary).collect()
    };
    (0..states.len()).map(at).collect()
}

/// Medians and fits of one model at one limit state, with those of its resamples.
struct Fragility {
    median: Resampled,
    fitted: Result<Lognormal, FitError>,
    alone: Result<Lognormal, FitError>,
    contradicted: bool,
    theta: Resampled,
}

impl Fragility {
    fn of_states(states: &[Vec<Exceedance>], kind: &ObservationKind, bootstrap: &Bootstrap) -> Vec<Self> {
        let observations: Vec<_> = states.iter().map(|state| kind.observations(state)).collect();
        let fitted = fit_jointly(&observations);
        let alone: Vec<_> = observations.iter().map(|state| fit(state)).collect();
        let contradicted = contradict_common_dispersion(&observations, &alone);
        let thetas = bootstrap.fitted_medians(states, kind);
        let medians = states.iter().map(|state| Resampled::medians(state, kind, bootstrap));
        let fits = fitted.into_iter().zip(alone);
        let fragility =
            |((median, theta), (fitted, alone))| Self { median, fitted, alone, contradicted, theta };
        medians.zip(thetas).zip(fits).map(fragility).collect()
    }
}

/// Returns whether limit states contradict a common β, by the ratio of likelihoods at a level of 5 %, as if
/// their runs were independent. Limit states without a curve of their own are left out.
///
/// S. S. Wilks: The large-sample distribution of the likelihood ratio for testing composite hypotheses.
/// Annals of Mathematical Statistics 9(1), 1938, 60–62.
fn contradict_common_dispersion(
    observations: &[Vec<Observation>],
    alone: &[Result<Lognormal, FitError>],
) -> bool {
    let own = observations.iter().zip(alone).filter_map(|(state, alone)| Some((state.clone(), alone.ok()?)));
    let (states, alone): (Vec<_>, Vec<_>) = own.unzip();
    let joint: Vec<Lognormal> = fit_jointly(&states).into_iter().flatten().collect();
    if states.len() < 2 || joint.len() < states.len() {
        return false;
    }
    let sum = |curves: &[Lognormal]| -> f64 {
        states.iter().zip(curves).map(|(state, curve)| log_likelihood(state, curve)).sum()
    };
    2.0 * (sum(&alone) - sum(&joint)) > chi_squared_95(states.len() - 1)
}

/// Returns the 95 % fractile of χ² with some degrees of freedom, to 3 %: for one degree 3.75 instead of 3.84.
///
/// E. B. Wilson, M. M. Hilferty: The distribution of chi-square. Proceedings of the National Academy of
/// Sciences 17(12), 1931, 684–688.
fn chi_squared_95(degrees: usize) -> f64 {
    let ninth = 2.0 / (9.0 * degrees as f64);
    degrees as f64 * (1.0 - ninth + 1.644_853_626_951 * ninth.sqrt()).powi(3)
}
