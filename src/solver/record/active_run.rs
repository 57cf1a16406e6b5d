//! A run under way through a record: where it is, what bounds its motion, and what it has come to.

mod careful;
mod follow;

use super::super::secant::SecantBranch;
use super::super::{Memo, Phase, State, Work};
use super::block::{Block, Nodes};
use super::bounds::{Bounds, Range};
use super::forcing::{BLOCK, Blocks};
use super::solver::{Outcome, RecordSolver, RunStart};
use super::step_map::{DAMPING_SHARE, StepMap};

/// A run under way.
pub(super) struct ActiveRun<'a> {
    solver: &'a RecordSolver<'a>,
    record: &'a Blocks<'a>,
    until_overturning: bool,
    plain: PlainSteps,
    /// The factor of the forcing.
    factor: f64,
    cursor: Cursor,
    /// u and u̇.
    now: [f64; 2],
    /// u and u̇ of this one are not kept up to date.
    state: State,
    /// The map of steps on the present branch.
    map: Option<&'a StepMap>,
    bounds: Bounds,
    block: Block,
    tally: Tally,
    search: ExtremeSearch,
    memo: Memo,
}

/// Plain steps taken at once.
#[derive(Clone, Copy)]
pub(super) struct PlainSteps {
    /// Their number.
    pub(super) at_once: usize,
    /// The least γ over them to reckon with: that of steps a batch takes for the run.
    pub(super) growth: f64,
    /// Whether lanes take parts of steps on branches with secant damping.
    pub(super) parts: bool,
}

impl PlainSteps {
    /// Of a run by itself.
    pub(super) const PAIRS: Self = Self { at_once: 2, growth: 0.0, parts: false };
}

/// The place of a run in its record.
#[derive(Clone, Copy, Default)]
struct Cursor {
    /// The sample, and the forcing there \[m/s²\].
    index: usize,
    forcing: f64,
    /// The share of the step from that sample that the run has taken already.
    share: f64,
    /// The first sample at which no plain steps begin.
    limit: usize,
    /// The samples at which this block and this pass through the record end.
    block_end: usize,
    last: usize,
}

/// What a run has come to, beside its state.
#[derive(Clone, Copy, Default)]
struct Tally {
    overturning: Option<f64>,
    /// Work of the steps that are not plain, and their number.
    work: Work,
    steps: u64,
    put_to_rest: bool,
}

/// The search for extremes between samples, after the run.
#[derive(Default)]
struct ExtremeSearch {
    /// Blocks in which u may have gone beyond the extremes known, with the samples at which they end.
    candidates: Vec<(Block, usize)>,
    /// What became of the run, once it is over but for its extremes.
    outcome: Option<Outcome>,
}

/// What the lanes of a batch hold of a run.
pub(super) struct LaneValues {
    pub(super) index: usize,
    /// The first sample at which no plain steps begin.
    pub(super) limit: usize,
    pub(super) now: [f64; 2],
    pub(super) branch: usize,
    pub(super) nodes: Nodes,
    /// P and D = P + f̂ \[m/s²\].
    pub(super) forcing: f64,
    pub(super) driving: f64,
    /// The |u| beyond which f̂ is taken anew \[m\].
    pub(super) half_reach: f64,
    /// Where u is known to stay \[m\].
    pub(super) limits: [f64; 2],
}

/// What the lanes of a batch hold of a run on a branch with secant damping.
pub(super) struct CurvedValues {
    pub(super) index: usize,
    pub(super) limit: usize,
    pub(super) share: f64,
    pub(super) now: [f64; 2],
    pub(super) nodes: Nodes,
    pub(super) secant: SecantBranch,
    /// D = P + f̂ \[m/s²\], the largest c of the branch \[1/s\], and γ.
    pub(super) driving: f64,
    pub(super) damping: f64,
    pub(super) growth: f64,
    /// Where u may be \[m\].
    pub(super) limits: [f64; 2],
}

impl<'a> ActiveRun<'a> {
    /// Starts a run.
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        record: &'a Blocks<'a>,
        until_overturning: bool,
        plain: PlainSteps,
        RunStart { state, factor }: RunStart,
    ) -> Self {
        let overturning = state.overturned.then_some(0.0);
        let mut run = Self {
            solver,
            record,
            until_overturning,
            plain,
            factor,
            cursor: Cursor { last: record.forcing.count() - 1, ..Cursor::default() },
            now: [0.0; 2],
            state,
            map: None,
            bounds: Bounds::default(),
            block: Block::enter(state, 0, 0.0, 0.0),
            tally: Tally { overturning, ..Tally::default() },
            search: ExtremeSearch::default(),
            memo: Memo::default(),
        };
        run.enter_at(state, 0);
        run
    }

    /// Tells whether the run is over but for its extremes.
    #[inline(always)]
    fn seeks_extremes(&self) -> bool {
        self.search.outcome.is_some()
    }

    /// Returns the state with u and u̇ as they are now.
    fn full_state(&self) -> State {
        let [displacement, velocity] = self.now;
        State { displacement, velocity, ..self.state }
    }

    /// Takes u, u̇ and the map of the branch from the state.
    #[inline(always)]
    fn load_state(&mut self) {
        let State { displacement, velocity, phase, branch, .. } = self.state;
        self.now = [displacement, velocity];
        let solver = self.solver;
        self.map = if phase == Phase::Moving { solver.maps[branch].as_ref() } else { None };
        self.bound_motion();
    }

    /// Takes the bounds on the motion on the present branch.
    #[inline(always)]
    fn bound_motion(&mut self) {
        if let Some(map) = self.map {
            self.bounds.take_branch(map, self.solver.step);
            self.block.raise(DAMPING_SHARE * self.bounds.driving(), map.growth[1]);
        }
    }

    /// Takes the bound f̂ on the forces anew, and what follows from it.
    pub(super) fn bound_force(&mut self) {
        self.include_nodes();
        self.bounds.take_force(self.solver, &self.state.peaks, self.seeks_extremes());
        self.bound_motion();
    }

    /// Takes f̂ anew where u has grown.
    #[inline(always)]
    fn bound_grown_force(&mut self) {
        if 2.0 * self.now[0].abs() > self.bounds.reach() && !self.seeks_extremes() {
            self.bound_force();
        }
    }

    /// Takes the present u and the ends of plain steps so far into the peaks.
    #[inline(always)]
    fn include_nodes(&mut self) {
        self.state.peaks.include(self.now[0]);
        self.block.nodes.add_to(&mut self.state.peaks);
    }

    /// Returns where u is known to stay: within the reach of f̂, and in the search for extremes within those
    /// known.
    #[inline(always)]
    fn limits(&self) -> [f64; 2] {
        let reach = self.bounds.reach();
        if self.seeks_extremes() {
            let peaks = self.state.peaks;
            [(-reach).max(-peaks.negative), reach.min(peaks.positive)]
        } else {
            [-reach, reach]
        }
    }

    #[inline(always)]
    fn range(&self, map: &StepMap, steps: usize) -> Range {
        self.bounds.range(map, self.limits(), steps)
    }

    /// Returns what lanes need to go on with the run; `None` where it cannot go side by side.
    pub(super) fn lane_values(&self) -> Option<LaneValues> {
        self.map.filter(|_| self.cursor.index < self.cursor.limit)?;
        let Cursor { index, limit, .. } = self.cursor;
        Some(LaneValues {
            index,
            limit,
            now: self.now,
            branch: self.state.branch,
            nodes: self.block.nodes,
            forcing: self.bounds.forcing(),
            driving: self.bounds.driving(),
            // in the search for extremes nothing grows
            half_reach: if self.seeks_extremes() { f64::INFINITY } else { 0.5 * self.bounds.reach() },
            limits: self.limits(),
        })
    }

    /// Returns what lanes need to go on along a branch with secant damping; `None` where the run is not on
    /// one.
    pub(super) fn curved_values(&self) -> Option<CurvedValues> {
        let map = self.map.filter(|_| self.cursor.index < self.cursor.limit)?;
        let (Cursor { index, limit, share, .. }, limits) = (self.cursor, self.limits());
        Some(CurvedValues {
            index,
            limit,
            share,
            now: self.now,
            nodes: self.block.nodes,
            secant: *map.secant()?,
            driving: self.bounds.driving(),
            damping: map.damping,
            growth: map.growth[0],
            limits: [map.corners[0].max(limits[0]), map.corners[1].min(limits[1])],
        })
    }

    /// Goes on from where lanes have taken the run along a branch with secant damping, at u̇ up to `fastest`.
    pub(super) fn resume_curved(
        &mut self,
        (index, share): (usize, f64),
        now: [f64; 2],
        nodes: Nodes,
        fastest: f64,
    ) {
        self.cursor.forcing = self.factor * self.record.forcing.at(index);
        (self.cursor.index, self.cursor.share) = (index, share);
        (self.now, self.block.nodes) = (now, nodes);
        if let Some(map) = self.map {
            self.block.raise(map.damping * fastest, map.growth[0]);
        }
    }

    /// Goes on from where lanes have taken the run, and the work of the steps that passed corners.
    pub(super) fn resume(&mut self, index: usize, now: [f64; 2], branch: usize, nodes: Nodes, work: Work) {
        self.tally.work.add(work);
        self.tally.steps += work.pieces - work.corners;
        self.cursor.index = index;
        self.cursor.forcing = self.factor * self.record.forcing.at(index);
        self.block.nodes = nodes;
        [self.state.displacement, self.state.velocity] = now;
        self.state.branch = branch;
        self.load_state();
    }

    /// Goes on from a state at a sample.
    fn enter_at(&mut self, state: State, index: usize) {
        self.state = state;
        self.cursor.index = index;
        self.cursor.forcing = self.factor * self.record.forcing.at(index);
        self.load_state();
        self.enter_block();
    }

    /// Enters the block the run is in.
    fn enter_block(&mut self) {
        let state = self.full_state();
        self.state = state;
        let Cursor { index, last, .. } = self.cursor;
        let end = if self.seeks_extremes() { last } else { ((index / BLOCK + 1) * BLOCK).min(last) };
        self.cursor.block_end = end;
        // the last plain steps may go beyond the block, but not beyond the pass
        self.cursor.limit = end.min((last + 1).saturating_sub(self.plain.at_once));
        let forcing = self.record.largest(index) * self.factor.abs();
        self.block = Block::enter(state, index, forcing, self.plain.growth);
        let serves = self.bounds.enter_block(forcing, &state.peaks, self.solver.step);
        if serves && !self.seeks_extremes() {
            self.bound_motion();
        } else {
            self.bound_force();
        }
    }

    /// Keeps a block in which an extreme may lie between samples.
    fn close_block(&mut self) {
        let block = self.block;
        if block.nodes.are_none() {
            return;
        }
        self.include_nodes();
        self.block.nodes = Nodes::NONE;
        // f̂ was taken at least as far as u has gone
        if self.may_exceed(&block, self.bounds.force()) {
            self.search.candidates.push((block, self.cursor.index));
        }
    }

    /// Tells whether u may have gone beyond the extremes known in a block, |f| being up to `force`.
    fn may_exceed(&self, block: &Block, force: f64) -> bool {
        let length = self.plain.at_once as f64 * self.solver.step;
        block.may_exceed(&self.state.peaks, force, length)
    }

    /// Enters the next block at the end of one; returns what became of the run once it is over. `observe` is
    /// shown the samples through which a wall lies.
    pub(super) fn next_block(&mut self, observe: &mut impl FnMut(usize, f64, f64)) -> Option<Outcome> {
        if self.state.phase == Phase::Landed {
            // nothing will ever happen
            if !self.seeks_extremes() {
                self.close_block();
                let [u, v] = self.now;
                (self.cursor.index + 1..=self.cursor.last).for_each(|index| observe(index, u, v));
            }
            (self.cursor.index, self.cursor.block_end) = (self.cursor.last, self.cursor.last);
        }
        while self.cursor.index >= self.cursor.block_end {
            if !self.seeks_extremes() {
                self.close_block();
                if self.cursor.index < self.cursor.last {
                    self.enter_block();
                    continue;
                }
                self.finish_run();
            }
            if !self.enter_candidate() {
                let outcome = self.search.outcome?;
                let state = State { peaks: self.state.peaks, ..outcome.state };
                return Some(Outcome { state, ..outcome });
            }
        }
        None
    }

    /// Notes what became of the run, its extremes being left to find.
    fn finish_run(&mut self) {
        let mut state = self.full_state();
        state.peaks.include(state.displacement);
        self.state = state;
        let Tally { overturning, mut work, steps, put_to_rest } = self.tally;
        // a plain step is one piece of motion
        work.pieces += self.cursor.last as u64 - steps;
        self.search.outcome = Some(Outcome { state, overturning, work, put_to_rest });
    }

    /// Enters a block in which an extreme may lie between samples, by the peaks known now; tells whether
    /// there is one. The motion is the same again, but for rounding: only extremes are taken from it.
    fn enter_candidate(&mut self) -> bool {
        while let Some((block, end)) = self.search.candidates.pop() {
            let force = self.solver.largest_force(self.state.peaks.largest());
            if self.may_exceed(&block, force) {
                self.cursor.last = end;
                self.enter_at(State { peaks: self.state.peaks, ..block.start }, block.first);
                return true;
            }
        }
        false
    }

    /// Notes that the wall has overturned in this step, `offset` \[s\] after its start; stops after it where
    /// asked to.
    fn overturn(&mut self, offset: f64) {
        self.tally.overturning =
            Some((self.cursor.index as f64 + self.cursor.share) * self.solver.step + offset);
        if self.until_overturning && !self.seeks_extremes() {
            // the extremes of the step itself are known
            self.close_block();
            let end = self.cursor.index + 1;
            (self.cursor.last, self.cursor.block_end) = (end, end);
        }
    }
}
