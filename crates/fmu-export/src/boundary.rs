//! What a boundary other than that of C needs, such as the one of `fmu-component`: an instance, its calls,
//! and the log.
//!
//! ```
//! use fmu_export::boundary::check_count;
//!
//! assert!(check_count("nValues", 2, 2).is_ok() && check_count("nValues", 1, 2).is_err());
//! ```

pub use crate::access::none_served;
pub use crate::call::{Call, Phase, Version};
pub use crate::ffi::arguments::check_count;
pub use crate::instance::{Instance, Purpose};
pub use crate::log::Logger;
