//! Differences between model and test.

/// Size of some differences \[-\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Root of their mean square.
    pub rms: f64,
    /// The largest.
    pub largest: f64,
}

impl Difference {
    /// Measures differences.
    ///
    /// # Panics
    /// If there is none.
    pub(super) fn of(differences: impl IntoIterator<Item = f64>) -> Self {
        let differences: Vec<f64> = differences.into_iter().collect();
        assert!(!differences.is_empty(), "no point is compared");
        let squares: f64 = differences.iter().map(|difference| difference * difference).sum();
        Self {
            rms: (squares / differences.len() as f64).sqrt(),
            largest: differences.iter().fold(0.0, |largest, difference| largest.max(difference.abs())),
        }
    }
}
