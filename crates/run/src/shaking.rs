//! Runs of one wall through one record, multiplied by factors.

use std::collections::HashMap;
use std::sync::OnceLock;

use ground_motion::GroundMotion;
use record::{Batch, BatchRun, Blocks, Forcing, Outcome, RecordSolver, RunEnd, RunStart, run_together};
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
    /// What many factors share, prepared for the first of them.
    batch: OnceLock<Batch<'a>>,
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
        Self { motion, solver, batch: OnceLock::new(), record, tail }
    }

    /// Runs the record multiplied by each of some factors, from u and u̇ at its start \[m, m/s\]. A run stops
    /// where the wall overturns. The time of overturning counts from the start of the record.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn runs(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        self.shaken(start, factors, RunEnd::AtOverturning)
    }

    /// Runs as [`runs`](Self::runs) does, for the peaks and the time of overturning alone, which have the
    /// same bits: a run also stops where the rest of the record cannot raise its peaks.
    ///
    /// # Errors
    /// As [`runs`](Self::runs).
    pub fn peaks(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        self.shaken(start, factors, RunEnd::AtPeaks)
    }

    /// Runs as [`runs`](Self::runs) does, but to the end of the tail: a wall that is back within `u_ins`
    /// there has no time of overturning. That of one that falls is when it first exceeded `u_ins`.
    ///
    /// # Errors
    /// As [`runs`](Self::runs).
    pub fn runs_to_the_end(&self, start: [f64; 2], factors: &[f64]) -> Result<Vec<Outcome>, SolverError> {
        self.shaken(start, factors, RunEnd::OfRecord)
    }

    fn shaken(&self, start: [f64; 2], factors: &[f64], end: RunEnd) -> Result<Vec<Outcome>, SolverError> {
        let batch = self.batch.get_or_init(|| self.solver.batch(Forcing::Samples(self.record.samples())));
        let starts: Vec<_> = factors.iter().map(|factor| self.start(start, *factor)).collect();
        let outcomes = match end {
            RunEnd::AtPeaks => batch.run_to_the_peaks(&starts)?,
            RunEnd::AtOverturning => batch.run(&starts, true)?,
            RunEnd::OfRecord => batch.run(&starts, false)?,
        };
        outcomes.into_iter().map(|outcome| self.finish(outcome, end)).collect()
    }

    /// Returns the start of a run from u and u̇, with a factor on the record.
    fn start(&self, [u, v]: [f64; 2], factor: f64) -> RunStart {
        // p = −λ a_g
        let factor = factor * self.motion.wall().body().forcing(Support::rigid(1.0));
        RunStart { state: self.motion.start_under(u, v, factor * self.record.samples()[0]), factor }
    }

    /// Follows a run from the end of the record on.
    fn finish(&self, outcome: Outcome, end: RunEnd) -> Result<Outcome, SolverError> {
        if end != RunEnd::OfRecord {
            return self.free_vibration(outcome, true);
        }
        let outcome = self.free_vibration(outcome, false)?;
        let (u, u_ins) = (outcome.state.displacement, self.motion.wall().body().instability);
        Ok(Outcome { overturning: outcome.overturning.filter(|_| u.abs() >= u_ins.of(u)), ..outcome })
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

/// A run of a wall through a record, among others.
#[derive(Clone, Copy, Debug)]
pub struct Shaken<'s, 'a> {
    /// The wall and the record.
    pub shaking: &'s Shaking<'a>,
    /// u \[m\] and u̇ \[m/s\] at the start of the record.
    pub start: [f64; 2],
    /// Factor on the record \[-\].
    pub factor: f64,
}

/// Runs any walls through any records, and returns what became of each, in their order, with the same bits as
/// [`Shaking::runs`] for [`RunEnd::AtOverturning`], [`Shaking::peaks`] for [`RunEnd::AtPeaks`] and
/// [`Shaking::runs_to_the_end`] for [`RunEnd::OfRecord`].
///
/// Many factors of one wall and record are faster there; few factors of many walls and records are faster
/// here.
pub fn together(runs: &[Shaken<'_, '_>], end: RunEnd) -> Vec<Result<Outcome, SolverError>> {
    // each record is prepared once, for all of its walls
    let (mut records, mut places) = (Vec::new(), HashMap::new());
    let mut of_run = Vec::with_capacity(runs.len());
    for Shaken { shaking: Shaking { record, .. }, .. } in runs {
        let place = *places.entry(std::ptr::from_ref(*record)).or_insert(records.len());
        if place == records.len() {
            records.push(Blocks::new(Forcing::Samples(record.samples())));
        }
        of_run.push(place);
    }
    let mut given = Vec::with_capacity(runs.len());
    for (Shaken { shaking, start, factor }, place) in runs.iter().zip(of_run) {
        let start = shaking.start(*start, *factor);
        given.push(BatchRun { solver: shaking.solver, record: &records[place], start });
    }
    let outcomes = run_together(&given, end).into_iter().zip(runs);
    outcomes.map(|(outcome, run)| run.shaking.finish(outcome?, end)).collect()
}
