//! Which variables a function serves, and the phases in which it may be set.

use crate::call::Phase;
use crate::failure::Failure;
use crate::model::Model;
use crate::variable::{Causality, Variability, Variable, VariableId};

/// Returns the variable with this value reference among those of one type of the model `M`.
pub(crate) fn find<M: Model, V: VariableId>(reference: u32) -> Result<V, Failure> {
    V::from_reference(reference).ok_or_else(|| unknown::<M>(reference))
}

/// Returns why a reference is not that of a variable of the type at hand.
#[cold]
pub(crate) fn unknown<M: Model>(reference: u32) -> Failure {
    let real = || M::Real::from_reference(reference).map(VariableId::variable);
    let integer = || M::Integer::from_reference(reference).map(VariableId::variable);
    let boolean = || M::Boolean::from_reference(reference).map(VariableId::variable);
    let text = || M::Text::from_reference(reference).map(VariableId::variable);
    let found = real().or_else(integer).or_else(boolean).or_else(text);
    let other = found.map_or_else(String::new, |Variable { name, .. }| {
        format!("; {name} has it: use the function of its type in modelDescription.xml")
    });
    Failure(format!("no variable of this type has the value reference {reference}{other}"))
}

/// Returns an error if there are any references: no variable has the type.
///
/// # Errors
/// [`Failure`] with the first reference.
pub fn none_served<M: Model>(references: &[u32]) -> Result<(), Failure> {
    references.first().map_or(Ok(()), |&reference| Err(unknown::<M>(reference)))
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
    let Variable { name, causality, variability, .. } = variable;
    Failure(format!(
        "{name} ({causality:?}, {variability:?}) cannot be set {now}: fixed parameters can before the end of \
         Initialization Mode, tunable ones and discrete inputs in Event Mode, constants and others never"
    ))
}

/// Checks that `variable` is an input whose derivative can be set.
pub(crate) fn check_derivable_input(variable: &Variable) -> Result<(), Failure> {
    if (variable.causality, variable.variability) == (Causality::Input, Variability::Continuous) {
        return Ok(());
    }
    Err(Failure(format!("{} takes no derivative: it is no continuous input", variable.name)))
}

/// Checks that the derivative requested is the first.
pub(crate) fn check_order(variable: &Variable, order: i32) -> Result<(), Failure> {
    if order == 1 {
        return Ok(());
    }
    Err(Failure(format!("derivative of order {order} of {}: only order 1 is supported", variable.name)))
}
