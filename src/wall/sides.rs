//! A quantity that may differ between u > 0 and u < 0.

use crate::choices::{Rocking, TieSide};

/// One quantity on the sides u > 0 and u < 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sides {
    /// Side u > 0.
    pub positive: f64,
    /// Side u < 0, as a positive number.
    pub negative: f64,
}

impl Sides {
    /// The same quantity on both sides.
    pub fn both(value: f64) -> Self {
        Self { positive: value, negative: value }
    }

    /// Computes the quantity of each side from its sign.
    pub(super) fn each(f: impl Fn(f64) -> f64) -> Self {
        Self { positive: f(1.0), negative: f(-1.0) }
    }

    /// Returns the smaller of both.
    pub fn least(self) -> f64 {
        self.positive.min(self.negative)
    }

    /// Returns the larger of both.
    pub fn most(self) -> f64 {
        self.positive.max(self.negative)
    }

    /// Computes another quantity of each side from this one.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
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

impl Rocking {
    /// Returns the sign of u to which a wall can rock, if it can rock to one side only.
    pub(super) fn free_side(self) -> Option<f64> {
        match self {
            Self::TwoSided => None,
            Self::OneSidedPositive => Some(1.0),
            Self::OneSidedNegative => Some(-1.0),
        }
    }

    /// Returns whether a wall can rock to the side of `sign`.
    pub(super) fn allows(self, sign: f64) -> bool {
        self.free_side().is_none_or(|free| free == sign)
    }
}

impl TieSide {
    /// Returns whether a tie of this side resists displacements of a sign.
    pub(super) fn holds(self, sign: f64) -> bool {
        match self {
            Self::Positive => sign > 0.0,
            Self::Negative => sign < 0.0,
            Self::Both => true,
        }
    }
}
