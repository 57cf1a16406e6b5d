//! States the version with the commit and the profile that this is built from, for `wall --version` and, since
//! the Python package uses this file too, `rocking_wall.__version__`.
//!
//! The same commit gives the same bytes: the commit is that of the source itself, of a git repository that
//! begins at the workspace or of the archive that cargo has packed; `unknown` elsewhere.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Digits of a commit: enough for any repository, and not as many as git thinks fit for this one.
const DIGITS: usize = 10;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let [version, package, output] = ["CARGO_PKG_VERSION", "CARGO_MANIFEST_DIR", "OUT_DIR"]
        .map(|name| env::var(name).unwrap_or_else(|error| panic!("cargo sets {name}: {error}")));
    let package = Path::new(&package);
    let commit = of_repository(package).or_else(|| of_archive(package));
    let commit = commit.map_or_else(|| "unknown".to_owned(), |hash| hash.chars().take(DIGITS).collect());
    // target/PROFILE/build/PACKAGE/out
    let profile = Path::new(&output).ancestors().nth(3).and_then(Path::file_name);
    let profile = profile.map_or_else(String::new, |name| name.to_string_lossy().replace("debug", "dev"));
    println!("cargo::rustc-env=PROGRAM_VERSION={version} (commit {commit}, {profile})");
    println!("cargo::rustc-env=PACKAGE_VERSION={version}+{commit}.{profile}");
}

/// The commit of the repository that begins at the workspace, two folders above its crates. A repository around
/// it is another project's.
fn of_repository(package: &Path) -> Option<String> {
    let root = package.ancestors().nth(2)?.canonicalize().ok()?;
    let asked = |arguments: &[&str]| {
        let output = Command::new("git").arg("-C").arg(&root).args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let top = PathBuf::from(asked(&["rev-parse", "--show-toplevel"])?).canonicalize().ok()?;
    if top != root {
        return None;
    }
    // they change with each commit and each change of branch, and with nothing else
    for file in ["HEAD", "logs/HEAD"] {
        let path = root.join(asked(&["rev-parse", "--git-path", file])?);
        if path.exists() {
            println!("cargo::rerun-if-changed={}", path.display());
        }
    }
    asked(&["rev-parse", "HEAD"])
}

/// The commit of an archive that cargo has packed.
fn of_archive(package: &Path) -> Option<String> {
    let text = std::fs::read_to_string(package.join(".cargo_vcs_info.json")).ok()?;
    let (_, hash) = text.split_once("\"sha1\": \"")?;
    hash.split('"').next().map(str::to_owned)
}
