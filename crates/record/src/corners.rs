//! Corners passed in a step, as long as u̇ keeps its sign up to each (docs/record-path.md, §4).

use crate::lanes::{Lanes, Waiting};
use crate::line::{Bounds, Course, LinearBranch};
use crate::number::{BranchRow, LaneRow, Number, index};
use crate::numbering::{Exits, LaneBranch};
use crate::run::Observer;
use crate::solver::RecordSolver;
use crate::table::BranchTable;

/// Most corners passed in one step.
const MOST_CORNERS: u32 = 4;
/// Largest correction δ of the last guess, over the length of the part.
const SMALL_SHIFT: f64 = 1e-4;
/// Largest ü δ/(2 u̇) of the last correction. It is larger only where u all but turns at the corner.
const SMALL_BEND: f64 = 1e-4;
/// Most evaluations of the motion to find a corner.
const MOST_GUESSES: u32 = 4;

/// A part of a step, along the branch that each lane is on.
#[derive(Clone, Copy)]
pub(crate) struct Part<N: Number> {
    /// Lanes that have come to it.
    pub(crate) lanes: N::Mask,
    pub(crate) branch: LaneBranch<N>,
    pub(crate) line: LinearBranch<N>,
    /// u, u̇ and ü at its start, and u and u̇ at its end if the branch goes on.
    pub(crate) from: [N; 3],
    pub(crate) to: [N; 2],
    /// Its length \[s\].
    pub(crate) length: N,
    /// p at its start \[m/s²\], and the rate of p \[m/s³\].
    pub(crate) forcing: N,
    pub(crate) rate: N,
    /// Passages of u = 0 before it.
    pub(crate) impacts: N,
}

/// Where lanes have come to, past corners.
#[derive(Clone, Copy)]
pub(crate) struct Arrival<N: Number> {
    pub(crate) lanes: N::Mask,
    end: [N; 2],
    branch: LaneBranch<N>,
    /// The corners passed, and of these the passages of u = 0.
    corners: N,
    impacts: N,
    /// What is left of the step \[s\].
    left: N,
}

impl<N: Number> Arrival<N> {
    #[inline(always)]
    pub(crate) fn none(part: &Part<N>) -> Self {
        let (lanes, zero) = (part.lanes & !part.lanes, part.length.like(0.0));
        Self { lanes, end: [zero; 2], branch: part.branch, corners: zero, impacts: zero, left: zero }
    }

    #[inline(always)]
    pub(crate) fn take(&mut self, lanes: N::Mask, part: &Part<N>, [u, v]: [N; 2], corners: u32, left: N) {
        self.lanes = self.lanes | lanes;
        self.end = [N::select(lanes, u, self.end[0]), N::select(lanes, v, self.end[1])];
        self.branch = LaneBranch::select(lanes, part.branch, self.branch);
        self.corners = N::select(lanes, u.like(f64::from(corners)), self.corners);
        self.impacts = N::select(lanes, part.impacts, self.impacts);
        self.left = N::select(lanes, left, self.left);
    }
}

/// The corner by which each lane leaves its branch \[m\], and how.
#[derive(Clone, Copy)]
pub(crate) struct Ahead<N> {
    pub(crate) corner: N,
    exits: Exits<N>,
}

/// When lanes pass a corner, and u̇ there; `found` are those in which that is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passage<N: Number> {
    pub(crate) found: N::Mask,
    pub(crate) time: N,
    pub(crate) velocity: N,
}

impl<N: Number> Part<N> {
    /// Returns a whole step on one branch.
    #[inline(always)]
    pub(crate) fn step(
        lanes: N::Mask,
        branch: LaneBranch<N>,
        line: LinearBranch<N>,
        [from, to]: [[N; 2]; 2],
        [p0, p1]: [N; 2],
        step: f64,
    ) -> Self {
        let from = [from[0], from[1], line.acceleration(from, p0)];
        let (length, rate) = (p0.like(step), (p1 - p0) * (1.0 / step));
        Self { lanes, branch, line, from, to, length, forcing: p0, rate, impacts: p0.like(0.0) }
    }

    /// Finds where u goes in the part.
    #[inline(always)]
    fn course(&self, bounds: &Bounds<N>) -> Course<N::Mask> {
        let Self { line, from, to, length, forcing, rate, .. } = *self;
        let forcing = forcing.abs().max((forcing + rate * length).abs());
        line.course([from[0], from[1]], to, forcing, length, bounds)
    }

    /// Finds when lanes whose u̇ keeps its sign reach a corner, and u̇ there.
    #[inline(always)]
    fn find(&self, corner: N, terms: usize) -> Passage<N> {
        let sought = self.lanes & (self.from[0].below(corner) | corner.below(self.from[0]));
        self.find_near(sought, self.guess(corner), corner, terms)
    }

    /// Finds when u passes a corner, and u̇ there: a guess is corrected by the derivatives at its time, again
    /// and again until the correction is small (docs/record-path.md, Eq. (4)).
    #[inline(always)]
    pub(crate) fn find_near(&self, mut sought: N::Mask, mut time: N, corner: N, terms: usize) -> Passage<N> {
        let Self { line, from, length, rate, .. } = *self;
        let zero = corner.like(0.0);
        let (mut found, mut found_time, mut found_velocity) = (sought & !sought, zero, zero);
        for _ in 0..MOST_GUESSES {
            let [u, v, a] = line.after(terms, time, from, rate);
            let jerk = rate - line.c * a - line.k * v;
            let pace = zero.like(1.0) / v;
            let first = -((u - corner) * pace);
            let bend = a * 0.5 * first * pace;
            let third = jerk * (first * first) * pace * (1.0 / 6.0);
            let shift = first * (-(bend * (-(bend + bend) + 1.0)) + 1.0 - third);
            let next = time + shift;
            let inside = zero.at_most(next) & next.below(length);
            let small = shift.abs().at_most(length * SMALL_SHIFT) & bend.abs().at_most(zero.like(SMALL_BEND));
            let now = sought & inside & small;
            // d⁴u/dt⁴ = −c d³u/dt³ − k ü
            let snap = -(line.c * jerk) - line.k * a;
            let velocity = v + shift * (a + shift * 0.5 * (jerk + shift * snap * (1.0 / 3.0)));
            found = found | now;
            found_time = N::select(now, next, found_time);
            found_velocity = N::select(now, velocity, found_velocity);
            sought = sought & inside & !small;
            if N::bits(sought) == 0 {
                break;
            }
            time = N::select(sought, next, time);
        }
        Passage { found, time: found_time, velocity: found_velocity }
    }

    /// Returns about when u reaches a corner: by constant ü, and then by the jerk at the start.
    #[inline(always)]
    fn guess(&self, corner: N) -> N {
        let Self { line, from: [u, v, a], length, rate, .. } = *self;
        let (zero, ahead) = (corner.like(0.0), corner - u);
        let speed = (v * v + (a + a) * ahead).max(zero).sqrt();
        let time = (ahead + ahead).abs() / (v.abs() + speed);
        let jerk = rate - line.c * a - line.k * v;
        let late = jerk * (time * time * time) * (1.0 / 6.0) / (v + a * time);
        (time - late).max(zero).min(length)
    }
}

impl<O: Observer> Lanes<'_, O> {
    /// Takes a part that leaves its branch through the corner ahead, and through others, up to the end of the
    /// step.
    #[inline(always)]
    pub(crate) fn pass_corners<N: Number>(
        &self,
        token: N::Token,
        first: usize,
        mut part: Part<N>,
    ) -> Arrival<N> {
        let (terms, zero) = (self.solvers[first].table.terms, N::splat(token, 0.0));
        let mut arrival = Arrival::none(&part);
        for corners in 1..=MOST_CORNERS {
            if N::bits(part.lanes) == 0 {
                break;
            }
            let curved;
            let ahead = self.ahead(token, first, &part);
            let passage = part.find(ahead.corner, terms);
            (part, curved) = self.cross(token, first, &part, ahead, passage);
            if N::bits(curved) != 0 {
                arrival.take(curved, &part, [part.from[0], part.from[1]], corners, part.length);
            }
            let Course { stays, leaves } = part.course(&self.bounds(token, first, part.branch));
            arrival.take(part.lanes & stays, &part, part.to, corners, zero);
            part.lanes = part.lanes & leaves;
        }
        arrival
    }

    /// Returns the corner by which lanes leave their branch, and how they do.
    #[inline(always)]
    pub(crate) fn ahead<N: Number>(&self, token: N::Token, first: usize, part: &Part<N>) -> Ahead<N> {
        let branches = self.branches(first, part.branch);
        let upwards = part.from[0].below(part.to[0]);
        let at = |row: fn(&BranchTable) -> &[BranchRow; 2]| {
            let [lower, upper] = branches.look_up_all(token, row);
            N::select(upwards, upper, lower)
        };
        Ahead { corner: at(|table| &table.ends), exits: Exits::of(at(|table| &table.exits)) }
    }

    /// Goes on beyond the corner ahead, where it is found and open, from the time and u̇ there. Returns the
    /// lanes that have come to a branch with secant damping, too: their part ends there.
    #[inline(always)]
    pub(crate) fn cross<N: Number>(
        &self,
        token: N::Token,
        first: usize,
        part: &Part<N>,
        Ahead { corner, exits }: Ahead<N>,
        Passage { found, time, velocity }: Passage<N>,
    ) -> (Part<N>, N::Mask) {
        let (rows, zero) = (&self.rows, N::splat(token, 0.0));
        let upwards = part.from[0].below(part.to[0]);
        let (impact, ordinary) = (exits.by_impact(), exits.at_ordinary_corner());
        let [down, up] = rows.passage_factors.each_ref().map(|row| N::load(token, row, first));
        let velocity = N::select(impact, velocity * N::select(upwards, up, down), velocity);
        let rest_speed = N::load(token, &rows.rest_speed, first);
        let lanes = found & (ordinary | (impact & rest_speed.at_most(velocity.abs())));
        let branch = LaneBranch::select(lanes, part.branch.next(upwards), part.branch);
        let line = LinearBranch::look_up(token, &self.branches(first, branch));
        let forcing = part.forcing + part.rate * time;
        let from = [corner, velocity, line.acceleration([corner, velocity], forcing)];
        let length = part.length - time;
        let [u, v, _] = line.after(self.solvers[first].table.terms, length, from, part.rate);
        let impacts = part.impacts + N::select(lanes & impact, N::splat(token, 1.0), zero);
        let curved = lanes & exits.to_curved();
        let lanes = lanes & !curved;
        (Part { lanes, branch, line, from, to: [u, v], length, forcing, impacts, ..*part }, curved)
    }

    /// Stores in the rows where lanes have come to.
    #[inline(always)]
    pub(crate) fn arrive<N: Number>(&mut self, token: N::Token, first: usize, arrival: &Arrival<N>) {
        let Arrival { lanes, end, branch, corners, impacts, left } = *arrival;
        let (rows, zero) = (&mut self.rows, N::splat(token, 0.0));
        let step_taken = -(left * (1.0 / self.solvers[first].step)) + 1.0;
        // a remainder below the rounding of the share counts as none
        let whole = left.at_most(zero) | N::splat(token, 1.0).at_most(step_taken);
        let put = |row: &mut LaneRow, value: N| {
            N::select(lanes, value, N::load(token, row, first)).store(row, first);
        };
        put(&mut rows.u, end[0]);
        put(&mut rows.v, end[1]);
        // u may have turned past its corner: the margin of the block counts from this end
        let highest = N::load(token, &rows.highest, first).max(end[0]);
        put(&mut rows.highest, highest);
        let lowest = N::load(token, &rows.lowest, first).min(end[0]);
        put(&mut rows.lowest, lowest);
        put(&mut rows.step_taken, N::select(whole, zero, step_taken));
        let branch = LaneBranch::select(lanes, branch, rows.branch.load(token, first));
        rows.branch.store(branch, first);
        let index = N::load(token, &rows.index, first);
        put(&mut rows.index, N::select(whole, index + 1.0, index));
        let counted = N::load(token, &rows.corners, first) + corners;
        put(&mut rows.corners, counted);
        let counted = N::load(token, &rows.impacts, first) + impacts;
        put(&mut rows.impacts, counted);
    }

    /// Returns what is left of the step of a lane, on the branch that it is on.
    #[inline(always)]
    pub(crate) fn rest<N: Number>(&self, token: N::Token, first: usize) -> Part<N> {
        let (rows, RecordSolver { table, step, .. }) = (&self.rows, self.solvers[first]);
        let load = |row| N::load(token, row, first);
        let (branch, step_taken) = (rows.branch.load(token, first), load(&rows.step_taken));
        let line = LinearBranch::look_up(token, &self.branches(first, branch));
        let samples = self.records[first].forcing.from(index(rows.index[first]), 2);
        let [p0, p1] = [load(&rows.factor) * samples[0], load(&rows.factor) * samples[1]];
        let (length, rate) = (load(&rows.step_taken) * -step + *step, (p1 - p0) * (1.0 / step));
        let now = [load(&rows.u), load(&rows.v)];
        let forcing = p0 + (p1 - p0) * step_taken;
        let from = [now[0], now[1], line.acceleration(now, forcing)];
        let [u, v, _] = line.after(table.terms, length, from, rate);
        let (lanes, zero) = (N::mask(token, 1), N::splat(token, 0.0));
        Part { lanes, branch, line, from, to: [u, v], length, forcing, rate, impacts: zero }
    }

    /// Takes the rest of a step of a lane that came to its branch within the step.
    #[inline(always)]
    pub(crate) fn rest_of_step<N: Number>(&mut self, token: N::Token, first: usize) -> Waiting {
        let (part, zero) = (self.rest(token, first), N::splat(token, 0.0));
        let bounds = self.bounds(token, first, part.branch);
        let Course { stays, leaves } = part.course(&bounds);
        let mut arrival = self.pass_corners(token, first, Part { lanes: leaves, ..part });
        arrival.take(stays, &part, part.to, 0, zero);
        self.arrive(token, first, &arrival);
        let to_resolve = 1 & !N::bits(arrival.lanes);
        if O::SEES && self.rows.step_taken[first] == 0.0 && to_resolve == 0 {
            self.see_now(first);
        }
        Waiting { ended: 0, to_resolve }
    }
}

#[cfg(test)]
mod tests;
