//! The run through one segment: pieces of motion, and the transitions between them.

use oscillator::KinematicState;

use super::adaptive::{Series, Viscous, newmark_step};
use super::event::{self, Ending, Exit, Piece};
use super::exact::ClosedForm;
use super::memo::Propagators;
use super::motion::{Method, Motion};
use super::state::{Phase, Report, SolverError, State};
use super::transition::{self, Reached, Rebound};
use super::trigonometric::Rotation;
use super::watch::{Followed, Watch};
use crate::wall::Couple;

/// Most impacts in one segment. A wall that can rest is put to rest when it reaches them.
const MOST_IMPACTS: u64 = 100_000;

/// The motion through one segment.
pub(super) struct Run<'a> {
    motion: &'a Motion,
    pub(super) state: State,
    pub(super) time: f64,
    duration: f64,
    /// Forcing at the start of the segment \[m/s²\] and its rate \[m/s³\].
    forcing: f64,
    rate: f64,
    with_couple: bool,
    propagators: &'a mut Propagators,
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
        with_couple: bool,
        propagators: &'a mut Propagators,
    ) -> Self {
        let rate = if duration > 0.0 { (to - from) / duration } else { 0.0 };
        Self {
            motion,
            state,
            time: 0.0,
            duration,
            forcing: from,
            rate,
            with_couple,
            propagators,
            report: Report::default(),
        }
    }

    /// Moves to the end of the segment, or to where a tie becomes another than that of the motion.
    // `watch` is an argument of all that needs it, not a field: an FMU watches nothing, and its library is
    // then found to need no search for demands
    #[inline(never)]
    pub(super) fn finish(&mut self, mut watch: Option<&mut Watch<'_>>) -> Result<(), SolverError> {
        while self.report.work.pieces < self.motion.most_pieces() {
            if self.time >= self.duration || self.state.tie != *self.motion.wall.tie_memory() {
                return self.check();
            }
            match self.state.phase {
                Phase::Landed => self.time = self.duration,
                Phase::Resting => self.rest(watch.as_deref_mut()),
                Phase::Moving => {
                    self.report.work.pieces += 1;
                    self.move_on(watch.as_deref_mut())?;
                }
            }
        }
        Err(self.not_followed(
            "the motion has more samples, impacts, turns and steps of Newmark than are followed,",
        ))
    }

    fn forcing_now(&self) -> f64 {
        self.forcing + self.rate * self.time
    }

    /// Rests until the forcing leaves the band.
    fn rest(&mut self, watch: Option<&mut Watch<'_>>) {
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
        if let Some(watch) = watch
            && !self.state.overturned
        {
            watch.rest(self.time, until);
        }
        if self.with_couple {
            let forcing = [now, self.forcing + self.rate * until];
            self.report.couple_impulse += self.motion.wall.couple_of_rest(forcing, until - self.time);
        }
        self.time = until;
        if leaving >= self.duration {
            return;
        }
        let upwards = now > highest || (now >= lowest && self.rate > 0.0);
        transition::leave_rest(self.motion, &mut self.state, upwards);
    }

    /// Computes the next piece of motion from the current state, and moves the wall along it.
    fn move_on(&mut self, watch: Option<&mut Watch<'_>>) -> Result<(), SolverError> {
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
            return self.follow_piece(&piece, watch);
        }
        if let Method::Newmark { step } = motion.method {
            // equal steps, none longer than `step`
            let steps = (remaining / step - 1e-9).ceil().max(1.0);
            let step = remaining / steps;
            return self.follow_piece(&newmark_step(branch, start, self.rate * step, step), watch);
        }
        if let Some(rotations) = motion.wall.rotations() {
            let rotation = Rotation::new(rotations, branch.side(), start, [forcing, self.rate]);
            let piece = Series::new(rotation, branch.side(), remaining, motion.tolerances);
            return self.follow_piece(&piece, watch);
        }
        if let Some(secant) = &motion.secants[index] {
            let (now, forcing) = ([displacement, velocity], [forcing, self.rate]);
            let piece = Series::secant(secant, branch, now, forcing, remaining, motion.tolerances);
            return self.follow_piece(&piece, watch);
        }
        let viscous = Viscous::new(branch, start, [forcing, self.rate]);
        self.follow_piece(&Series::new(viscous, 1.0, remaining, motion.tolerances), watch)
    }

    fn closed_form(&mut self, index: usize, start: KinematicState, remaining: f64) -> ClosedForm<'a> {
        let motion = self.motion;
        let branch = &motion.wall.branches()[index];
        let (oscillator, rate, peaks) = (&motion.oscillators[index], self.rate, &self.state.peaks);
        let bounds = [branch.lower, branch.upper];
        let mut piece = ClosedForm::new(oscillator, start, rate, remaining, bounds, peaks);
        // Only the propagator of a whole segment is kept: the next segment usually has the same
        // length, a part of one does not.
        let whole = self.time == 0.0 && piece.horizon() == self.duration;
        if whole && !oscillator.is_spread(self.duration) {
            let end = self.propagators.end(index, oscillator, start, rate, remaining);
            let integral = || self.propagators.displacement_integral([start, end], rate, remaining);
            piece.integral = self.with_couple.then(integral);
            piece.end = Some(end);
        }
        piece
    }

    /// Moves the wall along a piece, to its end or to the first corner.
    fn follow_piece<P: Piece>(
        &mut self,
        piece: &P,
        mut watch: Option<&mut Watch<'_>>,
    ) -> Result<(), SolverError> {
        let bounds = self.bounds();
        let mut peaks = self.state.peaks;
        let places = bounds.map(|index| self.motion.wall.corners()[index].displacement);
        let branch = &self.motion.wall.branches()[self.state.branch];
        let (from, is_newmark) =
            (self.state.displacement, matches!(self.motion.method, Method::Newmark { .. }));
        // 0 where no tie yields, not an option: compiled code multiplies before it branches, and what stands
        // in place of a missing number may be subnormal, which takes a hundred cycles
        let outwards = branch.yielding_side().unwrap_or(0.0);
        let ending = if outwards != 0.0 && !is_newmark {
            event::find_turn(piece, places, &mut peaks, outwards)
        } else {
            event::find_ending(piece, places, &mut peaks)
        };
        self.state.peaks = peaks;
        let event = "the next turn, impact or fall of the wall cannot be found";
        let ending = ending.map_err(|_| self.not_followed(event))?;
        let (length, displacement, velocity, exit) = match ending {
            Ending::Horizon(end) => (piece.horizon(), end.displacement, end.velocity, None),
            Ending::Exit(Exit { time, velocity, upwards }) => {
                (time, places[usize::from(upwards)], velocity, Some(upwards))
            }
            Ending::Turn { time, displacement, velocity } => (time, displacement, velocity, None),
        };
        let is_turn = matches!(ending, Ending::Turn { .. });
        if let Some(watch) = watch.as_deref_mut() {
            let State { branch, overturned, departed, .. } = self.state;
            let followed = Followed { piece, branch, from: self.time, length, displacement };
            let (motion, tied) = (!overturned, !departed && !watch.demands.ties.is_empty());
            let watched = if motion { watch.piece(&followed) } else { Ok(()) };
            let watched = watched.and_then(|()| if tied { watch.ties(&followed) } else { Ok(()) });
            watched.map_err(|_| self.not_followed("a largest value of the motion cannot be found"))?;
        }
        if self.with_couple && !self.state.departed {
            let Couple { at_zero, slope } = branch.couple;
            self.report.couple_impulse += at_zero * length + slope * piece.displacement_integral(length);
        }
        (self.state.displacement, self.state.velocity) = (displacement, velocity);
        if let Some(upwards) = exit {
            self.time += length;
            self.pass_corner(bounds[usize::from(upwards)], upwards);
        } else {
            let finished = self.time + length >= self.duration || length >= self.duration - self.time;
            self.time = if finished { self.duration } else { self.time + length };
            if length <= 0.0 && !is_turn {
                return Err(self.not_followed(event));
            }
            if is_newmark {
                self.state.branch = self.motion.wall.branch_of(displacement, velocity);
            }
            if is_turn || outwards * velocity < 0.0 {
                // of Newmark's steps only the ends count
                let is_farther = outwards * from > outwards * displacement;
                let reach = if is_newmark && is_farther { from } else { displacement };
                self.unload(reach);
            }
        }
        if let Some(watch) = watch
            && self.state.tie != *self.motion.wall.tie_memory()
        {
            watch.fracture(&self.state.tie, self.time);
        }
        self.check()
    }

    /// Ends the yielding of ties at their largest displacement.
    fn unload(&mut self, displacement: f64) {
        if transition::unload(self.motion, &mut self.state, displacement) {
            self.enter_fracture(displacement);
        }
    }

    fn enter_fracture(&mut self, displacement: f64) {
        self.report.fractures[usize::from(displacement < 0.0)].get_or_insert(self.time);
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
            let velocity = state.velocity * motion.wall.passage_factor(state.velocity);
            Rebound { velocity, rests: too_many || velocity.abs() < motion.rest_speed }
        };
        let forcing = [forcing, self.rate];
        let event =
            transition::pass_corner(motion, &mut self.state, Reached { corner, upwards }, forcing, rebound);
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

    fn not_followed(&self, fault: &'static str) -> SolverError {
        let State { displacement, velocity, .. } = self.state;
        let (reached, duration) = (self.time, self.duration);
        SolverError::NotFollowed { fault, reached, duration, displacement, velocity }
    }
}
