//! Which functions a variable belongs to, and the phases in which it may be set.

use crate::call::{Call, Phase, Version};
use crate::model::{Failure, Model};
use crate::variable::{Causality, Kind, TIME_REFERENCE, Variability, Variable, VariableId};

/// What a function does with the variables whose references it is given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Access {
    Get,
    Set,
    /// Gets or sets derivatives, which Reals alone have.
    Derive,
}

impl Access {
    /// Returns the variable with this value reference among those of one type of the model `M`.
    pub(crate) fn find<M: Model, V: VariableId>(
        self,
        version: Version,
        reference: u32,
    ) -> Result<V, Failure> {
        V::from_reference(reference).ok_or_else(|| self.unknown::<M>(version, reference))
    }

    /// Returns why a reference is not that of a variable of the type at hand: which function it belongs to.
    #[cold]
    pub(crate) fn unknown<M: Model>(self, version: Version, reference: u32) -> Failure {
        let real = || M::Real::from_reference(reference).map(VariableId::variable);
        let integer = || M::Integer::from_reference(reference).map(VariableId::variable);
        let boolean = || M::Boolean::from_reference(reference).map(VariableId::variable);
        let text = || M::Text::from_reference(reference).map(VariableId::variable);
        let found = real().or_else(integer).or_else(boolean).or_else(text);
        let own = found.map(|variable| (variable.name, names(variable.kind, version)));
        let time = (version == Version::Fmi3 && self == Self::Get && reference == TIME_REFERENCE)
            .then(|| ("time", names(Kind::Real { start: None, min: None, max: None }, version)));
        Failure(match (own.or(time), self) {
            (None, _) => format!("no variable of this type has the value reference {reference}"),
            (Some((name, (kind, ..))), Self::Derive) => {
                format!("{name} is {kind} and has no derivatives (value reference {reference})")
            }
            (Some((name, (kind, get, set))), _) => {
                let function = if self == Self::Get { get } else { set }.name(version);
                format!("{name} is {kind}: use {function} for value reference {reference}")
            }
        })
    }
}

/// The name of a type with its article, and its getter and setter.
fn names(kind: Kind, version: Version) -> (&'static str, Call, Call) {
    match (kind, version) {
        (Kind::Real { .. }, Version::Fmi2) => ("a Real", Call::GetReal, Call::SetReal),
        (Kind::Real { .. }, Version::Fmi3) => ("a Float64", Call::GetReal, Call::SetReal),
        (Kind::Integer { .. }, Version::Fmi2) => ("an Integer", Call::GetInteger, Call::SetInteger),
        (Kind::Integer { .. }, Version::Fmi3) => ("an Int32", Call::GetInteger, Call::SetInteger),
        (Kind::Enumeration { .. }, Version::Fmi2) => ("an Enumeration", Call::GetInteger, Call::SetInteger),
        (Kind::Enumeration { .. }, Version::Fmi3) => ("an Enumeration", Call::GetInt64, Call::SetInt64),
        (Kind::Boolean { .. }, _) => ("a Boolean", Call::GetBoolean, Call::SetBoolean),
        (Kind::String { .. }, _) => ("a String", Call::GetString, Call::SetString),
    }
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
    let why = match (variable.causality, variable.variability) {
        (Causality::Parameter, Variability::Tunable) => {
            format!("is tunable and cannot be set {now}: set it in Event Mode")
        }
        (Causality::Parameter, Variability::Fixed) => format!(
            "is a fixed parameter and cannot be set {now}: set it before the end of Initialization Mode"
        ),
        (Causality::Input, Variability::Discrete) => {
            format!("is not continuous and cannot change {now}: set another value in Event Mode")
        }
        _ => "cannot be set: only parameters and inputs that are not constant can".to_owned(),
    };
    Failure(format!("{} {why}", variable.name))
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
