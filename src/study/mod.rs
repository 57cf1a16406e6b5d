//! Studies: many runs of walls under many motions, and what they say together.
//!
//! Nothing here opens a file or prints.

pub mod document;
pub mod fragility;
pub mod ida;
pub mod parallel;
mod random;
pub mod spectrum;
