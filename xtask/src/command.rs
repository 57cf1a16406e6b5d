//! Knows the folders of the jobs, and runs other programs in them.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What went wrong, with the remedy.
pub(crate) type Result<T> = std::result::Result<T, String>;

/// Returns the root of the workspace.
pub(crate) fn root() -> PathBuf {
    let mut path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    path.pop();
    path
}

/// Returns the target folder, which the environment may set.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// Prepares a program to run in the root folder.
pub(crate) fn program(name: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(name);
    command.current_dir(root());
    command
}

/// Prepares the cargo that runs this program.
pub(crate) fn cargo() -> Command {
    program(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// Finds an installed program.
pub(crate) fn find(name: &str) -> Option<PathBuf> {
    let paths = std::env::var_os("PATH")?;
    std::env::split_paths(&paths).map(|folder| folder.join(name)).find(|path| path.is_file())
}

/// Runs a command to its end; `remedy` says what to do where it cannot start or does not succeed.
pub(crate) fn succeed(command: &mut Command, remedy: &str) -> Result<()> {
    let shown = shown(command);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{shown}` ended with {status}; {remedy}")),
        Err(error) => Err(format!("`{shown}` cannot start: {error}; {remedy}")),
    }
}

/// Runs a command as [`succeed`] does, and returns what it prints.
pub(crate) fn output(command: &mut Command, remedy: &str) -> Result<String> {
    let shown = shown(command);
    match command.output() {
        Ok(output) if output.status.success() => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr);
            Err(format!("`{shown}` ended with {}; {remedy}\n{}", output.status, text.trim_end()))
        }
        Err(error) => Err(format!("`{shown}` cannot start: {error}; {remedy}")),
    }
}

/// Says which file or folder an error is of.
pub(crate) fn at(path: &Path) -> impl Fn(std::io::Error) -> String {
    move |error| format!("{}: {error}", path.display())
}

/// Reads a text; a path begins at the root.
pub(crate) fn read(path: impl AsRef<Path>) -> Result<String> {
    fs::read_to_string(root().join(&path)).map_err(at(path.as_ref()))
}

/// Writes a file; a path begins at the root.
pub(crate) fn write(path: impl AsRef<Path>, content: impl AsRef<[u8]>) -> Result<()> {
    fs::write(root().join(&path), content).map_err(at(path.as_ref()))
}

/// Copies a file; paths begin at the root.
pub(crate) fn copy(from: impl AsRef<Path>, to: impl AsRef<Path>) -> Result<()> {
    let (from, to) = (from.as_ref(), to.as_ref());
    let failed = |error| format!("{} to {}: {error}", from.display(), to.display());
    fs::copy(root().join(from), root().join(to)).map(drop).map_err(failed)
}

/// Makes a folder, and those that it is in.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(at(path))
}

/// Removes a folder with all that is in it, if it is there.
pub(crate) fn remove_folder(path: &Path) -> Result<()> {
    if path.exists() { fs::remove_dir_all(path).map_err(at(path)) } else { Ok(()) }
}

/// Returns the CPU time of the programs that have ended, user and system \[s\]; `None` where the machine does
/// not tell it.
pub(crate) fn children_seconds() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // the name may have blanks; cutime and cstime are the 16th and the 17th word, in hundredths
    let words: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let hundredths = |at: usize| words.get(at)?.parse::<f64>().ok();
    Some((hundredths(13)? + hundredths(14)?) / 100.0)
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}
