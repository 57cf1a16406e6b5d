//! A motion prepared for steps of one length.

use super::super::{Method, Motion, State, Work};
use super::step_map::StepMap;
use crate::wall::Branch;

/// A run through a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunStart {
    /// The state at the first sample.
    pub state: State,
    /// By which the forcing is multiplied.
    pub factor: f64,
}

/// What became of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The state at the end of the record, or where the run stopped.
    pub state: State,
    /// Time of overturning from the start of the record \[s\].
    pub overturning: Option<f64>,
    /// Work done.
    pub work: Work,
    /// The bound on impacts was reached and the wall put to rest.
    pub put_to_rest: bool,
}

/// A motion prepared for steps of one length.
#[derive(Clone, Debug)]
pub struct RecordSolver<'a> {
    pub(super) motion: &'a Motion,
    /// \[s\]
    pub(super) step: f64,
    /// For each branch, unless its steps are left to the general search.
    pub(super) maps: Vec<Option<StepMap>>,
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\].
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let all_constant = motion.wall.has_constant_damping();
        let adaptive = matches!(motion.method, Method::Adaptive { .. });
        let map = |(index, branch): (usize, &Branch)| match (&motion.method, &motion.secants[index]) {
            (Method::Newmark { .. }, _) => None,
            (_, Some(secant)) => StepMap::curved(branch, *secant, step),
            // where nothing but the method asks for series, it has them on all but the elastic branch
            (_, None) if adaptive && all_constant && branch.stiffness <= 0.0 => None,
            (_, None) => StepMap::affine(branch, motion.oscillators[index], step),
        };
        let maps = motion.wall.branches().iter().enumerate().map(map).collect();
        Self { motion, step, maps }
    }

    /// Returns the largest |f| between the corners of the branches that have maps, for |u| up to `reach`
    /// \[m/s²\].
    pub(super) fn largest_force(&self, reach: f64) -> f64 {
        let mut largest = 0.0_f64;
        for map in self.maps.iter().flatten() {
            let [lower, upper] = [map.corners[0].max(-reach), map.corners[1].min(reach)];
            if lower <= upper {
                largest = largest.max(map.force(lower).abs()).max(map.force(upper).abs());
            }
        }
        largest
    }
}

/// Observes no sample: one function for all who ask for none, so that their runs share one code.
#[inline(always)]
pub(super) fn unseen(_: usize, _: f64, _: f64) {}
