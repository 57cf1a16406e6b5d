//! The paper's own scheme: Newmark linear acceleration without iteration at a fixed step.
//!
//! Tangent stiffness and damping are those at the start of the step, and the acceleration is reset from
//! equilibrium at each start (Chopra, Dynamics of Structures, section 15). Corners are not located: this
//! scheme is here to show their cost. Within a step the acceleration is linear, so the motion is a cubic, on
//! which overturning, impacts and the end of the fall are located.

use oscillator::KinematicState;

use crate::wall::Branch;

use super::adaptive::Series;

/// Computes one step of `duration` \[s\] from `start`, which is in equilibrium, while the forcing grows by
/// `forcing_change` \[m/s²\].
pub(super) fn step(
    branch: &Branch,
    start: KinematicState,
    forcing_change: f64,
    duration: f64,
) -> Series<'static> {
    let KinematicState { displacement, velocity, acceleration } = start;
    let (h, c, k) = (duration, branch.damping_at(displacement), branch.stiffness);
    // per unit effective mass: k̂ = k + 3c/h + 6/h²
    let effective_stiffness = k + 3.0 * c / h + 6.0 / (h * h);
    // Δp̂ = Δp + (6/h + 3c) u̇ + (3 + c h/2) ü
    let effective_forcing =
        forcing_change + (6.0 / h + 3.0 * c) * velocity + (3.0 + 0.5 * c * h) * acceleration;
    let change = effective_forcing / effective_stiffness;
    // Δü = 6/h² Δu − 6/h u̇ − 3 ü
    let acceleration_change = 6.0 / (h * h) * change - 6.0 / h * velocity - 3.0 * acceleration;
    Series::cubic(start, acceleration_change / h, duration)
}
