//! Searches a piece of motion for the extremes of a quantity.
//!
//! On an interval a quantity g has a bound M on |g̈|, so that between two instants δ apart it is at most
//! max(g₀, g₁) + M δ²/8. Intervals whose bound does not exceed the extreme so far, or in which g is monotone,
//! are dropped and the others halved, until the bound is met within [`ACCURACY`].

use std::cell::OnceCell;

use oscillator::KinematicState;

use super::super::demand::{Extremes, Instant, is_monotone};
use super::super::event::{Piece, SearchExhausted};

/// Error of an extreme, relative to the terms it is the sum of. Its time is then accurate to about 1e-6 of
/// the time scale of the motion around it.
pub const ACCURACY: f64 = 1e-12;
/// Number of intervals after which the tolerance of a search doubles, again and again. Hundreds of undamped
/// oscillations of the same height in one step would take too long with twelve digits each.
const PATIENCE: u32 = 1 << 14;
/// Most intervals of one search. By then the tolerance is a million times the value.
const MOST_INTERVALS: u32 = 60 * PATIENCE;
/// Most intervals pending at once.
const DEEPEST: usize = 64;

/// A quantity on a piece: its value by the motion, the bound on its second derivative, and the size of its
/// terms. The bound is a sum of shares of the bounds on |ü|, on the jerk and on the second derivative of ü,
/// and of a number.
pub(super) struct Quantity<F, S> {
    pub(super) value: F,
    pub(super) curvature: [f64; 4],
    pub(super) size: S,
}

impl<F, S> Quantity<F, S> {
    /// Returns by how much it may exceed its values at the ends of an interval.
    fn above(&self, width: f64, bounds: [f64; 3]) -> f64 {
        let [of_acceleration, of_jerk, of_snap, more] = self.curvature;
        let [acceleration, jerk, snap] = bounds;
        0.125 * width * width * (of_acceleration * acceleration + of_jerk * jerk + of_snap * snap + more)
    }
}

/// Number of instants of a piece that a search begins with, to find the size of the quantities on it.
const FIRST: usize = 5;

/// A piece to search up to a length; it starts `from` after the `time` of its segment.
pub(super) struct ExtremeSearch<'a, P> {
    piece: &'a P,
    time: f64,
    pub(super) from: f64,
    pub(super) length: f64,
    pub(super) ends: [KinematicState; 2],
    seen: OnceCell<[(f64, KinematicState); FIRST]>,
    /// Bounds on |ü|, on the jerk, and on the second derivative of ü \[m/s², m/s³, m/s⁴\].
    pub(super) bounds: [f64; 3],
}

#[derive(Clone, Copy)]
struct Node {
    offset: f64,
    value: f64,
    motion: KinematicState,
}

impl<'a, P: Piece> ExtremeSearch<'a, P> {
    pub(super) fn new(piece: &'a P, length: f64, [time, from]: [f64; 2]) -> Self {
        let ends = [piece.start(), piece.balanced(length)];
        let bounds = piece.curvatures([0.0, length], ends[0]);
        Self { piece, time, from, length, ends, seen: OnceCell::new(), bounds }
    }

    /// The instants that a search begins with. Most pieces need none: their ends show that none is higher.
    fn seen(&self) -> &[(f64, KinematicState); FIRST] {
        self.seen.get_or_init(|| {
            std::array::from_fn(|index| match index {
                0 => (0.0, self.ends[0]),
                _ if index + 1 == FIRST => (self.length, self.ends[1]),
                _ => {
                    let offset = self.length * (index as f64 / (FIRST - 1) as f64);
                    (offset, self.piece.balanced(offset))
                }
            })
        })
    }

    pub(super) fn largest(&self, pick: fn(&KinematicState) -> f64) -> f64 {
        self.seen().iter().map(|(_, motion)| pick(motion).abs()).fold(0.0, f64::max)
    }

    /// Raises the extremes to those of a quantity.
    pub(super) fn raise<F: Fn(f64, &KinematicState) -> f64, S: Fn() -> f64>(
        &self,
        extremes: &mut Extremes,
        quantity: &Quantity<F, S>,
    ) -> Result<(), SearchExhausted> {
        let times = [0.0, self.length];
        let [start, end] = [0, 1].map(|n| (quantity.value)(times[n], &self.ends[n]));
        let above = quantity.above(self.length, self.bounds);
        let times = times.map(|offset| self.time + (self.from + offset));
        if extremes.include_ends([start, end], above, times) {
            return Ok(());
        }
        if let Some(instant) = self.highest(1.0, extremes.highest.value, quantity)? {
            extremes.highest = instant;
        }
        if let Some(Instant { value, time }) = self.highest(-1.0, -extremes.lowest.value, quantity)? {
            extremes.lowest = Instant { value: -value, time };
        }
        Ok(())
    }

    /// Returns the highest value of `sign` times a quantity, if it exceeds `best`.
    pub(super) fn highest<F: Fn(f64, &KinematicState) -> f64, S: Fn() -> f64>(
        &self,
        sign: f64,
        best: f64,
        quantity: &Quantity<F, S>,
    ) -> Result<Option<Instant>, SearchExhausted> {
        let node = |offset: f64, motion: KinematicState| Node {
            offset,
            value: sign * (quantity.value)(offset, &motion),
            motion,
        };
        let first = self.seen().map(|(offset, motion)| node(offset, motion));
        let highest = first.iter().fold(f64::NEG_INFINITY, |most, node| most.max(node.value));
        let longest = first[FIRST - 1].offset / (FIRST - 1) as f64;
        if highest + quantity.above(longest, self.bounds) <= best {
            return Ok(None);
        }
        let size = (quantity.size)();
        let mut found = Node { offset: f64::NAN, value: best, ..first[0] };
        for node in first {
            if node.value > found.value {
                found = node;
            }
        }
        // from right to left, because the last interval added is searched first
        let (mut left, mut count) = (first[0], FIRST - 1);
        let mut pending = [left; DEEPEST];
        for (place, node) in pending.iter_mut().zip(first[1..].iter().rev()) {
            *place = *node;
        }
        for visited in 0..MOST_INTERVALS {
            let Some(index) = usize::checked_sub(count, 1) else {
                let time = self.time + (self.from + found.offset);
                return Ok((found.value > best).then_some(Instant { value: found.value, time }));
            };
            let right = pending[index];
            let width = right.offset - left.offset;
            let higher = left.value.max(right.value);
            // the error of a sum with cancellation is relative to its terms
            let patience = 2.0_f64.powi((visited / PATIENCE).cast_signed());
            let tolerance = patience * ACCURACY * size.max(found.value.abs());
            let within = |bounds: [f64; 3]| {
                let above = quantity.above(width, bounds);
                higher + above <= found.value + tolerance || is_monotone([left.value, right.value], above)
            };
            // of a wall that hovers near its instability before it falls back, the bounds over the whole
            // piece are up to 1e15 times those between two instants
            let between = || self.piece.curvatures([left.offset, right.offset], left.motion);
            if count == DEEPEST || within(self.bounds) || within(between()) {
                (left, count) = (right, index);
                continue;
            }
            let offset = 0.5 * (left.offset + right.offset);
            let middle = node(offset, self.piece.balanced(offset));
            if middle.value > found.value {
                found = middle;
            }
            pending[count] = middle;
            count += 1;
        }
        Err(SearchExhausted)
    }
}
