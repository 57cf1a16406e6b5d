//! The functions that co-simulation and Model Exchange have in common (FMI 2.0.5, section 2.1).

use super::arguments::{array, array_mut, text, to_get, to_set};
use super::guard::{self, Slot, functions};
use super::kinds::Kinds;
use super::types::{
    Boolean, CallbackFunctions, Component, Integer, Real, Status, Text, Type, ValueReference, status,
};
use crate::call::Call;
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
        // SAFETY: not NULL; the rest as the caller promises.
        unsafe { CStr::from_ptr(instance_name) }.to_owned()
    };
    // SAFETY: as the caller promises.
    let callbacks = unsafe { array("functions", functions, 1) }.ok().and_then(<[_]>::first);
    let logger =
        || Logger::new(callbacks.and_then(|callbacks| sink(*callbacks, name.clone())), logging_on != 0);
    // SAFETY: as the caller promises.
    let texts = unsafe { (text("fmuGUID", guid), text("fmuResourceLocation", resource_location)) };
    let checked = kinds.purpose(fmu_type).and_then(|purpose| Ok((purpose, check_texts(texts)?)));
    let instance = guard::catch(|| match checked {
        Ok((purpose, (guid, location))) => {
            Instance::<M>::new(&name.to_string_lossy(), guid, location, purpose, logger())
        }
        Err(failure) => {
            logger().log().error(format_args!("fmi2Instantiate: {failure}"));
            None
        }
    });
    match instance {
        Ok(Some(instance)) => Slot::component(instance),
        Ok(None) => ptr::null_mut(),
        Err(panic) => {
            logger().log().error(format_args!("fmi2Instantiate: internal error, please report it: {panic}"));
            ptr::null_mut()
        }
    }
}

type OptionalText<'a> = Result<Option<&'a str>, Failure>;

fn check_texts<'a>(
    (guid, location): (OptionalText<'a>, OptionalText<'a>),
) -> Result<(&'a str, Option<&'a str>), Failure> {
    let guid = guid?.ok_or("fmuGUID is NULL")?;
    Ok((guid, location?))
}

/// Passes messages on to the importer's logger.
fn sink(callbacks: CallbackFunctions, name: CString) -> Option<Box<Sink>> {
    let logger = callbacks.logger?;
    Some(Box::new(move |weight, category, message| {
        let message = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
        let category = CString::new(category.name()).unwrap_or_default();
        let environment = callbacks.component_environment;
        // The message goes through "%s": it may hold what printf would take for a format.
        // SAFETY: the importer promised a logger of this type; the texts live until it returns.
        unsafe {
            logger(
                environment,
                name.as_ptr(),
                status(weight),
                category.as_ptr(),
                c"%s".as_ptr(),
                message.as_ptr(),
            );
        }
    }))
}

/// `fmi2FreeInstance`
///
/// From inside a call, that is from the logger, the instance is freed at the end of that call.
///
/// # Safety
/// `component` is NULL or an instance of this model that was not freed; it is afterwards.
pub unsafe fn free_instance<M: Model>(component: Component) {
    // SAFETY: as the caller promises.
    unsafe { guard::free::<M>(component) };
}

functions! {
    /// `fmi2SetDebugLogging`
    ///
    /// Without categories all are meant. An unknown one is refused, and nothing changes then.
    set_debug_logging<Model>(
        logging_on: Boolean, count: usize, categories: *const Text
    ): SetDebugLogging, |instance| {
        // SAFETY: as the caller promises.
        let categories = unsafe { array("categories", categories, count) }?;
        let names = categories.iter().map(|&category| {
            // SAFETY: as the caller promises.
            unsafe { text("categories", category) }?.ok_or_else(|| Failure::from("a category is NULL"))
        });
        instance.set_debug_logging(logging_on != 0, names)
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
        instance.enter_initialization_mode();
        Ok(())
    };
    /// `fmi2ExitInitializationMode`
    exit_initialization_mode<Model>(): ExitInitializationMode, Instance::exit_initialization_mode;
    /// `fmi2Terminate`
    terminate<Model>(): Terminate, |instance| {
        instance.terminate();
        Ok(())
    };
    /// `fmi2Reset`
    reset<Model>(): Reset, |instance| {
        instance.reset();
        Ok(())
    };
    /// `fmi2GetString`
    ///
    /// The texts live until the next call of this for the instance.
    get_string<Model>(
        references: *const ValueReference, count: usize, values: *mut Text
    ): GetString, |instance| {
        // SAFETY: as the caller promises.
        let (references, values) = unsafe { to_get(references, values, count) }?;
        for (slot, text) in values.iter_mut().zip(instance.get_string(references)?) {
            slot.write(text.as_ptr());
        }
        Ok(())
    };
    /// `fmi2SetString`
    ///
    /// One value that is refused leaves all as they were.
    set_string<Model>(
        references: *const ValueReference, count: usize, values: *const Text
    ): SetString, |instance| {
        // SAFETY: as the caller promises.
        let (references, values) = unsafe { to_set(references, values, count) }?;
        let texts = values.iter().map(|&value| {
            // SAFETY: as the caller promises.
            unsafe { text("value", value) }?.ok_or_else(|| Failure::from("a value is NULL"))
        });
        instance.set_string(references, &texts.collect::<Result<Vec<_>, _>>()?)
    };
    /// `fmi2GetDirectionalDerivative`
    get_directional_derivative<Model>(
        unknowns: *const ValueReference, unknown_count: usize,
        knowns: *const ValueReference, known_count: usize,
        seeds: *const Real, values: *mut Real
    ): GetDirectionalDerivative, |instance| {
        // SAFETY: as the caller promises.
        let (unknowns, values) = unsafe {
            (array("vUnknown_ref", unknowns, unknown_count)?, array_mut("dvUnknown", values, unknown_count)?)
        };
        // SAFETY: as the caller promises.
        let (knowns, seeds) =
            unsafe { (array("vKnown_ref", knowns, known_count)?, array("dvKnown", seeds, known_count)?) };
        instance.directional_derivative(unknowns, knowns, seeds, values)
    };
}

/// Defines the getter and the setter of the values of a type.
macro_rules! values {
    ($(
        $type:ty: $get:ident $get_call:ident $get_name:literal, $set:ident $set_call:ident $set_name:literal;
    )*) => {
        functions! { $(
            #[doc = concat!("`", $get_name, "`")]
            $get<Model>(
                references: *const ValueReference, count: usize, values: *mut $type
            ): $get_call, |instance| {
                // SAFETY: as the caller promises.
                let (references, values) = unsafe { to_get(references, values, count) }?;
                instance.$get(references, values)
            };
            #[doc = concat!("`", $set_name, "`")]
            ///
            /// One value that is refused leaves all as they were.
            $set<Model>(
                references: *const ValueReference, count: usize, values: *const $type
            ): $set_call, |instance| {
                // SAFETY: as the caller promises.
                let (references, values) = unsafe { to_set(references, values, count) }?;
                instance.$set(references, values)
            };
        )* }
    };
}

values! {
    Real: get_real GetReal "fmi2GetReal", set_real SetReal "fmi2SetReal";
    Integer: get_integer GetInteger "fmi2GetInteger", set_integer SetInteger "fmi2SetInteger";
    Boolean: get_boolean GetBoolean "fmi2GetBoolean", set_boolean SetBoolean "fmi2SetBoolean";
}
