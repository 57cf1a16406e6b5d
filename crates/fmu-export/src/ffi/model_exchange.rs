//! The functions of Model Exchange (FMI 2.0.5, section 3.2; FMI 3.0.2, section 3.2).

use super::arguments::{array, array_mut, place};
use super::guard::functions;
use super::types::{Boolean, Component, EventInfo, Real, Status};
use crate::call::{Call, Phase};
use crate::model::{ModelExchange, Update};

functions! {
    /// `fmi2EnterEventMode`, `fmi3EnterEventMode`
    enter_event_mode<ModelExchange>(): EnterEventMode, |instance| instance.enter(Phase::EventMode);
    /// `fmi2NewDiscreteStates`
    new_discrete_states<ModelExchange>(information: *mut EventInfo): NewDiscreteStates, |instance| {
        // SAFETY: `information` is NULL or points to room for one value that nobody else uses during the
        // call.
        let information = unsafe { place("fmi2eventInfo", information) }?;
        let Update { again, states_changed, nominals_changed, next_event } = instance.update()?;
        information.write(EventInfo {
            new_discrete_states_needed: Boolean::from(again),
            terminate_simulation: 0,
            nominals_of_continuous_states_changed: Boolean::from(nominals_changed),
            values_of_continuous_states_changed: Boolean::from(states_changed),
            next_event_time_defined: Boolean::from(next_event.is_some()),
            next_event_time: next_event.unwrap_or(0.0),
        });
        Ok(())
    };
    /// `fmi2EnterContinuousTimeMode`, `fmi3EnterContinuousTimeMode`
    enter_continuous_time_mode<ModelExchange>(): EnterContinuousTimeMode, |instance| {
        instance.enter(Phase::ContinuousTimeMode)
    };
    /// `fmi2CompletedIntegratorStep`, `fmi3CompletedIntegratorStep`
    completed_integrator_step<ModelExchange>(
        _no_set_fmu_state_prior_to_current_point: impl Sized, enter_event_mode: *mut impl From<bool>,
        terminate_simulation: *mut impl From<bool>
    ): CompletedIntegratorStep, |instance| {
        // SAFETY: `enter_event_mode` and `terminate_simulation` are NULL or point to room for one value each
        // that nobody else uses during the call.
        let (event, end) = unsafe {
            (place("enterEventMode", enter_event_mode)?, place("terminateSimulation", terminate_simulation)?)
        };
        event.write(instance.complete_step()?.into());
        end.write(false.into());
        Ok(())
    };
    /// `fmi2SetTime`, `fmi3SetTime`
    set_time<ModelExchange>(time: Real): SetTime, |instance| instance.set_time(time);
    /// `fmi2SetContinuousStates`, `fmi3SetContinuousStates`
    set_continuous_states<ModelExchange>(states: *const Real, count: usize): SetContinuousStates, |instance| {
        // SAFETY: `states` is NULL or points to `count` numbers that stay as they are during the call.
        instance.set_states(unsafe { array("x", states, count) }?)
    };
    /// `fmi2GetDerivatives`, `fmi3GetContinuousStateDerivatives`
    get_derivatives<ModelExchange>(values: *mut Real, count: usize): GetDerivatives, |instance| {
        // SAFETY: `values` is NULL or points to room for `count` numbers that nobody else uses during the
        // call.
        instance.derivatives(unsafe { array_mut("derivatives", values, count, 0.0) }?)
    };
    /// `fmi2GetEventIndicators`, `fmi3GetEventIndicators`
    get_event_indicators<ModelExchange>(values: *mut Real, count: usize): GetEventIndicators, |instance| {
        // SAFETY: `values` is NULL or points to room for `count` numbers that nobody else uses during the
        // call.
        instance.event_indicators(unsafe { array_mut("eventIndicators", values, count, 0.0) }?)
    };
    /// `fmi2GetContinuousStates`, `fmi3GetContinuousStates`
    get_continuous_states<ModelExchange>(values: *mut Real, count: usize): GetContinuousStates, |instance| {
        // SAFETY: `values` is NULL or points to room for `count` numbers that nobody else uses during the
        // call.
        instance.states(unsafe { array_mut("x", values, count, 0.0) }?)
    };
    /// `fmi2GetNominalsOfContinuousStates`, `fmi3GetNominalsOfContinuousStates`
    get_nominals_of_continuous_states<ModelExchange>(
        values: *mut Real, count: usize
    ): GetNominalsOfContinuousStates, |instance| {
        // SAFETY: `values` is NULL or points to room for `count` numbers that nobody else uses during the
        // call.
        instance.nominals(unsafe { array_mut("x_nominal", values, count, 0.0) }?)
    };
}
