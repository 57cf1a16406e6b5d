//! `cargo xtask fmu`: builds the library, then the archive.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, cargo, program, root, succeed, target};
use crate::python::Environment;

/// The linker of the library.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Linker {
    /// The machine's own linker and C library.
    System,
    /// Zig with the symbols of glibc 2.17.
    Zig,
}

/// The oldest C library a portable FMU runs on.
const PORTABLE_TARGET: &str = "x86_64-unknown-linux-gnu.2.17";

/// An FMU of this workspace.
#[derive(Clone, Copy)]
pub(crate) struct Unit {
    /// The package whose library it holds.
    package: &'static str,
    /// Its file under `fmu_out/`.
    file: &'static str,
    /// The folder of its `modelDescription.xml` and `documentation/`.
    description: &'static str,
}

/// The rocking wall.
pub(crate) const WALL: Unit =
    Unit { package: "rocking-wall", file: "wall.fmu", description: "modelDescription" };

/// The floor for coupling with walls.
pub(crate) const FLOOR: Unit =
    Unit { package: "rocking-floor", file: "floor.fmu", description: "crates/floor/modelDescription" };

/// All FMUs.
pub(crate) const UNITS: [Unit; 2] = [WALL, FLOOR];

/// Builds an FMU into `fmu_out/` and returns its path.
///
/// # Errors
/// If the library does not build or the archive cannot be written.
pub(crate) fn build(unit: Unit, linker: Linker) -> Result<PathBuf> {
    let library = library(unit, linker)?;
    let built = programs("dev", &["fmu-export-build"])?;
    pack(unit, &library, &built)
}

/// Builds every FMU and prints its path.
///
/// # Errors
/// As [`build`].
pub(crate) fn build_all(linker: Linker) -> Result<()> {
    for unit in UNITS {
        println!("{}", build(unit, linker)?.display());
    }
    Ok(())
}

/// Builds the programs of some packages with a profile and returns their folder.
///
/// # Errors
/// If they do not build.
pub(crate) fn programs(profile: &str, packages: &[&str]) -> Result<PathBuf> {
    let mut build = cargo();
    build.args(["build", "--locked", "--bins", "--features", "fmu-export-build/archive"]);
    build.args(["--profile", profile]);
    build.args(packages.iter().flat_map(|package| ["--package", *package]));
    succeed(&mut build, "see the compiler's message above")?;
    Ok(target().join(if profile == "dev" { "debug" } else { profile }))
}

/// Builds the library, without the command line's crates, and returns its path.
///
/// # Errors
/// If it does not build.
pub(crate) fn library(unit: Unit, linker: Linker) -> Result<PathBuf> {
    let folder = target().join("fmu");
    let mut build = cargo();
    match linker {
        Linker::System => {
            build.arg("rustc");
        }
        Linker::Zig => {
            let zig = Environment::of("zig", "xtask/locks/zig.lock")?;
            build = zig.program("cargo-zigbuild");
            build.arg("rustc").args(["--target", PORTABLE_TARGET]);
            let mut path = zig.programs().into_os_string();
            if let Some(rest) = std::env::var_os("PATH") {
                path.push(":");
                path.push(rest);
            }
            build.env("PATH", path);
        }
    }
    build.args(["--release", "--locked", "--package", unit.package, "--lib", "--crate-type", "cdylib"]);
    build.args(["--features", "fmu"]);
    build.env("CARGO_TARGET_DIR", &folder);
    reproducible(&mut build);
    succeed(&mut build, "see the compiler's message above")?;
    let mut built = folder;
    if linker == Linker::Zig {
        built.push(PORTABLE_TARGET.trim_end_matches(".2.17"));
    }
    built.push("release");
    built.push(library_name(unit));
    Ok(built)
}

/// Makes the library's bytes independent of the build folders.
fn reproducible(build: &mut Command) {
    let cargo_home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| std::env::var_os("HOME").map(|home| Path::new(&home).join(".cargo")));
    let mut flags = vec![
        "-Cstrip=symbols".to_owned(),
        format!("--remap-path-prefix={}=/target", target().join("fmu").display()),
        format!("--remap-path-prefix={}=/rocking-wall", root().display()),
    ];
    if let Some(cargo_home) = cargo_home {
        flags.push(format!("--remap-path-prefix={}=/cargo", cargo_home.display()));
    }
    build.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"));
}

/// Zips the FMU with `fmu-pack` of a folder of programs, and returns its path.
///
/// # Errors
/// If the archive cannot be written.
pub(crate) fn pack(unit: Unit, library: &Path, programs: &Path) -> Result<PathBuf> {
    let output = root().join("fmu_out").join(unit.file);
    let mut pack = program(programs.join("fmu-pack"));
    let description = Path::new(unit.description);
    pack.arg("--description").arg(description.join("modelDescription.xml"));
    pack.arg("--documentation").arg(description.join("documentation"));
    pack.arg("--binary").arg(library).args(["--platform", platform()]);
    pack.arg("--output").arg(&output);
    succeed(&mut pack, "see its message above")?;
    Ok(output)
}

/// Returns FMI's name for this machine.
fn platform() -> &'static str {
    if cfg!(target_os = "windows") {
        "win64"
    } else if cfg!(target_os = "macos") {
        "darwin64"
    } else {
        "linux64"
    }
}

fn library_name(unit: Unit) -> String {
    let name = unit.package.replace('-', "_");
    format!("{}{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX)
}
