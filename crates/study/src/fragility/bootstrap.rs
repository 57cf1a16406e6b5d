//! Uncertainty of medians and their ratios due to the choice of records.

use super::dispersion::Estimator;
use super::fit::Lognormal;
use super::observation::{Sample, median};
use report::table::between;
use run::sample::{Pcg, fractile, sample_median};

use crate::ida::Exceedance;

/// Resamples of the records of a study, the same for every model.
///
/// A record is drawn with all its results, so that ratios between models keep what the models have in common.
/// B. Efron, R. J. Tibshirani: An introduction to the bootstrap. Chapman & Hall, 1993.
#[derive(Clone, Copy, Debug)]
pub struct Bootstrap {
    records: usize,
    samples: usize,
    seed: u64,
    /// Records that are drawn together.
    group: usize,
}

/// An estimate and its bootstrap interval.
///
/// Where the levels leave a number open, only bounds of it are known. `estimate` and `range`
/// then hold the upper ones, `least` the lower ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Estimate from all records.
    pub estimate: f64,
    /// Lower and upper percentile of the resamples; infinite where it lies above the levels.
    pub range: [f64; 2],
    /// The least that the estimate and the two percentiles can be.
    pub least: [f64; 3],
}

/// An estimate from all records and one from each resample; each is known by the least and the most that it
/// can be.
#[derive(Clone, Debug, PartialEq)]
pub struct Resampled {
    /// Least and most of the estimate from all records.
    pub estimate: [f64; 2],
    /// Least of each resample.
    pub least: Vec<f64>,
    /// Most of each resample.
    pub most: Vec<f64>,
}

impl Bootstrap {
    /// Prepares `samples` resamples of `records` records. The same seed gives the same draws.
    pub fn new(records: usize, samples: usize, seed: u64) -> Self {
        Self { records, samples, seed, group: 1 }
    }

    /// Draws groups of so many records that follow each other, such as a record and its reverse.
    ///
    /// # Panics
    /// If the records are no whole number of groups.
    #[must_use]
    pub fn in_groups(self, group: usize) -> Self {
        assert!(self.records.is_multiple_of(group), "whole groups of records");
        Self { group, ..self }
    }

    /// Returns how many records are drawn together.
    pub fn group(&self) -> usize {
        self.group
    }

    /// Computes something of each resample, from the indices of the records drawn.
    fn each<T>(&self, mut result: impl FnMut(&[usize]) -> T) -> Vec<T> {
        let mut random = Pcg::new(self.seed);
        let mut drawn = vec![0; self.records];
        let resample = |_| {
            for group in drawn.chunks_mut(self.group) {
                let first = random.below(self.records / self.group) * self.group;
                group.iter_mut().zip(first..).for_each(|(place, record)| *place = record);
            }
            result(&drawn)
        };
        (0..self.samples).map(resample).collect()
    }

    /// Returns the median of each resample of one model's exceedances.
    ///
    /// # Panics
    /// If there are fewer exceedances than records.
    pub fn medians(&self, exceedances: &[Exceedance]) -> Vec<f64> {
        let mut resampled = vec![0.0; self.records];
        self.each(|drawn| {
            for (value, &index) in resampled.iter_mut().zip(drawn) {
                *value = exceedances[index].or_infinity();
            }
            sample_median(&mut resampled)
        })
    }

    /// Computes something of each resample, from how often each record was drawn.
    pub(super) fn counted<T>(&self, mut result: impl FnMut(&[u32]) -> T) -> Vec<T> {
        let mut counts = vec![0; self.records];
        self.each(|drawn| {
            counts.fill(0);
            for &record in drawn {
                counts[record] += 1;
            }
            result(&counts)
        })
    }

    /// Fits the curves of each resample: of each limit state θ with the bounds of those that have no fit, and
    /// β, which is not a number then.
    ///
    /// # Panics
    /// As [`medians`](Self::medians).
    pub fn fitted(&self, states: &[Sample], estimator: &Estimator) -> Vec<[Resampled; 2]> {
        let prepared: Vec<_> = states.iter().map(Sample::prepared).collect();
        let fit = |counts: &[u32], near: &[_]| {
            let terms: Vec<_> = prepared.iter().map(|state| state.terms(counts)).collect();
            estimator.fit(&terms, near)
        };
        let ends = |counts: &[u32], curves: Vec<Result<Lognormal, _>>| -> Vec<[f64; 3]> {
            let bounds = |(fitted, sample): (Result<Lognormal, _>, &Sample)| {
                let Ok(Lognormal { median, dispersion }) = fitted else {
                    let [least, most] = sample.open_bounds(counts);
                    return [least, most, f64::NAN];
                };
                [median, median, dispersion]
            };
            curves.into_iter().zip(states).map(bounds).collect()
        };
        let ones = vec![1; self.records];
        let near = fit(&ones, &[]);
        let samples = self.counted(|counts| ends(counts, fit(counts, &near)));
        let resampled = |(state, [least, most, beta]): (usize, [f64; 3])| {
            let side =
                |side: usize| -> Vec<f64> { samples.iter().map(|sample| sample[state][side]).collect() };
            let [low, high, betas] = [side(0), side(1), side(2)];
            let theta = Resampled { estimate: [least, most], least: low, most: high };
            [theta, Resampled { estimate: [beta; 2], least: betas.clone(), most: betas }]
        };
        ends(&ones, near.clone()).into_iter().enumerate().map(resampled).collect()
    }
}

impl Resampled {
    /// Takes the sample median of exceedances, and those of its resamples.
    pub(super) fn medians(exceedances: &[Exceedance], bootstrap: &Bootstrap) -> Self {
        // a censored record exceeds at least above its levels, one that exceeds at its lowest level anywhere
        // below it
        let least = |exceedance: &Exceedance| match exceedance.bounds() {
            [least, most] if least == 0.0 || most == f64::INFINITY => Exceedance::At(least),
            _ => *exceedance,
        };
        let least: Vec<_> = exceedances.iter().map(least).collect();
        Self {
            estimate: [median(&least), median(exceedances)],
            least: bootstrap.medians(&least),
            most: bootstrap.medians(exceedances),
        }
    }

    /// Divides by another estimate, resample by resample.
    pub(super) fn over(&self, other: &Self) -> Self {
        let quotients = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a / b).collect();
        let ([least, most], [other_least, other_most]) = (self.estimate, other.estimate);
        Self {
            estimate: [least / other_most, most / other_least],
            least: quotients(&self.least, &other.most),
            most: quotients(&self.most, &other.least),
        }
    }

    /// Encloses the central `part` of the resamples.
    pub(super) fn interval(&self, part: f64) -> Interval {
        let [least, most] = self.estimate;
        let Interval { range: [low, high], .. } = Interval::new(least, self.least.iter().copied(), part);
        let interval = Interval::new(most, self.most.iter().copied(), part);
        Interval { least: [least, low, high], ..interval }
    }
}

impl Interval {
    /// Encloses the central `part` of the resamples' values. Values that are not numbers are left out.
    pub fn new(estimate: f64, resampled: impl IntoIterator<Item = f64>, part: f64) -> Self {
        let mut values: Vec<f64> = resampled.into_iter().filter(|value| !value.is_nan()).collect();
        values.sort_by(f64::total_cmp);
        let tail = 0.5 * (1.0 - part);
        let [low, high] = [tail, 1.0 - tail].map(|part| fractile(&values, part).unwrap_or(f64::NAN));
        Self { estimate, range: [low, high], least: [estimate, low, high] }
    }

    /// Returns the least and the most of the estimate and of the ends of its interval, in a unit.
    pub fn bounds(&self, unit: f64) -> [[f64; 2]; 3] {
        let most = [self.estimate, self.range[0], self.range[1]];
        [0, 1, 2].map(|part| [self.least[part] / unit, most[part] / unit])
    }

    /// Formats the estimate and the ends of its interval in a unit, see [`between`].
    pub fn texts(&self, unit: f64, decimals: usize) -> [String; 3] {
        self.bounds(unit).map(|bounds| between(bounds, |value| format!("{value:.decimals$}")))
    }
}
