//! Whether free motion can still raise the peak of a wall.

use rocking_wall::solver::State;
use rocking_wall::wall::Wall;

/// Energy over that of the peak by which rounding may exceed it.
const ENERGY_ROUNDING: f64 = 1e-13;

/// Whether free motion from here cannot raise `u_max/u_ins`: inside the well, with no more energy than its rim or the peak has.
pub(super) fn has_peaked(wall: &Wall, state: &State) -> bool {
    let (u_ins, end) = (wall.body().instability, wall.force_end());
    let ratio = state.peaks.ratio(u_ins);
    let energy = wall.energy(state.displacement, state.velocity);
    let rim = |sign: f64| {
        let peak = (ratio * u_ins.of(sign)).min(end.of(sign));
        wall.energy(sign * peak, 0.0)
    };
    state.displacement.abs() < end.of(state.displacement)
        && energy * (1.0 - ENERGY_ROUNDING) <= rim(1.0).min(rim(-1.0))
}
