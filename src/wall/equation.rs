//! The validated equation of motion of a wall, Eq. (12).

use oscillator::KinematicState;

use crate::choices::{Impact, Rocking};

use super::branch::{Branch, Corner};
use super::damping::{Damping, DampingLaw, RATIO_CUTOFF};
use super::error::ParameterError;
use super::force_law::RestoringForce;
use super::impact;
use super::mechanism::Body;
use super::parameters::{Kinematics, Parameters};
use super::sides::Sides;
use super::statics::Statics;
use super::tie::TieMemory;
use super::ties::Ties;
use super::trigonometric::FullRotations;
use super::warning::Warning;
use super::warnings;

/// A validated wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    statics: Statics,
    rotations: Option<FullRotations>,
    tie_memory: TieMemory,
    pub(super) damping: DampingLaw,
    restitution: Sides,
    pub(super) impact: bool,
    rocking: Rocking,
    branches: Vec<Branch>,
    corners: Vec<Corner>,
    warnings: Vec<Warning>,
}

/// Number of straight parts that draw a curved force between two corners.
const DRAWN_PARTS: u32 = 8;

impl Wall {
    /// Checks the relations between parameters and lays out the branches.
    ///
    /// # Errors
    /// [`ParameterError`], with the values, the limit and the remedy; numbers that walls rarely have come
    /// first, since they may be the cause.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        Self::checked(parameters).map_err(|error| error.with_doubts(parameters.unusual().collect()))
    }

    fn checked(parameters: &Parameters) -> Result<Self, ParameterError> {
        let mut body = Body::new(parameters)?;
        let asked = Damping::of(parameters)?;
        let restitution = impact::coefficient(parameters, asked, &body)?;
        let rotations = match parameters.kinematics {
            Kinematics::Linear => None,
            Kinematics::Trigonometric => Some(FullRotations::new(parameters, &body)?),
        };
        let force = RestoringForce::new(parameters, &body)?;
        let damping = DampingLaw::new(asked, parameters, &body, &force, restitution.least())?;
        let impact = parameters.impact == Impact::Restitution;
        if let Some(rotations) = &rotations {
            body.turn_fully(rotations);
        }
        let ties = Ties::new(parameters, &body)?;
        let at_impacts = impact.then_some(restitution.most());
        let warnings = warnings::collect(parameters, &body, &force, &ties, &damping, at_impacts);
        let rocking = parameters.rocking;
        let wall = Self {
            statics: Statics { body, force, ties },
            rotations,
            tie_memory: TieMemory::default(),
            damping,
            restitution,
            impact,
            rocking,
            branches: Vec::new(),
            corners: Vec::new(),
            warnings,
        };
        Ok(wall.with_tie_memory(TieMemory::default()))
    }

    /// Returns the wall with its ties as they are with a memory. Where they have yielded, they have other
    /// corners; slopes stay the same.
    #[must_use]
    pub fn with_tie_memory(mut self, memory: TieMemory) -> Self {
        self.tie_memory = memory;
        self.corners = self.lay_out_corners();
        self.branches = self.lay_out_branches();
        self
    }

    /// The wall at rest.
    pub fn statics(&self) -> &Statics {
        &self.statics
    }

    /// Returns F₀ \[N\] and `u_ins` \[m\] of the side of `sign` as they are stated; a side that transverse
    /// walls hold may have no strength, F₀ ≤ 0 and `u_ins` = 0.
    pub fn stated(&self, sign: f64) -> [f64; 2] {
        let own = self.body().held.filter(|_| !self.rocking.allows(sign));
        let body = self.body();
        own.map_or([body.strength.of(sign), body.instability.of(sign)], |force| [force, 0.0])
    }

    /// Masses, geometry and the rigid force.
    pub fn body(&self) -> &Body {
        &self.statics.body
    }

    /// Branches in order of displacement; branch `i` lies between corners `i` and `i + 1`.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Corners in order of displacement, the two landings first and last.
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// Warnings about a valid choice of parameters.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Returns whether the force is rigid-linear: it jumps at u = 0.
    pub fn is_rigid(&self) -> bool {
        self.statics.force.elastic_stiffness.is_none()
    }

    /// Returns whether the wall can rest at u = 0: by the jump of its force, or against transverse walls.
    pub fn can_rest(&self) -> bool {
        self.is_rigid() || self.free_side().is_some()
    }

    /// Returns the sign of u to which the wall can rock, if it can rock to one side only.
    pub fn free_side(&self) -> Option<f64> {
        self.rocking.free_side()
    }

    /// Checks a displacement \[m\] at which a run is to start.
    ///
    /// # Errors
    /// [`ParameterError::StartsBehindWalls`], [`ParameterError::StartsOverturned`].
    pub fn check_start(&self, u_start: f64) -> Result<(), ParameterError> {
        if self.free_side().is_some_and(|side| side * u_start < 0.0) {
            return Err(ParameterError::StartsBehindWalls { u_start, rocking: self.rocking.name() });
        }
        let u_ins = self.statics.body.instability.of(u_start);
        if u_start.abs() <= u_ins {
            return Ok(());
        }
        Err(ParameterError::StartsOverturned { u_start, u_ins })
    }

    /// The signs of u to which the wall can rock.
    pub fn sides(&self) -> impl Iterator<Item = f64> + use<> {
        let rocking = self.rocking;
        [1.0, -1.0].into_iter().filter(move |sign| rocking.allows(*sign))
    }

    /// Returns whether both sides are alike. A motion and its reverse then place the same demands on the
    /// wall.
    pub fn has_equal_sides(&self) -> bool {
        let one_tied = self.ties().iter().any(|tie| tie.holds(1.0) != tie.holds(-1.0));
        self.statics.has_equal_sides()
            && self.restitution.positive == self.restitution.negative
            && self.rotations.as_ref().is_none_or(FullRotations::has_equal_sides)
            && self.sides().count() == 2
            && !one_tied
    }

    /// The wall in full rotations; `None` where they are taken as small.
    pub fn rotations(&self) -> Option<&FullRotations> {
        self.rotations.as_ref()
    }

    /// Returns whether C is constant on every branch.
    pub fn has_constant_damping(&self) -> bool {
        self.damping.rocking.constant().is_some()
    }

    /// Returns whether the motion on each branch has a closed form: C is constant there, and rotations are
    /// small.
    pub fn has_closed_form(&self) -> bool {
        self.rotations.is_none() && self.has_constant_damping()
    }

    /// F/`m_eff` on a branch \[m/s²\].
    pub fn restoring(&self, branch: usize, displacement: f64) -> f64 {
        let branch = &self.branches[branch];
        match &self.rotations {
            None => branch.restoring(displacement),
            Some(rotations) => rotations.restoring(displacement, branch.side()),
        }
    }

    /// ü on a branch under the forcing p \[m/s²\].
    pub fn acceleration(&self, branch: usize, displacement: f64, velocity: f64, forcing: f64) -> f64 {
        let branch = &self.branches[branch];
        match &self.rotations {
            None => branch.acceleration(displacement, velocity, forcing),
            Some(rotations) => rotations.acceleration(displacement, velocity, forcing, branch.side()),
        }
    }

    /// Returns ü of what the reaction of the base carries, on the side of `sign` \[m/s²\]: in full rotations
    /// loads that move along are displaced by more than u in proportion.
    pub(crate) fn carried(&self, sign: f64, motion: KinematicState) -> f64 {
        self.rotations.as_ref().map_or(motion.acceleration, |rotations| rotations.carried(sign, motion))
    }

    /// The ties.
    pub fn ties(&self) -> &Ties {
        &self.statics.ties
    }

    /// What they remember; branches and corners are those of ties with this memory.
    pub fn tie_memory(&self) -> &TieMemory {
        &self.tie_memory
    }

    /// Elastic circular frequency ω₁ = √(k₁/`m_eff`) \[rad/s\]; 0 for the rigid-linear law.
    pub fn omega1(&self) -> f64 {
        self.statics.force.omega1(self.statics.body.effective_mass)
    }

    /// The damping in use: the model with its own ratio \[-\], given or computed.
    pub fn damping(&self) -> Damping {
        let DampingLaw { asked: Damping { model, .. }, own_ratio, .. } = self.damping;
        Damping { model, ratio: model.ratio().map(|_| own_ratio) }
    }

    /// Damping ratio in use \[-\]: ξ, ξ₁, the equivalent of c̄ at ω₁, or 0.
    pub fn damping_ratio(&self) -> f64 {
        self.damping.ratio
    }

    /// Damping coefficient on the elastic branch C \[N s/m\].
    pub fn elastic_damping(&self) -> f64 {
        self.damping.elastic * self.statics.body.effective_mass
    }

    /// Coefficient of restitution in use, at impacts or behind computed damping, e₁ against transverse walls
    /// \[-\]: of a passage from u > 0 to u < 0 (`positive`) and back. −1 where none is given or known.
    pub fn restitution(&self) -> Sides {
        self.restitution
    }

    /// Factor on u̇ at a passage of u = 0 at a `velocity` of this sign: e of the direction, or 1 without
    /// impact; −e₁ where transverse walls turn it back.
    pub fn passage_factor(&self, velocity: f64) -> f64 {
        match (self.impact, self.rocking) {
            (false, _) => 1.0,
            (true, Rocking::TwoSided) => self.restitution.of(-velocity),
            (true, _) => -self.restitution.positive,
        }
    }

    /// Displacements at which the force falls to zero, u₃ of each side \[m\].
    pub fn force_end(&self) -> Sides {
        self.statics.force_end()
    }

    /// Forces per unit effective mass within which a wall rests, −F₀⁻/`m_eff` and F₀⁺/`m_eff`, or 0 for an
    /// elastic branch; without a bound towards transverse walls \[m/s²\].
    pub fn rest_band(&self) -> [f64; 2] {
        [-1.0, 1.0].map(|direction| {
            if self.free_side() == Some(-direction) {
                return f64::INFINITY * direction;
            }
            // computed from the branches: with the same rounding as the acceleration, a wall just outside the
            // band does accelerate away
            self.restoring(self.branch_of(0.0, direction), 0.0)
        })
    }

    /// Speed below which a rigid wall comes to rest at u = 0, 1e-13 `u_ins` √(k₀/`m_eff`) \[m/s\].
    pub fn rest_speed(&self) -> f64 {
        1e-13 * self.displacement_scale() * self.rocking_rate()
    }

    /// √(k₀/`m_eff`), the rate at which a tilted wall falls \[1/s\].
    pub fn rocking_rate(&self) -> f64 {
        (self.statics.body.geometric_stiffness / self.statics.body.effective_mass).sqrt()
    }

    /// Energy per unit effective mass, ½ u̇² + ∫F du/`m_eff` from 0 \[m²/s²\]. For a strip it is twice the
    /// physical one, as Eq. (12) is.
    pub fn energy(&self, displacement: f64, velocity: f64) -> f64 {
        if let Some(rotations) = &self.rotations {
            return rotations.energy(displacement, velocity);
        }
        let (low, high) = (displacement.min(0.0), displacement.max(0.0));
        // trapezoids are exact on straight lines
        let part = |branch: &Branch| {
            let (from, to) = (branch.lower.max(low), branch.upper.min(high));
            if from < to { 0.5 * (branch.restoring(from) + branch.restoring(to)) * (to - from) } else { 0.0 }
        };
        let potential: f64 = self.branches.iter().map(part).sum();
        0.5 * velocity * velocity + if displacement < 0.0 { -potential } else { potential }
    }

    /// The larger `u_ins`, to which errors and tolerances refer \[m\].
    pub fn displacement_scale(&self) -> f64 {
        self.statics.body.instability.positive.max(self.statics.body.instability.negative)
    }

    /// Returns the branch of a displacement. At a corner it is the one ahead of a motion of the given
    /// `direction`, at rest the outer one.
    pub fn branch_of(&self, displacement: f64, direction: f64) -> usize {
        let last = self.branches.len() - 1;
        let outward = if direction == 0.0 { displacement } else { direction };
        let index = if outward < 0.0 {
            self.corners.partition_point(|corner| corner.displacement < displacement)
        } else {
            self.corners.partition_point(|corner| corner.displacement <= displacement)
        };
        index.saturating_sub(1).min(last)
    }

    /// Corners (u, F) of the restoring force from landing to landing, for drawing \[m, N\].
    pub fn backbone(&self) -> Vec<(f64, f64)> {
        let m = self.statics.body.effective_mass;
        let mut points: Vec<(f64, f64)> = Vec::with_capacity(2 * self.branches.len());
        // the short branch before u₃ only drops the damping
        let branches = self.branches.iter().enumerate();
        let drawn = branches.filter(|(_, b)| b.upper - b.lower > 2.0 * RATIO_CUTOFF * b.upper.abs());
        for (index, branch) in drawn {
            // full rotations bend the line
            let parts = if self.rotations.is_some() { DRAWN_PARTS } else { 1 };
            for part in 0..=parts {
                let share = f64::from(part) / f64::from(parts);
                let u = branch.lower * (1.0 - share) + branch.upper * share;
                let point = (u, self.restoring(index, u) * m);
                if points.last() != Some(&point) {
                    points.push(point);
                }
            }
        }
        points
    }
}
