//! The C boundary: generic functions that [`export_fmu!`](crate::export_fmu) gives their C names.
//!
//! The only unsafe code of the layer. What is unsafe is to believe C: that an instance is one, that an array
//! has as many elements as stated, that a text ends. NULL and misaligned pointers are refused.

#![allow(unsafe_code)]

mod arguments;
pub mod co_simulation;
pub mod common;
mod export;
mod guard;
mod kinds;
pub mod model_exchange;
pub mod states;
pub mod types;

pub use guard::install_panic_hook;
pub use kinds::Kinds;

use crate::call::Call;
use crate::instance::Instance;
use crate::model::{Failure, Model};
use types::{Component, ERROR, Status};

/// Lets the instance `component` do `body`, if it is the turn of `call`.
///
/// # Safety
/// `component` is NULL or what `instantiate` of the same model returned and `free_instance` has not taken,
/// and no other thread uses it.
unsafe fn with<M: Model>(
    component: Component,
    call: Call,
    body: impl FnOnce(&mut Instance<M>) -> Result<(), Failure>,
) -> Status {
    // SAFETY: as the caller promises.
    let Some(instance) = (unsafe { component.cast::<Instance<M>>().as_mut() }) else {
        return ERROR;
    };
    let status = match guard::catch(|| instance.call(call, body)) {
        Ok(status) => status,
        Err(panic) => instance.panicked(call, &panic),
    };
    types::status(status)
}
