//! What a Taylor series may leave out.

/// The largest terms in u \[m\] and in u̇ \[m/s\] that may be left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tolerances {
    pub(super) displacement: f64,
    pub(super) velocity: f64,
}

impl Tolerances {
    /// Returns the smaller of them for x = u/u₀ and ẋ, with time in steps, of 1/u₀ and the step \[s\].
    #[inline]
    pub(super) fn over(self, inverse: f64, step: f64) -> f64 {
        self.displacement.min(self.velocity * step) * inverse.abs()
    }
}

/// The share of a tolerance that a series may leave out.
pub(super) const CAUTION: f64 = 0.1;

/// Tells whether a series to order N, of which these are the last terms, leaves out no more than `CAUTION`
/// times `most`, of x and of ẋ.
///
/// Pairs of terms fall like a geometric series: from m₀, the larger of orders N − 3 and N − 2, to m₁, the
/// larger of the last two. With q = m₁/m₀ what is left out is 2 m₁ q/(1 − q) at most, and N times that of ẋ.
#[inline(always)]
#[allow(clippy::inline_always, reason = "measured: part of one piece of straight code")]
pub(super) fn within<const N: usize>([a, b, c, d]: [f64; 4], most: f64) -> bool {
    let (before, last) = (a.abs().max(b.abs()), c.abs().max(d.abs()));
    (2 * N) as f64 * last * last <= CAUTION * most * (before - last)
}
