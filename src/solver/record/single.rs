//! One run by itself.

use super::super::{SolverError, Work};
use super::active_run::{ActiveRun, PlainSteps};
use super::forcing::{Blocks, Forcing};
use super::solver::{Outcome, RecordSolver, RunStart, unseen};

impl RecordSolver<'_> {
    /// Moves a wall through a record; `until_overturning` stops it when it overturns.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed.
    pub fn run(
        &self,
        start: RunStart,
        forcing: Forcing<'_>,
        until_overturning: bool,
    ) -> Result<Outcome, SolverError> {
        self.run_through(start, &Blocks::new(forcing), until_overturning, &mut unseen)
    }

    /// Does the same, and shows `observe` the number, u and u̇ of each sample after the first.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_observed(
        &self,
        start: RunStart,
        forcing: Forcing<'_>,
        until_overturning: bool,
        mut observe: &mut dyn FnMut(usize, f64, f64),
    ) -> Result<Outcome, SolverError> {
        self.run_through(start, &Blocks::new(forcing), until_overturning, &mut observe)
    }

    /// Moves a wall through a record whose blocks are known.
    pub(super) fn run_through(
        &self,
        start: RunStart,
        record: &Blocks<'_>,
        until_overturning: bool,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<Outcome, SolverError> {
        if record.forcing.count() == 0 {
            let overturning = start.state.overturned.then_some(0.0);
            return Ok(Outcome {
                state: start.state,
                overturning,
                work: Work::default(),
                put_to_rest: false,
            });
        }
        ActiveRun::new(self, record, until_overturning, PlainSteps::PAIRS, start).follow(observe)
    }
}
