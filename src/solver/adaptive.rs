//! Taylor series of variable order, for motion that has no closed form.
//!
//! On a branch u is an analytic function of time, and its Taylor coefficients follow from the equation of
//! motion by recurrence: for any damping here, for full rotations in `trigonometric`, and faster for secant
//! damping in `secant`.
//!
//! The order grows until two consecutive terms fall below the tolerance at the end of the step. Where the
//! highest order does not suffice the step shrinks instead (Jorba and Zou, Experimental Mathematics 14,
//! 2005). The series is its own dense output, on which events are located.

use crate::wall::{Branch, DampingSeries};

use oscillator::{HIGHEST_ORDER, KinematicState, Polynomial};

use super::event::Piece;
use super::secant::Secant;
use super::tolerances::Tolerances;

/// A piece of motion by its Taylor series.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series {
    polynomial: Polynomial,
    horizon: f64,
}

/// An equation of motion that gives the Taylor coefficients of u one after the other.
pub(super) trait Recurrence {
    /// Coefficients of u, those known so far.
    fn displacement(&mut self) -> &mut [f64; HIGHEST_ORDER + 1];

    /// The n-th coefficient of ü; those of u are known up to n + 1.
    fn acceleration(&mut self, n: usize) -> f64;

    /// −1 where the recurrence works on −u, else 1.
    fn sign(&self) -> f64;
}

/// The recurrence on a branch with viscous damping.
pub(super) struct Viscous<'a> {
    branch: &'a Branch,
    damping: DampingSeries<{ HIGHEST_ORDER + 1 }>,
    /// p₀ and p₁.
    forcing: [f64; 2],
    displacement: [f64; HIGHEST_ORDER + 1],
}

impl<'a> Viscous<'a> {
    /// The motion from `start` under the forcing p₀ + p₁ t.
    pub(super) fn new(branch: &'a Branch, start: KinematicState, forcing: [f64; 2]) -> Self {
        let mut displacement = [0.0; HIGHEST_ORDER + 1];
        [displacement[0], displacement[1]] = [start.displacement, start.velocity];
        Self { branch, damping: DampingSeries::new(branch.damping, branch.own), forcing, displacement }
    }
}

impl Recurrence for Viscous<'_> {
    fn displacement(&mut self) -> &mut [f64; HIGHEST_ORDER + 1] {
        &mut self.displacement
    }

    fn acceleration(&mut self, n: usize) -> f64 {
        let Self { branch, damping, forcing, displacement: u } = self;
        let forcing = forcing.get(n).copied().unwrap_or(0.0);
        let restoring = if n == 0 { branch.restoring(u[0]) } else { branch.stiffness * u[n] };
        damping.extend(u, n);
        // (c u̇)ₙ = Σ cᵢ (n − i + 1) uₙ₋ᵢ₊₁
        let terms = if branch.damping.constant().is_some() { 1 } else { n + 1 };
        let slowing = |i: usize| damping.coefficients[i] * ((n - i + 1) as f64 * u[n - i + 1]);
        forcing - restoring - (0..terms).map(slowing).sum::<f64>()
    }

    fn sign(&self) -> f64 {
        1.0
    }
}

impl Series {
    /// Computes the motion from a recurrence, over `remaining` or as much of it as the highest order can
    /// cover within the tolerance.
    pub(super) fn new(mut work: impl Recurrence, remaining: f64, tolerances: Tolerances) -> Self {
        let mut power = remaining;
        let mut small_before = false;
        for n in 0..=HIGHEST_ORDER - 2 {
            let order = n + 2;
            let coefficient = work.acceleration(n) / ((n + 1) * (n + 2)) as f64;
            work.displacement()[order] = coefficient;
            // |uₙ| Tⁿ in u, n |uₙ| Tⁿ⁻¹ in u̇
            let rate = coefficient.abs() * power;
            let small = rate * remaining <= tolerances.displacement
                && order as f64 * rate <= tolerances.velocity
                // the forcing enters the first two terms, and damping one more
                && order > 3;
            if small && small_before {
                return Self { polynomial: polynomial(work, order), horizon: remaining };
            }
            small_before = small;
            power *= remaining;
        }
        let horizon = longest_step(work.displacement(), tolerances).min(remaining);
        Self { polynomial: polynomial(work, HIGHEST_ORDER), horizon }
    }

    /// Computes the motion on a branch with secant damping under a forcing from p₀ to p₁.
    pub(super) fn secant(
        branch: &Secant,
        now: [f64; 2],
        forcing: [f64; 2],
        remaining: f64,
        tolerances: Tolerances,
    ) -> Self {
        let (polynomial, horizon) = branch.series(now, forcing, remaining, tolerances);
        Self { polynomial, horizon }
    }

    /// Makes the cubic motion with a constant d³u/dt³.
    pub(super) fn cubic(start: KinematicState, acceleration_rate: f64, horizon: f64) -> Self {
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        coefficients[0] = start.displacement;
        coefficients[1] = start.velocity;
        coefficients[2] = 0.5 * start.acceleration;
        coefficients[3] = acceleration_rate / 6.0;
        Self { polynomial: Polynomial { coefficients, order: 3 }, horizon }
    }
}

/// u(t) from its coefficients up to `order`.
fn polynomial(mut work: impl Recurrence, order: usize) -> Polynomial {
    let sign = work.sign();
    Polynomial { coefficients: work.displacement().map(|coefficient| sign * coefficient), order }
}

/// Returns 0.9 of the step at which the last two terms of the highest order meet the tolerance.
fn longest_step(coefficients: &[f64; HIGHEST_ORDER + 1], tolerances: Tolerances) -> f64 {
    let mut step = f64::INFINITY;
    for order in [HIGHEST_ORDER - 1, HIGHEST_ORDER] {
        let size = coefficients[order].abs();
        let n = order as f64;
        step = step.min(libm::pow(tolerances.displacement / size, 1.0 / n));
        step = step.min(libm::pow(tolerances.velocity / (n * size), 1.0 / (n - 1.0)));
    }
    // the terms left out form a geometric series of about the size of the last term
    0.9 * step
}

impl Piece for Series {
    fn start(&self) -> KinematicState {
        self.polynomial.start()
    }

    fn horizon(&self) -> f64 {
        self.horizon
    }

    fn at(&self, time: f64) -> KinematicState {
        self.polynomial.at(time)
    }

    fn bounds(&self, _from: KinematicState, _length: f64) -> (f64, f64) {
        // over the whole piece, which is short
        self.polynomial.bounds(self.horizon)
    }

    fn snap(&self, _bounds: (f64, f64)) -> f64 {
        self.polynomial.snap(self.horizon)
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        self.polynomial.integral(time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::{BranchDamping, Line};

    /// The series of one law and the recurrence for any give the same motion, also with a tie.
    #[test]
    fn series_of_secant_damping_are_those_of_any() {
        let tolerances = Tolerances { displacement: 1e-13, velocity: 1e-12 };
        let own = Line { anchor: 0.3, force: 0.0, slope: -5.0 };
        let mut compared = 0;
        for damping in [BranchDamping::SecantRatio(0.1), BranchDamping::SecantStiffness(0.05)] {
            for (displacement, velocity, stiffness) in
                [(0.1, 0.3, -5.0), (0.25, -0.4, -5.0), (0.02, 0.1, 40.0)]
            {
                let force = stiffness * (0.02 - own.anchor);
                let branch = Branch { lower: 0.01, upper: 0.3, anchor: 0.02, force, stiffness, own, damping };
                let start = KinematicState { displacement, velocity, acceleration: 0.0 };
                let any = Series::new(Viscous::new(&branch, start, [0.4, 2.0]), 0.01, tolerances);
                let secant = Secant::new(&branch).expect("secant damping");
                let ends = [0.4, 0.4 + 2.0 * 0.01];
                let own = Series::secant(&secant, [displacement, velocity], ends, 0.01, tolerances);
                let time = any.horizon().min(own.horizon());
                let (any, own) = (any.at(time), own.at(time));
                assert!((any.displacement - own.displacement).abs() < 1e-12, "{any:?} {own:?}");
                assert!((any.velocity - own.velocity).abs() < 1e-11, "{any:?} {own:?}");
                // damping matters by far more than the tolerance
                let undamped = Branch { damping: BranchDamping::Constant(0.0), ..branch };
                let free = Series::new(Viscous::new(&undamped, start, [0.4, 2.0]), time, tolerances).at(time);
                assert!((free.velocity - own.velocity).abs() > 1e-4, "{free:?} {own:?}");
                compared += 1;
            }
        }
        assert_eq!(compared, 6);
    }

    /// Without the factor 0.9 for the terms left out, the step found is that at which the larger of the last
    /// two terms meets its tolerance. The terms are |uₙ| hⁿ in u and n |uₙ| hⁿ⁻¹ in u̇, with coefficients rⁿ.
    #[test]
    fn the_longest_step_meets_the_tolerance() {
        for growth in [0.2_f64, 0.9, 3.0] {
            for [displacement, velocity] in [[1e-12, 1.0], [1.0, 1e-12], [3e-10, 7e-9]] {
                let tolerances = Tolerances { displacement, velocity };
                // the last coefficient is halved and doubled, so that either of the last two terms may be the
                // larger
                for last in [0.5, 2.0] {
                    let mut coefficients: [f64; HIGHEST_ORDER + 1] =
                        std::array::from_fn(|order| growth.powi(i32::try_from(order).unwrap()));
                    coefficients[HIGHEST_ORDER] *= -last;
                    let step = longest_step(&coefficients, tolerances) / 0.9;
                    let share = |order: usize| {
                        let (n, size) = (order as f64, coefficients[order].abs());
                        let rate = size * step.powf(n - 1.0);
                        (rate * step / displacement).max(n * rate / velocity)
                    };
                    let largest = share(HIGHEST_ORDER - 1).max(share(HIGHEST_ORDER));
                    assert!((largest - 1.0).abs() < 1e-12, "{growth}, {tolerances:?}: {largest}");
                }
            }
        }
    }
}
