//! What lanes do side by side: plain steps, four at once, and the steps of those that wait.
//!
//! Lanes go on by four plain steps at once until all but one of them wait: at a corner, at the end of a
//! block, near an extreme in the search for those. Lanes pass ordinary corners and u = 0 side by side; the
//! rest is left to the run by itself. What a lane does never depends on the others.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

use super::super::forcing::AT_ONCE;
use super::corners::{Arrival, Law, Leaving};
use super::lanes::{Lanes, Rows};
use super::responses::{ROWS_AHEAD, Responses};
use super::vector::{Branches, Row, WIDTH, bits, indices, load, unzip};

/// Lanes that go on by plain steps while the others wait, at most: a round of those that wait costs as much
/// as some thirty of plain steps, however few they are.
const FEW: u32 = 1;

/// Returns the forcing `n` samples after those the lanes are at.
#[inline(always)]
fn nth<S: Simd>(simd: S, samples: [&[f64]; WIDTH], n: usize) -> f64x8<S> {
    f64x8::from_fn(simd, |i| samples[i][n])
}

/// Returns the change of u, or of u̇, by u, u̇ and q = p − f(0) at both ends of a step.
#[inline(always)]
fn change<S: Simd>(
    [by_u, by_v, by_q0, by_q1]: [f64x8<S>; 4],
    [u, v]: [f64x8<S>; 2],
    q: [f64x8<S>; 2],
) -> f64x8<S> {
    (by_q0 * q[0] + by_q1 * q[1]) + (by_u * u + by_v * v)
}

/// Where u, and between which values |u̇|, may be.
#[derive(Clone, Copy)]
struct Range<S: Simd> {
    low: f64x8<S>,
    high: f64x8<S>,
    speed: f64x8<S>,
}

impl<S: Simd> Range<S> {
    #[inline(always)]
    fn load(simd: S, [low, high]: &[Row; 2], speed: &Row) -> Self {
        Self { low: load(simd, low), high: load(simd, high), speed: load(simd, speed) }
    }

    /// Tells the lanes whose plain steps may start or end so.
    #[inline(always)]
    fn holds(&self, [u, v]: [f64x8<S>; 2]) -> mask64x8<S> {
        self.low.simd_le(u) & u.simd_le(self.high) & v.abs().simd_le(self.speed)
    }
}

/// What lanes have come to: u and u̇, their steps, and the extremes at the ends of these.
#[derive(Clone, Copy)]
struct Reached<S: Simd> {
    now: [f64x8<S>; 2],
    steps: f64x8<S>,
    highest: f64x8<S>,
    lowest: f64x8<S>,
}

impl<S: Simd> Reached<S> {
    #[inline(always)]
    fn start(simd: S, rows: &Rows) -> Self {
        let now = [load(simd, &rows.u), load(simd, &rows.v)];
        let highest = load(simd, &rows.highest).max(now[0]);
        let lowest = load(simd, &rows.lowest).min(now[0]);
        Self { now, steps: f64x8::splat(simd, 0.0), highest, lowest }
    }

    /// Goes to the ends of steps where lanes took them, and notes the extremes there.
    #[inline(always)]
    fn take(&mut self, lanes: mask64x8<S>, [u, v]: [f64x8<S>; 2], steps: f64x8<S>) {
        self.now = [lanes.select(u, self.now[0]), lanes.select(v, self.now[1])];
        self.steps = lanes.select(steps, self.steps);
        self.highest = self.highest.max(self.now[0]);
        self.lowest = self.lowest.min(self.now[0]);
    }

    /// Enters what these lanes have come to; returns the samples of all.
    #[inline(always)]
    fn store(self, lanes: mask64x8<S>, rows: &mut Rows) -> f64x8<S> {
        let simd = self.steps.simd;
        self.now[0].store_array(&mut rows.u);
        self.now[1].store_array(&mut rows.v);
        lanes.select(self.highest, load(simd, &rows.highest)).store_array(&mut rows.highest);
        lanes.select(self.lowest, load(simd, &rows.lowest)).store_array(&mut rows.lowest);
        let index = load(simd, &rows.index) + self.steps;
        index.store_array(&mut rows.index);
        index
    }
}

/// What lanes wait for, by their bits.
#[derive(Clone, Copy)]
struct Waiting {
    /// Lanes that may take plain steps.
    ready: u8,
    /// Lanes at the end of a block.
    ended: u8,
    /// Lanes whose u has grown beyond half the reach of f̂.
    grown: u8,
}

/// Lists lanes by their bits.
fn each(bits: u8) -> impl Iterator<Item = usize> {
    (0..WIDTH).filter(move |i| bits >> i & 1 == 1)
}

impl Lanes<'_> {
    /// Follows all runs to their ends.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(&mut self, simd: S) {
        (0..WIDTH).for_each(|i| self.fill(i));
        while self.busy != 0 {
            let mut lanes = self.measure_ranges(simd);
            if lanes.ready.count_ones() > self.few() {
                lanes = self.plain(simd, lanes.ready);
            }
            let Waiting { ready, ended, grown } = lanes;
            each(ended).for_each(|i| self.go_alone(i, false));
            let waiting = self.busy & !(ready | ended);
            each(waiting & grown).for_each(|i| self.bound_force(i));
            let waiting = waiting & !grown;
            if waiting != 0 {
                let none = self.step(simd, waiting);
                each(none).for_each(|i| self.go_alone(i, true));
            }
        }
    }

    /// Returns the number of lanes that are not worth going on for.
    fn few(&self) -> u32 {
        FEW.min(self.busy.count_ones().saturating_sub(1))
    }

    /// Finds where lanes may go, and which of them may take plain steps.
    #[inline(always)]
    fn measure_ranges<S: Simd>(&mut self, simd: S) -> Waiting {
        let step = self.solver.step;
        let rows = &mut self.rows;
        let table = &self.responses.table;
        let branches = Branches::new(load(simd, &rows.branch));
        let driving = load(simd, &rows.driving);
        let bounded = driving + branches.of(&table.damping_share) * driving;
        let [most, most4] = [branches.of(&table.growth) * bounded, branches.of(&table.growth4) * bounded];
        let step4 = AT_ONCE as f64 * step;
        let (margin, margin4) = (0.125 * step * step * most, 0.125 * step4 * step4 * most4);
        let lower = branches.of(&table.lower).max(load(simd, &rows.limits[0]));
        let upper = branches.of(&table.upper).min(load(simd, &rows.limits[1]));
        let speed = branches.of(&table.speed_share) * driving;
        let range4 = Range { low: lower + margin4, high: upper - margin4, speed };
        (lower + margin).store_array(&mut rows.range[0]);
        (upper - margin).store_array(&mut rows.range[1]);
        range4.low.store_array(&mut rows.range4[0]);
        range4.high.store_array(&mut rows.range4[1]);
        speed.store_array(&mut rows.speed);
        (step * most).store_array(&mut rows.velocity_change);
        let (u, v) = (load(simd, &rows.u), load(simd, &rows.v));
        // as fast as that, u̇ keeps its sign over four steps: then u is between its values at their ends
        let steady =
            v.abs().simd_ge(step4 * most4) & v.abs().simd_le(speed) & lower.simd_le(u) & u.simd_le(upper);
        let ready = range4.holds([u, v]) | steady;
        let index = load(simd, &rows.index);
        self.sort(u, index, ready)
    }

    /// Tells which lanes may go on, and which wait for what.
    #[inline(always)]
    fn sort<S: Simd>(&self, u: f64x8<S>, index: f64x8<S>, ready: mask64x8<S>) -> Waiting {
        let open = index.simd_lt(load(u.simd, &self.rows.limit));
        Waiting {
            ready: bits(ready & open) & self.busy,
            ended: bits(!open) & self.busy,
            grown: bits(load(u.simd, &self.rows.half_reach).simd_lt(u.abs())),
        }
    }

    /// Takes plain steps, four at once, until all lanes but a few wait.
    ///
    /// Lanes that wait are taken along, and what they come to is not kept: so no step waits for a comparison.
    #[inline(always)]
    fn plain<S: Simd>(&mut self, simd: S, ready: u8) -> Waiting {
        let few = self.few();
        let Responses { table, .. } = self.responses;
        let rows = &mut self.rows;
        let branches = Branches::new(load(simd, &rows.branch));
        let start = load(simd, &rows.index);
        let room = load(simd, &rows.limit) - start;
        let (samples, first_rows) = (indices(start), indices(branches.of(&table.response)));
        let ahead: [&[[f64; 2]]; WIDTH] =
            std::array::from_fn(|i| self.responses.ahead(first_rows[i], samples[i]));
        let [[uu, uv, u_force], [vu, vv, v_force]] =
            [branches.of_each(&table.four_steps[0]), branches.of_each(&table.four_steps[1])];
        let factor = load(simd, &rows.factor);
        let range = Range::load(simd, &rows.range4, &rows.speed);
        let started = mask64x8::from_bitmask(simd, ready.into());
        let mut goes = started;
        let mut reached = Reached::start(simd, rows);
        let [mut u, mut v] = reached.now;
        let mut steps = reached.steps;
        #[allow(clippy::needless_range_loop, reason = "eight tables at once")]
        for row in 0..ROWS_AHEAD {
            let [of_u, of_v] = unzip(simd, std::array::from_fn(|i| &ahead[i][row]));
            let next_u = u + ((factor * of_u + u_force) + (uu * u + uv * v));
            v = v + ((factor * of_v + v_force) + (vu * u + vv * v));
            u = next_u;
            goes = goes & range.holds([u, v]) & steps.simd_lt(room);
            steps += AT_ONCE as f64;
            reached.take(goes, [u, v], steps);
            if bits(goes).count_ones() <= few {
                break;
            }
        }
        let index = reached.store(started, rows);
        self.sort(reached.now[0], index, goes)
    }

    /// Takes one to four steps of lanes that wait, the last of them past corners if need be; tells which made
    /// none.
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, waiting: u8) -> u8 {
        let waits = mask64x8::from_bitmask(simd, waiting.into());
        let mut reached = Reached::start(simd, &self.rows);
        let leaving = self.stay(waits, &mut reached);
        if leaving.lanes.any_true() {
            let Arrival { lanes, end, branch, corners, passages } = leaving.pass(self.responses);
            reached.take(lanes, end, reached.steps + 1.0);
            let rows = &mut self.rows;
            branch.store_array(&mut rows.branch);
            (load(simd, &rows.corners) + corners).store_array(&mut rows.corners);
            (load(simd, &rows.impacts) + passages).store_array(&mut rows.impacts);
            let crossings = load(simd, &rows.crossings);
            lanes.select(crossings + 1.0, crossings).store_array(&mut rows.crossings);
        }
        reached.store(waits, &mut self.rows);
        bits(reached.steps.simd_lt(1.0)) & waiting
    }

    /// Takes up to four steps on which lanes stay on their branch and pass no extreme that counts; tells
    /// which would leave it in the next one.
    #[inline(always)]
    fn stay<S: Simd>(&self, mut goes: mask64x8<S>, reached: &mut Reached<S>) -> Leaving<S> {
        let simd = reached.steps.simd;
        let (rows, table) = (&self.rows, &self.responses.table);
        let branch = load(simd, &rows.branch);
        let branches = Branches::new(branch);
        let [u_by, v_by] = [branches.of_each(&table.one_step[0]), branches.of_each(&table.one_step[1])];
        let (lower, upper) = (branches.of(&table.lower), branches.of(&table.upper));
        let law = Law::of(&branches, table);
        let limits = [load(simd, &rows.limits[0]), load(simd, &rows.limits[1])];
        let range = Range::load(simd, &rows.range, &rows.speed);
        let velocity_change = load(simd, &rows.velocity_change);
        let eighth = 0.125 * self.solver.step * self.solver.step;
        // lanes that do not wait may be near the end
        let furthest = self.record.forcing.count() - 1 - AT_ONCE;
        let samples = indices(load(simd, &rows.index))
            .map(|index| self.record.forcing.from(index.min(furthest), AT_ONCE + 1));
        let factor = load(simd, &rows.factor);
        let (mut from, mut p0) = (reached.now, factor * nth(simd, samples, 0));
        let mut from_holds = range.holds(from);
        let mut leaving = Leaving {
            lanes: goes & !goes,
            branch,
            from,
            to: from,
            forcing: [p0; 2],
            forcing_bound: load(simd, &rows.forcing),
            limits,
            step: self.solver.step,
            rest_speed: self.solver.motion.rest_speed,
        };
        for n in 1..=AT_ONCE {
            let p1 = factor * nth(simd, samples, n);
            let q = [p0 - law.force_at_zero, p1 - law.force_at_zero];
            let to = [from[0] + change(u_by, from, q), from[1] + change(v_by, from, q)];
            let to_holds = range.holds(to);
            let inside = lower.simd_lt(to[0]) & to[0].simd_lt(upper);
            let (speed0, speed1) = (from[1].abs(), to[1].abs());
            let (low, high, speed) = (from[0].min(to[0]), from[0].max(to[0]), speed0.max(speed1));
            let steady = (from[1] * to[1]).simd_gt(0.0)
                & velocity_change.simd_lt(speed0 + speed1)
                & limits[0].simd_le(low)
                & high.simd_le(limits[1]);
            // by |p|, |u̇| and |f| at the ends of the step itself
            let force = law.force(from[0]).abs().max(law.force(to[0]).abs());
            let most = law.growth * (p0.abs().max(p1.abs()) + law.c * speed + force);
            let margin = eighth * most;
            let near =
                lower.max(limits[0]).simd_le(low - margin) & (high + margin).simd_le(upper.min(limits[1]));
            let slow = speed.simd_le(range.speed);
            let stays = goes & ((from_holds & to_holds) | (slow & (near | (inside & steady))));
            let leaves = goes & !stays & !inside;
            leaving.take(leaves, to, [p0, p1]);
            reached.take(stays, to, reached.steps + 1.0);
            goes = stays;
            if !goes.any_true() {
                break;
            }
            (from, p0, from_holds) = (to, p1, to_holds);
        }
        leaving.from = reached.now;
        leaving
    }
}
