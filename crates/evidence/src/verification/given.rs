//! Computed numbers beside given ones.

use crate::{Comparison, EvidenceError};

/// The numbers of a study, or why there are none.
pub(super) type Comparisons = Result<Vec<Comparison>, EvidenceError>;

/// Half a unit of the sixth digit.
pub(super) const SIX_DIGITS: f64 = 5e-6;

/// Compares computed numbers with given ones: case, quantity, unit, both numbers.
pub(super) fn within<C: Into<String>, Q: Into<String>>(
    allowed: f64,
    rows: impl IntoIterator<Item = (C, Q, &'static str, f64, f64)>,
) -> Vec<Comparison> {
    let compare = |(case, quantity, unit, computed, given)| {
        Comparison::new(case, quantity, unit, [computed, given], allowed)
    };
    rows.into_iter().map(compare).collect()
}
