//! State of the runs that share a vector: position in the record, bounds of the block, extremes.

use rocking_wall::solver::{Memo, Peaks, Phase, SolverError, State, Work};

use crate::affine::MOST_AT_ONCE;
use crate::blocks::Blocks;
use crate::forcing::BLOCK;
use crate::number::{LaneRow, WIDTH, index};
use crate::numbering::LaneBranches;
use crate::run::{BatchRun, Observer, Outcome, RunEnd};
use crate::solver::RecordSolver;
use crate::table::Stepping;

/// The |u| up to which f̂ bounds the forces, over the largest |u| so far.
const ROOM: f64 = 4.0;
/// Share of the energy at its peaks up to which the rest of a record may bring a run that ends before it.
/// What is left is far more than the errors of steps.
const SAFE: f64 = 0.999;

/// A block that a run has entered, and the extremes at the ends of its steps.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    /// The run's number, and its factor.
    pub(crate) number: usize,
    pub(crate) factor: f64,
    pub(crate) state: State,
    /// The sample, and the share of the step from there that is taken already.
    pub(crate) first: usize,
    pub(crate) step_taken: f64,
    pub(crate) end: usize,
    pub(crate) highest: f64,
    pub(crate) lowest: f64,
    pub(crate) fastest: f64,
    /// P \[m/s²\].
    pub(crate) forcing: f64,
}

impl Block {
    /// Returns the block that stands for a run before its first one.
    pub(crate) fn new(number: usize, factor: f64, state: State) -> Self {
        let (first, step_taken, end) = (0, 0.0, 0);
        let (highest, lowest, fastest, forcing) = (0.0, 0.0, 0.0, 0.0);
        Self { number, factor, state, first, step_taken, end, highest, lowest, fastest, forcing }
    }
}

/// The data of a run, except its motion, which is in [`Rows`].
pub(crate) struct Run {
    pub(crate) block: Block,
    /// The sample at which this pass through the record ends.
    pub(crate) last: usize,
    /// Its state, except u, u̇ and the branch, which are in [`Rows`].
    pub(crate) state: State,
    /// Whether a tie has changed, so that the prepared steps are those of another wall.
    pub(crate) is_stretched: bool,
    /// Bound f̂ on the force per mass while |u| stays within the reach of the block \[m/s²\].
    pub(crate) force: f64,
    pub(crate) overturning: Option<f64>,
    /// Work of the general search, and the steps left to it.
    pub(crate) searched: Work,
    pub(crate) steps: u64,
    pub(crate) put_to_rest: bool,
    pub(crate) memo: Memo,
}

/// The motion of each lane, and its bounds.
#[derive(Default)]
#[repr(align(64))]
pub(crate) struct Rows {
    /// The sample, the share of the step from there that is taken already, and the first sample at which no
    /// plain steps begin.
    pub(crate) index: LaneRow,
    pub(crate) step_taken: LaneRow,
    pub(crate) limit: LaneRow,
    /// The factor of the forcing.
    pub(crate) factor: LaneRow,
    /// The factors on u̇ at an impact, towards u < 0 and towards u > 0, and the |u̇| after it below which the
    /// wall may come to rest \[m/s\].
    pub(crate) passage_factors: [LaneRow; 2],
    pub(crate) rest_speed: LaneRow,
    pub(crate) u: LaneRow,
    pub(crate) v: LaneRow,
    pub(crate) branch: LaneBranches,
    /// Extremes of u at the ends of the block's steps \[m\], and the largest |u̇| on curved branches \[m/s\].
    pub(crate) highest: LaneRow,
    pub(crate) lowest: LaneRow,
    pub(crate) fastest: LaneRow,
    /// P and D = P + f̂ \[m/s²\].
    pub(crate) forcing: LaneRow,
    pub(crate) driving: LaneRow,
    /// The |u| beyond which f̂ is taken anew, and the limits that u must not leave: where f̂ bounds the
    /// forces, or the peaks \[m\].
    pub(crate) half_reach: LaneRow,
    pub(crate) limits: [LaneRow; 2],
    /// Corners passed here, and of these the passages of u = 0.
    pub(crate) corners: LaneRow,
    pub(crate) impacts: LaneRow,
    /// The change of u in the next part on a curved branch, as a share of u.
    pub(crate) next_change: LaneRow,
}

/// What a pass over the runs computes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pass {
    /// The motion, up to an end.
    Motion(RunEnd),
    /// The extremes between samples, in blocks where they may exceed those known.
    Extremes,
}

/// Lanes that wait, one bit for each.
#[derive(Clone, Copy)]
pub(crate) struct Waiting {
    /// Lanes at the end of a block.
    pub(crate) ended: u8,
    /// Lanes that cannot go on by the steps of all: `resolve` takes them further.
    pub(crate) to_resolve: u8,
}

/// Runs in lanes.
pub(crate) struct Lanes<'a, O> {
    /// The wall and the record of each lane. Those side by side are of one kind.
    pub(crate) solvers: [&'a RecordSolver<'a>; WIDTH],
    pub(crate) records: [&'a Blocks<'a>; WIDTH],
    pub(crate) rows: Rows,
    pub(crate) observer: O,
    pub(crate) pass: Pass,
    /// The steps that lanes take side by side.
    pub(crate) together: Option<Stepping>,
    /// The run of each lane that has had one.
    pub(crate) runs: Vec<Run>,
    pub(crate) given: &'a [BatchRun<'a>],
    /// The next of them to take up.
    pub(crate) next: usize,
    /// Blocks in which u may have gone beyond the extremes known.
    pub(crate) candidates: Vec<Block>,
    pub(crate) outcomes: Vec<Outcome>,
    /// The extremes found between samples.
    pub(crate) extremes: Vec<Peaks>,
    /// Runs that could not be followed, in the order in which they failed.
    pub(crate) failures: Vec<(usize, SolverError)>,
}

/// Lists lanes by their bits.
pub(crate) fn each(bits: u8) -> impl Iterator<Item = usize> {
    (0..WIDTH).filter(move |i| bits >> i & 1 == 1)
}

impl<'a, O: Observer> Lanes<'a, O> {
    /// Takes up runs, of which there is at least one.
    pub(crate) fn new(given: &'a [BatchRun<'a>], end: RunEnd, observer: O) -> Self {
        let BatchRun { solver, record, .. } = given[0];
        let outcome = |BatchRun { start, .. }: &BatchRun<'_>| Outcome {
            state: start.state,
            overturning: start.state.overturned.then_some(0.0),
            work: Work::default(),
            put_to_rest: false,
        };
        Self {
            solvers: [solver; WIDTH],
            records: [record; WIDTH],
            rows: Rows::default(),
            observer,
            pass: Pass::Motion(end),
            together: None,
            runs: Vec::new(),
            given,
            next: 0,
            candidates: Vec::new(),
            outcomes: given.iter().map(outcome).collect(),
            extremes: given.iter().map(|_| Peaks::at(0.0)).collect(),
            failures: Vec::new(),
        }
    }
}

impl<O: Observer> Lanes<'_, O> {
    /// Returns the sample a lane is at.
    #[inline(always)]
    pub(crate) fn sample(&self, lane: usize) -> usize {
        index(self.rows.index[lane])
    }

    /// Returns the state of the run in a lane.
    pub(crate) fn state(&self, lane: usize) -> State {
        let rows = &self.rows;
        let (displacement, velocity, branch) = (rows.u[lane], rows.v[lane], rows.branch.of(lane));
        State { displacement, velocity, branch, ..self.runs[lane].state }
    }

    /// Enters the block that the run of a lane is in.
    pub(crate) fn enter_block(&mut self, lane: usize) {
        let (first, state) = (self.sample(lane), self.state(lane));
        let (rows, run) = (&mut self.rows, &mut self.runs[lane]);
        let end = match self.pass {
            Pass::Motion(_) => ((first / BLOCK + 1) * BLOCK).min(run.last),
            Pass::Extremes => run.last,
        };
        let forcing = self.records[lane].largest(first) * rows.factor[lane].abs();
        run.block = Block { state, first, step_taken: rows.step_taken[lane], end, forcing, ..run.block };
        // the last plain steps may go beyond the block, but not beyond the record
        rows.limit[lane] = end.min((run.last + 1).saturating_sub(MOST_AT_ONCE)) as f64;
        rows.forcing[lane] = forcing;
        (rows.highest[lane], rows.lowest[lane]) = (f64::NEG_INFINITY, f64::INFINITY);
        (rows.fastest[lane], rows.next_change[lane]) = (0.0, f64::INFINITY);
        self.bound_force(lane);
    }

    /// Estimates the largest |u| in the next steps \[m\].
    fn largest(&self, lane: usize) -> f64 {
        let step = self.solvers[lane].step;
        self.runs[lane].state.peaks.largest() + self.rows.forcing[lane] * step * step
    }

    /// Computes anew the bound f̂ on the forces, and the limits that u must not leave.
    pub(crate) fn bound_force(&mut self, lane: usize) {
        self.include_ends(lane);
        let seeks = self.pass == Pass::Extremes;
        let reach = if seeks { self.runs[lane].state.peaks.largest() } else { ROOM * self.largest(lane) };
        let (rows, run) = (&mut self.rows, &mut self.runs[lane]);
        run.force = self.solvers[lane].table.largest_force(reach);
        rows.driving[lane] = rows.forcing[lane] + run.force;
        let Peaks { positive, negative } = run.state.peaks;
        let (limits, half_reach) =
            if seeks { ([-negative, positive], f64::INFINITY) } else { ([-reach, reach], 0.5 * reach) };
        [rows.limits[0][lane], rows.limits[1][lane]] = limits;
        rows.half_reach[lane] = half_reach;
    }

    /// Includes the ends of the steps so far in the peaks.
    pub(crate) fn include_ends(&mut self, lane: usize) {
        let (rows, peaks) = (&self.rows, &mut self.runs[lane].state.peaks);
        for u in [rows.highest[lane], rows.lowest[lane], rows.u[lane]] {
            if u.is_finite() {
                peaks.include(u);
            }
        }
    }

    /// Closes a block, and keeps it for a search if an extreme may lie between its samples.
    fn close_block(&mut self, lane: usize) {
        self.include_ends(lane);
        let (rows, run) = (&self.rows, &self.runs[lane]);
        let (highest, lowest, fastest) = (rows.highest[lane], rows.lowest[lane], rows.fastest[lane]);
        let block = Block { highest, lowest, fastest, end: self.sample(lane), ..run.block };
        // f̂ bounds the forces at least as far as u has gone
        if self.pass != Pass::Extremes && self.may_exceed(&block, &run.state.peaks, run.force) {
            self.candidates.push(block);
        }
    }

    /// Returns whether u may have gone beyond the peaks in a block, |f| being up to `force`
    /// (docs/record-path.md, §5).
    pub(crate) fn may_exceed(&self, block: &Block, peaks: &Peaks, force: f64) -> bool {
        let RecordSolver { table, step, .. } = self.given[block.number].solver;
        let driving = block.forcing + force;
        // A L²/8 of plain steps, and of parts on curved branches
        let plain = table.most_growth * (1.0 + table.most_damping) * driving;
        let curved = table.curved_growth * (driving + table.curved_damping * block.fastest);
        let margin = 0.125 * step * step * plain.max(curved);
        block.highest + margin > peaks.positive || margin - block.lowest > peaks.negative
    }

    /// Enters the next block where the run of a lane is at the end of one; returns whether the run goes on.
    pub(crate) fn in_block(&mut self, lane: usize) -> bool {
        if self.runs[lane].state.phase == Phase::Landed {
            // a wall that has landed never moves again
            let (first, last) = (self.sample(lane), self.runs[lane].last);
            let lies = [self.rows.u[lane], self.rows.v[lane]];
            (first..last).for_each(|sample| self.see(sample + 1, lies));
            self.rows.index[lane] = last as f64;
        }
        if !self.is_at_end(lane) {
            return true;
        }
        self.close_block(lane);
        if self.pass == Pass::Motion(RunEnd::AtPeaks) && self.peaks_are_final(lane) {
            self.runs[lane].last = self.sample(lane);
        }
        if self.sample(lane) < self.runs[lane].last {
            self.enter_block(lane);
            return true;
        }
        self.finish(lane);
        false
    }

    /// Returns whether the rest of the record cannot raise the peaks of the run in a lane: |p| adds to √(2E)
    /// at most its integral (docs/record-path.md, §5). Runs of walls with a tie, and those with steps that
    /// are not prepared, go on.
    fn peaks_are_final(&self, lane: usize) -> bool {
        let (solver, run) = (self.solvers[lane], &self.runs[lane]);
        let wall = solver.motion.wall();
        let is_prepared = !solver.table.steppings.contains(&Stepping::General);
        if !is_prepared || !wall.ties().is_empty() {
            return false;
        }
        let push = self.records[lane].rest(self.sample(lane)) * self.rows.factor[lane].abs() * solver.step;
        let speed = (2.0 * wall.energy(self.rows.u[lane], self.rows.v[lane])).sqrt() + push;
        // a wall that rocks to one side only has no peak on the other
        let mut sides =
            [1.0, -1.0].into_iter().filter(|sign| wall.free_side().is_none_or(|free| free == *sign));
        sides.all(|sign| {
            let peak = run.state.peaks.of(sign);
            peak < wall.force_end().of(sign) && 0.5 * speed * speed <= SAFE * wall.energy(sign * peak, 0.0)
        })
    }

    /// Shows the observer u and u̇ at a sample.
    #[inline(always)]
    pub(crate) fn see(&mut self, sample: usize, [u, v]: [f64; 2]) {
        if self.pass != Pass::Extremes {
            self.observer.see(sample, u, v);
        }
    }

    /// Shows the observer u and u̇ at the sample that a lane is at.
    #[inline(always)]
    pub(crate) fn see_now(&mut self, lane: usize) {
        self.see(self.sample(lane), [self.rows.u[lane], self.rows.v[lane]]);
    }

    /// Returns whether the run of a lane is at the end of its block.
    #[inline(always)]
    pub(crate) fn is_at_end(&self, lane: usize) -> bool {
        self.sample(lane) >= self.runs[lane].block.end
    }

    /// Stores the outcome of the run in a lane.
    fn finish(&mut self, lane: usize) {
        let (state, rows, run) = (self.state(lane), &self.rows, &self.runs[lane]);
        let number = run.block.number;
        if self.pass == Pass::Extremes {
            self.extremes[number].include(state.peaks.positive);
            self.extremes[number].include(-state.peaks.negative);
            return;
        }
        let (corners, impacts) = (index(rows.corners[lane]) as u64, index(rows.impacts[lane]) as u64);
        // a step is one piece of motion, and each corner passed in it one more
        let pieces = run.last as u64 - run.steps + corners;
        let mut work = Work { pieces, corners, impacts };
        work.add(run.searched);
        self.outcomes[number] =
            Outcome { state, overturning: run.overturning, work, put_to_rest: run.put_to_rest };
    }
}

#[cfg(test)]
mod tests;
