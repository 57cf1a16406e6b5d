#![doc = include_str!("../README.md")]
//!
//! # Map
//! ```text
//! modelDescription.xml ─ build.rs ─► variables ─► Unit   (FMI calls)
//!                                                  │
//! Parameters ─► Floor ──────────► advance(Load) ◄──┘
//!                                    │
//!                                  Piece   (closed form on one branch)
//! ```
//!
//! Between yielding and unloading the equation is linear, and loads are linear over a step: each piece is
//! solved in closed form, and the corners between pieces are located to rounding. The communication step adds
//! no error of its own.

pub mod choices;
mod event;
mod exchange;
pub mod floor;
mod inputs;
pub mod motion;
mod piece;
pub mod unit;
mod values;
pub mod variables;

#[cfg(feature = "fmu")]
fmu_export::export_fmu!(unit::Unit, co_simulation + model_exchange);

#[cfg(feature = "component")]
fmu_export::export_component!(unit::Unit);
