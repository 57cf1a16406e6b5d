//! What a Taylor series may leave out.

use super::scaled::Number;

/// The largest terms in u \[m\] and in u̇ \[m/s\] that may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances<N = f64> {
    /// Of u \[m\].
    pub displacement: N,
    /// Of u̇ \[m/s\].
    pub velocity: N,
}

impl<N: Number> Tolerances<N> {
    /// Returns the one dimensionless tolerance that meets both, for x = u/u₀ and for ẋ with time in lengths
    /// L: the smaller of the two, from 1/u₀ \[1/m\] and L \[s\].
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "measured: part of one piece of straight code")]
    pub fn over(self, inverse: N, length: N) -> N {
        // min(a, b) = −max(−a, −b)
        let smaller = -(length * -self.velocity).max(-self.displacement);
        smaller * inverse.abs()
    }
}

/// The share of a tolerance that a series may leave out.
pub const CAUTION: f64 = 0.1;

/// Returns a number that is positive where a series to order N leaves out more than `CAUTION` times `most` of
/// x or of ẋ. The argument holds the last four terms of the series.
///
/// Pairs of terms fall like a geometric series: from m₀, the larger of those of orders N − 3 and N − 2, to
/// m₁, the larger of the last two. With q = m₁/m₀ at most 2 m₁ q/(1 − q) of x is left out, and N times as
/// much of ẋ (docs/record-path.md, Eq. (6)).
#[inline(always)]
#[allow(clippy::inline_always, reason = "measured: part of one piece of straight code")]
pub fn excess<T: Number, const N: usize>([a, b, c, d]: [T; 4], most: T) -> T {
    let (before, last) = (a.abs().max(b.abs()), c.abs().max(d.abs()));
    last * last * (2 * N) as f64 - most * CAUTION * (before - last)
}
