//! Which variable may be set when.

use crate::call::Phase;
use crate::failure::Failure;
use crate::variable::{Causality, Variability, Variable, VariableId};

/// The variable with this value reference among those of one type.
pub(crate) fn find<V: VariableId>(reference: u32) -> Result<V, Failure> {
    V::from_reference(reference).ok_or_else(|| unknown(reference))
}

#[cold]
fn unknown(reference: u32) -> Failure {
    Failure(format!("no variable of this type has the value reference {reference}"))
}

/// Whether `variable` may be set in `phase`, which is one that has sets.
pub(crate) fn is_settable(variable: &Variable, phase: Phase) -> bool {
    match (variable.causality, variable.variability) {
        (_, Variability::Constant) => false,
        (Causality::Input, _) => true,
        (Causality::Parameter, Variability::Tunable) => phase != Phase::ContinuousTimeMode,
        (Causality::Parameter, _) => phase.is_before_the_start(),
        _ => false,
    }
}

/// Refuses what may not be set in `phase`.
pub(crate) fn check_settable(variable: &Variable, phase: Phase) -> Result<(), Failure> {
    if is_settable(variable, phase) { Ok(()) } else { Err(not_settable(variable, phase)) }
}

#[cold]
fn not_settable(variable: &Variable, phase: Phase) -> Failure {
    let name = variable.name;
    let what = match variable.causality {
        Causality::Parameter | Causality::Input if variable.variability == Variability::Constant => {
            "a constant"
        }
        Causality::Parameter if variable.variability == Variability::Tunable => {
            return Failure(format!("{name} is tunable and cannot be set {phase}: set it in Event Mode"));
        }
        Causality::Parameter => {
            return Failure(format!(
                "{name} is a fixed parameter and cannot be set {phase}: set it before \
                 fmi2ExitInitializationMode"
            ));
        }
        Causality::CalculatedParameter => "a calculated parameter",
        Causality::Input => "an input",
        Causality::Output => "an output",
        Causality::Local => "a local variable",
        Causality::Independent => "the independent variable",
    };
    Failure(format!("{name} is {what} and cannot be set: only parameters and inputs can"))
}

/// Whether `variable` is one whose derivative can be set.
pub(crate) fn check_derivable_input(variable: &Variable) -> Result<(), Failure> {
    let name = variable.name;
    match (variable.causality, variable.variability) {
        (Causality::Input, Variability::Continuous) => Ok(()),
        (Causality::Input, _) => Err(Failure(format!("{name} is not continuous and takes no derivative"))),
        _ => Err(Failure(format!("{name} is not an input and takes no derivative"))),
    }
}

/// Whether the derivative asked for is the first.
pub(crate) fn check_order(variable: &Variable, order: i32) -> Result<(), Failure> {
    if order == 1 {
        return Ok(());
    }
    Err(Failure(format!("derivative of order {order} of {}: only order 1 is supported", variable.name)))
}
