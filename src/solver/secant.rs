//! Motion on a branch whose damping follows the secant stiffness: steps and pieces of Taylor series.

#![allow(
    clippy::inline_always,
    reason = "measured: a series is one piece of straight code, its numbers in registers"
)]

use crate::wall::{Branch, BranchDamping, Line};
use oscillator::{HIGHEST_ORDER, Polynomial};

use super::regularised::Regularised;
use super::scaled::{ORDER, Scaled, Start};
use super::tolerances::{Tolerances, within};

/// Least force in κ, as a share of f(0).
pub(super) const LEAST: f64 = 1e-30;

/// The share of u by which it changes in a step from which on a regularised series costs less, as measured.
const FAST: f64 = 0.1;

/// Returns the share of a step, at most all of it, after which the last terms of the highest order are within
/// what may be left out.
fn longest([.., before, last]: [f64; 4], most: f64) -> f64 {
    let of = |term: f64, n: usize| {
        // libm's pow: where a series is cut does not depend on the platform's. The constants of the wall do:
        // `wall/equivalence.rs` and `wall/mechanism.rs` take powers and angles from the platform.
        libm::pow(most / (n as f64 * term.abs().max(f64::MIN_POSITIVE)), 1.0 / (n as f64 - 1.0))
    };
    // what is left out after the last term is a geometric series of about the same size
    (0.9 * of(before, ORDER - 1).min(of(last, ORDER))).min(1.0)
}

/// Returns u/u₀ − 1 and h u̇/u₀ at the end of a step by order 8 or 10; `None` where these leave out too much.
#[inline(always)]
fn end_to_10<const RATIO: bool>(series: &mut Scaled<f64>, most: f64) -> Option<[f64; 2]> {
    series.extend_to_8::<RATIO>();
    if within::<8>(series.last::<8>(), most) {
        return Some(series.end::<8>());
    }
    series.extend_to_10::<RATIO>();
    within::<10>(series.last::<10>(), most).then(|| series.end::<10>())
}

/// Does the same by any order, with c = 2ξ ω.
#[inline(always)]
fn end_with_ratio(start: Start<f64>, most: f64) -> Option<[f64; 2]> {
    if start.velocity.abs() < FAST
        && let Some(end) = end_to_10::<true>(&mut Scaled::new(start, 1.0), most)
    {
        return Some(end);
    }
    Regularised::new(start).end(most)
}

/// Does the same with c = (2ξ₁/ω₁) ω².
#[inline(always)]
fn end_with_stiffness(start: Start<f64>, most: f64) -> Option<[f64; 2]> {
    let mut series = Scaled::new(start, 1.0);
    if let Some(end) = end_to_10::<false>(&mut series, most) {
        return Some(end);
    }
    series.extend_to_12::<false>();
    if within::<12>(series.last::<12>(), most) {
        return Some(series.end::<12>());
    }
    series.extend_to_16::<false>();
    within::<ORDER>(series.last::<ORDER>(), most).then(|| series.end::<ORDER>())
}

/// A branch with secant damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SecantBranch {
    pub(super) anchor: f64,
    pub(super) force: f64,
    pub(super) stiffness: f64,
    /// The line of the wall without a tie, of which c is made, and its force at u = 0.
    pub(super) own: Line,
    pub(super) force_at_zero: f64,
    /// 1 for u > 0, −1 for u < 0.
    side: f64,
    /// 2ξ, or 2ξ₁/ω₁ \[s\].
    pub(super) factor: f64,
    /// Whether c = 2ξ ω.
    pub(super) is_ratio: bool,
}

impl SecantBranch {
    /// Takes a branch; `None` where its damping is constant.
    pub(super) fn new(branch: &Branch) -> Option<Self> {
        let (factor, is_ratio) = match branch.damping {
            BranchDamping::Constant(_) => return None,
            BranchDamping::SecantRatio(factor) => (factor, true),
            BranchDamping::SecantStiffness(factor) => (factor, false),
        };
        let Branch { anchor, force, stiffness, own, .. } = *branch;
        let (force_at_zero, side) = (own.at(0.0), branch.side());
        Some(Self { anchor, force, stiffness, own, force_at_zero, side, factor, is_ratio })
    }

    /// Prepares the series from u and u̇ under a forcing from p₀ to p₁ over a length L, and 1/u.
    #[inline(always)]
    fn start(&self, [u, v]: [f64; 2], p: [f64; 2], length: f64) -> (Start<f64>, f64) {
        let force = self.force + self.stiffness * (u - self.anchor);
        let inverse = 1.0 / u;
        // at u₃ the wall's own force is zero, and so is c, but κ must not divide by it
        let nonzero = self.side * (self.side * self.own.at(u)).max(LEAST * self.force_at_zero.abs());
        let secant = nonzero * inverse;
        let damping = self.factor * length * if self.is_ratio { secant.sqrt() } else { secant };
        let scale = length * length * inverse;
        let start = Start {
            velocity: length * v * inverse,
            driving: scale * (p[0] - force),
            rate: scale * (p[1] - p[0]),
            half_kappa: -0.5 * self.force_at_zero / nonzero,
            stiffness: self.stiffness * (length * length),
            damping,
        };
        (start, inverse)
    }

    /// Returns u and u̇ after a step; `None` where the highest order leaves out too much.
    #[inline(always)]
    pub(super) fn step<const RATIO: bool>(
        &self,
        [u, v]: [f64; 2],
        p: [f64; 2],
        [length, rate]: [f64; 2],
        tolerances: Tolerances,
    ) -> Option<[f64; 2]> {
        let (start, inverse) = self.start([u, v], p, length);
        let most = tolerances.over(inverse, length);
        let end = if RATIO { end_with_ratio(start, most) } else { end_with_stiffness(start, most) }?;
        Some([u + u * end[0], u * rate * end[1]])
    }

    /// Does the same in 2, 4 or 8 parts.
    #[cold]
    pub(super) fn step_by_parts<const RATIO: bool>(
        &self,
        start: [f64; 2],
        [p0, p1]: [f64; 2],
        [length, rate]: [f64; 2],
        tolerances: Tolerances,
    ) -> Option<[f64; 2]> {
        [2, 4, 8].into_iter().find_map(|parts| {
            let share = 1.0 / f64::from(parts);
            let p = |part: i32| p0 + (p1 - p0) * (f64::from(part) * share);
            let lengths = [length * share, rate / share];
            (0..parts).try_fold(start, |now, part| {
                self.step::<RATIO>(now, [p(part), p(part + 1)], lengths, tolerances)
            })
        })
    }

    /// Follows a motion with a constant damping ratio on which u̇ keeps its sign, over a length of time or to
    /// a corner if that comes first. Returns the time, and u and u̇ then; `None` where that is not found at
    /// once.
    pub(super) fn follow_to_corner(
        &self,
        [u, v]: [f64; 2],
        p: [f64; 2],
        length: f64,
        corner: Option<f64>,
        tolerances: Tolerances,
    ) -> Option<(f64, [f64; 2])> {
        let (start, inverse) = self.start([u, v], p, length);
        let (series, most) = (Regularised::new(start), tolerances.over(inverse, length));
        if let Some(corner) = corner {
            let [share, velocity] = series.passage((corner - u) * inverse, most)?;
            if share < 1.0 {
                return (share > 0.0).then_some((length * share, [corner, u / length * velocity]));
            }
        }
        let [rise, velocity] = series.end(most)?;
        Some((length, [u + u * rise, u / length * velocity]))
    }

    /// Returns the motion under a forcing from p₀ to p₁ over a length, and the time up to which it is within
    /// the tolerances.
    pub(super) fn series(
        &self,
        now: [f64; 2],
        p: [f64; 2],
        length: f64,
        tolerances: Tolerances,
    ) -> (Polynomial, f64) {
        if self.is_ratio {
            self.series_with::<true>(now, p, length, tolerances)
        } else {
            self.series_with::<false>(now, p, length, tolerances)
        }
    }

    fn series_with<const RATIO: bool>(
        &self,
        now: [f64; 2],
        p: [f64; 2],
        length: f64,
        tolerances: Tolerances,
    ) -> (Polynomial, f64) {
        let (start, inverse) = self.start(now, p, length);
        let mut series = Scaled::new(start, 1.0);
        let most = tolerances.over(inverse, length);
        let (mut order, mut horizon) = (8, length);
        series.extend_to_8::<RATIO>();
        if !within::<8>(series.last::<8>(), most) {
            order = ORDER;
            series.extend_to_10::<RATIO>();
            series.extend_to_12::<RATIO>();
            series.extend_to_16::<RATIO>();
            if !within::<ORDER>(series.last::<ORDER>(), most) {
                horizon = length * longest(series.last::<ORDER>(), most);
            }
        }
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        let (mut scale, rate) = (now[0], 1.0 / length);
        for (coefficient, x) in coefficients.iter_mut().zip(&series.x[..=order]) {
            *coefficient = scale * x;
            scale *= rate;
        }
        coefficients[1] = now[1];
        (Polynomial { coefficients, order }, horizon)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Follows a branch to the end of a length by one series after the other; returns their
    /// number, too.
    fn follow(
        branch: &SecantBranch,
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
                let (polynomial, horizon) = branch.series(now, ends, length - time, most);
                assert!(horizon > 0.0 && horizon <= length - time, "{horizon} of {}", length - time);
                count += 1;
                let there = polynomial.at(horizon);
                now = [there.displacement, there.velocity];
                time = if horizon == length - time { length } else { time + horizon };
            }
        }
        (now, count)
    }

    /// Terms that have come to rounding need not fall any more: they end no step late.
    #[test]
    fn no_series_goes_beyond_its_step() {
        let last = [1.25e-14, -1.26e-14, 4.06e-15, -9.9e-16];
        assert!(!within::<ORDER>(last, 5.2e-13));
        assert!(longest(last, 5.2e-13) <= 1.0);
    }

    /// A step by as many series as it takes, and by fixed orders, is the same in sixteen parts, from slow
    /// motion to one that changes u thirtyfold.
    #[test]
    fn series_are_within_the_tolerances() {
        let most = Tolerances { displacement: 1e-12, velocity: 1e-12 };
        let mut by_orders = 0;
        for damping in [BranchDamping::SecantRatio(0.06), BranchDamping::SecantStiffness(0.02)] {
            for speed in (0..3000).map(|i| 0.002 * 1.0025_f64.powi(i)) {
                // from u = 0.1, where p all but balances f, on a line that ends far beyond
                let (lower, upper) = (0.1, 100.0);
                let own = Line { anchor: upper, force: 0.0, slope: -0.02 };
                let branch =
                    Branch { lower, upper, anchor: upper, force: 0.0, stiffness: -0.02, own, damping };
                let branch = SecantBranch::new(&branch).expect("secant damping");
                let p = [2.0, 2.001];
                let (fine, many) = follow(&branch, [lower, speed], p, 16, most);
                let (coarse, few) = follow(&branch, [lower, speed], p, 1, most);
                let step = if branch.is_ratio {
                    branch.step::<true>([lower, speed], p, [1.0, 1.0], most)
                } else {
                    branch.step::<false>([lower, speed], p, [1.0, 1.0], most)
                };
                by_orders += u32::from(step.is_some());
                for end in [Some(coarse), step].into_iter().flatten() {
                    // the tolerance of each series; what it leaves out grows by a hundredth until the end
                    let error = (end[0] - fine[0]).abs().max((end[1] - fine[1]).abs());
                    let allowed = 1.01e-12 * f64::from(many + few);
                    assert!(error <= allowed, "{speed}: {error:e} of {allowed:e}");
                }
            }
        }
        assert!(by_orders > 10, "{by_orders}");
    }
}
