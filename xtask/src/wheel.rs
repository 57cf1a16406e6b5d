//! `cargo xtask wheel`: builds the Python package.

use std::path::{Path, PathBuf};

use crate::command::{Result, output, root, succeed, target};
use crate::fmu;
use crate::platform::Platform;
use crate::python::Environment;

/// The general FMU in the package, for `rocking_wall.package`.
const UNIT: &str = "crates/python/python/rocking_wall/wall.fmu";
/// Licences of others, from the FMU's folder to that of the package.
const LICENCES: [&str; 2] = ["modelDescription/documentation/licenses", "crates/python/licenses"];
const TEXTS: [&str; 2] = ["MIT.txt", "Apache-2.0.txt"];

/// Builds the wheel and prints its path.
pub(crate) fn run() -> Result<()> {
    let unit = fmu::build(fmu::WALL)?;
    println!("{}", build("release", &unit, None)?.display());
    Ok(())
}

/// Builds the wheel with a profile and a general FMU, for this machine or for a platform, and returns its
/// path.
pub(crate) fn build(profile: &str, unit: &Path, platform: Option<&Platform>) -> Result<PathBuf> {
    std::fs::copy(unit, root().join(UNIT)).map_err(|error| format!("{UNIT}: {error}"))?;
    for text in TEXTS {
        let [from, to] = LICENCES.map(|folder| root().join(folder).join(text));
        std::fs::copy(from, &to).map_err(|error| format!("{}: {error}", to.display()))?;
    }
    let maturin = Environment::of("maturin", "xtask/locks/maturin.lock")?;
    let folder = target().join("wheels").join(profile);
    // wheels of other versions and machines
    let _ = std::fs::remove_dir_all(&folder);
    let mut build = maturin.program("maturin");
    build.args(["build", "--locked", "--manifest-path", "crates/python/Cargo.toml", "--profile", profile]);
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
    succeed(build.arg("--out").arg(&folder), "see its message above")?;
    let failed = |error| format!("{}: {error}", folder.display());
    let mut files = std::fs::read_dir(&folder).map_err(failed)?.map_while(std::result::Result::ok);
    let wheel = files.find(|file| file.path().extension().is_some_and(|ending| ending == "whl"));
    wheel.map(|file| file.path()).ok_or_else(|| format!("{} has no wheel", folder.display()))
}

/// Installs the wheel into an environment that has what it needs.
pub(crate) fn install(wheel: &Path, environment: &Environment) -> Result<()> {
    let mut pip = environment.pip_install()?;
    output(pip.args(["--no-index", "--no-deps", "--force-reinstall"]).arg(wheel), "see its message above")
        .map(drop)
}
