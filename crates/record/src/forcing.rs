//! The forcing of a run: samples of a record, in blocks that share a bound.

use std::ops::Range;
use std::sync::OnceLock;

use crate::batch::Vectors;
use crate::responses::Responses;
use crate::solver::RecordSolver;
use crate::together::Common;

/// Samples of a block.
pub(crate) const BLOCK: usize = 256;
/// Most plain steps taken at once. The last ones of a block may end beyond it, by one step less than this.
pub(crate) const MOST_AT_ONCE: usize = 4;

/// Samples that a lane may read from where it is: those of a block, and of the last plain steps beyond it.
pub(crate) const AHEAD: usize = BLOCK + MOST_AT_ONCE + 1;

/// Forcing of a wall at the samples of a record, linear in between.
///
/// The forcing of a run is p = s × sample \[m/s²\], with s the run's [`factor`](crate::RunStart::factor). The
/// samples may be p itself, or accelerations `a_g` of the supports: p = −λ `a_g`, so s then includes −λ. The
/// step between samples is that of the [`RecordSolver`](crate::RecordSolver).
#[derive(Clone, Copy, Debug)]
pub enum Forcing<'a> {
    /// One value for each sample \[m/s²\]: n samples are n − 1 steps.
    Samples(&'a [f64]),
    /// A number of samples without motion, for free vibration; no memory is taken for them.
    Still(usize),
}

/// Samples without motion, as many as are ever asked for at once.
static STILL: [f64; 2 * BLOCK] = [0.0; 2 * BLOCK];

impl<'a> Forcing<'a> {
    /// Returns the number of samples.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Samples(samples) => samples.len(),
            Self::Still(count) => *count,
        }
    }

    /// Returns the forcing at `count` samples from `index` on.
    #[inline(always)]
    pub(crate) fn from(self, index: usize, count: usize) -> &'a [f64] {
        match self {
            Self::Samples(samples) => &samples[index..][..count],
            Self::Still(_) => &STILL[..count],
        }
    }

    /// Returns the forcing at a sample.
    #[inline(always)]
    pub(crate) fn at(&self, index: usize) -> f64 {
        self.from(index, 1)[0]
    }

    /// Returns the largest |p| over a range of samples.
    fn largest(&self, range: Range<usize>) -> f64 {
        self.fold(range, |a, b| if b > a { b } else { a })
    }

    /// Returns the sum of |p| over a range of samples.
    fn sum(&self, range: Range<usize>) -> f64 {
        self.fold(range, |a, b| a + b)
    }

    /// Combines |p| over a range of samples, eight side by side: a single chain would take longer than the
    /// steps.
    fn fold(&self, range: Range<usize>, combine: impl Fn(f64, f64) -> f64) -> f64 {
        let Self::Samples(samples) = self else { return 0.0 };
        let (rows, rest) = samples[range].as_chunks::<8>();
        let mut columns = [0.0; 8];
        for row in rows {
            columns = std::array::from_fn(|i| combine(columns[i], row[i].abs()));
        }
        columns.into_iter().chain(rest.iter().map(|sample| sample.abs())).fold(0.0, combine)
    }
}

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
    pub(crate) fn on(solver: &'a RecordSolver<'a>, forcing: Forcing<'a>, vectors: Option<Vectors>) -> Self {
        let record = Self::new(forcing);
        let responses = match vectors.and_then(|_| Common::of(solver, &record)) {
            Some(Common::Affine { .. }) => Responses::new(solver, forcing),
            _ => None,
        };
        Self { responses, ..record }
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
