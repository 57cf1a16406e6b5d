//! Many runs of one wall through one record.
//!
//! Where the wall and the step allow it, eight runs go side by side, each number of theirs in one place of a vector: the response
//! of the branches to the record is taken once for all (module `responses`), plain steps go four at once and corners are passed
//! several at once (`lanes`, `corners`). Where a step is long beside the wall's shortest period runs go one by one: there four
//! steps would reach a corner too often.
//!
//! What becomes of a run depends on the wall, the record, the step and its start, never on the other runs or on the processor.
//! It agrees with [`RecordSolver::run`] to rounding.

#[cfg(target_arch = "x86_64")]
mod avx512;
mod corners;
mod lanes;
mod responses;
mod vector;

use super::{Forcing, Passage, RecordSolver, SolverError, Start, stretches};
use lanes::Lanes;
use responses::Responses;

/// Runs that go side by side.
pub const LANES: usize = vector::WIDTH;

/// A record prepared for many runs.
#[derive(Debug)]
pub struct Batch<'a, F> {
    solver: &'a RecordSolver<'a>,
    forcing: &'a F,
    largest: Vec<f64>,
    responses: Option<Responses>,
}

impl RecordSolver<'_> {
    /// Prepares a record for many runs.
    pub fn batch<'a, F: Forcing>(&'a self, forcing: &'a F) -> Batch<'a, F> {
        Batch {
            solver: self,
            forcing,
            largest: stretches::largest_forcing(forcing),
            responses: Responses::new(self, forcing),
        }
    }
}

impl<F: Forcing> Batch<'_, F> {
    /// Whether runs go side by side, not one by one.
    #[must_use]
    pub fn is_side_by_side(&self) -> bool {
        self.responses.is_some()
    }

    /// Moves walls through the record, each as if it were alone; `until_overturning` stops those that overturn.
    ///
    /// # Errors
    /// [`SolverError`] of the first run that could not be followed.
    pub fn run(&self, starts: &[Start], until_overturning: bool) -> Result<Vec<Passage>, SolverError> {
        let Self { solver, forcing, largest, responses } = self;
        let Some(responses) = responses else {
            let run =
                |&start| solver.run_with(start, *forcing, largest, until_overturning, &mut |_, _, _| {});
            return starts.iter().map(run).collect();
        };
        let mut lanes = Lanes::new(solver, *forcing, largest, responses, starts, until_overturning);
        follow(&mut lanes);
        lanes.passages()
    }
}

/// [`Lanes::follow`], with vectors as wide as can be had.
#[allow(
    unsafe_code,
    reason = "the wide versions may run only where the processor has them, which no type can tell"
)]
fn follow<F: Forcing>(lanes: &mut Lanes<'_, F>) {
    #[cfg(target_arch = "x86_64")]
    {
        if avx512::is_there() {
            // SAFETY: the processor has AVX-512, as was just found.
            return unsafe { follow_avx512(lanes) };
        }
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has AVX2, as was just found.
            return unsafe { follow_avx2(lanes) };
        }
    }
    lanes.follow::<vector::Portable>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,popcnt")]
fn follow_avx512<F: Forcing>(lanes: &mut Lanes<'_, F>) {
    lanes.follow::<avx512::Wide>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn follow_avx2<F: Forcing>(lanes: &mut Lanes<'_, F>) {
    lanes.follow::<vector::Portable>();
}
