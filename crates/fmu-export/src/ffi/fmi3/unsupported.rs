//! The functions for what no FMU of this layer has: clocks, structural parameters, element dependencies.

use crate::call::Call;
use crate::ffi::guard::functions;
use crate::ffi::types::{Component, Status};
use crate::model::Model;

/// Defines functions whose call is never allowed, whatever their arguments.
macro_rules! never {
    ($($name:ident $call:ident;)*) => {
        functions! { $(
            /// Always an error.
            $name<Model>(): $call, |_| Ok(());
        )* }
    };
}

never! {
    enter_configuration_mode EnterConfigurationMode;
    exit_configuration_mode ExitConfigurationMode;
    get_number_of_variable_dependencies GetNumberOfVariableDependencies;
    get_variable_dependencies GetVariableDependencies;
    evaluate_discrete_states EvaluateDiscreteStates;
    get_clock GetClock;
    set_clock SetClock;
    get_interval_decimal GetIntervalDecimal;
    get_interval_fraction GetIntervalFraction;
    get_shift_decimal GetShiftDecimal;
    get_shift_fraction GetShiftFraction;
    set_interval_decimal SetIntervalDecimal;
    set_interval_fraction SetIntervalFraction;
    set_shift_decimal SetShiftDecimal;
    set_shift_fraction SetShiftFraction;
    activate_model_partition ActivateModelPartition;
}
