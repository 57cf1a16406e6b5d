//! A horizontal section of a part.

/// The faces and the width of a part or an opening at a height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Place x of the outer face \[m\].
    pub outer: f64,
    /// Place x of the inner face \[m\].
    pub inner: f64,
    /// Length along the wall \[m\].
    pub width: f64,
}

impl Section {
    /// Returns the thickness that two sections share, negative for their distance \[m\].
    pub(super) fn overlap(&self, other: &Self) -> f64 {
        self.inner.min(other.inner) - self.outer.max(other.outer)
    }

    /// Returns whether another section is within this one and narrower, faces within `same` \[m\].
    pub(super) fn contains(&self, other: &Self, same: f64) -> bool {
        self.outer <= other.outer + same && other.inner <= self.inner + same && other.width < self.width
    }
}
