//! Lognormal curve of maximum likelihood.

use super::normal::{cumulative, log_and_hazard};
use super::observation::Observation;

/// A lognormal fragility.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lognormal {
    /// Median θ, in the unit of the intensities.
    pub median: f64,
    /// Dispersion β, the standard deviation of the logarithm \[-\].
    pub dispersion: f64,
}

impl Lognormal {
    /// Returns the probability of exceedance at an intensity.
    #[must_use]
    pub fn probability(&self, intensity: f64) -> f64 {
        cumulative(libm::log(intensity / self.median) / self.dispersion)
    }
}

/// Why there is no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FitError {
    /// No run exceeds, or every run does.
    #[error("the demand is exceeded by no run or by all: raise or lower the levels")]
    OneSided,
    /// The likelihood grows without limit as β falls to 0.
    #[error(
        "one intensity parts all that exceed from all that do not: add records or levels for a dispersion"
    )]
    NoScatter,
    /// The curve of maximum likelihood does not rise.
    #[error("the demand is exceeded no more often at higher intensities: check the levels and counts")]
    Falling,
    /// An intensity that has no logarithm, or more exceedances than runs.
    #[error(
        "an observation is not one: intensities must be positive and finite, exceedances no more than runs"
    )]
    Observation,
}

/// Bounds on Newton's steps and on halvings of one; ten and two are usual.
const MOST_STEPS: usize = 200;
const MOST_HALVINGS: usize = 60;
/// 1/β above which there is no scatter.
const STEEPEST: f64 = 1e5;
/// 1/β below which there is no rise.
const FLATTEST: f64 = 1e-3;
/// Newton's decrement, in units of ln L, at which the next step is the last: it leaves an error of about
/// 1e-14 standard errors.
const DECREMENT: f64 = 1e-14;
/// Smallest β to start from.
const LEAST_SPREAD: f64 = 0.05;

/// Fits θ and β to observations by maximum likelihood.
///
/// With z = a ln x + c, a = 1/β, c = −a ln θ, the logarithm of the likelihood is concave in (a, c) for exact
/// intensities, censored records and stripes alike. Newton's method with halved steps finds its only maximum:
///
/// ```text
/// At(x):      ln a − z²/2
/// Above(x):   ln Φ(−z)                                                                  Eq. (8)
/// Stripe:     k ln Φ(z) + (n − k) ln Φ(−z)                                             Eq. (11)
/// ```
///
/// For exact intensities alone the maximum has a closed form: their mean and standard deviation.
///
/// # Errors
/// [`FitError`] if the observations do not determine a curve.
pub fn fit(observations: &[Observation]) -> Result<Lognormal, FitError> {
    fit_from(observations, None)
}

/// Fits as [`fit`] does, starting from the curve of similar observations.
pub(super) fn fit_from(observations: &[Observation], near: Option<Lognormal>) -> Result<Lognormal, FitError> {
    let terms: Vec<Term> = observations.iter().map(Term::new).collect::<Result<_, _>>()?;
    let (centre, spread) = start(&terms)?;
    if terms.iter().all(|term| term.exact) {
        return Ok(Lognormal { median: libm::exp(centre), dispersion: spread });
    }
    let (centre, spread) =
        near.map_or((centre, spread.max(LEAST_SPREAD)), |near| (libm::log(near.median), near.dispersion));
    // logarithms of intensities about their centre, so that a and c are nearly independent
    let mut point = [1.0 / spread, 0.0];
    let mut now = likelihood(&terms, centre, point);
    for _ in 0..MOST_STEPS {
        let [[aa, ac], [_, cc]] = now.curvature;
        let determinant = aa * cc - ac * ac;
        if !(determinant > 0.0 && point[0] < STEEPEST) {
            return Err(FitError::NoScatter);
        }
        let [ga, gc] = now.gradient;
        // the curvature is that of −ln L, positive definite
        let step = [(cc * ga - ac * gc) / determinant, (aa * gc - ac * ga) / determinant];
        if step[0] * ga + step[1] * gc <= DECREMENT {
            point = [point[0] + step[0], point[1] + step[1]];
            break;
        }
        // where no step improves on the rounding, this is the maximum
        let Some((better, there)) = climb(&terms, centre, point, step, now.value) else { break };
        (point, now) = (better, there);
    }
    let [a, c] = point;
    if a >= STEEPEST {
        return Err(FitError::NoScatter);
    }
    if a <= FLATTEST {
        return Err(FitError::Falling);
    }
    Ok(Lognormal { median: libm::exp(centre - c / a), dispersion: 1.0 / a })
}

/// Halves a step until it raises the likelihood.
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

/// Term of ln L: k ln Φ(z) + m ln Φ(−z), or ln a − z²/2 of an exact intensity.
#[derive(Clone, Copy)]
struct Term {
    /// y = ln x.
    y: f64,
    /// k; 1 of an exact intensity.
    exceeded: f64,
    /// m; 0 of an exact intensity.
    not_exceeded: f64,
    exact: bool,
}

impl Term {
    fn new(observation: &Observation) -> Result<Self, FitError> {
        let (x, exceeded, not_exceeded, exact) = match *observation {
            Observation::At(x) => (x, 1, 0, true),
            Observation::Above(x) => (x, 0, 1, false),
            Observation::Stripe { intensity, runs, exceeded } => {
                (intensity, exceeded, runs.checked_sub(exceeded).ok_or(FitError::Observation)?, false)
            }
        };
        if !(x > 0.0 && x.is_finite()) {
            return Err(FitError::Observation);
        }
        Ok(Self { y: libm::log(x), exceeded: exceeded.into(), not_exceeded: not_exceeded.into(), exact })
    }

    fn runs(&self) -> f64 {
        self.exceeded + self.not_exceeded
    }
}

/// Returns mean and standard deviation of the logarithms, to start from.
fn start(terms: &[Term]) -> Result<(f64, f64), FitError> {
    let exceeded = terms.iter().filter(|term| term.exceeded > 0.0).map(|term| term.y);
    let not_exceeded = terms.iter().filter(|term| term.not_exceeded > 0.0).map(|term| term.y);
    let lowest_exceeded = exceeded.fold(f64::INFINITY, f64::min);
    let highest_not_exceeded = not_exceeded.fold(f64::NEG_INFINITY, f64::max);
    let exact: Vec<f64> = terms.iter().filter(|term| term.exact).map(|term| term.y).collect();
    if lowest_exceeded == f64::INFINITY || (exact.is_empty() && highest_not_exceeded == f64::NEG_INFINITY) {
        return Err(FitError::OneSided);
    }
    // an exact intensity counts on both sides; an overlap, or two of them that differ, give a scatter
    if exact.iter().all(|y| *y == exact[0]) && highest_not_exceeded <= lowest_exceeded {
        return Err(FitError::NoScatter);
    }
    let weight: f64 = terms.iter().map(Term::runs).sum();
    let mean = terms.iter().map(|term| term.runs() * term.y).sum::<f64>() / weight;
    let squares: f64 = terms.iter().map(|term| term.runs() * (term.y - mean).powi(2)).sum();
    Ok((mean, (squares / weight).sqrt()))
}

/// The likelihood L at some (a, c).
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
        let y = term.y - centre;
        let z = a * y + c;
        // value and derivatives with respect to z; those of ln a are with respect to a
        let (mut l, mut d, mut dd) = (0.0, 0.0, 0.0);
        if term.exact {
            gradient[0] += 1.0 / a;
            curvature[0][0] += 1.0 / (a * a);
            (l, d, dd) = (libm::log(a) - 0.5 * z * z, -z, -1.0);
        } else {
            // a side without runs counts nothing, although 0 · ∞ is not 0
            if term.exceeded > 0.0 {
                let (log, h) = log_and_hazard(z);
                (l, d, dd) = (term.exceeded * log, term.exceeded * h, -term.exceeded * h * (h + z));
            }
            if term.not_exceeded > 0.0 {
                let (log, h) = log_and_hazard(-z);
                l += term.not_exceeded * log;
                d -= term.not_exceeded * h;
                dd -= term.not_exceeded * h * (h - z);
            }
        }
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
