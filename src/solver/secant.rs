//! Motion on a branch whose damping follows the secant stiffness, by Taylor series.
//!
//! [`SecantBranch::start`] turns a state and a forcing into what a series starts from, [`Scaled`] holds its
//! coefficients, and [`excess`] judges what they leave out:
//! ```
//! use rocking_wall::solver::secant::{ByRatio, Scaled, SecantBranch, excess};
//!
//! // f = 2 − u without damping, from u = 1 at rest under p = 2: ü = u, so u = cosh t
//! let (own, factor) = ([0.0, 2.0, -1.0], 0.0);
//! let branch =
//!     SecantBranch { anchor: 0.0, force: 2.0, stiffness: -1.0, own, force_at_zero: 2.0, factor };
//! let (start, _) = branch.start::<ByRatio>([1.0, 0.0], [2.0, 0.0], 0.1);
//! let mut series = Scaled::new(start);
//! series.extend_to_8::<ByRatio>();
//! assert!(excess::<f64, 8>(series.last::<8>(), 1e-12) <= 0.0);
//! let [rise, velocity] = series.end::<8>();
//! assert!((rise - (0.1_f64.cosh() - 1.0)).abs() < 1e-15);
//! assert!((velocity - 0.1 * 0.1_f64.sinh()).abs() < 1e-14);
//! ```

#![allow(
    clippy::inline_always,
    reason = "measured: a series is one piece of straight code, its numbers in registers"
)]

use crate::wall::{Branch, BranchDamping};
use oscillator::{HIGHEST_ORDER, Polynomial};

pub use super::scaled::{ByRatio, ByStiffness, Number, ORDER, Scaled, SecantLaw, Start, half_square, inner};
pub use super::tolerances::{CAUTION, Tolerances, excess};

/// Least own force by which κ is divided, as a fraction of f(0).
const LEAST: f64 = 1e-30;

/// Returns the fraction of a step, at most 1, over which the last two terms of the highest order are within
/// what may be left out.
fn longest([.., before, last]: [f64; 4], most: f64) -> f64 {
    let of = |term: f64, n: usize| {
        // With libm's pow the end of a series does not depend on the platform. The constants of the wall do:
        // `wall/equivalence.rs` and `wall/mechanism.rs` take powers and angles from the platform.
        libm::pow(most / (n as f64 * term.abs().max(f64::MIN_POSITIVE)), 1.0 / (n as f64 - 1.0))
    };
    // what is left out after the last term is a geometric series of about the same size
    (0.9 * of(before, ORDER - 1).min(of(last, ORDER))).min(1.0)
}

/// The law of a branch with secant damping, or of a branch in each lane of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SecantBranch<T> {
    /// A displacement on the branch \[m\].
    pub anchor: T,
    /// f at the anchor \[m/s²\].
    pub force: T,
    /// Stiffness k, the slope of f \[1/s²\].
    pub stiffness: T,
    /// The line of the wall without a tie, of which c is made: anchor \[m\], force \[m/s²\] and slope
    /// \[1/s²\].
    pub own: [T; 3],
    /// That line's force at u = 0 \[m/s²\].
    pub force_at_zero: T,
    /// 2ξ \[-\], or 2ξ₁/ω₁ \[s\].
    pub factor: T,
}

impl<T: Number> SecantBranch<T> {
    /// Prepares the series from u ≠ 0 \[m\] and u̇ \[m/s\] over a length L of time \[s\], under a forcing p
    /// that changes by `change` until then \[m/s²\]. Also returns 1/u \[1/m\].
    #[inline(always)]
    pub fn start<L: SecantLaw>(&self, [u, v]: [T; 2], [forcing, change]: [T; 2], length: T) -> (Start<T>, T) {
        let [anchor, own_force, slope] = self.own;
        let force = self.force + self.stiffness * (u - self.anchor);
        let inverse = u.like(1.0) / u;
        let zero = self.force_at_zero * inverse;
        // at u₃ the wall's own force is zero, and so is c, but κ must not divide by it
        let secant = ((own_force + slope * (u - anchor)) * inverse).max(zero.abs() * LEAST);
        let scale = length * length * inverse;
        let start = Start {
            velocity: length * v * inverse,
            driving: scale * (forcing - force),
            rate: scale * change,
            half_kappa: zero / secant * -0.5,
            stiffness: self.stiffness * (length * length),
            damping: self.factor * length * L::damping(secant),
        };
        (start, inverse)
    }
}

/// A branch with secant damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Secant {
    /// c = 2ξ ω.
    Ratio(SecantBranch<f64>),
    /// c = (2ξ₁/ω₁) ω².
    Stiffness(SecantBranch<f64>),
}

impl Secant {
    /// Takes a branch; `None` where its damping is constant.
    pub(super) fn new(branch: &Branch) -> Option<Self> {
        let Branch { anchor, force, stiffness, own, .. } = *branch;
        let law = |factor| SecantBranch {
            anchor,
            force,
            stiffness,
            own: [own.anchor, own.force, own.slope],
            force_at_zero: own.at(0.0),
            factor,
        };
        match branch.damping {
            BranchDamping::Constant(_) => None,
            BranchDamping::SecantRatio(factor) => Some(Self::Ratio(law(factor))),
            BranchDamping::SecantStiffness(factor) => Some(Self::Stiffness(law(factor))),
        }
    }

    /// Returns the line of the branch and the factor of its damping, whichever its law.
    pub fn branch(&self) -> &SecantBranch<f64> {
        let (Self::Ratio(branch) | Self::Stiffness(branch)) = self;
        branch
    }

    /// Returns the motion from u and u̇ on, under a forcing from p₀ to p₁ over a length.
    #[inline(always)]
    pub(super) fn reach(&self, now: [f64; 2], p: [f64; 2], length: f64, tolerances: Tolerances) -> Reach {
        match self {
            Self::Ratio(branch) => Reach::new::<ByRatio>(branch, now, p, length, tolerances),
            Self::Stiffness(branch) => Reach::new::<ByStiffness>(branch, now, p, length, tolerances),
        }
    }
}

/// A series with as many terms as it takes, and the time up to which it is within the tolerances \[s\].
pub(super) struct Reach {
    series: Scaled<f64>,
    order: usize,
    pub(super) horizon: f64,
}

impl Reach {
    #[inline(always)]
    fn new<L: SecantLaw>(
        branch: &SecantBranch<f64>,
        now: [f64; 2],
        p: [f64; 2],
        length: f64,
        tolerances: Tolerances,
    ) -> Self {
        let (start, inverse) = branch.start::<L>(now, [p[0], p[1] - p[0]], length);
        let (mut series, most) = (Scaled::new(start), tolerances.over(inverse, length));
        let (order, horizon) = extend::<L>(&mut series, length, most);
        Self { series, order, horizon }
    }

    /// Returns the motion from u and u̇ on, of the same start and length.
    #[inline(always)]
    pub(super) fn polynomial(&self, now: [f64; 2], length: f64) -> Polynomial {
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        let (mut scale, rate) = (now[0], 1.0 / length);
        for (coefficient, x) in coefficients.iter_mut().zip(&self.series.x[..=self.order]) {
            *coefficient = scale * x;
            scale *= rate;
        }
        coefficients[1] = now[1];
        Polynomial { coefficients, order: self.order }
    }
}

/// Adds terms until a series leaves out no more than `most` of u/u₀ and of L u̇/u₀ over its length. Returns
/// the order, and the time up to which it may go where the highest does not reach \[s\].
#[inline(always)]
fn extend<L: SecantLaw>(series: &mut Scaled<f64>, length: f64, most: f64) -> (usize, f64) {
    series.extend_to_8::<L>();
    if excess::<f64, 8>(series.last::<8>(), most) <= 0.0 {
        return (8, length);
    }
    series.extend_to_10::<L>();
    if excess::<f64, 10>(series.last::<10>(), most) <= 0.0 {
        return (10, length);
    }
    series.extend_to_12::<L>();
    if excess::<f64, 12>(series.last::<12>(), most) <= 0.0 {
        return (12, length);
    }
    series.extend_to_16::<L>();
    let last = series.last::<ORDER>();
    let is_whole = excess::<f64, ORDER>(last, most) <= 0.0;
    (ORDER, if is_whole { length } else { length * longest(last, most) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wall::{Couple, Line, TieAction};

    /// Follows a branch to the end of a length by one series after the other; returns their
    /// number, too.
    fn follow(
        branch: &Secant,
        mut now: [f64; 2],
        p: [f64; 2],
        parts: u32,
        most: Tolerances,
    ) -> ([f64; 2], u32) {
        let (length, mut count) = (1.0 / f64::from(parts), 0);
        for part in 0..parts {
            let forcing = |time: f64| p[0] + (p[1] - p[0]) * (f64::from(part) * length + time);
            let mut time = 0.0;
            while time < length {
                let ends = [forcing(time), forcing(length)];
                let reach = branch.reach(now, ends, length - time, most);
                let (polynomial, horizon) = (reach.polynomial(now, length - time), reach.horizon);
                assert!(horizon > 0.0 && horizon <= length - time, "{horizon} of {}", length - time);
                count += 1;
                let there = polynomial.at(horizon);
                now = [there.displacement, there.velocity];
                time = if horizon == length - time { length } else { time + horizon };
            }
        }
        (now, count)
    }

    /// Terms that have fallen to rounding fall no further, so that `excess` rejects them although they are
    /// small. The step must not become longer for that.
    #[test]
    fn no_series_goes_beyond_its_step() {
        let last = [1.25e-14, -1.26e-14, 4.06e-15, -9.9e-16];
        assert!(excess::<f64, ORDER>(last, 5.2e-13) > 0.0);
        assert!(longest(last, 5.2e-13) <= 1.0);
    }

    /// A step followed by as many series as it takes ends where sixteen parts of it end, from slow motion to
    /// one that changes u thirtyfold.
    #[test]
    fn series_are_within_the_tolerances() {
        let most = Tolerances { displacement: 1e-12, velocity: 1e-12 };
        for damping in [BranchDamping::SecantRatio(0.06), BranchDamping::SecantStiffness(0.02)] {
            for speed in (0..3000).map(|i| 0.002 * 1.0025_f64.powi(i)) {
                // from u = 0.1, where p all but balances f, on a line that ends far beyond
                let (lower, upper) = (0.1, 100.0);
                let own = Line { anchor: upper, force: 0.0, slope: -0.02 };
                let (anchor, force, stiffness) = (upper, 0.0, -0.02);
                let (tie, couple) = (TieAction::None, Couple::default());
                let branch = Branch { lower, upper, anchor, force, stiffness, own, tie, couple, damping };
                let branch = Secant::new(&branch).expect("secant damping");
                let p = [2.0, 2.001];
                let (fine, many) = follow(&branch, [lower, speed], p, 16, most);
                let (coarse, few) = follow(&branch, [lower, speed], p, 1, most);
                // the tolerance of each series; what it leaves out grows by a hundredth until the end
                let error = (coarse[0] - fine[0]).abs().max((coarse[1] - fine[1]).abs());
                let allowed = 1.01e-12 * f64::from(many + few);
                assert!(error <= allowed, "{speed}: {error:e} of {allowed:e}");
            }
        }
    }
}
