//! The functions of Model Exchange alone (FMI 2.0.5, section 3.2).

use super::arguments::{array, place, zeroed};
use super::types::{Boolean, Component, EventInfo, Real, Status};
use super::with;
use crate::call::Call;
use crate::instance::Instance;
use crate::model::{ModelExchange, Update};

/// `fmi2EnterEventMode`
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn enter_event_mode<M: ModelExchange>(component: Component) -> Status {
    let body = |instance: &mut Instance<M>| {
        instance.enter_event_mode();
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::EnterEventMode, body) }
}

/// `fmi2NewDiscreteStates`
///
/// # Safety
/// `component` is NULL or an instance; `information` is NULL or points to room for an `fmi2EventInfo`.
pub unsafe fn new_discrete_states<M: ModelExchange>(
    component: Component,
    information: *mut EventInfo,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
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
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::NewDiscreteStates, body) }
}

/// `fmi2EnterContinuousTimeMode`
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn enter_continuous_time_mode<M: ModelExchange>(component: Component) -> Status {
    let body = |instance: &mut Instance<M>| {
        instance.enter_continuous_time_mode();
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::EnterContinuousTimeMode, body) }
}

/// `fmi2CompletedIntegratorStep`
///
/// # Safety
/// `component` is NULL or an instance; the others are NULL or point to room for one value.
pub unsafe fn completed_integrator_step<M: ModelExchange>(
    component: Component,
    _no_set_fmu_state_prior_to_current_point: Boolean,
    enter_event_mode: *mut Boolean,
    terminate_simulation: *mut Boolean,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let (event, end) = unsafe {
            (place("enterEventMode", enter_event_mode)?, place("terminateSimulation", terminate_simulation)?)
        };
        event.write(Boolean::from(instance.complete_step()?));
        end.write(0);
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::CompletedIntegratorStep, body) }
}

/// `fmi2SetTime`
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn set_time<M: ModelExchange>(component: Component, time: Real) -> Status {
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SetTime, |instance: &mut Instance<M>| instance.set_time(time)) }
}

/// `fmi2SetContinuousStates`
///
/// # Safety
/// `component` is NULL or an instance; the array has `count` elements.
pub unsafe fn set_continuous_states<M: ModelExchange>(
    component: Component,
    states: *const Real,
    count: usize,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        instance.set_states(unsafe { array("x", states, count) }?)
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SetContinuousStates, body) }
}

macro_rules! array_functions {
    ($($c_name:literal $name:ident $call:ident $argument:literal $method:ident;)*) => { $(
        #[doc = concat!("`", $c_name, "`")]
        ///
        /// # Safety
        /// `component` is NULL or an instance; the array has `count` elements.
        pub unsafe fn $name<M: ModelExchange>(component: Component, values: *mut Real, count: usize) -> Status {
            let body = |instance: &mut Instance<M>| {
                // SAFETY: as the caller promises.
                instance.$method(unsafe { zeroed($argument, values, count) }?)
            };
            // SAFETY: as the caller promises.
            unsafe { with(component, Call::$call, body) }
        }
    )* };
}

array_functions! {
    "fmi2GetDerivatives" get_derivatives GetDerivatives "derivatives" derivatives;
    "fmi2GetEventIndicators" get_event_indicators GetEventIndicators "eventIndicators" event_indicators;
    "fmi2GetContinuousStates" get_continuous_states GetContinuousStates "x" states;
    "fmi2GetNominalsOfContinuousStates" get_nominals_of_continuous_states GetNominalsOfContinuousStates "x_nominal" nominals;
}
