#![doc = include_str!("../README.md")]
//!
//! # Modules
//! Nothing here prints. Only [`validation`] opens files. Each module uses only modules above it in this
//! table; all but [`validation`] have their page beside them:
//!
//! | module | holds |
//! |---|---|
//! | [`accuracy`] | error against run time of every solver; error of small rotations |
//! | [`stability`] | stability maps and extremes |
//! | [`reproduce`] | the tables and figures of the paper |
//! | [`validation`] | the model beside published tests |
//! | [`verification`] | every formula against a reference of its own |

pub mod accuracy;
pub mod reproduce;
pub mod stability;
pub mod validation;
pub mod verification;
