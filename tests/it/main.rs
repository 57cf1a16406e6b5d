//! The tests of the library.

mod cases;
mod description;
mod ground_motion;
