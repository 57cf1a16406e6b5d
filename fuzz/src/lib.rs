//! Instances of the project's units behind their C functions, as importers have them.

#![allow(unsafe_code, reason = "importers are C")]

mod arguments;
mod arguments3;
pub mod driver;
pub mod importer;
pub mod random;
