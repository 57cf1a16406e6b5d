//! Quantities that differ between the two sides of a wall.

/// One quantity on the sides u > 0 and u < 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    /// Side u > 0.
    pub positive: f64,
    /// Side u < 0, as a positive number.
    pub negative: f64,
}

impl Sides {
    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { positive: f(self.positive), negative: f(self.negative) }
    }

    /// The value of the side on which `displacement` lies; u = 0 belongs to the positive one.
    pub fn of(self, displacement: f64) -> f64 {
        if displacement < 0.0 { self.negative } else { self.positive }
    }
}
