//! Dispersions of the limit states of the same runs, and curves that do not cross.

use files::choices;
use serde::{Deserialize, Serialize};

use crate::fit::{FitError, Lognormal, fit_from};
use crate::linear::{cholesky, solve};
use crate::normal::cumulative;
use crate::term::{Likelihood, Term};

/// How the dispersions of the limit states of a wall are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dispersion {
    /// A β for each limit state; curves may cross.
    Own,
    /// One β for all limit states, as in [`fit_jointly`](super::fit_jointly).
    Common,
    /// A β for each limit state; curves that would cross take the likeliest values with which they do not.
    Ordered,
}

choices!(Dispersion);

/// What is fitted to the limit states of a wall.
#[derive(Clone, Debug)]
pub struct Estimator {
    /// Dispersions.
    pub dispersion: Dispersion,
    /// Places of the limit states, the first to be exceeded first.
    rising: Vec<usize>,
}

/// Where the curve of a limit state crosses that of a later one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveCrossing {
    /// Intensity.
    pub intensity: f64,
    /// The most by which the probability of the later limit state is the larger one \[-\].
    pub excess: f64,
}

impl CurveCrossing {
    /// Returns whether it is worth a warning: probabilities out of order by more than 0.01.
    pub fn matters(&self) -> bool {
        self.excess > 0.01
    }
}

/// z of the probability 1 − 1e-4: what lies beyond does not matter to a curve.
pub const TAIL: f64 = 3.719_016_485_455_709;
/// Weights of the barrier. The likeliest curves that do not cross have a ln L larger by at most the last
/// weight for each bound.
const BARRIERS: [f64; 7] = [1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// Number of weights for a resample, of which only fractiles are wanted.
const OF_RESAMPLE: usize = 4;
/// Bounds on Newton's steps with one weight, and on halvings of one.
const MOST_STEPS: usize = 60;
const MOST_HALVINGS: usize = 60;
/// Newton's decrement, as a part of the weight, at which the next weight is tried.
const DECREMENT: f64 = 0.01;
/// Least ratio of medians to start from, less 1.
const APART: f64 = 0.01;

impl Estimator {
    /// Prepares an estimator for limit states at some fractions of `u_ins`, in any order.
    pub fn new(dispersion: Dispersion, fractions: &[f64]) -> Self {
        let mut rising: Vec<usize> = (0..fractions.len()).collect();
        rising.sort_by(|&a, &b| fractions[a].total_cmp(&fractions[b]));
        Self { dispersion, rising }
    }

    /// Fits the curves of the limit states, from those of similar runs.
    pub(crate) fn fit(
        &self,
        states: &[Vec<Term>],
        near: &[Result<Lognormal, FitError>],
    ) -> Vec<Result<Lognormal, FitError>> {
        if self.dispersion == Dispersion::Common {
            return fit_from(states, near);
        }
        let own = |k| fit_from(&states[k..=k], near.get(k..=k).unwrap_or_default());
        let mut fitted: Vec<_> = (0..states.len()).flat_map(own).collect();
        if self.dispersion == Dispersion::Ordered && self.crossings(&fitted).iter().any(Option::is_some) {
            let known = |&state: &usize| fitted[state].ok().map(|curve| (state, curve));
            let known: Vec<_> = self.rising.iter().filter_map(known).collect();
            let terms: Vec<_> = known.iter().map(|(state, _)| states[*state].as_slice()).collect();
            let curves: Vec<_> = known.iter().map(|(_, curve)| *curve).collect();
            let weights = if near.is_empty() { &BARRIERS[..] } else { &BARRIERS[..OF_RESAMPLE] };
            for ((state, _), curve) in known.iter().zip(ordered(&terms, &curves, weights)) {
                fitted[*state] = Ok(curve);
            }
        }
        fitted
    }

    /// Returns for each limit state where its curve crosses that of the next one.
    pub(crate) fn crossings(&self, curves: &[Result<Lognormal, FitError>]) -> Vec<Option<CurveCrossing>> {
        let mut crossings = vec![None; curves.len()];
        let known: Vec<_> = self.rising.iter().filter_map(|&k| Some((k, curves[k].ok()?))).collect();
        for pair in known.windows(2) {
            crossings[pair[0].0] = pair[0].1.crossing(&pair[1].1);
        }
        crossings
    }
}

impl Lognormal {
    /// Returns where this curve crosses that of a limit state that is exceeded later: from there on, or up to
    /// there, the later one has the larger probability. What lies beyond probabilities of 1e-4 and 1 − 1e-4
    /// does not count.
    pub fn crossing(&self, next: &Self) -> Option<CurveCrossing> {
        // ln θ₁ + β₁ z = ln θ₂ + β₂ z
        let (shift, widening) = (libm::log(next.median / self.median), self.dispersion - next.dispersion);
        // within a rounding of a bound on which the ordered fit lies
        let crosses = shift < TAIL * widening.abs() * (1.0 - 1e-6);
        crosses.then(|| CurveCrossing {
            intensity: self.median * libm::exp(self.dispersion * (shift / widening).clamp(-TAIL, TAIL)),
            excess: self.excess(next, shift),
        })
    }

    /// Returns the most by which the probability of a later limit state is the larger one. There both
    /// densities are the same, with y = ln(x/θ₁) and s = ln(θ₂/θ₁):
    ///
    /// ```text
    /// (1/β₁² − 1/β₂²) y² + 2 (s/β₂²) y − s²/β₂² − 2 ln(β₂/β₁) = 0
    /// ```
    fn excess(&self, next: &Self, s: f64) -> f64 {
        let [own, other] = [self, next].map(|curve| curve.dispersion.powi(-2));
        let (a, b) = (own - other, s * other);
        let c = -s * s * other - 2.0 * libm::log(next.dispersion / self.dispersion);
        let q = -b - (b * b - a * c).max(0.0).sqrt().copysign(b);
        let difference = |y: f64| cumulative((y - s) / next.dispersion) - cumulative(y / self.dispersion);
        // a place that is not a number counts for nothing
        [q / a, c / q].map(difference).into_iter().fold(0.0, f64::max)
    }
}

/// Fits curves that do not cross: the constrained maximum of the likelihood.
///
/// Between the intensities at which one of a pair of curves has its 1e-4, and one of them its 1 − 1e-4, by
/// their own fits, the later curve must not lie above the earlier one. As z is linear in ln x, that is a
/// bound at both ends of the range, linear in a and c:
///
/// ```text
/// aᵢ y + cᵢ ≥ aᵢ₊₁ y + cᵢ₊₁
/// ```
/// ln L is concave in a and c, so that there is one maximum, which a logarithmic barrier finds: S. Boyd, L.
/// Vandenberghe: Convex optimization. Cambridge University Press, 2004, section 11.3.
fn ordered(states: &[&[Term]], own: &[Lognormal], weights: &[f64]) -> Vec<Lognormal> {
    let centres: Vec<f64> = own.iter().map(|curve| libm::log(curve.median)).collect();
    let bounds: Vec<(usize, f64)> = (1..own.len())
        .flat_map(|next| {
            let end = |sign: f64| {
                let z = sign * TAIL;
                let ends = [next - 1, next].map(|k| sign * (centres[k] + z * own[k].dispersion));
                (next, sign * ends[0].max(ends[1]))
            };
            [end(-1.0), end(1.0)]
        })
        .collect();
    let problem = Ordered { states, centres: &centres, bounds: &bounds };
    // parallel curves whose medians rise are within the bounds
    let a = own.len() as f64 / own.iter().map(|curve| curve.dispersion).sum::<f64>();
    let mut highest = f64::NEG_INFINITY;
    let mut point: Vec<f64> = Vec::new();
    for centre in &centres {
        highest = centre.max(highest + APART);
        point.extend([a, a * (centre - highest)]);
    }
    for weight in weights {
        problem.climb(&mut point, *weight);
    }
    let curve = |(at, centre): (&[f64], &f64)| Lognormal {
        median: libm::exp(centre - at[1] / at[0]),
        dispersion: 1.0 / at[0],
    };
    point.chunks(2).zip(&centres).map(curve).collect()
}

/// Limit states in rising order, and bounds between them.
struct Ordered<'a> {
    states: &'a [&'a [Term]],
    /// About where ln θ lies.
    centres: &'a [f64],
    /// Number of the later curve, and ln x.
    bounds: &'a [(usize, f64)],
}

impl Ordered<'_> {
    /// Moves to the maximum of ln L and of the logarithms of all distances from bounds, times a weight.
    fn climb(&self, point: &mut Vec<f64>, weight: f64) {
        for _ in 0..MOST_STEPS {
            let Some((value, gradient, mut curvature)) = self.value(point, weight) else { return };
            let Some(()) = cholesky(&mut curvature, 0.0) else { return };
            let mut step = gradient.clone();
            solve(&curvature, &mut step);
            let decrement: f64 = step.iter().zip(&gradient).map(|(step, slope)| step * slope).sum();
            let better = (0..MOST_HALVINGS).find_map(|halvings| {
                let part = 0.5_f64.powi(i32::try_from(halvings).unwrap_or(i32::MAX));
                let trial: Vec<f64> = point.iter().zip(&step).map(|(x, step)| x + part * step).collect();
                let there = self.value(&trial, weight)?.0;
                (there > value).then_some(trial)
            });
            let Some(better) = better else { return };
            *point = better;
            if decrement <= DECREMENT * weight {
                return;
            }
        }
    }

    /// Returns the value at a point, its gradient and its negative curvature; `None` beyond the bounds.
    fn value(&self, point: &[f64], weight: f64) -> Option<(f64, Vec<f64>, Vec<Vec<f64>>)> {
        let size = point.len();
        let (mut value, mut gradient, mut curvature) = (0.0, vec![0.0; size], vec![vec![0.0; size]; size]);
        for (state, terms) in self.states.iter().enumerate() {
            let at = [point[2 * state], point[2 * state + 1]];
            if at[0] <= 0.0 {
                return None;
            }
            let one = Likelihood::of(terms, self.centres[state], at);
            let [aa, ac, cc] = one.curvature;
            value += one.value;
            for (row, (slope, bend)) in one.gradient.into_iter().zip([[aa, ac], [ac, cc]]).enumerate() {
                gradient[2 * state + row] += slope;
                curvature[2 * state + row][2 * state..2 * state + 2].copy_from_slice(&bend);
            }
        }
        for &(next, y) in self.bounds {
            let first = 2 * (next - 1);
            let [before, after] = [next - 1, next].map(|state| y - self.centres[state]);
            let along = [before, 1.0, -after, -1.0];
            let distance: f64 = along.iter().zip(&point[first..]).map(|(slope, x)| slope * x).sum();
            if distance <= 0.0 {
                return None;
            }
            value += weight * libm::log(distance);
            for (row, slope) in along.iter().enumerate() {
                gradient[first + row] += weight / distance * slope;
                for (column, other) in along.iter().enumerate() {
                    curvature[first + row][first + column] += weight / (distance * distance) * slope * other;
                }
            }
        }
        value.is_finite().then_some((value, gradient, curvature))
    }
}
