//! Parts of steps on branches with secant damping, one Taylor series each (docs/record-path.md, §7).

use rocking_wall::solver::secant::{
    ByRatio, ByStiffness, ORDER, Scaled, SecantBranch, SecantLaw, Start, excess,
};

use crate::branches::law;
use crate::lanes::{Lanes, Rows, Waiting, each};
use crate::number::{BranchRow, LaneRow, Number, WIDTH, index};
use crate::numbering::BranchExit;
use crate::regularised::Regularised;
use crate::run::Observer;
use crate::solver::RecordSolver;
use crate::table::{BranchTable, Law, get};

/// The largest change of u in a part, over |u|, of eight lanes. Up to it the terms of a series fall fast
/// enough to end at its order.
const LARGEST_CHANGE: f64 = 0.2;
/// Factors on the next change where the series reached, and where it did not: of eight lanes, and of one.
const LONGER: [f64; 2] = [1.1, 1.3];
const SHORTER: [f64; 2] = [0.7, 0.6];
/// The change at and below which a lane waits for its run to go on by itself.
const SHORTEST: f64 = 1e-3;
/// Most lanes that wait while the others go on.
const WAITING: u32 = 1;
/// Most parts before lanes that wait are served.
const MOST_PARTS: usize = 256;
/// The change from which on a regularised series costs less, as measured.
const FAST: f64 = 0.1;

/// The series of one run by itself, of any order.
pub(crate) trait OneLane: SecantLaw {
    /// The largest change of u over |u| of one series.
    const FARTHEST: f64;

    /// Returns u/u₀ − 1 and L u̇/u₀ at the end of a part; `None` where no series reaches.
    fn end(start: Start<f64>, most: f64) -> Option<[f64; 2]>;
}

/// Returns the end of a part by order 8 or 10; `None` where these leave out too much.
#[inline(always)]
fn end_to_10<L: SecantLaw>(series: &mut Scaled<f64>, most: f64) -> Option<[f64; 2]> {
    series.extend_to_8::<L>();
    if excess::<f64, 8>(series.last::<8>(), most) <= 0.0 {
        return Some(series.end::<8>());
    }
    series.extend_to_10::<L>();
    (excess::<f64, 10>(series.last::<10>(), most) <= 0.0).then(|| series.end::<10>())
}

impl OneLane for ByRatio {
    const FARTHEST: f64 = f64::MAX;

    #[inline(always)]
    fn end(start: Start<f64>, most: f64) -> Option<[f64; 2]> {
        if start.velocity.abs() < FAST
            && let Some(end) = end_to_10::<Self>(&mut Scaled::new(start), most)
        {
            return Some(end);
        }
        Regularised::new(start).end(most)
    }
}

impl OneLane for ByStiffness {
    const FARTHEST: f64 = 0.3;

    #[inline(always)]
    fn end(start: Start<f64>, most: f64) -> Option<[f64; 2]> {
        let mut series = Scaled::new(start);
        if let Some(end) = end_to_10::<Self>(&mut series, most) {
            return Some(end);
        }
        series.extend_to_12::<Self>();
        if excess::<f64, 12>(series.last::<12>(), most) <= 0.0 {
            return Some(series.end::<12>());
        }
        series.extend_to_16::<Self>();
        (excess::<f64, ORDER>(series.last::<ORDER>(), most) <= 0.0).then(|| series.end::<ORDER>())
    }
}

/// Returns u/u₀ − 1 and L u̇/u₀ at the end of a part, and the lanes for which the series reach.
#[inline(always)]
fn end_of_part<N: Number, L: OneLane>(token: N::Token, start: Start<N>, most: N) -> ([N; 2], N::Mask) {
    if N::LANES == 1 {
        let start = Start {
            velocity: start.velocity.lane(0),
            driving: start.driving.lane(0),
            rate: start.rate.lane(0),
            half_kappa: start.half_kappa.lane(0),
            stiffness: start.stiffness.lane(0),
            damping: start.damping.lane(0),
        };
        let end = L::end(start, most.lane(0));
        let [u, v] = end.unwrap_or_default();
        return ([N::splat(token, u), N::splat(token, v)], N::mask(token, u8::from(end.is_some())));
    }
    let mut series = Scaled::new(start);
    series.extend_to_8::<L>();
    series.extend_to_10::<L>();
    let within = excess::<N, 10>(series.last::<10>(), most).at_most(N::splat(token, 0.0));
    (series.end::<10>(), within)
}

/// What lanes have come to on their branches.
#[derive(Clone, Copy)]
struct Reached<N> {
    now: [N; 2],
    /// Extremes of u at the ends of parts, and the largest |u̇| at their starts.
    highest: N,
    lowest: N,
    fastest: N,
    /// The share of the step taken already.
    step_taken: N,
    /// The change of u in the next part, over |u|.
    next_change: N,
}

impl<N: Number> Reached<N> {
    #[inline(always)]
    fn load(token: N::Token, rows: &Rows, first: usize) -> Self {
        let load = |row| N::load(token, row, first);
        let u = load(&rows.u);
        Self {
            now: [u, load(&rows.v)],
            highest: load(&rows.highest).max(u),
            lowest: load(&rows.lowest).min(u),
            fastest: load(&rows.fastest),
            step_taken: load(&rows.step_taken),
            next_change: load(&rows.next_change),
        }
    }

    #[inline(always)]
    fn store(self, rows: &mut Rows, first: usize) {
        self.now[0].store(&mut rows.u, first);
        self.now[1].store(&mut rows.v, first);
        self.highest.store(&mut rows.highest, first);
        self.lowest.store(&mut rows.lowest, first);
        self.fastest.store(&mut rows.fastest, first);
        self.step_taken.store(&mut rows.step_taken, first);
        self.next_change.store(&mut rows.next_change, first);
    }
}

/// What bounds the motion of lanes on their branches.
#[derive(Clone, Copy)]
struct Bounds<N> {
    driving: N,
    damping: N,
    growth: N,
    /// Where u may be \[m\].
    lower: N,
    upper: N,
}

impl<N: Number> Bounds<N> {
    /// Finds the lanes whose u stays where it may be over a length (docs/record-path.md, Eq. (8)).
    #[inline(always)]
    fn hold(&self, [u, v]: [N; 2], length: N) -> N::Mask {
        let (zero, speed) = (u.like(0.0), v.abs());
        // A L, and how far u may get from a straight line
        let change = self.growth * (self.driving + self.damping * speed) * length;
        let (line, margin) = (u + length * v, change * length * 0.5);
        // beyond that speed u̇ keeps its sign, so that u does not go back
        let steady = change.below(speed);
        let low = N::select(steady & zero.below(v), u, u.min(line) - margin);
        let high = N::select(steady & v.below(zero), u, u.max(line) + margin);
        self.lower.at_most(low) & high.at_most(self.upper)
    }
}

impl<O: Observer> Lanes<'_, O> {
    /// Takes parts of steps of the lanes from `first` on, until some wait; returns these.
    #[inline(always)]
    pub(crate) fn take_parts<N: Number, L: OneLane>(
        &mut self,
        token: N::Token,
        first: usize,
        busy: u8,
    ) -> Waiting {
        let (h, tolerances) = (self.solvers[first].step, self.tolerances::<N>(token, first));
        let (law, bounds) = self.laws::<N>(token, first);
        let mut reached = Reached::<N>::load(token, &self.rows, first);
        let (zero, one) = (N::splat(token, 0.0), N::splat(token, 1.0));
        let (farthest, longer, shorter) = if N::LANES == 1 {
            (L::FARTHEST, LONGER[1], SHORTER[1])
        } else {
            (LARGEST_CHANGE, LONGER[0], SHORTER[0])
        };
        let farthest = N::splat(token, farthest);
        reached.next_change = reached.next_change.min(farthest);
        // p at both ends of the step
        let mut ends = [[0.0; WIDTH]; 2];
        let mut ended = 0;
        for lane in each(busy) {
            ended |= u8::from(!self.take_forcing(first + lane, lane, &mut ends)) << lane;
        }
        let mut goes = N::mask(token, busy & !ended);
        for _ in 0..MOST_PARTS {
            let Reached { now: [u, v], step_taken, next_change, .. } = reached;
            let (rest, speed) = (-step_taken + 1.0, v.abs());
            // the share of u by which it changes in all of the step
            let whole = speed * h / u.abs();
            let most = rest.min(next_change / whole.max(N::splat(token, f64::MIN_POSITIVE)));
            let length = most * h;
            let fits = bounds.hold([u, v], length);
            let [p0, p1] = [N::load(token, &ends[0], 0), N::load(token, &ends[1], 0)];
            let forcing = [p0 + (p1 - p0) * step_taken, (p1 - p0) * most];
            let (start, inverse) = law.start::<L>([u, v], forcing, length);
            let (end, within) = end_of_part::<N, L>(token, start, tolerances.over(inverse, length));
            let taken = goes & fits & within;
            // also where the sum rounds to the whole step
            let finished = taken & (rest.at_most(most) | one.at_most(step_taken + most));
            let now = [N::select(taken, u + u * end[0], u), N::select(taken, u / length * end[1], v)];
            let change_then = N::select(
                taken,
                (next_change * longer).min(farthest),
                next_change.min(whole * most) * shorter,
            );
            reached = Reached {
                now,
                highest: reached.highest.max(now[0]),
                lowest: reached.lowest.min(now[0]),
                fastest: reached.fastest.max(N::select(taken, speed, zero)),
                step_taken: N::select(taken, N::select(finished, zero, step_taken + most), step_taken),
                // a lane that waits is as it was
                next_change: N::select(goes, change_then, next_change),
            };
            goes = goes & fits & N::splat(token, SHORTEST).below(reached.next_change);
            for lane in each(N::bits(finished)) {
                self.rows.index[first + lane] += 1.0;
                if O::SEES {
                    self.see(index(self.rows.index[first]), now.map(|number| number.lane(0)));
                }
                ended |= u8::from(!self.take_forcing(first + lane, lane, &mut ends)) << lane;
            }
            goes = goes & !N::mask(token, ended);
            if (busy & !N::bits(goes)).count_ones() > WAITING.min(busy.count_ones() - 1) {
                break;
            }
        }
        reached.store(&mut self.rows, first);
        Waiting { ended, to_resolve: busy & !N::bits(goes) & !ended }
    }

    /// Enters p at both ends of a lane's step; returns whether its block has one more step.
    #[inline(always)]
    fn take_forcing(&self, lane: usize, place: usize, ends: &mut [LaneRow; 2]) -> bool {
        if self.is_at_end(lane) {
            return false;
        }
        let samples = self.records[lane].forcing.from(index(self.rows.index[lane]), 2);
        for (row, sample) in ends.iter_mut().zip(samples) {
            row[place] = self.rows.factor[lane] * sample;
        }
        true
    }

    /// Looks up the law and the bounds of the branch of each lane.
    #[inline(always)]
    fn laws<N: Number>(&self, token: N::Token, first: usize) -> (SecantBranch<N>, Bounds<N>) {
        let rows = &self.rows;
        // one lane after the other, for any number of branches: this is not done often
        let look_up = |row: fn(&BranchTable) -> &BranchRow| {
            N::of_lanes(token, |lane| {
                let lane = (first + lane) % WIDTH;
                get(row(&self.solvers[lane].table), rows.branch.of(lane))
            })
        };
        let load = |row| N::load(token, row, first);
        let bounds = Bounds {
            driving: load(&rows.driving),
            damping: look_up(|table| &table.damping),
            growth: look_up(|table| &table.growth),
            lower: look_up(|table| &table.ends[0]).max(load(&rows.limits[0])),
            upper: look_up(|table| &table.ends[1]).min(load(&rows.limits[1])),
        };
        (law(look_up), bounds)
    }

    /// Takes a lane along a branch with a constant ratio to the end of the step or to the corner ahead, where
    /// u̇ keeps its sign until then; returns whether it does. With stiffness-proportional damping this would
    /// save little: the general search takes such steps.
    pub(crate) fn pass_curved_corner(&mut self, lane: usize) -> bool {
        self.solvers[lane].table.law == Law::Ratio && self.follow_to_corner(lane).is_some()
    }

    fn follow_to_corner(&mut self, lane: usize) -> Option<()> {
        let (rows, solver) = (&self.rows, self.solvers[lane]);
        let RecordSolver { table, step, .. } = solver;
        let (u, v, step_taken) = (rows.u[lane], rows.v[lane], rows.step_taken[lane]);
        let branch = rows.branch.of(lane);
        let side = usize::from(v > 0.0);
        let corner = get(&table.ends[side], branch);
        let rest = (1.0 - step_taken) * step;
        let samples = self.records[lane].forcing.from(index(rows.index[lane]), 2);
        let [p0, p1] = [samples[0], samples[1]].map(|p| rows.factor[lane] * p);
        let law = law(|row| get(row(table), branch));
        let (forcing, rate) = (p0 + (p1 - p0) * step_taken, (p1 - p0) / step);
        let (start, inverse) = law.start::<ByRatio>([u, v], [forcing, rate * rest], rest);
        let tolerance = solver.motion.tolerances().over(inverse, rest);
        let [part, velocity] = Regularised::new(start).passage((corner - u) * inverse, tolerance)?;
        let step_taken = step_taken + part * (1.0 - step_taken);
        let (end, finished) = if step_taken < 1.0 {
            ([corner, u / rest * velocity], false)
        } else {
            let [rise, velocity] = ByRatio::end(start, tolerance)?;
            ([u + u * rise, u / rest * velocity], true)
        };
        let known = rows.limits[0][lane] <= end[0] && end[0] <= rows.limits[1][lane];
        let is_open = matches!(table.exit(branch, side), BranchExit::Ordinary | BranchExit::Curved);
        if !known || !(finished || is_open) {
            return None;
        }
        let rows = &mut self.rows;
        [rows.u[lane], rows.v[lane]] = end;
        if finished {
            (rows.step_taken[lane], rows.index[lane]) = (0.0, rows.index[lane] + 1.0);
            self.see_now(lane);
        } else {
            rows.step_taken[lane] = step_taken;
            rows.branch.set(lane, if side == 1 { branch + 1 } else { branch - 1 });
            rows.corners[lane] += 1.0;
        }
        Some(())
    }
}
