//! The jobs of the project: `cargo xtask fmu | demo | test`.

fn main() {}
