//! Viscous damping: the coefficient C(u) of Eq. (12), per unit effective mass.

use crate::choices::DampingModel;

use super::equivalence;
use super::error::ParameterError;
use super::force_law::RestoringForce;
use super::mechanism::Body;
use super::parameters::{Parameters, given};

/// Damping per unit effective mass, c(u) = C(u)/`m_eff` \[1/s\], on one branch of the restoring force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BranchDamping {
    /// c is constant.
    Constant(f64),
    /// c = 2ξ ω(u), constant damping ratio on the secant frequency, Eqs. (8)–(9). Holds 2ξ.
    SecantRatio(f64),
    /// c = (2 ξ₁/ω₁) ω(u)², stiffness-proportional ratio, Eqs. (10)–(11). Holds 2 ξ₁/ω₁ \[s\].
    SecantStiffness(f64),
}

impl BranchDamping {
    /// c \[1/s\] where the secant stiffness per unit mass is ω² \[1/s²\]; none for ω² ≤ 0.
    pub fn coefficient(self, omega_squared: f64) -> f64 {
        match self {
            Self::Constant(c) => c,
            Self::SecantRatio(twice_xi) => twice_xi * omega_squared.max(0.0).sqrt(),
            Self::SecantStiffness(factor) => factor * omega_squared.max(0.0),
        }
    }

    /// dc/d(ω²) \[s\]; zero for a constant coefficient and where there is no damping.
    pub fn sensitivity(self, omega_squared: f64) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            _ if omega_squared <= 0.0 => 0.0,
            Self::SecantRatio(twice_xi) => 0.5 * twice_xi / omega_squared.sqrt(),
            Self::SecantStiffness(factor) => factor,
        }
    }
}

/// The damping of a wall: the model and the numbers in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Damping {
    pub(super) model: DampingModel,
    /// ξ in use \[-\]: for a free-standing block its equivalent at ω₁, and 0 where there is none.
    pub(super) ratio: f64,
    /// C/`m_eff` on the elastic branch, and everywhere for a constant coefficient \[1/s\].
    pub(super) elastic: f64,
    /// ξ or c̄ is computed from e, Eqs. (20)–(23).
    pub(super) is_computed: bool,
    omega1: f64,
}

impl Damping {
    /// # Errors
    /// [`ParameterError::NoElasticBranch`] where CDC, CDR or SDR meets the rigid-linear law;
    /// [`ParameterError::Computed`] where e = 0 leaves none to compute; [`ParameterError::NotGiven`].
    pub(super) fn new(
        parameters: &Parameters,
        body: &Body,
        force: &RestoringForce,
        restitution: f64,
    ) -> Result<Self, ParameterError> {
        let model = parameters.damping_model;
        let omega1 = force.omega1(body.effective_mass);
        let needs_none = matches!(model, DampingModel::None | DampingModel::FreeStandingBlock);
        if force.elastic_stiffness.is_none() && !needs_none {
            return Err(ParameterError::NoElasticBranch { model: model.name() });
        }
        let (xi, c_bar) = (given("xi", parameters.xi)?, given("c_bar", parameters.c_bar)?);
        let (name, number) = match model {
            DampingModel::FreeStandingBlock => ("c_bar", c_bar),
            _ => ("xi", xi),
        };
        let value = match number {
            Some(number) => number,
            None if model != DampingModel::None && restitution <= 0.0 => {
                return Err(ParameterError::Computed { name, restitution });
            }
            None => equivalence::predicted(model, force.elastic_fraction, restitution),
        };
        let (ratio, elastic) = match model {
            DampingModel::None => (0.0, 0.0),
            DampingModel::FreeStandingBlock => {
                // C = m_eff √(g/(h/2)) c̄
                let c = (parameters.gravity / (body.height / 2.0)).sqrt() * value;
                (if omega1 > 0.0 { c / (2.0 * omega1) } else { 0.0 }, c)
            }
            // C = 2 m_eff ω₁ ξ on the elastic branch, for all three
            _ => (value, 2.0 * omega1 * value),
        };
        let is_computed = model != DampingModel::None && number.is_none();
        Ok(Self { model, ratio, elastic, is_computed, omega1 })
    }

    /// Whether C is constant on every branch.
    pub(super) fn is_constant(&self) -> bool {
        !matches!(self.model, DampingModel::ConstantRatio | DampingModel::StiffnessProportional)
    }

    /// The damping on a branch off the elastic one, before the force falls to zero.
    pub(super) fn on_curved_branch(&self) -> BranchDamping {
        match self.model {
            DampingModel::ConstantRatio => BranchDamping::SecantRatio(2.0 * self.ratio),
            DampingModel::StiffnessProportional => {
                // no division by zero even where the compiler computes this ahead, for the rigid-linear law
                BranchDamping::SecantStiffness(2.0 * self.ratio / self.omega1.max(f64::MIN_POSITIVE))
            }
            _ => BranchDamping::Constant(self.elastic),
        }
    }

    /// The damping beyond u₃, where the secant stiffness is negative.
    pub(super) fn beyond_end(&self) -> BranchDamping {
        BranchDamping::Constant(if self.is_constant() { self.elastic } else { 0.0 })
    }
}
