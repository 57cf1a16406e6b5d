//! Corners passed by several lanes at once.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

use super::super::step_part::{EVEN, MOST_GUESSES, SMALL_BEND, SMALL_SHIFT};
use super::responses::Responses;
use super::table::BranchTable;
use super::vector::Branches;

/// 1/n!.
const INVERSE_FACTORIALS: [f64; 24] = {
    let mut inverse = [1.0; 24];
    let mut n = 1;
    while n < inverse.len() {
        inverse[n] = inverse[n - 1] / n as f64;
        n += 1;
    }
    inverse
};

/// A step h on which u leaves the lane's branch.
#[derive(Clone, Copy)]
pub(super) struct Leaving<S: Simd> {
    /// Lanes that take this step.
    pub(super) lanes: mask64x8<S>,
    pub(super) branch: f64x8<S>,
    /// u and u̇ at the start, and at the end if the branch went on.
    pub(super) from: [f64x8<S>; 2],
    pub(super) to: [f64x8<S>; 2],
    /// p at both ends \[m/s²\].
    pub(super) forcing: [f64x8<S>; 2],
    /// P over the block \[m/s²\].
    pub(super) forcing_bound: f64x8<S>,
    /// Where u is known to stay \[m\].
    pub(super) limits: [f64x8<S>; 2],
    /// h \[s\].
    pub(super) step: f64,
    /// |u̇| below which a wall rests after an impact \[m/s\].
    pub(super) rest_speed: f64,
}

/// The end of a step that passed a corner.
#[derive(Clone, Copy)]
pub(super) struct Arrival<S: Simd> {
    /// Lanes for which that was found.
    pub(super) lanes: mask64x8<S>,
    pub(super) end: [f64x8<S>; 2],
    pub(super) branch: f64x8<S>,
    /// Of these lanes those whose corner was a passage of u = 0.
    pub(super) passages: mask64x8<S>,
}

/// The branch of each lane: c, k, f(0) and A over P + c V + f̂.
#[derive(Clone, Copy)]
struct Law<S: Simd> {
    c: f64x8<S>,
    k: f64x8<S>,
    force_at_zero: f64x8<S>,
    growth: f64x8<S>,
}

impl<S: Simd> Law<S> {
    #[inline(always)]
    fn of(branches: &Branches<S>, table: &BranchTable) -> Self {
        Self {
            c: branches.of(&table.damping),
            k: branches.of(&table.stiffness),
            force_at_zero: branches.of(&table.force_at_zero),
            growth: branches.of(&table.growth),
        }
    }

    #[inline(always)]
    fn force(&self, u: f64x8<S>) -> f64x8<S> {
        self.force_at_zero + self.k * u
    }

    /// Returns u, u̇ and ü `time` after an instant, under a forcing that changes at `rate`: with E₀ = ü, E₁ =
    /// t d³u/dt³ and Eₙ = −c t Eₙ₋₁ − k t² Eₙ₋₂, u̇ grows by t Σ Eₙ/(n+1)! and u by t (u̇ + t Σ Eₙ/(n+2)!).
    #[inline(always)]
    fn after(&self, terms: usize, time: f64x8<S>, [u, v, a]: [f64x8<S>; 3], rate: f64x8<S>) -> [f64x8<S>; 3] {
        let Self { c, k, .. } = *self;
        let (p, q) = (-(c * time), -(k * time * time));
        // two terms at once wait for each other half as long
        let (p2, q2) = (p * p + q, p * q);
        let (mut even, mut odd) = (a, time * (rate - c * a - k * v));
        let mut sum_v = a + 0.5 * odd;
        let mut sum_u = 0.5 * a + (1.0 / 6.0) * odd;
        for n in (2..terms).step_by(2) {
            (even, odd) = (p * odd + q * even, p2 * odd + q2 * even);
            let [of_v, of_even, of_odd] = [n + 1, n + 2, n + 3].map(|n| INVERSE_FACTORIALS[n]);
            sum_v += of_v * even + of_even * odd;
            sum_u += of_even * even + of_odd * odd;
        }
        let (dv, du) = (time * sum_v, time * (v + time * sum_u));
        [u + du, v + dv, a + (rate * time - c * dv - k * du)]
    }
}

impl<S: Simd> Leaving<S> {
    /// Adds lanes that take the step.
    #[inline(always)]
    pub(super) fn take(&mut self, lanes: mask64x8<S>, to: [f64x8<S>; 2], forcing: [f64x8<S>; 2]) {
        self.lanes |= lanes;
        self.to = [lanes.select(to[0], self.to[0]), lanes.select(to[1], self.to[1])];
        self.forcing = [lanes.select(forcing[0], self.forcing[0]), lanes.select(forcing[1], self.forcing[1])];
    }

    /// Passes the one corner of the step, or the one passage of u = 0: u is monotone up to it and beyond it.
    /// Other lanes are left alone.
    #[inline(always)]
    pub(super) fn pass(self, responses: &Responses) -> Arrival<S> {
        let Self { from: [u, v], to: [to_u, to_v], forcing: [p0, p1], step, .. } = self;
        let (table, terms) = (&responses.table, responses.terms);
        let branches = Branches::new(self.branch);
        let here = Law::of(&branches, table);
        let rate = (p1 - p0) * (1.0 / step);
        let forces = [here.force(u), here.force(to_u)];
        let (a0, a1) = (p0 - here.c * v - forces[0], p1 - here.c * to_v - forces[1]);
        let steady = self.keeps_its_sign(&here, [v, to_v], forces, f64x8::splat(u.simd, step));
        let upwards = u.simd_lt(to_u);
        let corner = upwards.select(branches.of(&table.ordinary_upper), branches.of(&table.ordinary_lower));
        let rebound = upwards.select(branches.of(&table.rebound_upper), branches.of(&table.rebound_lower));
        let passes = rebound.simd_eq(rebound);
        let share = self.share(corner, [a0, a1]);
        let sought = self.lanes & steady & share.simd_gt(0.0) & share.simd_lt(1.0);
        let Passage { found, time, velocity, acceleration } =
            self.find(&here, corner, step * share, sought, [a0, rate], terms);
        let other = upwards.select(self.branch + 1.0, (self.branch - 1.0).max(0.0));
        let branch = self.lanes.select(other, self.branch);
        let branches = Branches::new(branch);
        let ahead = Law::of(&branches, table);
        let rebounding = rebound * velocity;
        let velocity = passes.select(rebounding, velocity);
        let anew = p0 + rate * time - ahead.c * velocity - ahead.force(corner);
        let acceleration = passes.select(anew, acceleration);
        let found = found & (!passes | velocity.abs().simd_ge(self.rest_speed));
        let remaining = step - time;
        let [end_u, end_v, _] = ahead.after(terms, remaining, [corner, velocity, acceleration], rate);
        let within = branches.of(&table.lower).simd_lt(end_u)
            & end_u.simd_lt(branches.of(&table.upper))
            & self.limits[0].simd_le(end_u)
            & end_u.simd_le(self.limits[1]);
        let forces = [ahead.force(corner), ahead.force(end_u)];
        let lanes = found & within & self.keeps_its_sign(&ahead, [velocity, end_v], forces, remaining);
        Arrival { lanes, end: [end_u, end_v], branch, passages: lanes & passes }
    }

    /// Finds when lanes reach the corner, and how: from a guess by the derivatives there, again from where
    /// that leads.
    #[inline(always)]
    fn find(
        &self,
        here: &Law<S>,
        corner: f64x8<S>,
        mut time: f64x8<S>,
        mut sought: mask64x8<S>,
        [a0, rate]: [f64x8<S>; 2],
        terms: usize,
    ) -> Passage<S> {
        let Self { from: [u, v], step, .. } = *self;
        let zero = f64x8::splat(time.simd, 0.0);
        let mut passage = Passage { found: sought & !sought, time: zero, velocity: zero, acceleration: zero };
        for guess in 0..MOST_GUESSES {
            let [near_u, near_v, near_a] = here.after(terms, time, [u, v, a0], rate);
            let beyond = near_u - corner;
            let jerk = rate - here.c * near_a - here.k * near_v;
            let pace = 1.0 / near_v;
            let first = -(beyond * pace);
            let bend = 0.5 * near_a * first * pace;
            let third = jerk * (first * first) * pace * (1.0 / 6.0);
            let shift = first * (1.0 - bend * (1.0 - (bend + bend)) - third);
            let next = time + shift;
            let inside = next.simd_ge(0.0) & next.simd_lt(step);
            let small = shift.abs().simd_le(SMALL_SHIFT * step) & bend.abs().simd_le(SMALL_BEND);
            let now = sought & inside & small;
            // d⁴u/dt⁴ = −c d³u/dt³ − k ü
            let snap = -(here.c * jerk) - here.k * near_a;
            let velocity = near_v + shift * (near_a + 0.5 * shift * (jerk + (1.0 / 3.0) * shift * snap));
            let acceleration = near_a + shift * (jerk + 0.5 * shift * snap);
            passage = Passage {
                found: passage.found | now,
                time: now.select(next, passage.time),
                velocity: now.select(velocity, passage.velocity),
                acceleration: now.select(acceleration, passage.acceleration),
            };
            sought = sought & inside & !small;
            if !sought.any_true() || guess + 1 == MOST_GUESSES {
                break;
            }
            time = sought.select(next, time);
        }
        passage
    }

    /// Tells the lanes whose u̇ keeps its sign between two instants: |ü| ≤ A, so that u̇ has no zero between
    /// values of one sign that are larger together than A times the time between; A of docs/record-path.md,
    /// §3, with
    /// |u̇| and |f| at both ends for V and f̂.
    #[inline(always)]
    fn keeps_its_sign(
        &self,
        law: &Law<S>,
        [v0, v1]: [f64x8<S>; 2],
        [f0, f1]: [f64x8<S>; 2],
        time: f64x8<S>,
    ) -> mask64x8<S> {
        let driving = self.forcing_bound + law.c * v0.abs().max(v1.abs()) + f0.abs().max(f1.abs());
        let most = law.growth * driving;
        (v0 * v1).simd_gt(0.0) & (most * time).simd_lt(v0.abs() + v1.abs())
    }

    /// Returns the fraction of the step after which u passes a corner: by the quintic t(u) through the ends,
    /// where the velocity does not change much.
    #[inline(always)]
    fn share(&self, corner: f64x8<S>, [a0, a1]: [f64x8<S>; 2]) -> f64x8<S> {
        let Self { from: [u, v], to: [to_u, to_v], step, .. } = *self;
        let rise = to_u - u;
        let inverse = 1.0 / rise;
        let (w0, w1) = (rise / (v * step), rise / (to_v * step));
        let bend = -0.5 * step * step * inverse;
        let (b0, b1) = (bend * a0 * (w0 * w0 * w0), bend * a1 * (w1 * w1 * w1));
        let (d, dv, db) = (1.0 - w0 - b0, w1 - w0 - (b0 + b0), b1 - b0);
        let c3 = 10.0 * d - 4.0 * dv + db;
        let c4 = 7.0 * dv - 15.0 * d - (db + db);
        let c5 = 6.0 * d - 3.0 * dv + db;
        let s = (corner - u) * inverse;
        let square = s * s;
        let quintic = s * ((w0 + s * b0) + square * ((c3 + s * c4) + square * c5));
        let even =
            w0.simd_ge(EVEN.start) & w0.simd_lt(EVEN.end) & w1.simd_ge(EVEN.start) & w1.simd_lt(EVEN.end);
        even.select(quintic, s)
    }
}

/// Lanes found to pass their corner, when, and u̇ and ü there.
#[derive(Clone, Copy)]
struct Passage<S: Simd> {
    found: mask64x8<S>,
    time: f64x8<S>,
    velocity: f64x8<S>,
    acceleration: f64x8<S>,
}
