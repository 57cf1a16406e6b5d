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
