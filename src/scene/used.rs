//! Selects the variables that the FMU of a scene lists: only those that the scene uses.

use fmu_export::VariableId;

use crate::variables::{BooleanVariable, RealVariable};
use crate::wall::usage;

use super::Scene;

impl Scene {
    /// Returns whether this scene's FMU lists the variable called `name`. Enumerations are frozen: the
    /// library reads them from the scene.
    pub fn uses(&self, name: &str) -> bool {
        use RealVariable as V;
        let p = &self.parameters;
        let matters = || usage(p).any(|usage| usage.name == name && usage.matters);
        match V::from_name(name) {
            None => BooleanVariable::from_name(name).is_some() && matters(),
            Some(input @ (V::AG | V::ABottom | V::ATop | V::Drift)) => self.inputs.contains(&input),
            // 0 stands for "none", and so does -1
            Some(V::Overburden) if p.overburden == 0.0 => false,
            Some(V::TieStiffness) if p.tie_stiffness == 0.0 => false,
            Some(V::TieStrength) if p.tie_strength == 0.0 => false,
            Some(V::TieUltimate) if p.tie_ultimate == -1.0 => false,
            Some(_) => matters(),
        }
    }
}
