//! The phases in which a variable may be set.

use crate::call::Phase;
use crate::failure::Failure;
use crate::variable::{Causality, Variability, Variable, VariableId};

/// Returns the variable with this value reference among those of one type.
pub(crate) fn find<V: VariableId>(reference: u32) -> Result<V, Failure> {
    V::from_reference(reference).ok_or_else(|| unknown(reference))
}

#[cold]
pub(crate) fn unknown(reference: u32) -> Failure {
    Failure(format!("no variable of this type has the value reference {reference}"))
}

/// Returns an error if there are any references: no variable has the type.
pub(crate) fn none(references: &[u32]) -> Result<(), Failure> {
    references.first().map_or(Ok(()), |&reference| Err(unknown(reference)))
}

/// Returns whether `variable` may be changed in `phase`, in which sets are allowed at all. With `event_mode`,
/// inputs that are not continuous may change in Event Mode but not in Step Mode.
pub(crate) fn is_settable(variable: &Variable, phase: Phase, event_mode: bool) -> bool {
    match (variable.causality, variable.variability) {
        (_, Variability::Constant) => false,
        (Causality::Input, Variability::Continuous) => true,
        (Causality::Input, _) => !(event_mode && phase == Phase::StepMode),
        (Causality::Parameter, Variability::Tunable) => phase != Phase::ContinuousTimeMode,
        (Causality::Parameter, _) => phase.is_before_the_start(),
        _ => false,
    }
}

/// Returns why `variable` cannot be set; `now` describes the present phase.
#[cold]
pub(crate) fn not_settable(variable: &Variable, now: &str) -> Failure {
    let name = variable.name;
    let what = match (variable.causality, variable.variability) {
        (Causality::Parameter | Causality::Input, Variability::Constant) => "a constant",
        (Causality::Parameter, Variability::Tunable) => {
            return Failure(format!("{name} is tunable and cannot be set {now}: set it in Event Mode"));
        }
        (Causality::Parameter, _) => {
            return Failure(format!(
                "{name} is a fixed parameter and cannot be set {now}: set it before the end of \
                 Initialization Mode"
            ));
        }
        (Causality::Input, _) => {
            return Failure(format!(
                "{name} is not continuous and cannot change {now}: set another value in Event Mode"
            ));
        }
        (Causality::CalculatedParameter, _) => "a calculated parameter",
        (Causality::Output, _) => "an output",
        (Causality::Local, _) => "a local variable",
        (Causality::Independent, _) => "the independent variable",
    };
    Failure(format!("{name} is {what} and cannot be set: only parameters and inputs can"))
}

/// Checks that `variable` is an input whose derivative can be set.
pub(crate) fn check_derivable_input(variable: &Variable) -> Result<(), Failure> {
    let name = variable.name;
    match (variable.causality, variable.variability) {
        (Causality::Input, Variability::Continuous) => Ok(()),
        (Causality::Input, _) => Err(Failure(format!("{name} is not continuous and takes no derivative"))),
        _ => Err(Failure(format!("{name} is not an input and takes no derivative"))),
    }
}

/// Checks that the derivative requested is the first.
pub(crate) fn check_order(variable: &Variable, order: i32) -> Result<(), Failure> {
    if order == 1 {
        return Ok(());
    }
    Err(Failure(format!("derivative of order {order} of {}: only order 1 is supported", variable.name)))
}
