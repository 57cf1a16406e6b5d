//! Steps that are not plain: new extremes, turning points, corners.

use super::super::super::run::Run;
use super::super::super::secant::SecantBranch;
use super::super::super::transition::{Rebound, branch_beyond, pass};
use super::super::super::{Phase, Report, SolverError, State, Work};
use super::super::step_map::{AffineSteps, StepMap, Way};
use super::super::step_part::{Course, Flow, StepPart, WayOut};
use super::ActiveRun;
use oscillator::KinematicState;

/// Parts of one step without the general search: bounces become fewer than these before a wall comes to rest,
/// unless it loses next to nothing.
const MOST_PARTS: u32 = 1024;

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
        match self.part_on(map, from, self.remaining(), [start, rate]) {
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

    /// Follows a step part by part, past corners at which the wall neither overturns, departs nor lands, to
    /// its end, to rest until then, or to a branch on which lanes go on. Tells whether that was all; else
    /// nothing has changed.
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
                Course::Leaves(way_out) => match self.cross(&part, way_out, &mut state, &mut work) {
                    Some((from, time)) => (from, time, part.forcing_after(time)),
                    None => return false,
                },
            };
            remaining -= time;
            if state.phase == Phase::Resting {
                let rests = self.rests_under([forcing, forcing + part.rate * remaining]);
                if rests {
                    self.state = state;
                    self.count(work);
                }
                return rests;
            }
            let Some(map) = self.map_of(state.branch) else { return false };
            let share = 1.0 - remaining / self.solver.step;
            // a share that grows and leaves something: else the step goes on here
            let shared = share > self.cursor.share && share < 1.0;
            if self.plain.parts && matches!(map.way, Way::Curved(_)) && shared {
                (state.displacement, state.velocity) = (from.displacement, from.velocity);
                self.state = state;
                // the step itself is counted where it ends
                self.tally.work.add(work);
                self.load_state();
                self.bound_grown_force();
                self.cursor.share = share;
                return true;
            }
            let Some(next) = self.part_on(map, from, remaining, [forcing, part.rate]) else {
                return false;
            };
            part = next;
            course = part.course(map.corners, &mut state.peaks);
        }
        false
    }

    /// Takes the state through the corner that a part leaves its branch by; returns the motion beyond it, and
    /// when that is. `None` where the wall overturns, departs or lands there, or where that is not found at
    /// once.
    #[inline(always)]
    fn cross(
        &self,
        part: &StepPart<'a>,
        way_out: WayOut,
        state: &mut State,
        work: &mut Work,
    ) -> Option<(KinematicState, f64)> {
        let motion = self.solver.motion;
        let index = state.branch + usize::from(way_out.upwards);
        let corner = motion.wall.corners()[index];
        let special = corner.overturning || corner.departure || corner.landing;
        if special || (!way_out.turns && part.from.displacement == corner.displacement) {
            return None;
        }
        let next = if corner.stop { state.branch } else { branch_beyond(index, way_out.upwards) };
        let (map, ahead) = (self.map_of(state.branch)?, self.map_of(next)?);
        // where more than the stiffness changes, the corner itself is asked for, and ü taken anew
        let even = !corner.passage && matches!((&map.way, &ahead.way), (Way::Affine(_), Way::Affine(_)));
        let change = if even { ahead.stiffness - map.stiffness } else { f64::INFINITY };
        let (time, mut from) = part.leave(way_out, map.corners, change, &state.peaks)?;
        let forcing = part.forcing_after(time);
        state.peaks.include(corner.displacement);
        state.velocity = from.velocity;
        let rebound = |state: &State| {
            let velocity = state.velocity * motion.wall.passage_factor();
            Rebound { velocity, rests: velocity.abs() < motion.rest_speed }
        };
        let event = pass(motion, state, (index, way_out.upwards), [forcing, part.rate], rebound);
        // a wall that e = 0 stops goes on by the forcing
        if !event.stopped && state.branch != next {
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

    /// Tells whether a wall that rests does so while the forcing goes from one value to another.
    #[inline(always)]
    pub(super) fn rests_under(&self, p: [f64; 2]) -> bool {
        let [lowest, highest] = self.solver.motion.rest_band;
        p.iter().all(|&p| lowest < p && p < highest)
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

    /// Makes a part of a step on a branch, up to `length` from an instant on under a forcing and its rate;
    /// `None` where that needs the general search.
    #[inline(always)]
    fn part_on(
        &self,
        map: &'a StepMap,
        from: KinematicState,
        length: f64,
        [forcing, rate]: [f64; 2],
    ) -> Option<StepPart<'a>> {
        match &map.way {
            Way::Affine(steps) => {
                let to = steps.short.as_ref()?.after(length, from, rate);
                Some(StepPart { flow: Flow::Linear(steps), from, to, length, forcing, rate })
            }
            Way::Curved(_) if length <= 0.0 => None,
            Way::Curved(secant) => {
                let now = [from.displacement, from.velocity];
                let ends = [forcing, forcing + rate * length];
                if let Some((length, end)) = self.follow_to_corner(map, secant, now, ends, length) {
                    let [displacement, velocity] = end;
                    // beyond a corner ü is taken anew
                    let to = KinematicState { displacement, velocity, acceleration: 0.0 };
                    return Some(StepPart { flow: Flow::Known, from, to, length, forcing, rate });
                }
                let tolerances = self.solver.motion.tolerances;
                let (polynomial, horizon) = secant.series(now, ends, length, tolerances);
                let length = horizon.min(length);
                let (from, to) = (polynomial.start(), polynomial.at(length));
                let flow = Flow::Series(polynomial);
                Some(StepPart { flow, from, to, length, forcing, rate })
            }
        }
    }

    /// Follows a motion to the end of a length, or to the corner ahead if that comes first; returns the time,
    /// and u and u̇ then. `None` where u̇ is not known to keep its sign (docs/record-path.md, §7), and as
    /// [`SecantBranch::follow_to_corner`].
    #[inline(always)]
    fn follow_to_corner(
        &self,
        map: &StepMap,
        secant: &SecantBranch,
        [u, v]: [f64; 2],
        p: [f64; 2],
        length: f64,
    ) -> Option<(f64, [f64; 2])> {
        if !secant.is_ratio {
            return None;
        }
        // u gets no further while |u̇| is at most 3/2 of what it is now
        let furthest = u + 1.5 * v * length;
        let corner = map.corners[usize::from(v > 0.0)];
        let leaves = (furthest - corner) * v >= 0.0;
        let reached = if leaves { corner } else { furthest };
        let force = map.force(u).abs().max(map.force(reached).abs());
        let most = p[0].abs().max(p[1].abs()) + force + 1.5 * map.damping * v.abs();
        // u̇ changes by less than half of it
        if 2.0 * most * length >= v.abs() {
            return None;
        }
        secant.follow_to_corner([u, v], p, length, leaves.then_some(corner), self.solver.motion.tolerances)
    }
}
