//! `cargo xtask portable`: the FMUs of every platform, and what this machine can tell of them.

use std::path::PathBuf;

use crate::command::{Result, cargo, find, root, succeed, target};
use crate::fmu;
use crate::python::Environment;
use crate::test::{TESTS, records};

/// Builds the FMUs for all platforms into `fmu_out/` and tests them: the Linux library in FMPy, the Windows
/// library under wine; the macOS library is only inspected.
///
/// # Errors
/// If something does not build or a test fails.
pub(crate) fn run() -> Result<()> {
    fmu::build_all(Some(fmu::PORTABLE))?;
    succeed(cargo().args(["build", "--locked", "--bin", "wall"]), "see the compiler's message above")?;
    let driver = driver()?;
    let python = Environment::of(TESTS.0, TESTS.1)?;
    let mut pytest = python.program("python");
    pytest.args(["-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", "tests/python"]);
    for (name, path) in [
        ("ROCKING_WALL_FMU", root().join("fmu_out/wall.fmu")),
        ("ROCKING_FLOOR_FMU", root().join("fmu_out/floor.fmu")),
        ("ROCKING_WALL_BIN", target().join("debug/wall")),
        ("ROCKING_WALL_DRIVER", driver),
        ("ROCKING_WALL_RECORDS", records()),
        ("WINEPREFIX", target().join("wine")),
    ] {
        pytest.env(name, path);
    }
    pytest.env("WINEDEBUG", "-all");
    succeed(&mut pytest, "see the failures above")?;
    if find("wine").is_none() {
        println!("not run: the Windows library: `apt-get install wine wine64`");
    }
    println!("not run: the macOS library, which is built and inspected only");
    Ok(())
}

/// Builds the program that calls the Windows library.
fn driver() -> Result<PathBuf> {
    let driver = target().join("fmu/driver.exe");
    let zig = Environment::of("zig", "xtask/locks/zig.lock")?;
    let mut compiler = zig.program("python-zig");
    compiler.args(["cc", "-target", "x86_64-windows-gnu", "-O2", "-Wall", "-Wextra", "-Werror", "-s"]);
    compiler.arg("-o").arg(&driver).arg("tests/python/windows_driver.c");
    succeed(&mut compiler, "see the compiler's message above")?;
    Ok(driver)
}
