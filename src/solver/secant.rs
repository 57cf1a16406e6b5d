//! Taylor series of the motion on a branch whose damping follows the secant stiffness.
//!
//! With the law f = f₀ + k u, the secant ω² = f/u and c = 2ξ ω or (2ξ₁/ω₁) ω², u is an analytic function of
//! time. Its coefficients are taken over their values at the start, x = u/u₀, s = ω²/ω₀², w = c/c₀, with time
//! in lengths L of the step and z = c₀ L ẋ:
//! ```text
//! sₙ = κ xₙ − Σ xᵢ sₙ₋ᵢ,   κ = k/ω₀² − 1 = −f₀/f(u₀)
//! wₙ = (sₙ − Σ wᵢ wₙ₋ᵢ)/2   for c = 2ξ ω,   wₙ = sₙ   for c = (2ξ₁/ω₁) ω²
//! (n+1)(n+2) xₙ₊₂ = L² pₙ/u₀ − k L² xₙ − (zₙ + Σ wᵢ zₙ₋ᵢ + wₙ z₀)        sums over 0 < i < n
//! ```
//! Nothing divides but the first term, and each sum ends with what is known last: a step is one piece of
//! straight code. The same code serves numbers and vectors of them.

#![allow(
    clippy::inline_always,
    reason = "measured: a series is one piece of straight code, its numbers in registers"
)]

use std::ops::{Add, Mul, Sub};

use crate::wall::{Branch, BranchDamping};
use oscillator::{HIGHEST_ORDER, Polynomial};

use super::tolerances::Tolerances;

/// Highest order of these series.
const ORDER: usize = 16;

/// Least share of f(0) that the force is taken to be.
pub(super) const LEAST: f64 = 1e-30;

/// 1/((n+1)(n+2)).
const INVERSE: [f64; ORDER] = {
    let mut inverse = [0.0; ORDER];
    let mut n = 0;
    while n < ORDER {
        inverse[n] = 1.0 / ((n + 1) * (n + 2)) as f64;
        n += 1;
    }
    inverse
};

/// A number, or a vector of them.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Mul<f64, Output = Self>
{
}

impl Number for f64 {}

/// The coefficients, of time in lengths of the step.
#[derive(Clone, Copy)]
pub(super) struct Scaled<T> {
    x: [T; ORDER + 1],
    z: [T; ORDER + 1],
    s: [T; ORDER + 1],
    w: [T; ORDER + 1],
    half_kappa: T,
    /// k L², c₀ L and L² p₁/u₀.
    stiffness: T,
    damping: T,
    rate: T,
}

/// What a series starts from.
#[derive(Clone, Copy)]
pub(super) struct Start<T> {
    /// L u̇₀/u₀.
    pub(super) velocity: T,
    /// L² (p₀ − f(u₀))/u₀.
    pub(super) driving: T,
    /// L² p₁/u₀, p being p₀ + p₁ t with t in lengths L.
    pub(super) rate: T,
    /// κ/2.
    pub(super) half_kappa: T,
    /// k L².
    pub(super) stiffness: T,
    /// c₀ L.
    pub(super) damping: T,
}

/// Computes Σ aᵢ bₙ₋ᵢ for 0 < i < N.
#[inline(always)]
fn inner<T: Number, const N: usize>(a: &[T; ORDER + 1], b: &[T; ORDER + 1]) -> T {
    let middle = N / 2;
    let mut sum = a[middle] * b[N - middle];
    for i in (1..middle).rev() {
        sum = sum + a[i] * b[N - i];
    }
    for i in middle + 1..N {
        sum = sum + a[i] * b[N - i];
    }
    sum
}

/// Computes half of Σ aᵢ aₙ₋ᵢ for 0 < i < N.
#[inline(always)]
fn half_square<T: Number, const N: usize>(a: &[T; ORDER + 1]) -> T {
    let middle = a[N / 2] * a[N - N / 2];
    let mut sum = if N.is_multiple_of(2) { middle * 0.5 } else { middle };
    for i in (1..N / 2).rev() {
        sum = sum + a[i] * a[N - i];
    }
    sum
}

/// Adds the terms n of a series; `RATIO` tells c = 2ξ ω.
macro_rules! terms {
    ($series:ident: $($n:literal)*) => { $($series.term::<$n, RATIO>();)* };
}

impl<T: Number> Scaled<T> {
    /// Starts a series: coefficients up to x₂.
    #[inline(always)]
    pub(super) fn new(start: Start<T>, one: T) -> Self {
        let Start { velocity, driving, rate, half_kappa, stiffness, damping } = start;
        let ones = [one; ORDER + 1];
        let mut series = Self { x: ones, z: ones, s: ones, w: ones, half_kappa, stiffness, damping, rate };
        series.x[1] = velocity;
        series.z[0] = damping * velocity;
        let acceleration = driving - series.z[0];
        series.z[1] = damping * acceleration;
        series.x[2] = acceleration * 0.5;
        series
    }

    /// Adds sₙ, wₙ, zₙ₊₁ and xₙ₊₂.
    #[inline(always)]
    fn term<const N: usize, const RATIO: bool>(&mut self) {
        let x = self.x[N];
        let mut half_s = self.half_kappa * x;
        if N > 1 {
            half_s = half_s - inner::<T, N>(&self.x, &self.s) * 0.5;
        }
        self.s[N] = half_s + half_s;
        self.w[N] = if !RATIO {
            self.s[N]
        } else if N > 1 {
            half_s - half_square::<T, N>(&self.w)
        } else {
            half_s
        };
        let mut rest = self.stiffness * x;
        if N == 1 {
            rest = rest - self.rate;
        } else {
            rest = rest + inner::<T, N>(&self.w, &self.z);
        }
        let slowing = self.z[N] + (rest + self.w[N] * self.z[0]);
        self.z[N + 1] = slowing * (self.damping * (-1.0 / (N + 1) as f64));
        self.x[N + 2] = slowing * -INVERSE[N];
    }

    /// Adds the terms up to x₈.
    #[inline(always)]
    pub(super) fn extend_to_8<const RATIO: bool>(&mut self) {
        terms!(self: 1 2 3 4 5 6);
    }

    /// Adds the terms up to x₁₀.
    #[inline(always)]
    pub(super) fn extend_to_10<const RATIO: bool>(&mut self) {
        terms!(self: 7 8);
    }

    /// Adds the terms up to x₁₂.
    #[inline(always)]
    pub(super) fn extend_to_12<const RATIO: bool>(&mut self) {
        terms!(self: 9 10);
    }

    /// Adds the terms up to x₁₆.
    #[inline(always)]
    pub(super) fn extend_to_16<const RATIO: bool>(&mut self) {
        terms!(self: 11 12 13 14);
    }

    /// Returns what x and ẋ have come to at the end of the step, by the terms up to N.
    #[inline(always)]
    pub(super) fn end<const N: usize>(&self) -> [T; 2] {
        let (mut x, mut velocity) = (self.x[1], self.x[1]);
        for n in 2..=N {
            x = x + self.x[n];
            velocity = velocity + self.x[n] * n as f64;
        }
        [x, velocity]
    }

    /// Returns the coefficients of order N − 3 to N.
    #[inline(always)]
    pub(super) fn last<const N: usize>(&self) -> [T; 4] {
        [self.x[N - 3], self.x[N - 2], self.x[N - 1], self.x[N]]
    }
}

/// Of what may be left out, the share that is.
pub(super) const CAUTION: f64 = 0.1;

/// Tells whether a series to order N leaves out no more than a share of `most` of x and of ẋ.
///
/// Pairs of terms fall like a geometric series: from m₀, the larger of orders N − 3 and N − 2, to m₁, the
/// larger of the last two. With q = m₁/m₀ what is left out is 2 m₁ q/(1 − q) at most, and N times that of ẋ.
#[inline(always)]
fn within<const N: usize>([a, b, c, d]: [f64; 4], most: f64) -> bool {
    let (before, last) = (a.abs().max(b.abs()), c.abs().max(d.abs()));
    (2 * N) as f64 * last * last <= CAUTION * most * (before - last)
}

/// Returns the share of a step after which the last terms of the highest order are within what may be left
/// out.
fn longest([.., before, last]: [f64; 4], most: f64) -> f64 {
    let of = |term: f64, n: usize| (most / (n as f64 * term.abs())).powf(1.0 / (n as f64 - 1.0));
    // what is left out after the last term is a geometric series of about the same size
    0.9 * of(before, ORDER - 1).min(of(last, ORDER))
}

/// A branch with secant damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SecantBranch {
    pub(super) anchor: f64,
    pub(super) force: f64,
    pub(super) stiffness: f64,
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
        let Branch { anchor, force, stiffness, .. } = *branch;
        let (force_at_zero, side) = (branch.restoring(0.0), branch.side());
        Some(Self { anchor, force, stiffness, force_at_zero, side, factor, is_ratio })
    }

    /// Prepares the series from u and u̇ under a forcing from p₀ to p₁ over a length L, and 1/u.
    #[inline(always)]
    fn start(&self, [u, v]: [f64; 2], p: [f64; 2], length: f64) -> (Scaled<f64>, f64) {
        let force = self.force + self.stiffness * (u - self.anchor);
        let inverse = 1.0 / u;
        // where the force is zero there is no damping yet, but κ takes a number
        let some = self.side * (self.side * force).max(LEAST * self.force_at_zero.abs());
        let secant = some * inverse;
        let damping = self.factor * length * if self.is_ratio { secant.sqrt() } else { secant };
        let scale = length * length * inverse;
        let start = Start {
            velocity: length * v * inverse,
            driving: scale * (p[0] - force),
            rate: scale * (p[1] - p[0]),
            half_kappa: -0.5 * self.force_at_zero / some,
            stiffness: self.stiffness * (length * length),
            damping,
        };
        (Scaled::new(start, 1.0), inverse)
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
        let (mut series, inverse) = self.start([u, v], p, length);
        let most = tolerances.over(inverse, length);
        let end = 'end: {
            series.extend_to_8::<RATIO>();
            if within::<8>(series.last::<8>(), most) {
                break 'end series.end::<8>();
            }
            series.extend_to_10::<RATIO>();
            if within::<10>(series.last::<10>(), most) {
                break 'end series.end::<10>();
            }
            series.extend_to_12::<RATIO>();
            if within::<12>(series.last::<12>(), most) {
                break 'end series.end::<12>();
            }
            series.extend_to_16::<RATIO>();
            if within::<ORDER>(series.last::<ORDER>(), most) {
                break 'end series.end::<ORDER>();
            }
            return None;
        };
        Some([u + u * end[0], u * rate * end[1]])
    }

    /// Does the same by two halves, or four quarters, where need be.
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
        let (mut series, inverse) = self.start(now, p, length);
        let most = tolerances.over(inverse, length);
        let (mut order, mut horizon) = (8, length);
        series.extend_to_8::<RATIO>();
        if !within::<8>(series.last::<8>(), most) {
            order = ORDER;
            series.extend_to_10::<RATIO>();
            series.extend_to_12::<RATIO>();
            series.extend_to_16::<RATIO>();
            if !within::<ORDER>(series.last::<ORDER>(), most) {
                horizon = length * longest(series.last::<ORDER>(), most).min(1.0);
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
