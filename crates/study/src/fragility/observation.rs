//! Observations to which a fragility is fitted; medians and steps of exceedances.

use run::sample::sample_median;

use crate::ida::Exceedance;

/// An observation to which a fragility is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observation {
    /// A record that first exceeds the limit state at this intensity.
    At(f64),
    /// A record that does not exceed it up to this intensity: censored. Baker, Eq. (8).
    Above(f64),
    /// A stripe: of `runs` at this intensity, `exceeded` exceed the limit state. Baker, Eq. (11).
    Stripe {
        /// Intensity.
        intensity: f64,
        /// Number of runs.
        runs: u32,
        /// Number of runs that exceed the limit state.
        exceeded: u32,
    },
}

/// Kind of observations that are made of the records' exceedances.
#[derive(Clone, Debug, PartialEq)]
pub enum ObservationKind {
    /// The intensity of each record, for records with levels of their own.
    Records,
    /// Stripes at the levels that all records share. Of a record only the two levels around its exceedance
    /// are known.
    Stripes(Vec<f64>),
}

impl ObservationKind {
    /// Returns the lowest level that all records share, or 0 where they share none.
    pub(super) fn lowest_level(&self) -> f64 {
        match self {
            Self::Records => 0.0,
            Self::Stripes(levels) => levels.iter().copied().reduce(f64::min).unwrap_or(0.0),
        }
    }

    /// Makes observations of the exceedances of some records.
    pub fn observations(&self, exceedances: &[Exceedance]) -> Vec<Observation> {
        let record = |exceedance: &Exceedance| match *exceedance {
            Exceedance::At(intensity) => Observation::At(intensity),
            Exceedance::Above(intensity) => Observation::Above(intensity),
        };
        let count = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        let stripe = |&intensity: &f64| {
            let exceeded = exceedances.iter().filter(|exceedance| exceedance.or_infinity() <= intensity);
            let (runs, exceeded) = (count(exceedances.len()), count(exceeded.count()));
            Observation::Stripe { intensity, runs, exceeded }
        };
        match self {
            Self::Records => exceedances.iter().map(record).collect(),
            Self::Stripes(levels) => levels.iter().map(stripe).collect(),
        }
    }
}

/// Returns the median exceedance: the intensity that half of the records need, infinite where it is above the
/// levels.
pub fn median(exceedances: &[Exceedance]) -> f64 {
    let mut intensities: Vec<f64> = exceedances.iter().map(|exceedance| exceedance.or_infinity()).collect();
    sample_median(&mut intensities)
}

/// Returns the steps of the empirical fragility: intensities in rising order, each with the fraction of the
/// records that exceed the limit state from there on. Censored records count among all records.
pub fn steps(exceedances: &[Exceedance]) -> Vec<(f64, f64)> {
    let mut intensities: Vec<f64> = exceedances.iter().map(|exceedance| exceedance.or_infinity()).collect();
    intensities.retain(|intensity| intensity.is_finite());
    intensities.sort_by(f64::total_cmp);
    let all = exceedances.len() as f64;
    intensities.iter().enumerate().map(|(index, &intensity)| (intensity, (index + 1) as f64 / all)).collect()
}
