//! What acts on a wall at its place: records of the ground, motions of floors, spectra given by points.

use std::path::PathBuf;

use ground_motion::GroundMotion;
use rocking_wall::scene::{DEFAULT_TAIL, Floors};
use rocking_wall::wall::Body;
use run::records::NamedRecord;
use run::shaking::felt;

use crate::error::CheckError;

/// The records of a check: motions of the ground at the site.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Their names and motions.
    pub named: Vec<NamedRecord>,
    /// Files that they were read from.
    pub files: Vec<PathBuf>,
    /// Warnings of a quick check of the records.
    pub warnings: Vec<String>,
}

/// The level of shaking of a limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Factors on the records of the code, in their order \[-\].
    pub factors: Vec<f64>,
    /// The storeys below the wall, as the limit state has them.
    pub floors: Option<Floors>,
    /// Whether the code runs each record with both signs.
    pub both_signs: bool,
    /// What is to be known of the factors.
    pub warnings: Vec<String>,
}

impl Records {
    /// Returns the motion that acts on a wall under each record: the record itself, or the motion of its
    /// floors, those of a strip wall by their weights.
    pub(crate) fn felt(&self, floors: Option<&Floors>, body: &Body) -> Result<Vec<GroundMotion>, CheckError> {
        let one = |NamedRecord { motion, .. }: &NamedRecord| {
            Ok(felt(floors, body, motion, DEFAULT_TAIL)?.into_owned())
        };
        self.named.iter().map(one).collect()
    }
}

/// Finds the first of points (T, `S_a`) that is not one of a spectrum: T rises from 0 on, `S_a` is above 0.
pub(crate) fn misplaced(points: &[(f64, f64)]) -> Option<usize> {
    let is_usable = |index: usize| {
        let (period, acceleration) = points[index];
        let rises = if index == 0 { period == 0.0 } else { period > points[index - 1].0 };
        rises && period.is_finite() && acceleration > 0.0 && acceleration.is_finite()
    };
    (0..points.len()).find(|index| !is_usable(*index))
}

/// Returns `S_a` at a period of a spectrum given by points (T, `S_a`), straight between them; `None` beyond
/// its ends.
pub(crate) fn interpolated(points: &[(f64, f64)], period: f64) -> Option<f64> {
    let after = points.partition_point(|point| point.0 < period);
    let &(t1, s1) = points.get(after)?;
    if t1 == period {
        return Some(s1);
    }
    let &(t0, s0) = points.get(after.checked_sub(1)?)?;
    Some(s0 + (s1 - s0) * ((period - t0) / (t1 - t0)))
}
