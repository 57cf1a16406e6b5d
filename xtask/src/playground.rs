//! `cargo xtask playground`: compiles the library to WebAssembly and packs it into a page of one file.

use std::path::{Path, PathBuf};

use crate::command::{Result, at, cargo, program, root, succeed, target};
use crate::platform::{check_rust_libraries, reproducible};

const TARGET: &str = "wasm32-unknown-unknown";
const PAGE: &str = "fmu_out/playground.html";
/// Largest page in bytes: it is to load at once, also from a mail.
const LARGEST: u64 = 1_300_000;

/// Checks that this machine can compile to WebAssembly.
pub(crate) fn check_target() -> Result<()> {
    check_rust_libraries([TARGET], "")
}

/// Builds the page that is published, and returns its path.
pub(crate) fn build() -> Result<PathBuf> {
    let page = root().join(PAGE);
    pack("playground", &page)?;
    let size = std::fs::metadata(&page).map_err(at(PAGE.as_ref()))?.len();
    if size > LARGEST {
        return Err(format!("{PAGE} has {size} bytes, more than {LARGEST}"));
    }
    println!("{PAGE}: {size} bytes");
    Ok(page)
}

/// Builds the page with a profile, and packs it into a file.
pub(crate) fn pack(profile: &str, page: &Path) -> Result<()> {
    check_target()?;
    let mut build = cargo();
    build.args(["rustc", "--quiet", "--locked", "--package", "rocking-playground", "--lib"]);
    build.args(["--crate-type", "cdylib", "--profile", profile, "--target", TARGET]);
    // two numbers at once: every browser that unpacks the page knows how
    reproducible(&mut build, &["-Ctarget-feature=+simd128"]);
    succeed(&mut build, "see its message above")?;
    let library = target().join(TARGET).join(profile).join("playground.wasm");
    let mut pack = program("python3");
    succeed(pack.arg("xtask/playground/pack.py").args([&library, page]), "see its message above")
}
