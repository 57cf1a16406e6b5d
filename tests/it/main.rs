//! The tests.

mod ground_motion;
