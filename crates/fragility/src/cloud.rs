//! Fragilities of clouds: records run once each, and a regression of the demand on the intensity.
//!
//! ```text
//! ln D = a + b ln IM + σ ε,   D = u_max/u_ins,   ε standard normal
//! P(D > d | IM = x) = Φ(ln(x/θ)/β),   ln θ = (ln d − a)/b,   β = σ/b
//! ```
//! A wall that overturned has a demand of 1 or more, which is all that is known of it: it is censored. With φ
//! and Φ of the standard normal distribution the likelihood is
//!
//! ```text
//! L = Π φ((ln D − a − b ln IM)/σ)/σ  of those that stand  ×  Π Φ((a + b ln IM)/σ)  of those that overturned
//! ```
//! J. Tobin: Estimation of relationships for limited dependent variables. Econometrica 26(1), 1958, 24–36. In
//! γ = 1/σ and δ = (a, b)/σ the logarithm of L is concave, so that it has one maximum (R. J. Olsen: Note on
//! the uniqueness of the maximum likelihood estimator for the Tobit model. Econometrica 46(5), 1978,
//! 1211–1215).

use crate::curve::Curve;
use crate::fit::{FitError, Lognormal};
use crate::linear::{cholesky, solve};
use crate::normal::log_and_hazard;
use crate::weights::Weights;

/// The runs of a wall and model, one for each record.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloud {
    points: Vec<Point>,
    weights: Weights,
}

/// A run.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    /// ln IM.
    x: f64,
    /// ln D; `None` of a wall that overturned.
    y: Option<f64>,
}

/// The regression of a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regression {
    /// ln D at the intensity of 1.
    pub intercept: f64,
    /// b, by how much ln D rises with ln IM \[-\].
    pub slope: f64,
    /// σ, the standard deviation of ln D \[-\].
    pub deviation: f64,
}

/// Bounds on Newton's steps and on halvings of one; six and none are usual.
const MOST_STEPS: usize = 100;
const MOST_HALVINGS: usize = 60;
/// Newton's decrement at which the next step is the last: it leaves an error of about 1e-14 standard errors.
const DECREMENT: f64 = 1e-14;
/// Least standard deviation about a line, relative to that of ln D, that is more than rounding.
const LEAST_SCATTER: f64 = 1e-9;

impl Cloud {
    /// Takes the runs of some records.
    pub fn of_curves(curves: &[Curve]) -> Self {
        let run = |curve: &Curve| curve.runs().first().copied();
        let points = curves.iter().filter_map(run).map(|run| Point {
            x: libm::log(run.intensity),
            y: run.overturning.is_none().then(|| libm::log(run.demand)),
        });
        Self { points: points.collect(), weights: Weights::default() }
    }

    /// Weighs the records.
    #[must_use]
    pub fn weighted(self, weights: &Weights) -> Self {
        Self { weights: weights.clone(), ..self }
    }

    /// Counts the records.
    pub fn records(&self) -> usize {
        self.points.len()
    }

    /// Counts the walls that overturned.
    pub fn collapsed(&self) -> usize {
        self.points.iter().filter(|point| point.y.is_none()).count()
    }

    /// Counts the walls that did not move at all. Their demand has no logarithm, and the regression leaves
    /// them out.
    pub fn still(&self) -> usize {
        self.points.iter().filter(|point| point.y == Some(f64::NEG_INFINITY)).count()
    }

    /// Fits the regression by maximum likelihood.
    ///
    /// # Errors
    /// [`FitError`] if the runs determine none.
    pub fn fit(&self) -> Result<Regression, FitError> {
        self.fit_drawn(&vec![1; self.points.len()])
    }

    /// Fits the regression, with each record as often as it was drawn.
    pub(crate) fn fit_drawn(&self, drawn: &[u32]) -> Result<Regression, FitError> {
        let drawn = self.points.iter().copied().zip(self.weights.times(drawn));
        let used = |(point, count): &(Point, f64)| *count > 0.0 && point.y.is_none_or(f64::is_finite);
        let points: Vec<_> = drawn.filter(used).collect();
        let standing = points.iter().filter_map(|(point, count)| Some(([point.x, point.y?], *count)));
        let line = Line::of(&standing.collect::<Vec<_>>()).ok_or(FitError::Cloud)?;
        // from the line through those that stand
        let gamma = 1.0 / line.deviation;
        let mut at = [line.height * gamma, line.slope * gamma, gamma];
        let mut here = likelihood(&points, line.centre, at);
        for _ in 0..MOST_STEPS {
            let mut step = here.gradient;
            cholesky(&mut here.curvature, 0.0).ok_or(FitError::Cloud)?;
            solve(&here.curvature, &mut step);
            let decrement: f64 = step.iter().zip(here.gradient).map(|(step, slope)| step * slope).sum();
            let mut part = 1.0;
            for _ in 0..MOST_HALVINGS {
                let next = [0, 1, 2].map(|k| at[k] + part * step[k]);
                let there = likelihood(&points, line.centre, next);
                // a rounding of the value must not stop the last steps
                if next[2] > 0.0 && there.value >= here.value - 1e-12 * here.value.abs() {
                    (at, here) = (next, there);
                    break;
                }
                part *= 0.5;
            }
            if decrement <= DECREMENT {
                let [height, slope, gamma] = at;
                let (slope, deviation) = (slope / gamma, 1.0 / gamma);
                let intercept = height / gamma - slope * line.centre;
                return if slope > 0.0 {
                    Ok(Regression { intercept, slope, deviation })
                } else {
                    Err(FitError::Falling)
                };
            }
        }
        Err(FitError::Cloud)
    }
}

impl Regression {
    /// Returns the fragility of a limit state, a fraction of `u_ins`.
    pub fn fragility(&self, fraction: f64) -> Lognormal {
        Lognormal {
            median: libm::exp((libm::log(fraction) - self.intercept) / self.slope),
            dispersion: self.deviation / self.slope,
        }
    }

    /// Returns the demand that half of the records exceed at an intensity.
    pub fn demand(&self, intensity: f64) -> f64 {
        libm::exp(self.intercept + self.slope * libm::log(intensity))
    }
}

/// The line of least squares through points, about the centre of their x.
struct Line {
    centre: f64,
    height: f64,
    slope: f64,
    deviation: f64,
}

impl Line {
    /// Returns the line; `None` where the points do not scatter about one.
    fn of(points: &[([f64; 2], f64)]) -> Option<Self> {
        let mean = |of: &dyn Fn([f64; 2]) -> f64| -> f64 {
            let add = |[sum, all]: [f64; 2], (point, count): &([f64; 2], f64)| {
                [sum + count * of(*point), all + count]
            };
            let sums = points.iter().fold([0.0; 2], add);
            sums[0] / sums[1]
        };
        let (centre, height) = (mean(&|[x, _]| x), mean(&|[_, y]| y));
        let slope = mean(&|[x, y]| (x - centre) * (y - height)) / mean(&|[x, _]| (x - centre).powi(2));
        let deviation = mean(&|[x, y]| (y - height - slope * (x - centre)).powi(2)).sqrt();
        let spread = mean(&|[_, y]| (y - height).powi(2)).sqrt();
        // not of numbers that are not known, as of a single x
        (deviation > LEAST_SCATTER * spread).then_some(Self { centre, height, slope, deviation })
    }
}

/// ln L without its constant, its slopes along δ and γ, and its negative second derivatives.
struct Likelihood {
    value: f64,
    gradient: [f64; 3],
    curvature: [[f64; 3]; 3],
}

fn likelihood(points: &[(Point, f64)], centre: f64, [height, slope, gamma]: [f64; 3]) -> Likelihood {
    let mut all = Likelihood { value: 0.0, gradient: [0.0; 3], curvature: [[0.0; 3]; 3] };
    for (Point { x, y }, count) in points {
        let x = x - centre;
        // ln L, its slope along the argument and its negative curvature, and the argument's own slopes
        let z = height + slope * x - gamma * y.unwrap_or(0.0);
        let (value, slope_z, bend) = if y.is_some() {
            (libm::log(gamma) - 0.5 * z * z, -z, 1.0)
        } else {
            let (value, hazard) = log_and_hazard(z);
            (value, hazard, hazard * (hazard + z))
        };
        let own = [1.0, x, -y.unwrap_or(0.0)];
        all.value += count * value;
        for k in 0..3 {
            all.gradient[k] += count * slope_z * own[k];
            for (l, other) in own.iter().enumerate() {
                all.curvature[k][l] += count * bend * own[k] * other;
            }
        }
        if y.is_some() {
            all.gradient[2] += count / gamma;
            all.curvature[2][2] += count / (gamma * gamma);
        }
    }
    all
}
