#![doc = include_str!("../README.md")]
//!
//! # Modules
//!
//! ```text
//! building.toml ─► Building ─► Parts ─┬─► Coupled   under a record, accelerations and reactions in one loop
//!                   scenes ───────────┤─► Trial     the step that other masters need
//!                                     └─► archive   SSP of FMUs
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`document`] | the file of a building |
//! | [`parts`] | its units and their connections, and the SSP |
//! | [`histories`] | floors and walls in time |
//! | [`coupled`] | the run under a record |
//! | [`table`] | its peaks and histories as tables and JSON |
//! | [`page`] | the page of a run |
//! | [`mod@trial`] | the step that a master needs for 1 % |

pub mod coupled;
pub mod document;
pub mod error;
pub mod histories;
pub mod page;
pub mod parts;
mod ssd;
pub mod table;
pub mod trial;
mod units;
mod wiring;

pub use coupled::{Coupled, Settings};
pub use document::Building;
pub use error::BuildingError;
pub use parts::Parts;
