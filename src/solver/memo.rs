//! What a run keeps from step to step, because it would be computed again.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use oscillator::{KinematicState, Oscillator};

use super::motion::Motion;
use crate::wall::TieMemory;

/// What a run keeps from step to step: the propagators of its last whole steps, and the motion of a wall
/// whose ties have yielded. Results do not depend on it, bit for bit.
#[derive(Clone, Debug, Default)]
pub struct Memo {
    propagators: Propagators,
    /// The motion with the present memory of the ties; `None` while it is that of the start.
    stretched: Option<Arc<Motion>>,
}

impl Memo {
    /// Prepares the motion for what the ties remember now, and returns it with the propagators of its steps.
    #[inline]
    pub(crate) fn prepare<'a>(
        &'a mut self,
        first: &'a Motion,
        memory: &TieMemory,
    ) -> (&'a Motion, &'a mut Propagators) {
        if self.motion(first).wall().tie_memory() != memory {
            self.stretch(first, memory);
        }
        (self.stretched.as_deref().unwrap_or(first), &mut self.propagators)
    }

    #[cold]
    fn stretch(&mut self, first: &Motion, memory: &TieMemory) {
        let is_first = first.wall().tie_memory() == memory;
        self.stretched = (!is_first).then(|| Arc::new(first.with_tie_memory(*memory)));
        // the branches have other numbers
        self.propagators = Propagators::default();
    }

    /// Returns the motion that was prepared last, of a run whose motion at the start is `first`.
    #[inline]
    pub(crate) fn motion<'a>(&'a self, first: &'a Motion) -> &'a Motion {
        self.stretched.as_deref().unwrap_or(first)
    }
}

/// The propagators of the last whole steps: one is computed once for steps of the same length on a branch.
///
/// Lengths that differ only by the rounding of a clock share one propagator. It is computed for the length
/// rounded to 40 bits, and a Taylor series covers the remainder of up to 5e-13 of the length. After seconds
/// of steps of milliseconds the clock rounds by more, so that lengths take turns.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Propagators {
    last: Propagator,
    /// Those before.
    earlier: [Propagator; 3],
}

#[derive(Clone, Copy, Debug)]
struct Propagator {
    branch: usize,
    duration: f64,
    matrix: Matrix3<f64>,
    /// Of ∫u dt.
    integral: [f64; 3],
}

impl Default for Propagator {
    fn default() -> Self {
        Self { branch: 0, duration: f64::NAN, matrix: Matrix3::zeros(), integral: [0.0; 3] }
    }
}

/// Bits of a length that a rounded length leaves out.
const ROUNDED_BITS: u32 = 12;

/// A length rounded to 40 bits of its mantissa.
fn rounded(duration: f64) -> f64 {
    let half = 1_u64 << (ROUNDED_BITS - 1);
    f64::from_bits((duration.to_bits() + half) & !((1 << ROUNDED_BITS) - 1))
}

impl Propagator {
    #[cold]
    fn new(branch: usize, oscillator: &Oscillator, duration: f64) -> Self {
        let rows = oscillator.propagator(duration);
        let matrix = Matrix3::from_fn(|i, j| rows[i][j]);
        Self { branch, duration, matrix, integral: oscillator.integral_row(duration) }
    }

    #[inline]
    fn is_of(&self, branch: usize, duration: f64) -> bool {
        self.duration == duration && self.branch == branch
    }
}

impl Propagators {
    /// Makes the propagator of a step the last one.
    #[cold]
    fn recall(&mut self, branch: usize, oscillator: &Oscillator, duration: f64) {
        if let Some(known) = self.earlier.iter_mut().find(|known| known.is_of(branch, duration)) {
            std::mem::swap(&mut self.last, known);
            return;
        }
        self.earlier.rotate_right(1);
        self.earlier[0] = self.last;
        self.last = Propagator::new(branch, oscillator, duration);
    }

    /// Returns the end of a whole step on a branch, and remembers its propagator.
    #[inline]
    pub(super) fn end(
        &mut self,
        branch: usize,
        oscillator: &Oscillator,
        start: KinematicState,
        forcing_rate: f64,
        length: f64,
    ) -> KinematicState {
        let duration = rounded(length);
        if !self.last.is_of(branch, duration) {
            self.recall(branch, oscillator, duration);
        }
        let from = Vector3::new(start.velocity, start.acceleration, forcing_rate);
        let change = self.last.matrix * from;
        let (velocity, acceleration) = (change[1], change[2]);
        let end = KinematicState { displacement: start.displacement + change[0], velocity, acceleration };
        let rest = length - duration;
        KinematicState {
            displacement: end.displacement + rest * velocity,
            velocity: velocity + rest * acceleration,
            acceleration: acceleration + rest * oscillator.jerk(end, forcing_rate),
        }
    }

    /// Returns ∫u dt over the whole step whose end was returned last, from its start to its end \[m s\].
    #[inline]
    pub(super) fn displacement_integral(
        &self,
        [start, end]: [KinematicState; 2],
        forcing_rate: f64,
        length: f64,
    ) -> f64 {
        let Propagator { duration, integral: [v, a, p], .. } = self.last;
        let KinematicState { displacement, velocity, acceleration } = start;
        let change = v * velocity + a * acceleration + p * forcing_rate;
        displacement * duration + change + (length - duration) * end.displacement
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A length within 2¹¹ roundings of a length of 40 bits is rounded to that.
    #[test]
    fn lengths_are_rounded_to_forty_bits() {
        for length in [0.01, 0.02, 1.0 / 3.0, 7.3e-5] {
            let shared = rounded(length);
            assert_eq!(shared.to_bits() % (1 << 12), 0, "{length}");
            assert!(length.to_bits().abs_diff(shared.to_bits()) <= 1 << 11, "{length}");
            for apart in [1, 100, 2047] {
                assert_eq!(rounded(f64::from_bits(shared.to_bits() + apart)), shared);
                assert_eq!(rounded(f64::from_bits(shared.to_bits() - apart)), shared);
            }
        }
    }

    /// The end of a step whose length is rounded is that of the step itself, also where ü is far below the
    /// jerk over the step.
    #[test]
    fn ends_of_steps_are_those_of_their_own_length() {
        let oscillator = Oscillator::new(0.4, 9.0);
        for apart in [2047, 1000, 1] {
            let length = f64::from_bits(rounded(0.7).to_bits() + apart);
            let start = KinematicState { displacement: 0.3, velocity: 20.0, acceleration: -50.0 };
            let mut propagators = Propagators::default();
            let found = propagators.end(0, &oscillator, start, 90.0, length);
            let wanted = oscillator.propagate(start, 90.0, length);
            // a few roundings of the largest terms; without the remainder of the length it would be a
            // thousand
            let near =
                |found: f64, wanted: f64| assert!((found - wanted).abs() <= 1e-13, "{found}, {wanted}");
            near(found.displacement, wanted.displacement);
            near(found.velocity, wanted.velocity);
            near(found.acceleration, wanted.acceleration);
            let integral = propagators.displacement_integral([start, found], 90.0, length);
            near(integral, oscillator.displacement_integral(start, 90.0, length));
        }
    }
}
