#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`document`], [`loaded`] and [`folder`] open files. Each module uses
//! only modules above it in this table:
//!
//! | module | holds |
//! |---|---|
//! | [`ida`] | incremental dynamic analysis: walls × records × damping models |
//! | [`uncertain`] | samples of uncertain parameters, and which of them explains θ |
//! | [`measures`] | which intensity measure to choose |
//! | [`codes`] | what a study asks of building codes |
//! | [`document`] | study files |
//! | [`loaded`] | studies read from files, with their scenes and records |
//! | [`results`] | the curves and the fragilities of each wall of a study |
//! | [`folder`] | a study in a folder: runs in parts, tables and a page |
//! | [`spectrum`] | rocking spectra over walls or over pulses |
//! | [`calibration`] | viscous damping that is equivalent to restitution |
//! | [`tie`] | force and displacement over the stiffness of a tie |

#[cfg(not(target_arch = "wasm32"))]
pub mod calibration;
pub mod codes;
pub mod document;
#[cfg(not(target_arch = "wasm32"))]
pub mod folder;
pub mod ida;
pub mod loaded;
pub mod measures;
pub mod results;
pub mod spectrum;
pub mod tie;
pub mod uncertain;

/// Fingerprint of the sources that runs depend on: the solver, ground motions, levels and the versions of
/// other crates. Builds with equal fingerprints compute the same runs, on every machine.
pub const SOURCES: &str = env!("SOURCES");
