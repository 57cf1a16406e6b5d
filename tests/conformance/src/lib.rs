//! Compares the C interface of the FMU with independent sources; see the tests.
//!
//! This crate is not a default member of the workspace: fmi-sys makes its bindings from the standard's
//! headers with libclang, which `cargo xtask test` provides.
