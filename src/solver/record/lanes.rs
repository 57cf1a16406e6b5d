//! Runs of one wall side by side, each at its own place in the record, two steps at a time as long as they are plain.

use super::super::{Phase, SolverError, State};
use super::stretches::Lane;
use super::{Affine, Forcing, Passage, RecordSolver, Start, StepMap};

/// Runs side by side. A lane that cannot go on by plain steps *waits* where it is until enough of them do.
pub(super) struct Lanes<'a, F, const N: usize> {
    pub(super) solver: &'a RecordSolver<'a>,
    pub(super) forcing: &'a F,
    pub(super) starts: &'a [Start],
    pub(super) until_overturning: bool,
    /// Largest |p| over each stretch of the record, before a run's factor \[m/s²\].
    pub(super) largest: &'a [f64],
    pub(super) pairs: Pairs<N>,
    /// The first sample at which each lane begins no pair of steps.
    pub(super) limit: [usize; N],
    /// The factor of the forcing.
    pub(super) factor: [f64; N],
    /// Coefficients of one and of two steps on each lane's branch.
    single: Wide<N>,
    double: Wide<N>,
    /// f(0) of each lane's branch \[m/s²\].
    force_at_zero: [f64; N],
    /// Where pairs of steps may start and end, u and |u̇|.
    low: [f64; N],
    high: [f64; N],
    fastest: [f64; N],
    /// Whether a lane cannot begin a pair of steps, or tried one that is not plain, or is idle.
    pub(super) waits: [bool; N],
    pub(super) rest: [Lane; N],
    /// The next run to begin, and the number of those under way.
    pub(super) next: usize,
    pub(super) running: usize,
    pub(super) passages: Vec<Option<Passage>>,
    /// Steps of the runs that have ended, and those among them that were searched.
    pub(super) steps: u64,
    pub(super) searched: u64,
    /// The first of the runs that could not be followed.
    pub(super) failure: Option<(usize, SolverError)>,
}

/// What pairs of plain steps change.
#[derive(Clone, Copy)]
pub(super) struct Pairs<const N: usize> {
    /// u and u̇.
    pub(super) now: [[f64; N]; 2],
    /// The sample each lane is at, and the forcing there \[m/s²\].
    pub(super) index: [usize; N],
    pub(super) forcing_now: [f64; N],
    /// The extremes of u at the ends of the plain steps of this stretch \[m\].
    pub(super) highest: [f64; N],
    pub(super) lowest: [f64; N],
}

/// [`Affine`] of each lane.
struct Wide<const N: usize> {
    terms: [[[f64; N]; 2]; 5],
}

/// c V over P + f̂: the largest speed V of a plain step. Walls stay far below, as they do below the terminal speed.
pub(super) const BRAKING: f64 = 0.25;
/// The |u| up to which f̂ is taken, over the largest so far.
const ROOM: f64 = 4.0;

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

impl<'a, F: Forcing, const N: usize> Lanes<'a, F, N> {
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        starts: &'a [Start],
        forcing: &'a F,
        largest: &'a [f64],
        until_overturning: bool,
    ) -> Self {
        Self {
            solver,
            forcing,
            starts,
            until_overturning,
            largest,
            pairs: Pairs {
                now: [[0.0; N]; 2],
                index: [0; N],
                forcing_now: [0.0; N],
                highest: [0.0; N],
                lowest: [0.0; N],
            },
            limit: [0; N],
            factor: [0.0; N],
            single: Wide::STILL,
            double: Wide::STILL,
            force_at_zero: [0.0; N],
            low: [f64::INFINITY; N],
            high: [f64::INFINITY; N],
            fastest: [0.0; N],
            waits: [true; N],
            rest: std::array::from_fn(|_| Lane::idle()),
            next: 0,
            running: 0,
            passages: vec![None; starts.len()],
            steps: 0,
            searched: 0,
            failure: None,
        }
    }

    /// Follows all runs to their ends; `observe` is shown u and u̇ at each sample after the first, of single runs.
    #[inline(always)]
    pub(super) fn follow(&mut self, observe: &mut impl FnMut(usize, f64, f64)) {
        for i in 0..N {
            if self.begin(i) {
                self.running += 1;
                self.go_on(i, observe);
            }
        }
        while self.running > 0 {
            self.plain(observe);
            for i in 0..N {
                if self.waits[i] && !self.rest[i].is_idle() {
                    if self.pairs.index[i] < self.limit[i] {
                        self.step(i, observe);
                    }
                    self.go_on(i, observe);
                }
            }
        }
    }

    /// The outcome of all runs, and the share of their steps that were searched.
    pub(super) fn passages(self) -> Result<(Vec<Passage>, f64), SolverError> {
        if let Some((_, error)) = self.failure {
            return Err(error);
        }
        let searched = self.searched as f64 / self.steps.max(1) as f64;
        Ok((self.passages.into_iter().flatten().collect(), searched))
    }

    /// Pairs of plain steps, until half the lanes wait or one comes to its limit.
    ///
    /// Lanes that wait are taken along, and held where they are: no branches, so that the compiler makes vectors of the lanes.
    #[allow(clippy::needless_range_loop, reason = "lanes by their numbers")]
    #[inline(always)]
    fn plain(&mut self, observe: &mut impl FnMut(usize, f64, f64)) {
        let enough = (self.running / 2) as u64;
        let room = |i: usize| self.limit[i].saturating_sub(self.pairs.index[i]).div_ceil(2);
        let pairs = (0..N).filter(|&i| !self.waits[i]).map(room).min().unwrap_or(0);
        let ahead: [&[[f64; 2]]; N] = std::array::from_fn(|i| {
            // those that wait may be near the end; what they read is of no use
            let index = if self.waits[i] { 0 } else { self.pairs.index[i] };
            &self.forcing.after(index, 2 * pairs).as_chunks().0[..pairs]
        });
        // apart from the rest, so that they stay in registers
        let Pairs { mut now, mut highest, mut lowest, .. } = self.pairs;
        let mut q: [f64; N] = std::array::from_fn(|i| self.pairs.forcing_now[i] - self.force_at_zero[i]);
        // all ones or all zeros
        let mut goes = self.waits.map(|waits| u64::from(!waits).wrapping_neg());
        let mut gone = [0_u64; N];
        for pair in 0..pairs {
            let (mut next, mut after) = ([0.0; N], [0.0; N]);
            for i in 0..N {
                [next[i], after[i]] = ahead[i][pair];
            }
            let mut end = [[0.0; N]; 2];
            for i in 0..N {
                next[i] = self.factor[i] * next[i] - self.force_at_zero[i];
                after[i] = self.factor[i] * after[i] - self.force_at_zero[i];
                for part in 0..2 {
                    let state = [now[0][i], now[1][i]];
                    end[part][i] = self.double.two_steps(i, part, state, [q[i], next[i], after[i]]);
                }
                goes[i] &= u64::from(self.holds(i, [end[0][i], end[1][i]])).wrapping_neg();
            }
            if N == 1 {
                if goes[0] == 0 {
                    break;
                }
                if !self.rest[0].looks_back() {
                    let index = self.pairs.index[0] + 2 * pair;
                    let state = [now[0][0], now[1][0]];
                    let middle = [0, 1].map(|part| self.single.one_step(0, part, state, [q[0], next[0]]));
                    observe(index + 1, middle[0], middle[1]);
                    observe(index + 2, end[0][0], end[1][0]);
                }
                now = end;
                gone[0] += 1;
            }
            let mut going = 0_u64;
            for i in 0..N {
                if N > 1 {
                    let select = |new: f64, old: f64| {
                        f64::from_bits((new.to_bits() & goes[i]) | (old.to_bits() & !goes[i]))
                    };
                    now[0][i] = select(end[0][i], now[0][i]);
                    now[1][i] = select(end[1][i], now[1][i]);
                    gone[i] = gone[i].wrapping_sub(goes[i]);
                    going = going.wrapping_sub(goes[i]);
                }
                q[i] = after[i];
                highest[i] = if now[0][i] > highest[i] { now[0][i] } else { highest[i] };
                lowest[i] = if now[0][i] < lowest[i] { now[0][i] } else { lowest[i] };
            }
            if N > 1 && going <= enough {
                break;
            }
        }
        let Pairs { mut index, mut forcing_now, .. } = self.pairs;
        for i in 0..N {
            #[allow(clippy::cast_possible_truncation, reason = "no more than the samples of the record")]
            let gone = gone[i] as usize;
            index[i] += 2 * gone;
            forcing_now[i] = self.factor[i] * self.forcing.at(index[i]);
            self.waits[i] = goes[i] == 0 || index[i] >= self.limit[i];
        }
        self.pairs = Pairs { now, index, forcing_now, highest, lowest };
    }

    /// Whether a pair of plain steps may end so, or begin.
    #[allow(clippy::needless_bitwise_bool, reason = "no branches, so that lanes go side by side")]
    #[inline(always)]
    fn holds(&self, i: usize, [u, v]: [f64; 2]) -> bool {
        (u >= self.low[i]) & (u <= self.high[i]) & (v.abs() <= self.fastest[i])
    }

    /// Goes on until the lane may try a pair of steps, or is idle.
    #[inline(never)]
    fn go_on(&mut self, i: usize, observe: &mut impl FnMut(usize, f64, f64)) {
        loop {
            if self.rest[i].state.phase == Phase::Landed {
                self.lie(i, observe);
            }
            while self.pairs.index[i] >= self.rest[i].until {
                if !self.turn_page(i) {
                    return;
                }
            }
            if self.open(i) {
                return;
            }
            self.step(i, observe);
        }
    }

    /// One step of one lane, plain or not.
    #[inline(always)]
    fn step(&mut self, i: usize, observe: &mut impl FnMut(usize, f64, f64)) {
        let index = self.pairs.index[i];
        let p = [self.pairs.forcing_now[i], self.factor[i] * self.forcing.at(index + 1)];
        if let Err(error) = self.move_one(i, p) {
            self.give_up(i, error);
            return;
        }
        self.pairs.index[i] = index + 1;
        self.pairs.forcing_now[i] = p[1];
        if !self.rest[i].looks_back() {
            let [u, v] = self.state(i);
            observe(index + 1, u, v);
        }
    }

    #[inline(always)]
    fn move_one(&mut self, i: usize, p: [f64; 2]) -> Result<(), SolverError> {
        let q = p.map(|p| p - self.force_at_zero[i]);
        let start = self.state(i);
        let end = [0, 1].map(|part| self.single.one_step(i, part, start, q));
        if let Some([low, high]) = self.range(i, 0) {
            let holds = |[u, v]: [f64; 2]| u >= low && u <= high && v.abs() <= self.fastest[i];
            if holds(start) && holds(end) {
                self.set_state(i, end);
                self.take_in(i, start[0]);
                self.take_in(i, end[0]);
                return Ok(());
            }
        }
        self.careful(i, p, end)
    }

    /// u and u̇ of a lane.
    #[inline]
    pub(super) fn state(&self, i: usize) -> [f64; 2] {
        let [u, v] = &self.pairs.now;
        [u[i], v[i]]
    }

    pub(super) fn whole_state(&self, i: usize) -> State {
        let [displacement, velocity] = self.state(i);
        State { displacement, velocity, ..self.rest[i].state }
    }

    #[inline]
    pub(super) fn set_state(&mut self, i: usize, [u, v]: [f64; 2]) {
        (self.pairs.now[0][i], self.pairs.now[1][i]) = (u, v);
    }

    /// Takes a displacement between plain steps into the extremes of the stretch.
    #[inline(always)]
    fn take_in(&mut self, i: usize, u: f64) {
        self.pairs.highest[i] = self.pairs.highest[i].max(u);
        self.pairs.lowest[i] = self.pairs.lowest[i].min(u);
    }

    /// Forgets the ends of plain steps.
    pub(super) fn forget_nodes(&mut self, i: usize) {
        (self.pairs.highest[i], self.pairs.lowest[i]) = (f64::NEG_INFINITY, f64::INFINITY);
    }

    /// Takes the ends of plain steps so far into the extremes.
    #[inline(always)]
    pub(super) fn take_in_nodes(&mut self, i: usize) {
        let (highest, lowest, u) = (self.pairs.highest[i], self.pairs.lowest[i], self.pairs.now[0][i]);
        let peaks = &mut self.rest[i].state.peaks;
        peaks.include(u);
        if highest >= lowest {
            peaks.include(highest);
            peaks.include(lowest);
        }
    }

    /// The map of steps on the branch a lane is on.
    #[inline(always)]
    pub(super) fn map(&self, i: usize) -> Option<&'a StepMap> {
        let State { phase, branch, .. } = self.rest[i].state;
        let solver = self.solver;
        if phase == Phase::Moving { solver.maps[branch].as_ref() } else { None }
    }

    /// Takes up the state and the branch of a lane.
    #[inline(always)]
    pub(super) fn load(&mut self, i: usize) {
        let State { displacement, velocity, .. } = self.rest[i].state;
        self.set_state(i, [displacement, velocity]);
        if let Some(map) = self.map(i) {
            self.single.load(i, &map.single);
            self.double.load(i, &map.double);
            self.force_at_zero[i] = map.force_at_zero;
            self.brake(i);
        }
    }

    /// The forces a lane may meet on its way.
    pub(super) fn measure(&mut self, i: usize) {
        self.take_in_nodes(i);
        let step = self.solver.step;
        let room = if self.rest[i].looks_back() { 1.0 } else { ROOM };
        let lane = &mut self.rest[i];
        lane.reach = room * (lane.state.peaks.largest() + lane.largest_forcing * step * step);
        lane.largest_force = self.solver.largest_force(lane.reach);
        self.brake(i);
    }

    /// What motion on the present branch can be at most.
    #[inline(always)]
    fn brake(&mut self, i: usize) {
        let Some(map) = self.map(i) else { return };
        let lane = &mut self.rest[i];
        let driving = lane.largest_forcing + lane.largest_force;
        self.fastest[i] = map.fastest(driving);
        let step = self.solver.step;
        let most = map.most(driving);
        lane.margins = [0.125 * step * step * most[0], 0.5 * step * step * most[1]];
        lane.slow = most[0] * step;
        lane.growth = lane.growth.max(map.growth[1]);
        lane.driving = lane.driving.max(driving);
    }

    /// Where one plain step, or two, may start and end.
    #[inline(always)]
    fn range(&self, i: usize, part: usize) -> Option<[f64; 2]> {
        let map = self.map(i)?;
        let lane = &self.rest[i];
        let Lane { reach, margins, state: State { peaks, .. }, .. } = *lane;
        let margin = margins[part];
        let [lower, upper] = [map.corners[0].max(-reach), map.corners[1].min(reach)];
        Some(if lane.looks_back() {
            [lower.max(-peaks.negative) + margin, upper.min(peaks.positive) - margin]
        } else {
            [lower + margin, upper - margin]
        })
    }

    /// Lets a lane begin pairs of steps, if it may; tells whether.
    #[inline(always)]
    fn open(&mut self, i: usize) -> bool {
        self.waits[i] = true;
        if let (true, Some([low, high])) = (self.pairs.index[i] < self.limit[i], self.range(i, 1)) {
            (self.low[i], self.high[i]) = (low, high);
            let state = self.state(i);
            if self.holds(i, state) {
                self.take_in(i, state[0]);
                self.waits[i] = false;
            }
        }
        !self.waits[i]
    }

    /// Goes on from the end of a step on the same branch.
    #[inline(always)]
    pub(super) fn arrive(&mut self, i: usize, end: [f64; 2]) {
        self.rest[i].state.peaks.include(end[0]);
        self.set_state(i, end);
        self.look_around(i);
    }

    /// Measures anew where u has grown.
    #[inline(always)]
    pub(super) fn look_around(&mut self, i: usize) {
        if 2.0 * self.pairs.now[0][i].abs() > self.rest[i].reach && !self.rest[i].looks_back() {
            self.measure(i);
        }
    }

    /// Whether u̇ keeps its sign over a step, by what |ü| can be at most: so it does between two velocities of one sign that
    /// are larger together than A h.
    #[inline(always)]
    pub(super) fn is_steady(&self, i: usize, v0: f64, [u1, v1]: [f64; 2]) -> bool {
        let Lane { slow, reach, .. } = self.rest[i];
        u1.abs() <= reach
            && v0 * v1 > 0.0
            && v0.abs() + v1.abs() > slow
            && v0.abs().max(v1.abs()) <= self.fastest[i]
    }
}
