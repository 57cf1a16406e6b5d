//! Moves a state through one segment: pieces of motion, and the transitions between them.

use oscillator::KinematicState;

use super::adaptive::{Series, Viscous, newmark_step};
use super::demand::Demands;
use super::event::{self, Ending, Exit, Piece, Shape};
use super::exact::ClosedForm;
use super::memo::Memo;
use super::motion::{Method, Motion};
use super::state::{Phase, Report, Segment, SolverError, State, Work};
use super::transition::{self, Rebound};
use super::trigonometric::Rotation;
use super::watch::{Followed, Watch};
use crate::wall::TieAction;

/// Most impacts in one segment. A wall that can rest is put to rest when it reaches them.
const MOST_IMPACTS: u64 = 100_000;

impl Motion {
    /// Moves `state` through a segment. With `integral`, the report contains ∫u dt. `memo` keeps the
    /// propagator of the last whole step.
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was.
    pub fn advance(
        &self,
        state: &mut State,
        segment: &Segment,
        integral: bool,
        memo: &mut Memo,
    ) -> Result<Report, SolverError> {
        self.advance_watched(state, segment, integral, memo, None)
    }

    /// Moves `state` through a segment and collects its demands. `watch` holds the demands so far, the time
    /// at the start of the segment \[s\], and whether the couple of a drift acts.
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was, and the demands are those up to the failure.
    #[inline]
    pub(crate) fn advance_watched(
        &self,
        state: &mut State,
        segment: &Segment,
        integral: bool,
        memo: &mut Memo,
        watch: Option<(&mut Demands, f64, bool)>,
    ) -> Result<Report, SolverError> {
        let body = self.wall.body();
        let forcing = [body.forcing(segment.from), body.forcing(segment.to)];
        let stretched = memo.prepare(self, &state.tie);
        let motion = stretched.as_deref().unwrap_or(self);
        if !integral
            && watch.is_none()
            && let Some(end) = motion.quiet_end(state, segment.duration, forcing, memo)
        {
            (state.displacement, state.velocity) = (end.displacement, end.velocity);
            return Ok(Report { work: Work { pieces: 1, ..Work::default() }, ..Report::default() });
        }
        let watch = watch.map(|(demands, time, drift)| (demands, segment, time, drift));
        self.run(state, segment.duration, forcing, integral, memo, watch)
    }

    /// Moves `state` through a time \[s\] in which the forcing p goes from one value to another \[m/s²\].
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was.
    pub fn advance_under(
        &self,
        state: &mut State,
        duration: f64,
        forcing: [f64; 2],
        memo: &mut Memo,
    ) -> Result<Report, SolverError> {
        self.run(state, duration, forcing, false, memo, None)
    }

    /// Moves `state` through a time, with the motion that belongs to the memory of the ties at each moment.
    fn run(
        &self,
        state: &mut State,
        duration: f64,
        forcing: [f64; 2],
        integral: bool,
        memo: &mut Memo,
        mut watch: Option<(&mut Demands, &Segment, f64, bool)>,
    ) -> Result<Report, SolverError> {
        let (mut now, mut time, mut report) = (*state, 0.0, Report::default());
        loop {
            let stretched = memo.prepare(self, &now.tie);
            let motion = stretched.as_deref().unwrap_or(self);
            if now.tie != state.tie {
                motion.find_branch(&mut now);
            }
            let mut run = Run::new(motion, now, duration, forcing, integral, memo);
            (run.time, run.report) = (time, report);
            run.watch = watch.as_mut().map(|&mut (ref mut demands, segment, time, drift)| Watch {
                demands,
                wall: &motion.wall,
                segment,
                time,
                drift,
            });
            run.finish()?;
            (now, time, report) = (run.state, run.time, run.report);
            if now.tie == *motion.wall.tie_memory() {
                *state = now;
                return Ok(report);
            }
        }
    }

    /// Sets the branch of a state whose ties have changed: ahead of the motion, or inwards at a turning point.
    pub(crate) fn find_branch(&self, state: &mut State) {
        let State { displacement, velocity, .. } = *state;
        let direction = if velocity == 0.0 { -displacement } else { velocity };
        state.branch = self.wall.branch_of(displacement, direction);
    }

    /// Returns the end of a segment without events: one piece in closed form that reaches no corner and no
    /// new peak. `None` for every other segment. The result is bit for bit that of a [`Run`].
    #[inline]
    fn quiet_end(
        &self,
        state: &State,
        duration: f64,
        [from, to]: [f64; 2],
        memo: &mut Memo,
    ) -> Option<KinematicState> {
        let &State { displacement, velocity, branch: index, phase, ref peaks, .. } = state;
        let (branch, oscillator) = (&self.wall.branches()[index], &self.oscillators[index]);
        let is_one_piece = duration > 0.0 && duration <= oscillator.longest_piece();
        // what yields must be followed to the turning point, however near
        let yields = branch.tie == TieAction::Yields;
        if phase != Phase::Moving || !is_one_piece || !self.takes_closed_form(index) || yields {
            return None;
        }
        if oscillator.is_spread(duration) {
            return None;
        }
        let acceleration = branch.acceleration(displacement, velocity, from);
        let start = KinematicState { displacement, velocity, acceleration };
        let rate = (to - from) / duration;
        let end = memo.end(index, oscillator, start, rate, duration);
        let most = oscillator.bounds(start, rate, duration);
        let corners = [branch.lower, branch.upper];
        let is_quiet = matches!(event::settle([start, end], duration, most, corners, peaks), Shape::Quiet);
        // if the motion has overflowed, a run reports where
        (is_quiet && end.displacement.is_finite() && end.velocity.is_finite()).then_some(end)
    }
}

/// The motion through one segment.
pub(super) struct Run<'a> {
    motion: &'a Motion,
    pub(super) state: State,
    time: f64,
    duration: f64,
    /// Forcing at the start of the segment \[m/s²\] and its rate \[m/s³\].
    forcing: f64,
    rate: f64,
    integral: bool,
    memo: &'a mut Memo,
    watch: Option<Watch<'a>>,
    pub(super) report: Report,
}

impl<'a> Run<'a> {
    /// Prepares a segment of `duration` \[s\] with a forcing linear between two values \[m/s²\].
    #[inline]
    pub(super) fn new(
        motion: &'a Motion,
        state: State,
        duration: f64,
        [from, to]: [f64; 2],
        integral: bool,
        memo: &'a mut Memo,
    ) -> Self {
        let rate = if duration > 0.0 { (to - from) / duration } else { 0.0 };
        Self {
            motion,
            state,
            time: 0.0,
            duration,
            forcing: from,
            rate,
            integral,
            memo,
            watch: None,
            report: Report::default(),
        }
    }

    /// Moves to the end of the segment, or to where a tie becomes another than that of the motion.
    pub(super) fn finish(&mut self) -> Result<(), SolverError> {
        while self.report.work.pieces < self.motion.most_pieces() {
            if self.time >= self.duration || self.state.tie != *self.motion.wall.tie_memory() {
                return self.check();
            }
            match self.state.phase {
                Phase::Landed => self.time = self.duration,
                Phase::Resting => self.rest(),
                Phase::Moving => {
                    self.report.work.pieces += 1;
                    self.move_on()?;
                }
            }
        }
        Err(self.exhausted())
    }

    fn forcing_now(&self) -> f64 {
        self.forcing + self.rate * self.time
    }

    /// Rests until the forcing leaves the band.
    fn rest(&mut self) {
        let [lowest, highest] = self.motion.rest_band;
        let now = self.forcing_now();
        // The time at which the forcing reaches an edge of the band, plus a margin for the rounding of the
        // forcing: by then the computed forcing is outside the band.
        let largest = self.forcing.abs() + self.rate.abs() * self.duration;
        let until = |edge: f64| ((edge - now).abs() + 2.0 * f64::EPSILON * largest) / self.rate.abs();
        let mut leaving = f64::INFINITY;
        if now > highest || now < lowest {
            leaving = self.time;
        } else if self.rate > 0.0 {
            leaving = self.time + until(highest);
        } else if self.rate < 0.0 {
            leaving = self.time + until(lowest);
        }
        let until = leaving.max(self.time).min(self.duration);
        if let Some(watch) = &mut self.watch
            && !self.state.overturned
        {
            watch.rest(self.time, until);
        }
        self.time = until;
        if leaving >= self.duration {
            return;
        }
        let upwards = now > highest || (now >= lowest && self.rate > 0.0);
        transition::leave_rest(self.motion, &mut self.state, upwards);
    }

    /// Computes the next piece of motion from the current state, and moves the wall along it.
    fn move_on(&mut self) -> Result<(), SolverError> {
        let motion = self.motion;
        let State { displacement, velocity, branch: index, .. } = self.state;
        let branch = &motion.wall.branches()[index];
        let forcing = self.forcing_now();
        let start = KinematicState {
            displacement,
            velocity,
            acceleration: branch.acceleration(displacement, velocity, forcing),
        };
        let remaining = self.duration - self.time;
        if motion.takes_closed_form(index) {
            let piece = self.closed_form(index, start, remaining);
            return self.follow_piece(&piece);
        }
        if let Method::Newmark { step } = motion.method {
            // equal steps, none longer than `step`
            let steps = (remaining / step - 1e-9).ceil().max(1.0);
            let step = remaining / steps;
            return self.follow_piece(&newmark_step(branch, start, self.rate * step, step));
        }
        if let Some(rotations) = motion.wall.rotations() {
            let rotation = Rotation::new(rotations, branch.side(), start, [forcing, self.rate]);
            return self.follow_piece(&Series::new(rotation, remaining, motion.tolerances));
        }
        if let Some(secant) = &motion.secants[index] {
            let (now, forcing) = ([displacement, velocity], [forcing, self.rate]);
            let piece = Series::secant((secant, branch), now, forcing, remaining, motion.tolerances);
            return self.follow_piece(&piece);
        }
        let viscous = Viscous::new(branch, start, [forcing, self.rate]);
        self.follow_piece(&Series::new(viscous, remaining, motion.tolerances))
    }

    fn closed_form(&mut self, index: usize, start: KinematicState, remaining: f64) -> ClosedForm<'a> {
        let motion = self.motion;
        let branch = &motion.wall.branches()[index];
        let (oscillator, rate, peaks) = (&motion.oscillators[index], self.rate, &self.state.peaks);
        let bounds = [branch.lower, branch.upper];
        let mut piece = ClosedForm::new(oscillator, start, rate, remaining, bounds, peaks);
        // Only the propagator of a whole segment goes into the memo: the next segment usually has the same
        // length, a part of one does not.
        let whole = self.time == 0.0 && piece.horizon() == self.duration;
        if whole && !oscillator.is_spread(self.duration) {
            piece.end_at(self.memo.end(index, oscillator, start, rate, remaining));
        }
        piece
    }

    /// Moves the wall along a piece, to its end or to the first corner.
    fn follow_piece<P: Piece>(&mut self, piece: &P) -> Result<(), SolverError> {
        let bounds = self.bounds();
        let mut peaks = self.state.peaks;
        let places = bounds.map(|index| self.motion.wall.corners()[index].displacement);
        let branch = &self.motion.wall.branches()[self.state.branch];
        let (from, is_newmark) =
            (self.state.displacement, matches!(self.motion.method, Method::Newmark { .. }));
        let yielding = Some(branch.side()).filter(|_| branch.tie == TieAction::Yields);
        let ending = match yielding {
            Some(side) if !is_newmark => event::find_turn(piece, places, &mut peaks, side),
            _ => event::find_ending(piece, places, &mut peaks),
        };
        self.state.peaks = peaks;
        let ending = ending.map_err(|_| self.exhausted())?;
        let (length, displacement, velocity, exit) = match ending {
            Ending::Horizon(end) => (piece.horizon(), end.displacement, end.velocity, None),
            Ending::Exit(Exit { time, velocity, upwards }) => {
                (time, places[usize::from(upwards)], velocity, Some(upwards))
            }
            Ending::Turn { time, displacement, velocity } => (time, displacement, velocity, None),
        };
        let is_turn = matches!(ending, Ending::Turn { .. });
        if let Some(watch) = &mut self.watch {
            let State { branch, overturned, departed, .. } = self.state;
            let followed = Followed { piece, branch, from: self.time, length, displacement };
            let (motion, tie) = (!overturned, !departed && watch.demands.tie.is_some());
            let watched = if motion { watch.piece(&followed) } else { Ok(()) };
            let watched = watched.and_then(|()| if tie { watch.tie(&followed) } else { Ok(()) });
            watched.map_err(|_| self.exhausted())?;
        }
        if self.integral && !self.state.departed {
            self.report.displacement_integral += piece.displacement_integral(length);
        }
        (self.state.displacement, self.state.velocity) = (displacement, velocity);
        if let Some(upwards) = exit {
            self.time += length;
            self.pass_corner(bounds[usize::from(upwards)], upwards);
        } else {
            let finished = self.time + length >= self.duration || length >= self.duration - self.time;
            self.time = if finished { self.duration } else { self.time + length };
            if length <= 0.0 && !is_turn {
                return Err(self.exhausted());
            }
            if is_newmark {
                self.state.branch = self.motion.wall.branch_of(displacement, velocity);
            }
            if let Some(side) = yielding.filter(|side| is_turn || side * velocity < 0.0) {
                // of Newmark's steps only the ends count
                let reach =
                    if is_newmark { side * (side * from).max(side * displacement) } else { displacement };
                self.unload(reach);
            }
        }
        self.check()
    }

    /// Ends the yielding of a tie at its largest displacement.
    fn unload(&mut self, displacement: f64) {
        if transition::unload(self.motion, &mut self.state, displacement) {
            self.enter_fracture(displacement);
        }
    }

    fn enter_fracture(&mut self, displacement: f64) {
        self.report.fractures[usize::from(displacement < 0.0)] = Some(self.time);
    }

    /// Returns the lower and upper corner that end a piece: the ends of the branch, or for Newmark the
    /// nearest corners at which more happens than a change of branch.
    fn bounds(&self) -> [usize; 2] {
        let (mut lower, mut upper) = (self.state.branch, self.state.branch + 1);
        if let Method::Newmark { .. } = self.motion.method {
            let corners = self.motion.wall.corners();
            while !corners[lower].is_marked() {
                lower -= 1;
            }
            while !corners[upper].is_marked() {
                upper += 1;
            }
        }
        [lower, upper]
    }

    /// Passes the corner that the wall has reached, and reports what happens there.
    fn pass_corner(&mut self, corner: usize, upwards: bool) {
        let (motion, forcing) = (self.motion, self.forcing_now());
        self.state.peaks.include(self.state.displacement);
        let velocity = self.state.velocity;
        let [lowest, highest] = motion.rest_band;
        let too_many = self.report.work.impacts + 1 >= MOST_IMPACTS
            && motion.wall.can_rest()
            && (lowest..=highest).contains(&forcing);
        let rebound = |state: &State| {
            let velocity = state.velocity * motion.wall.passage_factor();
            Rebound { velocity, rests: too_many || velocity.abs() < motion.rest_speed }
        };
        let forcing = [forcing, self.rate];
        let event = transition::pass_corner(motion, &mut self.state, (corner, upwards), forcing, rebound);
        self.report.work.add(event.work);
        self.report.put_to_rest |= too_many && event.work.impacts > 0;
        if event.fractured {
            self.enter_fracture(self.state.displacement);
        }
        if event.overturned {
            self.report.overturning = Some(self.time);
        }
        if event.departed {
            self.report.departure = Some([self.time, velocity]);
        }
    }

    fn check(&self) -> Result<(), SolverError> {
        let State { displacement, velocity, .. } = self.state;
        if displacement.is_finite() && velocity.is_finite() {
            return Ok(());
        }
        let (reached, duration, forcing) = (self.time, self.duration, self.forcing_now());
        Err(SolverError::NotFinite { reached, duration, displacement, velocity, forcing })
    }

    fn exhausted(&self) -> SolverError {
        let State { displacement, velocity, .. } = self.state;
        let (reached, duration, limit) = (self.time, self.duration, self.motion.most_pieces());
        SolverError::TooManyPieces { reached, duration, limit, displacement, velocity }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::DampingModel;
    use crate::wall::{Parameters, Support};

    /// A short step without events is quiet; a long step is not, nor is a step of a wall at rest.
    #[test]
    fn ordinary_steps_are_quiet() {
        let damping_model = DampingModel::ConstantCoefficient;
        let motion = Motion::of(&Parameters { damping_model, ..Parameters::default() }, 1e-8).unwrap();
        let u_ins = motion.wall().body().instability.positive;
        let mut state = motion.start(0.3 * u_ins, 0.0, Support::default());
        state.peaks.include(0.4 * u_ins);
        let quiet = |state: &State, duration: f64| {
            motion.quiet_end(state, duration, [0.0; 2], &mut Memo::default()).is_some()
        };
        assert!(quiet(&state, 0.01) && !quiet(&state, 100.0));
        assert!(!quiet(&State { phase: Phase::Resting, ..state }, 0.01));
    }
}
