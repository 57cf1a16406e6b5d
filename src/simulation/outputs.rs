//! What a wall shows of itself, and how that changes with its state and its supports.

use super::stepping::Simulation;
use crate::solver::{Demands, Phase, Start, State};
use crate::variables::Mechanism;
use crate::wall::{Ends, Support};

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
    /// Forces of the supports on the wall \[N\].
    pub reactions: Ends,
}

/// Partial derivatives of ü and of the forces with respect to one variable, for small rotations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensitivity {
    /// Of ü.
    pub acceleration: f64,
    /// Of F(u) − W d/h.
    pub restoring_force: f64,
    /// Of C u̇.
    pub damping_force: f64,
    /// Of the reactions.
    pub reactions: Ends,
}

impl Simulation {
    /// The outputs under the supports' present motion.
    #[must_use]
    pub fn outputs(&self, support: Support) -> Outputs {
        let wall = self.motion.wall();
        let body = wall.body();
        let m = body.effective_mass;
        let State { displacement, velocity, branch, phase, departed, .. } = self.progress.state;
        let damping = wall.branches()[branch].continued_damping(displacement).0 * velocity;
        let forcing = body.forcing(support);
        // of the forcing, what is not support acceleration: W d/h
        let pull = forcing - body.forcing(Support { drift: 0.0, ..support });
        let (acceleration, restoring, damping) = match phase {
            Phase::Moving => {
                let restoring = wall.restoring(branch, displacement);
                let acceleration = match wall.rotations() {
                    None => forcing - damping - restoring,
                    Some(_) => wall.acceleration(branch, displacement, velocity, forcing),
                };
                (acceleration, restoring - pull, damping)
            }
            Phase::Resting => (0.0, forcing - pull, 0.0),
            Phase::Landed => (0.0, 0.0, 0.0),
        };
        let reactions = if departed {
            Ends::default()
        } else {
            let drift = self.progress.drift || support.drift != 0.0;
            body.reactions(support, acceleration, displacement, drift)
        };
        Outputs {
            displacement,
            velocity,
            acceleration,
            ratio: displacement / body.instability.of(displacement),
            restoring_force: restoring * m,
            damping_force: damping * m,
            reactions,
        }
    }

    /// The demands of a motion that starts now, under the supports' present motion: `fractions` of `u_ins`, each above 0 and
    /// at most 1, are the limit states whose first crossings are wanted.
    #[must_use]
    pub fn demands(&self, support: Support, fractions: &[f64]) -> Demands {
        let Outputs { displacement, velocity, acceleration, reactions, .. } = self.outputs(support);
        let motion = [displacement, velocity, acceleration];
        Demands::new(self.wall(), &Start { time: self.progress.time, motion, reactions }, fractions)
    }

    /// Partial derivatives of the outputs with respect to u at fixed u̇ and under the supports' present motion.
    ///
    /// # Panics
    /// As the other derivatives, if the wall moves in full rotations.
    #[must_use]
    pub fn by_displacement(&self, support: Support) -> Sensitivity {
        let State { displacement, velocity, branch, phase, .. } = self.progress.state;
        if phase != Phase::Moving {
            return Sensitivity::default();
        }
        let branch = &self.wall().branches()[branch];
        let damping = branch.continued_damping(displacement).1 * velocity;
        let drift = self.progress.drift || support.drift != 0.0;
        let couple = if drift { self.wall().body().couple(1.0, 0.0) } else { 0.0 };
        self.sensitivity(Support::default(), -(branch.stiffness + damping), branch.stiffness, damping, couple)
    }

    /// Partial derivatives of the outputs with respect to u̇.
    ///
    /// # Panics
    /// If the wall moves in full rotations.
    #[must_use]
    pub fn by_velocity(&self) -> Sensitivity {
        let State { displacement, branch, phase, .. } = self.progress.state;
        if phase != Phase::Moving {
            return Sensitivity::default();
        }
        let damping = self.wall().branches()[branch].continued_damping(displacement).0;
        self.sensitivity(Support::default(), -damping, 0.0, damping, 0.0)
    }

    /// Derivatives of the outputs along a change of the supports' motion. A change of drift brings its couple.
    ///
    /// # Panics
    /// If the wall moves in full rotations.
    #[must_use]
    pub fn by_support(&self, change: Support) -> Sensitivity {
        let body = self.wall().body();
        let forcing = body.forcing(change);
        let pull = forcing - body.forcing(Support { drift: 0.0, ..change });
        let couple = body.couple(0.0, change.drift);
        match self.progress.state.phase {
            Phase::Moving => self.sensitivity(change, forcing, -pull, 0.0, couple),
            Phase::Resting => self.sensitivity(change, 0.0, forcing - pull, 0.0, couple),
            Phase::Landed => Sensitivity::default(),
        }
    }

    /// Rates of the outputs along the motion while the supports change at the rate `support_rate`.
    ///
    /// # Panics
    /// If the wall moves in full rotations.
    #[must_use]
    pub fn rates(&self, support: Support, support_rate: Support) -> Sensitivity {
        let now = self.outputs(support);
        let along_u = self.by_displacement(support);
        let along_v = self.by_velocity();
        let along_support = self.by_support(support_rate);
        let sum = |pick: fn(&Sensitivity) -> f64| {
            pick(&along_u) * now.velocity + pick(&along_v) * now.acceleration + pick(&along_support)
        };
        Sensitivity {
            acceleration: sum(|s| s.acceleration),
            restoring_force: sum(|s| s.restoring_force),
            damping_force: sum(|s| s.damping_force),
            reactions: Ends { bottom: sum(|s| s.reactions.bottom), top: sum(|s| s.reactions.top) },
        }
    }

    fn sensitivity(
        &self,
        change: Support,
        acceleration: f64,
        restoring: f64,
        damping: f64,
        couple: f64,
    ) -> Sensitivity {
        assert!(self.wall().rotations().is_none(), "derivatives are those of small rotations");
        let body = self.wall().body();
        let m = body.effective_mass;
        let reactions = if self.progress.state.departed {
            Ends::default()
        } else {
            // linear in accelerations, and the couple adds to it
            let plain = body.reactions(change, acceleration, 0.0, false);
            match body.mechanism {
                Mechanism::Parapet => plain,
                Mechanism::VerticalSpanning => {
                    Ends { bottom: plain.bottom - couple, top: plain.top + couple }
                }
            }
        };
        Sensitivity { acceleration, restoring_force: restoring * m, damping_force: damping * m, reactions }
    }
}
