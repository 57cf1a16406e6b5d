//! `cargo xtask release`: the files that users download, from one commit, with their checksums.

use std::path::{Path, PathBuf};

use crate::command::{Result, output, program, root, succeed, target};
use crate::fmu;
use crate::platform::Platform;
use crate::wheel;

/// The version of every crate, of the descriptions and of the changelog; a test holds them together.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Packages that are linked into the files.
const LINKED: [&str; 4] = ["rocking-wall-cli", "rocking-wall", "rocking-floor", "rocking-wall-python"];

/// Builds the FMUs (those of FMI 3.0 begin with `fmi3-`), the program for each platform, the Python package
/// for all but Windows and as sources, the list of components (SBOM), the notices of third parties and the
/// checksums into `target/release-files/`, and the version's section of the changelog beside it. The same
/// commit and compiler give the same bytes.
pub(crate) fn run(tag: Option<&str>, names: &str) -> Result<()> {
    let notes = notes()?;
    if let Some(tag) = tag.filter(|tag| tag.strip_prefix('v') != Some(VERSION)) {
        return Err(format!("the tag {tag} is not v{VERSION}, the version in Cargo.toml"));
    }
    let changed = output(program("git").args(["status", "--porcelain"]), "run the job in a clone")?;
    if !changed.is_empty() {
        return Err(format!("commit or remove these files first:\n{}", changed.trim_end()));
    }
    let platforms = Platform::named(names)?;
    fmu::check_component()?;
    let folder = target().join("release-files");
    // nothing of an earlier release may stay
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let beside = target().join("release-notes.md");
    std::fs::write(&beside, notes).map_err(|error| format!("{}: {error}", beside.display()))?;
    for unit in fmu::build_all(Some(names))? {
        let name = unit.file_name().unwrap_or_default().to_string_lossy();
        copy(&unit, &folder.join(&*name))?;
        copy(&unit.with_file_name("fmi3").join(&*name), &folder.join(format!("fmi3-{name}")))?;
    }
    let unit = folder.join("wall.fmu");
    let mut packages = vec![wheel::sources(&unit)?];
    for platform in platforms {
        let (built, ending) = wall(platform)?;
        copy(&built, &folder.join(format!("wall-{VERSION}-{}{ending}", platform.fmi3)))?;
        if wheel::is_linked_here(platform) {
            packages.push(wheel::build("release", &unit, Some(platform))?);
        }
    }
    for package in packages {
        copy(&package, &folder.join(package.file_name().unwrap_or_default()))?;
    }
    let mut components = program("python3");
    components.arg("xtask/release/components.py").arg(folder.join(format!("rocking-wall-{VERSION}")));
    succeed(components.arg(VERSION).args(LINKED), "see its message above")?;
    let mut sums = program("sh");
    sums.args(["-c", "LC_ALL=C; sha256sum * >../SHA256SUMS && mv ../SHA256SUMS . && cat SHA256SUMS"]);
    succeed(sums.current_dir(&folder), "install coreutils")?;
    println!("written {}", folder.display());
    Ok(())
}

/// Returns what the changelog says of this version.
fn notes() -> Result<String> {
    let changelog = root().join("CHANGELOG.md");
    let text = std::fs::read_to_string(&changelog).map_err(|error| format!("CHANGELOG.md: {error}"))?;
    let section = text.split("\n## ").skip(1).find(|section| section.starts_with(&format!("{VERSION} ")));
    let section = section.ok_or_else(|| format!("CHANGELOG.md has no section `## {VERSION} – date`"))?;
    let (_, told) = section.split_once('\n').unwrap_or_default();
    Ok(format!("{}\n", told.trim()))
}

/// Builds the program for a platform, and returns it with the ending of its name.
fn wall(platform: &Platform) -> Result<(PathBuf, &'static str)> {
    let folder = target().join("fmu");
    let mut build = platform.cargo("build")?;
    build.args(["--release", "--locked", "--bin", "wall"]).env("CARGO_TARGET_DIR", &folder);
    succeed(&mut build, "see the compiler's message above")?;
    let ending = if platform.library.1 == ".dll" { ".exe" } else { "" };
    Ok((folder.join(platform.target).join("release").join(format!("wall{ending}")), ending))
}

fn copy(from: &Path, to: &Path) -> Result<()> {
    let copied = std::fs::copy(from, to);
    copied.map(drop).map_err(|error| format!("{} to {}: {error}", from.display(), to.display()))
}
