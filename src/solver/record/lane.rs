//! One run of a wall through a record: by itself two steps at a time as long as they are plain; side by side with others what is
//! not plain (module `batch`).

use super::super::{Memo, Peaks, Phase, SolverError, State, Work};
use super::stretches::{Place, Stretch};
use super::{Forcing, Passage, RecordSolver, Start, StepMap};

/// A run under way.
pub(super) struct Lane<'a, F> {
    pub(super) solver: &'a RecordSolver<'a>,
    pub(super) forcing: &'a F,
    /// Largest |p| over each stretch of the record, before the run's factor \[m/s²\].
    pub(super) largest: &'a [f64],
    pub(super) until_overturning: bool,
    pub(super) plain: Plain,
    /// The factor of the forcing.
    pub(super) factor: f64,
    /// u and u̇.
    pub(super) now: [f64; 2],
    /// The sample the run is at, and the forcing there \[m/s²\].
    pub(super) index: usize,
    pub(super) forcing_now: f64,
    /// The extremes of u at the ends of the plain steps of this stretch \[m\].
    pub(super) highest: f64,
    pub(super) lowest: f64,
    /// u and u̇ of this one are not kept up to date.
    pub(super) state: State,
    /// The map of steps on the present branch.
    pub(super) map: Option<&'a StepMap>,
    /// The first sample at which no plain steps begin.
    pub(super) limit: usize,
    /// Samples at which this stretch and this pass through the record end.
    pub(super) until: usize,
    pub(super) last: usize,
    /// Where pairs of steps may start and end, u and |u̇|.
    range: [f64; 2],
    fastest: f64,
    /// P over this stretch \[m/s²\], f̂ \[m/s²\] and the |u| up to which f̂ is taken \[m\].
    pub(super) largest_forcing: f64,
    pub(super) largest_force: f64,
    pub(super) reach: f64,
    /// A h²/8 over one step and over two \[m\], and A h over one \[m/s\], on the present branch.
    margins: [f64; 2],
    slow: f64,
    /// The largest P + f̂ in this stretch, and A over P + c V + f̂.
    pub(super) driving: f64,
    pub(super) growth: f64,
    pub(super) began: Place,
    /// Stretches in which u may have gone beyond the extremes known.
    pub(super) doubtful: Vec<Stretch>,
    /// What became of the run, while it looks back at those.
    pub(super) result: Option<Passage>,
    pub(super) overturning: Option<f64>,
    /// Work of the steps that were searched, and their number.
    pub(super) work: Work,
    pub(super) searched: u64,
    pub(super) stilled: bool,
    pub(super) memo: Memo,
}

/// Plain steps taken at once.
#[derive(Clone, Copy)]
pub(super) struct Plain {
    /// Their number.
    pub(super) steps: usize,
    /// The least [`growth`](super::growth) over them to reckon with: that of steps taken for the lane, not by it.
    pub(super) growth: f64,
}

impl Plain {
    /// Of a run by itself.
    pub(super) const PAIRS: Self = Self { steps: 2, growth: 0.0 };
}

/// c V over P + f̂: the largest speed V of a plain step. Walls stay far below, as they do below the terminal speed.
pub(super) const BRAKING: f64 = 0.25;
/// The |u| up to which f̂ is taken, over the largest so far.
const ROOM: f64 = 4.0;

/// Whether plain steps may start or end so.
#[inline(always)]
fn holds([low, high]: [f64; 2], fastest: f64, [u, v]: [f64; 2]) -> bool {
    u >= low && u <= high && v.abs() <= fastest
}

impl<'a, F: Forcing> Lane<'a, F> {
    /// A run at its start.
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        forcing: &'a F,
        largest: &'a [f64],
        until_overturning: bool,
        plain: Plain,
        Start { state, factor }: Start,
    ) -> Self {
        let mut lane = Self {
            solver,
            forcing,
            largest,
            until_overturning,
            plain,
            factor,
            now: [state.displacement, state.velocity],
            index: 0,
            forcing_now: 0.0,
            highest: 0.0,
            lowest: 0.0,
            state,
            map: None,
            limit: 0,
            until: 0,
            last: forcing.count() - 1,
            range: [0.0; 2],
            fastest: 0.0,
            largest_forcing: 0.0,
            largest_force: 0.0,
            reach: 0.0,
            margins: [0.0; 2],
            slow: 0.0,
            driving: 0.0,
            growth: 0.0,
            began: Place { state, index: 0 },
            doubtful: Vec::new(),
            result: None,
            overturning: state.overturned.then_some(0.0),
            work: Work::default(),
            searched: 0,
            stilled: false,
            memo: Memo::default(),
        };
        lane.place(Place { state, index: 0 });
        lane
    }

    /// Follows the run to its end; `observe` is shown u and u̇ at each sample after the first.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<Passage, SolverError> {
        loop {
            if let Some(passage) = self.go_on(observe)? {
                return Ok(passage);
            }
            self.pairs(observe);
            if self.index < self.limit {
                self.step(observe)?;
            }
        }
    }

    /// Pairs of plain steps, as many as there are.
    #[inline(always)]
    fn pairs(&mut self, observe: &mut impl FnMut(usize, f64, f64)) {
        let Some(map) = self.map else { return };
        let pairs = self.limit.saturating_sub(self.index).div_ceil(2);
        let ahead = self.forcing.from(self.index + 1, 2 * pairs).as_chunks().0;
        let looks_back = self.looks_back();
        // apart from the rest, so that they stay in registers
        let (single, double, force_at_zero) = (map.single, map.double, map.force_at_zero);
        let (factor, range, fastest) = (self.factor, self.range, self.fastest);
        let (mut now, mut highest, mut lowest) = (self.now, self.highest, self.lowest);
        let mut q = self.forcing_now - force_at_zero;
        let mut gone = 0;
        for &[next, after] in ahead {
            let [next, after] = [next, after].map(|p: f64| factor * p - force_at_zero);
            let end = [0, 1].map(|part| double.two_steps(part, now, [q, next, after]));
            if !holds(range, fastest, end) {
                break;
            }
            if !looks_back {
                let index = self.index + 2 * gone;
                let [u, v] = [0, 1].map(|part| single.one_step(part, now, [q, next]));
                observe(index + 1, u, v);
                observe(index + 2, end[0], end[1]);
            }
            now = end;
            q = after;
            highest = if now[0] > highest { now[0] } else { highest };
            lowest = if now[0] < lowest { now[0] } else { lowest };
            gone += 1;
        }
        self.index += 2 * gone;
        self.forcing_now = self.factor * self.forcing.at(self.index);
        (self.now, self.highest, self.lowest) = (now, highest, lowest);
    }

    /// Goes on until the run may try a pair of steps, or is over: what became of it.
    #[inline(never)]
    fn go_on(&mut self, observe: &mut impl FnMut(usize, f64, f64)) -> Result<Option<Passage>, SolverError> {
        loop {
            if let Some(passage) = self.turn_pages(observe) {
                return Ok(Some(passage));
            }
            if self.open() {
                return Ok(None);
            }
            self.step(observe)?;
        }
    }

    /// One step, plain or not.
    #[inline(always)]
    pub(super) fn step(&mut self, observe: &mut impl FnMut(usize, f64, f64)) -> Result<(), SolverError> {
        let p = [self.forcing_now, self.factor * self.forcing.at(self.index + 1)];
        self.move_one(p)?;
        self.index += 1;
        self.forcing_now = p[1];
        if !self.looks_back() {
            let [u, v] = self.now;
            observe(self.index, u, v);
        }
        Ok(())
    }

    #[inline(always)]
    fn move_one(&mut self, p: [f64; 2]) -> Result<(), SolverError> {
        let Some(map) = self.map else { return self.search(p, None) };
        let q = p.map(|p| p - map.force_at_zero);
        let start = self.now;
        let end = [0, 1].map(|part| map.single.one_step(part, start, q));
        let range = self.range(map, 0);
        if holds(range, self.fastest, start) && holds(range, self.fastest, end) {
            self.now = end;
            self.take_in(start[0]);
            self.take_in(end[0]);
            return Ok(());
        }
        self.careful(map, p, end)
    }

    /// The state as a whole.
    pub(super) fn whole_state(&self) -> State {
        let [displacement, velocity] = self.now;
        State { displacement, velocity, ..self.state }
    }

    /// Takes a displacement between plain steps into the extremes of the stretch.
    #[inline(always)]
    fn take_in(&mut self, u: f64) {
        self.highest = self.highest.max(u);
        self.lowest = self.lowest.min(u);
    }

    /// Forgets the ends of plain steps.
    pub(super) fn forget_nodes(&mut self) {
        (self.highest, self.lowest) = (f64::NEG_INFINITY, f64::INFINITY);
    }

    /// Takes the ends of plain steps so far into the extremes.
    #[inline(always)]
    pub(super) fn take_in_nodes(&mut self) {
        let peaks = &mut self.state.peaks;
        peaks.include(self.now[0]);
        if self.highest >= self.lowest {
            peaks.include(self.highest);
            peaks.include(self.lowest);
        }
    }

    /// Takes up the state and the branch of the run.
    #[inline(always)]
    pub(super) fn load(&mut self) {
        let State { displacement, velocity, phase, branch, .. } = self.state;
        self.now = [displacement, velocity];
        let solver = self.solver;
        self.map = if phase == Phase::Moving { solver.maps[branch].as_ref() } else { None };
        self.brake();
    }

    /// The forces the run may meet on its way.
    pub(super) fn measure(&mut self) {
        self.take_in_nodes();
        let step = self.solver.step;
        let room = if self.looks_back() { 1.0 } else { ROOM };
        self.reach = room * (self.state.peaks.largest() + self.largest_forcing * step * step);
        self.largest_force = self.solver.largest_force(self.reach);
        self.brake();
    }

    /// What motion on the present branch can be at most.
    #[inline(always)]
    pub(super) fn brake(&mut self) {
        let Some(map) = self.map else { return };
        let driving = self.largest_forcing + self.largest_force;
        self.fastest = map.fastest(driving);
        let step = self.solver.step;
        let most = map.most(driving);
        self.margins = [0.125 * step * step * most[0], 0.5 * step * step * most[1]];
        self.slow = most[0] * step;
        self.growth = self.growth.max(map.growth[1]);
        self.driving = self.driving.max(driving);
    }

    /// Up to where u may go by what is known: to the reach of f̂, and in looking back to the extremes.
    #[inline(always)]
    pub(super) fn known(&self) -> [f64; 2] {
        let Peaks { positive, negative } = self.state.peaks;
        if self.looks_back() {
            [(-self.reach).max(-negative), self.reach.min(positive)]
        } else {
            [-self.reach, self.reach]
        }
    }

    /// Where one plain step, or two, may start and end.
    #[inline(always)]
    fn range(&self, map: &StepMap, part: usize) -> [f64; 2] {
        let margin = self.margins[part];
        let [lowest, highest] = self.known();
        [map.corners[0].max(lowest) + margin, map.corners[1].min(highest) - margin]
    }

    /// Finds out where pairs of steps may go; tells whether one may begin.
    #[inline(always)]
    fn open(&mut self) -> bool {
        let Some(map) = self.map else { return false };
        if self.index >= self.limit {
            return false;
        }
        self.range = self.range(map, 1);
        let opens = holds(self.range, self.fastest, self.now);
        if opens {
            self.take_in(self.now[0]);
        }
        opens
    }

    /// Goes on from the end of a step on the same branch.
    #[inline(always)]
    pub(super) fn arrive(&mut self, end: [f64; 2]) {
        self.state.peaks.include(end[0]);
        self.now = end;
        self.look_around();
    }

    /// Measures anew where u has grown.
    #[inline(always)]
    pub(super) fn look_around(&mut self) {
        if 2.0 * self.now[0].abs() > self.reach && !self.looks_back() {
            self.measure();
        }
    }

    /// Whether u̇ keeps its sign over a step, by what |ü| can be at most: so it does between two velocities of one sign that
    /// are larger together than A h.
    #[inline(always)]
    pub(super) fn is_steady(&self, v0: f64, [u1, v1]: [f64; 2]) -> bool {
        u1.abs() <= self.reach
            && v0 * v1 > 0.0
            && v0.abs() + v1.abs() > self.slow
            && v0.abs().max(v1.abs()) <= self.fastest
    }

    /// Whether the run is over but for its extremes.
    #[inline(always)]
    pub(super) fn looks_back(&self) -> bool {
        self.result.is_some()
    }
}
