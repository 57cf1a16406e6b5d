//! A motion prepared for steps of one length, the start of a run, and what becomes of it.

use rocking_wall::solver::{Motion, State, Work};

use crate::forcing::Blocks;
use crate::table::BranchTable;

/// Where a run through a record starts, and what multiplies the record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunStart {
    /// The state at the first sample: u \[m\], u̇ \[m/s\], the branch u is on, and the peaks so far.
    /// [`Motion::start`] and [`Motion::start_under`] return it.
    pub state: State,
    /// The factor of the [`Forcing`](crate::Forcing) \[-\], of either sign.
    pub factor: f64,
}

/// Where a run ends, if not in an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// At the last sample.
    OfRecord,
    /// At the end of the step in which the wall overturns.
    AtOverturning,
    /// At overturning, and no further than to where the rest of the record cannot raise the peaks. These have
    /// the same bits as if the run went on; the state is that where it ends.
    AtPeaks,
}

/// A run among others of any walls through any records ([`run_together`](crate::run_together)).
#[derive(Clone, Copy, Debug)]
pub struct BatchRun<'a> {
    /// The wall, prepared for the step of the record.
    pub solver: &'a RecordSolver<'a>,
    /// The record.
    pub record: &'a Blocks<'a>,
    /// The start, and the factor of the record.
    pub start: RunStart,
}

/// What became of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The state at the last sample, or at the end of the step in which the run stopped. Its peaks include
    /// extremes between samples.
    pub state: State,
    /// Time of overturning from the first sample \[s\], 0 for a wall that had overturned before; `None` if it
    /// stands.
    pub overturning: Option<f64>,
    /// Pieces of motion, corners passed and impacts.
    pub work: Work,
    /// Whether a step reached the bound on impacts and the wall was put to rest.
    pub put_to_rest: bool,
}

/// Callback, called at each sample.
pub(crate) trait Observer {
    const SEES: bool;
    fn see(&mut self, index: usize, u: f64, v: f64);
}

/// An observer that ignores the motion.
pub(crate) struct NoObserver;

impl Observer for NoObserver {
    const SEES: bool = false;

    #[inline(always)]
    fn see(&mut self, _: usize, _: f64, _: f64) {}
}

impl Observer for &mut dyn FnMut(usize, f64, f64) {
    const SEES: bool = true;

    fn see(&mut self, index: usize, u: f64, v: f64) {
        self(index, u, v);
    }
}

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
    /// Factor on u̇ at an impact.
    pub(crate) passage_factor: f64,
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\], which is above zero. What is prepared serves all records with that
    /// step.
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let passage_factor = motion.wall().passage_factor();
        Self { motion, step, table: BranchTable::new(motion, step), passage_factor }
    }

    /// Returns the motion whose steps are prepared.
    pub fn motion(&self) -> &'a Motion {
        self.motion
    }
}
