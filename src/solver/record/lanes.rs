//! Runs of one wall side by side, two steps at a time as long as they are plain.

use super::super::event::Peaks;
use super::super::oscillator::Oscillator;
use super::super::{Memo, Phase, SolverError, State, Work};
use super::{Affine, Forcing, Passage, RecordSolver, StepMap};

/// u and u̇ of each run.
pub(super) type States<const N: usize> = [[f64; N]; 2];

/// Runs side by side.
pub(super) struct Lanes<'a, const N: usize> {
    pub(super) solver: &'a RecordSolver<'a>,
    now: States<N>,
    /// Coefficients of one and of two steps on each lane's branch.
    single: Wide<N>,
    double: Wide<N>,
    /// f(0) of each lane's branch \[m/s²\].
    force_at_zero: [f64; N],
    /// Where one and two plain steps may start and end.
    single_range: Range<N>,
    double_range: Range<N>,
    /// Whether two plain steps may start from the present state.
    inside: [bool; N],
    all_inside: bool,
    pub(super) rest: [Lane; N],
    pub(super) running: usize,
    pub(super) until_overturning: bool,
}

/// [`Affine`] of each lane.
struct Wide<const N: usize> {
    terms: [[[f64; N]; 2]; 5],
}

/// Where a plain step, or two, may start and end.
struct Range<const N: usize> {
    /// Of u, so far from the corners.
    low: [f64; N],
    high: [f64; N],
    /// Of u where |u̇| is `slow` or less, so far from the extremes seen before.
    lowest: [f64; N],
    highest: [f64; N],
    slow: [f64; N],
    /// V, of |u̇|.
    fastest: [f64; N],
}

/// What a plain step does not touch.
#[derive(Clone, Copy)]
pub(super) struct Lane {
    pub(super) state: State,
    /// Largest |u| up to which f̂ is taken \[m\].
    reach: f64,
    /// P over the stretch of the record at hand \[m/s²\].
    largest_forcing: f64,
    pub(super) overturning: Option<f64>,
    /// Work of the steps that were searched, and their number.
    pub(super) work: Work,
    pub(super) searched: u64,
    pub(super) stilled: bool,
    /// The sample at which the run stopped.
    pub(super) stopped: Option<usize>,
    pub(super) memo: Memo,
}

/// c V over P + f̂: the largest speed V of a plain step. Walls stay far below, as they do below the terminal speed.
const BRAKING: f64 = 0.25;
/// The |u| up to which f̂ is taken, over the largest so far.
const ROOM: f64 = 4.0;
/// Samples for which P is taken together, an even number.
const STRETCH: usize = 256;

impl<const N: usize> Wide<N> {
    const STILL: Self = Self { terms: [[[0.0; N]; 2]; 5] };

    #[inline(always)]
    fn load(&mut self, i: usize, affine: &Affine) {
        for (term, [u, v]) in self.terms.iter_mut().zip(affine.terms) {
            (term[0][i], term[1][i]) = (u, v);
        }
    }

    /// u or u̇ of lane `i` after one step.
    #[inline(always)]
    fn one_step(&self, i: usize, part: usize, [u, v]: [f64; 2], q: [f64; 2]) -> f64 {
        let c = |term: usize| self.terms[term][part][i];
        // the products with the state last: they are what the next step waits for
        [u, v][part] + ((c(2) * q[0] + c(3) * q[1]) + (c(0) * u + c(1) * v))
    }

    /// u or u̇ of lane `i` after two steps.
    #[inline(always)]
    fn two_steps(&self, i: usize, part: usize, [u, v]: [f64; 2], q: [f64; 3]) -> f64 {
        let c = |term: usize| self.terms[term][part][i];
        [u, v][part] + (((c(2) * q[0] + c(3) * q[1]) + c(4) * q[2]) + (c(0) * u + c(1) * v))
    }
}

impl<const N: usize> Range<N> {
    const EMPTY: Self = Self {
        low: [0.0; N],
        high: [0.0; N],
        lowest: [0.0; N],
        highest: [0.0; N],
        slow: [0.0; N],
        fastest: [0.0; N],
    };

    #[allow(clippy::needless_bitwise_bool, reason = "no branches, so that lanes go side by side")]
    #[inline(always)]
    fn holds(&self, i: usize, [u, v]: [f64; 2]) -> bool {
        let speed = v.abs();
        let no_new_extreme = (speed > self.slow[i]) | ((u >= self.lowest[i]) & (u <= self.highest[i]));
        (u >= self.low[i]) & (u <= self.high[i]) & (speed <= self.fastest[i]) & no_new_extreme
    }

    /// For stretches of `length` on a branch between `corners`, in which |ü| stays below `most` and |u̇| starts and ends
    /// below `fastest`.
    #[inline(always)]
    fn set(&mut self, i: usize, length: f64, corners: [f64; 2], most: f64, fastest: f64) {
        let margin = 0.125 * length * length * most;
        (self.low[i], self.high[i]) = (corners[0] + margin, corners[1] - margin);
        (self.slow[i], self.fastest[i]) = (most * length, fastest);
    }

    /// With the extremes seen so far.
    #[inline]
    fn bound(&mut self, i: usize, length: f64, peaks: Peaks) {
        let margin = 0.125 * length * self.slow[i];
        (self.lowest[i], self.highest[i]) = (margin - peaks.negative, peaks.positive - margin);
    }

    /// Every state, or none.
    fn fill(&mut self, i: usize, all: bool) {
        let bound = if all { f64::INFINITY } else { f64::NEG_INFINITY };
        (self.low[i], self.high[i]) = (-bound, bound);
        (self.slow[i], self.fastest[i]) = (-1.0, f64::INFINITY);
    }
}

impl<'a, const N: usize> Lanes<'a, N> {
    pub(super) fn new(solver: &'a RecordSolver<'a>, states: [State; N], until_overturning: bool) -> Self {
        let lane = |index: usize| Lane {
            state: states[index],
            reach: f64::INFINITY,
            largest_forcing: f64::INFINITY,
            overturning: states[index].overturned.then_some(0.0),
            work: Work::default(),
            searched: 0,
            stilled: false,
            stopped: None,
            memo: Memo::default(),
        };
        let mut lanes = Self {
            solver,
            now: [[0.0; N]; 2],
            single: Wide::STILL,
            double: Wide::STILL,
            force_at_zero: [0.0; N],
            single_range: Range::EMPTY,
            double_range: Range::EMPTY,
            inside: [false; N],
            all_inside: false,
            rest: std::array::from_fn(lane),
            running: N,
            until_overturning,
        };
        for index in 0..N {
            lanes.load(index);
        }
        lanes.all_inside = all(&lanes.inside);
        lanes
    }

    /// Follows all lanes to the end of the record, or until none runs.
    #[inline(always)]
    pub(super) fn follow<F: Forcing<N>>(
        &mut self,
        forcing: &F,
        observe: &mut impl FnMut(usize, &[f64; N], &[f64; N]),
    ) -> Result<(), SolverError> {
        let last = forcing.count() - 1;
        let mut index = 0;
        let mut now = self.now;
        let mut p = forcing.at(0);
        while index + 1 < last && self.running > 0 {
            if index.is_multiple_of(STRETCH) {
                self.now = now;
                self.look_ahead(forcing.largest(index..(index + STRETCH).min(last) + 1));
            }
            let [next, after] = [forcing.at(index + 1), forcing.at(index + 2)];
            let (middle, end, plain) = self.pair(&now, [&p, &next, &after]);
            let mut states = [middle, end];
            if !(self.all_inside & plain) {
                self.now = now;
                self.with_care(index, &mut states, [&p, &next, &after])?;
            }
            observe(index + 1, &states[0][0], &states[0][1]);
            observe(index + 2, &states[1][0], &states[1][1]);
            (now, p) = (states[1], after);
            index += 2;
        }
        self.now = now;
        if index < last && self.running > 0 {
            self.look_ahead(forcing.largest(index..last + 1));
            let to = forcing.at(last);
            for i in 0..N {
                self.step(i, index, [p[i], to[i]])?;
            }
            observe(last, &self.now[0], &self.now[1]);
        }
        Ok(())
    }

    /// Takes up the largest forcing of the next stretch.
    fn look_ahead(&mut self, largest: [f64; N]) {
        for (i, largest) in largest.into_iter().enumerate() {
            self.rest[i].largest_forcing = largest;
            self.ready_anew(i);
        }
        self.all_inside = all(&self.inside);
    }

    /// Two plain steps of each lane: the states between and after them, and whether they are plain as far as the end tells.
    #[inline(always)]
    fn pair(&self, now: &States<N>, p: [&[f64; N]; 3]) -> (States<N>, States<N>, bool) {
        let (mut middle, mut end) = ([[0.0; N]; 2], [[0.0; N]; 2]);
        let mut plain = [false; N];
        for i in 0..N {
            let q = p.map(|p| p[i] - self.force_at_zero[i]);
            let state = [now[0][i], now[1][i]];
            for part in 0..2 {
                middle[part][i] = self.single.one_step(i, part, state, [q[0], q[1]]);
                end[part][i] = self.double.two_steps(i, part, state, q);
            }
            plain[i] = self.double_range.holds(i, [end[0][i], end[1][i]]);
        }
        (middle, end, all(&plain))
    }

    /// Two steps where some are not plain: those lanes go step by step.
    #[inline(always)]
    fn with_care(
        &mut self,
        index: usize,
        states: &mut [States<N>; 2],
        p: [&[f64; N]; 3],
    ) -> Result<(), SolverError> {
        for i in 0..N {
            if self.inside[i] && self.double_range.holds(i, states[1].map(|of| of[i])) {
                continue;
            }
            for (part, state) in states.iter_mut().enumerate() {
                self.step(i, index + part, [p[part][i], p[part + 1][i]])?;
                (state[0][i], state[1][i]) = (self.now[0][i], self.now[1][i]);
            }
            self.inside[i] = self.double_range.holds(i, self.state(i));
        }
        self.all_inside = all(&self.inside);
        Ok(())
    }

    /// One step of one lane, plain or not.
    #[inline(always)]
    fn step(&mut self, i: usize, index: usize, p: [f64; 2]) -> Result<(), SolverError> {
        let q = p.map(|p| p - self.force_at_zero[i]);
        let state = self.state(i);
        let end = [0, 1].map(|part| self.single.one_step(i, part, state, q));
        if self.single_range.holds(i, state) && self.single_range.holds(i, end) {
            self.set_state(i, end);
            return Ok(());
        }
        if self.rest[i].stopped.is_some() {
            return Ok(());
        }
        self.careful(i, index, p, end)
    }

    /// u and u̇ of a lane.
    #[inline]
    pub(super) fn state(&self, i: usize) -> [f64; 2] {
        self.now.map(|of| of[i])
    }

    #[inline]
    pub(super) fn set_state(&mut self, i: usize, [u, v]: [f64; 2]) {
        (self.now[0][i], self.now[1][i]) = (u, v);
    }

    /// The map of steps on the branch a lane is on.
    pub(super) fn map(&self, i: usize) -> Option<&'a StepMap> {
        let State { phase, branch, .. } = self.rest[i].state;
        let solver = self.solver;
        if phase == Phase::Moving { solver.maps[branch].as_ref() } else { None }
    }

    /// Takes up the state and the branch of a lane.
    #[inline(always)]
    pub(super) fn load(&mut self, i: usize) {
        let Lane { state, stopped, .. } = self.rest[i];
        self.set_state(i, [state.displacement, state.velocity]);
        let still = stopped.is_some() || state.phase == Phase::Landed;
        if let (false, Some(map)) = (still, self.map(i)) {
            self.single.load(i, &map.single);
            self.double.load(i, &map.double);
            self.force_at_zero[i] = map.force_at_zero;
        } else {
            self.single.load(i, &Affine::STILL);
            self.double.load(i, &Affine::STILL);
            // nothing will ever happen, or anything may
            self.single_range.fill(i, still);
            self.double_range.fill(i, still);
        }
        self.ready(i);
    }

    /// Goes on from the end of a step on the same branch.
    #[inline(always)]
    pub(super) fn arrive(&mut self, i: usize, end: [f64; 2]) {
        let lane = &mut self.rest[i];
        lane.state.peaks.include(end[0]);
        let near_the_edge = 2.0 * end[0].abs() > lane.reach;
        self.set_state(i, end);
        if near_the_edge {
            self.ready_anew(i);
        } else {
            self.bound(i);
        }
    }

    /// The range of plain steps with the branch, the forcing and the extremes at hand.
    #[inline(always)]
    fn ready(&mut self, i: usize) {
        if let (None, Some(map)) = (self.rest[i].stopped, self.map(i)) {
            self.measure(i, map);
        }
        self.bound(i);
    }

    /// [`Self::ready`], out of the way of steps that seldom need it.
    #[inline(never)]
    fn ready_anew(&mut self, i: usize) {
        self.ready(i);
    }

    /// The range of plain steps on the present branch.
    #[inline(always)]
    fn measure(&mut self, i: usize, map: &StepMap) {
        let Oscillator { damping, stiffness, .. } = map.oscillator;
        let step = self.solver.step;
        let lane = &mut self.rest[i];
        let forcing = lane.largest_forcing;
        lane.reach = ROOM * (lane.state.peaks.largest() + forcing * step * step);
        let ends = [map.corners[0].max(-lane.reach), map.corners[1].min(lane.reach)];
        let force = ends.map(|u| (map.force_at_zero + stiffness * u).abs());
        let driving = forcing + force[0].max(force[1]);
        let fastest = BRAKING * driving * map.inverse_damping;
        let braking = if damping > 0.0 { BRAKING * driving } else { 0.0 };
        let ranges = [&mut self.single_range, &mut self.double_range];
        for ((range, growth), steps) in ranges.into_iter().zip(map.growth).zip([1.0, 2.0]) {
            range.set(i, steps * step, ends, growth * (driving + braking), fastest);
        }
    }

    /// Whether u̇ keeps its sign over a step, by what |ü| can be at most: so it does between two velocities of one sign that
    /// are larger together than A h.
    #[inline(always)]
    pub(super) fn is_steady(&self, i: usize, v0: f64, [u1, v1]: [f64; 2]) -> bool {
        let Range { slow, fastest, .. } = &self.single_range;
        u1.abs() <= self.rest[i].reach
            && v0 * v1 > 0.0
            && v0.abs() + v1.abs() > slow[i]
            && v0.abs().max(v1.abs()) <= fastest[i]
    }

    /// The range of plain steps with the present extremes.
    #[inline(always)]
    pub(super) fn bound(&mut self, i: usize) {
        let (peaks, step) = (self.rest[i].state.peaks, self.solver.step);
        self.single_range.bound(i, step, peaks);
        self.double_range.bound(i, 2.0 * step, peaks);
        self.inside[i] = self.double_range.holds(i, self.state(i));
    }

    pub(super) fn passages(&self, steps: u64) -> [Passage; N] {
        std::array::from_fn(|i| {
            let Lane { mut state, overturning, mut work, searched, stilled, stopped, .. } = self.rest[i];
            if stopped.is_none() {
                [state.displacement, state.velocity] = self.state(i);
                state.peaks.include(state.displacement);
            }
            // a plain step is one piece of motion
            work.pieces += stopped.map_or(steps, |index| index as u64) - searched;
            Passage { state, overturning, work, stilled }
        })
    }
}

/// Whether all hold, without a branch for each.
#[inline(always)]
fn all<const N: usize>(each: &[bool; N]) -> bool {
    each.iter().fold(true, |all, &one| all & one)
}
