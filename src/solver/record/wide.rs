//! The way through a record, compiled for the vectors of the processor at hand.
//!
//! Wider vectors round like narrow ones, so that a run gives the same bits on every processor.
#![allow(
    unsafe_code,
    reason = "the wide version may run only where the processor has it, which no type can tell"
)]

use super::super::SolverError;
use super::lane::Lane;
use super::{Forcing, Passage};

/// [`Lane::follow`], with vectors as wide as can be had.
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
