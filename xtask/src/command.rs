//! Knows the folders of the jobs, and runs other programs in them.

use std::ffi::OsStr;
use std::path::PathBuf;
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

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}
