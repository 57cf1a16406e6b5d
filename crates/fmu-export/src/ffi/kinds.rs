//! What instances an FMU can be asked for.

use super::types::{CO_SIMULATION, MODEL_EXCHANGE, Type};
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
