//! Corners passed by several lanes at once.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

use super::super::step_part::{EVEN, MOST_GUESSES, SMALL_BEND, SMALL_SHIFT};
use super::responses::Responses;
use super::table::BranchTable;
use super::vector::Branches;

/// Corners of one step that are passed here.
const MOST_CORNERS: u32 = 4;

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

/// The end of a step that passed corners.
#[derive(Clone, Copy)]
pub(super) struct Arrival<S: Simd> {
    /// Lanes for which that was found.
    pub(super) lanes: mask64x8<S>,
    pub(super) end: [f64x8<S>; 2],
    pub(super) branch: f64x8<S>,
    /// The corners passed, and of these the passages of u = 0.
    pub(super) corners: f64x8<S>,
    pub(super) passages: f64x8<S>,
}

impl<S: Simd> Arrival<S> {
    /// Adds lanes whose last part ends the step.
    #[inline(always)]
    fn take(&mut self, lanes: mask64x8<S>, part: &Part<S>, corners: u32) {
        self.lanes |= lanes;
        let [u, v, _] = part.to;
        self.end = [lanes.select(u, self.end[0]), lanes.select(v, self.end[1])];
        self.branch = lanes.select(part.branch, self.branch);
        self.corners = lanes.select(f64x8::splat(u.simd, f64::from(corners)), self.corners);
        self.passages = lanes.select(part.passages, self.passages);
    }
}

/// A part of a step, along the branch that each lane is on.
#[derive(Clone, Copy)]
struct Part<S: Simd> {
    /// Lanes that have come to it.
    lanes: mask64x8<S>,
    branch: f64x8<S>,
    law: Law<S>,
    /// u, u̇ and ü at its start, and at its end if the branch goes on.
    from: [f64x8<S>; 3],
    to: [f64x8<S>; 3],
    length: f64x8<S>,
    /// p at its start \[m/s²\].
    forcing: f64x8<S>,
    /// Passages of u = 0 before it.
    passages: f64x8<S>,
}

/// The branch of each lane: c, k, f(0) and A over P + c V + f̂.
#[derive(Clone, Copy)]
pub(super) struct Law<S: Simd> {
    pub(super) c: f64x8<S>,
    k: f64x8<S>,
    pub(super) force_at_zero: f64x8<S>,
    pub(super) growth: f64x8<S>,
}

impl<S: Simd> Law<S> {
    #[inline(always)]
    pub(super) fn of(branches: &Branches<S>, table: &BranchTable) -> Self {
        Self {
            c: branches.of(&table.damping),
            k: branches.of(&table.stiffness),
            force_at_zero: branches.of(&table.force_at_zero),
            growth: branches.of(&table.growth),
        }
    }

    #[inline(always)]
    pub(super) fn force(&self, u: f64x8<S>) -> f64x8<S> {
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
            let [of_v, of_even, of_odd] =
                [INVERSE_FACTORIALS[n + 1], INVERSE_FACTORIALS[n + 2], INVERSE_FACTORIALS[n + 3]];
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

    /// Passes the corners of the step as long as u is monotone up to each and beyond it. Other lanes are left
    /// alone.
    #[inline(always)]
    pub(super) fn pass(self, responses: &Responses) -> Arrival<S> {
        let Self { lanes, branch, from: [u, v], to: [to_u, to_v], forcing: [p0, p1], step, .. } = self;
        let (zero, length) = (f64x8::splat(u.simd, 0.0), f64x8::splat(u.simd, step));
        let law = Law::of(&Branches::new(branch), &responses.table);
        let (a0, a1) = (p0 - law.c * v - law.force(u), p1 - law.c * to_v - law.force(to_u));
        let (from, to) = ([u, v, a0], [to_u, to_v, a1]);
        let mut part = Part { lanes, branch, law, from, to, length, forcing: p0, passages: zero };
        let (end, none) = (self.to, lanes & !lanes);
        let mut arrival = Arrival { lanes: none, end, branch, corners: zero, passages: zero };
        let rate = (p1 - p0) * (1.0 / step);
        part.lanes &= part.keeps_its_sign(self.forcing_bound);
        for corners in 1..=MOST_CORNERS {
            part = self.cross(&part, rate, responses);
            part.lanes &= part.keeps_its_sign(self.forcing_bound);
            let (u, branches) = (part.to[0], Branches::new(part.branch));
            let inside = branches.of(&responses.table.lower).simd_lt(u)
                & u.simd_lt(branches.of(&responses.table.upper));
            let known = self.limits[0].simd_le(u) & u.simd_le(self.limits[1]);
            arrival.take(part.lanes & inside & known, &part, corners);
            part.lanes &= !inside;
            if !part.lanes.any_true() {
                break;
            }
        }
        arrival
    }

    /// Goes on beyond the corner by which lanes leave their branch, where it is found and is ordinary or a
    /// passage of u = 0.
    #[inline(always)]
    fn cross(&self, part: &Part<S>, rate: f64x8<S>, responses: &Responses) -> Part<S> {
        let (table, terms) = (&responses.table, responses.terms);
        let branches = Branches::new(part.branch);
        let upwards = part.from[0].simd_lt(part.to[0]);
        let corner = upwards.select(branches.of(&table.ordinary_upper), branches.of(&table.ordinary_lower));
        let rebound = upwards.select(branches.of(&table.rebound_upper), branches.of(&table.rebound_lower));
        let passes = rebound.simd_eq(rebound);
        let Passage { found, time, velocity, acceleration } = part.find(corner, rate, terms);
        let other = upwards.select(part.branch + 1.0, (part.branch - 1.0).max(0.0));
        let branch = part.lanes.select(other, part.branch);
        let law = Law::of(&Branches::new(branch), table);
        let rebounding = rebound * velocity;
        let velocity = passes.select(rebounding, velocity);
        let forcing = part.forcing + rate * time;
        let anew = forcing - law.c * velocity - law.force(corner);
        let from = [corner, velocity, passes.select(anew, acceleration)];
        let length = part.length - time;
        Part {
            lanes: found & (!passes | velocity.abs().simd_ge(self.rest_speed)),
            branch,
            law,
            from,
            to: law.after(terms, length, from, rate),
            length,
            forcing,
            passages: passes.select(part.passages + 1.0, part.passages),
        }
    }
}

impl<S: Simd> Part<S> {
    /// Finds when lanes reach the corner, and how: from a guess by the derivatives there, again from where
    /// that leads.
    #[inline(always)]
    fn find(&self, corner: f64x8<S>, rate: f64x8<S>, terms: usize) -> Passage<S> {
        let Self { lanes, law: here, from, length, .. } = *self;
        let share = self.share(corner);
        let mut sought = lanes & share.simd_gt(0.0) & share.simd_lt(1.0);
        let mut time = length * share;
        let zero = f64x8::splat(time.simd, 0.0);
        let mut passage = Passage { found: sought & !sought, time: zero, velocity: zero, acceleration: zero };
        for guess in 0..MOST_GUESSES {
            let [near_u, near_v, near_a] = here.after(terms, time, from, rate);
            let beyond = near_u - corner;
            let jerk = rate - here.c * near_a - here.k * near_v;
            let pace = 1.0 / near_v;
            let first = -(beyond * pace);
            let bend = 0.5 * near_a * first * pace;
            let third = jerk * (first * first) * pace * (1.0 / 6.0);
            let shift = first * (1.0 - bend * (1.0 - (bend + bend)) - third);
            let next = time + shift;
            let inside = next.simd_ge(0.0) & next.simd_lt(length);
            let small = shift.abs().simd_le(SMALL_SHIFT * length) & bend.abs().simd_le(SMALL_BEND);
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

    /// Tells the lanes whose u̇ keeps its sign. As |ü| ≤ A, u̇ has no zero between values of one sign that
    /// are larger together than A times the length. A is that of docs/record-path.md, §3, with |u̇| and |f|
    /// at both ends for V and f̂.
    #[inline(always)]
    fn keeps_its_sign(&self, forcing_bound: f64x8<S>) -> mask64x8<S> {
        let Self { law, from: [u0, v0, _], to: [u1, v1, _], length, .. } = *self;
        let force = law.force(u0).abs().max(law.force(u1).abs());
        let most = law.growth * (forcing_bound + law.c * v0.abs().max(v1.abs()) + force);
        (v0 * v1).simd_gt(0.0) & (most * length).simd_lt(v0.abs() + v1.abs())
    }

    /// Returns the fraction of the length after which u passes a corner: by the quintic t(u) through the
    /// ends, where the velocity does not change much.
    #[inline(always)]
    fn share(&self, corner: f64x8<S>) -> f64x8<S> {
        let Self { from: [u, v, a0], to: [to_u, to_v, a1], length, .. } = *self;
        let rise = to_u - u;
        let inverse = 1.0 / rise;
        let (w0, w1) = (rise / (v * length), rise / (to_v * length));
        let bend = -0.5 * length * length * inverse;
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
