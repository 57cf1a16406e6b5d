//! `cargo xtask portable`: builds the FMUs of every platform and the playground as they are published, and
//! tests them as far as this machine can.

use std::path::Path;

use crate::command::{Result, cargo, find, root, succeed, target};
use crate::fmu;
use crate::platform::Platform;
use crate::playground;
use crate::python::Environment;
use crate::test::{pytest, records, with_libclang};

/// Builds the FMUs for all platforms and the playground into `fmu_out/` and tests them: the Linux library in
/// FMPy, the WebAssembly component in wasmtime, the Windows library and `wall.exe` under wine; the macOS
/// library is only inspected. The importer `fmi` drives the Linux library from Rust.
pub(crate) fn run() -> Result<()> {
    fmu::build_all(Some(fmu::PORTABLE))?;
    succeed(cargo().args(["build", "--locked", "--bin", "wall"]), "see the compiler's message above")?;
    let [windows] = Platform::named("win64")?[..] else { unreachable!("one row of the table") };
    let mut program = windows.cargo("build")?;
    program.args(["--locked", "--bin", "wall"]).env("CARGO_TARGET_DIR", target().join("fmu"));
    succeed(&mut program, "see the compiler's message above")?;
    let programs = target().join("fmu").join(windows.target).join("debug");
    compile("windows_driver.c", &programs.join("driver.exe"), &[])?;
    compile("windows_random.c", &programs.join("bcryptprimitives.dll"), &["-shared", "-ladvapi32"])?;
    let python = Environment::of("tests")?;
    let mut pytest = pytest(&python, "tests/python", None);
    let built = [
        ("ROCKING_WALL_FMU", root().join("fmu_out/wall.fmu")),
        ("ROCKING_FLOOR_FMU", root().join("fmu_out/floor.fmu")),
        ("ROCKING_WALL_BIN", target().join("debug/wall")),
    ];
    pytest.envs(built.clone());
    for (name, path) in [
        ("ROCKING_WALL_EXE", programs.join("wall.exe")),
        ("ROCKING_WALL_DRIVER", programs.join("driver.exe")),
        ("ROCKING_WALL_RECORDS", records()),
        ("WINEPREFIX", target().join("wine")),
    ] {
        pytest.env(name, path);
    }
    pytest.env("WINEDEBUG", "-all");
    match playground::check_target() {
        Ok(()) => {
            pytest.env("ROCKING_WALL_PLAYGROUND", playground::build()?);
        }
        Err(message) => println!("not run: the playground: {message}"),
    }
    succeed(&mut pytest, "see the failures above")?;
    let mut importer = cargo();
    importer.args(["test", "--locked", "--manifest-path", "tests/importer/Cargo.toml"]);
    importer.env("CARGO_TARGET_DIR", target().join("importer")).envs(built);
    succeed(with_libclang(&mut importer)?, "see the failures above")?;
    if find("wine").is_none() {
        println!("not run: the Windows library and wall.exe: `apt-get install wine wine64`");
    }
    println!("not run: the macOS library, which is built and inspected only");
    Ok(())
}

/// Compiles a file of `tests/python` for Windows.
fn compile(source: &str, output: &Path, arguments: &[&str]) -> Result<()> {
    let mut compiler = Environment::of("zig")?.program("python-zig");
    compiler.args(["cc", "-target", "x86_64-windows-gnu", "-O2", "-Wall", "-Wextra", "-Werror", "-s"]);
    compiler.arg("-o").arg(output).arg(Path::new("tests/python").join(source)).args(arguments);
    succeed(&mut compiler, "see the compiler's message above")
}
