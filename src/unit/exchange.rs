//! What an instance for Model Exchange remembers.

use crate::simulation::Excitation;
use crate::wall::Support;

/// What an instance for Model Exchange stores in addition.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Exchange {
    /// |u| is beyond its largest so far, and grows.
    pub(super) rising: bool,
    /// `a_g` at the last event \[m/s²\].
    pub(super) ground: f64,
    pub(super) own_motion: OwnMotion,
}

/// The scene's own motion between two samples, continued linearly beyond them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct OwnMotion {
    /// Seconds from the start of the simulation to its start.
    pub(super) from: f64,
    /// The supports there.
    pub(super) support: Support,
    /// Their rate \[1/s\].
    pub(super) rate: Support,
    /// Seconds from the start of the simulation to the next sample.
    pub(super) end: Option<f64>,
}

impl OwnMotion {
    /// Returns the motion from `elapsed` seconds after the start to the next sample.
    pub(super) fn new(motion: &Excitation, elapsed: f64) -> Self {
        let segment = motion.segment(elapsed, f64::INFINITY);
        let (from, to, duration) = (segment.from, segment.to, segment.duration);
        if !duration.is_finite() {
            return Self { from: elapsed, ..Self::default() };
        }
        let rate = from.with(to, |from, to| (to - from) / duration);
        Self { from: elapsed, support: from, rate, end: Some(elapsed + duration) }
    }

    pub(super) fn at(&self, elapsed: f64) -> Support {
        self.support.with(self.rate, |value, rate| value + rate * (elapsed - self.from))
    }
}
