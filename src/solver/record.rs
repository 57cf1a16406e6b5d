//! Motion over a record: many steps of one length, for several runs of one wall side by side.
//!
//! On a branch with constant damping a step is an affine map of (u, u̇) and of the forcing at its ends, made once for each
//! branch. A *plain* step applies the map and checks that u stayed so far from the corners and from the extremes seen
//! before that nothing can have happened in between. Everything else goes through [`Motion::advance`]'s own search.
//!
//! The distance that suffices: let |p| ≤ P over the record, |f| ≤ f̂ between the corners, and |u̇| ≤ V at both ends of a
//! step h. With A = max|ü| in the step, |u̇| ≤ V + A h/2 and u leaves its chord, and hence the branch, by no more than
//! A h²/8, so that A ≤ P + c (V + A h/2) + f̂ + |k| A h²/8, and the margin A h²/8 follows.

mod lanes;

use super::oscillator::Oscillator;
use super::{Method, Motion, SolverError, State, Work, is_constant};
use lanes::Lanes;

/// Forcing p of `N` runs at the samples of a record \[m/s²\].
pub trait Forcing<const N: usize> {
    /// Number of samples.
    fn count(&self) -> usize;
    /// The forcing of each run at a sample.
    fn at(&self, index: usize) -> [f64; N];
    /// Largest |p| of each run.
    fn largest(&self) -> [f64; N];
}

/// One record, scaled differently for each run.
#[derive(Clone, Copy, Debug)]
pub struct Scaled<'a, const N: usize> {
    samples: &'a [f64],
    factors: [f64; N],
    largest: f64,
}

impl<'a, const N: usize> Scaled<'a, N> {
    /// `samples` \[m/s²\] times each of `factors`; `largest` is the largest |sample|.
    #[must_use]
    pub fn new(samples: &'a [f64], factors: [f64; N], largest: f64) -> Self {
        Self { samples, factors, largest }
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

    fn largest(&self) -> [f64; N] {
        self.factors.map(|factor| factor.abs() * self.largest)
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

    fn largest(&self) -> [f64; N] {
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

/// A step on one branch:
/// Δu = `u[0]` u + `u[1]` u̇ + `u[2]` p₀ + `u[3]` p₁ + `u[4]`, and Δu̇ likewise.
#[derive(Clone, Copy, Debug)]
struct StepMap {
    u: [f64; 5],
    v: [f64; 5],
    /// Corners of the branch.
    corners: [f64; 2],
    /// f̂ \[m/s²\].
    force: f64,
    damping: f64,
    /// A = `growth` (P + c V + f̂); infinite where the step is too long for the argument.
    growth: f64,
    oscillator: Oscillator,
    /// Force at u = 0 of the branch's line \[m/s²\].
    force_at_zero: f64,
}

impl StepMap {
    fn new(branch: &crate::wall::Branch, oscillator: Oscillator, step: f64) -> Self {
        let (c, k) = (oscillator.damping, oscillator.stiffness);
        let green = oscillator.green(step);
        let (g, h, j) = (green.g, green.h, green.j / step);
        let force_at_zero = branch.restoring(0.0);
        let slack = 1.0 - 0.5 * c * step - 0.125 * k.abs() * step * step;
        Self {
            u: [-k * h, g, h - j, j, -h * force_at_zero],
            v: [-k * g, -(k * h + c * g), g - h / step, h / step, -g * force_at_zero],
            corners: [branch.lower, branch.upper],
            force: branch.restoring(branch.lower).abs().max(branch.restoring(branch.upper).abs()),
            damping: c,
            growth: if slack > 0.0 { 1.0 / slack } else { f64::INFINITY },
            oscillator,
            force_at_zero,
        }
    }
}

impl<'a> RecordSolver<'a> {
    /// Prepares steps of `step` \[s\].
    #[must_use]
    pub fn new(motion: &'a Motion, step: f64) -> Self {
        let maps = motion.wall.branches().iter().zip(&motion.oscillators).map(|(branch, &oscillator)| {
            let affine = match motion.method {
                Method::Exact => true,
                Method::Adaptive { .. } => branch.stiffness > 0.0 && is_constant(branch.damping),
                Method::Newmark { .. } => false,
            };
            (affine && !oscillator.is_spread(step)).then(|| StepMap::new(branch, oscillator, step))
        });
        Self { motion, step, maps: maps.collect() }
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
        let mut lanes = Lanes::new(self, states, forcing.largest(), until_overturning);
        if forcing.count() == 0 {
            return Ok(lanes.passages(0));
        }
        let mut index = 0;
        while index + 1 < forcing.count() && lanes.running > 0 {
            if lanes.all_inside {
                index = lanes.plain_steps(index, forcing, &mut observe);
            }
            if index + 1 < forcing.count() {
                lanes.step(index, forcing)?;
                index += 1;
                observe(index, &lanes.u, &lanes.v);
            }
        }
        Ok(lanes.passages(forcing.count() as u64 - 1))
    }
}
