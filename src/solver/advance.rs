//! Moves a state through one segment, with the motion that belongs to its ties at each moment.

use oscillator::KinematicState;

use super::demand::Demands;
use super::event::{self, Shape};
use super::memo::{Memo, Propagator};
use super::motion::Motion;
use super::run::Run;
use super::state::{Phase, Report, Segment, SolverError, State, Work};
use super::watch::Watch;

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
        if !integral
            && watch.is_none()
            && let Some(report) = self.pass_quietly(state, segment.duration, forcing, memo)
        {
            return Ok(report);
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
        // of a wall as it was at first, records leave here the steps that are not quiet
        if state.tie != *self.wall.tie_memory()
            && let Some(report) = self.pass_quietly(state, duration, forcing, memo)
        {
            return Ok(report);
        }
        self.run(state, duration, forcing, false, memo, None)
    }

    /// Moves `state` through a segment without events, with the ties as they are; `None` for another segment.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a call would take a tenth of a step")]
    fn pass_quietly(
        &self,
        state: &mut State,
        duration: f64,
        forcing: [f64; 2],
        memo: &mut Memo,
    ) -> Option<Report> {
        let (motion, propagator) = memo.prepare(self, &state.tie);
        let end = motion.quiet_end(state, duration, forcing, propagator)?;
        (state.displacement, state.velocity) = (end.displacement, end.velocity);
        Some(Report { work: Work { pieces: 1, ..Work::default() }, ..Report::default() })
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
            let (motion, propagator) = memo.prepare(self, &now.tie);
            if now.tie != state.tie {
                motion.find_branch(&mut now);
            }
            let mut run = Run::new(motion, now, duration, forcing, integral, propagator);
            (run.time, run.report) = (time, report);
            run.watch = watch.as_mut().map(|&mut (ref mut demands, segment, time, drift)| Watch {
                demands,
                wall: &motion.wall,
                segment,
                time,
                drift,
            });
            run.finish()?;
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

    /// Returns the end of a segment without events: one piece in closed form that reaches no corner and no
    /// new peak. `None` for every other segment. The result is bit for bit that of a [`Run`].
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "a call would take a tenth of a step")]
    fn quiet_end(
        &self,
        state: &State,
        duration: f64,
        [from, to]: [f64; 2],
        propagator: &mut Propagator,
    ) -> Option<KinematicState> {
        let &State { displacement, velocity, branch: index, phase, ref peaks, .. } = state;
        let (branch, oscillator) = (&self.wall.branches()[index], &self.oscillators[index]);
        let is_one_piece = duration > 0.0 && duration <= oscillator.longest_piece();
        // what yields must be followed to the turning point, however near
        let yields = branch.yielding_side().is_some();
        if phase != Phase::Moving || !is_one_piece || !self.takes_closed_form(index) || yields {
            return None;
        }
        if oscillator.is_spread(duration) {
            return None;
        }
        let acceleration = branch.acceleration(displacement, velocity, from);
        let start = KinematicState { displacement, velocity, acceleration };
        let rate = (to - from) / duration;
        let end = propagator.end(index, oscillator, start, rate, duration);
        let most = oscillator.bounds(start, rate, duration);
        let corners = [branch.lower, branch.upper];
        let is_quiet = matches!(event::settle([start, end], duration, most, corners, peaks), Shape::Quiet);
        // if the motion has overflowed, a run reports where
        (is_quiet && end.displacement.is_finite() && end.velocity.is_finite()).then_some(end)
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
            motion.quiet_end(state, duration, [0.0; 2], &mut Propagator::default()).is_some()
        };
        assert!(quiet(&state, 0.01) && !quiet(&state, 100.0));
        assert!(!quiet(&State { phase: Phase::Resting, ..state }, 0.01));
    }
}
