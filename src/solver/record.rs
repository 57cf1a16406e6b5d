//! Motion over a record: many steps of one length, for several runs of one wall side by side.
//!
//! On a branch with constant damping a step is an affine map of (u, u̇) and of the forcing at its ends, made once for each
//! branch, and so are two steps: that way each state waits for the one before the last only. A *plain* step applies the
//! map of two and checks that at both ends u is so far from the corners, and either so far from the extremes seen before or
//! |u̇| so large, that nothing can have happened in between. Everything else is looked at step by step: corners crossed and turning
//! points passed in the ordinary way in the module `careful`, the rest by [`Motion::advance`]'s own search.
//!
//! The distance that suffices, over a plain stretch of length h, one step or two: let |p| ≤ P over the next 256 samples, |f| ≤ f̂
//! between the corners and up to four times the largest |u| so far, and |u̇| ≤ V at both ends of the stretch, with c V = (P + f̂)/4.
//! With A = max|ü| in the stretch, |u̇| ≤ V + A h/2, and u leaves its chord, which lies on the branch, by no more than A h²/8, so
//! that A ≤ P + c (V + A h/2) + f̂ + |k| A h²/8. This bounds A unless h is too long, and the margin A h²/8 from corners and
//! extremes follows: f of a branch's line, followed beyond its ends. A stretch that starts or ends with |u̇| > A h has no turning
//! point, so that its extremes are its ends; the one beyond the extremes seen before is taken in with the first step that is
//! not plain, which comes before u turns.
#![allow(
    clippy::inline_always,
    reason = "measured: a step is one piece of straight code, its numbers in registers"
)]

use std::ops::Range;

mod careful;
mod lanes;
mod short;
mod wide;

use super::oscillator::Oscillator;
use super::{Method, Motion, SolverError, State, Work, is_constant};
use lanes::Lanes;
use short::Short;

use crate::wall::Branch;

/// Forcing p of `N` runs at the samples of a record \[m/s²\].
pub trait Forcing<const N: usize> {
    /// Number of samples.
    fn count(&self) -> usize;
    /// The forcing of each run at a sample.
    fn at(&self, index: usize) -> [f64; N];
    /// Largest |p| of each run over a range of samples.
    fn largest(&self, range: Range<usize>) -> [f64; N];
}

/// One record, scaled differently for each run.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<'a, const N: usize> {
    samples: &'a [f64],
    factors: [f64; N],
}

impl<'a, const N: usize> Scaled<'a, N> {
    /// `samples` \[m/s²\] times each of `factors`.
    #[must_use]
    pub fn new(samples: &'a [f64], factors: [f64; N]) -> Self {
        Self { samples, factors }
    }
}

impl<const N: usize> Forcing<N> for Scaled<'_, N> {
    fn count(&self) -> usize {
        self.samples.len()
    }

    fn at(&self, index: usize) -> [f64; N] {
        let sample = self.samples[index];
        self.factors.map(|factor| factor * sample)
    }

    fn largest(&self, range: Range<usize>) -> [f64; N] {
        // eight side by side: one maximum after another would take longer than the steps
        let (rows, rest) = self.samples[range].as_chunks::<8>();
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        let mut columns = [0.0; 8];
        for row in rows {
            columns = std::array::from_fn(|i| larger(columns[i], row[i].abs()));
        }
        let largest = columns.iter().chain(rest).fold(0.0, |largest, sample| larger(largest, sample.abs()));
        self.factors.map(|factor| factor.abs() * largest)
    }
}

/// No motion at all.
#[derive(Clone, Copy, Debug)]
pub struct Still(
    /// Number of samples.
    pub usize,
);

impl<const N: usize> Forcing<N> for Still {
    fn count(&self) -> usize {
        self.0
    }

    fn at(&self, _index: usize) -> [f64; N] {
        [0.0; N]
    }

    fn largest(&self, _range: Range<usize>) -> [f64; N] {
        [0.0; N]
    }
}

/// What became of one run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// The state at the end of the record, or where the run stopped.
    pub state: State,
    /// Time of overturning from the start of the record \[s\].
    pub overturning: Option<f64>,
    /// Work done.
    pub work: Work,
    /// The bound on impacts was reached and the wall put to rest.
    pub stilled: bool,
}

/// A motion prepared for steps of one length.
#[derive(Clone, Debug)]
pub struct RecordSolver<'a> {
    motion: &'a Motion,
    step: f64,
    /// For each branch, unless its steps are no affine maps.
    maps: Vec<Option<StepMap>>,
}

/// Steps on one branch, by the forcing less the branch's force at u = 0, q = p − f(0): the change of u and of u̇ for each of
/// u₀, u̇₀, q₀, q₁ and q₂.
#[derive(Clone, Copy, Debug)]
struct Affine {
    terms: [[f64; 2]; 5],
}

impl Affine {
    /// Nothing moves.
    const STILL: Self = Self { terms: [[0.0; 2]; 5] };

    /// One step h: q₂ does not count.
    fn single(oscillator: &Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping, oscillator.stiffness);
        let green = oscillator.green(step);
        let (g, h, j) = (green.g, green.h, green.j / step);
        let (of_u, of_v) = ([-k * h, -k * g], [g, -(k * h + c * g)]);
        Self { terms: [of_u, of_v, [h - j, g - h / step], [j, h / step], [0.0; 2]] }
    }

    /// Two steps h: the closed form over 2h, and the forcing of both, each as in `one`.
    fn double(one: &Self, oscillator: &Oscillator, step: f64) -> Self {
        let [one_u, one_v, first, second, _] = one.terms;
        let [two_u, two_v, ..] = Self::single(oscillator, 2.0 * step).terms;
        // what the first step changed, moved on by the second
        let onward = |[u, v]: [f64; 2], part: usize| [u, v][part] + (one_u[part] * u + one_v[part] * v);
        let parts = [0, 1];
        Self {
            terms: [
                two_u,
                two_v,
                parts.map(|part| onward(first, part)),
                parts.map(|part| onward(second, part) + first[part]),
                second,
            ],
        }
    }
}

/// What steps on one branch need.
#[derive(Clone, Copy, Debug)]
struct StepMap {
    single: Affine,
    double: Affine,
    /// Corners of the branch.
    corners: [f64; 2],
    /// A = `growth` (P + c V + f̂) over one step and over two; infinite where they are too long for the argument.
    growth: [f64; 2],
    oscillator: Oscillator,
    /// 1/c \[s\].
    inverse_damping: f64,
    /// f(0), of the branch's line \[m/s²\].
    force_at_zero: f64,
    short: Option<Short>,
}

impl StepMap {
    /// On a branch through u = 0 without ends.
    fn new(oscillator: Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping, oscillator.stiffness);
        let growth = |length: f64| {
            let slack = 1.0 - 0.5 * c * length - 0.125 * k.abs() * length * length;
            if slack > 0.0 { 1.0 / slack } else { f64::INFINITY }
        };
        let single = Affine::single(&oscillator, step);
        Self {
            single,
            double: Affine::double(&single, &oscillator, step),
            corners: [f64::NEG_INFINITY, f64::INFINITY],
            growth: [growth(step), growth(2.0 * step)],
            oscillator,
            inverse_damping: 1.0 / c,
            force_at_zero: 0.0,
            short: Short::new(&oscillator, step),
        }
    }

    /// The same on a branch with that oscillator.
    fn on(mut self, branch: &Branch) -> Self {
        self.corners = [branch.lower, branch.upper];
        self.force_at_zero = branch.restoring(0.0);
        self
    }
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\].
    #[must_use]
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let mut maps: Vec<Option<StepMap>> = Vec::with_capacity(motion.oscillators.len());
        for (branch, &oscillator) in motion.wall.branches().iter().zip(&motion.oscillators) {
            let affine = match motion.method {
                Method::Exact => true,
                Method::Adaptive { .. } => branch.stiffness > 0.0 && is_constant(branch.damping),
                Method::Newmark { .. } => false,
            };
            let map = (affine && !oscillator.is_spread(2.0 * step)).then(|| {
                // branches on both sides of the wall share their oscillator
                let known = maps.iter().flatten().find(|map| map.oscillator == oscillator);
                known.copied().unwrap_or_else(|| StepMap::new(oscillator, step)).on(branch)
            });
            maps.push(map);
        }
        Self { motion, step, maps }
    }

    /// Moves `N` walls from their states through a record; `until_overturning` stops each when it overturns. `observe` is
    /// shown u and u̇ of all runs at each sample after the first.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn run<const N: usize, F: Forcing<N>>(
        &self,
        states: [State; N],
        forcing: &F,
        until_overturning: bool,
        mut observe: impl FnMut(usize, &[f64; N], &[f64; N]),
    ) -> Result<[Passage; N], SolverError> {
        let mut lanes = Lanes::new(self, states, until_overturning);
        if forcing.count() > 0 {
            wide::follow(&mut lanes, forcing, &mut observe)?;
        }
        Ok(lanes.passages(forcing.count().saturating_sub(1) as u64))
    }
}
