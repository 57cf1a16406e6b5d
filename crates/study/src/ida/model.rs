//! Damping models of a study.

use rocking_wall::variables::{DampingModel, DampingSource, ForceLaw, Impact};
use rocking_wall::wall::{ParameterError, Parameters, Wall, equivalence};

/// Where a damping ratio comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Eqs. (20)–(23), from a₁ and e.
    Predicted,
    /// A damping ratio ξ, or c̄ of a free-standing block \[-\].
    Given(f64),
    /// ξ = −0.68 ln e. Makris and Konstantinidis, Eq. (14).
    Equation14,
}

/// How a wall loses energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// Not at all.
    None,
    /// Restitution at each passage of u = 0, on the wall's own force law (CR).
    Restitution,
    /// Restitution on the rigid-linear law.
    RigidRestitution,
    /// Constant damping coefficient, Eq. (6) (CDC).
    ConstantCoefficient(Source),
    /// Constant damping coefficient of a free-standing block, Eq. (7).
    FreeStandingBlock(Source),
    /// Constant damping ratio, Eqs. (8)–(9) (CDR).
    ConstantRatio(Source),
    /// Stiffness-proportional damping ratio, Eqs. (10)–(11) (SDR).
    StiffnessProportional(Source),
}

/// A damping model and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name, for people.
    pub name: String,
    /// What it does.
    pub damping: Damping,
}

impl Model {
    /// The model of a damping under its short name: `CR`, `CDC`, `CDR Eq. 14` …
    #[must_use]
    pub fn new(damping: Damping) -> Self {
        let (short, source) = match damping {
            Damping::None => ("none", Source::Predicted),
            Damping::Restitution => ("CR", Source::Predicted),
            Damping::RigidRestitution => ("CR rigid", Source::Predicted),
            Damping::ConstantCoefficient(source) => ("CDC", source),
            Damping::FreeStandingBlock(source) => ("block", source),
            Damping::ConstantRatio(source) => ("CDR", source),
            Damping::StiffnessProportional(source) => ("SDR", source),
        };
        let name = match source {
            Source::Predicted => short.to_owned(),
            Source::Given(value) => format!("{short} {value}"),
            Source::Equation14 => format!("{short} Eq. 14"),
        };
        Self { name, damping }
    }

    /// The models of Figure 15 of the paper: CR, CDC, CDR, SDR and CDR with the damping of Eq. (14).
    #[must_use]
    pub fn figure_15() -> Vec<Self> {
        let viscous = [
            Damping::Restitution,
            Damping::ConstantCoefficient(Source::Predicted),
            Damping::ConstantRatio(Source::Predicted),
            Damping::StiffnessProportional(Source::Predicted),
            Damping::ConstantRatio(Source::Equation14),
        ];
        viscous.map(Self::new).into()
    }

    /// The parameters of a wall with this model's damping and impact, upright and at rest.
    ///
    /// # Errors
    /// [`ParameterError`] if the parameters do not make a wall whose e Eq. (14) could take.
    pub fn applied_to(&self, wall: &Parameters) -> Result<Parameters, ParameterError> {
        let mut parameters = Parameters {
            damping_model: DampingModel::None,
            impact: Impact::None,
            u_start: 0.0,
            u_dot_start: 0.0,
            ..wall.clone()
        };
        let (model, source) = match self.damping {
            Damping::None => return Ok(parameters),
            Damping::Restitution | Damping::RigidRestitution => {
                parameters.impact = Impact::Restitution;
                if self.damping == Damping::RigidRestitution {
                    parameters.force_law = ForceLaw::RigidLinear;
                    parameters.multilinear = None;
                }
                return Ok(parameters);
            }
            Damping::ConstantCoefficient(source) => (DampingModel::ConstantCoefficient, source),
            Damping::FreeStandingBlock(source) => (DampingModel::FreeStandingBlock, source),
            Damping::ConstantRatio(source) => (DampingModel::ConstantRatio, source),
            Damping::StiffnessProportional(source) => (DampingModel::StiffnessProportional, source),
        };
        let ratio = match source {
            Source::Predicted => None,
            Source::Given(value) => Some(value),
            Source::Equation14 => {
                let e = Wall::new(&parameters)?.restitution();
                if e <= 0.0 {
                    return Err(ParameterError::Prediction { restitution: e });
                }
                Some(equivalence::makris_konstantinidis(e))
            }
        };
        parameters.damping_model = model;
        match ratio {
            None => parameters.damping_source = DampingSource::Predicted,
            Some(ratio) => {
                parameters.damping_source = DampingSource::Given;
                (parameters.xi, parameters.c_bar) = (ratio, ratio);
            }
        }
        Ok(parameters)
    }
}
