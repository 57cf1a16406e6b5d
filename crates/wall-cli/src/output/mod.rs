//! What leaves the program: stdout, stderr, and files.

mod distinct;
pub(crate) mod progress;
mod terminal;

use std::path::{Path, PathBuf};

use anyhow::Result;

pub(crate) use terminal::{Console, message};

impl Console<'_> {
    /// Writes a file completely or not at all, see [`run::file::to_file`]; `-` is standard output.
    pub(crate) fn write(&self, path: &Path, content: &[u8]) -> Result<()> {
        if path.as_os_str() == distinct::STDOUT {
            return self.bytes(content);
        }
        Ok(run::file::to_file(path, content)?)
    }

    /// Prints a value as JSON.
    pub(crate) fn json(&self, value: &serde_json::Value) -> Result<()> {
        self.print(&(serde_json::to_string_pretty(value)? + "\n"))
    }

    /// Writes a text to the file that an option names, if it is given.
    pub(crate) fn save(&self, path: Option<&PathBuf>, text: impl FnOnce() -> String) -> Result<()> {
        path.map_or(Ok(()), |path| self.write(path, text().as_bytes()))
    }
}

/// Lists files that were written, a line for each after `label`; standard output is no file.
pub(crate) fn written<'a>(label: &str, paths: impl IntoIterator<Item = &'a PathBuf>) -> String {
    let files = paths.into_iter().filter(|path| path.as_os_str() != distinct::STDOUT);
    files.map(|path| [label, &path.display().to_string(), "\n"].concat()).collect()
}
