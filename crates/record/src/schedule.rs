//! The one scheduler: of runs by themselves, in one lane, and of runs side by side.
//!
//! A **lane** is a place in a vector and holds one run at a time. Its run goes through these phases:
//!
//! 1. `start_next` puts the next run into the lane; `alone` follows it until it comes to a branch of the kind
//!    on which the lanes step together.
//! 2. A `round` takes steps of all lanes at once: on branches with constant damping `affine_steps`, on others
//!    `take_parts`. It ends where a lane has ended its block, or cannot go on by these steps.
//! 3. `resolve` takes the run of such a lane past that point: it bounds the forces anew, passes a corner or a
//!    turn, or searches the rest of the step as the general solver does.
//! 4. A second pass follows the blocks again in which an extreme between samples may exceed those known.

#[cfg(target_arch = "x86_64")]
use fearless_simd::{Level, Simd};
use rocking_wall::solver::secant::{ByRatio, ByStiffness};
use rocking_wall::solver::{Memo, Peaks, Phase, SolverError, State, Work};

use crate::lanes::{Block, Lanes, Pass, Run, Waiting, each};
use crate::number::WIDTH;
use crate::run::{BatchRun, Observer, Outcome, RunEnd, RunStart};
use crate::table::{Law, Stepping};

impl<O: Observer> Lanes<'_, O> {
    /// Follows all runs to their ends, one after the other; returns what became of each.
    pub(crate) fn one_by_one(mut self) -> Vec<Result<Outcome, SolverError>> {
        // no steps are taken side by side, so that `fill` follows one run after the other to its end
        self.fill(0);
        self.pass = Pass::Extremes;
        self.fill(0);
        self.outcomes()
    }

    /// Runs everything to the end. Runs on the same kind of branch step together (`round`) until one needs
    /// work of its own; `watch` is shown which lanes wait then. Returns what became of each.
    #[inline(always)]
    pub(crate) fn side_by_side(
        mut self,
        together: Stepping,
        watch: &mut dyn FnMut(Waiting),
        round: impl Fn(&mut Self, u8) -> Waiting,
    ) -> Vec<Result<Outcome, SolverError>> {
        self.together = Some(together);
        for pass in [self.pass, Pass::Extremes] {
            self.pass = pass;
            let mut busy = (0..WIDTH).fold(0, |busy, lane| busy | u8::from(self.fill(lane)) << lane);
            while busy != 0 {
                let waiting = round(&mut self, busy);
                watch(waiting);
                let Waiting { ended, to_resolve } = waiting;
                for lane in each(ended | to_resolve) {
                    let goes = to_resolve >> lane & 1 == 0 || self.resolve(lane);
                    if !(goes && self.alone(lane) || self.fill(lane)) {
                        busy &= !(1 << lane);
                    }
                }
            }
        }
        self.outcomes()
    }

    fn outcomes(self) -> Vec<Result<Outcome, SolverError>> {
        let include = |(mut outcome, extremes): (Outcome, Peaks)| {
            outcome.state.peaks.include(extremes.positive);
            outcome.state.peaks.include(-extremes.negative);
            Ok(outcome)
        };
        let mut outcomes: Vec<_> = self.outcomes.into_iter().zip(self.extremes).map(include).collect();
        // of the errors of one run the first counts
        for (number, error) in self.failures.into_iter().rev() {
            outcomes[number] = Err(error);
        }
        outcomes
    }

    /// Advances the next runs of a lane one by one until one can join the vector steps; returns whether there
    /// is one.
    fn fill(&mut self, lane: usize) -> bool {
        while self.start_next(lane) {
            if self.alone(lane) {
                return true;
            }
        }
        false
    }

    /// Starts the next run of this pass in a lane; returns whether there is one.
    fn start_next(&mut self, lane: usize) -> bool {
        match self.pass {
            Pass::Motion(_) => {
                let number = self.next;
                let Some(&BatchRun { record, start, .. }) = self.given.get(number) else { return false };
                let RunStart { state, factor } = start;
                self.next += 1;
                self.start(lane, Block::new(number, factor, state), record.forcing.count().max(1) - 1);
                true
            }
            Pass::Extremes => {
                while let Some(block) = self.candidates.pop() {
                    // the peaks of the motion pass, so that what one block adds does not depend on the others
                    let peaks = self.outcomes[block.number].state.peaks;
                    let table = &self.given[block.number].solver.table;
                    if self.may_exceed(&block, &peaks, table.largest_force(peaks.largest())) {
                        let state = State { peaks, ..block.state };
                        self.start(lane, Block { state, ..block }, block.end);
                        return true;
                    }
                }
                false
            }
        }
    }

    /// Starts a run in a lane, over some samples.
    fn start(&mut self, lane: usize, block: Block, last: usize) {
        let Block { state, factor, number, first, step_taken, .. } = block;
        let run = Run {
            block,
            last,
            state,
            is_stretched: state.tie != *self.given[number].solver.motion.wall().tie_memory(),
            force: 0.0,
            overturning: self.outcomes[number].overturning,
            searched: Work::default(),
            steps: 0,
            put_to_rest: false,
            memo: Memo::default(),
        };
        // lanes are filled in their order
        if lane < self.runs.len() {
            self.runs[lane] = run;
        } else {
            self.runs.push(run);
        }
        let BatchRun { solver, record, .. } = self.given[number];
        (self.solvers[lane], self.records[lane]) = (solver, record);
        let rows = &mut self.rows;
        for (row, factor) in rows.passage_factors.iter_mut().zip(solver.passage_factors) {
            row[lane] = factor;
        }
        rows.rest_speed[lane] = solver.motion.rest_speed();
        (rows.index[lane], rows.step_taken[lane], rows.factor[lane]) = (first as f64, step_taken, factor);
        (rows.u[lane], rows.v[lane]) = (state.displacement, state.velocity);
        rows.branch.set(lane, state.branch);
        (rows.corners[lane], rows.impacts[lane]) = (0.0, 0.0);
        self.enter_block(lane);
    }

    /// Follows the run of a lane by itself until it comes to steps taken side by side; returns whether it
    /// does so before its end.
    #[inline(never)]
    fn alone(&mut self, lane: usize) -> bool {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Level::new().as_avx2() {
            // AVX2 code is faster, as its instructions take three operands, and rounds alike
            return avx2.vectorize(
                #[inline(always)]
                || self.run_alone(lane),
            );
        }
        self.run_alone(lane)
    }

    #[inline(always)]
    fn run_alone(&mut self, lane: usize) -> bool {
        while self.in_block(lane) {
            let stepping = self.stepping(lane);
            if Some(stepping) == self.together && self.rows.index[lane] < self.rows.limit[lane] {
                return true;
            }
            let waiting = match stepping {
                Stepping::Affine => self.affine_steps::<f64>((), lane, 1),
                Stepping::Curved => self.take_parts_by_law(lane),
                Stepping::General => Waiting { ended: 0, to_resolve: u8::from(!self.rest_on(lane)) },
            };
            if waiting.to_resolve != 0 && !self.resolve(lane) {
                return false;
            }
        }
        false
    }

    /// Returns how the run of a lane takes steps.
    #[inline(always)]
    fn stepping(&self, lane: usize) -> Stepping {
        let run = &self.runs[lane];
        match run.state.phase {
            Phase::Moving if run.is_stretched => Stepping::General,
            Phase::Moving => self.solvers[lane].table.steppings[self.rows.branch.of(lane)],
            Phase::Resting | Phase::Landed => Stepping::General,
        }
    }

    #[inline(always)]
    fn take_parts_by_law(&mut self, lane: usize) -> Waiting {
        match self.solvers[lane].table.law {
            Law::Ratio => self.take_parts::<f64, ByRatio>((), lane, 1),
            Law::Stiffness => self.take_parts::<f64, ByStiffness>((), lane, 1),
        }
    }

    /// Takes the run of a lane past the point where it waits: computes f̂ anew, passes a corner, or searches
    /// the rest of the step. Returns whether the run could be followed.
    fn resolve(&mut self, lane: usize) -> bool {
        if self.rows.u[lane].abs() > self.rows.half_reach[lane] {
            self.bound_force(lane);
            return true;
        }
        self.rows.next_change[lane] = f64::INFINITY;
        let taken = match self.stepping(lane) {
            Stepping::Affine => self.follow_turns(lane),
            Stepping::Curved => self.pass_curved_corner(lane),
            Stepping::General => false,
        };
        if taken {
            return true;
        }
        let Err(error) = self.search(lane) else { return true };
        self.failures.push((self.runs[lane].block.number, error));
        false
    }

    /// Takes the steps through which the wall in a lane rests, up to the end of its block; returns whether
    /// there are any.
    fn rest_on(&mut self, lane: usize) -> bool {
        let [lowest, highest] = self.solvers[lane].motion.rest_band();
        let first = self.sample(lane);
        if self.runs[lane].state.phase != Phase::Resting {
            return false;
        }
        let holds = |sample: usize| {
            let p = self.rows.factor[lane] * self.records[lane].forcing.at(sample);
            lowest < p && p < highest
        };
        let end = self.runs[lane].block.end;
        let steps =
            if holds(first) { (first + 1..=end).take_while(|&sample| holds(sample)).count() } else { 0 };
        self.runs[lane].steps += steps as u64;
        for sample in first + 1..=first + steps {
            self.rows.index[lane] = sample as f64;
            self.see_now(lane);
        }
        steps > 0
    }

    /// Takes what is left of a step by the general search for events.
    fn search(&mut self, lane: usize) -> Result<(), SolverError> {
        self.include_ends(lane);
        let (sample, step_taken) = (self.sample(lane), self.rows.step_taken[lane]);
        let [from, to] = [0, 1].map(|n| self.rows.factor[lane] * self.records[lane].forcing.at(sample + n));
        let p = [from + (to - from) * step_taken, to];
        let (solver, step) = (self.solvers[lane], self.solvers[lane].step);
        let mut state = self.state(lane);
        let run = &mut self.runs[lane];
        // parts of the step that were taken before count as the one piece of a step that is not searched
        run.steps += u64::from(step_taken == 0.0);
        let report = solver.motion.advance_under(&mut state, (1.0 - step_taken) * step, p, &mut run.memo)?;
        run.searched.add(report.work);
        run.put_to_rest |= report.put_to_rest;
        run.state = state;
        run.is_stretched = state.tie != *solver.motion.wall().tie_memory();
        if let (Some(offset), None) = (report.overturning, run.overturning) {
            run.overturning = Some((sample as f64 + step_taken) * step + offset);
            if matches!(self.pass, Pass::Motion(end) if end != RunEnd::OfRecord) {
                run.last = sample + 1;
                run.block.end = run.last;
            }
        }
        let rows = &mut self.rows;
        (rows.u[lane], rows.v[lane]) = (state.displacement, state.velocity);
        (rows.index[lane], rows.step_taken[lane]) = ((sample + 1) as f64, 0.0);
        rows.branch.set(lane, state.branch);
        self.see_now(lane);
        self.bound_force(lane);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use rocking_wall::choices::{DampingModel, ForceLaw, Impact, Rocking};
    use rocking_wall::solver::Motion;
    use rocking_wall::wall::{Parameters, Support};

    use super::*;
    use crate::blocks::Blocks;
    use crate::forcing::Forcing;
    use crate::run::{NoObserver, RunEnd};
    use crate::solver::RecordSolver;

    /// A wall at rest passes over the samples within the band, up to the first beyond it.
    #[test]
    fn rest_lasts_as_long_as_the_band_holds() {
        let rigid = Parameters {
            force_law: ForceLaw::RigidLinear,
            damping_model: DampingModel::None,
            impact: Impact::Restitution,
            ..Parameters::default()
        };
        let motion = Motion::of(&rigid, 1e-8).expect("a valid wall");
        let (solver, [lowest, highest]) = (RecordSolver::new(&motion, 0.01), motion.rest_band());
        for (beyond, factor) in [(1.01 * highest, 1.0), (1.01 * lowest, 1.0), (1.01 * highest, -1.0)] {
            let samples: Vec<f64> = (0..100).map(|n| if n < 40 { 0.98 * beyond } else { beyond }).collect();
            let record = Blocks::new(Forcing::Samples(&samples));
            let start = RunStart { state: motion.start(0.0, 0.0, Support::default()), factor };
            let given = [BatchRun { solver: &solver, record: &record, start }];
            let mut lanes = Lanes::new(&given, RunEnd::OfRecord, NoObserver);
            assert!(lanes.start_next(0) && lanes.in_block(0));
            // the last step within the band ends at sample 39
            assert!(lanes.rest_on(0) && lanes.sample(0) == 39 && lanes.runs[0].steps == 39);
            assert!(!lanes.rest_on(0));
        }
    }

    /// A run that fails has its own error, in whatever order runs fail; the others have their outcomes.
    #[test]
    fn each_run_has_its_own_error() {
        let motion = Motion::of(&Parameters { u_start: 0.0, ..Parameters::default() }, 1e-8);
        let motion = motion.expect("a valid wall");
        let samples: Vec<f64> = (0..100).map(f64::from).collect();
        let (solver, record) = (RecordSolver::new(&motion, 0.01), Blocks::new(Forcing::Samples(&samples)));
        let state = motion.start(0.0, 0.0, Support::default());
        let given = [1e305, 1e-3, 2e305].map(|factor| {
            let start = RunStart { state, factor };
            BatchRun { solver: &solver, record: &record, start }
        });
        let mut lanes = Lanes::new(&given, RunEnd::OfRecord, NoObserver);
        assert!((0..3).all(|lane| lanes.start_next(lane)));
        assert!([2, 1, 0].iter().all(|&lane| !lanes.alone(lane)));
        let failed: Vec<_> = lanes.failures.iter().map(|(number, _)| *number).collect();
        assert_eq!(failed, [2, 0]);
        for (given, outcome) in given.iter().zip(lanes.outcomes()) {
            assert_eq!(outcome, solver.run(given.start, Forcing::Samples(&samples), RunEnd::OfRecord));
        }
    }

    /// A wall that nothing moves stays at u = 0. Only at transverse walls, where it leaves its rest for any
    /// p > 0, its steps are searched.
    #[test]
    fn a_wall_that_nothing_moves_stays() {
        for (rocking, impact, searched) in
            [(Rocking::TwoSided, Impact::None, 0), (Rocking::OneSidedPositive, Impact::Restitution, 99)]
        {
            let undamped = Parameters {
                rocking,
                impact,
                restitution: 0.5,
                damping_model: DampingModel::None,
                u_start: 0.0,
                ..Parameters::default()
            };
            let motion = Motion::of(&undamped, 1e-8).expect("a valid wall");
            let (solver, record) = (RecordSolver::new(&motion, 0.01), Blocks::new(Forcing::Still(100)));
            let start = RunStart { state: motion.start(0.0, 0.0, Support::default()), factor: 1.0 };
            let given = [BatchRun { solver: &solver, record: &record, start }];
            let mut lanes = Lanes::new(&given, RunEnd::OfRecord, NoObserver);
            assert!(lanes.start_next(0) && !lanes.rest_on(0) && !lanes.alone(0));
            assert_eq!((lanes.rows.u[0], lanes.rows.v[0], lanes.sample(0)), (0.0, 0.0, 99));
            assert_eq!(lanes.runs[0].steps, searched, "{rocking:?}");
        }
    }
}
