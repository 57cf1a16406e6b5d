//! Runs side by side, compiled for each width of vectors.

use fearless_simd::Simd;
use rocking_wall::solver::SolverError;
use rocking_wall::solver::secant::{ByRatio, ByStiffness};

use crate::common::Common;
use crate::eight::Eight;
use crate::lanes::{Lanes, Waiting};
use crate::run::{NoObserver, Outcome};
use crate::table::{Law, Stepping};

/// Follows runs side by side; `watch` is shown which lanes wait after each round.
pub(crate) fn in_lanes<S: Simd>(
    simd: S,
    kind: Common<'_>,
    lanes: Lanes<'_, NoObserver>,
    watch: &mut dyn FnMut(Waiting),
) -> Vec<Result<Outcome, SolverError>> {
    simd.vectorize(
        #[inline(always)]
        || match kind {
            Common::Prepared(_) => lanes.side_by_side(
                Stepping::Affine,
                watch,
                #[inline(always)]
                |lanes, busy| lanes.affine_steps::<Eight<S, true>>(simd, 0, busy),
            ),
            Common::Affine { .. } => lanes.side_by_side(
                Stepping::Affine,
                watch,
                #[inline(always)]
                |lanes, busy| lanes.affine_steps::<Eight<S, false>>(simd, 0, busy),
            ),
            Common::Curved { law: Law::Ratio, .. } => lanes.side_by_side(
                Stepping::Curved,
                watch,
                #[inline(always)]
                |lanes, busy| lanes.take_parts::<Eight<S, false>, ByRatio>(simd, 0, busy),
            ),
            Common::Curved { law: Law::Stiffness, .. } => lanes.side_by_side(
                Stepping::Curved,
                watch,
                #[inline(always)]
                |lanes, busy| lanes.take_parts::<Eight<S, false>, ByStiffness>(simd, 0, busy),
            ),
        },
    )
}
