//! Weights of records, which make one count for more than another.

use serde::{Deserialize, Serialize};

/// Probability weights of the records of a study: of each record the share that it stands for, times the
/// number of records, so that their sum is that number. Records with equal weights have the weight 1.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Weights(
    /// Empty where all are 1.
    Vec<f64>,
);

impl Weights {
    /// Takes positive weights of any sum.
    ///
    /// ```
    /// use fragility::Weights;
    ///
    /// assert_eq!(Weights::of(&[2.0, 6.0]).of_record(1), 1.5);
    /// assert_eq!(Weights::of(&[0.1; 7]), Weights::default());
    /// ```
    pub fn of(given: &[f64]) -> Self {
        let mean = given.iter().sum::<f64>() / given.len() as f64;
        // the mean of equal numbers may be a rounding away
        let are_equal = given.iter().all(|weight| (weight / mean - 1.0).abs() < 1e-12);
        Self(if are_equal { Vec::new() } else { given.iter().map(|weight| weight / mean).collect() })
    }

    /// Returns whether all are 1.
    pub fn are_equal(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the weight of a record, by its place.
    pub fn of_record(&self, place: usize) -> f64 {
        self.0.get(place).copied().unwrap_or(1.0)
    }

    /// Returns the number of records of equal weights that tell as much as `records` with these: (Σ w)²/Σ w².
    ///
    /// L. Kish: Survey sampling. Wiley, 1965, section 11.7.
    pub fn effective(&self, records: usize) -> f64 {
        let squares: f64 = (0..records).map(|place| self.of_record(place).powi(2)).sum();
        (records as f64).powi(2) / squares
    }

    /// Multiplies how often each record was drawn by its weight.
    pub(crate) fn times<'a>(&'a self, drawn: &'a [u32]) -> impl Iterator<Item = f64> + Clone + 'a {
        drawn.iter().enumerate().map(|(place, &count)| f64::from(count) * self.of_record(place))
    }
}
