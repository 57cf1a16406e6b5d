//! The variables that have an effect, given the values of the parameters.

use crate::choices::{
    DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, RestitutionSource, Rocking, Softening,
    Solver, TieSide, usages,
};

use super::parameters::{Kinematics, Parameters};
use super::profile::OF_RECTANGLE;

/// Says whether a variable of the model description has an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Usage {
    /// Its name.
    pub name: &'static str,
    /// Whether a parameter has its start value; `true` for other variables.
    pub is_start: bool,
    /// Whether it has an effect beside the other parameters.
    pub matters: bool,
    /// The condition for that; empty for a variable that always matters.
    pub condition: &'static str,
}

/// The condition of what a multilinear law replaces.
const NAMED_LAW: &str = "force_law is not multilinear";

/// The condition of what parts replace.
const A_RECTANGLE: &str = "the wall has no parts";

/// Returns the usage of every variable of the model description, by its `<Where>` elements.
///
/// ```
/// use rocking_wall::wall::{Parameters, usage};
///
/// // the default law is bilinear
/// let of_law = usage(&Parameters::default()).find(|usage| usage.name == "d1").unwrap();
/// assert!(!of_law.matters && of_law.condition == "force_law = trilinear");
/// ```
pub fn usage(parameters: &Parameters) -> impl Iterator<Item = Usage> + use<> {
    let has_parts = parameters.profile.is_some();
    let is_multilinear = parameters.multilinear.is_some();
    // full rotations have no closed form
    let is_adaptive =
        parameters.kinematics == Kinematics::Trigonometric && parameters.solver == Solver::Automatic;
    usages!(parameters).into_iter().map(move |usage| match usage.name {
        "force_law" | "a1" | "a3" | "d1" | "softening" if is_multilinear => {
            Usage { matters: false, condition: NAMED_LAW, ..usage }
        }
        // they stand for the parts, and the user has not set them
        name if has_parts && OF_RECTANGLE.contains(&name) => {
            Usage { is_start: true, matters: false, condition: A_RECTANGLE, ..usage }
        }
        "F0_negative" | "u_ins_negative" if has_parts => Usage { matters: true, ..usage },
        "omega1" if is_multilinear => Usage { matters: true, ..usage },
        "tolerance" if is_adaptive => Usage { matters: true, ..usage },
        _ => usage,
    })
}
