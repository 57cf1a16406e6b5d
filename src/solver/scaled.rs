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
//! Only the first term takes a division, and each sum ends with the term that is known last. A step is code
//! without branches, and the same code serves a number and a vector of numbers.

#![allow(
    clippy::inline_always,
    reason = "measured: a series is one piece of straight code, its numbers in registers"
)]

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Highest order of these series.
pub const ORDER: usize = 16;

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

/// A number or a vector of numbers, with the operations that a recurrence needs.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// Returns a value in all places of a vector like this one.
    fn like(self, value: f64) -> Self;
    /// Returns |x|.
    fn abs(self) -> Self;
    /// Returns √x.
    fn sqrt(self) -> Self;
    /// Returns the larger of two, neither of which is NaN.
    fn max(self, other: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

/// How damping follows the secant stiffness.
pub trait SecantLaw {
    /// Returns c over its factor, which is ω or ω², from ω² \[1/s²\].
    fn damping<T: Number>(square: T) -> T;

    /// Returns wₙ for n = N, from sₙ/2 and the earlier terms of w.
    fn term<T: Number, const N: usize>(half_s: T, w: &[T; ORDER + 1]) -> T;
}

/// c = 2ξ ω.
#[derive(Debug)]
pub struct ByRatio;

impl SecantLaw for ByRatio {
    #[inline(always)]
    fn damping<T: Number>(square: T) -> T {
        square.sqrt()
    }

    #[inline(always)]
    fn term<T: Number, const N: usize>(half_s: T, w: &[T; ORDER + 1]) -> T {
        if N > 1 { half_s - half_square::<T, N>(w) } else { half_s }
    }
}

/// c = (2ξ₁/ω₁) ω².
#[derive(Debug)]
pub struct ByStiffness;

impl SecantLaw for ByStiffness {
    #[inline(always)]
    fn damping<T: Number>(square: T) -> T {
        square
    }

    #[inline(always)]
    fn term<T: Number, const N: usize>(half_s: T, _: &[T; ORDER + 1]) -> T {
        half_s + half_s
    }
}

/// The Taylor coefficients of u/u₀ over time in lengths L of the step. All are dimensionless.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<T> {
    /// xₙ, those known so far.
    pub x: [T; ORDER + 1],
    z: [T; ORDER + 1],
    s: [T; ORDER + 1],
    w: [T; ORDER + 1],
    half_kappa: T,
    /// k L², c₀ L and L² p₁/u₀.
    stiffness: T,
    damping: T,
    rate: T,
}

/// The start of a series, made dimensionless by u₀ and the length L of the step.
#[derive(Clone, Copy, Debug)]
pub struct Start<T> {
    /// L u̇₀/u₀.
    pub velocity: T,
    /// L² (p₀ − f(u₀))/u₀.
    pub driving: T,
    /// L² p₁/u₀, p being p₀ + p₁ t with t in lengths L.
    pub rate: T,
    /// κ/2.
    pub half_kappa: T,
    /// k L².
    pub stiffness: T,
    /// c₀ L.
    pub damping: T,
}

/// Computes Σ aᵢ bₙ₋ᵢ for 0 < i < N.
#[inline(always)]
pub fn inner<T: Number, const N: usize>(a: &[T; ORDER + 1], b: &[T; ORDER + 1]) -> T {
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
pub fn half_square<T: Number, const N: usize>(a: &[T; ORDER + 1]) -> T {
    let middle = a[N / 2] * a[N - N / 2];
    let mut sum = if N.is_multiple_of(2) { middle * 0.5 } else { middle };
    for i in (1..N / 2).rev() {
        sum = sum + a[i] * a[N - i];
    }
    sum
}

/// Adds the terms n of a series.
macro_rules! terms {
    ($series:ident: $($n:literal)*) => { $($series.term::<$n, L>();)* };
}

impl<T: Number> Scaled<T> {
    /// Starts a series: coefficients up to x₂.
    #[inline(always)]
    pub fn new(start: Start<T>) -> Self {
        let Start { velocity, driving, rate, half_kappa, stiffness, damping } = start;
        let ones = [velocity.like(1.0); ORDER + 1];
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
    fn term<const N: usize, L: SecantLaw>(&mut self) {
        let x = self.x[N];
        let mut half_s = self.half_kappa * x;
        if N > 1 {
            half_s = half_s - inner::<T, N>(&self.x, &self.s) * 0.5;
        }
        self.s[N] = half_s + half_s;
        self.w[N] = L::term::<T, N>(half_s, &self.w);
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
    pub fn extend_to_8<L: SecantLaw>(&mut self) {
        terms!(self: 1 2 3 4 5 6);
    }

    /// Adds the terms up to x₁₀.
    #[inline(always)]
    pub fn extend_to_10<L: SecantLaw>(&mut self) {
        terms!(self: 7 8);
    }

    /// Adds the terms up to x₁₂.
    #[inline(always)]
    pub fn extend_to_12<L: SecantLaw>(&mut self) {
        terms!(self: 9 10);
    }

    /// Adds the terms up to x₁₆.
    #[inline(always)]
    pub fn extend_to_16<L: SecantLaw>(&mut self) {
        terms!(self: 11 12 13 14);
    }

    /// Returns u/u₀ − 1 and L u̇/u₀ at the end of the step, by the terms up to N, which were added before.
    #[inline(always)]
    pub fn end<const N: usize>(&self) -> [T; 2] {
        let (mut x, mut velocity) = (self.x[1], self.x[1]);
        for n in 2..=N {
            x = x + self.x[n];
            velocity = velocity + self.x[n] * n as f64;
        }
        [x, velocity]
    }

    /// Returns the coefficients of order N − 3 to N, for [`excess`](super::secant::excess).
    #[inline(always)]
    pub fn last<const N: usize>(&self) -> [T; 4] {
        [self.x[N - 3], self.x[N - 2], self.x[N - 1], self.x[N]]
    }
}
