//! The way of a run through a record, compiled for AVX2 where the processor has it.
//!
//! The instructions round alike, so that a run gives the same bits on every processor.
#![allow(
    unsafe_code,
    reason = "that version may run only where the processor has it, which no type can tell"
)]

use super::super::SolverError;
use super::lane::Lane;
use super::{Forcing, Passage};

/// [`Lane::follow`], with AVX2 if that can be had.
pub(super) fn follow<F: Forcing>(
    lane: &mut Lane<'_, F>,
    observe: &mut impl FnMut(usize, f64, f64),
) -> Result<Passage, SolverError> {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just found.
        return unsafe { follow_avx2(lane, observe) };
    }
    lane.follow(observe)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn follow_avx2<F: Forcing>(
    lane: &mut Lane<'_, F>,
    observe: &mut impl FnMut(usize, f64, f64),
) -> Result<Passage, SolverError> {
    lane.follow(observe)
}
