//! Damping models of a study.

use rocking_wall::variables::{DampingModel, ForceLaw, Impact};
use rocking_wall::wall::{COMPUTED, ParameterError, Parameters, Wall, equivalence};

/// Source of a damping ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RatioSource {
    /// Eqs. (20)–(23), from a₁ and e.
    Computed,
    /// A given damping ratio ξ, or c̄ of a free-standing block \[-\].
    Given(f64),
    /// ξ = −0.68 ln e. Makris and Konstantinidis, Eq. (14).
    Equation14,
}

/// Energy loss of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// None.
    None,
    /// Restitution at each passage of u = 0, on the wall's own force law (CR).
    Restitution,
    /// Restitution on the rigid-linear law.
    RigidRestitution,
    /// Constant damping coefficient, Eq. (6) (CDC).
    ConstantCoefficient(RatioSource),
    /// Constant damping coefficient of a free-standing block, Eq. (7).
    FreeStandingBlock(RatioSource),
    /// Constant damping ratio, Eqs. (8)–(9) (CDR).
    ConstantRatio(RatioSource),
    /// Stiffness-proportional damping ratio, Eqs. (10)–(11) (SDR).
    StiffnessProportional(RatioSource),
}

impl Damping {
    /// Returns the short name, the viscous damping and the source of its ratio.
    fn parts(self) -> (&'static str, DampingModel, RatioSource) {
        match self {
            Self::None => ("none", DampingModel::None, RatioSource::Computed),
            Self::Restitution => ("CR", DampingModel::None, RatioSource::Computed),
            Self::RigidRestitution => ("CR rigid", DampingModel::None, RatioSource::Computed),
            Self::ConstantCoefficient(source) => ("CDC", DampingModel::ConstantCoefficient, source),
            Self::FreeStandingBlock(source) => ("block", DampingModel::FreeStandingBlock, source),
            Self::ConstantRatio(source) => ("CDR", DampingModel::ConstantRatio, source),
            Self::StiffnessProportional(source) => ("SDR", DampingModel::StiffnessProportional, source),
        }
    }
}

/// A damping model and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name in tables and messages.
    pub name: String,
    /// Energy loss.
    pub damping: Damping,
}

impl Model {
    /// Names a model after its damping: `CR`, `CDC`, `CDR Eq. 14` …
    pub fn new(damping: Damping) -> Self {
        let (short, _, source) = damping.parts();
        let name = match source {
            RatioSource::Computed => short.to_owned(),
            RatioSource::Given(value) => format!("{short} {value}"),
            RatioSource::Equation14 => format!("{short} Eq. 14"),
        };
        Self { name, damping }
    }

    /// Returns the models of Figure 15 of the paper: CR, CDC, CDR, SDR, and CDR with the damping of Eq. (14).
    pub fn figure_15() -> Vec<Self> {
        let dampings = [
            Damping::Restitution,
            Damping::ConstantCoefficient(RatioSource::Computed),
            Damping::ConstantRatio(RatioSource::Computed),
            Damping::StiffnessProportional(RatioSource::Computed),
            Damping::ConstantRatio(RatioSource::Equation14),
        ];
        dampings.map(Self::new).into()
    }

    /// Returns the parameters of a wall with this model's damping and impact, upright and at rest.
    ///
    /// # Errors
    /// [`ParameterError`] if the ratio is that of Eq. (14) and the parameters make no wall, or one with e =
    /// 0.
    pub fn applied_to(&self, wall: &Parameters) -> Result<Parameters, ParameterError> {
        let mut parameters =
            Parameters { impact: Impact::None, u_start: 0.0, u_dot_start: 0.0, ..wall.clone() };
        parameters.set_damping(DampingModel::None, COMPUTED);
        if matches!(self.damping, Damping::Restitution | Damping::RigidRestitution) {
            parameters.impact = Impact::Restitution;
        }
        if self.damping == Damping::RigidRestitution {
            parameters.force_law = ForceLaw::RigidLinear;
            parameters.multilinear = None;
        }
        let (_, model, source) = self.damping.parts();
        if model == DampingModel::None {
            return Ok(parameters);
        }
        let ratio = match source {
            RatioSource::Computed => COMPUTED,
            RatioSource::Given(value) => value,
            RatioSource::Equation14 => {
                let e = Wall::new(&parameters)?.restitution();
                if e <= 0.0 {
                    return Err(ParameterError::Computed { name: "xi", restitution: e });
                }
                equivalence::makris_konstantinidis(e)
            }
        };
        parameters.set_damping(model, ratio);
        Ok(parameters)
    }
}
