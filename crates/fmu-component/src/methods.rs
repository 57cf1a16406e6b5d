//! The methods that Co-Simulation and Model Exchange have in common (FMI 3.0.2, sections 2.2 and 2.3).
//!
//! The draft lists them twice, once for each kind, so that they are macros here.

/// Defines the methods of an instance whose `self.0` is a [`Resource`](super::resource::Resource).
macro_rules! common_methods {
    () => {
        $crate::methods::values! {
            f64: get_float64 GetReal get_float64, set_float64 SetReal set_real;
            bool: get_boolean GetBoolean get_boolean, set_boolean SetBoolean set_boolean;
            i32: get_int32 GetInteger get_integer, set_int32 SetInteger set_integer,
                |kind| matches!(kind, fmu_export::Kind::Integer { .. });
            i64: get_int64 GetInt64 get_integer, set_int64 SetInt64 set_integer,
                |kind| matches!(kind, fmu_export::Kind::Enumeration { .. });
        }
        $crate::methods::unused_types! {
            f32: get_float32 GetFloat32, set_float32 SetFloat32;
            i8: get_int8 GetInt8, set_int8 SetInt8;
            u8: get_uint8 GetUInt8, set_uint8 SetUInt8;
            i16: get_int16 GetInt16, set_int16 SetInt16;
            u16: get_uint16 GetUInt16, set_uint16 SetUInt16;
            u32: get_uint32 GetUInt32, set_uint32 SetUInt32;
            u64: get_uint64 GetUInt64, set_uint64 SetUInt64;
            Vec<u8>: get_binary GetBinary, set_binary SetBinary;
        }
        $crate::methods::never! {
            enter_configuration_mode() -> Status = EnterConfigurationMode;
            exit_configuration_mode() -> Status = ExitConfigurationMode;
            evaluate_discrete_states() -> Status = EvaluateDiscreteStates;
            get_number_of_variable_dependencies(u32) -> u64 = GetNumberOfVariableDependencies;
            get_variable_dependencies(u32) -> Vec<VariableDependency> = GetVariableDependencies;
            get_clock(Vec<u32>) -> Vec<bool> = GetClock;
            set_clock(Vec<u32>, Vec<bool>) -> Status = SetClock;
            get_interval_decimal(Vec<u32>) -> Vec<(f64, IntervalQualifier)> = GetIntervalDecimal;
            get_interval_fraction(Vec<u32>) -> Vec<(IntervalFraction, IntervalQualifier)> =
                GetIntervalFraction;
            get_shift_decimal(Vec<u32>) -> Vec<f64> = GetShiftDecimal;
            get_shift_fraction(Vec<u32>) -> Vec<IntervalFraction> = GetShiftFraction;
            set_interval_decimal(Vec<u32>, Vec<f64>) -> Status = SetIntervalDecimal;
            set_interval_fraction(Vec<u32>, Vec<IntervalFraction>) -> Status = SetIntervalFraction;
            set_shift_decimal(Vec<u32>, Vec<f64>) -> Status = SetShiftDecimal;
            set_shift_fraction(Vec<u32>, Vec<IntervalFraction>) -> Status = SetShiftFraction;
        }

        fn set_debug_logging(&self, logging_on: bool, categories: Vec<String>) -> Status {
            self.0.run(Call::SetDebugLogging, |instance| {
                instance.set_debug_logging(logging_on, categories.iter().map(|name| Ok(name.as_str())))
            })
        }

        fn enter_initialization_mode(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
            self.0.run(Call::EnterInitializationMode, |instance| {
                instance.setup_experiment(fmu_export::Experiment { tolerance, start, stop })?;
                instance.enter(Phase::InitializationMode)
            })
        }

        fn exit_initialization_mode(&self) -> Status {
            self.0.run(Call::ExitInitializationMode, |instance| instance.exit_initialization_mode())
        }

        fn enter_event_mode(&self) -> Status {
            self.0.run(Call::EnterEventMode, |instance| instance.enter(Phase::EventMode))
        }

        fn update_discrete_states(&self) -> Result<DiscreteStatesInfo, Status> {
            self.0.ask(Call::NewDiscreteStates, |instance| {
                let update = instance.update()?;
                Ok(DiscreteStatesInfo {
                    new_discrete_states_needed: update.again,
                    terminate_simulation: false,
                    nominals_of_continuous_states_changed: update.nominals_changed,
                    values_of_continuous_states_changed: update.states_changed,
                    next_event_time_defined: update.next_event.is_some(),
                    next_event_time: update.next_event.unwrap_or(0.0),
                })
            })
        }

        fn enter_step_mode(&self) -> Status {
            self.0.run(Call::EnterStepMode, |instance| instance.enter(Phase::StepMode))
        }

        fn terminate(&self) -> Status {
            self.0.run(Call::Terminate, |instance| instance.enter(Phase::Terminated))
        }

        fn reset(&self) -> Status {
            self.0.run(Call::Reset, |instance| Ok(instance.reset()))
        }

        fn get_string(&self, references: Vec<u32>) -> Result<Vec<String>, Status> {
            self.0.ask(Call::GetString, |instance| {
                let texts = instance.get_string(&references)?;
                Ok(texts.map(|text| text.to_string_lossy().into_owned()).collect())
            })
        }

        fn set_string(&self, references: Vec<u32>, values: Vec<String>) -> Status {
            self.0.set(Call::SetString, &references, &values, |instance| {
                instance.set_string(&references, &values.iter().map(String::as_str).collect::<Vec<_>>())
            })
        }

        fn get_fmu_state(&self) -> Result<Vec<u8>, Status> {
            self.0.ask(Call::GetFMUstate, |instance| {
                let handle = instance.save(0)?;
                let bytes = instance.serialize(handle);
                instance.forget(handle)?;
                bytes
            })
        }

        fn set_fmu_state(&self, state: Vec<u8>) -> Status {
            self.0.run(Call::SetFMUstate, |instance| {
                let handle = instance.deserialize(&state)?;
                instance.restore(handle)?;
                instance.forget(handle)
            })
        }

        fn get_output_derivatives(&self, requests: Vec<(u32, u32)>) -> Result<Vec<f64>, Status> {
            let (references, orders) = crate::resource::references_and_orders(&requests);
            self.0.values(Call::GetRealOutputDerivatives, requests.len(), |instance, values| {
                instance.output_derivatives(&references, &orders, values)
            })
        }

        fn get_directional_derivative(
            &self,
            unknowns: Vec<u32>,
            knowns: Vec<u32>,
            seed: Vec<f64>,
        ) -> Result<Vec<f64>, Status> {
            self.0.values(Call::GetDirectionalDerivative, unknowns.len(), |instance, values| {
                fmu_export::boundary::check_count("nSeed", seed.len(), knowns.len())?;
                instance.derivatives_along([&knowns, &unknowns], &seed, values, false)
            })
        }

        fn get_adjoint_derivative(
            &self,
            unknowns: Vec<u32>,
            knowns: Vec<u32>,
            seed: Vec<f64>,
        ) -> Result<Vec<f64>, Status> {
            self.0.values(Call::GetAdjointDerivative, knowns.len(), |instance, values| {
                fmu_export::boundary::check_count("nSeed", seed.len(), unknowns.len())?;
                instance.derivatives_along([&unknowns, &knowns], &seed, values, true)
            })
        }
    };
}
pub(super) use common_methods;

/// Getters and setters of the values of a type.
macro_rules! values {
    ($(
        $type:ty: $get:ident $get_call:ident $get_by:ident, $set:ident $set_call:ident $set_by:ident
            $(, $serves:expr)?;
    )*) => { $(
        fn $get(&self, references: Vec<u32>) -> Result<Vec<$type>, Status> {
            self.0.values(Call::$get_call, references.len(), |instance, values| {
                instance.$get_by(&references, values $(, $serves)?)
            })
        }

        fn $set(&self, references: Vec<u32>, values: Vec<$type>) -> Status {
            self.0.set(Call::$set_call, &references, &values, |instance| {
                instance.$set_by(&references, &values $(, $serves)?)
            })
        }
    )* };
}
pub(super) use values;

/// Getters and setters of types that no variable has.
macro_rules! unused_types {
    ($($type:ty: $get:ident $get_call:ident, $set:ident $set_call:ident;)*) => { $(
        fn $get(&self, references: Vec<u32>) -> Result<Vec<$type>, Status> {
            let none = |_: &mut _| fmu_export::boundary::none_served::<M>(&references).map(|()| Vec::new());
            self.0.ask(Call::$get_call, none)
        }

        fn $set(&self, references: Vec<u32>, values: Vec<$type>) -> Status {
            let none = |_: &mut _| fmu_export::boundary::none_served::<M>(&references);
            self.0.set(Call::$set_call, &references, &values, none)
        }
    )* };
}
pub(super) use unused_types;

/// Methods whose call is never allowed, whatever their arguments.
macro_rules! never {
    () => {};
    ($name:ident($($type:ty),*) -> Status = $call:ident; $($rest:tt)*) => {
        fn $name(&self, $(_: $type),*) -> Status {
            self.0.run(Call::$call, |_| Ok(()))
        }
        $crate::methods::never! { $($rest)* }
    };
    ($name:ident($($type:ty),*) -> $answer:ty = $call:ident; $($rest:tt)*) => {
        fn $name(&self, $(_: $type),*) -> Result<$answer, Status> {
            self.0.ask(Call::$call, |_| Ok(<$answer>::default()))
        }
        $crate::methods::never! { $($rest)* }
    };
}
pub(super) use never;
