//! The C functions of an FMU, by name: FMI 2.0, and the macro for both versions.

/// Makes the model `$model` an FMU: defines the C functions of FMI 2.0 in a module `fmi2`. For co-simulation
/// these are 34, for Model Exchange, which asks for a [`ModelExchange`](crate::ModelExchange), 35, for both
/// 44. A model for both also gets all 75 functions of FMI 3.0, in a module `fmi3`: one library then serves
/// the FMUs of both versions.
///
/// It belongs into a `cdylib`, once, and best into a crate of its own: a program can only hold one set of
/// these names.
///
/// ```text
/// fmu_export::export_fmu!(spring::Spring);
/// fmu_export::export_fmu!(spring::Spring, co_simulation + model_exchange);
/// fmu_export::export_fmu!(spring::Spring, model_exchange);
/// ```
#[macro_export]
macro_rules! export_fmu {
    ($model:ty) => {
        $crate::__fmi2_module! { $model, CO_SIMULATION, __fmi2_co_simulation }
    };
    ($model:ty, model_exchange) => {
        $crate::__fmi2_module! { $model, MODEL_EXCHANGE, __fmi2_model_exchange }
    };
    ($model:ty, co_simulation + model_exchange) => {
        $crate::__fmi2_module! { $model, BOTH, __fmi2_co_simulation __fmi2_model_exchange }
        $crate::__fmi3_module! { $model }
    };
}

/// The module `fmi2`: the functions of every FMU, and those of the kinds.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_module {
    ($model:ty, $kinds:ident, $($functions:ident)+) => {
        // The type is named out here, where its path means what the caller means.
        #[doc(hidden)]
        type ExportedFmi2Model = $model;

        /// The C functions of the FMU.
        #[allow(unsafe_code, non_snake_case, clippy::missing_safety_doc)]
        pub mod fmi2 {
            use super::ExportedFmi2Model as Exported;
            use $crate::ffi::types::*;

            $($crate::$functions! { Exported })+

            $crate::__fmi_functions! { Exported, common,
                fn fmi2Instantiate = instantiate[&$crate::ffi::Kinds::<Exported>::$kinds](
                    instanceName: Text, fmuType: Type, fmuGUID: Text, fmuResourceLocation: Text,
                    functions: *const CallbackFunctions, visible: Boolean, loggingOn: Boolean) -> Component;
                fn fmi2GetTypesPlatform = get_types_platform() -> Text;
                fn fmi2GetVersion = get_version() -> Text;
                fn fmi2SetDebugLogging = set_debug_logging(
                    c: Component, loggingOn: Boolean, nCategories: usize, categories: *const Text) -> Status;
                fn fmi2FreeInstance = free_instance(c: Component) -> ();
                fn fmi2SetupExperiment = setup_experiment(
                    c: Component, toleranceDefined: Boolean, tolerance: Real, startTime: Real,
                    stopTimeDefined: Boolean, stopTime: Real) -> Status;
                fn fmi2EnterInitializationMode = enter_initialization_mode(c: Component) -> Status;
                fn fmi2ExitInitializationMode = exit_initialization_mode(c: Component) -> Status;
                fn fmi2Terminate = terminate(c: Component) -> Status;
                fn fmi2Reset = reset(c: Component) -> Status;
                fn fmi2GetDirectionalDerivative = get_directional_derivative(
                    c: Component, vUnknown_ref: *const ValueReference, nUnknown: usize,
                    vKnown_ref: *const ValueReference, nKnown: usize,
                    dvKnown: *const Real, dvUnknown: *mut Real) -> Status;
            }

            $crate::__fmi2_values! { Exported,
                Real: fmi2GetReal = get_real, fmi2SetReal = set_real;
                Integer: fmi2GetInteger = get_integer, fmi2SetInteger = set_integer;
                Boolean: fmi2GetBoolean = get_boolean, fmi2SetBoolean = set_boolean;
                Text: fmi2GetString = get_string, fmi2SetString = set_string;
            }

            $crate::__fmi_functions! { Exported, states,
                fn fmi2GetFMUstate = get_fmu_state(c: Component, state: *mut FmuState) -> Status;
                fn fmi2SetFMUstate = set_fmu_state(c: Component, state: FmuState) -> Status;
                fn fmi2FreeFMUstate = free_fmu_state(c: Component, state: *mut FmuState) -> Status;
                fn fmi2SerializedFMUstateSize = serialized_fmu_state_size(
                    c: Component, state: FmuState, size: *mut usize) -> Status;
                fn fmi2SerializeFMUstate = serialize_fmu_state(
                    c: Component, state: FmuState, serializedState: *mut Byte, size: usize) -> Status;
                fn fmi2DeSerializeFMUstate = de_serialize_fmu_state(
                    c: Component, serializedState: *const Byte, size: usize, state: *mut FmuState) -> Status;
            }
        }
    };
}

/// Defines the getters and setters of the values of some types. There are as many values as references.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_values {
    (
        $model:ident,
        $($type:ty: $get:ident = $get_generic:ident, $set:ident = $set_generic:ident;)*
    ) => { $crate::__fmi_functions! { $model, values, $(
        fn $get = $get_generic(
            c: Component, vr: *const ValueReference, nvr: usize, value: *mut $type)[nvr] -> Status;
        fn $set = $set_generic(
            c: Component, vr: *const ValueReference, nvr: usize, value: *const $type)[nvr] -> Status;
    )* } };
}

/// The functions of co-simulation alone.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_co_simulation {
    ($model:ident) => {
        $crate::__fmi_functions! { $model, co_simulation,
            fn fmi2SetRealInputDerivatives = set_real_input_derivatives(
                c: Component, vr: *const ValueReference, nvr: usize,
                order: *const Integer, value: *const Real) -> Status;
            fn fmi2GetRealOutputDerivatives = get_real_output_derivatives(
                c: Component, vr: *const ValueReference, nvr: usize,
                order: *const Integer, value: *mut Real) -> Status;
            fn fmi2DoStep = do_step(
                c: Component, currentCommunicationPoint: Real, communicationStepSize: Real,
                noSetFMUStatePriorToCurrentPoint: Boolean) -> Status;
            fn fmi2CancelStep = cancel_step(c: Component) -> Status;
            fn fmi2GetStatus = get_status(c: Component, s: StatusKind, value: *mut Status) -> Status;
            fn fmi2GetRealStatus = get_real_status(c: Component, s: StatusKind, value: *mut Real) -> Status;
            fn fmi2GetIntegerStatus = get_integer_status(
                c: Component, s: StatusKind, value: *mut Integer) -> Status;
            fn fmi2GetBooleanStatus = get_boolean_status(
                c: Component, s: StatusKind, value: *mut Boolean) -> Status;
            fn fmi2GetStringStatus = get_string_status(
                c: Component, s: StatusKind, value: *mut Text) -> Status;
        }
    };
}

/// The functions of Model Exchange alone.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi2_model_exchange {
    ($model:ident) => {
        $crate::__fmi_functions! { $model, model_exchange,
            fn fmi2EnterEventMode = enter_event_mode(c: Component) -> Status;
            fn fmi2NewDiscreteStates = new_discrete_states(
                c: Component, fmi2eventInfo: *mut EventInfo) -> Status;
            fn fmi2EnterContinuousTimeMode = enter_continuous_time_mode(c: Component) -> Status;
            fn fmi2CompletedIntegratorStep = completed_integrator_step(
                c: Component, noSetFMUStatePriorToCurrentPoint: Boolean,
                enterEventMode: *mut Boolean, terminateSimulation: *mut Boolean) -> Status;
            fn fmi2SetTime = set_time(c: Component, time: Real) -> Status;
            fn fmi2SetContinuousStates = set_continuous_states(
                c: Component, x: *const Real, nx: usize) -> Status;
            fn fmi2GetDerivatives = get_derivatives(
                c: Component, derivatives: *mut Real, nx: usize) -> Status;
            fn fmi2GetEventIndicators = get_event_indicators(
                c: Component, eventIndicators: *mut Real, ni: usize) -> Status;
            fn fmi2GetContinuousStates = get_continuous_states(
                c: Component, x: *mut Real, nx: usize) -> Status;
            fn fmi2GetNominalsOfContinuousStates = get_nominals_of_continuous_states(
                c: Component, x_nominal: *mut Real, nx: usize) -> Status;
        }
    };
}

/// Defines C functions that pass their arguments on to the generic ones of a module of [`ffi`](crate::ffi),
/// after the `first` and before the `last`, which these have in addition.
#[doc(hidden)]
#[macro_export]
macro_rules! __fmi_functions {
    (
        $model:ident, $module:ident,
        $(fn $name:ident = $generic:ident $([$first:expr])?
            ($($argument:ident: $type:ty),*) $([$last:expr])? -> $result:ty;)*
    ) => { $(
        #[doc = concat!("`", stringify!($name), "`: see [`", stringify!($generic), "`].")]
        #[doc = concat!("\n[`", stringify!($generic), "`]: fmu_export::ffi::", stringify!($module), "::",
            stringify!($generic))]
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($argument: $type),*) -> $result {
            // SAFETY: the standard asks of the importer that a component is NULL or an instance of this model
            // that is not freed, that pointers are NULL or point to as many elements as stated, that texts
            // end with a NUL, and that callbacks are of their types.
            unsafe { $crate::ffi::$module::$generic::<$model>($($first,)? $($argument,)* $($last)?) }
        }
    )* };
}
