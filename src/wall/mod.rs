//! The wall: parameters in, a validated equation of motion out.
//!
//! ```text
//! m_eff ü + C(u) u̇ + F(u) = −λ m_eff a_eff                                              Eq. (12)
//! ```
//!
//! A [`Wall`] that exists is valid and never changes. It is a short sorted list of [`Branch`]es, straight pieces of the
//! restoring force per unit effective mass, and of the [`Corner`]s between them; a solver sees only the branch it is on.

mod capacity;
mod continuation;
mod damping;
pub mod equivalence;
mod error;
mod force_law;
mod layout;
mod mechanism;
mod parameters;
pub mod restitution;
mod supports;
mod trigonometric;

pub use capacity::CapacityPoint;
pub use damping::BranchDamping;
pub use error::{ParameterError, Warning};
pub use force_law::Line;
pub use mechanism::Body;
pub use parameters::Parameters;
pub use supports::{Ends, Support};
pub use trigonometric::{FullRotations, Kinematics};

use damping::Damping;
use force_law::RestoringForce;

use crate::variables::{DampingModel, DampingSource, Impact, Mechanism};

/// One quantity on the sides u > 0 and u < 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    /// Side u > 0.
    pub positive: f64,
    /// Side u < 0, as a positive number.
    pub negative: f64,
}

impl Sides {
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { positive: f(self.positive), negative: f(self.negative) }
    }

    /// The value of the side on which `displacement` lies; u = 0 belongs to the positive one.
    #[must_use]
    pub fn of(self, displacement: f64) -> f64 {
        if displacement < 0.0 { self.negative } else { self.positive }
    }
}

/// A straight piece of the restoring force per unit effective mass, with its damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Displacements the branch spans \[m\].
    pub lower: f64,
    /// See `lower`.
    pub upper: f64,
    /// Displacement of the line's anchor \[m\].
    pub anchor: f64,
    /// F/`m_eff` at the anchor \[m/s²\].
    pub force: f64,
    /// Slope of F/`m_eff` \[1/s²\].
    pub stiffness: f64,
    /// Damping on the branch.
    pub damping: BranchDamping,
}

impl Branch {
    /// F/`m_eff` \[m/s²\].
    #[must_use]
    pub fn restoring(&self, displacement: f64) -> f64 {
        self.force + self.stiffness * (displacement - self.anchor)
    }

    /// 1 for u > 0, −1 for u < 0.
    #[must_use]
    pub fn side(&self) -> f64 {
        if self.upper > 0.0 { 1.0 } else { -1.0 }
    }

    /// C/`m_eff` \[1/s\].
    #[must_use]
    pub fn damping_at(&self, displacement: f64) -> f64 {
        match self.damping {
            BranchDamping::Constant(c) => c,
            // ω² = F/(u m_eff); the branch through u = 0 has constant damping
            secant => secant.coefficient(self.restoring(displacement) / displacement),
        }
    }

    /// d(C/`m_eff`)/du \[1/(m s)\].
    #[must_use]
    pub fn damping_slope(&self, displacement: f64) -> f64 {
        if let BranchDamping::Constant(_) = self.damping {
            return 0.0;
        }
        let omega_squared = self.restoring(displacement) / displacement;
        // d(F/u)/du = (k − F/u)/u
        self.damping.sensitivity(omega_squared) * (self.stiffness - omega_squared) / displacement
    }

    /// Relative acceleration, ü = p − c u̇ − F/`m_eff`, under the forcing p \[m/s²\].
    #[must_use]
    pub fn acceleration(&self, displacement: f64, velocity: f64, forcing: f64) -> f64 {
        forcing - self.damping_at(displacement) * velocity - self.restoring(displacement)
    }
}

/// What happens where two branches meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "independent marks of one place")]
pub struct Corner {
    /// Place \[m\].
    pub displacement: f64,
    /// Passing it is an impact, or a jump of the rigid force.
    pub passage: bool,
    /// Beyond it the wall has overturned.
    pub overturning: bool,
    /// Beyond it the wall has left its supports.
    pub departure: bool,
    /// Here the wall lies down.
    pub landing: bool,
}

impl Corner {
    /// Whether anything but a change of branch happens here.
    #[must_use]
    pub fn is_marked(&self) -> bool {
        self.passage || self.overturning || self.departure || self.landing
    }
}

/// A validated wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    body: Body,
    force: RestoringForce,
    rotations: Option<FullRotations>,
    damping: Damping,
    restitution: f64,
    impact: bool,
    branches: Vec<Branch>,
    corners: Vec<Corner>,
    warnings: Vec<Warning>,
}

/// Fraction of u₃ before which a constant damping ratio is dropped, so that no solver meets the root of √(u₃ − u).
///
/// The work left out is ∫C du = (4/3) ξ ω₀ δ^{3/2} √(`m_eff`…), 1e-15 ξ of the scale of u̇ for δ = 1e-10 u₃.
const RATIO_CUTOFF: f64 = 1e-10;

/// Parts in which a curved force is drawn between two corners.
const DRAWN_PARTS: u32 = 8;

impl Wall {
    /// Checks the relations between parameters and lays out the branches.
    ///
    /// # Errors
    /// [`ParameterError`], with the values, the limit and the remedy.
    pub fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let mut body = Body::new(parameters)?;
        let rotations = match parameters.kinematics {
            Kinematics::Linear => None,
            Kinematics::Trigonometric => Some(FullRotations::new(parameters, &body)?),
        };
        let force = RestoringForce::new(parameters, &body)?;
        let restitution = restitution::coefficient(parameters, &body)?;
        let damping = Damping::new(parameters, &body, &force, restitution)?;
        let impact = parameters.impact == Impact::Restitution;
        let warnings = Warning::collect(parameters, &body, &force, impact);
        if let Some(rotations) = &rotations {
            body.turn_fully(rotations);
        }
        let mut wall = Self {
            body,
            force,
            rotations,
            damping,
            restitution,
            impact,
            branches: Vec::new(),
            corners: Vec::new(),
            warnings,
        };
        wall.lay_out();
        wall.check_start(parameters.u_start)?;
        Ok(wall)
    }

    /// Masses, geometry and the rigid force.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Branches in order of displacement; branch `i` lies between corners `i` and `i + 1`.
    #[must_use]
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// Corners in order of displacement, the two landings first and last.
    #[must_use]
    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// What the user should know about a valid choice of parameters.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Whether the force is rigid-linear: it jumps at u = 0, and the wall can rest.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.force.elastic_stiffness.is_none()
    }

    /// The wall in full rotations, unless they are taken as small.
    #[must_use]
    pub fn rotations(&self) -> Option<&FullRotations> {
        self.rotations.as_ref()
    }

    /// Whether C is constant on every branch.
    #[must_use]
    pub fn has_constant_damping(&self) -> bool {
        self.damping.is_constant()
    }

    /// Whether the motion on each branch has a closed form: C is constant there, and rotations are small.
    #[must_use]
    pub fn has_closed_form(&self) -> bool {
        self.rotations.is_none() && self.has_constant_damping()
    }

    /// F/`m_eff` on a branch \[m/s²\].
    #[must_use]
    pub fn restoring(&self, branch: usize, displacement: f64) -> f64 {
        let branch = &self.branches[branch];
        match &self.rotations {
            None => branch.restoring(displacement),
            Some(rotations) => rotations.restoring(displacement, branch.side()),
        }
    }

    /// ü on a branch under the forcing p \[m/s²\].
    #[must_use]
    pub fn acceleration(&self, branch: usize, displacement: f64, velocity: f64, forcing: f64) -> f64 {
        let branch = &self.branches[branch];
        match &self.rotations {
            None => branch.acceleration(displacement, velocity, forcing),
            Some(rotations) => rotations.acceleration(displacement, velocity, forcing, branch.side()),
        }
    }

    /// Elastic circular frequency ω₁ = √(k₁/`m_eff`) \[rad/s\]; 0 for the rigid-linear law.
    #[must_use]
    pub fn omega1(&self) -> f64 {
        self.force.elastic_stiffness.map_or(0.0, |k1| (k1 / self.body.effective_mass).sqrt())
    }

    /// Damping ratio in use \[-\]: ξ, ξ₁, the equivalent of c̄ at ω₁, or 0.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        self.damping.ratio
    }

    /// Damping coefficient on the elastic branch C \[N s/m\].
    #[must_use]
    pub fn elastic_damping(&self) -> f64 {
        self.damping.elastic * self.body.effective_mass
    }

    /// Coefficient of restitution in use, at impacts or behind predicted damping \[-\].
    #[must_use]
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Factor on u̇ at a passage of u = 0: e, or 1 without impact.
    #[must_use]
    pub fn passage_factor(&self) -> f64 {
        if self.impact { self.restitution } else { 1.0 }
    }

    /// Displacements at which the force falls to zero, u₃ of each side \[m\].
    #[must_use]
    pub fn force_end(&self) -> Sides {
        Sides { positive: self.force.positive.end, negative: self.force.negative.end }
    }

    /// Forces per unit effective mass within which a rigid wall rests, −F₀⁻/`m_eff` and F₀⁺/`m_eff` \[m/s²\].
    #[must_use]
    pub fn rest_band(&self) -> [f64; 2] {
        // of the branches themselves, so that a wall beyond the band is accelerated away from it bit for bit
        [-1.0, 1.0].map(|direction| self.restoring(self.branch_of(0.0, direction), 0.0))
    }

    /// Speed below which a rigid wall comes to rest at u = 0, 1e-13 `u_ins` √(k₀/`m_eff`) \[m/s\].
    #[must_use]
    pub fn rest_speed(&self) -> f64 {
        1e-13 * self.displacement_scale() * self.rocking_rate()
    }

    /// √(k₀/`m_eff`), the rate at which a tilted wall falls \[1/s\].
    #[must_use]
    pub fn rocking_rate(&self) -> f64 {
        (self.body.geometric_stiffness / self.body.effective_mass).sqrt()
    }

    /// Energy per unit effective mass, ½ u̇² + ∫F du/`m_eff` from 0 \[m²/s²\]. For a strip twice the physical one, as Eq. (12) is.
    #[must_use]
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
    #[must_use]
    pub fn displacement_scale(&self) -> f64 {
        self.body.instability.positive.max(self.body.instability.negative)
    }

    /// The branch of a displacement; at a corner the one into which a motion of the given `direction` leads, at
    /// rest the outer one.
    #[must_use]
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
    #[must_use]
    pub fn backbone(&self) -> Vec<(f64, f64)> {
        let m = self.body.effective_mass;
        let mut points: Vec<(f64, f64)> = Vec::with_capacity(2 * self.branches.len());
        // the branch before u₃ that only drops the damping is no corner of the force
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

    /// # Errors
    /// [`ParameterError::StartBeyondLanding`].
    fn check_start(&self, u_start: f64) -> Result<(), ParameterError> {
        let limit = self.body.landing.of(u_start);
        if u_start.abs() < limit {
            Ok(())
        } else {
            Err(ParameterError::StartBeyondLanding { u_start, limit })
        }
    }
}
