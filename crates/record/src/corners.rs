//! Corners passed in a step, as long as u̇ keeps its sign (docs/record-path.md, §4).

use crate::lanes::{Lanes, Waiting};
use crate::number::{BranchRow, Number, Row, index};
use crate::solver::{Observer, RecordSolver};
use crate::table::{Table, exit};

/// Most corners passed in one step.
const MOST_CORNERS: u32 = 4;
/// Largest correction δ of a first guess, over the length of the part.
const SMALL_SHIFT: f64 = 1e-4;
/// Largest ü δ/(2 u̇) of the last correction. It is larger only where u all but turns at the corner.
const SMALL_BEND: f64 = 1e-4;
/// Most evaluations of the motion to find a corner.
const MOST_GUESSES: u32 = 4;
/// Ratios of the mean velocity of a passage to those at its ends between which a quintic is close to t(u).
const EVEN: [f64; 2] = [0.3, 3.0];

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

/// The line of the branch of each lane, ü = p − c u̇ − f(0) − k u, and γ over a step.
#[derive(Clone, Copy)]
pub(crate) struct Line<N> {
    c: N,
    k: N,
    pub(crate) force_at_zero: N,
    growth: N,
}

impl<N: Number> Line<N> {
    #[inline(always)]
    pub(crate) fn look_up(token: N::Token, table: &Table, branches: N::Branches) -> Self {
        let look_up = |row: &BranchRow| N::look_up(token, row, branches);
        Self {
            c: look_up(&table.damping),
            k: look_up(&table.stiffness),
            force_at_zero: look_up(&table.force_at_zero),
            growth: look_up(&table.growth),
        }
    }

    #[inline(always)]
    fn force(&self, u: N) -> N {
        self.force_at_zero + self.k * u
    }

    #[inline(always)]
    fn acceleration(&self, [u, v]: [N; 2], forcing: N) -> N {
        forcing - self.c * v - self.force(u)
    }

    /// Returns A, the bound on |ü| between two instants, by the largest |p| and by |u̇| and |f| there.
    #[inline(always)]
    pub(crate) fn most(&self, forcing: N, from: [N; 2], to: [N; 2]) -> N {
        let force = self.force(from[0]).abs().max(self.force(to[0]).abs());
        self.growth * (forcing + self.c * from[1].abs().max(to[1].abs()) + force)
    }

    /// Returns u, u̇ and ü `time` after an instant, under a forcing that changes at `rate`: with E₀ = ü, E₁ =
    /// t d³u/dt³ and Eₙ = −c t Eₙ₋₁ − k t² Eₙ₋₂, u̇ grows by t Σ Eₙ/(n+1)! and u by t (u̇ + t Σ Eₙ/(n+2)!).
    #[inline(always)]
    fn after(&self, terms: usize, time: N, [u, v, a]: [N; 3], rate: N) -> [N; 3] {
        let Self { c, k, .. } = *self;
        let (p, q) = (-(c * time), -(k * time * time));
        // two terms at a time: the chain of terms that depend on each other is half as long
        let (p2, q2) = (p * p + q, p * q);
        let (mut even, mut odd) = (a, time * (rate - c * a - k * v));
        let mut sum_v = a + odd * 0.5;
        let mut sum_u = a * 0.5 + odd * (1.0 / 6.0);
        for n in (2..terms).step_by(2) {
            (even, odd) = (p * odd + q * even, p2 * odd + q2 * even);
            let [of_v, of_even, of_odd] =
                [INVERSE_FACTORIALS[n + 1], INVERSE_FACTORIALS[n + 2], INVERSE_FACTORIALS[n + 3]];
            sum_v = sum_v + (even * of_v + odd * of_even);
            sum_u = sum_u + (even * of_even + odd * of_odd);
        }
        let (dv, du) = (time * sum_v, time * (v + time * sum_u));
        [u + du, v + dv, a + (rate * time - c * dv - k * du)]
    }
}

/// A part of a step, along the branch that each lane is on.
#[derive(Clone, Copy)]
pub(crate) struct Part<N: Number> {
    /// Lanes that have come to it.
    pub(crate) lanes: N::Mask,
    branch: N,
    line: Line<N>,
    /// u, u̇ and ü at its start, and at its end if the branch goes on.
    from: [N; 3],
    to: [N; 3],
    /// Its length \[s\].
    length: N,
    /// p at its start \[m/s²\], and the rate of p \[m/s³\].
    forcing: N,
    rate: N,
    /// Passages of u = 0 before it.
    impacts: N,
}

/// Where lanes have come to, past corners.
#[derive(Clone, Copy)]
pub(crate) struct Arrival<N: Number> {
    pub(crate) lanes: N::Mask,
    end: [N; 2],
    branch: N,
    /// The corners passed, and of these the passages of u = 0.
    corners: N,
    impacts: N,
    /// What is left of the step \[s\].
    left: N,
}

impl<N: Number> Arrival<N> {
    #[inline(always)]
    fn take(&mut self, lanes: N::Mask, part: &Part<N>, [u, v, _]: [N; 3], corners: u32, left: N) {
        self.lanes = self.lanes | lanes;
        self.end = [N::select(lanes, u, self.end[0]), N::select(lanes, v, self.end[1])];
        self.branch = N::select(lanes, part.branch, self.branch);
        self.corners = N::select(lanes, u.like(f64::from(corners)), self.corners);
        self.impacts = N::select(lanes, part.impacts, self.impacts);
        self.left = N::select(lanes, left, self.left);
    }
}

impl<N: Number> Part<N> {
    /// Returns a whole step on one branch.
    #[inline(always)]
    pub(crate) fn step(
        lanes: N::Mask,
        branch: N,
        line: Line<N>,
        [from, to]: [[N; 2]; 2],
        [p0, p1]: [N; 2],
        step: f64,
    ) -> Self {
        let (a0, a1) = (line.acceleration(from, p0), line.acceleration(to, p1));
        let (from, to) = ([from[0], from[1], a0], [to[0], to[1], a1]);
        let (length, rate) = (p0.like(step), (p1 - p0) * (1.0 / step));
        Self { lanes, branch, line, from, to, length, forcing: p0, rate, impacts: p0.like(0.0) }
    }

    /// Finds the lanes whose u̇ keeps its sign, and those in which u leaves its chord by a margin at most
    /// (docs/record-path.md, §3), with |u̇| and |f| at both ends for V and f̂.
    #[inline(always)]
    fn keeps_its_sign(&self, most_forcing: N) -> (N::Mask, N) {
        let Self { line, from: [u0, v0, _], to: [u1, v1, _], length, .. } = *self;
        let change = line.most(most_forcing, [u0, v0], [u1, v1]) * length;
        let keeps = v0.like(0.0).below(v0 * v1) & change.below(v0.abs() + v1.abs());
        (keeps, change * length * 0.125)
    }

    /// Finds when lanes reach a corner, and u̇ there: a guess is corrected by the derivatives at its time,
    /// again and again until the correction is small (docs/record-path.md, Eq. (4)).
    #[inline(always)]
    fn find(&self, corner: N, terms: usize) -> (N::Mask, N, N) {
        let Self { lanes, line, from, length, rate, .. } = *self;
        let share = self.share(corner);
        let zero = corner.like(0.0);
        let mut sought = lanes & zero.below(share) & share.below(zero + 1.0);
        let mut time = length * share;
        let (mut found, mut found_time, mut found_velocity) = (sought & !sought, zero, zero);
        for guess in 0..MOST_GUESSES {
            let [u, v, a] = line.after(terms, time, from, rate);
            let jerk = rate - line.c * a - line.k * v;
            let pace = zero.like(1.0) / v;
            let first = -((u - corner) * pace);
            let bend = a * 0.5 * first * pace;
            let third = jerk * (first * first) * pace * (1.0 / 6.0);
            let shift = first * (-(bend * (-(bend + bend) + 1.0)) + 1.0 - third);
            let next = time + shift;
            let inside = zero.at_most(next) & next.below(length);
            let small = shift.abs().at_most(length * SMALL_SHIFT) & bend.abs().at_most(zero + SMALL_BEND);
            let now = sought & inside & small;
            // d⁴u/dt⁴ = −c d³u/dt³ − k ü
            let snap = -(line.c * jerk) - line.k * a;
            let velocity = v + shift * (a + shift * 0.5 * (jerk + shift * snap * (1.0 / 3.0)));
            found = found | now;
            found_time = N::select(now, next, found_time);
            found_velocity = N::select(now, velocity, found_velocity);
            sought = sought & inside & !small;
            if N::bits(sought) == 0 || guess + 1 == MOST_GUESSES {
                break;
            }
            time = N::select(sought, next, time);
        }
        (found, found_time, found_velocity)
    }

    /// Returns the fraction of the length after which u passes a corner: by the quintic t(u) through the
    /// ends, where the velocity does not change much.
    #[inline(always)]
    fn share(&self, corner: N) -> N {
        let Self { from: [u, v, a0], to: [to_u, to_v, a1], length, .. } = *self;
        let rise = to_u - u;
        let inverse = rise.like(1.0) / rise;
        let (w0, w1) = (rise / (v * length), rise / (to_v * length));
        // dt/du and d²t/du² = −ü/u̇³, for t over the length and u over the rise
        let bend = length * length * inverse * -0.5;
        let (b0, b1) = (bend * a0 * (w0 * w0 * w0), bend * a1 * (w1 * w1 * w1));
        let (d, dv, db) = (-w0 + 1.0 - b0, w1 - w0 - (b0 + b0), b1 - b0);
        let c3 = d * 10.0 - dv * 4.0 + db;
        let c4 = dv * 7.0 - d * 15.0 - (db + db);
        let c5 = d * 6.0 - dv * 3.0 + db;
        let s = (corner - u) * inverse;
        let square = s * s;
        let quintic = s * ((w0 + s * b0) + square * ((c3 + s * c4) + square * c5));
        let [low, high] = [u.like(EVEN[0]), u.like(EVEN[1])];
        let even = low.at_most(w0) & w0.below(high) & low.at_most(w1) & w1.below(high);
        N::select(even, quintic, s)
    }
}

impl<O: Observer> Lanes<'_, O> {
    /// Goes through the corners of a step as long as u̇ keeps its sign.
    #[inline(always)]
    pub(crate) fn pass_corners<N: Number>(
        &self,
        token: N::Token,
        first: usize,
        mut part: Part<N>,
    ) -> Arrival<N> {
        let (rows, table) = (&self.rows, &self.solver.table);
        let lowest = N::load(token, &rows.limits[0], first);
        let highest = N::load(token, &rows.limits[1], first);
        let most_forcing = N::load(token, &rows.forcing, first);
        let zero = N::splat(token, 0.0);
        let (end, none) = ([zero; 2], part.lanes & !part.lanes);
        let mut arrival =
            Arrival { lanes: none, end, branch: part.branch, corners: zero, impacts: zero, left: zero };
        for corners in 0..=MOST_CORNERS {
            if corners > 0 {
                let curved;
                (part, curved) = self.cross(token, &part);
                if N::bits(curved) != 0 {
                    arrival.take(curved, &part, part.from, corners, part.length);
                }
            }
            let (keeps, margin) = part.keeps_its_sign(most_forcing);
            if corners == 0 && N::LANES > 1 {
                // steps side by side are whole ones that leave the branch
                part.lanes = part.lanes & keeps;
                continue;
            }
            let (u, branches) = (part.to[0], part.branch.branches());
            let lower = N::look_up(token, &table.ends[0], branches).max(lowest);
            let upper = N::look_up(token, &table.ends[1], branches).min(highest);
            let inside = lower.below(u) & u.below(upper);
            let (low, high) = (u.min(part.from[0]) - margin, u.max(part.from[0]) + margin);
            let near = lower.at_most(low) & high.at_most(upper);
            arrival.take(part.lanes & inside & (keeps | near), &part, part.to, corners, zero);
            part.lanes = part.lanes & keeps & !inside;
            if N::bits(part.lanes) == 0 || corners == MOST_CORNERS {
                break;
            }
        }
        arrival
    }

    /// Goes on beyond the corner by which lanes leave their branch, where it is found and open. Returns the
    /// lanes that have come to a branch with secant damping, too: their part ends there.
    #[inline(always)]
    fn cross<N: Number>(&self, token: N::Token, part: &Part<N>) -> (Part<N>, N::Mask) {
        let (table, zero) = (&self.solver.table, N::splat(token, 0.0));
        let branches = part.branch.branches();
        let upwards = part.from[0].below(part.to[0]);
        let side = |rows: &[BranchRow; 2]| {
            N::select(upwards, N::look_up(token, &rows[1], branches), N::look_up(token, &rows[0], branches))
        };
        let (corner, exit) = (side(&table.ends), side(&table.exits));
        let (found, time, velocity) = part.find(corner, table.terms);
        let is = |kind: f64| (zero + (kind - 0.5)).below(exit) & exit.below(zero + (kind + 0.5));
        let impact = is(exit::IMPACT);
        let velocity = N::select(impact, velocity * self.solver.passage_factor, velocity);
        let rest_speed = zero + self.solver.motion.rest_speed();
        let lanes =
            found & (is(exit::ORDINARY) | is(exit::CURVED) | (impact & rest_speed.at_most(velocity.abs())));
        let other = N::select(upwards, part.branch + 1.0, (part.branch + -1.0).max(zero));
        let branch = N::select(lanes, other, part.branch);
        let line = Line::look_up(token, table, branch.branches());
        let forcing = part.forcing + part.rate * time;
        let from = [corner, velocity, line.acceleration([corner, velocity], forcing)];
        let length = part.length - time;
        let to = line.after(table.terms, length, from, part.rate);
        let impacts = part.impacts + N::select(lanes & impact, zero + 1.0, zero);
        let curved = lanes & is(exit::CURVED);
        let lanes = lanes & !is(exit::CURVED);
        (Part { lanes, branch, line, from, to, length, forcing, impacts, ..*part }, curved)
    }

    /// Stores in the rows where lanes have come to.
    #[inline(always)]
    pub(crate) fn arrive<N: Number>(&mut self, token: N::Token, first: usize, arrival: &Arrival<N>) {
        let Arrival { lanes, end, branch, corners, impacts, left } = *arrival;
        let (rows, zero) = (&mut self.rows, N::splat(token, 0.0));
        let share = -(left * (1.0 / self.solver.step)) + 1.0;
        // a remainder below the rounding of the share counts as none
        let whole = left.at_most(zero) | (zero + 1.0).at_most(share);
        let put = |row: &mut Row, value: N| {
            N::select(lanes, value, N::load(token, row, first)).store(row, first);
        };
        put(&mut rows.u, end[0]);
        put(&mut rows.v, end[1]);
        put(&mut rows.branch, branch);
        put(&mut rows.share, N::select(whole, zero, share));
        let index = N::load(token, &rows.index, first);
        put(&mut rows.index, N::select(whole, index + 1.0, index));
        let counted = N::load(token, &rows.corners, first) + corners;
        put(&mut rows.corners, counted);
        let counted = N::load(token, &rows.impacts, first) + impacts;
        put(&mut rows.impacts, counted);
    }

    /// Takes the rest of a step of a lane that came to its branch within the step.
    #[inline(always)]
    pub(crate) fn rest_of_step<N: Number>(&mut self, token: N::Token, first: usize) -> Waiting {
        let (rows, RecordSolver { table, step, .. }) = (&self.rows, self.solver);
        let load = |row| N::load(token, row, first);
        let (branch, share) = (load(&rows.branch), load(&rows.share));
        let line = Line::look_up(token, table, branch.branches());
        let samples = self.record.forcing.from(index(rows.index[first]), 2);
        let [p0, p1] = [load(&rows.factor) * samples[0], load(&rows.factor) * samples[1]];
        let (length, rate) = (load(&rows.share) * -step + *step, (p1 - p0) * (1.0 / step));
        let now = [load(&rows.u), load(&rows.v)];
        let forcing = p0 + (p1 - p0) * share;
        let from = [now[0], now[1], line.acceleration(now, forcing)];
        let to = line.after(table.terms, length, from, rate);
        let (lanes, impacts) = (N::mask(token, 1), N::splat(token, 0.0));
        let part = Part { lanes, branch, line, from, to, length, forcing, rate, impacts };
        let arrival = self.pass_corners(token, first, part);
        self.arrive(token, first, &arrival);
        let stuck = 1 & !N::bits(arrival.lanes);
        if O::SEES && self.rows.share[first] == 0.0 && stuck == 0 {
            self.see_now(first);
        }
        Waiting { ended: 0, stuck }
    }
}

#[cfg(test)]
mod tests;
