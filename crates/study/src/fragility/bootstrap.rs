//! How much medians and their ratios owe to the choice of records.

use super::fit::{fit, fit_from};
use super::{Observing, sample_median, value};
use crate::ida::Occurrence;
use crate::random::Pcg;

/// Resamples of the records of a study, the same for every model: B. Efron, R. J. Tibshirani: An introduction to the
/// bootstrap. Chapman & Hall, 1993.
///
/// A record is drawn with all its results, so that ratios between models keep what the models have in common.
#[derive(Clone, Copy, Debug)]
pub struct Bootstrap {
    records: usize,
    samples: usize,
    seed: u64,
}

/// An estimate and its bootstrap interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// From all records.
    pub estimate: f64,
    /// Lower and upper percentile of the resamples; infinite where the median of so many lies above the levels.
    pub range: [f64; 2],
}

impl Bootstrap {
    /// `samples` resamples of `records` records. The same seed gives the same draws.
    #[must_use]
    pub fn new(records: usize, samples: usize, seed: u64) -> Self {
        Self { records, samples, seed }
    }

    /// A number from each resample, which is told by the places of the records drawn.
    fn each(&self, mut number: impl FnMut(&[usize]) -> f64) -> Vec<f64> {
        let mut random = Pcg::new(self.seed);
        let mut drawn = vec![0; self.records];
        let resample = |_| {
            drawn.fill_with(|| random.below(self.records));
            number(&drawn)
        };
        (0..self.samples).map(resample).collect()
    }

    /// The medians of the resamples of one model's first exceedances.
    ///
    /// # Panics
    /// If there are fewer first exceedances than records.
    #[must_use]
    pub fn medians(&self, occurrences: &[Occurrence]) -> Vec<f64> {
        let values: Vec<f64> = occurrences.iter().copied().map(value).collect();
        let mut resampled = vec![0.0; self.records];
        self.each(|drawn| {
            for (place, &index) in resampled.iter_mut().zip(drawn) {
                *place = values[index];
            }
            sample_median(&mut resampled)
        })
    }

    /// θ of the fits to the resamples; NaN where one has no fit.
    ///
    /// # Panics
    /// As [`medians`](Self::medians).
    #[must_use]
    pub fn fitted_medians(&self, occurrences: &[Occurrence], observing: &Observing) -> Vec<f64> {
        let near = fit(&observing.observations(occurrences)).ok();
        self.each(|drawn| {
            let resampled: Vec<Occurrence> = drawn.iter().map(|&index| occurrences[index]).collect();
            fit_from(&observing.observations(&resampled), near).map_or(f64::NAN, |fit| fit.median)
        })
    }
}

impl Interval {
    /// The estimate with the central `part` of the resamples' values; those that are not numbers (a ratio of two
    /// medians above the levels) are left out.
    #[must_use]
    pub fn new(estimate: f64, resampled: impl IntoIterator<Item = f64>, part: f64) -> Self {
        let mut values: Vec<f64> = resampled.into_iter().filter(|value| !value.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let tail = 0.5 * (1.0 - part);
        let at = |part: f64| super::fractile(&values, part).unwrap_or(f64::NAN);
        Self { estimate, range: [at(tail), at(1.0 - tail)] }
    }
}
