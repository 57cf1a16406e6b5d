//! The wall: parameters in, a validated equation of motion out.
//!
//! ```text
//! m_eff ü + C(u) u̇ + F(u) = −λ m_eff a_eff                                              Eq. (12)
//! ```
//!
//! A [`Wall`] that exists is valid and never changes. It is a short sorted list of [`Branch`]es, straight
//! pieces of the restoring force per unit effective mass, and of the [`Corner`]s between them. A solver sees
//! only the branch it is on.

mod bar;
mod branch;
mod capacity;
mod damping;
mod equation;
pub mod equivalence;
mod error;
mod facts;
mod force_law;
mod layout;
mod mechanism;
mod parameters;
mod ratio;
pub mod restitution;
mod supports;
mod tie;
mod trigonometric;
mod usage;
mod usual;
mod warning;

pub use bar::{Bar, BarNumber, BarTie, TiePart};
pub use branch::{Branch, Corner};
pub use capacity::{CapacityPoint, Statics};
pub(crate) use damping::DampingSeries;
pub use damping::{BranchDamping, Damping};
pub use equation::Wall;
pub use error::ParameterError;
pub use facts::Fact;
pub use force_law::Line;
pub use mechanism::{Body, Sides};
pub use parameters::{COMPUTED, Kinematics, Parameters, is_computable};
pub use ratio::Ratio;
pub use supports::{Ends, Support};
pub use tie::{Hold, Tie, TieAction, TieMemory};
pub use trigonometric::FullRotations;
pub use usage::{Usage, usage};
pub use usual::Usual;
pub use warning::Warning;
