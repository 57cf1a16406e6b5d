//! Steps on branches with constant damping: plain steps, four at once, and the single steps of lanes that
//! wait (docs/record-path.md, §2 and §3).

use crate::corners::{Line, Part};
use crate::forcing::AT_ONCE;
use crate::lanes::{Lanes, Rows, Waiting};
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

/// What bounds the motion of each lane on its branch.
#[derive(Clone, Copy)]
struct Bounds<N> {
    /// Where one step, and where steps at once, may start and end.
    range: Range<N>,
    range4: Range<N>,
    /// A h over one step and over four \[m/s\].
    change: N,
    change4: N,
    /// Where u may be: on the branch, and where it is known to stay \[m\].
    lower: N,
    upper: N,
}

/// What lanes have come to: u and u̇, their steps, and the extremes at the ends of these.
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
        self.steps = N::select(lanes, self.steps + steps, self.steps);
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
        let bounds = self.bounds::<N>(token, first);
        let [u, v] = [N::load(token, &self.rows.u, first), N::load(token, &self.rows.v, first)];
        let speed = v.abs();
        // from this speed on u̇ keeps its sign over four steps, so that u stays between its values at their
        // ends
        let steady = bounds.change4.at_most(speed)
            & speed.at_most(bounds.range4.speed)
            & bounds.lower.at_most(u)
            & u.at_most(bounds.upper);
        let open = |rows: &Rows| N::load(token, &rows.index, first).below(N::load(token, &rows.limit, first));
        let mut ready = N::bits((bounds.range4.holds([u, v]) | steady) & open(&self.rows)) & busy;
        let few = FEW.min(busy.count_ones() - 1);
        if ready.count_ones() > few {
            let goes = if N::LANES == 1 {
                self.plain_alone(token, first, &bounds, ready)
            } else if let Some(responses) = responses {
                self.plain_abreast(token, first, &bounds, (ready, few), responses)
            } else {
                N::mask(token, 0)
            };
            ready = N::bits(goes & open(&self.rows)) & busy;
        }
        let u = N::load(token, &self.rows.u, first);
        let grown = N::bits(N::load(token, &self.rows.half_reach, first).below(u.abs())) & busy & !ready;
        let mut waiting = busy & !(ready | grown);
        let mut ended = 0;
        if N::LANES > 1 {
            ended = busy & !N::bits(open(&self.rows));
            waiting &= !ended;
        } else if self.is_at_end(first) {
            (ended, waiting) = (waiting, 0);
        }
        let stuck = if waiting == 0 { 0 } else { self.single_steps(token, first, &bounds, waiting) };
        Waiting { ended, stuck: grown & !ended | stuck }
    }

    /// Finds what bounds the motion on the branch of each lane.
    #[inline(always)]
    fn bounds<N: Number>(&self, token: N::Token, first: usize) -> Bounds<N> {
        let (rows, table, step) = (&self.rows, &self.solver.table, self.solver.step);
        let branches = N::load(token, &rows.branch, first).branches();
        let look_up = |row: &BranchRow| N::look_up(token, row, branches);
        let driving = N::load(token, &rows.driving, first);
        let bounded = driving + look_up(&table.damping_share) * driving;
        let [most, most4] = [look_up(&table.growth) * bounded, look_up(&table.plain_growth) * bounded];
        let step4 = look_up(&table.at_once) * step;
        let (margin, margin4) = (most * (0.125 * step * step), most4 * (step4 * step4 * 0.125));
        let lower = look_up(&table.ends[0]).max(N::load(token, &rows.limits[0], first));
        let upper = look_up(&table.ends[1]).min(N::load(token, &rows.limits[1], first));
        let speed = look_up(&table.speed_share) * driving;
        Bounds {
            range: Range { low: lower + margin, high: upper - margin, speed },
            range4: Range { low: lower + margin4, high: upper - margin4, speed },
            change: most * step,
            change4: most4 * step4,
            lower,
            upper,
        }
    }

    /// Takes plain steps side by side, by the responses of the branches to the record.
    #[inline(always)]
    fn plain_abreast<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        bounds: &Bounds<N>,
        ready: (u8, u32),
        responses: &Responses,
    ) -> N::Mask {
        let rows = &self.rows;
        let mut ahead: [&[[f64; 2]]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead.iter_mut().enumerate() {
            let branch = index(rows.branch[lane]);
            let start = get(&responses.starts, branch);
            let at_once = index(get(&self.solver.table.at_once, branch));
            *ahead = responses.ahead(index(start), index(rows.index[lane]), at_once);
        }
        self.plain_steps(token, first, bounds, ready, ROWS_AHEAD, |row| {
            N::unzip(token, |lane| ahead[lane][row])
        })
    }

    /// Takes plain steps of one lane.
    #[inline(always)]
    fn plain_alone<N: Number>(
        &mut self,
        token: N::Token,
        first: usize,
        bounds: &Bounds<N>,
        ready: u8,
    ) -> N::Mask {
        let (rows, record) = (&self.rows, self.record);
        let branch = index(rows.branch[first]);
        let (map, at_once) = (self.solver.table.maps[branch], index(get(&self.solver.table.at_once, branch)));
        let sample = index(rows.index[first]);
        let count = (index(rows.limit[first]) - sample).div_ceil(at_once);
        let p = record.forcing.from(sample, (count - 1) * at_once + AT_ONCE + 1);
        self.plain_steps(token, first, bounds, (ready, 0), count, |row| {
            let response = map.respond(&p[row * at_once..][..=AT_ONCE]);
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
        bounds: &Bounds<N>,
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
        let at_once = N::look_up(token, &table.at_once, branches);
        let factor = N::load(token, &rows.factor, first);
        let room = N::load(token, &rows.limit, first) - N::load(token, &rows.index, first);
        let started = N::mask(token, ready);
        let mut goes = started;
        let mut reached = Reached::start(token, rows, first);
        let [mut u, mut v] = reached.now;
        for row in 0..count {
            let [of_u, of_v] = response(row);
            let next_u = u + ((factor * of_u + u_force) + (uu * u + uv * v));
            v = v + ((factor * of_v + v_force) + (vu * u + vv * v));
            u = next_u;
            goes = goes & bounds.range4.holds([u, v]) & reached.steps.below(room);
            if O::SEES && N::bits(goes) != 0 {
                let sample = index(self.rows.index[first] + reached.steps.lane(0));
                let (from, count) = (reached.now.map(|x| x.lane(0)), index(at_once.lane(0)));
                self.see_steps(first, sample, from, count - 1);
                self.see(sample + count, [u.lane(0), v.lane(0)]);
            }
            reached.take(goes, [u, v], at_once);
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
        let part = self.stay(token, first, bounds, waits, &mut reached);
        let arrival =
            if N::bits(part.lanes) == 0 { None } else { Some(self.pass_corners(token, first, part)) };
        if O::SEES {
            let sample = index(self.rows.index[first]);
            self.see_steps(first, sample, before.map(|x| x.lane(0)), index(reached.steps.lane(0)));
        }
        reached.store(token, waits, &mut self.rows, first);
        let mut none = N::bits(reached.steps.below(N::splat(token, 1.0))) & waiting;
        if let Some(arrival) = arrival {
            none &= !N::bits(arrival.lanes);
            self.arrive(token, first, &arrival);
            if O::SEES && N::bits(arrival.lanes) != 0 && self.rows.share[first] == 0.0 {
                self.see_now(first);
            }
        }
        none
    }

    /// Takes up to four steps in which lanes stay on their branch and within the limits of u, also between
    /// samples. Returns the next step of the lanes that leave their branch in it.
    #[inline(always)]
    fn stay<N: Number>(
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
        let [lower, upper] = look_up_rows::<N, _>(token, &table.ends, branches);
        let line = Line::look_up(token, table, branches);
        let eighth = 0.125 * self.solver.step * self.solver.step;
        let furthest = self.record.forcing.count() - 1;
        // lanes that do not wait may be near the end of the record
        let most = if N::LANES == 1 { AT_ONCE.min(furthest - index(rows.index[first])) } else { AT_ONCE };
        let mut ahead: [&[f64]; WIDTH] = [&[]; WIDTH];
        for (lane, ahead) in ahead[..N::LANES].iter_mut().enumerate() {
            let sample = index(rows.index[(first + lane) % WIDTH]);
            *ahead = self.record.forcing.from(sample.min(furthest - most), most + 1);
        }
        let factor = N::load(token, &rows.factor, first);
        let p = |n: usize| factor * N::of_lanes(token, |lane| ahead[lane][n]);
        let (mut from, mut p0) = (reached.now, p(0));
        let mut from_holds = bounds.range.holds(from);
        let (none, one) = (goes & !goes, N::splat(token, 1.0));
        let (mut leaving, mut end, mut forcing) = (none, from, [p0; 2]);
        for n in 1..=most {
            let p1 = p(n);
            let q = [p0 - line.force_at_zero, p1 - line.force_at_zero];
            let to = [from[0] + change(u_by, from, q), from[1] + change(v_by, from, q)];
            let to_holds = bounds.range.holds(to);
            let inside = lower.below(to[0]) & to[0].below(upper);
            let (speed0, speed1) = (from[1].abs(), to[1].abs());
            let (low, high, speed) = (from[0].min(to[0]), from[0].max(to[0]), speed0.max(speed1));
            let steady = N::splat(token, 0.0).below(from[1] * to[1])
                & bounds.change.below(speed0 + speed1)
                & bounds.lower.at_most(low)
                & high.at_most(bounds.upper);
            // the margin by |p|, |u̇| and |f| at the ends of this step, not by the bounds of its block
            let margin = line.most(p0.abs().max(p1.abs()), from, to) * eighth;
            let near = bounds.lower.at_most(low - margin) & (high + margin).at_most(bounds.upper);
            let slow = speed.at_most(bounds.range.speed);
            let stays = goes & ((from_holds & to_holds) | (slow & (near | (inside & steady))));
            let leaves = goes & !stays & !inside;
            leaving = leaving | leaves;
            end = [N::select(leaves, to[0], end[0]), N::select(leaves, to[1], end[1])];
            forcing = [N::select(leaves, p0, forcing[0]), N::select(leaves, p1, forcing[1])];
            reached.take(stays, to, one);
            goes = stays;
            if N::bits(goes) == 0 {
                break;
            }
            (from, p0, from_holds) = (to, p1, to_holds);
        }
        Part::step(leaving, branch, line, [reached.now, end], forcing, self.solver.step)
    }
}
