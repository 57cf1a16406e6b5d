//! Steps that are not plain: new extremes, turning points, corners.

use super::super::super::run::Run;
use super::super::super::transition::branch_beyond;
use super::super::super::{Report, SolverError, Work};
use super::super::short::Short;
use super::super::step_map::StepMap;
use super::super::step_part::{Course, StepPart};
use super::ActiveRun;
use oscillator::KinematicState;

/// Corners crossed in one step without the general search.
const MOST_CROSSINGS: u32 = 4;

impl<'a> ActiveRun<'a> {
    /// Takes a step that may reach a corner or a new extreme, and that ends at `end` if it does not leave its
    /// branch.
    #[inline(always)]
    pub(super) fn careful_step(
        &mut self,
        map: &'a StepMap,
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
            acceleration: p - map.oscillator.damping() * velocity - map.force(displacement),
        };
        let (from, to) = (kinematics(start, p[0]), kinematics(end, p[1]));
        let length = self.solver.step;
        let part = StepPart { from, to, length, rate: (p[1] - p[0]) / length };
        match part.course(map, &mut self.state.peaks) {
            Course::Stays => self.arrive(end),
            Course::Leaves if self.cross(part) => {}
            Course::Leaves | Course::Unclear => self.search_step(p, Some(to))?,
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

    /// Takes a step on which u, monotone, leaves the branch through corners where nothing but the stiffness
    /// changes, and then stays on a branch: the ordinary case of a corner, without the general search. Tells
    /// whether it was that.
    #[inline(always)]
    fn cross(&mut self, mut part: StepPart) -> bool {
        let wall = &self.solver.motion.wall;
        let mut state = self.state;
        let upwards = part.to.displacement > part.from.displacement;
        for corners in 1..=MOST_CROSSINGS {
            let index = state.branch + usize::from(upwards);
            let corner = wall.corners()[index];
            if corner.is_marked() || part.from.displacement == corner.displacement {
                return false;
            }
            let next = branch_beyond(index, upwards);
            let [Some((map, short)), Some((ahead, short_ahead))] =
                [state.branch, next].map(|branch| self.short_map(branch))
            else {
                return false;
            };
            let change = ahead.oscillator.stiffness() - map.oscillator.stiffness();
            let Some((time, from)) = part.passage(map, short, corner.displacement, change) else {
                return false;
            };
            let length = part.length - time;
            part = StepPart { from, to: short_ahead.after(length, from, part.rate), length, ..part };
            state.branch = next;
            state.peaks.include(corner.displacement);
            match part.course(ahead, &mut state.peaks) {
                Course::Leaves => {}
                Course::Unclear => return false,
                Course::Stays => {
                    (state.displacement, state.velocity) = (part.to.displacement, part.to.velocity);
                    state.peaks.include(state.displacement);
                    self.state = state;
                    let corners = u64::from(corners);
                    self.count(Work { pieces: 1 + corners, corners, impacts: 0 });
                    return true;
                }
            }
        }
        false
    }

    /// Returns the maps of a branch over a step and over parts of one.
    #[inline(always)]
    fn short_map(&self, branch: usize) -> Option<(&'a StepMap, &'a Short)> {
        let map = self.solver.maps.get(branch)?.as_ref()?;
        Some((map, map.short.as_ref()?))
    }

    /// Takes a step by the general search for events.
    #[cold]
    pub(super) fn search_step(
        &mut self,
        p: [f64; 2],
        known_end: Option<KinematicState>,
    ) -> Result<(), SolverError> {
        [self.state.displacement, self.state.velocity] = self.now;
        let mut run = Run::new(self.solver.motion, self.state, self.solver.step, p, false, &mut self.memo);
        run.first_end = known_end;
        let (state, report) = run.finish()?;
        let Report { overturning, work, put_to_rest, .. } = report;
        self.state = state;
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
