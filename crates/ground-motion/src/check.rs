//! A quick check of a record: baseline, unit, stated peak, missing start and tail; and of a scaled motion.

use crate::motion::{GroundMotion, floor_index};
use crate::record::Record;
use crate::warning::{CREDIBLE_PEAK, Warning};

/// Largest final velocity of the ground relative to its peak velocity; processed records have less than 0.1
/// %.
const FINAL_VELOCITY: f64 = 0.05;

/// Largest acceleration of the first sample and of the last second, relative to the peak; processed records
/// have up to 2 % and 6 %.
const AT_THE_ENDS: f64 = 0.1;

/// Largest difference from the peak that the file states, relative to it.
const STATED_PEAK: f64 = 0.01;

/// Result of a quick check of a record.
///
/// ```
/// use ground_motion::{RecordOptions, Unit, Warning, parse};
///
/// // half a sine in cm/s², read as if it were in g, and without its end
/// let samples: Vec<_> = (0..300).map(|i| (100.0 * (0.01 * f64::from(i)).sin()).to_string()).collect();
/// let (unit, step) = (Some(Unit::StandardGravity), Some(0.01));
/// let options = RecordOptions { unit, step, ..RecordOptions::default() };
/// let check = parse("example.csv", samples.join("\n").into(), &options)?.check();
/// assert_eq!(check.warnings.len(), 3);
/// assert!(matches!(check.warnings[1], Warning::Unit { .. }));
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Check {
    /// Mean acceleration (m/s²).
    pub mean: f64,
    /// Largest velocity of the ground (m/s), from rest.
    pub peak_velocity: f64,
    /// Velocity of the ground at the end (m/s).
    pub final_velocity: f64,
    /// Warnings to look at before the record is used.
    pub warnings: Vec<Warning>,
}

impl GroundMotion {
    /// Warns about a peak above 3 g, or below 1e-4 g unless it is 0. A PGA in gal that is read as if it were
    /// in m/s² has a peak that is too large.
    ///
    /// ```
    /// use ground_motion::SyntheticMotion;
    ///
    /// let motion = SyntheticMotion::default().motion()?;
    /// assert_eq!(motion.scaled_to_peak(3.0)?.warning(), None);
    /// assert!(motion.scaled_to_peak(3e-5)?.warning().is_some());
    /// let warning = motion.scaled_to_peak(300.0)?.warning().unwrap();
    /// assert!(warning.to_string().contains("300.0 m/s² is 30.6 g"));
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    pub fn warning(&self) -> Option<Warning> {
        Warning::of_peak(self.peak())
    }
}

impl Record {
    /// Checks that the time step is that of a record, that the ground comes to rest, that the peak is
    /// credible and agrees with the one that the file states, and that neither the start nor the end of the
    /// shaking is missing.
    pub fn check(&self) -> Check {
        let motion = &self.motion;
        let final_velocity = motion.velocities().last().copied().unwrap_or(0.0);
        let peak_velocity = motion.peak_velocity();
        let samples = motion.samples();
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let step = motion.step();
        let mut warnings = self.warnings.clone();
        if self.is_vertical {
            warnings.push(Warning::Vertical);
        }
        warnings.extend(Warning::of_step(step));
        let peak = motion.peak();
        if peak == 0.0 {
            warnings.push(Warning::NoMotion);
            return Check { mean, peak_velocity, final_velocity, warnings };
        }
        warnings.extend(spike(samples));
        if final_velocity.abs() > FINAL_VELOCITY * peak_velocity {
            warnings.push(Warning::Baseline { last: final_velocity, peak: peak_velocity });
        }
        let is_other = |stated: &f64| (peak - stated).abs() > STATED_PEAK * stated + self.peak_rounding;
        if let Some(stated) = self.stated_peak.filter(is_other) {
            warnings.push(Warning::StatedPeak { peak, stated });
        }
        warnings.extend(Warning::of_unit(peak, self.unit, CREDIBLE_PEAK));
        let start = samples[0].abs() / peak;
        if start > AT_THE_ENDS {
            warnings.push(Warning::MissingStart { part: start });
        }
        let tail = tail(motion) / peak;
        if tail > AT_THE_ENDS {
            warnings.push(Warning::MissingTail { part: tail });
        }
        Check { mean, peak_velocity, final_velocity, warnings }
    }
}

/// Warns about a sample that is several times as large as all others: in records the ratio is below 1.5.
fn spike(samples: &[f64]) -> Option<Warning> {
    const RATIO: f64 = 3.0;
    const FEWEST: usize = 20;
    let (mut place, mut peak, mut others) = (0, 0.0, 0.0_f64);
    for (at, size) in samples.iter().map(|a| a.abs()).enumerate() {
        if size > peak {
            (place, peak, others) = (at, size, peak);
        } else {
            others = others.max(size);
        }
    }
    let is_spike = samples.len() >= FEWEST && others > 0.0 && peak > RATIO * others;
    is_spike.then_some(Warning::Spike { place: place + 1, peak, others })
}

/// Finds the largest acceleration of the last second, or of the last twentieth of a record below 20 s.
fn tail(motion: &GroundMotion) -> f64 {
    let samples = motion.samples();
    let length = f64::min(1.0, motion.duration() / 20.0) / motion.step();
    let count = floor_index(length).clamp(1, samples.len());
    samples[samples.len() - count..].iter().fold(0.0, |peak, a| a.abs().max(peak))
}
