//! Rocking of masonry walls.

pub mod ground_motion;
