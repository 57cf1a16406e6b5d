//! Uncertainty of medians and their ratios due to the choice of records.

use std::f64::consts::LN_10;

use report::table::{Digits, between};
use run::parallel::stop_if_asked;
use run::sample::{Pcg, unsorted_fractile};

use crate::curve::Exceedance;
use crate::dispersion::Estimator;
use crate::fit::Lognormal;
use crate::normal::cumulative;
use crate::sample::Sample;
use crate::weights::Weights;

/// Fewest records whose resamples are studentised. Of 4, 5 and 6 records 34, 10 and 2.0 % of the resamples
/// draw two or fewer different ones. Up to 5 they are the 2.5 % at an end of an interval, which then says how
/// close two records happen to be: β has an upper end of 51, 8 and 5 times β̂, in the median.
pub const FEWEST_RECORDS: usize = 6;

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
    /// Whether β is corrected for the number of records.
    corrects: bool,
    /// Number of independent records of equal weights that tell as much.
    effective: f64,
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
    /// Least and most of each resample; of curves, studentised.
    pub samples: Vec<[f64; 2]>,
    /// Of curves, each resample as it was fitted.
    pub drawn: Vec<f64>,
}

impl Bootstrap {
    /// Prepares `samples` resamples of `records` records. The same seed gives the same draws.
    pub fn new(records: usize, samples: usize, seed: u64) -> Self {
        Self { records, samples, seed, group: 1, corrects: false, effective: records as f64 }
    }

    /// Draws groups of so many records that follow each other, such as a record and its reverse.
    ///
    /// # Panics
    /// If the records are no whole number of groups.
    #[must_use]
    pub fn in_groups(self, group: usize) -> Self {
        assert!(self.records.is_multiple_of(group), "whole groups of records");
        let effective = self.effective * (self.group as f64 / group as f64);
        Self { group, effective, ..self }
    }

    /// Takes the weights of the records. Each resample draws records alike, and weighs those drawn: a record
    /// comes with its weight.
    #[must_use]
    pub fn weighted(self, weights: &Weights) -> Self {
        Self { effective: weights.effective(self.records) / self.group as f64, ..self }
    }

    /// Corrects β for the number of records n, or leaves it as fitted.
    ///
    /// The standard deviation of n normal numbers, with the divisor n, has a mean of 1 − 3/(4n) times the
    /// true one, to the order of 1/n.
    #[must_use]
    pub fn corrected(self, corrects: bool) -> Self {
        Self { corrects, ..self }
    }

    /// Returns a curve, with 4n/(4n − 3) times its β where that is [asked for](Self::corrected).
    pub fn correct(&self, fitted: Lognormal) -> Lognormal {
        let n = self.effective;
        let factor = if self.corrects { 4.0 * n / (4.0 * n - 3.0) } else { 1.0 };
        Lognormal { dispersion: factor * fitted.dispersion, ..fitted }
    }

    /// Returns the least probability of which n records tell the order of magnitude, at least 1e-4.
    ///
    /// Of n lognormal intensities z = ln(x/θ)/β has the variance (1 + z²/2)/n, and ln Φ(z) a slope of about
    /// |z|. At this probability, rounded up to one digit, ln P has a standard error of ln 10:
    ///
    /// ```text
    /// z² (1 + z²/2) = n ln² 10
    /// ```
    pub fn least_probability(&self) -> f64 {
        let n = self.effective;
        let square = (1.0 + 2.0 * n * LN_10 * LN_10).sqrt() - 1.0;
        let least = cumulative(-square.sqrt()).max(1e-4);
        let digit = libm::pow(10.0, libm::floor(libm::log10(least)));
        // 1e-4 is one of its digit, to a rounding
        (least / digit - 1e-9).ceil() * digit
    }

    /// Returns which part of the likelihood of all records counts where they are taken as independent: of
    /// records that are drawn together and of unequal weights less than 1.
    pub(crate) fn independent_part(&self) -> f64 {
        self.effective / self.records as f64
    }

    /// Returns how many records are drawn together.
    pub fn group(&self) -> usize {
        self.group
    }

    /// Computes something of each resample, from how often each record was drawn.
    pub(crate) fn counted<T>(&self, mut result: impl FnMut(&[u32]) -> T) -> Vec<T> {
        let mut random = Pcg::new(self.seed);
        let mut counts = vec![0; self.records];
        let resample = |_| {
            counts.fill(0);
            for _ in 0..self.records / self.group {
                let first = random.below(self.records / self.group) * self.group;
                counts[first..first + self.group].iter_mut().for_each(|count| *count += 1);
            }
            result(&counts)
        };
        (0..self.samples).map(resample).collect()
    }

    /// Takes the sample median of the exceedances of each limit state, and those of its resamples.
    ///
    /// # Panics
    /// If there are not as many exceedances as records.
    pub fn medians(&self, states: &[Sample]) -> Vec<Resampled> {
        // a censored record exceeds at least above its levels, one that exceeds at its lowest level anywhere
        // below it
        let least = |exceedance: &Exceedance| match exceedance.bounds() {
            [least, most] if least == 0.0 || most == f64::INFINITY => Exceedance::At(least),
            _ => *exceedance,
        };
        let of_state = |state: &Sample| {
            let least: Vec<_> = state.exceedances().iter().map(least).collect();
            let ends = [&least, state.exceedances()].map(sorted);
            let of = |counts: &[u32]| {
                let weights: Vec<_> = state.weights().times(counts).collect();
                ends.each_ref().map(|sorted| median(sorted, &weights))
            };
            let (estimate, samples) = (of(&vec![1; self.records]), self.counted(of));
            Resampled { estimate, samples, drawn: Vec::new() }
        };
        states.iter().map(of_state).collect()
    }

    /// Fits the curves of each resample: of each limit state θ with the bounds of those that have no fit, and
    /// β, which is not a number then.
    ///
    /// # Panics
    /// As [`medians`](Self::medians).
    pub fn fitted(&self, states: &[Sample], estimator: &Estimator) -> Vec<[Resampled; 2]> {
        let prepared: Vec<_> = states.iter().map(Sample::prepared).collect();
        let mut terms = vec![Vec::new(); states.len()];
        let mut fit = |counts: &[u32], near: &[_]| {
            prepared.iter().zip(&mut terms).for_each(|(state, terms)| state.terms(counts, terms));
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
        let samples = self.counted(|counts| {
            stop_if_asked();
            ends(counts, fit(counts, &near))
        });
        let resampled =
            |(state, all): (usize, [f64; 3])| self.curves(all, &samples.iter().map(|sample| sample[state]));
        ends(&ones, near.clone()).into_iter().enumerate().map(resampled).collect()
    }

    /// Takes θ and β from its least and most and from β, of all records and of each resample, and studentises
    /// the resamples: what a resample has beside all records, all records have beside the truth.
    ///
    /// ```text
    /// ln θˢ = ln θ − (β/β*) ln(θ*/θ)        βˢ = β (β/β*)^k,   k² = n (n + 1)/((n − 1)(n − 2))
    /// ```
    /// The resamples of n lognormal intensities have ln β* with a variance of about (n − 2)/(2 n (n + 1)),
    /// by the mean of their kurtosis, 3 (n − 1)/(n + 1); that of ln β is 1/(2 (n − 1)). k makes up for it. A
    /// resample without a curve keeps its bounds of θ. Efron and Tibshirani, chapters 12 and 13. Resamples of
    /// fewer than [`FEWEST_RECORDS`] are not numbers.
    pub(crate) fn curves(
        &self,
        [least, most, beta]: [f64; 3],
        samples: &(impl Iterator<Item = [f64; 3]> + Clone),
    ) -> [Resampled; 2] {
        let n = self.effective.max(FEWEST_RECORDS as f64);
        let power = (n * (n + 1.0) / ((n - 1.0) * (n - 2.0))).sqrt();
        let studentised = samples.clone().map(|[low, high, own]| {
            if self.effective < FEWEST_RECORDS as f64 {
                return [f64::NAN; 3];
            }
            let narrower = beta / own;
            if !(narrower > 0.0 && narrower.is_finite()) {
                return [low, high, f64::NAN];
            }
            let theta = most * libm::exp(-narrower * libm::log(high / most));
            [theta, theta, beta * libm::pow(narrower, power)]
        });
        let drawn = |part: usize| samples.clone().map(|sample| sample[part]).collect();
        let thetas = studentised.clone().map(|[least, most, _]| [least, most]).collect();
        let betas = studentised.map(|[.., beta]| [beta; 2]).collect();
        [
            Resampled { estimate: [least, most], samples: thetas, drawn: drawn(1) },
            Resampled { estimate: [beta; 2], samples: betas, drawn: drawn(2) },
        ]
    }
}

impl Resampled {
    /// Divides by another estimate, resample by resample.
    pub(crate) fn over(&self, other: &Self) -> Self {
        let quotient = |[least, most]: [f64; 2], over: [f64; 2]| [least / over[1], most / over[0]];
        let samples = self.samples.iter().zip(&other.samples);
        Self {
            estimate: quotient(self.estimate, other.estimate),
            samples: samples.map(|(one, over)| quotient(*one, *over)).collect(),
            drawn: Vec::new(),
        }
    }

    /// Encloses the central `part` of the resamples.
    pub(crate) fn interval(&self, part: f64) -> Interval {
        let [least, most] = [0, 1]
            .map(|end| Interval::new(self.estimate[end], self.samples.iter().map(|ends| ends[end]), part));
        Interval { least: [least.estimate, least.range[0], least.range[1]], ..most }
    }
}

/// Returns the exceedances of records in rising order, with the places of the records.
fn sorted(exceedances: &[Exceedance]) -> Vec<(f64, usize)> {
    let mut sorted: Vec<_> = exceedances.iter().map(|one| one.or_infinity()).zip(0..).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    sorted
}

/// Returns the median of what is sorted, by the weights of the records: the value at which half of them is
/// passed, or the mean of two between which it lies.
fn median(sorted: &[(f64, usize)], weights: &[f64]) -> f64 {
    assert_eq!(sorted.len(), weights.len(), "as many exceedances as records");
    let (half, rounding) = (0.5 * weights.iter().sum::<f64>(), 1e-12 * weights.len() as f64);
    let (mut below, mut lower) = (0.0, None);
    for (value, record) in sorted.iter().filter(|(_, record)| weights[*record] > 0.0) {
        below += weights[*record];
        if let Some(lower) = lower {
            return 0.5 * (lower + value);
        }
        if below > half + rounding {
            return *value;
        }
        // half of the weights lie up to here
        lower = (below > half - rounding).then_some(*value);
    }
    f64::NAN
}

impl Interval {
    /// Encloses the central `part` of the resamples' values. Values that are not numbers are left out.
    pub fn new(estimate: f64, resampled: impl IntoIterator<Item = f64>, part: f64) -> Self {
        let mut values: Vec<f64> = resampled.into_iter().filter(|value| !value.is_nan()).collect();
        let tail = 0.5 * (1.0 - part);
        let [low, high] =
            [tail, 1.0 - tail].map(|part| unsorted_fractile(&mut values, part).unwrap_or(f64::NAN));
        Self { estimate, range: [low, high], least: [estimate, low, high] }
    }

    /// Applies a non-decreasing function.
    #[must_use]
    pub fn mapped(self, function: impl Fn(f64) -> f64) -> Self {
        let Self { estimate, range, least } = self;
        Self { estimate: function(estimate), range: range.map(&function), least: least.map(&function) }
    }

    /// Returns the least and the most of the estimate and of the ends of its interval, in a unit.
    pub fn bounds(&self, unit: f64) -> [[f64; 2]; 3] {
        let most = [self.estimate, self.range[0], self.range[1]];
        [0, 1, 2].map(|part| [self.least[part] / unit, most[part] / unit])
    }

    /// Formats the estimate and the ends of its interval in a unit, see [`between`].
    pub fn texts(&self, unit: f64, digits: Digits) -> [String; 3] {
        self.bounds(unit).map(|bounds| between(bounds, |value| digits.of(value)))
    }
}
