//! The tests of the library.

mod cases;
mod closed_forms;
mod description;
mod ground_motion;
mod properties;
