//! How much medians and their ratios owe to the choice of records.

use super::fit::{fit, fit_from};
use super::{FitError, Observing, sample_median, value};
use crate::study::ida::Occurrence;
use crate::study::random::Pcg;

/// Resamples of the records of a study, the same for every model: B. Efron, R. J. Tibshirani: An introduction to the
/// bootstrap. Chapman & Hall, 1993.
///
/// A record is drawn with all its results, so that ratios between models keep what the models have in common.
#[derive(Clone, Debug)]
pub struct Bootstrap {
    /// Places of the records drawn, resample by resample.
    draws: Vec<Vec<u32>>,
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
        let mut random = Pcg::new(seed);
        let count = u32::try_from(records).unwrap_or(u32::MAX);
        #[allow(clippy::cast_possible_truncation, reason = "below `count`")]
        let mut draw = || (0..count).map(|_| random.below(count as usize) as u32).collect();
        Self { draws: (0..samples).map(|_| draw()).collect() }
    }

    /// The medians of the resamples of one model's first exceedances.
    #[must_use]
    pub fn medians(&self, occurrences: &[Occurrence]) -> Vec<f64> {
        let values: Vec<f64> = occurrences.iter().copied().map(value).collect();
        let mut drawn = vec![0.0; values.len()];
        let median = |draw: &Vec<u32>| {
            for (place, &index) in drawn.iter_mut().zip(draw) {
                *place = values[index as usize];
            }
            sample_median(&mut drawn)
        };
        self.draws.iter().map(median).collect()
    }

    /// θ of the fits to the resamples; NaN where one has no fit.
    #[must_use]
    pub fn fitted_medians(&self, occurrences: &[Occurrence], observing: &Observing) -> Vec<f64> {
        let near = fit(&observing.observations(occurrences)).ok();
        let fitted = |draw: &Vec<u32>| -> Result<f64, FitError> {
            let drawn: Vec<Occurrence> = draw.iter().map(|&index| occurrences[index as usize]).collect();
            Ok(fit_from(&observing.observations(&drawn), near)?.median)
        };
        self.draws.iter().map(|draw| fitted(draw).unwrap_or(f64::NAN)).collect()
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
