//! The C functions of FMI 3.0, by name.

/// The module `fmi3`: every function of `fmi3Functions.h`.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_module {
    ($model:ty) => {
        #[doc(hidden)]
        type ExportedFmi3Model = $model;

        /// The C functions of the FMU, FMI 3.0.
        #[allow(unsafe_code, non_snake_case, clippy::missing_safety_doc, clippy::too_many_arguments)]
        pub mod fmi3 {
            use super::ExportedFmi3Model as Exported;
            use $crate::ffi::fmi3::types::*;
            use $crate::ffi::types::{FmuState, Status, Text, ValueReference};

            $crate::__fmi_functions! { Exported, common,
                fn fmi3SetDebugLogging = set_debug_logging(
                    c: Instance, loggingOn: Boolean, nCategories: usize, categories: *const Text) -> Status;
                fn fmi3FreeInstance = free_instance(c: Instance) -> ();
                fn fmi3ExitInitializationMode = exit_initialization_mode(c: Instance) -> Status;
                fn fmi3Terminate = terminate(c: Instance) -> Status;
                fn fmi3Reset = reset(c: Instance) -> Status;
            }

            $crate::__fmi_functions! { Exported, states,
                fn fmi3GetFMUState = get_fmu_state(c: Instance, FMUState: *mut FmuState) -> Status;
                fn fmi3SetFMUState = set_fmu_state(c: Instance, FMUState: FmuState) -> Status;
                fn fmi3FreeFMUState = free_fmu_state(c: Instance, FMUState: *mut FmuState) -> Status;
                fn fmi3SerializedFMUStateSize = serialized_fmu_state_size(
                    c: Instance, FMUState: FmuState, size: *mut usize) -> Status;
                fn fmi3SerializeFMUState = serialize_fmu_state(
                    c: Instance, FMUState: FmuState, serializedState: *mut Byte, size: usize) -> Status;
                fn fmi3DeserializeFMUState = de_serialize_fmu_state(
                    c: Instance, serializedState: *const Byte, size: usize,
                    FMUState: *mut FmuState) -> Status;
            }

            $crate::__fmi_functions! { Exported, model_exchange,
                fn fmi3EnterEventMode = enter_event_mode(c: Instance) -> Status;
                fn fmi3EnterContinuousTimeMode = enter_continuous_time_mode(c: Instance) -> Status;
                fn fmi3CompletedIntegratorStep = completed_integrator_step(
                    c: Instance, noSetFMUStatePriorToCurrentPoint: Boolean, enterEventMode: *mut Boolean,
                    terminateSimulation: *mut Boolean) -> Status;
                fn fmi3SetTime = set_time(c: Instance, time: f64) -> Status;
                fn fmi3SetContinuousStates = set_continuous_states(
                    c: Instance, continuousStates: *const f64, nContinuousStates: usize) -> Status;
                fn fmi3GetContinuousStateDerivatives = get_derivatives(
                    c: Instance, derivatives: *mut f64, nContinuousStates: usize) -> Status;
                fn fmi3GetEventIndicators = get_event_indicators(
                    c: Instance, eventIndicators: *mut f64, nEventIndicators: usize) -> Status;
                fn fmi3GetContinuousStates = get_continuous_states(
                    c: Instance, continuousStates: *mut f64, nContinuousStates: usize) -> Status;
                fn fmi3GetNominalsOfContinuousStates = get_nominals_of_continuous_states(
                    c: Instance, nominals: *mut f64, nContinuousStates: usize) -> Status;
            }

            $crate::__fmi_functions! { Exported, fmi3,
                fn fmi3GetVersion = get_version() -> Text;
                fn fmi3InstantiateModelExchange = instantiate_model_exchange(
                    instanceName: Text, instantiationToken: Text, resourcePath: Text, visible: Boolean,
                    loggingOn: Boolean, instanceEnvironment: InstanceEnvironment,
                    logMessage: LogMessageCallback) -> Instance;
                fn fmi3InstantiateCoSimulation = instantiate_co_simulation(
                    instanceName: Text, instantiationToken: Text, resourcePath: Text, visible: Boolean,
                    loggingOn: Boolean, eventModeUsed: Boolean, earlyReturnAllowed: Boolean,
                    requiredIntermediateVariables: *const ValueReference,
                    nRequiredIntermediateVariables: usize, instanceEnvironment: InstanceEnvironment,
                    logMessage: LogMessageCallback,
                    intermediateUpdate: IntermediateUpdateCallback) -> Instance;
                fn fmi3InstantiateScheduledExecution = instantiate_scheduled_execution(
                    instanceName: Text, instantiationToken: Text, resourcePath: Text, visible: Boolean,
                    loggingOn: Boolean, instanceEnvironment: InstanceEnvironment,
                    logMessage: LogMessageCallback, clockUpdate: ClockUpdateCallback,
                    lockPreemption: PreemptionCallback, unlockPreemption: PreemptionCallback) -> Instance;
                fn fmi3EnterInitializationMode = start_initialization(
                    c: Instance, toleranceDefined: Boolean, tolerance: f64, startTime: f64,
                    stopTimeDefined: Boolean, stopTime: f64) -> Status;
                fn fmi3GetDirectionalDerivative = derivatives_along[false](
                    c: Instance, unknowns: *const ValueReference, nUnknowns: usize,
                    knowns: *const ValueReference, nKnowns: usize, seed: *const f64, nSeed: usize,
                    sensitivity: *mut f64, nSensitivity: usize) -> Status;
                fn fmi3GetAdjointDerivative = derivatives_along[true](
                    c: Instance, unknowns: *const ValueReference, nUnknowns: usize,
                    knowns: *const ValueReference, nKnowns: usize, seed: *const f64, nSeed: usize,
                    sensitivity: *mut f64, nSensitivity: usize) -> Status;
                fn fmi3UpdateDiscreteStates = update_discrete_states(
                    c: Instance, discreteStatesNeedUpdate: *mut Boolean, terminateSimulation: *mut Boolean,
                    nominalsOfContinuousStatesChanged: *mut Boolean,
                    valuesOfContinuousStatesChanged: *mut Boolean, nextEventTimeDefined: *mut Boolean,
                    nextEventTime: *mut f64) -> Status;
                fn fmi3GetNumberOfEventIndicators = get_number_of_event_indicators(
                    c: Instance, nEventIndicators: *mut usize) -> Status;
                fn fmi3GetNumberOfContinuousStates = get_number_of_continuous_states(
                    c: Instance, nContinuousStates: *mut usize) -> Status;
                fn fmi3EnterStepMode = enter_step_mode(c: Instance) -> Status;
                fn fmi3GetOutputDerivatives = get_output_derivatives(
                    c: Instance, vr: *const ValueReference, nvr: usize, orders: *const i32,
                    values: *mut f64, nValues: usize) -> Status;
                fn fmi3DoStep = do_step(
                    c: Instance, currentCommunicationPoint: f64, communicationStepSize: f64,
                    noSetFMUStatePriorToCurrentPoint: Boolean, eventHandlingNeeded: *mut Boolean,
                    terminateSimulation: *mut Boolean, earlyReturn: *mut Boolean,
                    lastSuccessfulTime: *mut f64) -> Status;
            }

            $crate::__fmi3_values! { Exported,
                f64: fmi3GetFloat64 = get_float64, fmi3SetFloat64 = set_float64;
                i32: fmi3GetInt32 = get_int32, fmi3SetInt32 = set_int32;
                i64: fmi3GetInt64 = get_int64, fmi3SetInt64 = set_int64;
                Boolean: fmi3GetBoolean = get_bool, fmi3SetBoolean = set_bool;
                Text: fmi3GetString = get_string, fmi3SetString = set_string;
            }

            $crate::__fmi3_unused! { Exported,
                fn fmi3GetFloat32(values: *mut f32, nValues: usize);
                fn fmi3SetFloat32(values: *const f32, nValues: usize);
                fn fmi3GetInt8(values: *mut i8, nValues: usize);
                fn fmi3SetInt8(values: *const i8, nValues: usize);
                fn fmi3GetUInt8(values: *mut u8, nValues: usize);
                fn fmi3SetUInt8(values: *const u8, nValues: usize);
                fn fmi3GetInt16(values: *mut i16, nValues: usize);
                fn fmi3SetInt16(values: *const i16, nValues: usize);
                fn fmi3GetUInt16(values: *mut u16, nValues: usize);
                fn fmi3SetUInt16(values: *const u16, nValues: usize);
                fn fmi3GetUInt32(values: *mut u32, nValues: usize);
                fn fmi3SetUInt32(values: *const u32, nValues: usize);
                fn fmi3GetUInt64(values: *mut u64, nValues: usize);
                fn fmi3SetUInt64(values: *const u64, nValues: usize);
                fn fmi3GetBinary(valueSizes: *mut usize, values: *mut Binary, nValues: usize);
                fn fmi3SetBinary(valueSizes: *const usize, values: *const Binary, nValues: usize);
            }

            $crate::__fmi3_unsupported! { Exported,
                fn fmi3GetClock(c: Instance, vr: *const ValueReference, nvr: usize, values: *mut Clock);
                fn fmi3SetClock(c: Instance, vr: *const ValueReference, nvr: usize, values: *const Clock);
                fn fmi3GetNumberOfVariableDependencies(
                    c: Instance, valueReference: ValueReference, nDependencies: *mut usize);
                fn fmi3GetVariableDependencies(
                    c: Instance, dependent: ValueReference, elementIndicesOfDependent: *mut usize,
                    independents: *mut ValueReference, elementIndicesOfIndependents: *mut usize,
                    dependencyKinds: *mut DependencyKind, nDependencies: usize);
                fn fmi3EnterConfigurationMode(c: Instance);
                fn fmi3ExitConfigurationMode(c: Instance);
                fn fmi3GetIntervalDecimal(
                    c: Instance, vr: *const ValueReference, nvr: usize, intervals: *mut f64,
                    qualifiers: *mut IntervalQualifier);
                fn fmi3GetIntervalFraction(
                    c: Instance, vr: *const ValueReference, nvr: usize, counters: *mut u64,
                    resolutions: *mut u64, qualifiers: *mut IntervalQualifier);
                fn fmi3GetShiftDecimal(c: Instance, vr: *const ValueReference, nvr: usize, shifts: *mut f64);
                fn fmi3GetShiftFraction(
                    c: Instance, vr: *const ValueReference, nvr: usize, counters: *mut u64,
                    resolutions: *mut u64);
                fn fmi3SetIntervalDecimal(
                    c: Instance, vr: *const ValueReference, nvr: usize, intervals: *const f64);
                fn fmi3SetIntervalFraction(
                    c: Instance, vr: *const ValueReference, nvr: usize, counters: *const u64,
                    resolutions: *const u64);
                fn fmi3SetShiftDecimal(
                    c: Instance, vr: *const ValueReference, nvr: usize, shifts: *const f64);
                fn fmi3SetShiftFraction(
                    c: Instance, vr: *const ValueReference, nvr: usize, counters: *const u64,
                    resolutions: *const u64);
                fn fmi3EvaluateDiscreteStates(c: Instance);
                fn fmi3ActivateModelPartition(
                    c: Instance, clockReference: ValueReference, activationTime: f64);
            }
        }
    };
}

/// Defines the getters and setters of the values of some types.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_values {
    (
        $model:ident,
        $($type:ty: $get:ident = $get_generic:ident, $set:ident = $set_generic:ident;)*
    ) => { $crate::__fmi_functions! { $model, values, $(
        fn $get = $get_generic(
            c: Instance, vr: *const ValueReference, nvr: usize, values: *mut $type, nValues: usize) -> Status;
        fn $set = $set_generic(
            c: Instance, vr: *const ValueReference, nvr: usize, values: *const $type,
            nValues: usize) -> Status;
    )* } };
}

/// Defines the getters and setters of types that no variable has, by their arguments after the references.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_unused {
    ($model:ident, $(fn $name:ident($($unused:ident: $type:ty),*);)*) => { $(
        #[doc = concat!("`", stringify!($name), "`: there are no variables of its type.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            c: Instance, vr: *const ValueReference, nvr: usize, $($unused: $type),*
        ) -> Status {
            $(let _ = $unused;)*
            // SAFETY: the standard asks of the importer that the instance is NULL or one of this model that
            // is not freed, and that the references are NULL or as many as stated.
            unsafe { $crate::ffi::fmi3::refuse::<$model>(c, stringify!($name), vr, nvr) }
        }
    )* };
}

/// Defines C functions that refuse, whatever their arguments after the instance.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi3_unsupported {
    (
        $model:ident,
        $(fn $name:ident($c:ident: $c_type:ty $(, $unused:ident: $type:ty)*);)*
    ) => { $(
        #[doc = concat!("`", stringify!($name), "`: always an error.")]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($c: $c_type $(, $unused: $type)*) -> Status {
            $(let _ = $unused;)*
            // SAFETY: the standard asks of the importer that the instance is NULL or one of this model that
            // is not freed.
            unsafe { $crate::ffi::fmi3::refuse::<$model>($c, stringify!($name), std::ptr::null(), 0) }
        }
    )* };
}
