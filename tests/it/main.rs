//! The tests of the library.

mod cases;
mod closed_forms;
mod ground_motion;
mod properties;
