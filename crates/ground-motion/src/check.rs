//! A quick check of a record: baseline, unit, stated peak, missing start and tail; and of a scaled motion.

use crate::motion::{GroundMotion, floor_index};
use crate::record::Record;
use crate::unit::{STANDARD_GRAVITY, Unit};

/// Largest final velocity of the ground relative to its peak velocity; processed records have less than 0.1
/// %.
const FINAL_VELOCITY: f64 = 0.05;

/// Largest acceleration of the first sample and of the last second, relative to the peak; processed records
/// have up to 2 % and 6 %.
const AT_THE_ENDS: f64 = 0.1;

/// Range of time steps without a warning (s); records have 0.02 s and less, and 0.001 s and more.
const USUAL_STEP: [f64; 2] = [5e-4, 0.1];

/// Range of peaks (g) without a warning about the unit; the strongest records have about 4 g, few have more
/// than 2 g.
const CREDIBLE_PEAK: [f64; 2] = [1e-4, 3.0];

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

/// A sign that a record or a scaled motion is not ready for use.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// Every sample is zero.
    #[error("every sample is 0")]
    NoMotion,
    /// The time step is longer or shorter than that of any record, so the times may not be in seconds.
    #[error("step: {}", unusual(*step))]
    Step {
        /// Time between samples (s).
        step: f64,
    },
    /// The ground still moves at the end.
    #[error(
        "baseline: the ground ends at {last:.3} m/s, its peak velocity is {peak:.3} m/s; correct the baseline"
    )]
    Baseline {
        /// Velocity at the end (m/s).
        last: f64,
        /// Largest velocity (m/s).
        peak: f64,
    },
    /// The peak is out of the range of earthquakes, so the unit may be wrong.
    #[error(
        "unit: a peak of {} g is not credible; are the samples really in {unit}?{}",
        if *peak < 1e-2 { format!("{peak:.3e}") } else { format!("{peak:.2}") },
        credible(others)
    )]
    Unit {
        /// Peak acceleration (g).
        peak: f64,
        /// The unit it was read in.
        unit: Unit,
        /// Units that would give a credible peak.
        others: Vec<Unit>,
    },
    /// The peak of a motion is above or below that of any record, so its scale or a unit may be wrong.
    #[error("motion: a peak of {}; check its scale, and the unit of its PGA or amplitude", strength(*peak))]
    Strength {
        /// Peak acceleration (m/s²).
        peak: f64,
    },
    /// The record starts in the middle of the shaking.
    #[error("start: the first sample has {:.0} % of the peak; is the onset missing?", 100.0 * part)]
    MissingStart {
        /// First sample relative to the peak.
        part: f64,
    },
    /// The record ends in the middle of the shaking.
    #[error("tail: the last second has {:.0} % of the peak; is the end missing?", 100.0 * part)]
    MissingTail {
        /// Largest sample of the last second relative to the peak.
        part: f64,
    },
    /// The file states another peak.
    #[error("peak: the samples have {peak:.5} m/s², the file states {stated:.5} m/s²")]
    StatedPeak {
        /// Largest sample (m/s²).
        peak: f64,
        /// Peak the file states (m/s²).
        stated: f64,
    },
    /// The direction is vertical.
    #[error("vertical: this component is vertical, but records shake walls sideways; use a horizontal one")]
    Vertical,
    /// The file has more samples than it states.
    #[error("samples: the file states {stated} and has {found}; the first {stated} are used")]
    Surplus {
        /// Number of samples in the file.
        found: usize,
        /// Number it states; these are read.
        stated: usize,
    },
    /// The line that closes the last channel is missing, with all its samples there.
    #[error("end: the line that closes the channel is missing, all stated samples are there")]
    Unclosed,
    /// A line has another number of samples than the others, so one may be missing.
    #[error(
        "samples: line {line} has {found} numbers, the others {usual}, and {more} more lines differ; where \
         one is missing, all later samples come too early"
    )]
    Gap {
        /// The first such line, from 1.
        line: usize,
        /// How many samples it has.
        found: usize,
        /// How many most lines have.
        usual: usize,
        /// How many more lines have another number.
        more: usize,
    },
    /// The times of the file, in another unit than seconds, have another step than the stated one.
    #[error("step: the times of the file are {step} s apart; the {stated} s that you state count")]
    StatedStep {
        /// Step of the times (s).
        step: f64,
        /// The step that the user has stated, which counts (s).
        stated: f64,
    },
}

/// Says of a time step (s) what is unusual, and in which unit the times may be.
fn unusual(step: f64) -> String {
    let [shortest, longest] = USUAL_STEP;
    if step > longest {
        return format!(
            "{step} s between samples is longer than records have; are the times in milliseconds, or \
             numbers of samples?"
        );
    }
    let units = [("minutes", 60.0), ("hours", 3600.0), ("days", 86_400.0)];
    let credible = units.into_iter().find(|(_, seconds)| (shortest..=longest).contains(&(seconds * step)));
    let guess = credible.map_or_else(
        || "another unit".to_owned(),
        |(of, seconds)| format!("{of} (a step of {:.2e} s)", seconds * step),
    );
    format!("{step:.3e} s between samples is shorter than records have; are the times in {guess}?")
}

/// Lists the units that would give a credible peak.
fn credible(units: &[Unit]) -> String {
    let units: Vec<_> = units.iter().map(|unit| unit.name()).collect();
    if units.is_empty() { String::new() } else { format!(" Credible would be {}", units.join(" or ")) }
}

/// Says of a peak (m/s²) what records have.
fn strength(peak: f64) -> String {
    let ([low, high], in_g) = (CREDIBLE_PEAK, peak / STANDARD_GRAVITY);
    if in_g > high {
        format!("{peak:.1} m/s² is {in_g:.1} g, and few records have more than {high} g")
    } else {
        format!("{peak:.1e} m/s² is {in_g:.1e} g, and records of strong motion have more than {low} g")
    }
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

impl Warning {
    /// Warns about the peak of a scaled motion (m/s²), as [`GroundMotion::warning`] does.
    pub fn of_peak(peak: f64) -> Option<Self> {
        (peak != 0.0 && !is_credible(peak, CREDIBLE_PEAK)).then_some(Self::Strength { peak })
    }

    /// Warns about a peak (m/s²), read in a unit, that is outside a range (g).
    pub(crate) fn of_unit(peak: f64, unit: Unit, range: [f64; 2]) -> Option<Self> {
        if is_credible(peak, range) {
            return None;
        }
        let raw = peak / unit.to_si(1.0);
        let others = Unit::ALL.into_iter().filter(|other| *other != unit);
        let others = others.filter(|other| is_credible(other.to_si(raw), range)).collect();
        Some(Self::Unit { peak: peak / STANDARD_GRAVITY, unit, others })
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
        if !(USUAL_STEP[0]..=USUAL_STEP[1]).contains(&step) {
            warnings.push(Warning::Step { step });
        }
        let peak = motion.peak();
        if peak == 0.0 {
            warnings.push(Warning::NoMotion);
            return Check { mean, peak_velocity, final_velocity, warnings };
        }
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

fn is_credible(peak: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&(peak / STANDARD_GRAVITY))
}

/// Finds the largest acceleration of the last second, or of the last twentieth of a record below 20 s.
fn tail(motion: &GroundMotion) -> f64 {
    let samples = motion.samples();
    let length = f64::min(1.0, motion.duration() / 20.0) / motion.step();
    let count = floor_index(length).clamp(1, samples.len());
    samples[samples.len() - count..].iter().fold(0.0, |peak, a| a.abs().max(peak))
}
