//! Lognormal curve of maximum likelihood.

use run::bisection::first_true;

use super::normal::cumulative;
use super::observation::Observation;
use super::term::{Likelihood, Term};

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
    /// let curve = study::fragility::Lognormal { median: 2.0, dispersion: 0.5 };
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
    /// An intensity that has no logarithm, or more exceedances than runs.
    #[error(
        "an observation is invalid: intensities must be positive and finite, exceedances no more than runs"
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

/// Fits θ and β of one limit state by maximum likelihood.
///
/// # Errors
/// [`FitError`] if the observations do not determine a curve.
pub fn fit(observations: &[Observation]) -> Result<Lognormal, FitError> {
    fit_jointly(&[observations.to_vec()]).pop().unwrap_or(Err(FitError::OneSided))
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
/// Stripe:          k ln Φ(z) + (n − k) ln Φ(−z)                                        Eq. (11)
/// ```
///
/// For exact intensities alone the maximum has a closed form: their means and their pooled standard
/// deviation. A limit state whose observations determine no median has an error and leaves the others alone.
pub fn fit_jointly(states: &[Vec<Observation>]) -> Vec<Result<Lognormal, FitError>> {
    let states: Vec<_> = states.iter().map(|state| terms(state)).collect();
    let states: Vec<_> = states.iter().map(|terms| terms.as_deref().map_err(|error| *error)).collect();
    fit_from(&states, &[])
}

/// Returns the terms of the likelihood of observations.
pub(super) fn terms(observations: &[Observation]) -> Result<Vec<Term>, FitError> {
    observations.iter().try_fold(Vec::new(), |mut terms, observation| {
        terms.extend(Term::of(observation)?);
        Ok(terms)
    })
}

/// Fits as [`fit_jointly`] does, starting from the curves of similar observations.
pub(super) fn fit_from(
    states: &[Result<&[Term], FitError>],
    near: &[Result<Lognormal, FitError>],
) -> Vec<Result<Lognormal, FitError>> {
    let mut states: Vec<Result<State<'_>, FitError>> =
        states.iter().map(|terms| State::new((*terms)?)).collect();
    let usable: Vec<&mut State<'_>> = states.iter_mut().flatten().collect();
    let fitted = maximum(usable, near);
    let mut medians = fitted.iter().flat_map(|(logarithms, _)| logarithms);
    let curve = |state: &Result<State<'_>, FitError>| {
        state.as_ref().map_err(|error| *error)?;
        let dispersion = fitted.as_ref().map_err(|error| *error)?.1;
        let median = medians.next().map_or(f64::NAN, |logarithm| libm::exp(*logarithm));
        Ok(Lognormal { median, dispersion })
    };
    states.iter().map(curve).collect()
}

/// Returns ln θ of each limit state, and the common β.
fn maximum(
    mut states: Vec<&mut State<'_>>,
    near: &[Result<Lognormal, FitError>],
) -> Result<(Vec<f64>, f64), FitError> {
    let sum = |part: fn(&State<'_>) -> f64| states.iter().map(|state| part(state)).sum::<f64>();
    let spread = (sum(|state| state.squares) / sum(|state| state.weight)).sqrt();
    if !states.iter().any(|state| state.scatters) {
        return Err(FitError::NoScatter);
    }
    if states.iter().all(|state| state.terms.iter().all(Term::is_exact)) {
        return Ok((states.iter().map(|state| state.centre).collect(), spread));
    }
    let mut spread = spread.max(LEAST_SPREAD);
    let known: Vec<&Lognormal> = near.iter().flatten().collect();
    if known.len() == states.len() {
        for (state, near) in states.iter_mut().zip(known) {
            (state.centre, spread) = (libm::log(near.median), near.dispersion);
        }
    }
    // logarithms of intensities about their centres, so that a and c are nearly independent
    let mut point = Point { a: 1.0 / spread, c: vec![0.0; states.len()] };
    let mut now = likelihood(&states, &point);
    for _ in 0..MOST_STEPS {
        let (step, decrement) =
            newton_step(&now.1).filter(|_| point.a < STEEPEST).ok_or(FitError::NoScatter)?;
        if decrement <= DECREMENT {
            point = point.moved(&step, 1.0);
            break;
        }
        // where no step raises ln L by more than rounding, this point is the maximum
        let Some((better, there)) = climb(&states, &point, &step, now.0) else { break };
        (point, now) = (better, there);
    }
    if point.a >= STEEPEST {
        return Err(FitError::NoScatter);
    }
    if point.a <= FLATTEST {
        return Err(FitError::Falling);
    }
    let medians = states.iter().zip(&point.c).map(|(state, c)| state.centre - c / point.a);
    Ok((medians.collect(), 1.0 / point.a))
}

/// Halves a step until it raises the likelihood.
fn climb(
    states: &[&mut State<'_>],
    from: &Point,
    step: &Point,
    value: f64,
) -> Option<(Point, (f64, Vec<Likelihood>))> {
    let mut part = 1.0;
    for _ in 0..MOST_HALVINGS {
        let trial = from.moved(step, part);
        if trial.a > 0.0 {
            let there = likelihood(states, &trial);
            if there.0 > value {
                return Some((trial, there));
            }
        }
        part *= 0.5;
    }
    None
}

/// Computes ln L of a curve under terms, without its constant.
pub(super) fn log_likelihood(terms: &[Term], curve: &Lognormal) -> f64 {
    Likelihood::of(terms, libm::log(curve.median), [1.0 / curve.dispersion, 0.0]).value
}

/// The observations of one limit state.
struct State<'a> {
    terms: &'a [Term],
    /// About where ln θ lies: at first the mean of the logarithms.
    centre: f64,
    /// Sum of the squares of the logarithms about their mean.
    squares: f64,
    /// Number of runs.
    weight: f64,
    /// Whether the observations bound β from below.
    scatters: bool,
}

impl<'a> State<'a> {
    fn new(terms: &'a [Term]) -> Result<Self, FitError> {
        let least_end = terms.iter().map(|term| term.between[1]).fold(f64::INFINITY, f64::min);
        let last_start = terms.iter().map(|term| term.between[0]).fold(f64::NEG_INFINITY, f64::max);
        if least_end == f64::INFINITY || last_start == f64::NEG_INFINITY {
            return Err(FitError::OneSided);
        }
        // no intensity may be in all intervals; an exact one counts on both sides
        let scatters = last_start > least_end;
        let weight: f64 = terms.iter().map(|term| term.runs).sum();
        let centre = terms.iter().map(|term| term.runs * term.middle()).sum::<f64>() / weight;
        let squares = terms.iter().map(|term| term.runs * (term.middle() - centre).powi(2)).sum();
        Ok(Self { terms, centre, squares, weight, scatters })
    }
}

/// Parameters of the curves: a = 1/β, and c of each limit state.
struct Point {
    a: f64,
    c: Vec<f64>,
}

impl Point {
    /// Returns this point, moved by a part of a step.
    fn moved(&self, step: &Self, part: f64) -> Self {
        let c = self.c.iter().zip(&step.c).map(|(c, step)| c + part * step).collect();
        Self { a: self.a + part * step.a, c }
    }
}

/// Returns ln L at a point, and the likelihood of each limit state.
fn likelihood(states: &[&mut State<'_>], point: &Point) -> (f64, Vec<Likelihood>) {
    let of = |(state, c): (&&mut State<'_>, &f64)| Likelihood::of(state.terms, state.centre, [point.a, *c]);
    let all: Vec<_> = states.iter().zip(&point.c).map(of).collect();
    (all.iter().map(|state| state.value).sum(), all)
}

/// Returns Newton's step and its decrement; none where the curvature is not positive definite.
///
/// The limit states share nothing but a, so their c are eliminated first.
fn newton_step(states: &[Likelihood]) -> Option<(Point, f64)> {
    let (mut gradient, mut curvature) = (0.0, 0.0);
    for Likelihood { gradient: [ga, gc], curvature: [aa, ac, cc], .. } in states {
        gradient += ga - ac * gc / cc;
        curvature += aa - ac * ac / cc;
    }
    let definite = curvature > 0.0 && states.iter().all(|state| state.curvature[2] > 0.0);
    let a = gradient / curvature;
    let c = states.iter().map(|state| (state.gradient[1] - state.curvature[1] * a) / state.curvature[2]);
    let c: Vec<f64> = c.collect();
    let along = |(state, c): (&Likelihood, &f64)| a * state.gradient[0] + c * state.gradient[1];
    let decrement = states.iter().zip(&c).map(along).sum();
    definite.then_some((Point { a, c }, decrement))
}
