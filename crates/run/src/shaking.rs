//! Runs of one wall through one record, multiplied by factors.

use ground_motion::GroundMotion;
use record::{Batch, Forcing, Outcome, RecordSolver, RunStart};
use rocking_wall::solver::{Motion, SolverError};
use rocking_wall::wall::Support;

use crate::free_motion::peak_is_final;

/// How far a run goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Until {
    /// To the end of the step in which the wall overturns, or to the end of the tail.
    Overturning,
    /// To overturning, or to where the rest of the record cannot raise the peaks: these and the time of
    /// overturning have the bits of a run until [`Overturning`](Self::Overturning).
    Peaks,
    /// To the end of the tail: a wall that is back within `u_ins` there has no time of overturning. That of
    /// one that falls is when it first exceeded `u_ins`.
    End,
}

/// A wall under a record: what its runs share.
///
/// ```
/// use ground_motion::SyntheticMotion;
/// use record::RecordSolver;
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::Parameters;
/// use run::shaking::{Shaking, Until};
///
/// let record = SyntheticMotion::default().motion()?;
/// let parameters = Parameters { u_start: 0.0, ..Parameters::default() };
/// let motion = Motion::of(&parameters, parameters.tolerance)?;
/// let solver = RecordSolver::new(&motion, record.step());
/// let shaking = Shaking::new(&motion, &solver, &record, 10.0);
/// let runs = shaking.runs([0.0, 0.0], &[0.1, 100.0], Until::Overturning)?;
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

    /// Runs the record multiplied by each of some factors, from u and u̇ at its start \[m, m/s\]. The time of
    /// overturning counts from the start of the record.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn runs(&self, [u, v]: [f64; 2], factors: &[f64], until: Until) -> Result<Vec<Outcome>, SolverError> {
        // p = −λ a_g
        let participation = self.motion.wall().body().forcing(Support::rigid(1.0));
        let start = |factor: &f64| {
            let factor = factor * participation;
            RunStart { state: self.motion.start_under(u, v, factor * self.record.samples()[0]), factor }
        };
        let starts: Vec<_> = factors.iter().map(start).collect();
        let outcomes = match until {
            Until::Overturning => self.batch.run(&starts, true),
            Until::Peaks => self.batch.run_to_the_peaks(&starts),
            Until::End => self.batch.run(&starts, false),
        }?;
        outcomes.into_iter().map(|outcome| self.free_vibration(outcome, until)).collect()
    }

    /// Follows the free vibration after the record. A wall that lacks the energy to exceed its peak is not
    /// followed, unless it has overturned and may come back.
    fn free_vibration(&self, outcome: Outcome, until: Until) -> Result<Outcome, SolverError> {
        let is_final = match outcome.overturning {
            Some(_) => until != Until::End,
            None => peak_is_final(self.motion.wall(), &outcome.state),
        };
        if is_final {
            return Ok(outcome);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to 1000 s of steps")]
        let count = (self.tail / self.record.step()).ceil() as usize + 1;
        let start = RunStart { state: outcome.state, factor: 1.0 };
        let after = self.solver.run(start, Forcing::Still(count), until != Until::End)?;
        let later = after.overturning.map(|time| self.record.duration() + time);
        let u = after.state.displacement;
        let comes_back = until == Until::End && u.abs() < self.motion.wall().body().instability.of(u);
        let overturning = outcome.overturning.or(later).filter(|_| !comes_back);
        Ok(Outcome { state: after.state, overturning, ..outcome })
    }
}
