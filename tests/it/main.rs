//! The tests of the library.

mod cases;
mod ground_motion;
