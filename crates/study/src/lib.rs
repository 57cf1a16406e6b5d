#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`loaded`] and `wall_table` open files. Each module uses only modules above
//! it in this table:
//!
//! | module | holds |
//! |---|---|
//! | [`parallel`] | work shared by threads |
//! | [`chart`] | charts as plain data |
//! | `random` | random numbers that are the same on every machine |
//! | [`halving`] | where something begins, found by halving |
//! | [`free_motion`] | free motion of a wall, with impacts or with viscous damping |
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

#[cfg(not(target_arch = "wasm32"))]
pub mod calibration;
pub mod chart;
pub mod check;
pub mod circolare;
pub mod document;
pub mod fragility;
pub mod free_motion;
pub mod halving;
pub mod ida;
pub mod loaded;
pub mod model;
pub mod parallel;
pub mod polarity;
mod random;
pub mod results;
pub mod spectrum;
pub mod tables;
pub mod tie;
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
