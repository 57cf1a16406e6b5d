//! Uncertainty of medians and their ratios due to the choice of records.

use super::fit::{fit, fit_from};
use super::observation::ObservationKind;
use super::sample::{fractile, sample_median};
use crate::ida::Exceedance;
use crate::random::Pcg;

/// Resamples of the records of a study, the same for every model.
///
/// A record is drawn with all its results, so that ratios between models keep what the models have in common.
/// B. Efron, R. J. Tibshirani: An introduction to the bootstrap. Chapman & Hall, 1993.
#[derive(Clone, Copy, Debug)]
pub struct Bootstrap {
    records: usize,
    samples: usize,
    seed: u64,
}

/// An estimate and its bootstrap interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Estimate from all records.
    pub estimate: f64,
    /// Lower and upper percentile of the resamples; infinite where it lies above the levels.
    pub range: [f64; 2],
}

impl Bootstrap {
    /// Prepares `samples` resamples of `records` records. The same seed gives the same draws.
    #[must_use]
    pub fn new(records: usize, samples: usize, seed: u64) -> Self {
        Self { records, samples, seed }
    }

    /// Computes a number of each resample, from the indices of the records drawn.
    fn each(&self, mut number: impl FnMut(&[usize]) -> f64) -> Vec<f64> {
        let mut random = Pcg::new(self.seed);
        let mut drawn = vec![0; self.records];
        let resample = |_| {
            drawn.fill_with(|| random.below(self.records));
            number(&drawn)
        };
        (0..self.samples).map(resample).collect()
    }

    /// Returns the median of each resample of one model's exceedances.
    ///
    /// # Panics
    /// If there are fewer exceedances than records.
    #[must_use]
    pub fn medians(&self, exceedances: &[Exceedance]) -> Vec<f64> {
        let mut resampled = vec![0.0; self.records];
        self.each(|drawn| {
            for (value, &index) in resampled.iter_mut().zip(drawn) {
                *value = exceedances[index].or_infinity();
            }
            sample_median(&mut resampled)
        })
    }

    /// Returns θ of the fit to each resample; NaN where one has no fit.
    ///
    /// # Panics
    /// As [`medians`](Self::medians).
    #[must_use]
    pub fn fitted_medians(&self, exceedances: &[Exceedance], kind: &ObservationKind) -> Vec<f64> {
        let near = fit(&kind.observations(exceedances)).ok();
        self.each(|drawn| {
            let resampled: Vec<Exceedance> = drawn.iter().map(|&index| exceedances[index]).collect();
            fit_from(&kind.observations(&resampled), near).map_or(f64::NAN, |fit| fit.median)
        })
    }
}

impl Interval {
    /// Encloses the central `part` of the resamples' values. Values that are not numbers (a ratio of two
    /// medians above the levels) are left out.
    #[must_use]
    pub fn new(estimate: f64, resampled: impl IntoIterator<Item = f64>, part: f64) -> Self {
        let mut values: Vec<f64> = resampled.into_iter().filter(|value| !value.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let tail = 0.5 * (1.0 - part);
        Self { estimate, range: [tail, 1.0 - tail].map(|part| fractile(&values, part).unwrap_or(f64::NAN)) }
    }
}
