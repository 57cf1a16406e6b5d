//! Motion over a record: many steps of one length, of one run ([`RecordSolver::run`]) or of many ([`Batch`]).
//!
//! On a branch with constant damping a step is an affine map of (u, u̇) and of the forcing at its ends, made once for each
//! branch, and so are two steps, or four: that way a state waits for fewer before it. A *plain* step applies the map, of several where
//! it can, and checks that u at both ends is so far from the corners that none can have been reached in between.
//! Everything else is looked at step by step: corners crossed and turning points passed in the ordinary way in the module
//! `careful`, the rest by [`Motion::advance`]'s own search.
//!
//! The distance that suffices, over a plain stretch of length h, one step or several: let |p| ≤ P over the next 256 samples (and
//! three more, to which steps taken at once may go), |f| ≤ f̂ between the corners and up to some times the largest |u| so far,
//! and |u̇| ≤ V at both ends of the stretch, with c V = (P + f̂)/4. With A = max|ü| in the stretch, |u̇| ≤ V + A h/2, and u leaves
//! its chord, which lies on the branch, by no more than A h²/8, so that A ≤ P + c (V + A h/2) + f̂ + |k| A h²/8. This bounds A
//! unless h is too long, and the margin A h²/8 follows: f of a branch's line, followed beyond its ends.
//!
//! Extremes are known at the ends of plain steps, and beyond them up to that margin, which is small beside the extremes of the whole
//! run. Few of its 256-sample stretches can hold them: those are gone through a second time, and there steps that come
//! within the margin of the extremes known are looked at one by one (module `stretches`).
#![allow(
    clippy::inline_always,
    reason = "measured: a step is one piece of straight code, its numbers in registers"
)]

use std::ops::Range;

mod batch;
mod careful;
mod lane;
mod short;
mod stretches;
mod wide;

use super::{Method, Motion, SolverError, State, Work, is_constant};
pub use batch::{Batch, LANES};
use lane::{Lane, Plain};
use oscillator::Oscillator;
use short::Short;

use crate::wall::Branch;

/// Forcing p at the samples of a record \[m/s²\], before a run's factor.
pub trait Forcing {
    /// Number of samples.
    fn count(&self) -> usize;
    /// The forcing at a sample.
    fn at(&self, index: usize) -> f64;
    /// The forcing at so many samples from one on.
    fn from(&self, index: usize, count: usize) -> &[f64];
    /// Largest |p| over a range of samples.
    fn largest(&self, range: Range<usize>) -> f64;
}

/// Samples of forcing \[m/s²\].
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a>(
    /// One after another.
    pub &'a [f64],
);

impl Forcing for Samples<'_> {
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn at(&self, index: usize) -> f64 {
        self.0[index]
    }

    #[inline(always)]
    fn from(&self, index: usize, count: usize) -> &[f64] {
        &self.0[index..][..count]
    }

    fn largest(&self, range: Range<usize>) -> f64 {
        // eight side by side: one maximum after another would take longer than the steps
        let (rows, rest) = self.0[range].as_chunks::<8>();
        let larger = |a: f64, b: f64| if b > a { b } else { a };
        let mut columns = [0.0; 8];
        for row in rows {
            columns = std::array::from_fn(|i| larger(columns[i], row[i].abs()));
        }
        columns.iter().chain(rest).fold(0.0, |largest, sample| larger(largest, sample.abs()))
    }
}

/// As much of no motion as is asked for at once.
static STILL: [f64; 2 * stretches::STRETCH] = [0.0; 2 * stretches::STRETCH];

/// No motion at all.
#[derive(Clone, Copy, Debug)]
pub struct Still(
    /// Number of samples.
    pub usize,
);

impl Forcing for Still {
    fn count(&self) -> usize {
        self.0
    }

    #[inline(always)]
    fn at(&self, _index: usize) -> f64 {
        0.0
    }

    #[inline(always)]
    fn from(&self, _index: usize, count: usize) -> &[f64] {
        &STILL[..count]
    }

    fn largest(&self, _range: Range<usize>) -> f64 {
        0.0
    }
}

/// A run through a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The state at the first sample.
    pub state: State,
    /// By which the forcing is multiplied.
    pub factor: f64,
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
    /// One step h: q₂ does not count.
    fn single(oscillator: &Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        let green = oscillator.green(step);
        let (g, h, j) = (green.g, green.h, green.j / step);
        let (of_u, of_v) = ([-k * h, -k * g], [g, -(k * h + c * g)]);
        Self { terms: [of_u, of_v, [h - j, g - h / step], [j, h / step], [0.0; 2]] }
    }

    /// u or u̇ after one step.
    #[inline(always)]
    fn one_step(&self, part: usize, [u, v]: [f64; 2], q: [f64; 2]) -> f64 {
        let c = |term: usize| self.terms[term][part];
        // the products with the state last: they are what the next step waits for
        [u, v][part] + ((c(2) * q[0] + c(3) * q[1]) + (c(0) * u + c(1) * v))
    }

    /// u or u̇ after two steps.
    #[inline(always)]
    fn two_steps(&self, part: usize, [u, v]: [f64; 2], q: [f64; 3]) -> f64 {
        let c = |term: usize| self.terms[term][part];
        [u, v][part] + (((c(2) * q[0] + c(3) * q[1]) + c(4) * q[2]) + (c(0) * u + c(1) * v))
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
    /// Of [`growth`], over one step and over two.
    growth: [f64; 2],
    oscillator: Oscillator,
    /// 1/c \[s\].
    inverse_damping: f64,
    /// f(0), of the branch's line \[m/s²\].
    force_at_zero: f64,
    short: Option<Short>,
}

/// A over P + c V + f̂, over a length of time: 1/(1 − c h/2 − |k| h²/8), infinite where that is too long for the argument.
fn growth(oscillator: &Oscillator, length: f64) -> f64 {
    let (c, k) = (oscillator.damping(), oscillator.stiffness());
    let slack = 1.0 - 0.5 * c * length - 0.125 * k.abs() * length * length;
    if slack > 0.0 { 1.0 / slack } else { f64::INFINITY }
}

impl StepMap {
    /// A over one step and over two, where the forcing and the branch's force together are up to `driving`.
    #[inline(always)]
    fn most(&self, driving: f64) -> [f64; 2] {
        let braking = if self.oscillator.damping() > 0.0 { lane::BRAKING } else { 0.0 };
        self.growth.map(|growth| growth * (driving + braking * driving))
    }

    /// V.
    #[inline(always)]
    fn fastest(&self, driving: f64) -> f64 {
        lane::BRAKING * driving * self.inverse_damping
    }

    /// On a branch through u = 0 without ends.
    fn new(oscillator: Oscillator, step: f64) -> Self {
        let single = Affine::single(&oscillator, step);
        Self {
            single,
            double: Affine::double(&single, &oscillator, step),
            corners: [f64::NEG_INFINITY, f64::INFINITY],
            growth: [growth(&oscillator, step), growth(&oscillator, 2.0 * step)],
            oscillator,
            inverse_damping: 1.0 / oscillator.damping(),
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

    /// Largest |f| between the corners of the branches that have maps, for |u| up to `reach` \[m/s²\].
    fn largest_force(&self, reach: f64) -> f64 {
        let mut largest = 0.0_f64;
        for map in self.maps.iter().flatten() {
            let [lower, upper] = [map.corners[0].max(-reach), map.corners[1].min(reach)];
            if lower <= upper {
                let force = |u: f64| (map.force_at_zero + map.oscillator.stiffness() * u).abs();
                largest = largest.max(force(lower)).max(force(upper));
            }
        }
        largest
    }

    /// Moves a wall through a record; `until_overturning` stops it when it overturns. `observe` is shown u and u̇ at each sample
    /// after the first.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed.
    pub fn run<F: Forcing>(
        &self,
        start: Start,
        forcing: &F,
        until_overturning: bool,
        mut observe: impl FnMut(usize, f64, f64),
    ) -> Result<Passage, SolverError> {
        let largest = stretches::largest_forcing(forcing);
        self.run_with(start, forcing, &largest, until_overturning, &mut observe)
    }

    /// The same, `largest` as of [`stretches::largest_forcing`].
    fn run_with<F: Forcing>(
        &self,
        start: Start,
        forcing: &F,
        largest: &[f64],
        until_overturning: bool,
        observe: &mut impl FnMut(usize, f64, f64),
    ) -> Result<Passage, SolverError> {
        if forcing.count() == 0 {
            let overturning = start.state.overturned.then_some(0.0);
            return Ok(Passage { state: start.state, overturning, work: Work::default(), stilled: false });
        }
        let mut lane = Lane::new(self, forcing, largest, until_overturning, Plain::PAIRS, start);
        wide::follow(&mut lane, observe)
    }
}
