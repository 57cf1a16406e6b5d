//! Sequences: records one after the other, such as a main shock and an aftershock.

use crate::error::{GroundMotionError, check_parameter};
use crate::motion::{GroundMotion, floor_index};

/// Time between the shocks of a sequence that states none (s).
pub const DEFAULT_PAUSE: f64 = 10.0;
/// Most parts of the shortest step of a sequence.
const MOST_PARTS: u32 = 100;
/// Relative difference up to which steps are equal: single precision has 6e-8.
const STEP_ROUNDING: f64 = 1e-6;
/// Most samples of a sequence, of 8 bytes each.
const MOST_SAMPLES: f64 = 2e7;

impl GroundMotion {
    /// Joins shocks to one motion: each begins `pause` (s), in whole steps and at least one, after the last
    /// sample of the one before.
    ///
    /// The step is the longest that divides those of all shocks. A record is linear between its samples, so
    /// that it is the same motion at a shorter step. In a pause of two steps or more, a shock whose first or
    /// last sample is not zero comes and goes within a step.
    ///
    /// ```
    /// use ground_motion::GroundMotion;
    ///
    /// let main = GroundMotion::new(0.02, vec![0.0, 3.0, 0.0])?;
    /// let after = GroundMotion::new(0.01, vec![0.0, 1.0, 0.0])?;
    /// let both = GroundMotion::sequence(&[main, after], 0.02)?;
    /// assert_eq!(both.samples(), [0.0, 1.5, 3.0, 1.5, 0.0, 0.0, 0.0, 1.0, 0.0]);
    /// assert_eq!(both.shocks(), [0..6, 6..9]);
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    ///
    /// # Errors
    /// If there is no shock, if the pause is negative or not finite, if the steps have no common part of at
    /// least a hundredth of the shortest one, or the sequence has more than 2·10⁷ samples.
    pub fn sequence(shocks: &[Self], pause: f64) -> Result<Self, GroundMotionError> {
        check_parameter(pause >= 0.0 && pause.is_finite(), "pause", pause, "from 0 s on and finite")?;
        let step = common_step(shocks)?;
        let parts = |shock: &Self| (shock.step() / step).round();
        let still = (pause / step - STEP_ROUNDING).ceil().max(1.0) - 1.0;
        let length = |shock: &Self| parts(shock) * (shock.samples().len() - 1) as f64 + 1.0;
        let found = shocks.iter().map(length).sum::<f64>() + still * shocks.len().saturating_sub(1) as f64;
        let limit = "at most 2e7; shorten the pause, or resample records so that their steps are equal";
        check_parameter(found <= MOST_SAMPLES, "number of samples of a sequence", found, limit)?;
        let (mut samples, mut later) = (Vec::new(), Vec::new());
        for shock in shocks {
            if !samples.is_empty() {
                samples.resize(samples.len() + floor_index(still), 0.0);
                later.push(samples.len());
            }
            let (first, parts) = (samples.len(), parts(shock));
            later.extend(shock.shocks()[1..].iter().map(|own| first + own.start * floor_index(parts)));
            for pair in shock.samples().windows(2) {
                let between = |part: usize| pair[0] + (pair[1] - pair[0]) * (part as f64 / parts);
                samples.extend((0..floor_index(parts)).map(between));
            }
            samples.extend(shock.samples().last());
        }
        Self::new(step, samples)?.with_later(&later)
    }

    /// Splits off the last shock of a sequence, with the sample before it, which both parts have. `None` of a
    /// single record, and where that sample is not zero.
    pub fn split_last(&self) -> Option<[Self; 2]> {
        let start = self.shocks().last()?.start.checked_sub(1)?;
        let part = |samples: &[f64]| Self::new(self.step(), samples.to_vec()).ok();
        let parts = [part(&self.samples()[..=start])?, part(&self.samples()[start..])?];
        (self.samples()[start] == 0.0).then_some(parts)
    }
}

/// Returns the longest step that divides those of all shocks.
fn common_step(shocks: &[GroundMotion]) -> Result<f64, GroundMotionError> {
    let steps = || shocks.iter().map(GroundMotion::step);
    let [one, value] = [steps().fold(f64::INFINITY, f64::min), steps().fold(0.0, f64::max)];
    let is_whole = |parts: f64| (parts - parts.round()).abs() <= STEP_ROUNDING * parts;
    let divides = |step: &f64| steps().all(|of| is_whole(of / step));
    let mut divided = (1..=MOST_PARTS).map(|parts| one / f64::from(parts));
    let limit =
        "a multiple of a part, down to 1/100, of the shortest step of its sequence; resample a record";
    divided.find(divides).ok_or(GroundMotionError::Parameter { name: "step [s]", value, limit })
}
