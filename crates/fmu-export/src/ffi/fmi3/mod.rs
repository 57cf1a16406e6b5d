//! FMI 3.0: the functions that differ from those of FMI 2.0.
//!
//! ```
//! use fmu_export::ffi::fmi3::types::{Boolean, LogMessageCallback};
//!
//! // the layouts are those of fmi3PlatformTypes.h and fmi3FunctionTypes.h
//! assert_eq!((size_of::<Boolean>(), size_of::<LogMessageCallback>()), (1, size_of::<usize>()));
//! ```

mod instantiation;
mod steps;
pub mod types;
mod unsupported;
mod values;

pub use instantiation::{
    get_version, instantiate_co_simulation, instantiate_model_exchange, instantiate_scheduled_execution,
};
pub use steps::*;
pub use unsupported::*;
#[cfg(feature = "component")]
pub(super) use values::check_count;
pub use values::*;
