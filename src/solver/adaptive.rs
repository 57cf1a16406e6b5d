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

use oscillator::{Bounds, HIGHEST_ORDER, KinematicState, Polynomial};

use super::event::Piece;
use super::secant::Secant;
use super::tolerances::Tolerances;

/// A piece of motion by its Taylor series.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series<'a> {
    polynomial: Polynomial,
    horizon: f64,
    /// The motion at the horizon, and the bounds on |ü| and on the jerk up to there.
    end: KinematicState,
    bounds: Bounds,
    /// What gives ü instead of the series, and bounds it.
    law: Option<Law<'a>>,
}

/// The equation of motion on a branch with secant damping, under a forcing p₀ + p₁ t.
///
/// u(t) is singular where C is: at u₃ and at u = 0. From close to one of them a step may go further than the
/// series converges, because its terms are small there in u and in u̇. The terms of ü are about n/t times
/// those of u̇, and need not be small.
#[derive(Clone, Copy, Debug)]
struct Law<'a> {
    branch: &'a Branch,
    forcing: [f64; 2],
}

impl Law<'_> {
    fn forcing(&self, time: f64) -> f64 {
        self.forcing[0] + self.forcing[1] * time
    }

    /// Bounds the second derivative of ü of the exact motion between two times with their motions, which the
    /// piece follows within the tolerance of u and u̇:
    /// ```text
    /// ü = p − c u̇ − f,   u‴ = p₁ − c′ u̇² − c ü − k u̇,   u⁗ = −c″ u̇³ − 3c′ u̇ ü − c u‴ − k ü
    /// ```
    fn snap(&self, times: [f64; 2], motions: [KinematicState; 2], most_acceleration: f64) -> f64 {
        let length = times[1] - times[0];
        let [u0, u1] = motions.map(|motion| motion.displacement);
        let sag = 0.125 * length * length * most_acceleration;
        let Branch { lower, upper, stiffness, .. } = *self.branch;
        let range = [(u0.min(u1) - sag).clamp(lower, upper), (u0.max(u1) + sag).clamp(lower, upper)];
        let larger = |[a, b]: [f64; 2]| a.abs().max(b.abs());
        let speed = larger(motions.map(|motion| motion.velocity)) + 0.5 * length * most_acceleration;
        let [c, slope, bend] = self.branch.damping_bounds(range);
        let force = larger(range.map(|u| self.branch.restoring(u)));
        let acceleration = larger(times.map(|time| self.forcing(time))) + c * speed + force;
        let stiffness = stiffness.abs();
        let jerk = self.forcing[1].abs() + (slope * speed + stiffness) * speed + c * acceleration;
        bend * speed.powi(3) + (3.0 * slope * speed + stiffness) * acceleration + c * jerk
    }
}

/// An equation of motion that gives the Taylor coefficients of u one after the other.
pub(super) trait Recurrence {
    /// Coefficients of u, those known so far.
    fn displacement(&mut self) -> &mut [f64; HIGHEST_ORDER + 1];

    /// The n-th coefficient of ü; those of u are known up to n + 1.
    fn acceleration(&mut self, n: usize) -> f64;
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
}

impl<'a> Series<'a> {
    /// Computes the motion from a recurrence of `sign` u, over `remaining` or as much of it as the highest
    /// order can cover within the tolerance.
    pub(super) fn new(mut work: impl Recurrence, sign: f64, remaining: f64, tolerances: Tolerances) -> Self {
        let polynomial = |u: &[f64; HIGHEST_ORDER + 1], order: usize| Polynomial {
            coefficients: u.map(|coefficient| sign * coefficient),
            order,
        };
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
                return Self::of(polynomial(work.displacement(), order), remaining, None);
            }
            small_before = small;
            power *= remaining;
        }
        let horizon = longest_step(work.displacement(), tolerances).min(remaining);
        Self::of(polynomial(work.displacement(), HIGHEST_ORDER), horizon, None)
    }

    fn of(polynomial: Polynomial, horizon: f64, law: Option<Law<'a>>) -> Self {
        Self { polynomial, horizon, end: polynomial.at(horizon), bounds: polynomial.bounds(horizon), law }
    }

    /// Computes the motion on a branch with secant damping under the forcing p₀ + p₁ t.
    pub(super) fn secant(
        secant: &Secant,
        branch: &'a Branch,
        now: [f64; 2],
        forcing: [f64; 2],
        remaining: f64,
        tolerances: Tolerances,
    ) -> Self {
        let ends = [forcing[0], forcing[0] + forcing[1] * remaining];
        let reach = secant.reach(now, ends, remaining, tolerances);
        let law = Law { branch, forcing };
        Self::of(reach.polynomial(now, remaining), reach.horizon, Some(law))
    }

    /// Makes the cubic motion with a constant d³u/dt³.
    pub(super) fn cubic(start: KinematicState, acceleration_rate: f64, horizon: f64) -> Self {
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        coefficients[0] = start.displacement;
        coefficients[1] = start.velocity;
        coefficients[2] = 0.5 * start.acceleration;
        coefficients[3] = acceleration_rate / 6.0;
        Self::of(Polynomial { coefficients, order: 3 }, horizon, None)
    }
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

impl Piece for Series<'_> {
    fn start(&self) -> KinematicState {
        self.polynomial.start()
    }

    fn horizon(&self) -> f64 {
        self.horizon
    }

    fn at(&self, time: f64) -> KinematicState {
        if time == self.horizon { self.end } else { self.polynomial.at(time) }
    }

    fn bounds(&self, _from: KinematicState, _length: f64) -> Bounds {
        // over the whole piece, which is short
        self.bounds
    }

    fn balanced(&self, time: f64) -> KinematicState {
        let motion = self.at(time);
        let Some(law) = &self.law else { return motion };
        let KinematicState { displacement, velocity, .. } = motion;
        let acceleration = law.branch.acceleration(displacement, velocity, law.forcing(time));
        KinematicState { acceleration, ..motion }
    }

    fn curvatures(&self, [left, right]: [f64; 2], from: KinematicState) -> [f64; 3] {
        let Bounds { acceleration, jerk } =
            if right == self.horizon { self.bounds } else { self.polynomial.bounds(right) };
        let snap = match &self.law {
            Some(law) => law.snap([left, right], [from, self.at(right)], acceleration),
            None => self.polynomial.snap(right),
        };
        [acceleration, jerk, snap]
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        self.polynomial.integral(time)
    }
}

/// The paper's own scheme, Newmark linear acceleration without iteration at a fixed step: computes one step
/// of `duration` \[s\] from `start`, which is in equilibrium, while the forcing grows by `forcing_change`
/// \[m/s²\].
///
/// Tangent stiffness and damping are those at the start of the step, and the acceleration is reset from
/// equilibrium at each start (Chopra, Dynamics of Structures, section 15). Corners are not located: this
/// scheme is here to show their cost. Within a step the acceleration is linear, so the motion is a cubic, on
/// which overturning, impacts and the end of the fall are located.
pub(super) fn newmark_step(
    branch: &Branch,
    start: KinematicState,
    forcing_change: f64,
    duration: f64,
) -> Series<'static> {
    let KinematicState { displacement, velocity, acceleration } = start;
    let (h, c, k) = (duration, branch.damping_at(displacement), branch.stiffness);
    // per unit effective mass: k̂ = k + 3c/h + 6/h²
    let effective_stiffness = k + 3.0 * c / h + 6.0 / (h * h);
    // Δp̂ = Δp + (6/h + 3c) u̇ + (3 + c h/2) ü
    let effective_forcing =
        forcing_change + (6.0 / h + 3.0 * c) * velocity + (3.0 + 0.5 * c * h) * acceleration;
    let change = effective_forcing / effective_stiffness;
    // Δü = 6/h² Δu − 6/h u̇ − 3 ü
    let acceleration_change = 6.0 / (h * h) * change - 6.0 / h * velocity - 3.0 * acceleration;
    Series::cubic(start, acceleration_change / h, duration)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::{BranchDamping, Couple, Line, TieAction};

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
                let (lower, upper, anchor) = (0.01, 0.3, 0.02);
                let (tie, couple) = (TieAction::None, Couple::default());
                let branch = Branch { lower, upper, anchor, force, stiffness, own, tie, couple, damping };
                let start = KinematicState { displacement, velocity, acceleration: 0.0 };
                let any = Series::new(Viscous::new(&branch, start, [0.4, 2.0]), 1.0, 0.01, tolerances);
                let secant = Secant::new(&branch).expect("secant damping");
                let now = [displacement, velocity];
                let own = Series::secant(&secant, &branch, now, [0.4, 2.0], 0.01, tolerances);
                let time = any.horizon().min(own.horizon());
                let (any, own) = (any.at(time), own.at(time));
                assert!((any.displacement - own.displacement).abs() < 1e-12, "{any:?} {own:?}");
                assert!((any.velocity - own.velocity).abs() < 1e-11, "{any:?} {own:?}");
                // damping matters by far more than the tolerance
                let undamped = Branch { damping: BranchDamping::Constant(0.0), ..branch };
                let free =
                    Series::new(Viscous::new(&undamped, start, [0.4, 2.0]), 1.0, time, tolerances).at(time);
                assert!((free.velocity - own.velocity).abs() > 1e-4, "{free:?} {own:?}");
                compared += 1;
            }
        }
        assert_eq!(compared, 6);
    }

    /// The second derivative of ü keeps within its bound where the series converges. The bound is larger by
    /// what cancels. From close to u₃ on, where the terms of ü do not fall, ü is that of a far shorter
    /// series.
    #[test]
    fn acceleration_follows_the_equation_of_motion() {
        let own = Line { anchor: 0.3, force: 0.0, slope: -5.0 };
        let forcing = [0.4, 2.0];
        let mut far = 0;
        for damping in [BranchDamping::SecantRatio(0.1), BranchDamping::SecantStiffness(0.05)] {
            let (lower, upper) = (0.01, 0.3 * (1.0 - 1e-10));
            let (anchor, force, stiffness) = (0.3, 0.0, -5.0);
            let (tie, couple) = (TieAction::None, Couple::default());
            let branch = Branch { lower, upper, anchor, force, stiffness, own, tie, couple, damping };
            let secant = Secant::new(&branch).expect("secant damping");
            let series = |now: [f64; 2], time: f64, length: f64, tolerance: f64| {
                let tolerances = Tolerances { displacement: tolerance, velocity: tolerance };
                let forcing = [forcing[0] + forcing[1] * time, forcing[1]];
                Series::secant(&secant, &branch, now, forcing, length, tolerances)
            };
            for (u, v) in [(0.1, 0.3), (0.25, -0.4), (0.02, 0.3)] {
                let piece = series([u, v], 0.0, 0.005, 1e-14);
                let length = piece.horizon();
                let [wide, narrow] =
                    [length, 1e-3 * length].map(|end| piece.curvatures([0.0, end], piece.start())[2]);
                let snap = 24.0 * piece.polynomial.coefficients[4].abs();
                assert!(narrow >= snap && narrow <= wide, "{u}: {snap} of {narrow} of {wide}");
                assert!(narrow <= 30.0 * snap, "{u}: {narrow} for {snap}");
            }
            let from_end = series([upper, -0.4], 0.0, 0.01, 1e-8);
            let time = 0.9 * from_end.horizon();
            let found = from_end.balanced(time);
            let now = from_end.at(time);
            let wanted = series([now.displacement, now.velocity], time, 1e-16, 1e-8).start().acceleration;
            assert!((found.acceleration - wanted).abs() <= 1e-14, "{} for {wanted}", found.acceleration);
            far += u32::from((now.acceleration - wanted).abs() > 0.1 * wanted.abs());
        }
        // C of a constant ratio alone is singular there
        assert_eq!(far, 1);
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
