//! A record in blocks of samples that share a bound.

use std::sync::OnceLock;

use crate::affine::MOST_AT_ONCE;
use crate::common::Common;
use crate::forcing::{BLOCK, Forcing, STILL};
use crate::number::Vectors;
use crate::responses::Responses;
use crate::solver::RecordSolver;

/// Samples that a lane may read from where it is: those of a block, and of the last plain steps beyond it.
pub(crate) const AHEAD: usize = BLOCK + MOST_AT_ONCE + 1;

/// A forcing and its bounds, block by block: prepared once for the runs of any walls
/// ([`run_together`](crate::run_together)).
#[derive(Debug)]
pub struct Blocks<'a> {
    pub(crate) forcing: Forcing<'a>,
    /// Largest |p| over each block and the samples after it to which plain steps may go \[m/s²\].
    largest: Vec<f64>,
    /// Sum of |p| from the start of each block to the end of the record \[m/s²\], for runs that may end at
    /// their peaks.
    rest: OnceLock<Vec<f64>>,
    /// The last [`AHEAD`] samples, and after them zeros, for runs side by side.
    tail: OnceLock<Vec<f64>>,
    /// The responses of a wall whose many runs go by them.
    pub(crate) responses: Option<Responses<'a>>,
}

impl<'a> Blocks<'a> {
    /// Prepares a forcing, in a fraction of the time of a run.
    pub fn new(forcing: Forcing<'a>) -> Self {
        let last = forcing.count().saturating_sub(1);
        let over = |block: usize| block * BLOCK..((block + 1) * BLOCK + MOST_AT_ONCE - 1).min(last) + 1;
        let largest = (0..last.div_ceil(BLOCK)).map(|block| forcing.largest(over(block))).collect();
        Self { forcing, largest, rest: OnceLock::new(), tail: OnceLock::new(), responses: None }
    }

    /// Prepares a forcing for many runs of one wall. The response of the wall's branches to the record is
    /// taken once for all of them, where they go side by side with constant damping. A large record may take
    /// some MB for each branch.
    pub fn for_many(solver: &'a RecordSolver<'a>, forcing: Forcing<'a>) -> Self {
        Self::on(solver, forcing, Vectors::widest())
    }

    /// Prepares a forcing for many runs of one wall with some vectors.
    #[doc(hidden)]
    pub fn on(solver: &'a RecordSolver<'a>, forcing: Forcing<'a>, vectors: Option<Vectors>) -> Self {
        let record = Self::new(forcing);
        let responses = match vectors.and_then(|_| Common::of(solver, record.count())) {
            Some(Common::Affine { .. }) => Responses::new(solver, forcing),
            _ => None,
        };
        Self { responses, ..record }
    }

    #[doc(hidden)]
    pub fn forcing(&self) -> Forcing<'a> {
        self.forcing
    }

    /// Returns what a run of a wall through this record has in common with others; `None` if it goes by
    /// itself.
    pub(crate) fn common<'s>(&self, solver: &'s RecordSolver<'s>) -> Option<Common<'s>> {
        if self.responses.as_ref().is_some_and(|responses| std::ptr::eq(responses.solver, solver)) {
            return Some(Common::Prepared(std::ptr::from_ref(solver)));
        }
        Common::of(solver, self.count())
    }

    /// Returns the forcing at [`AHEAD`] samples from `index` on: zeros beyond the end of the record.
    #[inline(always)]
    pub(crate) fn ahead(&self, index: usize) -> &[f64; AHEAD] {
        let (ahead, count) = (index + AHEAD, self.forcing.count());
        let samples = match self.forcing {
            Forcing::Samples(samples) if ahead > count => {
                &self.tail.get_or_init(|| tail(samples))[ahead - count..]
            }
            Forcing::Samples(samples) => &samples[index..],
            Forcing::Still(_) => &STILL,
        };
        samples.first_chunk().unwrap_or_else(|| unreachable!("a lane is at a sample of its record"))
    }

    /// Returns the number of samples.
    pub(crate) fn count(&self) -> usize {
        self.forcing.count()
    }

    /// Returns the bound on |p| in the block of a sample \[m/s²\].
    pub(crate) fn largest(&self, index: usize) -> f64 {
        self.largest.get(index / BLOCK).copied().unwrap_or(0.0)
    }

    /// Returns the sum of |p| from the start of the block of a sample on \[m/s²\]. Times the step it bounds
    /// the integral of |p| from the sample on, since p is linear between samples.
    pub(crate) fn rest(&self, index: usize) -> f64 {
        let rest = self.rest.get_or_init(|| sums_of_rests(self.forcing, self.largest.len()));
        rest.get(index / BLOCK).copied().unwrap_or(0.0)
    }
}

/// Returns the sum of |p| from the start of each block to the end of a record \[m/s²\].
fn sums_of_rests(forcing: Forcing<'_>, blocks: usize) -> Vec<f64> {
    let (mut rests, mut sum, mut end) = (vec![0.0; blocks], 0.0, forcing.count());
    for (block, rest) in rests.iter_mut().enumerate().rev() {
        sum += forcing.sum(block * BLOCK..end);
        (*rest, end) = (sum, block * BLOCK);
    }
    rests
}

/// Returns the last [`AHEAD`] samples of a record, or zeros before a shorter one, and zeros after them.
fn tail(samples: &[f64]) -> Vec<f64> {
    let (mut tail, known) = (vec![0.0; 2 * AHEAD], samples.len().min(AHEAD));
    tail[AHEAD - known..AHEAD].copy_from_slice(&samples[samples.len() - known..]);
    tail
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bound of a block is the largest |p| of its samples, and of those that its last plain steps reach;
    /// its rest is the sum from its first sample to the last of the record.
    #[test]
    fn bounds_of_blocks_are_the_largest_of_their_samples() {
        for count in [2, 17, BLOCK, BLOCK + 1, BLOCK + 3, 3 * BLOCK + 100] {
            // signs alternate, and the largest samples lie everywhere
            let sample =
                |n: usize| (1.0 + (n * 37 % 101) as f64) * if n.is_multiple_of(2) { 1.0 } else { -1.0 };
            let samples: Vec<f64> = (0..count).map(sample).collect();
            let blocks = Blocks::new(Forcing::Samples(&samples));
            for first in (0..count - 1).step_by(BLOCK) {
                let reached = &samples[first..(first + BLOCK + MOST_AT_ONCE).min(count)];
                let wanted = reached.iter().map(|p| p.abs()).fold(0.0, f64::max);
                assert_eq!(blocks.largest(first), wanted, "{first} of {count}");
                assert_eq!(blocks.rest(first), samples[first..].iter().map(|p| p.abs()).sum::<f64>());
                assert_eq!(blocks.largest((first + BLOCK).min(count - 1) - 1), wanted, "{first} of {count}");
            }
        }
        assert_eq!(Blocks::new(Forcing::Still(500)).largest(300), 0.0);
    }
}
