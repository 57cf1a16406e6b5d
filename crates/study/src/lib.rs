#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`loaded`], `wall_table` and [`validation`] open files. Each module uses only
//! modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | [`parallel`] | work shared by threads |
//! | [`chart`] | charts as plain data |
//! | `random` | random numbers that are the same on every machine |
//! | `halving` | where something begins, found by halving |
//! | `free_motion` | free motion of a wall, with impacts or with viscous damping |
//! | [`model`] | damping models: names, meanings and colours; walls that have them |
//! | [`ida`] | incremental dynamic analysis: walls × records × damping models |
//! | [`fragility`] | fragilities of their limit states, with bootstrap intervals |
//! | [`document`] | study files |
//! | `wall_table` | tables of walls |
//! | [`loaded`] | studies read from files, with their scenes and records |
//! | [`results`] | the curves and the fragilities of each wall of a study |
//! | [`tables`] | the rows of a study's tables, for CSV and Python |
//! | [`spectrum`] | rocking spectra over walls or over pulses |
//! | [`calibration`] | viscous damping that is equivalent to restitution |
//! | [`polarity`] | motions with both signs |
//! | [`tie`] | force and displacement over the stiffness of a tie |
//! | [`check`] | static capacity against a response spectrum |
//! | [`circolare`] | the check of a wall by the Italian code, Circolare 7/2019 |
//! | [`accuracy`] | error against run time of every solver; error of small rotations |
//! | [`stability`] | stability maps and extremes |
//! | [`reproduce`] | the tables and figures of the paper |
//! | [`validation`] | the model beside published tests |
//! | [`verification`] | every formula against a reference of its own |

pub mod accuracy;
#[cfg(not(target_arch = "wasm32"))]
pub mod calibration;
pub mod chart;
pub mod check;
pub mod circolare;
pub mod document;
pub mod fragility;
mod free_motion;
mod halving;
pub mod ida;
pub mod loaded;
pub mod model;
pub mod parallel;
pub mod polarity;
mod random;
#[cfg(not(target_arch = "wasm32"))]
pub mod reproduce;
pub mod results;
pub mod spectrum;
pub mod stability;
pub mod tables;
pub mod tie;
pub mod validation;
#[cfg(not(target_arch = "wasm32"))]
pub mod verification;
mod wall_table;

/// Fingerprint of the sources that runs depend on: the solver, ground motions, levels and the versions of
/// other crates. Builds with equal fingerprints compute the same runs, on every machine.
pub const SOURCES: &str = env!("SOURCES");

/// Returns a count with its noun.
///
/// ```
/// assert_eq!([1, 2].map(|count| study::counted(count, "record")), ["1 record", "2 records"]);
/// ```
pub fn counted(count: impl std::fmt::Display, noun: &str) -> String {
    let text = format!("{count} {noun}");
    if text.starts_with("1 ") { text } else { text + "s" }
}
