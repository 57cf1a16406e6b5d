//! The C boundary of the FMU against independent authorities; see the tests.
//!
//! This crate is no default member of the workspace: fmi-sys makes its bindings from the standard's headers and needs
//! libclang for that, which `cargo xtask test` provides.
