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

pub(crate) mod arguments;
pub mod co_simulation;
pub mod common;
mod export;
mod export3;
pub mod fmi3;
mod guard;
pub mod model_exchange;
pub mod states;
pub mod types;
pub mod values;

use self::types::{CO_SIMULATION, MODEL_EXCHANGE, Type};
use crate::call::Version;
use crate::failure::Failure;
use crate::instance::Purpose;
use crate::model::{Interface, Model, ModelExchange};

/// The kinds of instances that a library exports the functions for.
#[derive(Debug)]
pub struct Kinds<M: Model> {
    co_simulation: bool,
    /// The continuous states, for Model Exchange.
    states: Option<&'static [M::Real]>,
}

impl<M: Model> Kinds<M> {
    /// Co-simulation alone.
    pub const CO_SIMULATION: Self = Self { co_simulation: true, states: None };

    /// Returns what an instance of `kind` is made for, in FMI 2.0.
    pub(super) fn purpose(&self, kind: Type) -> Result<Purpose<M>, Failure> {
        let (interface, states) = match (kind, self.states) {
            (CO_SIMULATION, _) if self.co_simulation => (Interface::CoSimulation, &[][..]),
            (MODEL_EXCHANGE, Some(states)) => (Interface::ModelExchange, states),
            _ => return Err(Failure(format!("fmuType {kind}: this FMU is for {} only", self.names()))),
        };
        let (event_mode, early_return) = (false, false);
        Ok(Purpose { version: Version::Fmi2, interface, states, event_mode, early_return })
    }

    fn names(&self) -> String {
        let exchange = self.states.map(|_| format!("Model Exchange, {MODEL_EXCHANGE},"));
        let steps = self.co_simulation.then(|| format!("co-simulation, {CO_SIMULATION},"));
        [exchange, steps].into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }
}

impl<M: ModelExchange> Kinds<M> {
    /// Model Exchange alone.
    pub const MODEL_EXCHANGE: Self = Self { co_simulation: false, states: Some(M::STATES) };
    /// Both kinds.
    pub const BOTH: Self = Self { co_simulation: true, states: Some(M::STATES) };
}
