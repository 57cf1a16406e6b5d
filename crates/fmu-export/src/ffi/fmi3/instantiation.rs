//! Making instances (FMI 3.0.2, section 2.3.1).

use super::types::{
    ClockUpdateCallback, Instance, InstanceEnvironment, IntermediateUpdate, IntermediateUpdateCallback,
    LogMessageCallback, PreemptionCallback,
};
use crate::access;
use crate::ffi::arguments::{array, bytes, required_text, text};
use crate::ffi::common::{make, sink};
use crate::ffi::types::{Text, ValueReference};
use crate::instance::{self, Purpose};
use crate::log::Logger;
use crate::model::{Interface, ModelExchange};
use crate::variable::VariableId;
use std::rc::Rc;

/// `fmi3GetVersion`
///
/// # Safety
/// None needed; unsafe like its siblings.
pub unsafe fn get_version<M: ModelExchange>() -> Text {
    c"3.0".as_ptr()
}

/// `fmi3InstantiateModelExchange`
///
/// NULL is returned, after a log, when token or environment do not suit.
///
/// # Safety
/// The texts are NULL or end with a NUL; `log_message` is NULL or a function of its type.
pub unsafe fn instantiate_model_exchange<M: ModelExchange>(
    name: Text,
    token: Text,
    resource_path: Text,
    _visible: bool,
    logging_on: bool,
    environment: InstanceEnvironment,
    log_message: LogMessageCallback,
) -> Instance {
    let logger = || logger(environment, log_message, logging_on);
    make("fmi3InstantiateModelExchange", logger, |logger| {
        let purpose = Purpose::fmi3(Interface::ModelExchange, M::STATES);
        // SAFETY: the texts are NULL, or end with a NUL and stay as they are during the call.
        let (name, token, path) = unsafe { texts(name, token, resource_path) }?;
        instance::Instance::<M>::new(name, token, path, purpose, logger)
    })
}

/// `fmi3InstantiateCoSimulation`
///
/// NULL is returned, after a log, when token or environment do not suit. A warning names intermediate
/// variables that are not continuous inputs: some importers list all that they record. `intermediate_update`
/// is called only where the description says `providesIntermediateUpdate`.
///
/// # Safety
/// As for [`instantiate_model_exchange`]; `intermediate_variables` is NULL or points to as many references.
#[allow(clippy::too_many_arguments, clippy::fn_params_excessive_bools, reason = "the standard's")]
pub unsafe fn instantiate_co_simulation<M: ModelExchange>(
    name: Text,
    token: Text,
    resource_path: Text,
    _visible: bool,
    logging_on: bool,
    event_mode_used: bool,
    early_return_allowed: bool,
    intermediate_variables: *const ValueReference,
    intermediate_variable_count: usize,
    environment: InstanceEnvironment,
    log_message: LogMessageCallback,
    intermediate_update: IntermediateUpdateCallback,
) -> Instance {
    let logger = || logger(environment, log_message, logging_on);
    make("fmi3InstantiateCoSimulation", logger, |mut logger| {
        // SAFETY: `intermediate_variables` is NULL or points to `intermediate_variable_count` references
        // that stay as they are during the call.
        let intermediate = unsafe {
            array("requiredIntermediateVariables", intermediate_variables, intermediate_variable_count)
        }?;
        let served = |&reference: &ValueReference| {
            let variable: M::Real = access::find::<M, _>(reference)?;
            access::check_derivable_input(variable.variable())
        };
        if let Some(failure) = intermediate.iter().find_map(|reference| served(reference).err()) {
            logger.log().warning(format_args!("intermediate updates are for continuous inputs: {failure}"));
        }
        let (event_mode, early_return) = (event_mode_used, early_return_allowed);
        let purpose = Purpose { event_mode, early_return, ..Purpose::fmi3(Interface::CoSimulation, &[]) };
        // SAFETY: the texts are NULL, or end with a NUL and stay as they are during the call.
        let (name, token, path) = unsafe { texts(name, token, resource_path) }?;
        let mut made = instance::Instance::<M>::new(name, token, path, purpose, logger)?;
        // an importer need not be ready for a call that the description does not announce
        let announced = intermediate_update.filter(|_| M::Real::INTERPOLATES);
        made.intermediate_update = announced.map(|callback| asking(environment, callback));
        Ok(made)
    })
}

/// Asks the importer for inputs, by its callback.
fn asking(environment: InstanceEnvironment, callback: IntermediateUpdate) -> instance::IntermediateUpdate {
    Rc::new(move |time| {
        let (mut early, mut early_time) = (false, time);
        // SAFETY: the importer promised a callback of this type; the places live until it returns.
        unsafe {
            callback(environment, time, true, false, false, false, &raw mut early, &raw mut early_time);
        }
    })
}

/// `fmi3InstantiateScheduledExecution`: always NULL, after a log.
///
/// # Safety
/// As for [`instantiate_model_exchange`].
#[allow(clippy::too_many_arguments, reason = "the standard's")]
pub unsafe fn instantiate_scheduled_execution<M: ModelExchange>(
    _name: Text,
    _token: Text,
    _resource_path: Text,
    _visible: bool,
    logging_on: bool,
    environment: InstanceEnvironment,
    log_message: LogMessageCallback,
    _clock_update: ClockUpdateCallback,
    _lock_preemption: PreemptionCallback,
    _unlock_preemption: PreemptionCallback,
) -> Instance {
    let logger = || logger(environment, log_message, logging_on);
    make::<M>("fmi3InstantiateScheduledExecution", logger, |_| {
        Err("this FMU is for Model Exchange and co-simulation only".into())
    })
}

/// # Safety
/// The texts are NULL or end with a NUL, and nobody changes them during `'a`.
unsafe fn texts<'a>(
    name: Text,
    token: Text,
    path: Text,
) -> Result<(&'a str, &'a str, Option<&'a [u8]>), crate::Failure> {
    // SAFETY: each text is NULL, or ends with a NUL and stays as it is during `'a`.
    unsafe {
        let name = text("instanceName", name)?.unwrap_or_default();
        Ok((name, required_text("instantiationToken", token)?, bytes(path)))
    }
}

/// Passes messages on to the importer's callback.
fn logger(environment: InstanceEnvironment, log_message: LogMessageCallback, logging_on: bool) -> Logger {
    let sink = log_message.map(|log_message| {
        sink(move |status, category, message| {
            // SAFETY: the importer promised a callback of this type; the texts live until it returns.
            unsafe { log_message(environment, status, category.as_ptr(), message.as_ptr()) };
        })
    });
    Logger::new(sink, logging_on)
}
