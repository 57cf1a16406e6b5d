//! Moves a state through one segment, with the motion that belongs to its ties at each moment.

use oscillator::KinematicState;

use super::demand::Demands;
use super::event::{self, Shape};
use super::memo::{Memo, Propagators};
use super::motion::Motion;
use super::run::Run;
use super::state::{Phase, Report, Segment, SolverError, State, Work};
use super::watch::Watch;
use crate::wall::Couple;

impl Motion {
    /// Moves `state` through a segment. `with_couple` asks for ∫G dt in the report. `memo` keeps the
    /// propagators of the last whole steps.
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was.
    pub fn advance(
        &self,
        state: &mut State,
        segment: &Segment,
        with_couple: bool,
        memo: &mut Memo,
    ) -> Result<Report, SolverError> {
        self.advance_watched(state, segment, with_couple, memo, None)
    }

    /// Moves `state` through a segment and collects its demands. `watch` holds the demands so far and the
    /// time at the start of the segment \[s\].
    ///
    /// # Errors
    /// [`SolverError`]; `state` is then as it was, and the demands are those up to the failure.
    #[inline]
    pub(crate) fn advance_watched(
        &self,
        state: &mut State,
        segment: &Segment,
        with_couple: bool,
        memo: &mut Memo,
        watch: Option<(&mut Demands, f64)>,
    ) -> Result<Report, SolverError> {
        let body = self.wall.body();
        let forcing = [body.forcing(segment.from), body.forcing(segment.to)];
        let mut watch = watch.map(|(demands, time)| Watch { demands, wall: &self.wall, segment, time });
        let duration = segment.duration;
        if let Some(report) = self.pass_quietly(state, duration, forcing, with_couple, memo, watch.as_mut()) {
            return Ok(report);
        }
        self.run(state, duration, forcing, with_couple, memo, watch.as_mut())
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
        // of a wall as it was at first, records leave here the steps that are not quiet
        if state.tie != *self.wall.tie_memory()
            && let Some(report) = self.pass_quietly(state, duration, forcing, false, memo, None)
        {
            return Ok(report);
        }
        self.run(state, duration, forcing, false, memo, None)
    }

    /// Moves `state` through a segment without events, with the ties as they are; `None` for another segment,
    /// or for one whose demands have to be searched.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a call would take a tenth of a step")]
    fn pass_quietly(
        &self,
        state: &mut State,
        duration: f64,
        forcing: [f64; 2],
        with_couple: bool,
        memo: &mut Memo,
        watch: Option<&mut Watch<'_>>,
    ) -> Option<Report> {
        let (motion, propagators) = memo.prepare(self, &state.tie);
        if state.phase != Phase::Moving {
            return motion.stay(state, duration, forcing, with_couple, watch);
        }
        let end = motion.quiet_end(state, duration, forcing, propagators, watch)?;
        let couple_impulse =
            if with_couple { motion.couple_over(state, end, duration, forcing, propagators) } else { 0.0 };
        (state.displacement, state.velocity) = (end.displacement, end.velocity);
        state.peaks.include(end.displacement);
        Some(Report { work: Work { pieces: 1, ..Work::default() }, couple_impulse, ..Report::default() })
    }

    /// Returns ∫G dt over a segment in one piece to its `end`, which was found by the propagators last.
    fn couple_over(
        &self,
        state: &State,
        end: KinematicState,
        duration: f64,
        [from, to]: [f64; 2],
        propagators: &Propagators,
    ) -> f64 {
        let &State { displacement, velocity, branch: index, .. } = state;
        let branch = &self.wall.branches()[index];
        let acceleration = branch.acceleration(displacement, velocity, from);
        let start = KinematicState { displacement, velocity, acceleration };
        let rate = (to - from) / duration;
        let Couple { at_zero, slope } = branch.couple;
        at_zero * duration + slope * propagators.displacement_integral([start, end], rate, duration)
    }

    /// Passes a segment through which a wall that rests or lies stays where it is; `None` for one in which it
    /// begins to move.
    fn stay(
        &self,
        state: &State,
        duration: f64,
        forcing: [f64; 2],
        with_couple: bool,
        watch: Option<&mut Watch<'_>>,
    ) -> Option<Report> {
        let mut report = Report::default();
        if state.phase == Phase::Resting {
            let [lowest, highest] = self.rest_band;
            let stays = duration > 0.0 && forcing.iter().all(|p| lowest < *p && *p < highest);
            if !stays {
                return None;
            }
            if let (false, Some(watch)) = (state.overturned, watch) {
                watch.rest(0.0, duration);
            }
            if with_couple {
                report.couple_impulse = self.wall.couple_of_rest(forcing, duration);
            }
        }
        Some(report)
    }

    /// Moves `state` through a time, with the motion that belongs to the memory of the ties at each moment.
    fn run(
        &self,
        state: &mut State,
        duration: f64,
        forcing: [f64; 2],
        with_couple: bool,
        memo: &mut Memo,
        mut watch: Option<&mut Watch<'_>>,
    ) -> Result<Report, SolverError> {
        let (mut now, mut time, mut report) = (*state, 0.0, Report::default());
        loop {
            let (motion, propagators) = memo.prepare(self, &now.tie);
            if now.tie != state.tie {
                motion.find_branch(&mut now);
            }
            let mut run = Run::new(motion, now, duration, forcing, with_couple, propagators);
            (run.time, run.report) = (time, report);
            let mut on_wall = watch.as_deref_mut().map(|watch| watch.of(&motion.wall));
            run.finish(on_wall.as_mut())?;
            if run.state.tie == *motion.wall.tie_memory() {
                *state = run.state;
                return Ok(run.report);
            }
            (now, time, report) = (run.state, run.time, run.report);
        }
    }

    /// Sets the branch of a state whose ties have changed: ahead of the motion, and inwards where it turns.
    pub(super) fn find_branch(&self, state: &mut State) {
        let State { displacement, velocity, .. } = *state;
        let direction = if velocity == 0.0 { -displacement } else { velocity };
        state.branch = self.wall.branch_of(displacement, direction);
    }

    /// Returns the end of a segment of a moving wall without events: one piece in closed form that reaches no
    /// corner, and no new peak before its end. Its ends show the demands on it. `None` for every other
    /// segment. The result is bit for bit that of a [`Run`].
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a call would take a tenth of a step")]
    fn quiet_end(
        &self,
        state: &State,
        duration: f64,
        [from, to]: [f64; 2],
        propagators: &mut Propagators,
        watch: Option<&mut Watch<'_>>,
    ) -> Option<KinematicState> {
        let &State { displacement, velocity, branch: index, ref peaks, .. } = state;
        let (branch, oscillator) = (&self.wall.branches()[index], &self.oscillators[index]);
        let is_one_piece = duration > 0.0 && duration <= oscillator.longest_piece();
        // what yields must be followed to the turning point, however near
        let yields = branch.yielding_side().is_some();
        if !is_one_piece || !self.takes_closed_form(index) || yields {
            return None;
        }
        if oscillator.is_spread(duration) {
            return None;
        }
        let acceleration = branch.acceleration(displacement, velocity, from);
        let start = KinematicState { displacement, velocity, acceleration };
        let rate = (to - from) / duration;
        let end = propagators.end(index, oscillator, start, rate, duration);
        let most = oscillator.bounds(start, rate, duration);
        let corners = [branch.lower, branch.upper];
        let goes_on = match event::settle([start, end], duration, most, corners, peaks) {
            Shape::Quiet => true,
            Shape::Monotone | Shape::Back => (branch.lower..=branch.upper).contains(&end.displacement),
            Shape::Turning | Shape::Split => false,
        };
        // if the motion has overflowed, a run reports where
        if !goes_on || !end.displacement.is_finite() || !end.velocity.is_finite() {
            return None;
        }
        let is_watched = watch.is_none_or(|watch| {
            let bounds = [most.acceleration, most.jerk, oscillator.snap(most)];
            watch.include_ends(branch, state.overturned, [start, end], bounds)
        });
        is_watched.then_some(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choices::{DampingModel, ForceLaw, Impact, Mechanism};
    use crate::wall::{Ends, Parameters, Support};

    /// A short step without events is quiet; a long step is not.
    #[test]
    fn ordinary_steps_are_quiet() {
        let damping_model = DampingModel::ConstantCoefficient;
        let motion = Motion::of(&Parameters { damping_model, ..Parameters::default() }, 1e-8).unwrap();
        let u_ins = motion.wall().body().instability.positive;
        let mut state = motion.start(0.3 * u_ins, 0.0, Support::default());
        state.peaks.include(0.4 * u_ins);
        let quiet = |state: &State, duration: f64| {
            motion.quiet_end(state, duration, [0.0; 2], &mut Propagators::default(), None).is_some()
        };
        assert!(quiet(&state, 0.01) && !quiet(&state, 100.0));
    }

    /// Steps by their ends have the state, the work and the demands of a search, bit for bit.
    #[test]
    fn steps_by_their_ends_have_the_demands_of_a_search() {
        let rocking = Parameters {
            damping_model: DampingModel::ConstantCoefficient,
            height: 3.0,
            thickness: 0.25,
            u_start: 0.0,
            ..Parameters::default()
        };
        let rigid = Parameters {
            damping_model: DampingModel::None,
            force_law: ForceLaw::RigidLinear,
            impact: Impact::Restitution,
            ..rocking.clone()
        };
        let strip = Parameters { mechanism: Mechanism::VerticalSpanning, ..rocking.clone() };
        let tied = Parameters { tie_height: 2.0, tie_stiffness: 3e5, ..rocking.clone() };
        let acceleration = |t: f64| {
            let [slow, fast] = [5.0, 43.0].map(|omega: f64| libm::sin(omega * t));
            0.4 * t.min(4.0) * (slow + 0.4 * fast)
        };
        let (step, steps) = (5e-3, 2000);
        for parameters in [rocking, rigid, strip, tied] {
            let motion = Motion::of(&parameters, 1e-8).unwrap();
            let wall = motion.wall();
            let mut state = motion.start(0.0, 0.0, Support::default());
            let mut demands = Demands::new(wall, 0.0, [0.0; 3], Ends::default(), |_| 0.0, &[0.1, 0.3]);
            let (mut memo, mut by_ends) = (Memo::default(), 0);
            for index in 0..steps {
                let time = f64::from(index) * step;
                let [from, to] = [time, time + step].map(|t| Support::rigid(acceleration(t)));
                let segment = &Segment { duration: step, from, to };
                let forcing = [wall.body().forcing(from), wall.body().forcing(to)];
                let (mut searched, mut of_search) = (state, demands.clone());
                let watch = &mut Watch { demands: &mut of_search, wall, segment, time };
                let memos = &mut Memo::default();
                let expected = motion.run(&mut searched, step, forcing, true, memos, Some(watch));
                let watch = &mut Watch { demands: &mut demands, wall, segment, time };
                let found = motion.pass_quietly(&mut state, step, forcing, true, &mut memo, Some(watch));
                by_ends += i32::from(found.is_some());
                if let Some(report) = found {
                    assert_eq!((Ok(report), state, &demands), (expected, searched, &of_search), "{time} s");
                } else {
                    (state, demands) = (searched, of_search);
                }
            }
            assert!(by_ends >= steps / 4, "{by_ends} of {steps} steps by their ends");
        }
    }
}
