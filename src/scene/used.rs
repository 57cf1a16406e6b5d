//! Which variables the FMU of a scene lists: what a scene does not use is not there.

use fmu_export::VariableId;

use crate::choices::{DampingModel, DampingSource, ForceLaw, Impact, Mechanism, RestitutionSource, Solver};
use crate::variables::{BooleanVariable, IntegerVariable, RealVariable, integer_parameter};

use super::Scene;

impl Scene {
    /// Whether this scene's FMU lists the variable called `name`.
    pub fn uses(&self, name: &str) -> bool {
        let boolean = |variable| match variable {
            BooleanVariable::Overturned => true,
        };
        // enumerations are frozen: the library reads them from the scene
        let integer = |variable| match variable {
            integer_parameter!() => false,
        };
        RealVariable::from_name(name).is_some_and(|variable| self.uses_real(variable))
            || IntegerVariable::from_name(name).is_some_and(integer)
            || BooleanVariable::from_name(name).is_some_and(boolean)
    }

    /// Whether a number plays a part in the scene's choices.
    #[allow(clippy::match_same_arms, reason = "what every scene has, a few variables to a line")]
    fn uses_real(&self, variable: RealVariable) -> bool {
        use RealVariable as V;
        let p = &self.parameters;
        let vertical = p.mechanism == Mechanism::VerticalSpanning;
        let loaded = p.overburden > 0.0;
        let named = p.multilinear.is_none();
        let rigid = named && p.force_law == ForceLaw::RigidLinear;
        let damped = p.damping_model != DampingModel::None;
        let given = p.damping_source == DampingSource::Given;
        let free_standing = p.damping_model == DampingModel::FreeStandingBlock;
        let needs_restitution = p.impact == Impact::Restitution || (damped && !given);
        match variable {
            V::AG | V::ABottom | V::ATop | V::Drift => self.inputs.contains(&variable),
            V::HingeRatio | V::ReactionTop | V::ImpulseTop => vertical,
            V::Overburden | V::OverburdenEccentricity => loaded,
            V::F0Negative | V::UInsNegative => loaded && p.overburden_eccentricity != 0.0,
            V::A1 => named && !rigid,
            V::Omega1 => !rigid,
            V::A3 => named,
            V::D1 => named && p.force_law == ForceLaw::Trilinear,
            V::Xi => damped && given && !free_standing,
            V::CBar => damped && given && free_standing,
            V::DampingForce | V::XiUsed => damped,
            V::Restitution => needs_restitution && p.restitution_source == RestitutionSource::Given,
            V::RestitutionUsed => needs_restitution,
            V::TieHeight | V::TieStiffness | V::TieSlack | V::TieForce => p.tie_stiffness > 0.0,
            V::TieStrength => p.tie_stiffness > 0.0 && p.tie_strength > 0.0,
            V::NewmarkStep => p.solver == Solver::Newmark,
            V::Tolerance => match p.solver {
                Solver::Exact | Solver::Newmark => false,
                Solver::Adaptive => true,
                Solver::Automatic => matches!(
                    p.damping_model,
                    DampingModel::ConstantRatio | DampingModel::StiffnessProportional
                ),
            },
            V::Height | V::Thickness | V::Width | V::Density | V::Gravity | V::UStart | V::UDotStart => true,
            V::U | V::UDot | V::UDdot | V::URatio | V::UMax | V::UIns | V::OverturnTime => true,
            V::RestoringForce | V::ReactionBottom | V::ImpulseBottom | V::F0 => true,
            V::Mass | V::EffectiveMass | V::Participation => true,
        }
    }
}
