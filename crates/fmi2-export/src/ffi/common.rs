//! The functions that co-simulation and Model Exchange have in common (FMI 2.0.5, section 2.1).

use super::arguments::{array, array_mut, text};
use super::types::{
    Boolean, CallbackFunctions, Component, Integer, Real, Status, Text, Type, ValueReference, status,
};
use super::{Kinds, guard, with};
use crate::call::Call;
use crate::instance::Instance;
use crate::log::{Logger, Sink};
use crate::model::{Experiment, Failure, Model};
use std::ffi::{CStr, CString};
use std::ptr;

/// `fmi2GetTypesPlatform`
///
/// # Safety
/// None needed; unsafe like its siblings.
#[must_use]
pub unsafe fn get_types_platform<M: Model>() -> Text {
    c"default".as_ptr()
}

/// `fmi2GetVersion`
///
/// # Safety
/// None needed; unsafe like its siblings.
#[must_use]
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
#[must_use]
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
        Ok(Some(instance)) => Box::into_raw(Box::new(instance)).cast(),
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
/// # Safety
/// `component` is NULL or an instance of this model that was not freed; it is afterwards.
pub unsafe fn free_instance<M: Model>(component: Component) {
    let instance = component.cast::<Instance<M>>();
    if instance.is_null() {
        return;
    }
    // A model that panics when it is dropped has nobody left to tell.
    // SAFETY: as the caller promises.
    let _ = guard::catch(|| drop(unsafe { Box::from_raw(instance) }));
}

/// `fmi2SetDebugLogging`
///
/// Without categories all are meant. An unknown one is refused, and nothing changes then.
///
/// # Safety
/// `component` is NULL or an instance; `categories` points to `count` texts.
pub unsafe fn set_debug_logging<M: Model>(
    component: Component,
    logging_on: Boolean,
    count: usize,
    categories: *const Text,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let categories = unsafe { array("categories", categories, count) }?;
        let names = categories.iter().map(|&category| {
            // SAFETY: as the caller promises.
            unsafe { text("categories", category) }?.ok_or_else(|| Failure::from("a category is NULL"))
        });
        instance.set_debug_logging(logging_on != 0, names)
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SetDebugLogging, body) }
}

/// `fmi2SetupExperiment`
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn setup_experiment<M: Model>(
    component: Component,
    tolerance_defined: Boolean,
    tolerance: Real,
    start: Real,
    stop_defined: Boolean,
    stop: Real,
) -> Status {
    let experiment = Experiment {
        tolerance: (tolerance_defined != 0).then_some(tolerance),
        start,
        stop: (stop_defined != 0).then_some(stop),
    };
    // SAFETY: as the caller promises.
    unsafe {
        with(component, Call::SetupExperiment, |instance: &mut Instance<M>| {
            instance.setup_experiment(experiment)
        })
    }
}

macro_rules! mode_functions {
    ($($c_name:literal $name:ident $call:ident $body:expr;)*) => { $(
        #[doc = concat!("`", $c_name, "`")]
        ///
        /// # Safety
        /// `component` is NULL or an instance.
        pub unsafe fn $name<M: Model>(component: Component) -> Status {
            let body: fn(&mut Instance<M>) -> Result<(), Failure> = $body;
            // SAFETY: as the caller promises.
            unsafe { with(component, Call::$call, body) }
        }
    )* };
}

mode_functions! {
    "fmi2EnterInitializationMode" enter_initialization_mode EnterInitializationMode |instance| {
        instance.enter_initialization_mode();
        Ok(())
    };
    "fmi2ExitInitializationMode" exit_initialization_mode ExitInitializationMode Instance::exit_initialization_mode;
    "fmi2Terminate" terminate Terminate |instance| {
        instance.terminate();
        Ok(())
    };
    "fmi2Reset" reset Reset |instance| {
        instance.reset();
        Ok(())
    };
}

macro_rules! value_functions {
    ($($type:ty: $get_c:literal $get:ident $get_call:ident, $set_c:literal $set:ident $set_call:ident;)*) => { $(
        #[doc = concat!("`", $get_c, "`")]
        ///
        /// # Safety
        /// `component` is NULL or an instance; the arrays have `count` elements.
        pub unsafe fn $get<M: Model>(
            component: Component,
            references: *const ValueReference,
            count: usize,
            values: *mut $type,
        ) -> Status {
            let body = |instance: &mut Instance<M>| {
                // SAFETY: as the caller promises.
                let (references, values) = unsafe { (array("vr", references, count)?, array_mut("value", values, count)?) };
                instance.$get(references, values)
            };
            // SAFETY: as the caller promises.
            unsafe { with(component, Call::$get_call, body) }
        }

        #[doc = concat!("`", $set_c, "`")]
        ///
        /// One value that is refused leaves all as they were.
        ///
        /// # Safety
        /// `component` is NULL or an instance; the arrays have `count` elements.
        pub unsafe fn $set<M: Model>(
            component: Component,
            references: *const ValueReference,
            count: usize,
            values: *const $type,
        ) -> Status {
            let body = |instance: &mut Instance<M>| {
                // SAFETY: as the caller promises.
                let (references, values) = unsafe { (array("vr", references, count)?, array("value", values, count)?) };
                instance.$set(references, values)
            };
            // SAFETY: as the caller promises.
            unsafe { with(component, Call::$set_call, body) }
        }
    )* };
}

value_functions! {
    Real: "fmi2GetReal" get_real GetReal, "fmi2SetReal" set_real SetReal;
    Integer: "fmi2GetInteger" get_integer GetInteger, "fmi2SetInteger" set_integer SetInteger;
    Boolean: "fmi2GetBoolean" get_boolean GetBoolean, "fmi2SetBoolean" set_boolean SetBoolean;
}

/// `fmi2GetString`
///
/// The texts live until the next call of this for the instance.
///
/// # Safety
/// `component` is NULL or an instance; the arrays have `count` elements.
pub unsafe fn get_string<M: Model>(
    component: Component,
    references: *const ValueReference,
    count: usize,
    values: *mut Text,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let (references, values) =
            unsafe { (array("vr", references, count)?, array_mut("value", values, count)?) };
        for (slot, text) in values.iter_mut().zip(instance.get_string(references)?) {
            slot.write(text.as_ptr());
        }
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::GetString, body) }
}

/// `fmi2SetString`
///
/// One value that is refused leaves all as they were.
///
/// # Safety
/// `component` is NULL or an instance; the arrays have `count` elements, the texts end with a NUL.
pub unsafe fn set_string<M: Model>(
    component: Component,
    references: *const ValueReference,
    count: usize,
    values: *const Text,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let (references, values) =
            unsafe { (array("vr", references, count)?, array("value", values, count)?) };
        let texts = values.iter().map(|&value| {
            // SAFETY: as the caller promises.
            unsafe { text("value", value) }?.ok_or_else(|| Failure::from("a value is NULL"))
        });
        instance.set_string(references, &texts.collect::<Result<Vec<_>, _>>()?)
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SetString, body) }
}

/// `fmi2GetDirectionalDerivative`
///
/// # Safety
/// `component` is NULL or an instance; the arrays have as many elements as stated.
pub unsafe fn get_directional_derivative<M: Model>(
    component: Component,
    unknowns: *const ValueReference,
    unknown_count: usize,
    knowns: *const ValueReference,
    known_count: usize,
    seeds: *const Real,
    values: *mut Real,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let (unknowns, values) = unsafe {
            (array("vUnknown_ref", unknowns, unknown_count)?, array_mut("dvUnknown", values, unknown_count)?)
        };
        // SAFETY: as the caller promises.
        let (knowns, seeds) =
            unsafe { (array("vKnown_ref", knowns, known_count)?, array("dvKnown", seeds, known_count)?) };
        instance.directional_derivative(unknowns, knowns, seeds, values)
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::GetDirectionalDerivative, body) }
}
