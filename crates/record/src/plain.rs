//! Steps on branches with constant damping: plain steps, four or two at once, and the single steps of lanes
//! that wait (docs/record-path.md, §2 and §3).

use crate::affine::MOST_AT_ONCE;
use crate::blocks::AHEAD;
use crate::corners::Part;
use crate::lanes::{Lanes, Rows, Waiting};
use crate::line::{Bounds, LinearBranch};
use crate::number::{Number, WIDTH, index};
use crate::responses::ROWS_AHEAD;
use crate::run::Observer;
use crate::table::{BranchTable, get};

/// The number of lanes at which plain steps stop, so that the lanes that wait are served. Serving them costs
/// as much as some thirty plain steps, however few they are.
const STOP_AT: u32 = 1;

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

/// Returns the change of u, or of u̇, by u, u̇ and q = p − f(0) at both ends of a step.
#[inline(always)]
fn change<N: Number>([by_u, by_v, by_q0, by_q1]: [N; 4], [u, v]: [N; 2], q: [N; 2]) -> N {
    // adds the products with the state last, because the next step waits for them
    (by_q0 * q[0] + by_q1 * q[1]) + (by_u * u + by_v * v)
}

/// Returns the forcing of lanes at two samples.
#[inline(always)]
fn pair<N: Number>(token: N::Token, ahead: &[&[f64; AHEAD]; WIDTH], at: usize) -> [N; 2] {
    N::unzip(token, |lane| [ahead[lane][at], ahead[lane][at + 1]])
}

/// Returns the change of u, or of u̇, by the forcing at five samples, as `Affine::respond` does.
#[inline(always)]
fn respond<N: Number>(by: &[[N; 2]; MOST_AT_ONCE + 1], part: usize, p: [N; MOST_AT_ONCE + 1]) -> N {
    let [a, b, c, d, e] = by;
    ((a[part] * p[0] + b[part] * p[1]) + (c[part] * p[2] + d[part] * p[3])) + e[part] * p[4]
}

/// Lanes that may take plain steps, one bit for each, and how few of them are too few to go on.
#[derive(Clone, Copy)]
struct Ready {
    lanes: u8,
    stop_at: u32,
}

impl<O: Observer> Lanes<'_, O> {
    /// Takes steps of the lanes from `first` on, until some wait for what is not done here; returns these.
    #[inline(always)]
    pub(crate) fn affine_steps<N: Number>(&mut self, token: N::Token, first: usize, busy: u8) -> Waiting {
        if N::LANES == 1 && self.rows.step_taken[first] > 0.0 {
            return self.rest_of_step::<N>(token, first);
        }
        let branch = self.rows.branch.load(token, first);
        let bounds = self.bounds(token, first, branch);
        let (range, change) = self.plain_range::<N>(token, first, &bounds);
        let [u, v] = [N::load(token, &self.rows.u, first), N::load(token, &self.rows.v, first)];
        // from this speed on u̇ keeps its sign over the steps: u stays between its values at their ends
        let steady = change.at_most(v.abs())
            & Range { low: bounds.within[0], high: bounds.within[1], ..range }.holds([u, v]);
        let open = |rows: &Rows| N::load(token, &rows.index, first).below(N::load(token, &rows.limit, first));
        let mut ready = N::bits((range.holds([u, v]) | steady) & open(&self.rows)) & busy;
        let stop_at = STOP_AT.min(busy.count_ones() - 1);
        if ready.count_ones() > stop_at {
            let goes = if N::LANES == 1 {
                self.plain_alone(token, first, &range, ready)
            } else if N::ONE_TABLE {
                self.plain_in_lanes(token, first, &range, Ready { lanes: ready, stop_at })
            } else {
                self.plain_by_samples(token, first, &range, Ready { lanes: ready, stop_at })
            };
            ready = N::bits(goes & open(&self.rows)) & busy;
        }
        let u = N::load(token, &self.rows.u, first);
        let grown = N::bits(N::load(token, &self.rows.half_reach, first).below(u.abs())) & busy & !ready;
        // a run by itself takes the steps beyond the limit one by one
        let ended =
            if N::LANES > 1 { busy & !N::bits(open(&self.rows)) } else { self.is_at_end(first).into() };
        let waiting = busy & !(ready | grown | ended);
        let to_resolve = if waiting == 0 { 0 } else { self.single_steps(token, first, &bounds, waiting) };
        Waiting { ended, to_resolve: grown & !ended | to_resolve }
    }

    /// Finds where plain steps may start and end, and A L, the most by which u̇ changes over those taken at
    /// once \[m/s\].
    #[inline(always)]
    fn plain_range<N: Number>(&self, token: N::Token, first: usize, bounds: &Bounds<N>) -> (Range<N>, N) {
        let (rows, solver) = (&self.rows, self.solvers[first]);
        let branches = self.branches(first, rows.branch.load::<N>(token, first));
        let driving = N::load(token, &rows.driving, first);
        let bounded = driving + branches.look_up(token, |table| &table.damping_share) * driving;
        let length = solver.table.at_once as f64 * solver.step;
        let most = branches.look_up(token, |table| &table.plain_growth) * bounded;
        let margin = most * (0.125 * length * length);
        let [low, high] = [bounds.within[0] + margin, bounds.within[1] - margin];
        (Range { low, high, speed: bounds.speed }, most * length)
    }

    /// Takes plain steps side by side, of one wall, by the responses of its branches to the records.
    #[inline(always)]
    fn plain_in_lanes<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        range: &Range<N>,
        ready: Ready,
    ) -> N::Mask {
        let (rows, records) = (&self.rows, self.records);
        let mut ahead: [&[[f64; 2]]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead.iter_mut().enumerate() {
            let responses = records[lane].responses.as_ref();
            let responses = responses.unwrap_or_else(|| unreachable!("runs of this kind have them"));
            *ahead = responses.ahead(rows.branch.of(lane), index(rows.index[lane]));
        }
        self.plain_steps(token, first, range, ready, ROWS_AHEAD, |row| {
            N::unzip(token, |lane| ahead[lane][row])
        })
    }

    /// Takes plain steps side by side, of any walls and records, by the samples of the records.
    #[inline(always)]
    fn plain_by_samples<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        range: &Range<N>,
        ready: Ready,
    ) -> N::Mask {
        let (solvers, records) = (self.solvers, self.records);
        let at_once = solvers[first].table.at_once;
        let mut ahead = [&[0.0; AHEAD]; WIDTH];
        let mut maps = [&solvers[first].table.maps[0]; WIDTH];
        for lane in 0..WIDTH {
            ahead[lane] = records[lane].ahead(index(self.rows.index[lane]));
            maps[lane] = &solvers[lane].table.maps[self.rows.branch.of(lane)];
        }
        let mut by = [[N::splat(token, 0.0); 2]; MOST_AT_ONCE + 1];
        for (n, by) in by.iter_mut().enumerate() {
            *by = N::unzip(token, |lane| maps[lane].of_forcing[n]);
        }
        let mut p0 = N::of_lanes(token, |lane| ahead[lane][0]);
        self.plain_steps(
            token,
            first,
            range,
            ready,
            ROWS_AHEAD,
            #[inline(always)]
            |row| {
                let at = (row * at_once).min(AHEAD - MOST_AT_ONCE - 1);
                let ([p1, p2], [p3, p4]) = (pair(token, &ahead, at + 1), pair(token, &ahead, at + 3));
                let p = [p0, p1, p2, p3, p4];
                p0 = if at_once == MOST_AT_ONCE { p4 } else { p2 };
                [respond(&by, 0, p), respond(&by, 1, p)]
            },
        )
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
        let (rows, record) = (&self.rows, self.records[first]);
        let branch = rows.branch.of(first);
        let BranchTable { maps, at_once, .. } = &self.solvers[first].table;
        let (map, at_once) = (maps[branch], *at_once);
        let sample = index(rows.index[first]);
        let count = (index(rows.limit[first]) - sample).div_ceil(at_once);
        let p = record.forcing.from(sample, (count - 1) * at_once + MOST_AT_ONCE + 1);
        self.plain_steps(token, first, range, Ready { lanes: ready, stop_at: 0 }, count, |row| {
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
        Ready { lanes: ready, stop_at }: Ready,
        count: usize,
        mut response: impl FnMut(usize) -> [N; 2],
    ) -> N::Mask {
        let (rows, at_once) = (&self.rows, self.solvers[first].table.at_once);
        let branches = self.branches(first, rows.branch.load::<N>(token, first));
        let [uu, uv, u_force] = branches.look_up_all(token, |table| &table.plain_steps[0]);
        let [vu, vv, v_force] = branches.look_up_all(token, |table| &table.plain_steps[1]);
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
                let (from, count) = (reached.now.map(|x| x.lane(0)), at_once);
                self.see_steps(first, sample, from, count - 1);
                self.see(sample + count, [u.lane(0), v.lane(0)]);
            }
            steps = steps + at_once as f64;
            reached.take(goes, [u, v], steps);
            if N::bits(goes).count_ones() <= stop_at {
                break;
            }
        }
        reached.store(token, started, &mut self.rows, first);
        goes
    }

    /// Shows the observer some single steps of a lane, from u and u̇ at a sample on.
    fn see_steps(&mut self, lane: usize, sample: usize, mut now: [f64; 2], count: usize) {
        let (rows, table) = (&self.rows, &self.solvers[lane].table);
        let (branch, factor) = (rows.branch.of(lane), rows.factor[lane]);
        let map = table.one_step.map(|rows| rows.map(|row| get(&row, branch)));
        for sample in sample..sample + count {
            let q = [0, 1].map(|n| {
                factor * self.records[lane].forcing.at(sample + n) - get(&table.force_at_zero, branch)
            });
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
            if O::SEES && N::bits(arrival.lanes) != 0 && self.rows.step_taken[first] == 0.0 {
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
        let (rows, step) = (&self.rows, self.solvers[first].step);
        let branch = rows.branch.load::<N>(token, first);
        let branches = self.branches(first, branch);
        let u_by = branches.look_up_all(token, |table| &table.one_step[0]);
        let v_by = branches.look_up_all(token, |table| &table.one_step[1]);
        let line = LinearBranch::look_up(token, &branches);
        let length = N::splat(token, step);
        let furthest = self.records[first].forcing.count() - 1;
        let most =
            if N::LANES == 1 { MOST_AT_ONCE.min(furthest - index(rows.index[first])) } else { MOST_AT_ONCE };
        let mut ahead: [&[f64]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead[..N::LANES].iter_mut().enumerate() {
            let lane = (first + lane) % WIDTH;
            let (sample, forcing) = (index(rows.index[lane]), self.records[lane].forcing);
            // lanes that do not wait may be near the end of the record
            *ahead = forcing.from(sample.min(forcing.count() - 1 - most), most + 1);
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
        Part::step(leaving, branch, line, [reached.now, end], forcing, step)
    }
}
