//! `cargo xtask fmu`: builds the library, then the archive.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, cargo, make_folder, program, root, succeed, target};
use crate::platform::{self, Platform, check_rust_libraries, reproducible};

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
    Unit { package: "rocking-wall-fmu", file: "wall.fmu", description: "modelDescription" };

/// The floor for coupling with walls.
pub(crate) const FLOOR: Unit =
    Unit { package: "rocking-floor-fmu", file: "floor.fmu", description: "crates/floor/modelDescription" };

/// The example of the export layer.
pub(crate) const BALL: Unit =
    Unit { package: "bouncing-ball", file: "ball.fmu", description: "examples/fmu" };

/// All FMUs of the project.
const UNITS: [Unit; 2] = [WALL, FLOOR];

/// The target of WebAssembly components, and their platform in FMI 3.0.
const COMPONENT: &str = "wasm32-wasip2";

/// The beginning and ending of this machine's libraries.
pub(crate) const SYSTEM: [&str; 2] = [std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX];

/// The platforms of portable FMUs and of releases.
pub(crate) const PORTABLE: &str = "linux64,aarch64-linux,win64,darwin64";

/// Where users find the FMUs.
pub(crate) fn out() -> PathBuf {
    root().join("fmu_out")
}

/// Builds an FMU for this machine into `fmu_out/` and returns its path.
pub(crate) fn build(unit: Unit) -> Result<PathBuf> {
    let (library, component) = (library(unit, None)?, component(unit)?);
    pack(unit, &[library], component.as_slice(), &packer()?, &out())
}

/// Builds `fmu-pack`, and returns its folder.
fn packer() -> Result<PathBuf> {
    programs("dev", &["--package", "fmu-export-build", "--bin", "fmu-pack", "--features", "archive"])
}

/// Builds every FMU, for this machine or for named platforms, prints their paths and returns them.
pub(crate) fn build_all(names: Option<&str>) -> Result<Vec<PathBuf>> {
    let platforms = names.map(Platform::named).transpose()?;
    let mut built = Vec::new();
    for unit in UNITS {
        let path = match &platforms {
            None => build(unit)?,
            Some(platforms) => {
                let (of_2, mut of_3) = libraries(unit, platforms)?;
                of_3.extend(component(unit)?);
                pack(unit, &of_2, &of_3, &packer()?, &out())?
            }
        };
        println!("{}", path.display());
        built.push(path);
    }
    Ok(built)
}

/// Builds the library for each platform. Returns those that FMI 2.0 has a folder for, of which several
/// processors may share one, and those for FMI 3.0 alone.
fn libraries(unit: Unit, platforms: &[&'static Platform]) -> Result<(Vec<PathBuf>, Vec<PathBuf>)> {
    let (mut of_2, mut of_3) = (BTreeMap::new(), Vec::new());
    for platform in platforms {
        let library = library(unit, Some(platform))?;
        let Some(folder) = platform.fmi2 else {
            of_3.push(library);
            continue;
        };
        if let Some(other) = of_2.insert(folder, library.clone()) {
            let universal = library.with_extension("universal");
            platform::join(&[&other, &library], &universal)?;
            of_2.insert(folder, universal);
        }
    }
    Ok((of_2.into_values().collect(), of_3))
}

/// Builds targets of packages with a profile, and returns the folder of what is built.
pub(crate) fn programs(profile: &str, targets: &[&str]) -> Result<PathBuf> {
    let mut build = cargo();
    build.args(["build", "--locked", "--profile", profile]).args(targets);
    succeed(&mut build, "see the compiler's message above")?;
    Ok(target().join(if profile == "dev" { "debug" } else { profile }))
}

/// Builds the library that is published, for a platform or with this machine's own linker and C library, and
/// without the command line's crates; returns its path.
pub(crate) fn library(unit: Unit, platform: Option<&Platform>) -> Result<PathBuf> {
    let folder = target().join("fmu");
    let (mut build, built, names) = match platform {
        None => {
            let mut build = cargo();
            reproducible(build.arg("rustc"), &[]);
            (build, folder.clone(), SYSTEM)
        }
        Some(platform) => (platform.cargo("rustc")?, folder.join(platform.target), platform.library),
    };
    link(build.args(["--profile", "dist"]).env("CARGO_TARGET_DIR", &folder), unit)?;
    Ok(built.join("dist").join(file_name(unit, names)))
}

/// Links the library of a unit by a prepared `cargo rustc`.
fn link(build: &mut Command, unit: Unit) -> Result<()> {
    build.args(["--locked", "--package", unit.package, "--lib", "--crate-type", "cdylib"]);
    succeed(build, "see the compiler's message above")
}

/// Returns the name of the file that a build gives the library of a unit, of the platform's beginning and
/// ending.
pub(crate) fn file_name(unit: Unit, [beginning, ending]: [&str; 2]) -> String {
    format!("{beginning}{}{ending}", unit.package.replace('-', "_"))
}

/// Checks that this machine can build WebAssembly components.
pub(crate) fn check_component() -> Result<()> {
    check_rust_libraries([COMPONENT], "")
}

/// Builds the WebAssembly component of a unit, and returns its path; where this machine cannot build it, that
/// is said.
fn component(unit: Unit) -> Result<Option<PathBuf>> {
    if let Err(missing) = check_component() {
        println!("{} has no WebAssembly component: {missing}", unit.file);
        return Ok(None);
    }
    let folder = target().join("fmu");
    let mut build = cargo();
    build.args(["rustc", "--profile", "dist", "--target", COMPONENT]).env("CARGO_TARGET_DIR", &folder);
    reproducible(&mut build, &[]);
    link(&mut build, unit)?;
    Ok(Some(folder.join(COMPONENT).join("dist").join(file_name(unit, ["", ".wasm"]))))
}

/// Zips the FMU with `fmu-pack` of a folder of programs into a folder, for FMI 2.0 of some libraries and,
/// below `fmi3/`, for FMI 3.0 of these and more. Returns the path of the first.
pub(crate) fn pack(
    unit: Unit,
    of_2: &[PathBuf],
    more: &[PathBuf],
    programs: &Path,
    folder: &Path,
) -> Result<PathBuf> {
    pack_version(unit, &[of_2, more].concat(), programs, Fmi::Three, folder)?;
    pack_version(unit, of_2, programs, Fmi::Two, folder)
}

/// A version of FMI.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fmi {
    Two,
    Three,
}

/// Zips the FMU for one version of FMI into a folder, that of FMI 3.0 below `fmi3/`, and returns its path.
pub(crate) fn pack_version(
    unit: Unit,
    libraries: &[PathBuf],
    programs: &Path,
    version: Fmi,
    folder: &Path,
) -> Result<PathBuf> {
    let (folder, version) = match version {
        Fmi::Two => (folder.to_owned(), "2"),
        Fmi::Three => (folder.join("fmi3"), "3"),
    };
    make_folder(&folder)?;
    let output = folder.join(unit.file);
    let mut pack = program(programs.join("fmu-pack"));
    let description = Path::new(unit.description);
    pack.args(["--fmi", version]);
    pack.arg("--description").arg(description.join("modelDescription.xml"));
    pack.arg("--documentation").arg(description.join("documentation"));
    for library in libraries {
        pack.arg("--binary").arg(library);
    }
    pack.arg("--output").arg(&output);
    succeed(&mut pack, "see its message above")?;
    Ok(output)
}
