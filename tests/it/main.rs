//! The tests of the library.

mod cases;
