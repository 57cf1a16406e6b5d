//! Runs of one wall through one record, multiplied by factors.

use ground_motion::GroundMotion;
use record::{Batch, Forcing, Outcome, RecordSolver, RunStart};
use rocking_wall::solver::{Motion, SolverError};
use rocking_wall::wall::Support;

use crate::free_motion::peak_is_final;

/// A wall under a record: what its runs share.
///
/// ```
/// use ground_motion::SyntheticMotion;
/// use record::RecordSolver;
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::Parameters;
/// use run::shaking::Shaking;
///
/// let record = SyntheticMotion::default().motion()?;
/// let parameters = Parameters { u_start: 0.0, ..Parameters::default() };
/// let motion = Motion::of(&parameters, parameters.tolerance)?;
/// let solver = RecordSolver::new(&motion, record.step());
/// let runs = Shaking::new(&motion, &solver, &record, 10.0).runs([0.0, 0.0], &[0.1, 100.0])?;
/// assert!(runs[0].overturning.is_none() && runs[1].overturning.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Shaking<'a> {
    motion: &'a Motion,
    solver: &'a RecordSolver<'a>,
    batch: Batch<'a>,
    record: &'a GroundMotion,
    tail: f64,
}

impl<'a> Shaking<'a> {
    /// Prepares the runs of a wall through a record and, for `tail` \[s\] after it, in free vibration. The
    /// steps of `solver` are those of the record.
    pub fn new(
        motion: &'a Motion,
        solver: &'a RecordSolver<'a>,
        record: &'a GroundMotion,
        tail: f64,
    ) -> Self {
        let batch = solver.batch(Forcing::Samples(record.samples()));
        Self { motion, solver, batch, record, tail }
    }

    /// Runs the record multiplied by each of some factors, from u and u̇ at its start \[m, m/s\]. A run stops
    /// where the wall overturns. The time of overturning counts from the start of the record.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn runs(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        self.shaken(start, factors, |starts| self.batch.run(starts, true), true)
    }

    /// Runs as [`runs`](Self::runs) does, for the peaks and the time of overturning alone, which have the
    /// same bits: a run also stops where the rest of the record cannot raise its peaks.
    ///
    /// # Errors
    /// As [`runs`](Self::runs).
    pub fn peaks(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        self.shaken(start, factors, |starts| self.batch.run_to_the_peaks(starts), true)
    }

    /// Runs as [`runs`](Self::runs) does, but to the end of the tail: a wall that is back within `u_ins`
    /// there has no time of overturning. That of one that falls is when it first exceeded `u_ins`.
    ///
    /// # Errors
    /// As [`runs`](Self::runs).
    pub fn runs_to_the_end(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        let u_ins = self.motion.wall().body().instability;
        let fate = |outcome: Outcome| {
            let u = outcome.state.displacement;
            Outcome { overturning: outcome.overturning.filter(|_| u.abs() >= u_ins.of(u)), ..outcome }
        };
        let outcomes = self.shaken(start, factors, |starts| self.batch.run(starts, false), false)?;
        Ok(outcomes.into_iter().map(fate).collect())
    }

    fn shaken(
        &self,
        [u, v]: [f64; 2],
        factors: &[f64],
        run: impl FnOnce(&[RunStart]) -> Result<Vec<Outcome>, SolverError>,
        until_overturning: bool,
    ) -> Result<Vec<Outcome>, SolverError> {
        // p = −λ a_g
        let participation = self.motion.wall().body().forcing(Support::rigid(1.0));
        let start = |factor: &f64| {
            let factor = factor * participation;
            RunStart { state: self.motion.start_under(u, v, factor * self.record.samples()[0]), factor }
        };
        let starts: Vec<_> = factors.iter().map(start).collect();
        let outcomes = run(&starts)?.into_iter();
        outcomes.map(|outcome| self.free_vibration(outcome, until_overturning)).collect()
    }

    /// Follows the free vibration after the record. A wall that lacks the energy to exceed its peak is not
    /// followed, unless it has overturned and may come back.
    fn free_vibration(&self, outcome: Outcome, until_overturning: bool) -> Result<Outcome, SolverError> {
        let is_final = match outcome.overturning {
            Some(_) => until_overturning,
            None => peak_is_final(self.motion.wall(), &outcome.state),
        };
        if is_final {
            return Ok(outcome);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to 1000 s of steps")]
        let count = (self.tail / self.record.step()).ceil() as usize + 1;
        let start = RunStart { state: outcome.state, factor: 1.0 };
        let after = self.solver.run(start, Forcing::Still(count), until_overturning)?;
        let later = after.overturning.map(|time| self.record.duration() + time);
        let overturning = outcome.overturning.or(later);
        Ok(Outcome { state: after.state, overturning, ..outcome })
    }
}
