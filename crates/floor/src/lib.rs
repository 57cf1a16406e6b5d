//! A floor: one degree of freedom relative to its base, with walls that push it.
//!
//! ```text
//! M ẍ + c ẋ + R(x) = −M a_g − Σ rᵢ
//! ```
//!
//! M is the mass without the walls', c the viscous damping, R a linear spring or a bilinear one with
//! kinematic hardening, `a_g` the base's acceleration and rᵢ the force of the floor on wall i (the floor
//! feels the opposite). The base is the ground or another floor.
//!
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
//!
//! ```
//! use fmu_export::{Log, Model, Step};
//! use rocking_floor::unit::Unit;
//! use rocking_floor::variables::RealVariable as V;
//!
//! let mut floor = Unit::new()?;
//! floor.set_real(V::DisplacementStart, 0.01);
//! floor.initialize(&mut Log::silent())?;
//! floor.do_step(Step { from: 0.0, duration: 0.05, may_end_early: false }, &mut Log::silent())?;
//! assert!(floor.real(V::Displacement) < 0.01, "it swings back");
//! # Ok::<(), fmu_export::Failure>(())
//! ```

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
