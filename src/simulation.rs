//! A wall in time: the state and the steps that change it, the supports' motion, the outputs.

mod events;
mod excitation;
mod outputs;

use std::sync::Arc;

use crate::solver::{Demands, Memo, Method, Motion, Phase, Samples, Segment, SolverError, State, Work};
use crate::wall::{Ends, ParameterError, Parameters, Support, Wall};

pub use events::Handled;
pub use excitation::{Excitation, segment_of};
pub use outputs::Outputs;

/// A wall in time.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// The motion with the ties as they are at first.
    first: Arc<Motion>,
    pub(super) progress: Progress,
    memo: Memo,
}

/// All that changes during a simulation: plain data, copied to save it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time \[s\].
    pub time: f64,
    /// State of the wall.
    pub state: State,
    /// Time of overturning \[s\]; `None` before.
    pub overturn_time: Option<f64>,
    /// When a tie of each side first broke, u > 0 first \[s\].
    pub tie_breaks: [Option<f64>; 2],
    /// Work so far.
    pub work: Work,
}

impl Progress {
    /// Returns when a tie first broke \[s\].
    pub fn tie_break_time(&self) -> Option<f64> {
        self.tie_breaks.into_iter().flatten().reduce(f64::min)
    }
}

/// What one step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// Impulses of the supports on the wall \[N s\].
    pub impulses: Ends,
    /// The wall overturned in this step.
    pub overturned: bool,
    /// The wall left its supports in this step.
    pub departed: bool,
    /// A tie of each side, u > 0 first, broke in this step; [`Progress::tie_breaks`] says when the first did.
    // flags, not times: 32 bytes more would cost a tenth of a step
    pub fractures: [bool; 2],
    /// The limit on impacts was reached, and the wall was put to rest.
    pub put_to_rest: bool,
}

/// Why a wall could not be moved to the end of a step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum RunError {
    /// The motion could not be followed in the segment from `time` on.
    #[error("at t = {time:?} s: {source}")]
    Solver { time: f64, source: SolverError },
    /// The step is too long for its excitation.
    #[error("the step spans more than {limit} samples; use smaller steps")]
    TooManySegments { limit: usize },
    /// The segments of the step have too many pieces together.
    #[error(
        "more than {limit} pieces of motion, between samples, impacts and turns, in one step, at \
         t = {time:?} s; use smaller steps (`output_step` of a scene)"
    )]
    TooManyPieces { time: f64, limit: u64 },
}

/// Most segments in one step.
const MOST_SEGMENTS: usize = 2_000_000;
/// Fewest steps among which calm ones are looked for: the ranges of these cost as much as a few steps.
const FEWEST_CALM: f64 = 8.0;

impl Simulation {
    /// Places a wall at its start, at `time` \[s\], on supports that move as `support` says. The tighter of
    /// the importer's `tolerance` and the parameter applies.
    ///
    /// # Errors
    /// [`ParameterError`].
    pub fn new(
        parameters: &Parameters,
        tolerance: Option<f64>,
        time: f64,
        support: Support,
    ) -> Result<Self, ParameterError> {
        let tolerance = tolerance.map_or(parameters.tolerance, |given| given.min(parameters.tolerance));
        let motion = Motion::of(parameters, tolerance)?;
        let doubts = |error: ParameterError| error.with_doubts(parameters.unusual().collect());
        motion.wall().check_start(parameters.u_start).map_err(doubts)?;
        let state = motion.start(parameters.u_start, parameters.u_dot_start, support);
        let overturn_time = state.overturned.then_some(time);
        let ties = motion.wall().ties();
        let broken = |sign: f64| ties.iter().any(|tie| tie.is_broken(sign, &state.tie));
        let tie_breaks = [1.0, -1.0].map(|sign| broken(sign).then_some(time));
        let progress = Progress { time, state, overturn_time, tie_breaks, work: Work::default() };
        let mut simulation = Self { first: Arc::new(motion), progress, memo: Memo::default() };
        simulation.prepare(&state);
        Ok(simulation)
    }

    /// Prepares the motion for what the ties of a state remember.
    pub(crate) fn prepare(&mut self, state: &State) {
        self.memo.prepare(&self.first, &state.tie);
    }

    /// The motion of the wall with its ties as they are.
    pub(super) fn motion(&self) -> &Motion {
        self.memo.motion(&self.first)
    }

    /// The wall with its ties as they are.
    pub fn wall(&self) -> &Wall {
        self.motion().wall()
    }

    /// The method in use.
    pub fn method(&self) -> &Method {
        self.first.method()
    }

    /// Returns the progress of the simulation.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Restores the progress of a simulation of the same wall.
    ///
    /// # Panics
    /// If the branch is not one of the wall's.
    pub fn restore(&mut self, progress: Progress) {
        self.prepare(&progress.state);
        assert!(progress.state.branch < self.wall().branches().len(), "a branch of this wall");
        self.progress = progress;
    }

    /// Moves the wall through a segment.
    ///
    /// # Errors
    /// [`SolverError`]; the simulation is then as it was.
    pub fn advance(&mut self, segment: &Segment) -> Result<Step, SolverError> {
        let mut step = Step::default();
        self.add_segment(segment, None, &mut step).map(|()| step)
    }

    /// Moves the wall through a segment, and adds its demands to `demands`.
    ///
    /// # Errors
    /// [`SolverError`]; the simulation is then as it was, and `demands` may hold the motion up to the
    /// failure.
    pub fn advance_watched(&mut self, segment: &Segment, demands: &mut Demands) -> Result<Step, SolverError> {
        let mut step = Step::default();
        self.add_segment(segment, Some(demands), &mut step).map(|()| step)
    }

    /// Moves the wall to a time \[s\] under a motion of its supports, or without one, and adds its demands to
    /// `demands`. With these, steps of a record in which nothing happens are passed many at once. Returns
    /// whether the limit on impacts was reached and the wall put to rest.
    ///
    /// ```
    /// use rocking_wall::simulation::Simulation;
    /// use rocking_wall::wall::{Parameters, Support};
    ///
    /// // free vibration from rest for 3 s
    /// let mut simulation = Simulation::new(&Parameters::default(), None, 0.0, Support::default())?;
    /// simulation.advance_to(3.0, None, None)?;
    /// assert_eq!(simulation.progress().time, 3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RunError`]; the simulation is then at the end of the last segment that succeeded.
    pub fn advance_to(
        &mut self,
        end: f64,
        motion: Option<&Excitation>,
        demands: Option<&mut Demands>,
    ) -> Result<bool, RunError> {
        let next = |simulation: &mut Self, demands: Option<&mut Demands>, _| {
            if let (Some(motion), Some(demands)) = (motion, demands) {
                simulation.pass_calm_steps_seen(end, motion, demands, |_| ());
            }
            let now = simulation.progress.time;
            (segment_of(motion, now, end - now), end - now)
        };
        let step = self.advance_through(next, demands)?;
        self.set_time(end);
        Ok(step.put_to_rest)
    }

    /// Moves the wall through the segments of a step, and adds its demands to `demands`. `next` receives the
    /// simulation, the demands and the length of the step that is done \[s\]. It returns the next segment
    /// and the length that is left \[s\].
    ///
    /// # Errors
    /// [`RunError`]; the simulation is then at the end of the last segment that succeeded.
    pub fn advance_through(
        &mut self,
        mut next: impl FnMut(&mut Self, Option<&mut Demands>, f64) -> (Segment, f64),
        mut demands: Option<&mut Demands>,
    ) -> Result<Step, RunError> {
        let (mut whole, mut done) = (Step::default(), 0.0);
        let (before, limit) = (self.progress.work.pieces, self.first.most_pieces());
        for _ in 0..MOST_SEGMENTS {
            if self.progress.work.pieces - before > limit {
                return Err(RunError::TooManyPieces { time: self.progress.time, limit });
            }
            let (segment, remaining) = next(self, demands.as_deref_mut(), done);
            if remaining <= 0.0 {
                return Ok(whole);
            }
            let time = self.progress.time;
            let moved = self.add_segment(&segment, demands.as_deref_mut(), &mut whole);
            moved.map_err(|source| RunError::Solver { time, source })?;
            done += segment.duration;
            if segment.duration >= remaining {
                return Ok(whole);
            }
        }
        Err(RunError::TooManySegments { limit: MOST_SEGMENTS })
    }

    /// Passes the calm steps that follow: steps of a record in which nothing happens and no demand changes.
    /// Appends u \[m\] and u̇ \[m/s\] at the end of each to `ends`. Stops one step before `end` \[s\] or
    /// earlier.
    ///
    /// It passes none unless the time is that of a sample, `end` is eight steps away, and one interpolated
    /// record moves both supports. `demands` are those of the motion so far.
    ///
    /// ```
    /// use ground_motion::SyntheticMotion;
    /// use rocking_wall::simulation::{Excitation, Simulation};
    /// use rocking_wall::wall::{Parameters, Support};
    ///
    /// let motion = Excitation::new(SyntheticMotion::default().motion()?, None);
    /// let at_rest = Parameters { u_start: 0.0, ..Parameters::default() };
    /// let mut simulation = Simulation::new(&at_rest, None, 0.0, Support::default())?;
    /// let mut demands = simulation.demands(Support::default(), &[]);
    /// simulation.advance_to(10.0, Some(&motion), Some(&mut demands))?;
    /// let mut ends = Vec::new();
    /// simulation.pass_calm_steps(20.0, &motion, &demands, &mut ends);
    /// let passed = (simulation.progress().time - 10.0) / motion.step();
    /// assert_eq!(passed.round(), ends.len() as f64);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn pass_calm_steps(
        &mut self,
        end: f64,
        motion: &Excitation,
        demands: &Demands,
        ends: &mut Vec<[f64; 2]>,
    ) {
        // a list, not the caller's closure: generic code is compiled where it is called, without optimisation
        // in builds from source
        self.pass_calm_steps_seen(end, motion, demands, |end| ends.push(end));
    }

    /// Passes calm steps, and shows `see` u and u̇ at the end of each.
    fn pass_calm_steps_seen(
        &mut self,
        end: f64,
        motion: &Excitation,
        demands: &Demands,
        see: impl FnMut([f64; 2]),
    ) {
        let time = self.progress.time;
        let step = motion.bottom().step();
        if end - time < FEWEST_CALM * step {
            return;
        }
        let Some((first, accelerations)) = motion.samples_from(time) else { return };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "steps of a record")]
        let count = (((end - time) / step) as usize).min(accelerations.len());
        let samples = Samples { accelerations: &accelerations[..count], step };
        let Progress { state, work, .. } = &mut self.progress;
        let moves = state.phase == Phase::Moving;
        let passed = self.first.pass_calm_steps(state, samples, &mut self.memo, demands, see);
        work.pieces += if moves { passed as u64 } else { 0 };
        if passed > 0 {
            self.progress.time = (first + passed) as f64 * step;
        }
    }

    /// Moves the wall through a segment, and adds what happens in it to `step`.
    #[inline]
    fn add_segment(
        &mut self,
        segment: &Segment,
        mut demands: Option<&mut Demands>,
        step: &mut Step,
    ) -> Result<(), SolverError> {
        let body = self.first.wall().body();
        let Progress { time, state: State { displacement, velocity, departed, .. }, .. } = self.progress;
        let with_couple = !departed && body.is_strip();
        let watch = demands.as_deref_mut().map(|demands| (demands, time));
        let state = &mut self.progress.state;
        let report = self.first.advance_watched(state, segment, with_couple, &mut self.memo, watch)?;
        step.overturned |= report.overturning.is_some();
        step.departed |= report.departure.is_some();
        step.put_to_rest |= report.put_to_rest;
        if !departed {
            let (length, end) = match report.departure {
                Some([length, velocity]) => {
                    (length, [body.departure.of(velocity).copysign(velocity), velocity])
                }
                None => (segment.duration, [state.displacement, state.velocity]),
            };
            let gained = match self.first.wall().rotations() {
                None => end[1] - velocity,
                Some(rotations) => {
                    let carried = |[u, v]: [f64; 2]| rotations.carried_velocity(u, v);
                    carried(end) - carried([displacement, velocity])
                }
            };
            // ∫ of a quantity linear over the segment, up to `length`
            let fraction = if segment.duration > 0.0 { length / segment.duration } else { 0.0 };
            let integrate = |from: f64, to: f64| length * (from + 0.5 * (to - from) * fraction);
            let (from, to) = (segment.from, segment.to);
            let supports = from.with(to, integrate);
            let Ends { bottom, top } = body.reaction_changes(supports, gained, report.couple_impulse);
            step.impulses.bottom += bottom - body.contact.thrust * length;
            step.impulses.top += top;
        }
        self.progress.time += segment.duration;
        self.progress.work.add(report.work);
        if let (None, Some(offset)) = (self.progress.overturn_time, report.overturning) {
            self.progress.overturn_time = Some(time + offset);
        }
        for (side, offset) in report.fractures.into_iter().enumerate() {
            let Some(offset) = offset else { continue };
            self.progress.tie_breaks[side].get_or_insert(time + offset);
            step.fractures[side] = true;
        }
        if let Some(demands) = demands {
            self.enter_yielding(demands);
        }
        Ok(())
    }

    /// Sets the time \[s\] to the importer's, from which the sum of steps differs by rounding.
    pub fn set_time(&mut self, time: f64) {
        self.progress.time = time;
    }
}
