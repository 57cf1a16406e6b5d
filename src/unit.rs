//! The wall as an FMI model.

mod exchange;
mod inputs;
mod instance;
mod model;
mod model_exchange;
mod state;

pub use instance::Unit;
