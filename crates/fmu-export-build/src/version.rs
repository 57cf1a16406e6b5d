//! The version of a program with the commit and the profile that it is built from.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Digits of a commit: enough for any repository, and not as many as git thinks fit for this one.
const DIGITS: usize = 10;

/// Is the `build.rs` of a program that states commit and profile: sets `PROGRAM_VERSION` for people, such as
/// `0.1.0 (commit 0123456789, release)`, and `PACKAGE_VERSION` for Python, `0.1.0+0123456789.release`.
///
/// The same commit gives the same bytes: it is that of the source itself, of a git repository that begins two
/// folders above the package or of the archive that cargo has packed; `unknown` elsewhere. cargo runs the
/// script again after a commit or a change of branch only.
///
/// ```no_run
/// fmu_export_build::state_version();
/// ```
#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
pub fn state_version() {
    println!("cargo::rerun-if-changed=build.rs");
    let [version, package, output] =
        ["CARGO_PKG_VERSION", "CARGO_MANIFEST_DIR", "OUT_DIR"].map(|name| env::var(name).unwrap_or_default());
    let package = Path::new(&package);
    let commit = of_repository(package).or_else(|| of_archive(package));
    let commit = commit.map_or_else(|| "unknown".to_owned(), |hash| hash.chars().take(DIGITS).collect());
    let profile = profile(&output);
    println!("cargo::rustc-env=PROGRAM_VERSION={version} (commit {commit}, {profile})");
    println!("cargo::rustc-env=PACKAGE_VERSION={version}+{commit}.{profile}");
}

/// The profile of a folder `target/PROFILE/build/PACKAGE/out`; cargo calls the folder of `dev` debug.
fn profile(output: &str) -> String {
    let name = Path::new(output).ancestors().nth(3).and_then(Path::file_name);
    let plain = |name: &std::ffi::OsStr| name.to_string_lossy().into_owned();
    name.map_or_else(String::new, |name| if name == "debug" { "dev".to_owned() } else { plain(name) })
}

/// The commit of the repository that begins at the workspace, two folders above its crates. A repository
/// around it is another project's.
#[allow(clippy::print_stdout, reason = "this is how a build script speaks to cargo")]
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
    of_vcs_info(&std::fs::read_to_string(package.join(".cargo_vcs_info.json")).ok()?)
}

fn of_vcs_info(text: &str) -> Option<String> {
    let (_, hash) = text.split_once("\"sha1\": \"")?;
    hash.split('"').next().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_profile_is_that_of_the_folder() {
        for (output, name) in [
            ("/a/target/debug/build/wall-1/out", "dev"),
            ("/a/target/release/build/wall-1/out", "release"),
            ("/a/target/x86_64-pc-windows-gnu/demo/build/wall-1/out", "demo"),
            ("", ""),
        ] {
            assert_eq!(profile(output), name, "{output}");
        }
    }

    #[test]
    fn the_commit_is_that_of_the_source() {
        let archive = "{\n  \"git\": {\n    \"sha1\": \"0123abc\"\n  }\n}";
        assert_eq!(of_vcs_info(archive).as_deref(), Some("0123abc"));
        // two folders above `src/bin` is a folder of the repository, not its beginning
        let package = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(of_repository(&package.join("src/bin")), None);
        assert_eq!(of_archive(package), None);
        if let Some(commit) = of_repository(package) {
            assert!(commit.len() >= 40 && commit.chars().all(|c| c.is_ascii_hexdigit()), "{commit}");
        }
    }
}
