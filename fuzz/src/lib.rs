//! Instances of the project's units behind their C functions, as importers have them.

#![allow(unsafe_code, reason = "importers are C")]

mod arguments;
pub mod driver;
pub mod importer;
pub mod random;
