//! Selects the variables that the FMU of a scene lists: only those that the scene uses.

use fmu_export::VariableId;

use crate::variables::{BooleanVariable, RealVariable};
use crate::wall::usage;

use super::Scene;

impl Scene {
    /// Returns whether this scene's FMU lists the variable called `name`. Enumerations are frozen: the
    /// library reads them from the scene.
    pub fn uses(&self, name: &str) -> bool {
        RealVariable::from_name(name).is_some_and(|variable| self.uses_real(variable))
            || BooleanVariable::from_name(name).is_some()
    }

    /// Returns whether a Real variable is used with the scene's choices.
    fn uses_real(&self, variable: RealVariable) -> bool {
        use RealVariable as V;
        let p = &self.parameters;
        match variable {
            V::AG | V::ABottom | V::ATop | V::Drift => self.inputs.contains(&variable),
            // 0 stands for "none"
            V::Overburden if p.overburden == 0.0 => false,
            V::TieStiffness if p.tie_stiffness == 0.0 => false,
            V::TieStrength if p.tie_strength == 0.0 => false,
            _ => usage(p).any(|usage| usage.name == variable.variable().name && usage.matters),
        }
    }
}
