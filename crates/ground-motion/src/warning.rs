//! What a record or a scaled motion gives reason to warn about.

use crate::unit::{STANDARD_GRAVITY, Unit};

/// Range of peaks (g) without a warning about the unit; the strongest records have about 4 g, few have more
/// than 2 g.
pub(crate) const CREDIBLE_PEAK: [f64; 2] = [1e-4, 3.0];

/// Range of time steps without a warning (s); records have 0.02 s and less, and 0.001 s and more.
const USUAL_STEP: [f64; 2] = [5e-4, 0.1];

/// A sign that a record or a scaled motion is not ready for use.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
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
         one is missing, all later samples come too early{}",
        if *found == 0 { ", and behind an empty line or a comment another record may begin" } else { "" }
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
    /// The first sample may be the number of samples, or their step.
    #[error(
        "samples: the first, {first}, is the number of those that follow, or their step; if it is no \
         sample, begin its line with `# `"
    )]
    FirstNumber {
        /// The first sample, in the unit of the file.
        first: f64,
    },
    /// One sample is far above all others, so it may stand for a missing one.
    #[error(
        "spike: sample {place} has {:.3} g, all others at most {:.3} g; correct it if it stands for a \
         missing value, such as -999", peak / STANDARD_GRAVITY, others / STANDARD_GRAVITY
    )]
    Spike {
        /// Which sample it is, from 1.
        place: usize,
        /// Its size (m/s²).
        peak: f64,
        /// Largest size of all others (m/s²).
        others: f64,
    },
    /// The file has another step than the stated one: in its header, or by times in another unit.
    #[error("step: the file has {step} s between samples; the {stated} s that you state count")]
    StatedStep {
        /// Step of the file (s).
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

impl Warning {
    /// Warns about the peak of a scaled motion (m/s²), as
    /// [`GroundMotion::warning`](crate::GroundMotion::warning) does.
    pub fn of_peak(peak: f64) -> Option<Self> {
        (peak != 0.0 && !is_credible(peak, CREDIBLE_PEAK)).then_some(Self::Strength { peak })
    }

    /// Warns about a time step (s) that is longer or shorter than that of any record.
    pub fn of_step(step: f64) -> Option<Self> {
        (!(USUAL_STEP[0]..=USUAL_STEP[1]).contains(&step)).then_some(Self::Step { step })
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

fn is_credible(peak: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&(peak / STANDARD_GRAVITY))
}
