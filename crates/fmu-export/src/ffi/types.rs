//! The types of `fmi2TypesPlatform.h` ("default") and `fmi2FunctionTypes.h`, FMI 2.0.5.
//!
//! Enumerations that come from C are plain integers here: an importer may pass any.

use std::ffi::{c_char, c_int, c_void};

/// `fmi2Component`: an instance.
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`: belongs to the importer.
pub type ComponentEnvironment = *mut c_void;
/// `fmi2FMUstate`: a saved state.
pub type FmuState = *mut c_void;
/// `fmi2ValueReference`
pub type ValueReference = u32;
/// `fmi2Real`
pub type Real = f64;
/// `fmi2Integer`
pub type Integer = c_int;
/// `fmi2Boolean`: 0 is false, anything else true.
pub type Boolean = c_int;
/// `fmi2String`: UTF-8, ends at the first NUL.
pub type Text = *const c_char;
/// `fmi2Byte`
pub type Byte = c_char;

/// The integer type of a C enumeration. On Windows it is `int`, which is passed in the same way.
pub type Enumeration = std::ffi::c_uint;

/// `fmi2Status`
pub type Status = Enumeration;
/// `fmi2Type`
pub type Type = Enumeration;
/// `fmi2StatusKind`
pub type StatusKind = Enumeration;

/// `fmi2OK`
pub const OK: Status = 0;
/// `fmi2Warning`
pub const WARNING: Status = 1;
/// `fmi2Discard`
pub const DISCARD: Status = 2;
/// `fmi2Error`
pub const ERROR: Status = 3;
/// `fmi2Fatal`
pub const FATAL: Status = 4;

/// `fmi2ModelExchange`
pub const MODEL_EXCHANGE: Type = 0;
/// `fmi2CoSimulation`
pub const CO_SIMULATION: Type = 1;

/// `fmi2DoStepStatus`
pub const DO_STEP_STATUS: StatusKind = 0;
/// `fmi2LastSuccessfulTime`
pub const LAST_SUCCESSFUL_TIME: StatusKind = 2;
/// `fmi2Terminated`
pub const TERMINATED: StatusKind = 3;

/// `fmi2CallbackLogger`: takes a format like `printf`.
pub type CallbackLogger =
    unsafe extern "C" fn(ComponentEnvironment, Text, Status, category: Text, message: Text, ...);
/// `fmi2CallbackAllocateMemory`
pub type CallbackAllocateMemory = unsafe extern "C" fn(count: usize, size: usize) -> *mut c_void;
/// `fmi2CallbackFreeMemory`
pub type CallbackFreeMemory = unsafe extern "C" fn(*mut c_void);
/// `fmi2StepFinished`
pub type StepFinished = unsafe extern "C" fn(ComponentEnvironment, Status);

/// `fmi2CallbackFunctions`. Only logger and environment are used: `canNotUseMemoryManagementFunctions`, and
/// no step is asynchronous.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CallbackFunctions {
    /// Takes the messages.
    pub logger: Option<CallbackLogger>,
    /// Not used.
    pub allocate_memory: Option<CallbackAllocateMemory>,
    /// Not used.
    pub free_memory: Option<CallbackFreeMemory>,
    /// Not used.
    pub step_finished: Option<StepFinished>,
    /// Handed back to the logger.
    pub component_environment: ComponentEnvironment,
}

/// `fmi2EventInfo`
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct EventInfo {
    /// `fmi2NewDiscreteStates` is to be called again.
    pub new_discrete_states_needed: Boolean,
    /// The model asks for the end of the simulation.
    pub terminate_simulation: Boolean,
    /// Nominal values of states have changed.
    pub nominals_of_continuous_states_changed: Boolean,
    /// States have jumped.
    pub values_of_continuous_states_changed: Boolean,
    /// `next_event_time` holds.
    pub next_event_time_defined: Boolean,
    /// Time of the next event that is known in advance \[s\].
    pub next_event_time: Real,
}

/// A status as C has it, by its number.
pub(crate) const fn status(status: crate::Status) -> Status {
    status as Status
}
