//! Every exported function has the type that bindgen reads from the FMI 2.0 headers. The test is that this
//! file compiles. Wall and floor export by one macro; the floor builds sooner.

#![allow(unsafe_code, reason = "the boundary is made of unsafe functions")]
#![allow(missing_docs, reason = "a test")]

use std::mem::{align_of, offset_of, size_of};

use fmi_sys::fmi2 as standard;
use fmu_export::ffi::types as own;
use rocking_floor_fmu::fmi2 as exported;

macro_rules! same_type {
    ($($function:ident: $kind:ident),* $(,)?) => {
        $(const _: standard::$kind = Some(exported::$function);)*
        /// Functions compared.
        const COMPARED: &[&str] = &[$(stringify!($function)),*];
    };
}

same_type! {
    fmi2GetTypesPlatform: fmi2GetTypesPlatformTYPE,
    fmi2GetVersion: fmi2GetVersionTYPE,
    fmi2SetDebugLogging: fmi2SetDebugLoggingTYPE,
    fmi2FreeInstance: fmi2FreeInstanceTYPE,
    fmi2SetupExperiment: fmi2SetupExperimentTYPE,
    fmi2EnterInitializationMode: fmi2EnterInitializationModeTYPE,
    fmi2ExitInitializationMode: fmi2ExitInitializationModeTYPE,
    fmi2Terminate: fmi2TerminateTYPE,
    fmi2Reset: fmi2ResetTYPE,
    fmi2GetReal: fmi2GetRealTYPE,
    fmi2GetInteger: fmi2GetIntegerTYPE,
    fmi2GetBoolean: fmi2GetBooleanTYPE,
    fmi2GetString: fmi2GetStringTYPE,
    fmi2SetReal: fmi2SetRealTYPE,
    fmi2SetInteger: fmi2SetIntegerTYPE,
    fmi2SetBoolean: fmi2SetBooleanTYPE,
    fmi2SetString: fmi2SetStringTYPE,
    fmi2GetFMUstate: fmi2GetFMUstateTYPE,
    fmi2SetFMUstate: fmi2SetFMUstateTYPE,
    fmi2FreeFMUstate: fmi2FreeFMUstateTYPE,
    fmi2SerializedFMUstateSize: fmi2SerializedFMUstateSizeTYPE,
    fmi2SerializeFMUstate: fmi2SerializeFMUstateTYPE,
    fmi2DeSerializeFMUstate: fmi2DeSerializeFMUstateTYPE,
    fmi2GetDirectionalDerivative: fmi2GetDirectionalDerivativeTYPE,
    fmi2SetRealInputDerivatives: fmi2SetRealInputDerivativesTYPE,
    fmi2GetRealOutputDerivatives: fmi2GetRealOutputDerivativesTYPE,
    fmi2DoStep: fmi2DoStepTYPE,
    fmi2CancelStep: fmi2CancelStepTYPE,
    fmi2GetStatus: fmi2GetStatusTYPE,
    fmi2GetRealStatus: fmi2GetRealStatusTYPE,
    fmi2GetIntegerStatus: fmi2GetIntegerStatusTYPE,
    fmi2GetBooleanStatus: fmi2GetBooleanStatusTYPE,
    fmi2GetStringStatus: fmi2GetStringStatusTYPE,
    fmi2EnterEventMode: fmi2EnterEventModeTYPE,
    fmi2EnterContinuousTimeMode: fmi2EnterContinuousTimeModeTYPE,
    fmi2CompletedIntegratorStep: fmi2CompletedIntegratorStepTYPE,
    fmi2SetTime: fmi2SetTimeTYPE,
    fmi2SetContinuousStates: fmi2SetContinuousStatesTYPE,
    fmi2GetDerivatives: fmi2GetDerivativesTYPE,
    fmi2GetEventIndicators: fmi2GetEventIndicatorsTYPE,
    fmi2GetContinuousStates: fmi2GetContinuousStatesTYPE,
    fmi2GetNominalsOfContinuousStates: fmi2GetNominalsOfContinuousStatesTYPE,
}

/// `fmi2Instantiate` takes a struct of callbacks. With the layer's struct in place of the standard's, the
/// type is the same.
type Instantiate = unsafe extern "C" fn(
    standard::fmi2String,
    standard::fmi2Type,
    standard::fmi2String,
    standard::fmi2String,
    *const own::CallbackFunctions,
    standard::fmi2Boolean,
    standard::fmi2Boolean,
) -> standard::fmi2Component;
const _: Instantiate = exported::fmi2Instantiate;
const _: standard::fmi2InstantiateTYPE = {
    unsafe extern "C" fn theirs(
        _: standard::fmi2String,
        _: standard::fmi2Type,
        _: standard::fmi2String,
        _: standard::fmi2String,
        _: *const standard::fmi2CallbackFunctions,
        _: standard::fmi2Boolean,
        _: standard::fmi2Boolean,
    ) -> standard::fmi2Component {
        std::ptr::null_mut()
    }
    Some(theirs)
};

/// `fmi2NewDiscreteStates` fills a struct. With the layer's struct in place of the standard's, the type is
/// the same.
type NewDiscreteStates =
    unsafe extern "C" fn(standard::fmi2Component, *mut own::EventInfo) -> standard::fmi2Status;
const _: NewDiscreteStates = exported::fmi2NewDiscreteStates;
const _: standard::fmi2NewDiscreteStatesTYPE = {
    unsafe extern "C" fn theirs(
        _: standard::fmi2Component,
        _: *mut standard::fmi2EventInfo,
    ) -> standard::fmi2Status {
        0
    }
    Some(theirs)
};

/// The callbacks themselves have the standard's types.
const _: fn(own::CallbackFunctions) -> standard::fmi2CallbackFunctions = |ours| {
    let logger: standard::fmi2CallbackLogger = ours.logger;
    let allocate_memory: standard::fmi2CallbackAllocateMemory = ours.allocate_memory;
    let free_memory: standard::fmi2CallbackFreeMemory = ours.free_memory;
    let step_finished: standard::fmi2StepFinished = ours.step_finished;
    standard::fmi2CallbackFunctions {
        logger,
        allocateMemory: allocate_memory,
        freeMemory: free_memory,
        stepFinished: step_finished,
        componentEnvironment: ours.component_environment,
    }
};

#[test]
fn the_callbacks_lie_where_the_standard_has_them() {
    type Ours = own::CallbackFunctions;
    type Theirs = standard::fmi2CallbackFunctions;
    assert_eq!(size_of::<Ours>(), size_of::<Theirs>());
    assert_eq!(align_of::<Ours>(), align_of::<Theirs>());
    assert_eq!(offset_of!(Ours, logger), offset_of!(Theirs, logger));
    assert_eq!(offset_of!(Ours, allocate_memory), offset_of!(Theirs, allocateMemory));
    assert_eq!(offset_of!(Ours, free_memory), offset_of!(Theirs, freeMemory));
    assert_eq!(offset_of!(Ours, step_finished), offset_of!(Theirs, stepFinished));
    assert_eq!(offset_of!(Ours, component_environment), offset_of!(Theirs, componentEnvironment));
}

#[test]
fn the_event_information_lies_where_the_standard_has_it() {
    type Ours = own::EventInfo;
    type Theirs = standard::fmi2EventInfo;
    assert_eq!(size_of::<Ours>(), size_of::<Theirs>());
    assert_eq!(align_of::<Ours>(), align_of::<Theirs>());
    assert_eq!(offset_of!(Ours, new_discrete_states_needed), offset_of!(Theirs, newDiscreteStatesNeeded));
    assert_eq!(offset_of!(Ours, terminate_simulation), offset_of!(Theirs, terminateSimulation));
    assert_eq!(
        offset_of!(Ours, nominals_of_continuous_states_changed),
        offset_of!(Theirs, nominalsOfContinuousStatesChanged)
    );
    assert_eq!(
        offset_of!(Ours, values_of_continuous_states_changed),
        offset_of!(Theirs, valuesOfContinuousStatesChanged)
    );
    assert_eq!(offset_of!(Ours, next_event_time_defined), offset_of!(Theirs, nextEventTimeDefined));
    assert_eq!(offset_of!(Ours, next_event_time), offset_of!(Theirs, nextEventTime));
}

#[test]
fn the_numbers_are_the_standards() {
    assert_eq!(own::OK, standard::fmi2Status_fmi2OK);
    assert_eq!(own::WARNING, standard::fmi2Status_fmi2Warning);
    assert_eq!(own::DISCARD, standard::fmi2Status_fmi2Discard);
    assert_eq!(own::ERROR, standard::fmi2Status_fmi2Error);
    assert_eq!(own::FATAL, standard::fmi2Status_fmi2Fatal);
    assert_eq!(own::MODEL_EXCHANGE, standard::fmi2Type_fmi2ModelExchange);
    assert_eq!(own::CO_SIMULATION, standard::fmi2Type_fmi2CoSimulation);
    assert_eq!(own::DO_STEP_STATUS, standard::fmi2StatusKind_fmi2DoStepStatus);
    assert_eq!(own::LAST_SUCCESSFUL_TIME, standard::fmi2StatusKind_fmi2LastSuccessfulTime);
    assert_eq!(own::TERMINATED, standard::fmi2StatusKind_fmi2Terminated);
}

#[test]
fn all_functions_are_compared() {
    // and fmi2Instantiate and fmi2NewDiscreteStates
    assert_eq!(COMPARED.len() + 2, 44);
}
