//! FMI 3.0: the functions that differ from those of FMI 2.0.
//!
//! ```
//! use fmu_export::ffi::fmi3::types::{Boolean, LogMessageCallback};
//!
//! // the layouts are those of fmi3PlatformTypes.h and fmi3FunctionTypes.h
//! assert_eq!((size_of::<Boolean>(), size_of::<LogMessageCallback>()), (1, size_of::<usize>()));
//! ```

use crate::access;
use crate::call::Call;
use crate::ffi::arguments::array;
use crate::ffi::guard;
use crate::ffi::types::{Component, ERROR, Status, ValueReference};
use crate::model::Model;

mod instantiation;
mod steps;
pub mod types;

pub use instantiation::{
    get_version, instantiate_co_simulation, instantiate_model_exchange, instantiate_scheduled_execution,
};
pub use steps::*;

/// Refuses a function for what no FMU of this layer has: one that is never allowed, such as `fmi3GetClock`,
/// whatever its arguments; and a getter or setter of a type that no variable has, unless it is given no
/// references.
///
/// # Safety
/// `component` is NULL or an instance; `references` is NULL or points to `count` references.
pub unsafe fn refuse<M: Model>(
    component: Component,
    function: &str,
    references: *const ValueReference,
    count: usize,
) -> Status {
    let Some(call) = Call::of_fmi3(function) else { return ERROR };
    // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
    let instance = unsafe { guard::instance::<M>(component) };
    guard::run(instance, call, |_| {
        // SAFETY: `references` is NULL or points to `count` elements that stay as they are during the call.
        access::none_served::<M>(unsafe { array("valueReferences", references, count) }?)
    })
}
