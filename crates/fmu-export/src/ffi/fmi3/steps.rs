//! Initialisation, steps, events and derivatives (FMI 3.0.2, sections 2.2.11, 2.3, 3.2 and 4.2).

use super::types::Boolean;
use crate::call::{Call, Phase};
use crate::ffi::arguments::{array, array_mut, check_count, place, to_get};
use crate::ffi::guard::{self, functions};
use crate::ffi::types::{Component, OK, Status, ValueReference};
use crate::model::{Experiment, Model, ModelExchange, Update};

/// `fmi3DoStep`
///
/// Never returns `fmi3Discard`. A step of length 0 does nothing, and asks for no inputs. A step that ends
/// early does so just after an event. Where the importer gave an `intermediateUpdate`, that is called once,
/// before the step is computed, and may set continuous inputs for the end of the step: they run there
/// linearly.
///
/// # Safety
/// `component` is NULL or an instance, which `intermediateUpdate` does not free; pointers are NULL or point
/// to room for one value.
#[allow(clippy::too_many_arguments, reason = "the standard's")]
pub unsafe fn do_step<M: Model>(
    component: Component,
    communication_point: f64,
    step_size: f64,
    _no_set_fmu_state_prior_to_current_point: Boolean,
    event_handling_needed: *mut Boolean,
    terminate_simulation: *mut Boolean,
    early_return: *mut Boolean,
    last_successful_time: *mut f64,
) -> Status {
    // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
    // `intermediateUpdate` does not free it.
    let instance = || unsafe { guard::instance::<M>(component) };
    // SAFETY: each place is NULL or points to room for one value that nobody else uses during the call.
    let answer = |event: bool, early: bool, time: f64| unsafe {
        place("eventHandlingNeeded", event_handling_needed)?.write(event);
        place("terminateSimulation", terminate_simulation)?.write(false);
        place("earlyReturn", early_return)?.write(early);
        place("lastSuccessfulTime", last_successful_time)?.write(time);
        Ok(())
    };
    let mut asked = None;
    let begun = guard::run(instance(), Call::DoStep, |instance| {
        answer(false, false, instance.time())?;
        asked = instance.begin_step(communication_point, step_size)?;
        Ok(())
    });
    if begun != OK {
        return begun;
    }
    // No call is under way now, so that the importer can set inputs.
    if let Some((update, end)) = asked {
        update(end);
    }
    guard::run(instance(), Call::FinishStep, |instance| {
        let early = instance.finish_step()?;
        answer(early && instance.purpose.event_mode, early, instance.time())
    })
}

functions! {
    /// `fmi3EnterInitializationMode`
    start_initialization<Model>(
        tolerance_defined: Boolean, tolerance: f64, start: f64, stop_defined: Boolean, stop: f64
    ): EnterInitializationMode, |instance| {
        let (tolerance, stop) = (tolerance_defined.then_some(tolerance), stop_defined.then_some(stop));
        instance.setup_experiment(Experiment { tolerance, start, stop })?;
        instance.enter(Phase::InitializationMode)
    };
    /// `fmi3EnterStepMode`
    enter_step_mode<Model>(): EnterStepMode, |instance| instance.enter(Phase::StepMode);
    /// `fmi3UpdateDiscreteStates`
    update_discrete_states<ModelExchange>(
        discrete_states_need_update: *mut Boolean, terminate_simulation: *mut Boolean,
        nominals_of_continuous_states_changed: *mut Boolean,
        values_of_continuous_states_changed: *mut Boolean,
        next_event_time_defined: *mut Boolean, next_event_time: *mut f64
    ): NewDiscreteStates, |instance| {
        // SAFETY: each place is NULL or points to room for one value that nobody else uses during the call.
        let places = unsafe {
            [
                place("discreteStatesNeedUpdate", discrete_states_need_update)?,
                place("terminateSimulation", terminate_simulation)?,
                place("nominalsOfContinuousStatesChanged", nominals_of_continuous_states_changed)?,
                place("valuesOfContinuousStatesChanged", values_of_continuous_states_changed)?,
                place("nextEventTimeDefined", next_event_time_defined)?,
            ]
        };
        // SAFETY: `next_event_time` is NULL or points to room for one value that nobody else uses during the
        // call.
        let time = unsafe { place("nextEventTime", next_event_time) }?;
        let Update { again, states_changed, nominals_changed, next_event } = instance.update()?;
        let found = [again, false, nominals_changed, states_changed, next_event.is_some()];
        for (place, value) in places.into_iter().zip(found) {
            place.write(value);
        }
        time.write(next_event.unwrap_or(0.0));
        Ok(())
    };
    /// `fmi3GetOutputDerivatives`
    get_output_derivatives<Model>(
        references: *const ValueReference, count: usize, orders: *const i32,
        values: *mut f64, value_count: usize
    ): GetRealOutputDerivatives, |instance| {
        check_count("nValues", value_count, count)?;
        // SAFETY: `references`, `orders` and `values` are NULL or point to `count` elements that nobody else
        // changes during the call.
        let (orders, (references, values)) =
            unsafe { (array("orders", orders, count)?, to_get(references, values, count, 0.0)?) };
        instance.output_derivatives(references, orders, values)
    };
    /// `fmi3GetNumberOfEventIndicators`
    get_number_of_event_indicators<ModelExchange>(
        count: *mut usize
    ): GetNumberOfEventIndicators, |_| {
        // SAFETY: `count` is NULL or points to room for one value that nobody else uses during the call.
        unsafe { place("nEventIndicators", count) }?.write(M::EVENT_INDICATORS);
        Ok(())
    };
    /// `fmi3GetNumberOfContinuousStates`
    get_number_of_continuous_states<ModelExchange>(
        count: *mut usize
    ): GetNumberOfContinuousStates, |_| {
        // SAFETY: `count` is NULL or points to room for one value that nobody else uses during the call.
        unsafe { place("nContinuousStates", count) }?.write(M::STATES.len());
        Ok(())
    };
}

/// `fmi3GetDirectionalDerivative`, and `fmi3GetAdjointDerivative` if `adjoint`
///
/// # Safety
/// `component` is NULL or an instance; pointers are NULL or point to as many elements as stated.
#[allow(clippy::too_many_arguments, reason = "the standard's")]
pub unsafe fn derivatives_along<M: Model>(
    adjoint: bool,
    component: Component,
    unknowns: *const ValueReference,
    unknown_count: usize,
    knowns: *const ValueReference,
    known_count: usize,
    seeds: *const f64,
    seed_count: usize,
    sensitivity: *mut f64,
    sensitivity_count: usize,
) -> Status {
    let call = if adjoint { Call::GetAdjointDerivative } else { Call::GetDirectionalDerivative };
    // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
    guard::run(unsafe { guard::instance::<M>(component) }, call, |instance| {
        // SAFETY: `unknowns` and `knowns` are NULL or point to as many references as their counts state.
        let (unknowns, knowns) =
            unsafe { (array("unknowns", unknowns, unknown_count)?, array("knowns", knowns, known_count)?) };
        let (seeded, wanted) = if adjoint { (unknowns, knowns) } else { (knowns, unknowns) };
        check_count("nSeed", seed_count, seeded.len())?;
        check_count("nSensitivity", sensitivity_count, wanted.len())?;
        // SAFETY: `seeds` and `sensitivity` are NULL or point to as many numbers as their counts state, those
        // of `sensitivity` used by nobody else during the call.
        let (seeds, values) = unsafe {
            (
                array("seed", seeds, seed_count)?,
                array_mut("sensitivity", sensitivity, sensitivity_count, 0.0)?,
            )
        };
        instance.derivatives_along([seeded, wanted], seeds, values, adjoint)
    })
}
