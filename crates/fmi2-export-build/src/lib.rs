//! Turns a modelDescription.xml into Rust variables, and files into an FMU.
