//! `cargo xtask wheel`: builds the Python package.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::command::{Result, at, copy, output, remove_folder, root, succeed, target};
use crate::fmu;
use crate::platform::Platform;
use crate::python::Environment;

/// The general FMU in the package, for `rocking_wall.package`.
const UNIT: &str = "crates/python/python/rocking_wall/wall.fmu";
/// The Python of the extension, for pyo3. maturin would describe it in a file of its own, for which cargo
/// would build the extension again.
const PYTHON: &str = "crates/python/pyo3-config.txt";
/// Licences of others, from the FMU's folder to that of the package.
const LICENCES: [&str; 2] = ["modelDescription/documentation/licenses", "crates/python/licenses"];
const TEXTS: [&str; 2] = ["MIT.txt", "Apache-2.0.txt"];

/// Builds the wheel for this machine with a general FMU, and prints its path. With an FMU that is built it is
/// optimised as what is published; without, as what `pip install` builds.
pub(crate) fn run(unit: Option<&str>) -> Result<()> {
    let (profile, unit) = match unit {
        Some(path) => ("dist", root().join(path)),
        None => ("release", fmu::build(fmu::WALL)?),
    };
    println!("{}", build(profile, &unit, None)?.display());
    Ok(())
}

/// Builds the wheel for each of some platforms, all with the FMU of these platforms, and prints their paths.
pub(crate) fn portable(names: &str) -> Result<()> {
    let [unit, _] = &fmu::build_all(Some(names))?[..] else { unreachable!("wall and floor") };
    for platform in Platform::named(names)? {
        if is_linked_here(platform) {
            println!("{}", build("dist", unit, Some(platform))?.display());
        } else {
            let unit = unit.display();
            println!("not built: that for Windows: run `cargo xtask wheel --fmu FILE` there with {unit}");
        }
    }
    Ok(())
}

/// Returns whether the wheel of a platform can be linked on another. That of Windows cannot: maturin hands
/// its list of exports to every library, those of FMUs among them.
pub(crate) fn is_linked_here(platform: &Platform) -> bool {
    !platform.target.contains("windows")
}

/// Describes Python to pyo3 as in every other job of the tests, so that the extension is built once.
pub(crate) fn share_extension(job: &mut Command) {
    job.env("PYO3_CONFIG_FILE", root().join(PYTHON));
}

/// Builds the wheel with a profile and a general FMU, for this machine or for a platform, and returns its
/// path.
pub(crate) fn build(profile: &str, unit: &Path, platform: Option<&Platform>) -> Result<PathBuf> {
    let folder = target().join("wheels").join(platform.map_or(profile, |platform| platform.fmi3));
    let mut build = maturin("build", unit)?;
    build.args(["--locked", "--profile", profile, "--generate-stubs"]);
    if profile == "dev" {
        share_extension(&mut build);
    }
    if let Some(platform) = platform {
        build.args(["--zig", "--target", platform.target]);
        if platform.target.ends_with("linux-gnu") {
            // glibc 2.17
            build.args(["--compatibility", "manylinux2014"]);
        }
        platform.link_with_zig(&mut build)?;
        // the time in the archive
        build.env("SOURCE_DATE_EPOCH", "315532800").env("CARGO_TARGET_DIR", target().join("fmu"));
    }
    written(&mut build, &folder, "whl")
}

/// Packs the sources, with a general FMU, and returns the path of the source distribution.
pub(crate) fn sources(unit: &Path) -> Result<PathBuf> {
    written(&mut maturin("sdist", unit)?, &target().join("wheels/sources"), "gz")
}

/// Prepares a job of maturin, with a general FMU and the licences of others in their places.
fn maturin(job: &str, unit: &Path) -> Result<Command> {
    copy(unit, UNIT)?;
    for text in TEXTS {
        let [from, to] = LICENCES.map(|folder| Path::new(folder).join(text));
        copy(from, to)?;
    }
    let mut maturin = Environment::of("maturin")?.program("maturin");
    maturin.args([job, "--manifest-path", "crates/python/Cargo.toml"]);
    // as for the tests; otherwise the crates would be built again
    maturin.env("CARGO_INCREMENTAL", "0");
    Ok(maturin)
}

/// Runs a job of maturin into a folder, and returns the file that it leaves there.
fn written(job: &mut Command, folder: &Path, ending: &str) -> Result<PathBuf> {
    // files of other versions
    remove_folder(folder)?;
    succeed(job.arg("--out").arg(folder), "see its message above")?;
    let mut files = std::fs::read_dir(folder).map_err(at(folder))?.map_while(std::result::Result::ok);
    let file = files.find(|file| file.path().extension().is_some_and(|found| found == ending));
    file.map(|file| file.path()).ok_or_else(|| format!("{} has no .{ending}", folder.display()))
}

/// Installs the wheel into an environment that has what it needs.
pub(crate) fn install(wheel: &Path, environment: &Environment) -> Result<()> {
    let mut pip = environment.pip_install()?;
    output(
        pip.args(["--no-compile", "--no-index", "--no-deps", "--force-reinstall"]).arg(wheel),
        "see its message above",
    )
    .map(drop)
}
