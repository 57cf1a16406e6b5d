//! `cargo xtask package`: the crates as a registry gets them.

use std::time::Instant;

use crate::command::{Result, cargo, succeed, target};

/// Packages that are not published: `publish = false` in their manifests, which a test compares.
const KEPT: [&str; 5] =
    ["bouncing-ball", "conformance", "rocking-playground", "rocking-wall-python", "xtask"];

/// Packs every crate that is published into `target/package/`, in the order of their dependencies, and builds
/// each from its archive alone against the archives before it.
pub(crate) fn run() -> Result<()> {
    let start = Instant::now();
    let mut package = cargo();
    package.args(["package", "--workspace", "--locked"]);
    package.args(KEPT.iter().flat_map(|name| ["--exclude", *name]));
    // the profile of the workspace and its target folder: the crates of others are those of the tests
    package.env("CARGO_PROFILE_DEV_DEBUG", "false").env("CARGO_TARGET_DIR", target());
    succeed(&mut package, "cargo 1.90 or newer packs a workspace; else see its message above")?;
    println!("{}: {} s", target().join("package").display(), start.elapsed().as_secs());
    Ok(())
}
