//! Records beside the spectrum of the ground, NTC 3.2.3.6.

use ground_motion::{Maxima, Spectrum};
use serde::Serialize;

use crate::error::CheckError;
use crate::file::site::Records;
use crate::ntc::ground::GroundSpectrum;
use crate::words::{Sentence, fixed, say};

/// Periods at which spectra are compared, in equal ratios.
const PERIODS: u32 = 100;
/// ξ of the comparison \[-\].
const DAMPING: f64 = 0.05;
/// Bounds of the mean spectrum over that of the ground, NTC 3.2.3.6 \[-\].
pub const BAND: [f64; 2] = [0.9, 1.3];
/// Factors of usual scaling \[-\].
const USUAL: [f64; 2] = [0.25, 4.0];
/// How far a ratio may be off its bound by rounding \[-\].
const ROUNDING: f64 = 1e-9;

/// How the mean spectrum of the records compares with that of the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compatibility {
    /// Least ratio of the mean spectrum to that of the ground \[-\].
    pub least: f64,
    /// Its period \[s\].
    pub least_at: f64,
    /// Largest ratio \[-\].
    pub largest: f64,
    /// Its period \[s\].
    pub largest_at: f64,
    /// Whether they are within 0.9 to 1.3.
    pub compatible: bool,
    /// Largest ratio of a single record \[-\].
    #[serde(skip)]
    pub largest_single: f64,
    /// Mean ratios over the periods, to draw \[s, -\].
    #[serde(skip)]
    pub ratios: Vec<(f64, f64)>,
}

/// Spectra of records over that of the ground.
pub(crate) struct Ratios {
    periods: Vec<f64>,
    /// Of each record, at each period \[-\].
    of_records: Vec<Vec<f64>>,
}

impl Ratios {
    /// Compares the spectra of the records between two periods \[s\].
    ///
    /// # Errors
    /// [`CheckError::Motion`] of a period that is too short for a record.
    pub(crate) fn new(
        records: &Records,
        ground: &GroundSpectrum,
        [from, to]: [f64; 2],
    ) -> Result<Self, CheckError> {
        let period = |index: u32| from * libm::pow(to / from, f64::from(index) / f64::from(PERIODS - 1));
        let periods: Vec<f64> = (0..PERIODS).map(period).collect();
        let spectrum = Spectrum::new(DAMPING, Maxima::Everywhere)?;
        let mut of_records = Vec::new();
        for record in &records.named {
            let found = spectrum.accelerations(&record.motion, &periods)?;
            let ratios =
                found.iter().zip(&periods).map(|(sa, period)| sa / ground.acceleration(*period, DAMPING));
            of_records.push(ratios.collect());
        }
        Ok(Self { periods, of_records })
    }

    /// The factors that bring each record to the spectrum in the mean of the logarithms, and all of them so
    /// that their mean is nowhere below 0.9 of it.
    pub(crate) fn factors(&self) -> Vec<f64> {
        let one = |ratios: &Vec<f64>| {
            (-ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp()
        };
        let factors: Vec<f64> = self.of_records.iter().map(one).collect();
        let least = self.means(&factors).into_iter().fold(f64::INFINITY, f64::min);
        let common = (BAND[0] / least).max(1.0);
        factors.into_iter().map(|factor| common * factor).collect()
    }

    fn means(&self, factors: &[f64]) -> Vec<f64> {
        let count = self.of_records.len() as f64;
        let mean = |index: usize| {
            let all = self.of_records.iter().zip(factors).map(|(ratios, factor)| factor * ratios[index]);
            all.sum::<f64>() / count
        };
        (0..self.periods.len()).map(mean).collect()
    }

    /// Judges the records with their factors.
    pub(crate) fn judged(&self, factors: &[f64]) -> Compatibility {
        let ratios: Vec<(f64, f64)> = self.periods.iter().copied().zip(self.means(factors)).collect();
        let by_ratio = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let none = (f64::NAN, f64::NAN);
        let (least_at, least) = ratios.iter().min_by(by_ratio).copied().unwrap_or(none);
        let (largest_at, largest) = ratios.iter().max_by(by_ratio).copied().unwrap_or(none);
        let singles = self.of_records.iter().zip(factors);
        let singles = singles.flat_map(|(ratios, factor)| ratios.iter().map(move |ratio| factor * ratio));
        let compatible = least >= BAND[0] * (1.0 - ROUNDING) && largest <= BAND[1] * (1.0 + ROUNDING);
        let largest_single = singles.fold(0.0, f64::max);
        Compatibility { least, least_at, largest, largest_at, compatible, largest_single, ratios }
    }
}

impl Compatibility {
    /// What the engineer should know of the records of a limit state.
    pub(crate) fn warnings(&self, state: &str, factors: impl Iterator<Item = f64>) -> Vec<Sentence> {
        let mut warnings = Vec::new();
        let [low, high] = BAND;
        if !self.compatible {
            warnings.push(say! {
                "{state}: the records are not compatible with the spectrum (NTC 3.2.3.6): their mean is from \
                 {least} (T = {from} s) to {largest} (T = {to} s) of it, beyond {low} to {high}",
                "{state}: gli accelerogrammi non sono compatibili con lo spettro (NTC 3.2.3.6): la loro \
                 media è da {least} (T = {from} s) a {largest} (T = {to} s) volte lo spettro, fuori da \
                 {low}-{high}",
                state, least = fixed(self.least, 3), from = fixed(self.least_at, 3),
                largest = fixed(self.largest, 3), to = fixed(self.largest_at, 3), low, high
            });
        }
        if self.largest_single > high {
            warnings.push(say! {
                "{state}: a single record reaches {reached} of the spectrum, above {high} (C7.11.3.1.2.2)",
                "{state}: un singolo accelerogramma raggiunge {reached} dello spettro, oltre {high} \
                 (C7.11.3.1.2.2)", state, reached = fixed(self.largest_single, 3), high
            });
        }
        let [low, high] = USUAL;
        if let Some(factor) = factors.into_iter().find(|factor| !(low..=high).contains(factor)) {
            warnings.push(say! {
                "{state}: a record is scaled by {factor}; {low} to {high} is usual (C3.2.3.6)",
                "{state}: un accelerogramma è scalato di {factor}; è usuale {low}-{high} (C3.2.3.6)",
                state, factor = fixed(factor, 3), low, high
            });
        }
        warnings
    }
}
