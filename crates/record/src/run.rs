//! The start of a run, its end, and what becomes of it.

use rocking_wall::solver::{State, Work};

use crate::blocks::Blocks;
use crate::solver::RecordSolver;

/// Where a run through a record starts, and what multiplies the record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunStart {
    /// The state at the first sample: u \[m\], u̇ \[m/s\], the branch u is on, and the peaks so far.
    /// [`Motion::start`](rocking_wall::solver::Motion::start) and
    /// [`Motion::start_under`](rocking_wall::solver::Motion::start_under) return it.
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
