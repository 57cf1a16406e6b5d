//! Runs of one wall through one record, multiplied by factors.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::OnceLock;

use ground_motion::GroundMotion;
use record::{BatchRun, Blocks, Forcing, Outcome, RecordSolver, RunEnd, RunStart, run_together};
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::{SolverError, State};
use rocking_wall::wall::{Body, Support};
use scene::{Floors, SceneError};

use crate::free_motion::peak_is_final;

/// Returns the motion that a wall feels under a record: on floors theirs, until a `tail` \[s\] after the
/// record ends; that of a strip wall is the mean of its two by their weights.
///
/// # Errors
/// [`SceneError`] of floors whose motion cannot be computed.
pub fn felt<'r>(
    floors: Option<&Floors>,
    body: &Body,
    record: &'r GroundMotion,
    tail: f64,
) -> Result<Cow<'r, GroundMotion>, SceneError> {
    let Some(floors) = floors else { return Ok(Cow::Borrowed(record)) };
    let ground = Excitation::new(record.clone(), None);
    let supports = floors.motion(body.mechanism, &ground, record.duration() + tail)?;
    let effective = supports.effective(body);
    effective.map(Cow::Owned).map_err(|error| SceneError::Value { message: error.to_string() })
}

/// A wall under a record: what its runs share.
///
/// ```
/// use ground_motion::SyntheticMotion;
/// use record::{RecordSolver, RunEnd};
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::Parameters;
/// use run::shaking::Shaking;
///
/// let record = SyntheticMotion::default().motion()?;
/// let parameters = Parameters { u_start: 0.0, ..Parameters::default() };
/// let motion = Motion::of(&parameters, parameters.tolerance)?;
/// let solver = RecordSolver::new(&motion, record.step());
/// let shaking = Shaking::new(&solver, &record, 10.0);
/// let runs = shaking.runs([0.0, 0.0], &[0.1, 100.0], RunEnd::AtOverturning)?;
/// assert!(runs[0].overturning.is_none() && runs[1].overturning.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Shaking<'a> {
    solver: &'a RecordSolver<'a>,
    /// The record, prepared for many factors.
    blocks: OnceLock<Blocks<'a>>,
    record: &'a GroundMotion,
    tail: f64,
    /// The state from which its runs go on, instead of a start.
    before: Option<State>,
}

impl<'a> Shaking<'a> {
    /// Prepares the runs of a wall through a record and, for `tail` \[s\] after it, in free vibration. The
    /// steps of `solver` are those of the record.
    pub fn new(solver: &'a RecordSolver<'a>, record: &'a GroundMotion, tail: f64) -> Self {
        Self { solver, blocks: OnceLock::new(), record, tail, before: None }
    }

    /// Lets its runs go on from a state, such as the one that a motion before has left.
    pub fn go_on_from(&mut self, state: State) {
        self.before = Some(state);
    }

    /// Runs the record multiplied by each of some factors, from u and u̇ at its start \[m, m/s\]. The time of
    /// overturning counts from the start of the record. A run to the end of the tail
    /// ([`RunEnd::OfRecord`]) has none where the wall is back within `u_ins` there; that of a wall that falls
    /// is when it first exceeded `u_ins`.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn runs(&self, start: [f64; 2], factors: &[f64], end: RunEnd) -> Result<Vec<Outcome>, SolverError> {
        self.prepare();
        let run = |&factor: &f64| Shaken { shaking: self, start, factor };
        together(&factors.iter().map(run).collect::<Vec<_>>(), end).into_iter().collect()
    }

    /// Prepares the record for many factors, which [`together`] then makes use of.
    pub fn prepare(&self) -> &Blocks<'a> {
        let forcing = Forcing::Samples(self.record.samples());
        self.blocks.get_or_init(|| Blocks::for_many(self.solver, forcing))
    }

    /// Returns the start of a run from u and u̇, with a factor on the record.
    fn start(&self, [u, v]: [f64; 2], factor: f64) -> RunStart {
        // p = −λ a_g
        let factor = factor * self.solver.motion().wall().body().forcing(Support::rigid(1.0));
        let upright = || self.solver.motion().start_under(u, v, factor * self.record.samples()[0]);
        RunStart { state: self.before.unwrap_or_else(upright), factor }
    }

    /// Follows the free vibration after the record. A wall that lacks the energy to exceed its peak is not
    /// followed, unless it has overturned and may come back.
    fn free_vibration(&self, outcome: Outcome, end: RunEnd) -> Result<Outcome, SolverError> {
        let to_the_end = end == RunEnd::OfRecord;
        let is_final = match outcome.overturning {
            Some(_) => !to_the_end,
            None => peak_is_final(self.solver.motion().wall(), &outcome.state),
        };
        if is_final {
            return Ok(outcome);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "up to 1000 s of steps")]
        let count = (self.tail / self.record.step()).ceil() as usize + 1;
        let start = RunStart { state: outcome.state, factor: 1.0 };
        let rest = if to_the_end { RunEnd::OfRecord } else { RunEnd::AtOverturning };
        let after = self.solver.run(start, Forcing::Still(count), rest)?;
        let later = after.overturning.map(|time| self.record.duration() + time);
        let u = after.state.displacement;
        let comes_back = to_the_end && u.abs() < self.solver.motion().wall().body().instability.of(u);
        let overturning = outcome.overturning.or(later).filter(|_| !comes_back);
        Ok(Outcome { state: after.state, overturning, ..outcome })
    }
}

/// A run of a wall through a record, among others.
#[derive(Clone, Copy, Debug)]
pub struct Shaken<'s, 'a> {
    /// The wall and the record.
    pub shaking: &'s Shaking<'a>,
    /// u \[m\] and u̇ \[m/s\] at the start of the record, of a wall that does not go on from a state.
    pub start: [f64; 2],
    /// Factor on the record \[-\].
    pub factor: f64,
}

/// Runs any walls through any records, and returns what became of each, in their order, with the same bits as
/// [`Shaking::runs`].
///
/// Few factors of many walls and records are faster here than there, and so are many factors of each where
/// records are prepared for them ([`Shaking::prepare`]).
pub fn together(runs: &[Shaken<'_, '_>], end: RunEnd) -> Vec<Result<Outcome, SolverError>> {
    // each record is prepared once, for all of its walls, unless it is for one of them
    let (mut records, mut places) = (Vec::new(), HashMap::new());
    let mut of_run = Vec::with_capacity(runs.len());
    for Shaken { shaking: Shaking { record, blocks, .. }, .. } in runs {
        if blocks.get().is_some() {
            of_run.push(None);
            continue;
        }
        let place = *places.entry(std::ptr::from_ref(*record)).or_insert(records.len());
        if place == records.len() {
            records.push(Blocks::new(Forcing::Samples(record.samples())));
        }
        of_run.push(Some(place));
    }
    let mut given = Vec::with_capacity(runs.len());
    for (Shaken { shaking, start, factor }, place) in runs.iter().zip(of_run) {
        let start = shaking.start(*start, *factor);
        let record = place.map_or_else(|| shaking.prepare(), |place: usize| &records[place]);
        given.push(BatchRun { solver: shaking.solver, record, start });
    }
    let outcomes = run_together(&given, end).into_iter().zip(runs);
    outcomes.map(|(outcome, run)| run.shaking.free_vibration(outcome?, end)).collect()
}
