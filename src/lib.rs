//! Rocking of masonry walls.
