//! Fragilities of several models beside that of a reference.

use crate::bootstrap::{Bootstrap, Interval, Resampled};
use crate::cloud::{Cloud, Regression};
use crate::curve::Exceedance;
use crate::dispersion::{CurveCrossing, Dispersion, Estimator};
use crate::fit::{FitError, Lognormal, fit_from, log_likelihood};
use crate::sample::Sample;
use crate::term::Term;

/// Fraction of the resamples within an interval.
pub const CONFIDENCE: f64 = 0.95;

/// Fragility of one model at one limit state, beside a reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Number of records.
    pub records: usize,
    /// Number of records that do not exceed the limit state at any level; of a cloud, those whose wall
    /// overturned.
    pub censored: usize,
    /// Intensity that half of the records need; of a cloud, θ.
    pub median: Interval,
    /// Curve, with the dispersion of the estimator.
    pub fitted: Result<Lognormal, FitError>,
    /// Curve of this limit state alone.
    pub alone: Result<Lognormal, FitError>,
    /// Whether the limit states of the model contradict a common β.
    pub contradicted: bool,
    /// Where the curve crosses that of the next limit state.
    pub crossing: Option<CurveCrossing>,
    /// Largest distance of the curve from the fractions of the records that exceed.
    pub misfit: Option<f64>,
    /// θ of the curve; its bounds where there is none.
    pub theta: Interval,
    /// β of the curve; not a number where there is none.
    pub beta: Interval,
    /// θ and β of each resample, studentised; not numbers where it has no curve.
    pub resamples: Vec<[f64; 2]>,
    /// θ and β of each resample as fitted; not numbers where it has no curve.
    pub drawn: Vec<[f64; 2]>,
    /// Median over that of the reference.
    pub median_ratio: Interval,
    /// θ over that of the reference.
    pub theta_ratio: Interval,
}

/// Compares some models, over the same records, with the model number `reference`. Intervals hold 95 % of the
/// resamples.
///
/// Each model has one sample for each limit state. Returns one list of summaries for each limit state, model
/// by model.
///
/// # Panics
/// If there is no such model, or the models differ in their number of limit states or records.
pub fn compare(
    models: &[Vec<Sample>],
    reference: usize,
    estimator: &Estimator,
    bootstrap: &Bootstrap,
) -> Vec<Vec<Summary>> {
    let shape = |model: &Vec<Sample>| model.iter().map(|s| s.exceedances().len()).collect::<Vec<_>>();
    let states = shape(&models[reference]);
    assert!(models.iter().all(|model| shape(model) == states), "each model has a result for each record");
    let of_model = |model: &Vec<Sample>| Fragility::of_states(model, estimator, bootstrap);
    beside(models.iter().map(of_model).collect(), reference)
}

/// Compares the clouds of some models as [`compare`] does, at some fractions of `u_ins`.
///
/// # Panics
/// If there is no model of that number, or the models differ in their number of records.
pub fn compare_clouds(
    models: &[Cloud],
    fractions: &[f64],
    reference: usize,
    bootstrap: &Bootstrap,
) -> Vec<Vec<Summary>> {
    let of_model = |cloud: &Cloud| Fragility::of_cloud(cloud, fractions, bootstrap);
    beside(models.iter().map(of_model).collect(), reference)
}

/// Divides the fragilities of each model by those of a reference: limit state by limit state, model by model.
fn beside(models: Vec<Vec<Fragility>>, reference: usize) -> Vec<Vec<Summary>> {
    let base: Vec<_> = models[reference].iter().map(|one| (one.median.clone(), one.theta.clone())).collect();
    let mut states: Vec<Vec<Summary>> = base.iter().map(|_| Vec::with_capacity(models.len())).collect();
    for (model, fragilities) in models.into_iter().enumerate() {
        for ((state, (base_median, base_theta)), own) in states.iter_mut().zip(&base).zip(fragilities) {
            let Fragility { mut summary, median, theta } = own;
            if model != reference {
                summary.median_ratio = median.over(base_median).interval(CONFIDENCE);
                summary.theta_ratio = theta.over(base_theta).interval(CONFIDENCE);
            }
            state.push(summary);
        }
    }
    states
}

/// A summary that is its own reference, with the resamples by which others are divided.
struct Fragility {
    summary: Summary,
    median: Resampled,
    theta: Resampled,
}

impl Fragility {
    /// Takes a curve, with the resamples of its median and of its θ and β.
    fn new(
        fitted: Result<Lognormal, FitError>,
        [records, censored]: [usize; 2],
        median: Resampled,
        [theta, beta]: [Resampled; 2],
    ) -> Self {
        let pair = |(theta, beta): (f64, f64)| if beta.is_nan() { [f64::NAN; 2] } else { [theta, beta] };
        let [thetas, betas] = [&theta, &beta].map(|of| of.samples.iter().map(|[_, most]| *most));
        let resamples = thetas.zip(betas).map(pair).collect();
        let drawn = theta.drawn.iter().copied().zip(beta.drawn.iter().copied()).map(pair).collect();
        let one = Interval::new(1.0, [1.0], CONFIDENCE);
        let mut interval = beta.interval(CONFIDENCE);
        interval.estimate = fitted.map_or(f64::NAN, |curve| curve.dispersion);
        let summary = Summary {
            records,
            censored,
            median: median.interval(CONFIDENCE),
            fitted,
            alone: fitted,
            contradicted: false,
            crossing: None,
            misfit: None,
            theta: theta.interval(CONFIDENCE),
            beta: interval,
            resamples,
            drawn,
            median_ratio: one,
            theta_ratio: one,
        };
        Self { summary, median, theta }
    }

    fn of_states(states: &[Sample], estimator: &Estimator, bootstrap: &Bootstrap) -> Vec<Self> {
        let terms: Vec<_> = states.iter().map(Sample::terms).collect();
        let mut own = estimator.clone();
        own.dispersion = Dispersion::Own;
        let (fitted, alone) = (estimator.fit(&terms, &[]), own.fit(&terms, &[]));
        let contradicted = contradict_common_dispersion(&terms, &alone, bootstrap.independent_part());
        let correct = |fits: Vec<Result<Lognormal, FitError>>| -> Vec<_> {
            fits.into_iter().map(|fit| fit.map(|curve| bootstrap.correct(curve))).collect()
        };
        let (fitted, alone) = (correct(fitted), correct(alone));
        let crossings = estimator.crossings(&fitted);
        let medians = bootstrap.medians(states);
        let resampled = medians.into_iter().zip(bootstrap.fitted(states, estimator));
        let of_state = |(place, (median, curves)): (usize, (Resampled, [Resampled; 2]))| {
            let (state, fitted) = (&states[place], fitted[place]);
            let censored = |exceedance: &&Exceedance| matches!(exceedance, Exceedance::Above(_));
            let censored = state.exceedances().iter().filter(censored).count();
            let median = if state.is_apart() { curves[0].clone() } else { median };
            let mut one = Self::new(fitted, [state.exceedances().len(), censored], median, curves);
            one.summary.alone = alone[place];
            one.summary.contradicted = contradicted;
            one.summary.crossing = crossings[place];
            one.summary.misfit = fitted.ok().map(|curve| state.misfit(|x| curve.probability(x)));
            one
        };
        resampled.enumerate().map(of_state).collect()
    }

    /// The fragilities of limit states that follow from one regression: they have one β, and do not cross.
    fn of_cloud(cloud: &Cloud, fractions: &[f64], bootstrap: &Bootstrap) -> Vec<Self> {
        let own = cloud.fit();
        let resampled = bootstrap.counted(|counts| cloud.fit_drawn(counts).ok());
        let state = |&fraction: &f64| {
            // nothing is known of θ without a regression
            let ends = |fit: Option<Regression>| {
                let curve = fit.map(|fit| fit.fragility(fraction));
                curve.map_or([0.0, f64::INFINITY, f64::NAN], |curve| {
                    [curve.median, curve.median, curve.dispersion]
                })
            };
            let curves = bootstrap.curves(ends(own.ok()), &resampled.iter().map(|fit| ends(*fit)));
            let counts = [cloud.records(), cloud.collapsed()];
            let fitted = own.map(|fit| bootstrap.correct(fit.fragility(fraction)));
            Self::new(fitted, counts, curves[0].clone(), curves)
        };
        fractions.iter().map(state).collect()
    }
}

impl Summary {
    /// Adds a β of modelling to that of the records, in the curve and in its resamples: their squares add up.
    ///
    /// Whatever takes probabilities from the curve takes it so.
    #[must_use]
    pub fn widened(mut self, modelling: f64) -> Self {
        let total = |beta: f64| beta.hypot(modelling);
        self.fitted = self.fitted.map(|curve| Lognormal { dispersion: total(curve.dispersion), ..curve });
        self.beta = self.beta.mapped(total);
        let resamples = self.resamples.iter_mut().chain(&mut self.drawn);
        resamples.for_each(|[_, beta]| *beta = total(*beta));
        self
    }

    /// Returns the variance of ln θ, the covariance of ln θ and β, and the variance of β, over the resamples;
    /// `None` without a curve.
    pub fn covariance(&self) -> Option<[f64; 3]> {
        self.fitted.ok().and_then(|_| covariance(&self.drawn))
    }
}

/// Returns the variance of ln θ, the covariance of ln θ and β, and the variance of β, of resamples; `None`
/// with fewer than two curves.
pub fn covariance(resamples: &[[f64; 2]]) -> Option<[f64; 3]> {
    let known = resamples.iter().filter(|pair| pair.iter().all(|value| value.is_finite()));
    let known: Vec<_> = known.map(|[theta, beta]| [libm::log(*theta), *beta]).collect();
    let count = known.len() as f64;
    let mean = [0, 1].map(|k| known.iter().map(|pair| pair[k]).sum::<f64>() / count);
    let moment = |one: usize, other: usize| -> f64 {
        let products = known.iter().map(|pair| (pair[one] - mean[one]) * (pair[other] - mean[other]));
        products.sum::<f64>() / (count - 1.0)
    };
    (known.len() > 1).then(|| [moment(0, 0), moment(0, 1), moment(1, 1)])
}

/// Returns whether limit states contradict a common β, by the ratio of likelihoods at a level of 5 %, as if
/// their runs were independent. Limit states without a curve of their own are left out. The two signs of a
/// record tell as much as one, and records of unequal weights less: a part of the likelihood counts.
///
/// S. S. Wilks: The large-sample distribution of the likelihood ratio for testing composite hypotheses.
/// Annals of Mathematical Statistics 9(1), 1938, 60–62.
fn contradict_common_dispersion(
    states: &[Vec<Term>],
    alone: &[Result<Lognormal, FitError>],
    part: f64,
) -> bool {
    let own = states.iter().zip(alone).filter_map(|(terms, alone)| Some((terms, alone.ok()?)));
    let (states, alone): (Vec<_>, Vec<_>) = own.unzip();
    let joint: Vec<Lognormal> = fit_from(&states, &[]).into_iter().flatten().collect();
    if states.len() < 2 || joint.len() < states.len() {
        return false;
    }
    let sum = |curves: &[Lognormal]| -> f64 {
        states.iter().zip(curves).map(|(terms, curve)| log_likelihood(terms, curve)).sum()
    };
    2.0 * (sum(&alone) - sum(&joint)) * part > chi_squared_95(states.len() - 1)
}

/// Returns the 95 % fractile of χ² with some degrees of freedom, to 3 %: for one degree 3.75 instead of 3.84.
///
/// E. B. Wilson, M. M. Hilferty: The distribution of chi-square. Proceedings of the National Academy of
/// Sciences 17(12), 1931, 684–688.
fn chi_squared_95(degrees: usize) -> f64 {
    let ninth = 2.0 / (9.0 * degrees as f64);
    degrees as f64 * (1.0 - ninth + 1.644_853_626_951 * ninth.sqrt()).powi(3)
}
