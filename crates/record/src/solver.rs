//! A motion prepared for steps of one length.

use rocking_wall::solver::Motion;

use crate::table::BranchTable;

/// A motion prepared for steps of one length.
///
/// ```
/// use record::{Forcing, RecordSolver, RunEnd, RunStart};
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::{Parameters, Support};
///
/// let parameters = Parameters { u_start: 0.0, ..Parameters::default() };
/// let motion = Motion::of(&parameters, parameters.tolerance)?;
/// // a_g every 10 ms [m/s²]
/// let samples: Vec<f64> = (0..500).map(|n| 0.5 * (0.06 * f64::from(n)).sin()).collect();
/// // p = −λ a_g
/// let factor = motion.wall().body().forcing(Support::rigid(1.0));
/// let start = RunStart { state: motion.start(0.0, 0.0, Support::default()), factor };
/// let solver = RecordSolver::new(&motion, 0.01);
/// let outcome = solver.run(start, Forcing::Samples(&samples), RunEnd::OfRecord)?;
/// assert!(outcome.state.peaks.largest() > 0.0 && outcome.overturning.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RecordSolver<'a> {
    pub(crate) motion: &'a Motion,
    /// Length of the steps \[s\].
    pub(crate) step: f64,
    pub(crate) table: BranchTable,
    /// Factors on u̇ at an impact: of a wall that goes to u < 0 and of one that goes to u > 0.
    pub(crate) passage_factors: [f64; 2],
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\], which is above zero. What is prepared serves all records with that
    /// step.
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let passage_factors = [-1.0, 1.0].map(|velocity| motion.wall().passage_factor(velocity));
        Self { motion, step, table: BranchTable::new(motion, step), passage_factors }
    }

    /// Returns the motion whose steps are prepared.
    pub fn motion(&self) -> &'a Motion {
        self.motion
    }
}
