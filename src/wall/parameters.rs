//! What a user gives: one field per parameter of the model description.

use std::sync::Arc;

use fmi2_export::{Kind, VariableId};

use crate::variables::{
    DampingModel, DampingSource, EccentricityMode, ForceLaw, Impact, IntegerVariable, Mechanism,
    RealVariable, RestitutionSource, Softening, Solver,
};

use super::Kinematics;

/// The parameters of a wall and of its solution, in SI units, named as in `modelDescription.xml`.
///
/// This is where the scene file and the FMI variables meet. The limits of one parameter come from the description
/// and are checked where it is set; relations between parameters are checked by [`Wall::new`](super::Wall::new) and
/// [`Method::new`](crate::solver::Method::new).
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "each field is documented by the variable of the same name")]
pub struct Parameters {
    pub mechanism: Mechanism,
    pub height: f64,
    pub thickness: f64,
    pub width: f64,
    pub density: f64,
    pub gravity: f64,
    pub hinge_ratio: f64,
    pub overburden: f64,
    pub overburden_eccentricity: f64,
    pub eccentricity_mode: EccentricityMode,
    pub force_law: ForceLaw,
    pub a1: f64,
    pub a3: f64,
    pub d1: f64,
    pub softening: Softening,
    pub damping_model: DampingModel,
    pub damping_source: DampingSource,
    pub xi: f64,
    pub c_bar: f64,
    pub impact: Impact,
    pub restitution_source: RestitutionSource,
    pub restitution: f64,
    pub u_start: f64,
    pub u_dot_start: f64,
    pub solver: Solver,
    pub tolerance: f64,
    pub newmark_step: f64,
    /// Small or full rotations. Only scenes carry it.
    pub kinematics: Kinematics,
    /// Corners `[u/u_ins, F/F0]` of a multilinear law after the origin, the same fractions on both sides; replaces
    /// `force_law`, `a1`, `a3`, `d1` and `softening`. Only scenes carry it.
    pub multilinear: Option<Arc<[[f64; 2]]>>,
}

impl Default for Parameters {
    /// The start values of the model description, applied through the same setters importers use.
    fn default() -> Self {
        let mut parameters = Self {
            mechanism: Mechanism::Parapet,
            height: f64::NAN,
            thickness: f64::NAN,
            width: f64::NAN,
            density: f64::NAN,
            gravity: f64::NAN,
            hinge_ratio: f64::NAN,
            overburden: f64::NAN,
            overburden_eccentricity: f64::NAN,
            eccentricity_mode: EccentricityMode::FixedToWall,
            force_law: ForceLaw::Bilinear,
            a1: f64::NAN,
            a3: f64::NAN,
            d1: f64::NAN,
            softening: Softening::Parallel,
            damping_model: DampingModel::None,
            damping_source: DampingSource::Given,
            xi: f64::NAN,
            c_bar: f64::NAN,
            impact: Impact::None,
            restitution_source: RestitutionSource::Given,
            restitution: f64::NAN,
            u_start: f64::NAN,
            u_dot_start: f64::NAN,
            solver: Solver::Automatic,
            tolerance: f64::NAN,
            newmark_step: f64::NAN,
            kinematics: Kinematics::Linear,
            multilinear: None,
        };
        for &variable in RealVariable::ALL {
            if let (Kind::Real { start: Some(start), .. }, Some(field)) =
                (&variable.variable().kind, parameters.real_mut(variable))
            {
                *field = *start;
            }
        }
        for &variable in IntegerVariable::ALL {
            if let Kind::Enumeration { start: Some(start), .. } = variable.variable().kind {
                parameters.set_choice(variable, start);
            }
        }
        parameters
    }
}

impl Parameters {
    /// The field of a real parameter; `None` for a variable that is not a parameter.
    pub fn real_mut(&mut self, variable: RealVariable) -> Option<&mut f64> {
        use RealVariable as V;
        match variable {
            V::Height => Some(&mut self.height),
            V::Thickness => Some(&mut self.thickness),
            V::Width => Some(&mut self.width),
            V::Density => Some(&mut self.density),
            V::Gravity => Some(&mut self.gravity),
            V::HingeRatio => Some(&mut self.hinge_ratio),
            V::Overburden => Some(&mut self.overburden),
            V::OverburdenEccentricity => Some(&mut self.overburden_eccentricity),
            V::A1 => Some(&mut self.a1),
            V::A3 => Some(&mut self.a3),
            V::D1 => Some(&mut self.d1),
            V::Xi => Some(&mut self.xi),
            V::CBar => Some(&mut self.c_bar),
            V::Restitution => Some(&mut self.restitution),
            V::UStart => Some(&mut self.u_start),
            V::UDotStart => Some(&mut self.u_dot_start),
            V::Tolerance => Some(&mut self.tolerance),
            V::NewmarkStep => Some(&mut self.newmark_step),
            V::AG
            | V::ABottom
            | V::ATop
            | V::Drift
            | V::U
            | V::UDot
            | V::UDdot
            | V::URatio
            | V::RestoringForce
            | V::DampingForce
            | V::ReactionBottom
            | V::ReactionTop
            | V::ImpulseBottom
            | V::ImpulseTop
            | V::OverturnTime
            | V::UMax
            | V::Mass
            | V::EffectiveMass
            | V::Participation
            | V::F0
            | V::F0Negative
            | V::UIns
            | V::UInsNegative
            | V::Omega1
            | V::XiUsed
            | V::RestitutionUsed => None,
        }
    }

    /// The value of a real parameter; `None` for a variable that is not a parameter.
    #[must_use]
    pub fn real(&self, variable: RealVariable) -> Option<f64> {
        // one match serves both: the copy is of plain numbers
        self.clone().real_mut(variable).copied()
    }

    /// The value of a choice, as the number of its item.
    #[must_use]
    pub fn choice(&self, variable: IntegerVariable) -> i32 {
        use IntegerVariable as V;
        match variable {
            V::Mechanism => self.mechanism.value(),
            V::EccentricityMode => self.eccentricity_mode.value(),
            V::ForceLaw => self.force_law.value(),
            V::Softening => self.softening.value(),
            V::DampingModel => self.damping_model.value(),
            V::DampingSource => self.damping_source.value(),
            V::Impact => self.impact.value(),
            V::RestitutionSource => self.restitution_source.value(),
            V::Solver => self.solver.value(),
        }
    }

    /// Sets a choice by the number of its item; `false` where there is no such item.
    pub fn set_choice(&mut self, variable: IntegerVariable, value: i32) -> bool {
        use IntegerVariable as V;
        fn set<T>(field: &mut T, item: Option<T>) -> bool {
            item.map(|item| *field = item).is_some()
        }
        match variable {
            V::Mechanism => set(&mut self.mechanism, Mechanism::from_value(value)),
            V::EccentricityMode => set(&mut self.eccentricity_mode, EccentricityMode::from_value(value)),
            V::ForceLaw => set(&mut self.force_law, ForceLaw::from_value(value)),
            V::Softening => set(&mut self.softening, Softening::from_value(value)),
            V::DampingModel => set(&mut self.damping_model, DampingModel::from_value(value)),
            V::DampingSource => set(&mut self.damping_source, DampingSource::from_value(value)),
            V::Impact => set(&mut self.impact, Impact::from_value(value)),
            V::RestitutionSource => set(&mut self.restitution_source, RestitutionSource::from_value(value)),
            V::Solver => set(&mut self.solver, Solver::from_value(value)),
        }
    }
}
