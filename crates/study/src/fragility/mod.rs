//! Fragilities: the probability that a demand is exceeded, over the intensity.
//!
//! Empirical steps, and lognormal curves fitted by maximum likelihood.
//!
//! ```text
//! P(exceeded | IM = x) = Φ(ln(x/θ)/β)
//! ```
//! J. W. Baker: Efficient analytical fragility function fitting using dynamic structural analysis. Earthquake Spectra
//! 31(1), 2015, 579–599.

mod bootstrap;
mod compare;
mod fit;
mod normal;

use super::ida::Occurrence;

pub use bootstrap::{Bootstrap, Interval};
pub use compare::{CONFIDENCE, Summary, compare};
pub use fit::{FitError, Lognormal, fit};
pub use normal::{cumulative, quantile};

/// What a fit learns from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observation {
    /// A record that first exceeds the demand at this intensity.
    At(f64),
    /// A record that does not, up to this intensity: censored. Baker, Eq. (8).
    Above(f64),
    /// A stripe: of `runs` at this intensity, `exceeded` exceed the demand. Baker, Eq. (11).
    Stripe {
        /// The intensity.
        intensity: f64,
        /// Number of runs.
        runs: u32,
        /// How many exceed the demand.
        exceeded: u32,
    },
}

impl From<Occurrence> for Observation {
    fn from(occurrence: Occurrence) -> Self {
        match occurrence {
            Occurrence::At(intensity) => Self::At(intensity),
            Occurrence::Above(intensity) => Self::Above(intensity),
        }
    }
}

/// How records become observations.
#[derive(Clone, Debug, PartialEq)]
pub enum Observing {
    /// Each record's own intensity, known to a fraction of β.
    Exactly,
    /// Stripes at levels that all records share: what is known of a record is between which two it lies.
    InStripes(Vec<f64>),
}

impl Observing {
    /// The observations that the first exceedances of some records make.
    #[must_use]
    pub fn observations(&self, occurrences: &[Occurrence]) -> Vec<Observation> {
        match self {
            Self::Exactly => occurrences.iter().copied().map(Observation::from).collect(),
            Self::InStripes(levels) => {
                let stripe = |&intensity: &f64| {
                    let exceeded = |occurrence: &&Occurrence| match **occurrence {
                        Occurrence::At(at) => at <= intensity,
                        Occurrence::Above(_) => false,
                    };
                    let count = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
                    Observation::Stripe {
                        intensity,
                        runs: count(occurrences.len()),
                        exceeded: count(occurrences.iter().filter(exceeded).count()),
                    }
                };
                levels.iter().map(stripe).collect()
            }
        }
    }
}

/// Median of first exceedances: the intensity that half of the records need, infinite where it lies above the levels.
#[must_use]
pub fn median(occurrences: &[Occurrence]) -> f64 {
    let mut intensities: Vec<f64> = occurrences.iter().copied().map(value).collect();
    sample_median(&mut intensities)
}

/// The steps of the empirical fragility: intensities in rising order, each with the part of the records that exceed the
/// demand from there on. Censored records count among all records.
#[must_use]
pub fn steps(occurrences: &[Occurrence]) -> Vec<(f64, f64)> {
    let mut intensities: Vec<f64> =
        occurrences.iter().copied().map(value).filter(|intensity| intensity.is_finite()).collect();
    intensities.sort_by(f64::total_cmp);
    let all = occurrences.len() as f64;
    intensities.iter().enumerate().map(|(index, &intensity)| (intensity, (index + 1) as f64 / all)).collect()
}

/// The value below which a part of a sorted sample lies: the smallest that at least this part does not exceed.
#[must_use]
pub fn fractile(sorted: &[f64], part: f64) -> Option<f64> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to the length")]
    let place = (part * sorted.len() as f64 - 1e-9).ceil().max(1.0) as usize;
    sorted.get(place - 1).copied()
}

/// Intensity of a first exceedance, infinite for a censored record.
fn value(occurrence: Occurrence) -> f64 {
    match occurrence {
        Occurrence::At(intensity) => intensity,
        Occurrence::Above(_) => f64::INFINITY,
    }
}

/// The middle value, or the mean of the two in the middle.
fn sample_median(values: &mut [f64]) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let middle = values.len() / 2;
    let even = values.len().is_multiple_of(2);
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    if !even {
        return upper;
    }
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (lower + upper)
}
