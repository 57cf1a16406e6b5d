//! Steps that are not plain: new extremes, turning points, corners.

use super::super::super::run::Run;
use super::super::super::transition::{Rebound, branch_beyond, pass};
use super::super::super::{Motion, Report, SolverError, State, Work};
use super::super::step_map::{AffineSteps, StepMap, Way};
use super::super::step_part::{Course, Flow, StepPart};
use super::ActiveRun;
use oscillator::KinematicState;

/// Parts of one step without the general search.
const MOST_PARTS: u32 = 16;

impl<'a> ActiveRun<'a> {
    /// Takes a step that may reach a corner or a new extreme, and that ends at `end` if it does not leave its
    /// branch.
    #[inline(always)]
    pub(super) fn careful_step(
        &mut self,
        map: &'a StepMap,
        steps: &'a AffineSteps,
        p: [f64; 2],
        end: [f64; 2],
    ) -> Result<(), SolverError> {
        let start = self.now;
        self.include_nodes();
        let within = end[0] > map.corners[0] && end[0] < map.corners[1];
        if within && self.bounds.keep_sign(start[1], end) {
            self.arrive(end);
            return Ok(());
        }
        let kinematics = |[displacement, velocity]: [f64; 2], p: f64| KinematicState {
            displacement,
            velocity,
            acceleration: p - steps.oscillator.damping() * velocity - map.force(displacement),
        };
        let (from, to) = (kinematics(start, p[0]), kinematics(end, p[1]));
        let length = self.solver.step;
        let (forcing, rate) = (p[0], (p[1] - p[0]) / length);
        let part = StepPart { flow: Flow::Linear(steps), from, to, length, forcing, rate };
        self.take_part(map, &part, p)
    }

    /// Takes a step on a branch with secant damping that may reach a corner or a new extreme.
    #[inline(never)]
    pub(super) fn curved_step(&mut self, map: &'a StepMap, p: [f64; 2]) -> Result<(), SolverError> {
        let [displacement, velocity] = self.now;
        self.include_nodes();
        let (rate, [start, _]) = ((p[1] - p[0]) / self.solver.step, self.rest_of(p));
        let from = KinematicState { displacement, velocity, acceleration: 0.0 };
        match part_on(map, from, self.remaining(), [start, rate], self.solver.motion) {
            Some(part) => self.take_part(map, &part, p),
            None => self.search_step(p, None),
        }
    }

    /// Returns what is left of the step \[s\].
    #[inline(always)]
    fn remaining(&self) -> f64 {
        (1.0 - self.cursor.share) * self.solver.step
    }

    /// Returns the forcing now and at the end of the step.
    #[inline(always)]
    fn rest_of(&self, [p0, p1]: [f64; 2]) -> [f64; 2] {
        [p0 + (p1 - p0) * self.cursor.share, p1]
    }

    /// Takes a step from its first part on.
    #[inline(always)]
    fn take_part(&mut self, map: &'a StepMap, part: &StepPart<'a>, p: [f64; 2]) -> Result<(), SolverError> {
        let KinematicState { displacement, velocity, .. } = part.to;
        let whole = part.length == self.remaining();
        match part.course(map.corners, &mut self.state.peaks) {
            Course::Stays if whole => self.arrive([displacement, velocity]),
            course if self.follow_parts(part, course) => {}
            _ => {
                let known = matches!(part.flow, Flow::Linear(_)).then_some(part.to);
                self.search_step(p, known)?;
            }
        }
        Ok(())
    }

    /// Goes on from the end of a step on the same branch.
    #[inline(always)]
    fn arrive(&mut self, end: [f64; 2]) {
        self.state.peaks.include(end[0]);
        self.now = end;
        self.bound_grown_force();
    }

    /// Follows a step part by part, past corners at which the wall neither overturns, departs, lands nor
    /// stops, to its end, or to a branch on which lanes go on. Tells whether that was all; else nothing has
    /// changed.
    #[inline(always)]
    fn follow_parts(&mut self, first: &StepPart<'a>, mut course: Course) -> bool {
        let mut part = *first;
        let mut state = self.state;
        let mut remaining = self.remaining();
        let mut work = Work::default();
        for _ in 0..MOST_PARTS {
            work.pieces += 1;
            let (from, time, forcing) = match course {
                Course::Unclear => return false,
                Course::Stays => {
                    state.peaks.include(part.to.displacement);
                    if part.length == remaining {
                        (state.displacement, state.velocity) = (part.to.displacement, part.to.velocity);
                        self.state = state;
                        self.count(work);
                        return true;
                    }
                    (part.to, part.length, part.forcing_after(part.length))
                }
                Course::Leaves => match self.cross(&part, &mut state, &mut work) {
                    Some((from, time)) => (from, time, part.forcing_after(time)),
                    None => return false,
                },
            };
            remaining -= time;
            let Some(map) = self.map_of(state.branch) else { return false };
            if self.plain.parts && matches!(map.way, Way::Curved(_)) && remaining > 0.0 {
                (state.displacement, state.velocity) = (from.displacement, from.velocity);
                self.state = state;
                // the step itself is counted where it ends
                self.tally.work.add(work);
                self.load_state();
                self.bound_grown_force();
                self.cursor.share = 1.0 - remaining / self.solver.step;
                return true;
            }
            let Some(next) = part_on(map, from, remaining, [forcing, part.rate], self.solver.motion) else {
                return false;
            };
            part = next;
            course = part.course(map.corners, &mut state.peaks);
        }
        false
    }

    /// Takes the state through the corner that a part leaves its branch by; returns the motion beyond it, and
    /// when that is. `None` where it is not an ordinary corner, or not found at once.
    #[inline(always)]
    fn cross(
        &self,
        part: &StepPart<'a>,
        state: &mut State,
        work: &mut Work,
    ) -> Option<(KinematicState, f64)> {
        let motion = self.solver.motion;
        let upwards = part.to.displacement > part.from.displacement;
        let index = state.branch + usize::from(upwards);
        let corner = motion.wall.corners()[index];
        let special = corner.overturning || corner.departure || corner.landing;
        if special || part.from.displacement == corner.displacement {
            return None;
        }
        let next = if corner.stop { state.branch } else { branch_beyond(index, upwards) };
        let (map, ahead) = (self.map_of(state.branch)?, self.map_of(next)?);
        // where more than the stiffness changes, the corner itself is asked for, and ü taken anew
        let even = !corner.passage && matches!((&map.way, &ahead.way), (Way::Affine(_), Way::Affine(_)));
        let change = if even { ahead.stiffness - map.stiffness } else { f64::INFINITY };
        let (time, mut from) = part.passage(corner.displacement, change)?;
        let forcing = part.forcing_after(time);
        state.peaks.include(corner.displacement);
        state.velocity = from.velocity;
        let rebound = |state: &State| {
            let velocity = state.velocity * motion.wall.passage_factor();
            Rebound { velocity, rests: velocity.abs() < motion.rest_speed }
        };
        let event = pass(motion, state, (index, upwards), [forcing, part.rate], rebound);
        // a wall that is stopped goes on by the forcing
        if event.stopped || state.branch != next {
            return None;
        }
        if !even {
            from.velocity = state.velocity;
            let branch = &motion.wall.branches()[next];
            from.acceleration = branch.acceleration(from.displacement, from.velocity, forcing);
        }
        work.add(event.work);
        Some((from, time))
    }

    /// Returns the map of a branch.
    #[inline(always)]
    fn map_of(&self, branch: usize) -> Option<&'a StepMap> {
        self.solver.maps.get(branch)?.as_ref()
    }

    /// Takes a step by the general search for events.
    #[cold]
    pub(super) fn search_step(
        &mut self,
        p: [f64; 2],
        known_end: Option<KinematicState>,
    ) -> Result<(), SolverError> {
        [self.state.displacement, self.state.velocity] = self.now;
        let (length, p) = (self.remaining(), self.rest_of(p));
        let mut run = Run::new(self.solver.motion, self.state, length, p, false, &mut self.memo);
        run.first_end = known_end;
        run.finish()?;
        let Report { overturning, work, put_to_rest, .. } = run.report;
        self.state = run.state;
        self.tally.put_to_rest |= put_to_rest;
        if let (Some(offset), None) = (overturning, self.tally.overturning) {
            self.overturn(offset);
        }
        self.count(work);
        Ok(())
    }

    /// Counts a step that was not plain, and goes on from its state.
    #[inline(always)]
    fn count(&mut self, work: Work) {
        self.tally.work.add(work);
        self.tally.steps += 1;
        self.load_state();
        self.bound_grown_force();
    }
}

/// Makes a part of a step on a branch, up to `length` from an instant on under a forcing and its rate; `None`
/// where that needs the general search.
#[inline(always)]
fn part_on<'a>(
    map: &'a StepMap,
    from: KinematicState,
    length: f64,
    [forcing, rate]: [f64; 2],
    motion: &Motion,
) -> Option<StepPart<'a>> {
    match &map.way {
        Way::Affine(steps) => {
            let to = steps.short.as_ref()?.after(length, from, rate);
            Some(StepPart { flow: Flow::Linear(steps), from, to, length, forcing, rate })
        }
        Way::Curved(secant) => {
            let now = [from.displacement, from.velocity];
            let ends = [forcing, forcing + rate * length];
            let (polynomial, horizon) = secant.series(now, ends, length, motion.tolerances);
            let length = horizon.min(length);
            let (from, to) = (polynomial.start(), polynomial.at(length));
            let flow = Flow::Series(polynomial);
            Some(StepPart { flow, from, to, length, forcing, rate })
        }
    }
}
