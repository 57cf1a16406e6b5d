//! What leaves the program: stdout, stderr, and files, which are written completely or not at all.

#![allow(clippy::print_stderr, reason = "messages to the user")]

use std::hash::{BuildHasher, RandomState};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail};
use figures::plot::Picture;

/// Writes a file completely or not at all: beside its place first, then renamed.
pub(crate) fn to_file(path: &Path, content: &[u8]) -> Result<()> {
    let context = || format!("{}: cannot be written", path.display());
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let name = path.file_name().with_context(context)?;
    // unique, also among processes with the same number on other machines
    let own = RandomState::new().hash_one(std::process::id());
    let part = folder.join(format!(".{}.{own:016x}.part", name.to_string_lossy()));
    let written = std::fs::write(&part, content).and_then(|()| std::fs::rename(&part, path));
    if written.is_err() {
        // leave nothing incomplete behind; the file may not exist
        let _ = std::fs::remove_file(&part);
    }
    written.with_context(context)
}

/// Writes a text to the file that an option names, if it is given.
pub(crate) fn save(path: Option<&PathBuf>, text: impl FnOnce() -> String) -> Result<()> {
    path.map_or(Ok(()), |path| to_file(path, text().as_bytes()))
}

/// Writes a picture, as SVG or PNG by the file's ending; draws it only if the ending is one of them.
pub(crate) fn picture(path: &Path, draw: impl FnOnce() -> Result<Picture>) -> Result<()> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let bytes = match ending.as_str() {
        "svg" => draw()?.svg().into_bytes(),
        "png" => draw()?.png().map_err(|reason| anyhow!("{}: {reason}", path.display()))?,
        _ => bail!("{}: a plot ends in .svg or .png", path.display()),
    };
    to_file(path, &bytes)
}

/// Prints to stdout; a closed pipe is no error.
pub(crate) fn to_stdout(text: &str) -> Result<()> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error).context("stdout"),
        _ => Ok(()),
    }
}

/// Joins an error and its causes, outermost first, without a cause that the text before it ends with.
pub(crate) fn message(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if !text.ends_with(&cause) {
            text = if text.is_empty() { cause } else { format!("{text}: {cause}") };
        }
    }
    text
}

/// Tells the user an error.
pub(crate) fn report(message: &str) {
    eprintln!("wall: {message}");
}

/// Warns the user of something that does not stop the work.
pub(crate) fn warn(message: &str) {
    eprintln!("wall: warning: {message}");
}
