//! Runs of walls with secant damping, side by side on the branches that have it.
//!
//! Each lane goes along its branch by parts of steps, one Taylor series at a time: as long as the series of
//! the common order reach, and as no corner or extreme can be met. What is more than that is left to the run
//! by itself: the elastic branch, corners, the ends of blocks. What a lane does never depends on the others.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

use super::super::super::scaled::{Number, Scaled, Start};
use super::super::super::secant::{LEAST, SecantBranch};
use super::super::super::tolerances::{CAUTION, Tolerances};
use super::super::active_run::{ActiveRun, CurvedValues, PlainSteps};
use super::super::block::Nodes;
use super::super::forcing::Blocks;
use super::super::solver::{Outcome, RecordSolver, RunStart};
use super::vector::{Row, WIDTH, bits, load};
use crate::solver::SolverError;

/// The way of a part, as a share of |u|: there the terms of a series fall fast enough to end at its order.
const REACH: f64 = 0.2;
/// By which the next way is longer where the series reached, and shorter where it did not.
const LONGER: f64 = 1.1;
const SHORTER: f64 = 0.7;
/// The way so short that the run goes on by itself.
const SHORTEST: f64 = 1e-3;
/// Lanes that wait while the others go on.
const WAITING: u32 = 1;
/// Parts between two looks at what waits.
const MOST_PARTS: usize = 256;

/// Runs side by side.
pub(super) struct CurvedLanes<'a> {
    solver: &'a RecordSolver<'a>,
    record: &'a Blocks<'a>,
    until_overturning: bool,
    starts: &'a [RunStart],
    /// The next start to take up.
    next: usize,
    /// The run of each lane, its number, the sample it is at, and the first at which it waits.
    runs: [Option<ActiveRun<'a>>; WIDTH],
    numbers: [usize; WIDTH],
    samples: [usize; WIDTH],
    ends: [usize; WIDTH],
    rows: Rows,
    /// Lanes that have a run.
    busy: u8,
    outcomes: Vec<Option<Outcome>>,
    /// The first run that could not be followed.
    failure: Option<(usize, SolverError)>,
}

/// The lanes' numbers while they go side by side.
#[derive(Default)]
#[repr(align(64))]
struct Rows {
    factor: Row,
    u: Row,
    v: Row,
    /// Extremes of u at the ends of parts, and the largest |u̇|.
    highest: Row,
    lowest: Row,
    fastest: Row,
    /// The share of the step taken already, and the largest way of a part.
    share: Row,
    reach: Row,
    /// p at both ends of the step \[m/s²\].
    forcing: [Row; 2],
    limits: [Row; 2],
    driving: Row,
    damping: Row,
    growth: Row,
    law: SecantRows,
}

/// The law of the branch of each lane; of its own line, of which c is made, anchor, force and slope.
#[derive(Default)]
struct SecantRows {
    anchor: Row,
    force: Row,
    stiffness: Row,
    own: [Row; 3],
    force_at_zero: Row,
    factor: Row,
}

impl Rows {
    fn enter(&mut self, i: usize, values: &CurvedValues) {
        [self.u[i], self.v[i]] = values.now;
        (self.highest[i], self.lowest[i]) = (values.nodes.highest, values.nodes.lowest);
        (self.fastest[i], self.share[i], self.reach[i]) = (0.0, values.share, 0.5 * REACH);
        [self.limits[0][i], self.limits[1][i]] = values.limits;
        (self.driving[i], self.damping[i], self.growth[i]) = (values.driving, values.damping, values.growth);
        let SecantBranch { anchor, force, stiffness, own, force_at_zero, factor, .. } = values.secant;
        let law = &mut self.law;
        for (row, number) in law.own.iter_mut().zip([own.anchor, own.force, own.slope]) {
            row[i] = number;
        }
        (law.anchor[i], law.force[i], law.stiffness[i]) = (anchor, force, stiffness);
        (law.force_at_zero[i], law.factor[i]) = (force_at_zero, factor);
    }
}

impl<S: Simd> Number for f64x8<S> {}

impl<'a> CurvedLanes<'a> {
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        record: &'a Blocks<'a>,
        starts: &'a [RunStart],
        until_overturning: bool,
    ) -> Self {
        Self {
            solver,
            record,
            until_overturning,
            starts,
            next: 0,
            runs: [const { None }; WIDTH],
            numbers: [0; WIDTH],
            samples: [0; WIDTH],
            ends: [0; WIDTH],
            rows: Rows::default(),
            busy: 0,
            outcomes: vec![None; starts.len()],
            failure: None,
        }
    }

    /// Follows all runs to their ends; `RATIO` tells c = 2ξ ω.
    ///
    /// # Errors
    /// Of the first run that could not be followed.
    #[inline(always)]
    pub(super) fn follow<S: Simd, const RATIO: bool>(mut self, simd: S) -> Result<Vec<Outcome>, SolverError> {
        (0..WIDTH).for_each(|i| self.fill(i));
        while self.busy != 0 {
            let waiting = self.take_parts::<S, RATIO>(simd);
            (0..WIDTH).filter(|i| waiting >> i & 1 == 1).for_each(|i| self.go_alone(i));
        }
        match self.failure {
            Some((_, error)) => Err(error),
            None => Ok(self.outcomes.into_iter().flatten().collect()),
        }
    }

    /// Gives a lane the next run that comes to a branch with secant damping, if there is one.
    fn fill(&mut self, i: usize) {
        self.busy &= !(1 << i);
        while let Some(&start) = self.starts.get(self.next) {
            let plain = PlainSteps { parts: true, ..PlainSteps::PAIRS };
            let run = ActiveRun::new(self.solver, self.record, self.until_overturning, plain, start);
            (self.runs[i], self.numbers[i]) = (Some(run), self.next);
            self.rows.factor[i] = start.factor;
            self.next += 1;
            if self.advance(i, false) {
                self.busy |= 1 << i;
                return;
            }
        }
    }

    /// Lets the run of a lane go on by itself, by one step at least unless its block has ended, until it may
    /// go side by side again; where it ends the lane gets another.
    fn go_alone(&mut self, i: usize) {
        let rows = &self.rows;
        let sample = self.samples[i];
        if let Some(run) = &mut self.runs[i] {
            let nodes = Nodes { highest: rows.highest[i], lowest: rows.lowest[i] };
            run.resume_curved((sample, rows.share[i]), [rows.u[i], rows.v[i]], nodes, rows.fastest[i]);
        }
        if !self.advance(i, sample < self.ends[i]) {
            self.fill(i);
        }
    }

    /// Lets a run go by itself until it may go side by side; tells whether that comes before its end.
    fn advance(&mut self, i: usize, step: bool) -> bool {
        let Some(run) = &mut self.runs[i] else { return false };
        let number = self.numbers[i];
        match run.follow_to_curve(step) {
            Ok(None) => {}
            Ok(Some(outcome)) => {
                self.outcomes[number] = Some(outcome);
                return false;
            }
            Err(error) => {
                if self.failure.as_ref().is_none_or(|(first, _)| number < *first) {
                    self.failure = Some((number, error));
                }
                return false;
            }
        }
        let Some(values) = run.curved_values() else { return false };
        (self.samples[i], self.ends[i]) = (values.index, values.limit);
        self.rows.enter(i, &values);
        let factor = self.rows.factor[i];
        for (row, sample) in self.rows.forcing.iter_mut().zip([values.index, values.index + 1]) {
            row[i] = factor * self.record.forcing.at(sample);
        }
        true
    }

    /// Takes parts of steps until lanes wait; tells which do.
    #[inline(always)]
    fn take_parts<S: Simd, const RATIO: bool>(&mut self, simd: S) -> u8 {
        let (h, tolerances) = (self.solver.step, self.solver.motion.tolerances);
        let rows = &mut self.rows;
        let (driving, damping) = (load(simd, &rows.driving), load(simd, &rows.damping));
        let (growth, limits) =
            (load(simd, &rows.growth), [load(simd, &rows.limits[0]), load(simd, &rows.limits[1])]);
        let [mut u, mut v] = [load(simd, &rows.u), load(simd, &rows.v)];
        let [mut highest, mut lowest] = [load(simd, &rows.highest).max(u), load(simd, &rows.lowest).min(u)];
        let (mut fastest, mut share) = (load(simd, &rows.fastest), load(simd, &rows.share));
        let mut reach = load(simd, &rows.reach);
        let mut goes = mask64x8::from_bitmask(simd, self.busy.into());
        for _ in 0..MOST_PARTS {
            let (rest, speed) = (1.0 - share, v.abs());
            let most = rest.min(reach * u.abs() / (speed * h));
            let length = most * h;
            // A, and how far u may get from a straight line
            let bound = growth * (driving + damping * speed);
            let change = bound * length;
            let (line, margin) = (u + length * v, 0.5 * (change * length));
            // beyond that speed u̇ keeps its sign, so that u does not go back
            let steady = change.simd_lt(speed);
            let (rises, falls) = (steady & v.simd_gt(0.0), steady & v.simd_lt(0.0));
            let low = rises.select(u, u.min(line) - margin);
            let high = falls.select(u, u.max(line) + margin);
            let fits = limits[0].simd_le(low) & high.simd_le(limits[1]);
            let [from, to] = [load(simd, &rows.forcing[0]), load(simd, &rows.forcing[1])];
            let forcing = [from + (to - from) * share, (to - from) * most];
            let (end, within) = end_of_part::<S, RATIO>(&rows.law, [u, v], forcing, length, tolerances);
            let taken = goes & fits & within;
            // also where the sum rounds to the whole step
            let finished = taken & (most.simd_ge(rest) | (share + most).simd_ge(1.0));
            u = taken.select(end[0], u);
            v = taken.select(end[1], v);
            highest = highest.max(u);
            lowest = lowest.min(u);
            fastest = fastest.max(taken.select(speed, fastest));
            share = taken.select(finished.select(0.0 * share, share + most), share);
            reach = taken.select((LONGER * reach).min(REACH), SHORTER * reach);
            goes = goes & fits & reach.simd_gt(SHORTEST);
            let mut done = bits(finished);
            let mut ended = 0;
            while done != 0 {
                let i = done.trailing_zeros() as usize;
                done &= done - 1;
                self.samples[i] += 1;
                if self.samples[i] >= self.ends[i] {
                    ended |= 1 << i;
                } else {
                    rows.forcing[0][i] = rows.forcing[1][i];
                    rows.forcing[1][i] = rows.factor[i] * self.record.forcing.at(self.samples[i] + 1);
                }
            }
            goes &= !mask64x8::from_bitmask(simd, ended);
            if (self.busy & !bits(goes)).count_ones() > WAITING.min(self.busy.count_ones() - 1) {
                break;
            }
        }
        u.store_array(&mut rows.u);
        v.store_array(&mut rows.v);
        highest.store_array(&mut rows.highest);
        lowest.store_array(&mut rows.lowest);
        fastest.store_array(&mut rows.fastest);
        share.store_array(&mut rows.share);
        reach.store_array(&mut rows.reach);
        self.busy & !bits(goes)
    }
}

/// Returns u and u̇ at the end of a part of some length, p being what it is at its start and its change, and
/// the lanes for which the series reach.
#[inline(always)]
fn end_of_part<S: Simd, const RATIO: bool>(
    law: &SecantRows,
    [u, v]: [f64x8<S>; 2],
    [forcing, change]: [f64x8<S>; 2],
    length: f64x8<S>,
    tolerances: Tolerances,
) -> ([f64x8<S>; 2], mask64x8<S>) {
    let simd = u.simd;
    let force_at_zero = load(simd, &law.force_at_zero);
    let stiffness = load(simd, &law.stiffness);
    let force = load(simd, &law.force) + stiffness * (u - load(simd, &law.anchor));
    let [own_anchor, own_force, own_slope] = &law.own;
    let own = load(simd, own_force) + load(simd, own_slope) * (u - load(simd, own_anchor));
    let inverse = 1.0 / u;
    let ratio = (own * inverse).max(LEAST * (force_at_zero * inverse).abs());
    let secant = if RATIO { ratio.sqrt() } else { ratio };
    let scale = length * length * inverse;
    let start = Start {
        velocity: length * v * inverse,
        driving: scale * (forcing - force),
        rate: scale * change,
        half_kappa: -0.5 * (force_at_zero * inverse) / ratio,
        stiffness: stiffness * (length * length),
        damping: load(simd, &law.factor) * length * secant,
    };
    let mut series = Scaled::new(start, f64x8::splat(simd, 1.0));
    let most = inverse.abs() * (tolerances.velocity * length).min(tolerances.displacement);
    series.extend_to_8::<RATIO>();
    series.extend_to_10::<RATIO>();
    let [x, velocity] = series.end::<10>();
    ([u + u * x, u / length * velocity], within::<S>(series.last::<10>(), 10.0, most))
}

/// Tells the lanes in which what a series leaves out is small enough (`tolerances::within`).
#[inline(always)]
fn within<S: Simd>([a, b, c, d]: [f64x8<S>; 4], order: f64, most: f64x8<S>) -> mask64x8<S> {
    let (before, last) = (a.abs().max(b.abs()), c.abs().max(d.abs()));
    (2.0 * order * last * last).simd_le(CAUTION * most * (before - last))
}
