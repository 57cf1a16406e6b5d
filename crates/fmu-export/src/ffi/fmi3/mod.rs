//! FMI 3.0: the functions that differ from those of FMI 2.0.
//!
//! ```
//! use fmu_export::ffi::fmi3::types::{Boolean, LogMessageCallback};
//!
//! // the layouts are those of fmi3PlatformTypes.h and fmi3FunctionTypes.h
//! assert_eq!((size_of::<Boolean>(), size_of::<LogMessageCallback>()), (1, size_of::<usize>()));
//! ```

use crate::call::Call;
use crate::ffi::guard::functions;
use crate::ffi::types::{Component, Status};
use crate::model::Model;

mod instantiation;
mod steps;
pub mod types;
mod values;

pub use instantiation::{
    get_version, instantiate_co_simulation, instantiate_model_exchange, instantiate_scheduled_execution,
};
pub use steps::*;
#[cfg(feature = "component")]
pub(super) use values::check_count;
pub use values::*;

/// Defines functions for what no FMU of this layer has, such as clocks: their call is never allowed, whatever
/// their arguments.
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
