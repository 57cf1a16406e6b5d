//! Lognormal curve of maximum likelihood.

use run::bisection::first_true;

use crate::normal::cumulative;
use crate::sample::Sample;
use crate::term::{Likelihood, Term};

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
    pub fn probability(&self, intensity: f64) -> f64 {
        cumulative(libm::log(intensity / self.median) / self.dispersion)
    }

    /// Returns the intensity at which the probability of exceedance is that given, between 0 and 1.
    ///
    /// ```
    /// let curve = fragility::Lognormal { median: 2.0, dispersion: 0.5 };
    /// assert!((curve.probability(curve.intensity(0.1)) - 0.1).abs() < 1e-12);
    /// ```
    pub fn intensity(&self, probability: f64) -> f64 {
        // Φ is 0 and 1 at the ends in doubles
        let reaches = |z: f64| Ok::<_, std::convert::Infallible>(cumulative(z) >= probability);
        let Ok(z) = first_true([-40.0, 40.0], 64, reaches);
        self.median * libm::exp(self.dispersion * z)
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
        "one intensity separates all that exceed from all that do not: add records or levels for a scatter"
    )]
    NoScatter,
    /// The curve of maximum likelihood does not rise.
    #[error(
        "the demand is not exceeded more often at higher intensities: check the levels, or the scale of a \
         cloud"
    )]
    Falling,
    /// The demands of a cloud have no regression.
    #[error(
        "fewer than three walls stand at different intensities, or their demands do not scatter: add \
         records, or change the scale"
    )]
    Cloud,
    /// An intensity that has no logarithm, or two levels that fall.
    #[error("an exceedance is invalid: its intensity must be positive and finite, two levels must rise")]
    Exceedance,
}

/// Bounds on Newton's steps and on halvings of one; ten and two are usual.
const MOST_STEPS: usize = 200;
const MOST_HALVINGS: usize = 60;
/// 1/β above which there is no scatter.
const STEEPEST: f64 = 1e5;
/// 1/β below which there is no rise.
const FLATTEST: f64 = 1e-3;
/// Newton's decrement, in units of ln L, at which the next step is the last: it leaves an error of about
/// this many standard errors.
const DECREMENT: f64 = 1e-14;
/// The same of a resample, of which only fractiles are wanted.
const DECREMENT_OF_RESAMPLE: f64 = 1e-10;
/// Newton's decrement below which a whole step is sure to be better: rounding would hide by how much.
const SURE: f64 = 1e-6;
/// Smallest β to start from.
const LEAST_SPREAD: f64 = 0.05;

/// Fits θ and β of one limit state by maximum likelihood.
///
/// # Errors
/// [`FitError`] if the sample does not determine a curve.
pub fn fit(sample: &Sample) -> Result<Lognormal, FitError> {
    fit_jointly(std::slice::from_ref(sample)).remove(0)
}

/// Fits the curves of several limit states of the same runs by maximum likelihood, with one β for all.
///
/// Curves with a common β never cross. Their medians rise with the limit states, since each run that exceeds
/// one exceeds those below it as well. M. Shinozuka, M. Q. Feng, H. Kim, T. Uzawa, T. Ueda: Statistical
/// analysis of fragility curves. Report MCEER-03-0002, 2003.
///
/// With z = a ln x + c, a = 1/β, c = −a ln θ, the logarithm of the likelihood is concave in a and all c, for
/// exact intensities, intervals, censored records and stripes alike: each is an integral of a density with a
/// concave logarithm (A. Prékopa: Acta Scientiarum Mathematicarum 34, 1973, 335–343). Newton's method with
/// halved steps finds its only maximum:
///
/// ```text
/// At(x):           ln a − z²/2
/// Between(x₁, x₂): ln(Φ(z₂) − Φ(z₁))
/// Above(x):        ln Φ(−z)                                                             Eq. (8)
/// of n runs at x, k exceed:  k ln Φ(z) + (n − k) ln Φ(−z)                              Eq. (11)
/// ```
///
/// For exact intensities alone the maximum has a closed form: their means and their pooled standard
/// deviation. A limit state whose sample determines no median has an error and leaves the others alone.
pub fn fit_jointly(states: &[Sample]) -> Vec<Result<Lognormal, FitError>> {
    fit_from(&states.iter().map(Sample::terms).collect::<Vec<_>>(), &[])
}

/// Fits as [`fit_jointly`] does, starting from the curves of similar samples, if there are some.
pub(crate) fn fit_from(
    states: &[impl AsRef<[Term]>],
    near: &[Result<Lognormal, FitError>],
) -> Vec<Result<Lognormal, FitError>> {
    let mut states: Vec<_> = states.iter().map(|terms| State::new(terms.as_ref())).collect();
    let a = maximum(&mut states, near);
    states.into_iter().map(|state| Ok(state?.curve(a?))).collect()
}

/// Returns a = 1/β of the maximum, and stores c in each limit state.
fn maximum(
    states: &mut [Result<State<'_>, FitError>],
    near: &[Result<Lognormal, FitError>],
) -> Result<f64, FitError> {
    let usable = || states.iter().flatten();
    let sum = |part: fn(&State<'_>) -> f64| usable().map(part).sum::<f64>();
    let spread = (sum(|state| state.squares) / sum(|state| state.weight)).sqrt();
    if !usable().any(|state| state.scatters) {
        return Err(FitError::NoScatter);
    }
    let mut terms = usable().flat_map(|state| state.terms);
    if terms.clone().all(Term::is_exact) {
        return Ok(1.0 / spread);
    }
    let mut a = 1.0 / spread.max(LEAST_SPREAD);
    // the midpoints of narrow intervals are a better start than other samples
    let is_known = usable().count() == near.iter().flatten().count();
    if is_known && !terms.all(Term::is_bounded) {
        for (state, near) in states.iter_mut().flatten().zip(near.iter().flatten()) {
            (state.centre, a) = (libm::log(near.median), 1.0 / near.dispersion);
        }
    }
    let last = if near.is_empty() { DECREMENT } else { DECREMENT_OF_RESAMPLE };
    let mut value = likelihood(states, a, [0.0, 0.0]);
    for _ in 0..MOST_STEPS {
        if a >= STEEPEST {
            return Err(FitError::NoScatter);
        }
        let (step, decrement) = newton_step(states).ok_or(FitError::NoScatter)?;
        if decrement <= last {
            a += step;
            states.iter_mut().flatten().for_each(|state| state.c += state.step);
            break;
        }
        let climbed = if decrement <= SURE && a + step > 0.0 {
            Some((1.0, likelihood(states, a, [step, 1.0])))
        } else {
            climb(states, [a, step], value)
        };
        // where no step raises ln L by more than rounding, this point is the maximum
        let Some((part, better)) = climbed else { break };
        (a, value) = (a + part * step, better);
        states.iter_mut().flatten().for_each(|state| state.c += part * state.step);
    }
    if a >= STEEPEST {
        return Err(FitError::NoScatter);
    }
    if a <= FLATTEST {
        return Err(FitError::Falling);
    }
    Ok(a)
}

/// Halves a step until it raises the likelihood; returns its part, and ln L there.
fn climb(states: &mut [Result<State<'_>, FitError>], [a, step]: [f64; 2], value: f64) -> Option<(f64, f64)> {
    let mut part = 1.0;
    for _ in 0..MOST_HALVINGS {
        if a + part * step > 0.0 {
            let there = likelihood(states, a, [step, part]);
            if there > value {
                return Some((part, there));
            }
        }
        part *= 0.5;
    }
    None
}

/// Computes ln L of a curve under terms, without its constant.
pub(crate) fn log_likelihood(terms: &[Term], curve: &Lognormal) -> f64 {
    Likelihood::of(terms, libm::log(curve.median), [1.0 / curve.dispersion, 0.0]).value
}

/// The sample of one limit state.
struct State<'a> {
    terms: &'a [Term],
    /// About where ln θ lies: at first the mean of the logarithms.
    centre: f64,
    /// Sum of the squares of the logarithms about their mean, about as of exact intensities.
    squares: f64,
    /// Number of runs.
    weight: f64,
    /// Whether the sample bounds β from below.
    scatters: bool,
    /// Parameter of its curve. Logarithms of intensities are about their centre, so that a and c are nearly
    /// independent.
    c: f64,
    /// Newton's step of c.
    step: f64,
    /// The likelihood where it was computed last.
    likelihood: Likelihood,
}

impl<'a> State<'a> {
    fn new(terms: &'a [Term]) -> Result<Self, FitError> {
        let has_logarithms =
            |[from, to]: [f64; 2]| from <= to && from < f64::INFINITY && to > f64::NEG_INFINITY;
        if !terms.iter().all(|term| has_logarithms(term.between)) {
            return Err(FitError::Exceedance);
        }
        let least_end = terms.iter().map(|term| term.between[1]).fold(f64::INFINITY, f64::min);
        let last_start = terms.iter().map(|term| term.between[0]).fold(f64::NEG_INFINITY, f64::max);
        if least_end == f64::INFINITY || last_start == f64::NEG_INFINITY {
            return Err(FitError::OneSided);
        }
        // no intensity may be in all intervals; an exact one counts on both sides
        let scatters = last_start > least_end;
        let weight: f64 = terms.iter().map(|term| term.runs).sum();
        let centre = terms.iter().map(|term| term.runs * term.middle()).sum::<f64>() / weight;
        // W. F. Sheppard: the variance of midpoints is larger than that of values by a twelfth of width²
        let square =
            |term: &Term| term.runs * ((term.middle() - centre).powi(2) - term.width().powi(2) / 12.0);
        let squares = terms.iter().map(square).sum();
        let (c, step, likelihood) = (0.0, 0.0, Likelihood::default());
        Ok(Self { terms, centre, squares, weight, scatters, c, step, likelihood })
    }

    /// Returns its curve with a.
    fn curve(&self, a: f64) -> Lognormal {
        Lognormal { median: libm::exp(self.centre - self.c / a), dispersion: 1.0 / a }
    }
}

/// Computes the likelihood of each limit state at a part of Newton's step; returns ln L of all.
fn likelihood(states: &mut [Result<State<'_>, FitError>], a: f64, [step, part]: [f64; 2]) -> f64 {
    let of = |state: &mut State<'_>| {
        let at = [a + part * step, state.c + part * state.step];
        state.likelihood = Likelihood::of(state.terms, state.centre, at);
        state.likelihood.value
    };
    states.iter_mut().flatten().map(of).sum()
}

/// Leaves Newton's step of c in each limit state; returns that of a, and the decrement. `None` where the
/// curvature is not positive definite.
///
/// The limit states share nothing but a, so their c are eliminated first.
fn newton_step(states: &mut [Result<State<'_>, FitError>]) -> Option<(f64, f64)> {
    let (mut gradient, mut curvature, mut is_definite) = (0.0, 0.0, true);
    for State { likelihood: Likelihood { gradient: [ga, gc], curvature: [aa, ac, cc], .. }, .. } in
        states.iter().flatten()
    {
        gradient += ga - ac * gc / cc;
        curvature += aa - ac * ac / cc;
        is_definite &= *cc > 0.0;
    }
    let (a, mut decrement) = (gradient / curvature, 0.0);
    for state in states.iter_mut().flatten() {
        let Likelihood { gradient: [ga, gc], curvature: [_, ac, cc], .. } = state.likelihood;
        state.step = (gc - ac * a) / cc;
        decrement += a * ga + state.step * gc;
    }
    (is_definite && curvature > 0.0).then_some((a, decrement))
}
