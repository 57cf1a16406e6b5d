//! A motion prepared for steps of one length.

use super::super::{Method, Motion, State, Work, is_constant};
use super::step_map::StepMap;

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
    /// For each branch, unless its steps are no affine maps.
    pub(super) maps: Vec<Option<StepMap>>,
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\].
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let mut maps: Vec<Option<StepMap>> = Vec::with_capacity(motion.oscillators.len());
        for (branch, &oscillator) in motion.wall.branches().iter().zip(&motion.oscillators) {
            let affine = match motion.method {
                Method::Exact => true,
                Method::Adaptive { .. } => branch.stiffness > 0.0 && is_constant(branch.damping),
                Method::Newmark { .. } => false,
            };
            let map = (affine && !oscillator.is_spread(2.0 * step)).then(|| {
                // branches on both sides of the wall share their oscillator
                let known = maps.iter().flatten().find(|map| map.oscillator == oscillator);
                known.copied().unwrap_or_else(|| StepMap::new(oscillator, step)).on(branch)
            });
            maps.push(map);
        }
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
