#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`validation`] opens files. Each module uses only modules above it in this
//! table, and has what shows its results beside it:
//!
//! | module | holds |
//! |---|---|
//! | [`Comparison`] | the row of every table: what, computed, given, allowed |
//! | [`reproduce`] | the tables and figures of the paper; error of small rotations |
//! | [`accuracy`] | error against run time of every solver |
//! | [`stability`] | stability maps and extremes |
//! | [`validation`] | the model beside published tests |
//! | [`verification`] | every formula against a reference of its own |

pub mod accuracy;
mod comparison;
mod error;
pub mod reproduce;
pub mod stability;
pub mod validation;
pub mod verification;

pub use comparison::Comparison;
pub use error::EvidenceError;
