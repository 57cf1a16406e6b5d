//! What leaves the program: stdout, stderr, and files.

mod distinct;
pub(crate) mod progress;
mod terminal;

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

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

    /// Writes a picture to the file that an option names, if it is given. Draws it only if the file ends in
    /// .svg.
    pub(crate) fn picture(
        &self,
        path: Option<&PathBuf>,
        draw: impl FnOnce() -> Result<String>,
    ) -> Result<()> {
        let Some(path) = path else { return Ok(()) };
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if ending != "svg" {
            bail!("{}: a plot is SVG; give a file that ends in .svg", path.display());
        }
        self.write(path, draw()?.as_bytes())
    }
}

/// Lists files that were written, a line for each after `label`; standard output is no file.
pub(crate) fn written<'a>(label: &str, paths: impl IntoIterator<Item = &'a PathBuf>) -> String {
    let files = paths.into_iter().filter(|path| path.as_os_str() != distinct::STDOUT);
    files.map(|path| [label, &path.display().to_string(), "\n"].concat()).collect()
}

/// Refuses any ending but .svg for a picture that is written as SVG only. Names without an ending, such as
/// those of devices, are accepted.
pub(crate) fn expect_svg(path: Option<&PathBuf>) -> Result<()> {
    match path.and_then(|path| Some((path, path.extension()?))) {
        Some((path, ending)) if !ending.eq_ignore_ascii_case("svg") => {
            bail!("{}: --svg writes SVG; give a file that ends in .svg", path.display())
        }
        _ => Ok(()),
    }
}
