//! Studies: many runs of walls under many motions, and what they say together.
//!
//! Nothing here opens a file or prints.

pub mod accuracy;
pub mod calibration;
pub mod chart;
pub mod document;
pub mod fragility;
mod free_motion;
pub mod ida;
pub mod parallel;
mod random;
pub mod reproduce;
pub mod spectrum;
pub mod stability;
