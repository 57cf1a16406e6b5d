//! The loop over a record, compiled for the vectors of the processor at hand.
//!
//! Wider vectors round like narrow ones, so that a run gives the same bits on every processor.
#![allow(
    unsafe_code,
    reason = "the wide version may run only where the processor has it, which no type can tell"
)]

use super::Forcing;
use super::lanes::Lanes;
use crate::solver::SolverError;

/// [`Lanes::follow`], with vectors as wide as can be had.
pub(super) fn follow<const N: usize, F: Forcing<N>>(
    lanes: &mut Lanes<'_, N>,
    forcing: &F,
    observe: &mut impl FnMut(usize, &[f64; N], &[f64; N]),
) -> Result<(), SolverError> {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, as was just found.
        return unsafe { follow_avx2(lanes, forcing, observe) };
    }
    lanes.follow(forcing, observe)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn follow_avx2<const N: usize, F: Forcing<N>>(
    lanes: &mut Lanes<'_, N>,
    forcing: &F,
    observe: &mut impl FnMut(usize, &[f64; N], &[f64; N]),
) -> Result<(), SolverError> {
    lanes.follow(forcing, observe)
}
