//! Taylor series of the motion with a constant damping ratio, in a time in which small u pass slowly.
//!
//! As a function of time, u has a singularity where its branch would reach u = 0: one series holds while u
//! changes by a fraction of its size. With u = u₀ y² and a time σ with dt ∝ y dσ it has none there, as with
//! collisions of bodies in celestial mechanics (Levi-Civita's regularisation). With θ = t/h and c = 2ξ √(f/u)
//! ```text
//! θ′ = y        y″ = y g − κ z y′        z² = 1 + e (y² − 1)
//! g = h² (p − f(u))/(2u₀)        κ = h c(u₀)        e = 1 − f(0)/f(u₀)
//! ```
//! and h u̇/u₀ = 2y′. The step h ends where θ = 1. docs/record-path.md, §7, derives it.

use rocking_wall::solver::secant::{CAUTION, ORDER, Start, half_square, inner};

/// Highest order of these series.
const HIGHEST: usize = 12;
/// Most guesses of the σ that is sought.
const MOST_GUESSES: u32 = 6;
/// Largest |θ − 1| of a guess from which the expansion about it leads to θ = 1.
const SMALL_MISS: f64 = 1e-6;
/// Largest Newton step, over σ, after which the next one would be below rounding.
const SMALL_STEP: f64 = 1e-8;

type Terms = [f64; ORDER + 1];

/// The coefficients of a series, over σ.
#[derive(Clone, Copy)]
pub(crate) struct Regularised {
    y: Terms,
    g: Terms,
    z: Terms,
    /// κ y′.
    d: Terms,
    /// The rate of g over θ.
    rate: f64,
    /// h² k.
    stiffness: f64,
    kappa: f64,
    e: f64,
}

/// Where a series is evaluated: θ, y − 1, y′ and y″.
#[derive(Clone, Copy)]
struct Values {
    theta: f64,
    growth: f64,
    slope: f64,
    bend: f64,
}

/// Sums c₀ + c₁ x + … to the given order, four terms at a time.
#[inline(always)]
fn sum(x: f64, order: usize, c: impl Fn(usize) -> f64) -> f64 {
    let (x2, term) = (x * x, |n| if n <= order { c(n) } else { 0.0 });
    let four = |n| (term(n) + x * term(n + 1)) + x2 * (term(n + 2) + x * term(n + 3));
    (0..order / 4).rev().fold(four(order / 4 * 4), |sum, group| four(4 * group) + x2 * x2 * sum)
}

impl Regularised {
    /// Starts a series: coefficients up to y₂.
    #[inline(always)]
    pub(crate) fn new(start: Start<f64>) -> Self {
        let Start { velocity, driving, rate, half_kappa, stiffness, damping } = start;
        let ones = [1.0; ORDER + 1];
        let (rate, kappa, e) = (0.5 * rate, damping, 1.0 + 2.0 * half_kappa);
        let mut series = Self { y: ones, g: ones, z: ones, d: ones, rate, stiffness, kappa, e };
        series.y[1] = 0.5 * velocity;
        series.g[0] = 0.5 * driving;
        series.d[0] = kappa * series.y[1];
        let second = series.g[0] - series.d[0];
        series.d[1] = kappa * second;
        series.y[2] = 0.5 * second;
        series
    }

    /// Adds gₙ, zₙ, yₙ₊₂ and (κ y′)ₙ₊₁.
    #[inline(always)]
    fn term<const N: usize>(&mut self) {
        let Self { y, g, z, d, .. } = self;
        let theta = y[N - 1] * (1.0 / N as f64);
        // of (y² − 1)/2
        let stretch = if N > 1 { y[N] + half_square::<f64, N>(y) } else { y[N] };
        g[N] = self.rate * theta - self.stiffness * stretch;
        z[N] = if N > 1 { self.e * stretch - half_square::<f64, N>(z) } else { self.e * stretch };
        let mut second = g[0] * y[N] + g[N];
        if N > 1 {
            second += inner::<f64, N>(y, g) - inner::<f64, N>(z, d);
        }
        second = second - z[N] * d[0] - d[N];
        d[N + 1] = second * (self.kappa * (1.0 / (N + 1) as f64));
        y[N + 2] = second * (1.0 / ((N + 1) * (N + 2)) as f64);
    }

    /// Adds the terms up to y₈.
    #[inline(always)]
    fn extend_to_8(&mut self) {
        self.term::<1>();
        self.term::<2>();
        self.term::<3>();
        self.term::<4>();
        self.term::<5>();
        self.term::<6>();
    }

    /// Adds terms until a series up to `sigma` leaves out no more than `most` of u/u₀ and of h u̇/u₀. Returns
    /// the order; `None` where the highest does not reach.
    #[inline(always)]
    fn extend(&mut self, sigma: f64, most: f64) -> Option<usize> {
        // u/u₀ = y² and h u̇/u₀ = 2 y′, and σ need not be 1
        let most = 0.5 * most * sigma.min(1.0);
        if self.reaches::<8>(sigma, most) {
            return Some(8);
        }
        self.term::<7>();
        self.term::<8>();
        if self.reaches::<10>(sigma, most) {
            return Some(10);
        }
        self.term::<9>();
        self.term::<10>();
        self.reaches::<HIGHEST>(sigma, most).then_some(HIGHEST)
    }

    /// Returns whether a series to the even order N leaves out little enough at `sigma`: as
    /// [`excess`](rocking_wall::solver::secant::excess) says, but the q of the numerator is a hundredth at
    /// least. Here the last pair of terms can be small by chance (docs/record-path.md, §7).
    #[inline(always)]
    fn reaches<const N: usize>(&self, sigma: f64, most: f64) -> bool {
        let mut power = sigma;
        for _ in 2..N / 2 {
            power *= sigma * sigma;
        }
        let [a, b, c, d] = [N - 3, N - 2, N - 1, N].map(|n| {
            let term = power * self.y[n];
            power *= sigma;
            term
        });
        let (before, last) = (a.abs().max(b.abs()), c.abs().max(d.abs()));
        (2 * N) as f64 * last * last.max(0.01 * before) <= CAUTION * most * (before - last)
    }

    /// Evaluates the terms up to an order.
    #[inline(always)]
    fn at(&self, order: usize, x: f64) -> Values {
        match order {
            8 => self.at_by::<8>(x),
            10 => self.at_by::<10>(x),
            _ => self.at_by::<HIGHEST>(x),
        }
    }

    #[inline(always)]
    fn at_by<const N: usize>(&self, x: f64) -> Values {
        let y = &self.y;
        Values {
            theta: x * sum(x, N, |n| y[n] * (1.0 / (n + 1) as f64)),
            growth: x * sum(x, N - 1, |n| y[n + 1]),
            slope: sum(x, N - 1, |n| (n + 1) as f64 * y[n + 1]),
            bend: sum(x, N - 2, |n| ((n + 1) * (n + 2)) as f64 * y[n + 2]),
        }
    }

    /// Returns about where the step ends: Halley's rule for θ by the terms up to y₄, from the end for
    /// constant u̇.
    #[inline(always)]
    fn guess(&self) -> f64 {
        let [_, a, b, c, d, ..] = self.y;
        // 2/(1 + √(1 + 2a)) by Padé's approximation
        let x = (1.0 + 0.5 * a) / (1.0 + a);
        let beyond = x * (1.0 + x * (a / 2.0 + x * (b * (1.0 / 3.0) + x * (c / 4.0 + x * d * 0.2)))) - 1.0;
        let value = 1.0 + x * (a + x * (b + x * c));
        // the second-order term is small: y₁ stands for y′ there
        x - beyond * value / (value * value - 0.5 * beyond * a)
    }

    /// Returns u/u₀ − 1 and h u̇/u₀ at the end of the step; `None` where the series leaves out more than
    /// `most` of them.
    #[inline(always)]
    pub(crate) fn end(mut self, most: f64) -> Option<[f64; 2]> {
        self.extend_to_8();
        let guess = self.guess();
        self.end_from(guess, most)
    }

    /// Returns what `end` does, from a guess of the σ at the end and terms up to y₈.
    #[inline(always)]
    fn end_from(&mut self, mut x: f64, most: f64) -> Option<[f64; 2]> {
        for _ in 0..MOST_GUESSES {
            // a guess further on may need a higher order
            let order = self.extend(x, most)?;
            let Values { theta, growth, slope, bend } = self.at(order, x);
            let pace = 1.0 / (1.0 + growth);
            // θ(x + δ) = 1, nearly as in docs/record-path.md, Eq. (4): the next term is below rounding
            let first = (1.0 - theta) * pace;
            let turn = 0.5 * slope * first * pace;
            let shift = first * (1.0 - turn);
            if first.abs() < SMALL_MISS {
                let [growth, slope] = self.shifted(x, [growth, slope, bend], shift);
                return Some([growth * (2.0 + growth), 2.0 * slope]);
            }
            x += shift;
        }
        None
    }

    /// Returns y − 1 and y′ at x + `shift` from y − 1, y′ and y″ at x, to the second order of a small shift.
    /// y‴ is summed up to y₅.
    #[inline(always)]
    fn shifted(&self, x: f64, [growth, slope, bend]: [f64; 3], shift: f64) -> [f64; 2] {
        let third = 6.0 * self.y[3] + x * (24.0 * self.y[4] + x * 60.0 * self.y[5]);
        [growth + shift * (slope + shift * bend / 2.0), slope + shift * (bend + shift * third / 2.0)]
    }

    /// Returns whether y′ keeps its sign up to σ: its first term outweighs all others.
    fn keeps_its_sign(&self, order: usize, x: f64) -> bool {
        let others = (2..=order).rev().fold(0.0, |sum, n| sum * x + n as f64 * self.y[n].abs()) * x;
        others < self.y[1].abs()
    }

    /// Returns about the σ at which y − 1 comes to `goal`: two Newton steps by the terms up to y₈.
    #[inline(always)]
    fn guess_of_passage(&self, goal: f64) -> f64 {
        let mut x = goal / self.y[1];
        for _ in 0..2 {
            let Values { growth, slope, .. } = self.at(8, x);
            x += (goal - growth) / slope;
        }
        x
    }

    /// Returns the θ at which u/u₀ − 1 comes to `rise`, and h u̇/u₀ then; `None` where that is not found at
    /// once, the series leaves out more than `most`, or u̇ may change its sign before.
    #[inline(always)]
    pub(crate) fn passage(mut self, rise: f64, most: f64) -> Option<[f64; 2]> {
        self.extend_to_8();
        let goal = rise / (1.0 + (1.0 + rise).sqrt());
        let mut x = self.guess_of_passage(goal);
        let order = self.extend(x, most)?;
        for _ in 0..MOST_GUESSES {
            let Values { theta, growth, slope, bend } = self.at(order, x);
            let shift = (goal - growth) / slope;
            if shift.abs() < SMALL_STEP * x {
                if !self.keeps_its_sign(order, x) {
                    return None;
                }
                return Some([theta + shift * (1.0 + goal), 2.0 * (slope + shift * bend)]);
            }
            x += shift;
        }
        None
    }
}

#[cfg(test)]
mod tests;
