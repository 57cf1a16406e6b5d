//! The C boundary: generic functions that [`export_fmu!`](crate::export_fmu) gives their C names.
//!
//! The only unsafe code of the layer. It relies on C for what it cannot check: that a component is an
//! instance, that an array has as many elements as stated, that a text ends with a NUL. NULL and misaligned
//! pointers are refused.
//!
//! ```
//! use fmu_export::ffi::types::{EventInfo, OK, Status};
//!
//! // the layouts are those of fmi2FunctionTypes.h
//! assert_eq!((size_of::<Status>(), size_of::<EventInfo>(), OK), (4, 32, 0));
//! ```

#![allow(unsafe_code)]

mod arguments;
pub mod co_simulation;
pub mod common;
#[cfg(feature = "component")]
pub mod component;
mod export;
mod export3;
pub mod fmi3;
mod guard;
mod kinds;
pub mod model_exchange;
pub mod states;
pub mod types;

pub use kinds::Kinds;
