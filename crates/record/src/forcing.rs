//! The forcing of a run: samples of a record.

use std::ops::Range;

/// Samples of a block.
pub(crate) const BLOCK: usize = 256;

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
pub(crate) static STILL: [f64; 2 * BLOCK] = [0.0; 2 * BLOCK];

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
    pub(crate) fn largest(&self, range: Range<usize>) -> f64 {
        self.fold(range, |a, b| if b > a { b } else { a })
    }

    /// Returns the sum of |p| over a range of samples.
    pub(crate) fn sum(&self, range: Range<usize>) -> f64 {
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
