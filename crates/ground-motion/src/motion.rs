//! Ground motions: accelerations at a uniform step.

use std::ops::Range;
use std::sync::Arc;

use crate::error::{GroundMotionError, check_parameter};

/// An acceleration history with a uniform step; sample i is at the time i · step, the first at zero.
///
/// The acceleration is linear between samples and zero before the first and after the last one. Clones share
/// the samples.
///
/// ```
/// use ground_motion::GroundMotion;
///
/// let motion = GroundMotion::new(0.01, vec![0.0, 1.5, -2.0, 0.5])?;
/// assert_eq!((motion.duration(), motion.peak()), (0.03, 2.0));
/// assert_eq!(motion.at(0.005), 0.75);
/// assert_eq!(motion.scaled_to_peak(1.0)?.samples(), [0.0, 0.75, -1.0, 0.25]);
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GroundMotion {
    step: f64,
    samples: Arc<[f64]>,
    /// First samples of the shocks of a sequence after the first one; `None` of a single record.
    later: Option<Arc<[usize]>>,
}

impl GroundMotion {
    /// Makes a motion of its step (s) and its samples (m/s²).
    ///
    /// # Errors
    /// If the step is not positive or the duration not finite, if there are fewer than two samples, if a
    /// sample is not a number from −10⁶ to 10⁶ m/s².
    pub fn new(step: f64, samples: Vec<f64>) -> Result<Self, GroundMotionError> {
        if samples.len() < 2 {
            return Err(GroundMotionError::TooFewSamples { found: samples.len() });
        }
        if !(step > 0.0 && ((samples.len() - 1) as f64 * step).is_finite()) {
            return Err(GroundMotionError::Step { step });
        }
        if let Some(index) = samples.iter().position(|a| !is_possible(*a)) {
            return Err(GroundMotionError::NotFinite { index, value: samples[index] });
        }
        Ok(Self { step, samples: samples.into(), later: None })
    }

    /// Returns the time between samples (s).
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Returns the samples (m/s²).
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Takes the motion as a sequence whose later shocks begin at these samples: between 0 and the last
    /// one, in rising order.
    ///
    /// # Errors
    /// If they are not.
    pub fn with_later(self, later: &[usize]) -> Result<Self, GroundMotionError> {
        let rises = [&[0], later, &[self.samples.len() - 1]].concat().is_sorted_by(|a, b| a < b);
        let limit = "those of samples that rise from above 0 to below the last one";
        check_parameter(rises, "number of shocks after the first one", later.len() as f64, limit)?;
        Ok(Self { later: (!later.is_empty()).then(|| later.into()), ..self })
    }

    /// Returns the samples of each shock of a sequence, with the pause after it; of a single record all.
    pub fn shocks(&self) -> Vec<Range<usize>> {
        let later = self.later.as_deref().unwrap_or_default();
        let ends = later.iter().copied().chain([self.samples.len()]);
        [0].iter().chain(later).zip(ends).map(|(&start, end)| start..end).collect()
    }

    /// Returns the time of the last sample (s).
    pub fn duration(&self) -> f64 {
        (self.samples.len() - 1) as f64 * self.step
    }

    /// Interpolates the acceleration (m/s²) at a time (s). At the very end it is the last sample; at a time
    /// that is NaN it is zero.
    pub fn at(&self, time: f64) -> f64 {
        if !(0.0..=self.duration()).contains(&time) {
            return 0.0;
        }
        let last_interval = self.samples.len() - 2;
        let position = time / self.step;
        let interval = floor_index(position).min(last_interval);
        // At the end the quotient may miss the whole number by its rounding.
        let fraction = (position - interval as f64).clamp(0.0, 1.0);
        let (left, right) = (self.samples[interval], self.samples[interval + 1]);
        (1.0 - fraction) * left + fraction * right
    }

    /// Computes the peak ground acceleration, the largest absolute sample (m/s²).
    pub fn peak(&self) -> f64 {
        self.samples.iter().fold(0.0, |peak, a| a.abs().max(peak))
    }

    /// Multiplies every sample by `factor`.
    ///
    /// # Panics
    /// Where [`checked_scaled`](Self::checked_scaled) has an error; it is for factors from outside.
    pub fn scaled(&self, factor: f64) -> Self {
        self.checked_scaled(factor).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Multiplies every sample by `factor`.
    ///
    /// # Errors
    /// If the factor is not finite, or a scaled sample beyond 10⁶ m/s².
    pub fn checked_scaled(&self, factor: f64) -> Result<Self, GroundMotionError> {
        self.check_factor(factor)?;
        Ok(Self { samples: self.samples.iter().map(|a| factor * a).collect(), ..self.clone() })
    }

    /// Checks that every sample may be multiplied by `factor`.
    ///
    /// # Errors
    /// As [`checked_scaled`](Self::checked_scaled).
    pub fn check_factor(&self, factor: f64) -> Result<(), GroundMotionError> {
        let peak = self.peak();
        if factor.is_finite() && is_possible(factor * peak) {
            Ok(())
        } else {
            Err(GroundMotionError::Factor { factor, peak })
        }
    }

    /// Scales the motion to the peak ground acceleration `pga` (m/s²).
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

    /// Cuts out the part from the sample nearest to `from` to the one nearest to `to` (s); it starts again at
    /// time zero. The shocks of a sequence that begin in it remain.
    ///
    /// # Errors
    /// If the interval does not lie within the record or holds fewer than two samples.
    pub fn trimmed(&self, from: f64, to: f64) -> Result<Self, GroundMotionError> {
        let (first, end) = ((from / self.step).round(), (to / self.step).round());
        // Written so that NaN is refused.
        if !(first >= 0.0 && first < end && end < self.samples.len() as f64) {
            return Err(GroundMotionError::Trim { from, to, duration: self.duration() });
        }
        let [first, end] = [first, end].map(floor_index);
        let later = self.shocks().into_iter().filter(|shock| first < shock.start && shock.start < end);
        let later: Vec<_> = later.map(|shock| shock.start - first).collect();
        Self::new(self.step, self.samples[first..=end].to_vec())?.with_later(&later)
    }
}

/// Returns whether supports may have an acceleration (m/s²): at most 10⁶, the limit of the inputs of FMUs.
fn is_possible(acceleration: f64) -> bool {
    acceleration.abs() <= 1e6
}

/// Returns the whole part of a position that is not negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates, callers bound it"
)]
pub(crate) fn floor_index(position: f64) -> usize {
    position as usize
}
