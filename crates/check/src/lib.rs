#![doc = include_str!("../README.md")]
//!
//! | module | holds |
//! |---|---|
//! | [`code`] | what every code has, and the list of codes |
//! | [`circolare`] | the code `circolare-2019` |
//! | [`fractions`] | the code `fractions` |
//! | [`mod@find`] | the smallest thickness or tie, or the largest height, with which a wall passes |
//! | [`walls`] | many walls |
//! | `site` | motions of floors, and spectra given by points |

pub mod circolare;
pub mod code;
mod error;
pub mod find;
pub mod fractions;
mod site;
pub mod walls;

pub use error::CheckError;
