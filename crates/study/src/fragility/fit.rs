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
        "one intensity separates all that exceed from all that do not: add records or levels for a scatter"
    )]
    NoScatter,
    /// The curve of maximum likelihood does not rise.
    #[error("the demand is not exceeded more often at higher intensities: check the levels and counts")]
    Falling,
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
/// exact intensities, censored records and stripes alike. Newton's method with halved steps finds its only
/// maximum:
///
/// ```text
/// At(x):      ln a − z²/2
/// Above(x):   ln Φ(−z)                                                                  Eq. (8)
/// Stripe:     k ln Φ(z) + (n − k) ln Φ(−z)                                             Eq. (11)
/// ```
///
/// For exact intensities alone the maximum has a closed form: their means and their pooled standard
/// deviation. A limit state whose observations determine no median has an error and leaves the others alone.
pub fn fit_jointly(states: &[Vec<Observation>]) -> Vec<Result<Lognormal, FitError>> {
    fit_from(states, &[])
}

/// Fits as [`fit_jointly`] does, starting from the curves of similar observations.
pub(super) fn fit_from(
    states: &[Vec<Observation>],
    near: &[Result<Lognormal, FitError>],
) -> Vec<Result<Lognormal, FitError>> {
    let mut states: Vec<Result<State, FitError>> =
        states.iter().map(|observations| State::new(observations)).collect();
    let usable: Vec<&mut State> = states.iter_mut().flatten().collect();
    let fitted = maximum(usable, near);
    let mut medians = fitted.iter().flat_map(|(logarithms, _)| logarithms);
    let curve = |state: &Result<State, FitError>| {
        state.as_ref().map_err(|error| *error)?;
        let dispersion = fitted.as_ref().map_err(|error| *error)?.1;
        let median = medians.next().map_or(f64::NAN, |logarithm| libm::exp(*logarithm));
        Ok(Lognormal { median, dispersion })
    };
    states.iter().map(curve).collect()
}

/// Returns ln θ of each limit state, and the common β.
fn maximum(
    mut states: Vec<&mut State>,
    near: &[Result<Lognormal, FitError>],
) -> Result<(Vec<f64>, f64), FitError> {
    let sum = |part: fn(&State) -> f64| states.iter().map(|state| part(state)).sum::<f64>();
    let spread = (sum(|state| state.squares) / sum(|state| state.weight)).sqrt();
    if !states.iter().any(|state| state.scatters) {
        return Err(FitError::NoScatter);
    }
    if states.iter().all(|state| state.terms.iter().all(|term| term.exact)) {
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
            now.newton_step().filter(|_| point.a < STEEPEST).ok_or(FitError::NoScatter)?;
        if decrement <= DECREMENT {
            point = point.moved(&step, 1.0);
            break;
        }
        // where no step raises ln L by more than rounding, this point is the maximum
        let Some((better, there)) = climb(&states, &point, &step, now.value) else { break };
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
fn climb(states: &[&mut State], from: &Point, step: &Point, value: f64) -> Option<(Point, Likelihood)> {
    let mut part = 1.0;
    for _ in 0..MOST_HALVINGS {
        let trial = from.moved(step, part);
        if trial.a > 0.0 {
            let there = likelihood(states, &trial);
            if there.value > value {
                return Some((trial, there));
            }
        }
        part *= 0.5;
    }
    None
}

/// Bounds of the θ that observations leave open: `[0, x]` if all exceed from x on, `[x, ∞]` if none exceeds
/// up to x, and the gap between the two where one intensity parts them.
pub(super) fn open_bounds(observations: &[Observation]) -> [f64; 2] {
    let [mut least, mut most] = [0.0, f64::INFINITY];
    for term in observations.iter().filter_map(|observation| Term::new(observation).ok()) {
        if term.exact || term.not_exceeded > 0.0 {
            least = f64::max(least, libm::exp(term.y));
        }
        if term.exceeded > 0.0 {
            most = f64::min(most, libm::exp(term.y));
        }
    }
    [least, most.max(least)]
}

/// Computes ln L of a curve under observations, without its constant.
pub(super) fn log_likelihood(observations: &[Observation], curve: &Lognormal) -> f64 {
    let Ok(mut state) = State::new(observations) else { return 0.0 };
    state.centre = libm::log(curve.median);
    likelihood(&[&mut state], &Point { a: 1.0 / curve.dispersion, c: vec![0.0] }).value
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

    /// Returns the term and its derivatives with respect to z; those of ln a are with respect to a.
    fn derivatives(&self, a: f64, z: f64) -> [f64; 3] {
        if self.exact {
            return [libm::log(a) - 0.5 * z * z, -z, -1.0];
        }
        let (mut l, mut d, mut dd) = (0.0, 0.0, 0.0);
        // a side without runs adds nothing, but 0 · ∞ would be NaN
        if self.exceeded > 0.0 {
            let (log, h) = log_and_hazard(z);
            (l, d, dd) = (self.exceeded * log, self.exceeded * h, -self.exceeded * h * (h + z));
        }
        if self.not_exceeded > 0.0 {
            let (log, h) = log_and_hazard(-z);
            l += self.not_exceeded * log;
            d -= self.not_exceeded * h;
            dd -= self.not_exceeded * h * (h - z);
        }
        [l, d, dd]
    }
}

/// The observations of one limit state.
struct State {
    terms: Vec<Term>,
    /// About where ln θ lies: at first the mean of the logarithms.
    centre: f64,
    /// Sum of the squares of the logarithms about their mean.
    squares: f64,
    /// Number of runs.
    weight: f64,
    /// Whether the observations bound β from below.
    scatters: bool,
}

impl State {
    fn new(observations: &[Observation]) -> Result<Self, FitError> {
        let terms: Vec<Term> = observations.iter().map(Term::new).collect::<Result<_, _>>()?;
        let exceeded = terms.iter().filter(|term| term.exceeded > 0.0).map(|term| term.y);
        let not_exceeded = terms.iter().filter(|term| term.not_exceeded > 0.0).map(|term| term.y);
        let lowest_exceeded = exceeded.fold(f64::INFINITY, f64::min);
        let highest_not_exceeded = not_exceeded.fold(f64::NEG_INFINITY, f64::max);
        let exact: Vec<f64> = terms.iter().filter(|term| term.exact).map(|term| term.y).collect();
        if lowest_exceeded == f64::INFINITY || (exact.is_empty() && highest_not_exceeded == f64::NEG_INFINITY)
        {
            return Err(FitError::OneSided);
        }
        // an exact intensity counts on both sides; an overlap, or two of them that differ, give a scatter
        let scatters = exact.iter().any(|y| *y != exact[0]) || highest_not_exceeded > lowest_exceeded;
        let weight: f64 = terms.iter().map(Term::runs).sum();
        let centre = terms.iter().map(|term| term.runs() * term.y).sum::<f64>() / weight;
        let squares = terms.iter().map(|term| term.runs() * (term.y - centre).powi(2)).sum();
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

/// The likelihood L at some point.
struct Likelihood {
    /// ln L without its constant.
    value: f64,
    /// ∂ ln L/∂a and −∂² ln L/∂a².
    along_a: [f64; 2],
    /// ∂ ln L/∂c, −∂² ln L/∂a∂c and −∂² ln L/∂c² of each limit state.
    along_c: Vec<[f64; 3]>,
}

impl Likelihood {
    /// Returns Newton's step and its decrement; none where the curvature is not positive definite.
    ///
    /// The limit states share nothing but a, so their c are eliminated first.
    fn newton_step(&self) -> Option<(Point, f64)> {
        let [mut gradient, mut curvature] = self.along_a;
        for [gc, ac, cc] in &self.along_c {
            gradient -= ac * gc / cc;
            curvature -= ac * ac / cc;
        }
        let definite = curvature > 0.0 && self.along_c.iter().all(|[_, _, cc]| *cc > 0.0);
        let a = gradient / curvature;
        let c: Vec<f64> = self.along_c.iter().map(|[gc, ac, cc]| (gc - ac * a) / cc).collect();
        let along = self.along_c.iter().zip(&c).map(|([gc, ..], c)| gc * c).sum::<f64>();
        let decrement = a * self.along_a[0] + along;
        definite.then_some((Point { a, c }, decrement))
    }
}

fn likelihood(states: &[&mut State], point: &Point) -> Likelihood {
    let mut all = Likelihood { value: 0.0, along_a: [0.0; 2], along_c: Vec::with_capacity(states.len()) };
    for (state, c) in states.iter().zip(&point.c) {
        let mut along_c = [0.0; 3];
        for term in &state.terms {
            let y = term.y - state.centre;
            let [l, d, dd] = term.derivatives(point.a, point.a * y + c);
            if term.exact {
                all.along_a[0] += 1.0 / point.a;
                all.along_a[1] += 1.0 / (point.a * point.a);
            }
            all.value += l;
            all.along_a[0] += d * y;
            all.along_a[1] -= dd * y * y;
            along_c[0] += d;
            along_c[1] -= dd * y;
            along_c[2] -= dd;
        }
        all.along_c.push(along_c);
    }
    all
}
