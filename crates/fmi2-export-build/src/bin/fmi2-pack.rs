//! Packs an FMU.
fn main() {}
