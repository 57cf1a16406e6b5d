//! The way of a run through a record, compiled for AVX2 where the processor has it.
//!
//! The instructions round alike, so that a run gives the same bits on every processor.

use super::super::SolverError;
use super::lane::Lane;
use super::{Forcing, Passage};

/// [`Lane::follow`], with AVX2 if that can be had.
pub(super) fn follow<F: Forcing>(
    lane: &mut Lane<'_, F>,
    observe: &mut impl FnMut(usize, f64, f64),
) -> Result<Passage, SolverError> {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = fearless_simd::Level::new().as_avx2() {
        return fearless_simd::Simd::vectorize(
            avx2,
            #[inline(always)]
            || lane.follow(observe),
        );
    }
    lane.follow(observe)
}
