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
//! Each module uses only modules above it in this table, or before it in its row:
//!
//! | module | holds |
//! |---|---|
//! | [`equivalence`], [`restitution`] | damping that restitution is worth; formulas of restitution |
//! | `section`, `part`, `profile` | a wall of parts, with openings and loads |
//! | `warning`, `error` | what a user is told |
//! | `sides`, `ratio` | quantities of both sides; the ratios of damping |
//! | `given`, `usual` | numbers that are given or computed; numbers that walls usually have |
//! | `bar`, `tie_numbers`, `parameters`, `usage` | what is given, and which of it has an effect |
//! | `points` | masses and loads of parts as points |
//! | `strip` | how the two bodies of a strip of parts move |
//! | `mechanism`, `assembled`, `level` | bodies, of rectangles and of parts; those above a level |
//! | `force_law`, `damping`, `turn`, `trigonometric` | what is made of it |
//! | `tie`, `ties` | a tie, and those of a wall |
//! | `impact`, `statics`, `warnings` | impacts; the wall at rest; what is doubtful |
//! | `branch`, `equation`, `layout`, `tied` | the wall, its branches, and ties on them |
//! | `supports`, `capacity`, `facts` | supports that move; the capacity curve; the numbers of a wall |

mod assembled;
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
mod impact;
mod layout;
mod level;
mod mechanism;
mod parameters;
mod part;
mod points;
mod profile;
mod ratio;
pub mod restitution;
mod section;
mod sides;
mod statics;
mod strip;
mod supports;
mod tie;
mod tie_numbers;
mod tied;
mod ties;
mod trigonometric;
mod turn;
mod usage;
mod usual;
mod warning;
mod warnings;

pub use bar::{Bar, BarNumber, BarTie, TiePart};
pub use branch::{Branch, Corner, Couple};
pub use capacity::CapacityPoint;
pub(crate) use damping::DampingSeries;
pub use damping::{BranchDamping, Damping};
pub use equation::Wall;
pub(crate) use error::Choice;
pub use error::ParameterError;
pub use facts::Fact;
pub use force_law::{Line, check_points};
pub use given::{COMPUTED, is_computable};
pub use mechanism::{Body, Contact, MassShares};
pub use parameters::{Kinematics, Parameters};
pub use part::{Hollow, Item, Load, Opening, Part, ProfileError};
pub use points::Centroid;
pub use profile::{MOST_ITEMS, OF_RECTANGLE, Profile};
pub use ratio::Ratio;
pub use section::Section;
pub use sides::Sides;
pub use statics::Statics;
pub use strip::Strip;
pub use supports::{Ends, Support};
pub use tie::{Hold, Tie, TieAction, TieMemory};
pub use tie_numbers::TieNumbers;
pub use ties::Ties;
pub use trigonometric::FullRotations;
pub(crate) use turn::Turn;
pub use usage::{Usage, usage};
pub use usual::Usual;
pub use warning::Warning;
pub use warning::six_digits;
