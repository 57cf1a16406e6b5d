//! The wall: parameters in, a validated equation of motion out.
//!
//! ```text
//! m_eff ü + C(u) u̇ + F(u) = −λ m_eff a_eff                                              Eq. (12)
//! ```
//!
//! A [`Wall`] that exists is valid and never changes. It is a short sorted list of [`Branch`]es, straight
//! pieces of the restoring force per unit effective mass, and of the [`Corner`]s between them. A solver sees
//! only the branch it is on.
//!
//! A file uses only those that stand before it here:
//!
//! ```text
//! equivalence   warning   error   sides   ratio   given          what can be said of numbers
//! usual   bar   parameters   usage                               what is given
//! mechanism   force_law   damping   trigonometric   tie          what is made of it
//! restitution   statics   warnings
//! branch   equation   layout   supports   capacity   facts       the wall
//! ```

mod bar;
mod branch;
mod capacity;
mod damping;
mod equation;
pub mod equivalence;
mod error;
mod facts;
mod force_law;
mod given;
mod layout;
mod mechanism;
mod parameters;
mod ratio;
pub mod restitution;
mod sides;
mod statics;
mod supports;
mod tie;
mod trigonometric;
mod usage;
mod usual;
mod warning;
mod warnings;

pub use bar::{Bar, BarNumber, BarTie, TiePart};
pub use branch::{Branch, Corner};
pub use capacity::CapacityPoint;
pub(crate) use damping::DampingSeries;
pub use damping::{BranchDamping, Damping};
pub use equation::Wall;
pub use error::ParameterError;
pub use facts::Fact;
pub use force_law::Line;
pub use given::{COMPUTED, is_computable};
pub use mechanism::Body;
pub use parameters::{Kinematics, Parameters};
pub use ratio::Ratio;
pub use sides::Sides;
pub use statics::Statics;
pub use supports::{Ends, Support};
pub use tie::{Hold, Tie, TieAction, TieMemory};
pub use trigonometric::FullRotations;
pub use usage::{Usage, usage};
pub use usual::Usual;
pub use warning::Warning;
