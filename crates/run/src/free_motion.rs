//! Free motion of a wall, with impacts or with viscous damping.

use rocking_wall::solver::{Memo, Motion, Report, Segment, SolverError, State};
use rocking_wall::variables::{DampingModel, Impact};
use rocking_wall::wall::{COMPUTED, Damping, Parameters, Support, Wall};

/// By how much rounding may raise the energy, relative to that at the peak.
const ENERGY_ROUNDING: f64 = 1e-13;

/// Advances a wall without excitation by `duration` \[s\].
///
/// # Errors
/// [`SolverError`] if the motion cannot be followed; the state is as it was.
pub fn advance(
    motion: &Motion,
    state: &mut State,
    duration: f64,
    memo: &mut Memo,
) -> Result<Report, SolverError> {
    let segment = Segment { duration, from: Support::default(), to: Support::default() };
    motion.advance(state, &segment, false, memo)
}

/// Returns whether free motion from `state` cannot raise `u_max/u_ins`. It cannot if the wall is between its
/// points of zero force, and its energy exceeds neither that at the peak so far nor that at these points.
pub fn peak_is_final(wall: &Wall, state: &State) -> bool {
    let (u_ins, end) = (wall.body().instability, wall.force_end());
    let ratio = state.peaks.ratio(u_ins);
    let energy = wall.energy(state.displacement, state.velocity);
    let highest = |sign: f64| {
        let peak = (ratio * u_ins.of(sign)).min(end.of(sign));
        wall.energy(sign * peak, 0.0)
    };
    state.displacement.abs() < end.of(state.displacement)
        && energy * (1.0 - ENERGY_ROUNDING) <= highest(1.0).min(highest(-1.0))
}

/// Returns a wall with restitution and no damping.
pub fn with_restitution(parameters: &Parameters, restitution: f64) -> Parameters {
    let mut rocking = Parameters { impact: Impact::Restitution, restitution, ..parameters.clone() };
    rocking.set_damping(Damping::NONE);
    rocking
}

/// Returns a wall with a damping ratio, ξ or c̄, and no impacts.
pub fn with_damping(parameters: &Parameters, model: DampingModel, ratio: f64) -> Parameters {
    let mut damped = Parameters { impact: Impact::None, restitution: COMPUTED, ..parameters.clone() };
    damped.set_damping(Damping::given(model, ratio));
    damped
}
