//! FMI 3.0: the functions that differ from those of FMI 2.0.
//!
//! ```
//! use fmu_export::ffi::fmi3::types::{Boolean, LogMessageCallback};
//!
//! // the layouts are those of fmi3PlatformTypes.h and fmi3FunctionTypes.h
//! assert_eq!((size_of::<Boolean>(), size_of::<LogMessageCallback>()), (1, size_of::<usize>()));
//! ```

use crate::call::Call;
use crate::ffi::guard;
use crate::ffi::types::{Component, ERROR, Status};
use crate::model::Model;

mod instantiation;
mod steps;
pub mod types;
mod values;

pub use instantiation::{
    get_version, instantiate_co_simulation, instantiate_model_exchange, instantiate_scheduled_execution,
};
pub use steps::*;
#[cfg(feature = "component")]
pub(super) use values::check_count;
pub use values::*;

/// Refuses a function for what no FMU of this layer has, such as `fmi3GetClock`: its call is never allowed,
/// whatever its other arguments.
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn refuse<M: Model>(component: Component, function: &str) -> Status {
    // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
    let instance = unsafe { guard::instance::<M>(component) };
    let call = Call::of_fmi3(function);
    call.map_or(ERROR, |call| guard::run(instance, call, |_| Ok(())))
}
