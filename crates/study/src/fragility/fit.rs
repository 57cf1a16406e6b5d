//! The lognormal curve of greatest likelihood.

use super::Observation;
use super::normal::{cumulative, log_and_hazard};

/// A lognormal fragility.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lognormal {
    /// θ, in the unit of the intensities.
    pub median: f64,
    /// β, standard deviation of the logarithm \[-\].
    pub dispersion: f64,
}

impl Lognormal {
    /// Probability of exceedance at an intensity.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        cumulative(libm::log(intensity / self.median) / self.dispersion)
    }
}

/// Why there is no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// Nothing exceeds, or everything does.
    #[error("the demand is exceeded by no run or by all: raise or lower the levels")]
    OneSided,
    /// Likelihood grows without limit as β falls to 0.
    #[error(
        "one intensity parts all that exceed from all that do not: add records or levels for a dispersion"
    )]
    NoScatter,
    /// The likeliest curve does not rise.
    #[error("the demand is exceeded no more often at higher intensities: check the levels and counts")]
    Falling,
    /// An intensity that has no logarithm, or more exceedances than runs.
    #[error(
        "an observation is not one: intensities must be positive and finite, exceedances no more than runs"
    )]
    Observation,
}

/// Bound on Newton's steps and on halvings of one; ten and two are usual.
const MOST_STEPS: usize = 200;
const MOST_HALVINGS: usize = 60;
/// 1/β beyond which there is no scatter.
const STEEPEST: f64 = 1e5;
/// 1/β below which there is no rise.
const FLATTEST: f64 = 1e-3;
/// Newton's decrement, in units of the logarithm of the likelihood, at which one more step ends the search: it leaves an error
/// of about 1e-14 standard errors.
const DECREMENT: f64 = 1e-14;
/// Smallest β to start from.
const LEAST_SPREAD: f64 = 0.05;

/// Fits θ and β to observations by maximum likelihood.
///
/// With z = a ln x + c, a = 1/β, c = −a ln θ, the logarithm of the likelihood is concave in (a, c), for intensities, censored records
/// and stripes alike, so Newton's method with halved steps finds its one maximum:
///
/// ```text
/// At(x):      ln a − z²/2
/// Above(x):   ln Φ(−z)                                                                  Eq. (8)
/// Stripe:     k ln Φ(z) + (n − k) ln Φ(−z)                                             Eq. (11)
/// ```
///
/// Of intensities alone the maximum has a closed form, their mean and standard deviation.
///
/// # Errors
/// [`FitError`], if the observations do not determine a curve.
pub fn fit(observations: &[Observation]) -> Result<Lognormal, FitError> {
    fit_from(observations, None)
}

/// The same, from the curve of similar observations on.
pub(super) fn fit_from(observations: &[Observation], near: Option<Lognormal>) -> Result<Lognormal, FitError> {
    let terms = terms(observations)?;
    let (centre, spread) = start(&terms)?;
    if terms.iter().all(|term| matches!(term, Term::At(_))) {
        return Ok(Lognormal { median: libm::exp(centre), dispersion: spread });
    }
    let (centre, spread) =
        near.map_or((centre, spread.max(LEAST_SPREAD)), |near| (libm::log(near.median), near.dispersion));
    // logarithms of intensities about their centre, so that a and c are nearly independent
    let mut place = [1.0 / spread, 0.0];
    let mut now = likelihood(&terms, centre, place);
    for _ in 0..MOST_STEPS {
        let [[aa, ac], [_, cc]] = now.curvature;
        let determinant = aa * cc - ac * ac;
        if !(determinant > 0.0 && place[0] < STEEPEST) {
            return Err(FitError::NoScatter);
        }
        let [ga, gc] = now.gradient;
        // the curvature is that of −ln L, positive definite
        let step = [(cc * ga - ac * gc) / determinant, (aa * gc - ac * ga) / determinant];
        if step[0] * ga + step[1] * gc <= DECREMENT {
            place = [place[0] + step[0], place[1] + step[1]];
            break;
        }
        // no better place to rounding: this is it
        let Some((better, there)) = climb(&terms, centre, place, step, now.value) else { break };
        (place, now) = (better, there);
    }
    let [a, c] = place;
    if a >= STEEPEST {
        return Err(FitError::NoScatter);
    }
    if a <= FLATTEST {
        return Err(FitError::Falling);
    }
    Ok(Lognormal { median: libm::exp(centre - c / a), dispersion: 1.0 / a })
}

/// A step, halved until it leads upwards.
fn climb(
    terms: &[Term],
    centre: f64,
    [a, c]: [f64; 2],
    step: [f64; 2],
    value: f64,
) -> Option<([f64; 2], Likelihood)> {
    let mut part = 1.0;
    for _ in 0..MOST_HALVINGS {
        let trial = [a + part * step[0], c + part * step[1]];
        if trial[0] > 0.0 {
            let there = likelihood(terms, centre, trial);
            if there.value > value {
                return Some((trial, there));
            }
        }
        part *= 0.5;
    }
    None
}

/// A part of the likelihood at y = ln x.
#[derive(Clone, Copy)]
enum Term {
    At(f64),
    /// k ln Φ(z) + m ln Φ(−z).
    Counts {
        y: f64,
        exceeded: f64,
        standing: f64,
    },
}

fn terms(observations: &[Observation]) -> Result<Vec<Term>, FitError> {
    let logarithm = |x: f64| {
        if x > 0.0 && x.is_finite() { Ok(libm::log(x)) } else { Err(FitError::Observation) }
    };
    let term = |observation: &Observation| {
        Ok(match *observation {
            Observation::At(x) => Term::At(logarithm(x)?),
            Observation::Above(x) => Term::Counts { y: logarithm(x)?, exceeded: 0.0, standing: 1.0 },
            Observation::Stripe { intensity, runs, exceeded } => {
                let standing = runs.checked_sub(exceeded).ok_or(FitError::Observation)?;
                Term::Counts {
                    y: logarithm(intensity)?,
                    exceeded: f64::from(exceeded),
                    standing: f64::from(standing),
                }
            }
        })
    };
    observations.iter().map(term).collect()
}

/// Centre and spread of the logarithms to start from.
fn start(terms: &[Term]) -> Result<(f64, f64), FitError> {
    let weighted = terms.iter().map(|term| match *term {
        Term::At(y) => (y, 1.0, 1.0, 0.0),
        Term::Counts { y, exceeded, standing } => (y, exceeded + standing, exceeded, standing),
    });
    let (mut weight, mut sum) = (0.0, 0.0);
    // the range of what exceeds and of what does not
    let (mut lowest_exceeded, mut highest_standing) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut exact, mut different) = (None, false);
    for (y, n, exceeded, standing) in weighted {
        weight += n;
        sum += n * y;
        if exceeded > 0.0 {
            lowest_exceeded = lowest_exceeded.min(y);
        }
        if standing > 0.0 {
            highest_standing = highest_standing.max(y);
        }
    }
    for term in terms {
        if let Term::At(y) = *term {
            different |= exact.is_some_and(|other| other != y);
            exact = Some(y);
        }
    }
    if lowest_exceeded == f64::INFINITY || (exact.is_none() && highest_standing == f64::NEG_INFINITY) {
        return Err(FitError::OneSided);
    }
    // an exact intensity tells on both sides; two of them that differ, or an overlap, give a scatter
    let overlap = highest_standing > lowest_exceeded;
    if !different && !overlap {
        return Err(FitError::NoScatter);
    }
    let mean = sum / weight;
    let square = |term: &Term| match *term {
        Term::At(y) => (y - mean).powi(2),
        Term::Counts { y, exceeded, standing } => (exceeded + standing) * (y - mean).powi(2),
    };
    let variance = terms.iter().map(square).sum::<f64>() / weight;
    Ok((mean, variance.sqrt()))
}

struct Likelihood {
    /// ln L but for a constant.
    value: f64,
    gradient: [f64; 2],
    /// Second derivatives of −ln L.
    curvature: [[f64; 2]; 2],
}

fn likelihood(terms: &[Term], centre: f64, [a, c]: [f64; 2]) -> Likelihood {
    let (mut value, mut gradient, mut curvature) = (0.0, [0.0; 2], [[0.0; 2]; 2]);
    for term in terms {
        // value and derivatives with respect to z
        let (y, l, d, dd) = match *term {
            Term::At(y) => {
                let z = a * (y - centre) + c;
                gradient[0] += 1.0 / a;
                curvature[0][0] += 1.0 / (a * a);
                (y, libm::log(a) - 0.5 * z * z, -z, -1.0)
            }
            Term::Counts { y, exceeded, standing } => {
                let z = a * (y - centre) + c;
                let (mut l, mut d, mut dd) = (0.0, 0.0, 0.0);
                // nothing of a side without runs: 0 · ∞ is not 0
                if exceeded > 0.0 {
                    let (log, h) = log_and_hazard(z);
                    (l, d, dd) = (exceeded * log, exceeded * h, -exceeded * h * (h + z));
                }
                if standing > 0.0 {
                    let (log, h) = log_and_hazard(-z);
                    l += standing * log;
                    d -= standing * h;
                    dd -= standing * h * (h - z);
                }
                (y, l, d, dd)
            }
        };
        let y = y - centre;
        value += l;
        gradient[0] += d * y;
        gradient[1] += d;
        curvature[0][0] -= dd * y * y;
        curvature[0][1] -= dd * y;
        curvature[1][0] -= dd * y;
        curvature[1][1] -= dd;
    }
    Likelihood { value, gradient, curvature }
}
