//! Free motion of a wall, with impacts or with viscous damping.

use std::borrow::Cow;

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

/// Returns a wall with its ties as they are in a state of its motion: stretched, or broken.
pub fn as_in<'a>(wall: &'a Wall, state: &State) -> Cow<'a, Wall> {
    if state.tie == *wall.tie_memory() {
        return Cow::Borrowed(wall);
    }
    Cow::Owned(wall.clone().with_tie_memory(state.tie))
}

/// Returns whether free motion from `state` cannot raise `u_max/u_ins`. It cannot if the wall is between its
/// points of zero force, and its energy exceeds neither that at the peak so far nor that at these points.
/// Ties count as they are now. One that yields on takes energy, which is part of that at the peak.
pub fn peak_is_final(wall: &Wall, state: &State) -> bool {
    let wall = as_in(wall, state);
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

#[cfg(test)]
mod tests {
    use rocking_wall::choices::{ForceLaw, TieSide};
    use rocking_wall::wall::{Sides, TieMemory};

    use super::*;

    /// A wall of 270 J, whose tie keeps it below 0.06 m while it is whole and not stretched: with its tie
    /// broken the energy brings it beyond.
    #[test]
    fn ties_count_as_they_are_now() {
        let parameters = Parameters {
            height: 3.0,
            thickness: 0.3,
            force_law: ForceLaw::RigidLinear,
            damping_model: DampingModel::None,
            tie_height: 2.6,
            tie_stiffness: 2e5,
            tie_strength: 3e3,
            tie_ultimate: 1.0,
            tie_side: TieSide::Both,
            ..Parameters::default()
        };
        let motion = Motion::of(&parameters, 1e-8).expect("a valid wall");
        let wall = motion.wall();
        let mut state = motion.start(0.0, 0.5, Support::default());
        // between the potential of the peak with the tie as it was at first, and without it
        state.peaks.include(0.06);
        state.peaks.include(-0.06);
        let [tied, free] = [TieMemory::default(), TieMemory { lost: true, ..TieMemory::default() }]
            .map(|tie| peak_is_final(wall, &State { tie, ..state }));
        assert!(tied && !free);
        // a tie that has been stretched to 0.059 m is slack almost up to there
        let yielded = Sides { positive: 0.059, negative: 0.059 };
        assert!(!peak_is_final(wall, &State { tie: TieMemory { yielded, lost: false }, ..state }));
    }
}
