//! The functions that co-simulation and Model Exchange have in common (FMI 2.0.5, section 2.1).

use super::Kinds;
use super::arguments::{array, array_mut, bytes, required_text, text};
use super::guard::{self, Slot, functions};
use super::types::{Boolean, CallbackFunctions, Component, Real, Status, Text, Type, ValueReference, status};
use crate::call::{Call, Phase};
use crate::failure::Failure;
use crate::instance::Instance;
use crate::log::{Logger, Sink};
use crate::model::{Experiment, Model};
use std::ffi::{CStr, CString};
use std::ptr;

/// `fmi2GetTypesPlatform`
///
/// # Safety
/// None needed; unsafe like its siblings.
pub unsafe fn get_types_platform<M: Model>() -> Text {
    c"default".as_ptr()
}

/// `fmi2GetVersion`
///
/// # Safety
/// None needed; unsafe like its siblings.
pub unsafe fn get_version<M: Model>() -> Text {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`
///
/// NULL is returned, after a log, when guid, kind or environment do not suit. What `functions` points to is
/// copied.
///
/// # Safety
/// The texts are NULL or end with a NUL; `functions` is NULL or points to callbacks of the stated types.
#[allow(clippy::too_many_arguments, reason = "the standard's seven, and what the library can do")]
pub unsafe fn instantiate<M: Model>(
    kinds: &Kinds<M>,
    instance_name: Text,
    fmu_type: Type,
    guid: Text,
    resource_location: Text,
    functions: *const CallbackFunctions,
    _visible: Boolean,
    logging_on: Boolean,
) -> Component {
    let name = if instance_name.is_null() {
        CString::default()
    } else {
        // SAFETY: `instance_name` is not NULL and ends with a NUL.
        unsafe { CStr::from_ptr(instance_name) }.to_owned()
    };
    // SAFETY: `functions` is NULL or points to callbacks of the stated types, which are copied here.
    let callbacks = unsafe { array("functions", functions, 1) }.ok().and_then(<[_]>::first);
    let sink = || callbacks.and_then(|callbacks| logger_of(*callbacks, name.clone()));
    let logger = || Logger::new(sink(), logging_on != 0);
    make("fmi2Instantiate", logger, |logger| {
        // SAFETY: the texts are NULL, or end with a NUL and stay as they are during the call.
        let (guid, location) = unsafe { (required_text("fmuGUID", guid)?, bytes(resource_location)) };
        Instance::new(&name.to_string_lossy(), guid, location, kinds.purpose(fmu_type)?, logger)
    })
}

/// Makes an instance for the C function `function`; NULL, after a log, if it is refused. The first call also
/// makes panics silent.
pub(super) fn make<M: Model>(
    function: &str,
    logger: impl Fn() -> Logger,
    instantiate: impl FnOnce(Logger) -> Result<Instance<M>, Failure>,
) -> Component {
    guard::install_panic_hook();
    let made = guard::catch(|| instantiate(logger()));
    let failure = match made {
        Ok(Ok(instance)) => return Slot::component(instance),
        Ok(Err(failure)) => failure,
        Err(panic) => Failure(format!("internal error, please report it: {panic}")),
    };
    logger().log().error(format_args!("{function}: {failure}"));
    ptr::null_mut()
}

/// Passes messages on to the importer's logger.
fn logger_of(callbacks: CallbackFunctions, name: CString) -> Option<Box<Sink>> {
    let logger = callbacks.logger?;
    let (environment, format) = (callbacks.component_environment, c"%s".as_ptr());
    Some(sink(move |status, category, message| {
        // The message goes through "%s": it may hold what printf would take for a format.
        // SAFETY: the importer promised a logger of this type; the texts live until it returns.
        unsafe { logger(environment, name.as_ptr(), status, category.as_ptr(), format, message.as_ptr()) };
    }))
}

/// Passes messages on to `log`, as C has them: status, category and text.
pub(super) fn sink(log: impl Fn(Status, &CStr, &CStr) + 'static) -> Box<Sink> {
    Box::new(move |weight, category, message| {
        let message = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
        let category = CString::new(category.name()).unwrap_or_default();
        log(status(weight), &category, &message);
    })
}

/// `fmi2FreeInstance`, `fmi3FreeInstance`
///
/// From inside a call, that is from the logger, the instance is freed at the end of that call.
///
/// # Safety
/// `component` is NULL or an instance of this model that was not freed; it is afterwards.
pub unsafe fn free_instance<M: Model>(component: Component) {
    // SAFETY: `component` is NULL or an instance of this model that has not been freed.
    unsafe { guard::free::<M>(component) };
}

functions! {
    /// `fmi2SetDebugLogging`, `fmi3SetDebugLogging`
    ///
    /// Without categories all are meant. An unknown one is warned of and left out.
    set_debug_logging<Model>(
        logging_on: impl From<bool> + PartialEq, count: usize, categories: *const Text
    ): SetDebugLogging, |instance| {
        // SAFETY: `categories` is NULL or points to `count` texts that stay as they are during the call.
        let categories = unsafe { array("categories", categories, count) }?;
        let names = categories.iter().map(|&category| {
            // SAFETY: `category` is NULL or a text that ends with a NUL.
            unsafe { text("categories", category) }?.ok_or_else(|| Failure::from("a category is NULL"))
        });
        instance.set_debug_logging(logging_on != false.into(), names)
    };
    /// `fmi2SetupExperiment`
    setup_experiment<Model>(
        tolerance_defined: Boolean, tolerance: Real, start: Real, stop_defined: Boolean, stop: Real
    ): SetupExperiment, |instance| {
        instance.setup_experiment(Experiment {
            tolerance: (tolerance_defined != 0).then_some(tolerance),
            start,
            stop: (stop_defined != 0).then_some(stop),
        })
    };
    /// `fmi2EnterInitializationMode`
    enter_initialization_mode<Model>(): EnterInitializationMode, |instance| {
        instance.enter(Phase::InitializationMode)
    };
    /// `fmi2ExitInitializationMode`, `fmi3ExitInitializationMode`
    exit_initialization_mode<Model>(): ExitInitializationMode, Instance::exit_initialization_mode;
    /// `fmi2Terminate`, `fmi3Terminate`
    terminate<Model>(): Terminate, |instance| instance.enter(Phase::Terminated);
    /// `fmi2Reset`, `fmi3Reset`
    reset<Model>(): Reset, |instance| {
        instance.reset();
        Ok(())
    };
    /// `fmi2GetDirectionalDerivative`
    get_directional_derivative<Model>(
        unknowns: *const ValueReference, unknown_count: usize,
        knowns: *const ValueReference, known_count: usize,
        seeds: *const Real, values: *mut Real
    ): GetDirectionalDerivative, |instance| {
        // SAFETY: `knowns` and `seeds` are NULL or point to `known_count` elements that stay as they are
        // during the call.
        let (knowns, seeds) =
            unsafe { (array("vKnown_ref", knowns, known_count)?, array("dvKnown", seeds, known_count)?) };
        // SAFETY: `unknowns` and `values` are NULL or point to `unknown_count` elements that nobody else
        // changes during the call.
        let (unknowns, values) = unsafe {
            (
                array("vUnknown_ref", unknowns, unknown_count)?,
                array_mut("dvUnknown", values, unknown_count, 0.0)?,
            )
        };
        instance.derivatives_along([knowns, unknowns], seeds, values, false)
    };
}
