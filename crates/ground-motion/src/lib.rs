//! Ground motions: acceleration histories that shake a wall.
//!
//! ```text
//! file ── record (a format) ──┐
//! pulse, harmonic ── pulse ───┼──► GroundMotion: uniform step, m/s², linear between samples, zero outside
//! seed ── synthetic ──────────┘
//! ```
//!
//! [`Spectrum`] makes intensities of a motion, [`Record::check`] looks for what is wrong with a record.
//!
//! A [`GroundMotion`] that exists is valid: a positive step, at least two samples, all finite. Units are converted
//! where a file is read and nowhere else.

mod at2;
mod check;
mod cosmos;
mod csmip;
mod csv;
mod error;
mod esm;
mod fields;
mod format;
mod knet;
mod pulse;
mod record;
mod smc;
pub mod spectrum;
mod synthetic;
mod unit;

use std::sync::Arc;

pub use check::{Check, Finding};
pub use error::GroundMotionError;
pub use format::Format;
pub use pulse::{Pulse, Shape};
pub use record::{MAX_FILE_BYTES, ReadOptions, Record, parse, parse_channels, read, read_channels};
pub use spectrum::{Peaks, Spectrum};
pub use synthetic::SyntheticMotion;
pub use unit::{STANDARD_GRAVITY, Unit};

/// An acceleration history with a uniform step; sample i is at the time i · step, the first at zero.
///
/// The acceleration is linear between samples and zero before the first and after the last one. Clones share the
/// samples.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundMotion {
    step: f64,
    samples: Arc<[f64]>,
}

impl GroundMotion {
    /// A motion from its step (s) and its samples (m/s²).
    ///
    /// # Errors
    /// If the step is not positive or the duration not finite, if there are fewer than two samples, if a sample is not
    /// finite.
    pub fn new(step: f64, samples: Vec<f64>) -> Result<Self, GroundMotionError> {
        if samples.len() < 2 {
            return Err(GroundMotionError::TooFewSamples { found: samples.len() });
        }
        if !(step > 0.0 && time_of(samples.len() - 1, step).is_finite()) {
            return Err(GroundMotionError::Step { step });
        }
        if let Some(index) = samples.iter().position(|a| !a.is_finite()) {
            return Err(GroundMotionError::NotFinite { index, value: samples[index] });
        }
        Ok(Self { step, samples: samples.into() })
    }

    /// Time between samples (s).
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The samples (m/s²).
    #[must_use]
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Time of the last sample (s).
    #[must_use]
    pub fn duration(&self) -> f64 {
        time_of(self.samples.len() - 1, self.step)
    }

    /// Acceleration at a time (s), in m/s². At the very end it is the last sample; a NaN time gives zero.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        if !(0.0..=self.duration()).contains(&time) {
            return 0.0;
        }
        let last_interval = self.samples.len() - 2;
        let position = time / self.step;
        let interval = floor_index(position).min(last_interval);
        // At the end the quotient may miss the whole number by its rounding.
        let fraction = (position - index_as_f64(interval)).clamp(0.0, 1.0);
        let (left, right) = (self.samples[interval], self.samples[interval + 1]);
        (1.0 - fraction) * left + fraction * right
    }

    /// Peak ground acceleration: the largest absolute sample (m/s²).
    #[must_use]
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |peak, a| a.abs().max(peak))
    }

    /// The motion with every sample multiplied by `factor`.
    ///
    /// # Panics
    /// If the factor or a scaled sample is not finite; [`checked_scaled`](Self::checked_scaled) is for factors from
    /// outside.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        match self.checked_scaled(factor) {
            Ok(motion) => motion,
            Err(error) => panic!("{error}"),
        }
    }

    /// The motion with every sample multiplied by `factor`.
    ///
    /// # Errors
    /// If the factor or a scaled sample is not finite.
    pub fn checked_scaled(&self, factor: f64) -> Result<Self, GroundMotionError> {
        let peak = self.peak();
        if !factor.is_finite() || !(factor * peak).is_finite() {
            return Err(GroundMotionError::Factor { factor, peak });
        }
        Ok(Self { step: self.step, samples: self.samples.iter().map(|a| factor * a).collect() })
    }

    /// The motion scaled to the peak ground acceleration `pga` (m/s²).
    ///
    /// # Errors
    /// If `pga` is negative or not finite, or if every sample is zero.
    pub fn scaled_to_peak(&self, pga: f64) -> Result<Self, GroundMotionError> {
        if !(pga >= 0.0 && pga.is_finite()) {
            return Err(GroundMotionError::Peak { peak: pga });
        }
        let peak = self.peak();
        if peak == 0.0 {
            return Err(GroundMotionError::NoPeak { peak: pga });
        }
        self.checked_scaled(pga / peak)
    }

    /// The part from the sample nearest to `from` to the one nearest to `to` (s), starting again at time zero.
    ///
    /// # Errors
    /// If the interval does not lie within the record or holds fewer than two samples.
    pub fn trimmed(&self, from: f64, to: f64) -> Result<Self, GroundMotionError> {
        let refused = || GroundMotionError::Trim { from, to, duration: self.duration() };
        let last = self.samples.len() - 1;
        let (first, end) = ((from / self.step).round(), (to / self.step).round());
        // Asks for the two ends in a way that NaN fails.
        if !(first >= 0.0 && first < end && end <= index_as_f64(last)) {
            return Err(refused());
        }
        let samples = &self.samples[floor_index(first)..=floor_index(end)];
        Ok(Self { step: self.step, samples: samples.into() })
    }
}

/// Time of sample `index` (s).
fn time_of(index: usize, step: f64) -> f64 {
    index_as_f64(index) * step
}

/// A sample's index as a number.
#[expect(clippy::cast_precision_loss, reason = "no record has 2^53 samples")]
fn index_as_f64(index: usize) -> f64 {
    index as f64
}

/// The whole part of a position that is known not to be negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, callers bound it"
)]
fn floor_index(position: f64) -> usize {
    position as usize
}
