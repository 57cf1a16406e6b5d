//! The outputs of a wall, and their derivatives.

use oscillator::KinematicState;

use super::Simulation;
use crate::solver::{Demands, Phase, State};
use crate::wall::{Ends, Sides, Support, Tie};

/// Outputs that follow from the state and the supports' present motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// u \[m\].
    pub displacement: f64,
    /// u̇ \[m/s\].
    pub velocity: f64,
    /// ü \[m/s²\].
    pub acceleration: f64,
    /// u/`u_ins` of its side \[-\].
    pub ratio: f64,
    /// F(u) − W d/h, at rest the holding force \[N\].
    pub restoring_force: f64,
    /// C u̇ \[N\].
    pub damping_force: f64,
    /// Forces of the supports on the wall \[N\]; those of ties are in them, of a strip by the law of the
    /// lever.
    pub reactions: Ends,
    /// Force N of the tie, of several their sum, tension positive \[N\].
    pub tie_force: f64,
    /// Plastic elongation p of the tie of each side, of several the largest \[m\].
    pub tie_elongation: Sides,
}

impl Simulation {
    /// Returns the outputs under the supports' present motion.
    pub fn outputs(&self, support: Support) -> Outputs {
        let State { displacement, velocity, .. } = self.progress.state;
        self.outputs_at([displacement, velocity], support)
    }

    /// Returns the outputs for another u \[m\] and u̇ \[m/s\] than the present ones, such as those at the end
    /// of a calm step. Branch, phase and ties are the present ones.
    pub fn outputs_at(&self, [displacement, velocity]: [f64; 2], support: Support) -> Outputs {
        let wall = self.wall();
        let body = wall.body();
        let m = body.effective_mass;
        let State { branch, phase, departed, .. } = self.progress.state;
        let damping = wall.branches()[branch].continued_damping(displacement).0 * velocity;
        let forcing = body.forcing(support);
        // the part of the forcing that is not acceleration of the supports: W d/h
        let pull = forcing - body.forcing(Support { drift: 0.0, ..support });
        let (acceleration, restoring, damping, couple) = match phase {
            Phase::Moving => {
                let restoring = wall.restoring(branch, displacement);
                let acceleration = match wall.rotations() {
                    None => forcing - damping - restoring,
                    Some(_) => wall.acceleration(branch, displacement, velocity, forcing),
                };
                let couple = wall.branches()[branch].couple.at(displacement);
                (acceleration, restoring - pull, damping, couple)
            }
            Phase::Resting => (0.0, forcing - pull, 0.0, wall.couple_at_rest(forcing).at(forcing)),
            Phase::Landed => (0.0, 0.0, 0.0, 0.0),
        };
        let motion = KinematicState { displacement, velocity, acceleration };
        let carried = wall.carried(wall.branches()[branch].side(), motion);
        let reactions = if departed { Ends::default() } else { body.reactions(support, carried, couple) };
        Outputs {
            displacement,
            velocity,
            acceleration,
            ratio: displacement / body.instability.of(displacement),
            restoring_force: restoring * m,
            damping_force: damping * m,
            reactions,
            tie_force: wall.tie_force(branch, displacement),
            tie_elongation: wall.tie_elongation(branch, displacement),
        }
    }

    /// Returns the demands of a motion that starts now, under the supports' present motion. `fractions` of
    /// `u_ins`, each above 0 and at most 1, are the limit states whose first crossings are wanted.
    pub fn demands(&self, support: Support, fractions: &[f64]) -> Demands {
        let Outputs { displacement, velocity, acceleration, reactions, .. } = self.outputs(support);
        let (motion, time) = ([displacement, velocity, acceleration], self.progress.time);
        let State { branch, tie: memory, .. } = self.progress.state;
        let wall = self.wall();
        let force = |tie: &Tie| wall.force_of(tie, branch, displacement);
        let mut demands = Demands::new(wall, time, motion, reactions, force, fractions);
        for (tie, demands) in wall.ties().iter().zip(&mut demands.ties) {
            demands.break_with(tie, &memory, time);
        }
        self.enter_yielding(&mut demands);
        demands
    }

    /// Enters how far the ties have yielded so far.
    pub(super) fn enter_yielding(&self, demands: &mut Demands) {
        let State { displacement, branch, .. } = self.progress.state;
        let wall = self.wall();
        for (tie, demands) in wall.ties().iter().zip(&mut demands.ties) {
            if let Some(yielding) = &mut demands.yielding {
                yielding.elongation = tie.elongations(&wall.tie_memory_at(branch, displacement));
            }
        }
    }

    /// Returns the derivative of the outputs along a change of u, of u̇ and of the supports' motion, which is
    /// `support` now.
    pub fn derivative(&self, support: Support, [du, dv]: [f64; 2], change: Support) -> Outputs {
        let wall = self.wall();
        let body = wall.body();
        let m = body.effective_mass;
        let State { displacement, velocity, branch, phase, departed, .. } = self.progress.state;
        // dN/du = ±K times the lever
        let tie_force = wall.tie_slope(branch) * displacement.signum() * du;
        let (number, branch) = (branch, &wall.branches()[branch]);
        let mut tie_elongation = Sides::default();
        if let Some(side) = branch.yielding_side() {
            // dp/du = ± the lever, of the tie that is the longest
            *tie_elongation.of_mut(side) = wall.elongating_lever(number, displacement) * side * du;
        }
        let forcing = body.forcing(change);
        let pull = forcing - body.forcing(Support { drift: 0.0, ..change });
        let mut carried = None;
        let (acceleration, restoring, damping) = match (phase, wall.rotations()) {
            (Phase::Moving, Some(rotations)) => {
                let (side, now) = (branch.side(), body.forcing(support));
                let acceleration = rotations.acceleration(displacement, velocity, now, side);
                let motion = KinematicState { displacement, velocity, acceleration };
                let acceleration = rotations.acceleration_change(side, motion, now, [du, dv, forcing]);
                carried = Some(rotations.carried_change(side, motion, [du, dv, acceleration]));
                (acceleration, rotations.restoring_change(side, displacement, du) - pull, 0.0)
            }
            (Phase::Moving, None) => {
                let (c, slope) = branch.continued_damping(displacement);
                let damping = c * dv + slope * velocity * du;
                let restoring = branch.stiffness * du;
                (forcing - damping - restoring, restoring - pull, damping)
            }
            (Phase::Resting, _) => (0.0, forcing - pull, 0.0),
            (Phase::Landed, _) => (0.0, 0.0, 0.0),
        };
        let carried = carried.unwrap_or(acceleration);
        let reactions = match phase {
            Phase::Landed => Ends::default(),
            _ if departed => Ends::default(),
            Phase::Moving => body.reaction_changes(change, carried, branch.couple.slope * du),
            Phase::Resting => {
                let couple = wall.couple_at_rest(body.forcing(support));
                body.reaction_changes(change, acceleration, couple.slope * forcing)
            }
        };
        Outputs {
            displacement: du,
            velocity: dv,
            acceleration,
            ratio: du / body.instability.of(displacement),
            restoring_force: restoring * m,
            damping_force: damping * m,
            reactions,
            tie_force,
            tie_elongation,
        }
    }
}
