//! Steps on branches with constant damping: plain steps, four or two at once, and the single steps of lanes
//! that wait (docs/record-path.md, §2 and §3).

use crate::corners::Part;
use crate::forcing::MOST_AT_ONCE;
use crate::lanes::{Lanes, Rows, Waiting};
use crate::line::{Bounds, Line};
use crate::number::{BranchRow, Number, WIDTH, index};
use crate::responses::{ROWS_AHEAD, Responses};
use crate::solver::Observer;
use crate::table::get;

/// The number of lanes at which plain steps stop, so that the lanes that wait are served. Serving them costs
/// as much as some thirty plain steps, however few they are.
const FEW: u32 = 1;

/// Where plain steps may start and end: u from `low` to `high`, |u̇| up to `speed`.
#[derive(Clone, Copy)]
struct Range<N> {
    low: N,
    high: N,
    speed: N,
}

impl<N: Number> Range<N> {
    #[inline(always)]
    fn holds(&self, [u, v]: [N; 2]) -> N::Mask {
        self.low.at_most(u) & u.at_most(self.high) & v.abs().at_most(self.speed)
    }
}

/// Result of a step of each lane: u and u̇, the steps taken, and the extremes at their ends.
#[derive(Clone, Copy)]
struct Reached<N> {
    now: [N; 2],
    steps: N,
    highest: N,
    lowest: N,
}

impl<N: Number> Reached<N> {
    #[inline(always)]
    fn start(token: N::Token, rows: &Rows, first: usize) -> Self {
        let now = [N::load(token, &rows.u, first), N::load(token, &rows.v, first)];
        let highest = N::load(token, &rows.highest, first).max(now[0]);
        let lowest = N::load(token, &rows.lowest, first).min(now[0]);
        Self { now, steps: N::splat(token, 0.0), highest, lowest }
    }

    /// Moves the lanes that took steps to the ends of these, and includes u there in the extremes.
    #[inline(always)]
    fn take(&mut self, lanes: N::Mask, [u, v]: [N; 2], steps: N) {
        self.now = [N::select(lanes, u, self.now[0]), N::select(lanes, v, self.now[1])];
        self.steps = N::select(lanes, steps, self.steps);
        self.highest = self.highest.max(self.now[0]);
        self.lowest = self.lowest.min(self.now[0]);
    }

    /// Stores in the rows what these lanes have come to.
    #[inline(always)]
    fn store(self, token: N::Token, lanes: N::Mask, rows: &mut Rows, first: usize) {
        self.now[0].store(&mut rows.u, first);
        self.now[1].store(&mut rows.v, first);
        N::select(lanes, self.highest, N::load(token, &rows.highest, first)).store(&mut rows.highest, first);
        N::select(lanes, self.lowest, N::load(token, &rows.lowest, first)).store(&mut rows.lowest, first);
        (N::load(token, &rows.index, first) + self.steps).store(&mut rows.index, first);
    }
}

/// Looks up the numbers of several rows.
#[inline(always)]
fn look_up_rows<N: Number, const ROWS: usize>(
    token: N::Token,
    rows: &[BranchRow; ROWS],
    branches: N::Branches,
) -> [N; ROWS] {
    let mut found = [N::splat(token, 0.0); ROWS];
    for (found, row) in found.iter_mut().zip(rows) {
        *found = N::look_up(token, row, branches);
    }
    found
}

/// Returns the change of u, or of u̇, by u, u̇ and q = p − f(0) at both ends of a step.
#[inline(always)]
fn change<N: Number>([by_u, by_v, by_q0, by_q1]: [N; 4], [u, v]: [N; 2], q: [N; 2]) -> N {
    // adds the products with the state last, because the next step waits for them
    (by_q0 * q[0] + by_q1 * q[1]) + (by_u * u + by_v * v)
}

impl<O: Observer> Lanes<'_, O> {
    /// Takes steps of the lanes from `first` on, until some wait for what is not done here; returns these.
    #[inline(always)]
    pub(crate) fn affine_steps<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        busy: u8,
        responses: Option<&Responses>,
    ) -> Waiting {
        if N::LANES == 1 && self.rows.share[first] > 0.0 {
            return self.rest_of_step::<N>(token, first);
        }
        let branch = N::load(token, &self.rows.branch, first);
        let bounds = Bounds::look_up(token, &self.solver.table, &self.rows, first, branch);
        let (range, change) = self.plain_range::<N>(token, first, &bounds);
        let [u, v] = [N::load(token, &self.rows.u, first), N::load(token, &self.rows.v, first)];
        // from this speed on u̇ keeps its sign over the steps: u stays between its values at their ends
        let steady = change.at_most(v.abs())
            & Range { low: bounds.within[0], high: bounds.within[1], ..range }.holds([u, v]);
        let open = |rows: &Rows| N::load(token, &rows.index, first).below(N::load(token, &rows.limit, first));
        let mut ready = N::bits((range.holds([u, v]) | steady) & open(&self.rows)) & busy;
        let few = FEW.min(busy.count_ones() - 1);
        if ready.count_ones() > few {
            let goes = if N::LANES == 1 {
                self.plain_alone(token, first, &range, ready)
            } else if let Some(responses) = responses {
                self.plain_in_lanes(token, first, &range, (ready, few), responses)
            } else {
                N::mask(token, 0)
            };
            ready = N::bits(goes & open(&self.rows)) & busy;
        }
        let u = N::load(token, &self.rows.u, first);
        let grown = N::bits(N::load(token, &self.rows.half_reach, first).below(u.abs())) & busy & !ready;
        // a run by itself takes the steps beyond the limit one by one
        let ended =
            if N::LANES > 1 { busy & !N::bits(open(&self.rows)) } else { self.is_at_end(first).into() };
        let waiting = busy & !(ready | grown | ended);
        let stuck = if waiting == 0 { 0 } else { self.single_steps(token, first, &bounds, waiting) };
        Waiting { ended, stuck: grown & !ended | stuck }
    }

    /// Finds where plain steps may start and end, and A L, the most by which u̇ changes over those taken at
    /// once \[m/s\].
    #[inline(always)]
    fn plain_range<N: Number>(&self, token: N::Token, first: usize, bounds: &Bounds<N>) -> (Range<N>, N) {
        let (rows, table) = (&self.rows, &self.solver.table);
        let branches = N::load(token, &rows.branch, first).branches();
        let driving = N::load(token, &rows.driving, first);
        let bounded = driving + N::look_up(token, &table.damping_share, branches) * driving;
        let length = table.at_once as f64 * self.solver.step;
        let most = N::look_up(token, &table.plain_growth, branches) * bounded;
        let margin = most * (0.125 * length * length);
        let [low, high] = [bounds.within[0] + margin, bounds.within[1] - margin];
        (Range { low, high, speed: bounds.speed }, most * length)
    }

    /// Takes plain steps side by side, by the responses of the branches to the record.
    #[inline(always)]
    fn plain_in_lanes<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        range: &Range<N>,
        ready: (u8, u32),
        responses: &Responses,
    ) -> N::Mask {
        let rows = &self.rows;
        let mut ahead: [&[[f64; 2]]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead.iter_mut().enumerate() {
            *ahead = responses.ahead(index(rows.branch[lane]), index(rows.index[lane]));
        }
        self.plain_steps(token, first, range, ready, ROWS_AHEAD, |row| {
            N::unzip(token, |lane| ahead[lane][row])
        })
    }

    /// Takes plain steps of one lane.
    #[inline(always)]
    fn plain_alone<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        range: &Range<N>,
        ready: u8,
    ) -> N::Mask {
        let (rows, record) = (&self.rows, self.record);
        let branch = index(rows.branch[first]);
        let (map, at_once) = (self.solver.table.maps[branch], self.solver.table.at_once);
        let sample = index(rows.index[first]);
        let count = (index(rows.limit[first]) - sample).div_ceil(at_once);
        let p = record.forcing.from(sample, (count - 1) * at_once + MOST_AT_ONCE + 1);
        self.plain_steps(token, first, range, (ready, 0), count, |row| {
            let response = map.respond(&p[row * at_once..][..=MOST_AT_ONCE]);
            N::unzip(token, |_| response)
        })
    }

    /// Takes plain steps, several at once, until few lanes go on; returns the lanes that do. `response` gives
    /// the change by the record over each group of steps in turn.
    #[inline(always)]
    fn plain_steps<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        range: &Range<N>,
        (ready, few): (u8, u32),
        count: usize,
        response: impl Fn(usize) -> [N; 2],
    ) -> N::Mask {
        let (rows, table) = (&self.rows, &self.solver.table);
        let branches = N::load(token, &rows.branch, first).branches();
        let [[uu, uv, u_force], [vu, vv, v_force]] = [
            look_up_rows::<N, _>(token, &table.plain_steps[0], branches),
            look_up_rows::<N, _>(token, &table.plain_steps[1], branches),
        ];
        let factor = N::load(token, &rows.factor, first);
        let room = N::load(token, &rows.limit, first) - N::load(token, &rows.index, first);
        let started = N::mask(token, ready);
        let mut goes = started;
        let mut reached = Reached::start(token, rows, first);
        let [mut u, mut v] = reached.now;
        let mut steps = reached.steps;
        for row in 0..count {
            let [of_u, of_v] = response(row);
            let next_u = u + ((factor * of_u + u_force) + (uu * u + uv * v));
            v = v + ((factor * of_v + v_force) + (vu * u + vv * v));
            u = next_u;
            goes = goes & range.holds([u, v]) & steps.below(room);
            if O::SEES && N::bits(goes) != 0 {
                let sample = index(self.rows.index[first] + reached.steps.lane(0));
                let (from, count) = (reached.now.map(|x| x.lane(0)), table.at_once);
                self.see_steps(first, sample, from, count - 1);
                self.see(sample + count, [u.lane(0), v.lane(0)]);
            }
            steps = steps + table.at_once as f64;
            reached.take(goes, [u, v], steps);
            if N::bits(goes).count_ones() <= few {
                break;
            }
        }
        reached.store(token, started, &mut self.rows, first);
        goes
    }

    /// Shows the observer some single steps of a lane, from u and u̇ at a sample on.
    fn see_steps(&mut self, lane: usize, sample: usize, mut now: [f64; 2], count: usize) {
        let (table, rows) = (&self.solver.table, &self.rows);
        let (branch, factor) = (rows.branch[lane].branches(), rows.factor[lane]);
        let map = [
            look_up_rows::<f64, _>((), &table.one_step[0], branch),
            look_up_rows::<f64, _>((), &table.one_step[1], branch),
        ];
        for sample in sample..sample + count {
            let q = [0, 1]
                .map(|n| factor * self.record.forcing.at(sample + n) - get(&table.force_at_zero, branch));
            now = [0, 1].map(|part| now[part] + change(map[part], now, q));
            self.see(sample + 1, now);
        }
    }

    /// Takes one to four steps of lanes that wait, the last of them past corners if need be; returns those
    /// that took none.
    #[inline(always)]
    fn single_steps<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        bounds: &Bounds<N>,
        waiting: u8,
    ) -> u8 {
        let waits = N::mask(token, waiting);
        let mut reached = Reached::start(token, &self.rows, first);
        let before = reached.now;
        let part = self.stay_on_branch(token, first, bounds, waits, &mut reached);
        if O::SEES {
            let sample = index(self.rows.index[first]);
            self.see_steps(first, sample, before.map(|x| x.lane(0)), index(reached.steps.lane(0)));
        }
        reached.store(token, waits, &mut self.rows, first);
        let mut none = N::bits(reached.steps.below(N::splat(token, 1.0))) & waiting;
        if N::bits(part.lanes) != 0 {
            let arrival = self.pass_corners(token, first, part);
            self.arrive(token, first, &arrival);
            none &= !N::bits(arrival.lanes);
            if O::SEES && N::bits(arrival.lanes) != 0 && self.rows.share[first] == 0.0 {
                self.see_now(first);
            }
        }
        none
    }

    /// Takes up to four steps in which lanes stay on their branch and within the limits of u, also between
    /// samples. Returns the next step of the lanes that leave their branch in it.
    #[inline(always)]
    fn stay_on_branch<N: Number>(
        &self,
        token: N::Token,
        first: usize,
        bounds: &Bounds<N>,
        mut goes: N::Mask,
        reached: &mut Reached<N>,
    ) -> Part<N> {
        let (rows, table) = (&self.rows, &self.solver.table);
        let branch = N::load(token, &rows.branch, first);
        let branches = branch.branches();
        let [u_by, v_by] = [
            look_up_rows::<N, _>(token, &table.one_step[0], branches),
            look_up_rows::<N, _>(token, &table.one_step[1], branches),
        ];
        let line = Line::look_up(token, table, branches);
        let length = N::splat(token, self.solver.step);
        let furthest = self.record.forcing.count() - 1;
        // lanes that do not wait may be near the end of the record
        let most =
            if N::LANES == 1 { MOST_AT_ONCE.min(furthest - index(rows.index[first])) } else { MOST_AT_ONCE };
        let mut ahead: [&[f64]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead[..N::LANES].iter_mut().enumerate() {
            let sample = index(rows.index[(first + lane) % WIDTH]);
            *ahead = self.record.forcing.from(sample.min(furthest - most), most + 1);
        }
        let factor = N::load(token, &rows.factor, first);
        let p = |n: usize| factor * N::of_lanes(token, |lane| ahead[lane][n]);
        let (mut from, mut p0) = (reached.now, p(0));
        let none = goes & !goes;
        let (mut leaving, mut end, mut forcing) = (none, from, [p0; 2]);
        for n in 1..=most {
            let p1 = p(n);
            let q = [p0 - line.force_at_zero, p1 - line.force_at_zero];
            let to = [from[0] + change(u_by, from, q), from[1] + change(v_by, from, q)];
            let course = line.course(from, to, p0.abs().max(p1.abs()), length, bounds);
            let (stays, leaves) = (goes & course.stays, goes & course.leaves);
            leaving = leaving | leaves;
            end = [N::select(leaves, to[0], end[0]), N::select(leaves, to[1], end[1])];
            forcing = [N::select(leaves, p0, forcing[0]), N::select(leaves, p1, forcing[1])];
            reached.take(stays, to, reached.steps + 1.0);
            goes = stays;
            if N::bits(goes) == 0 {
                break;
            }
            (from, p0) = (to, p1);
        }
        Part::step(leaving, branch, line, [reached.now, end], forcing, self.solver.step)
    }
}
