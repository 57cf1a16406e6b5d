//! A wall in time: the state, the supports' motion, the outputs.

mod events;
mod excitation;
mod outputs;
mod stepping;

pub use events::Handled;
pub use excitation::{Excitation, segment_of};
pub use outputs::Outputs;
pub use stepping::{Progress, RunError, Simulation, Step};
