//! A quantity that may differ between u > 0 and u < 0.

/// One quantity on the sides u > 0 and u < 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

    /// See [`of`](Self::of).
    pub fn of_mut(&mut self, displacement: f64) -> &mut f64 {
        if displacement < 0.0 { &mut self.negative } else { &mut self.positive }
    }
}
