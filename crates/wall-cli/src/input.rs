//! Files that the user names.

use std::path::Path;

use anyhow::{Context, Result, bail};

/// Reads a regular file of at most `most_bytes`; `what` names what it should be in the error. A pipe is
/// refused before it is opened, which would wait for its writer.
pub(crate) fn read(path: &Path, what: &str, most_bytes: u64) -> Result<String> {
    let context = || format!("{}: cannot be read", path.display());
    let metadata = std::fs::metadata(path).with_context(context)?;
    if !metadata.is_file() || metadata.len() > most_bytes {
        bail!("{}: expected {what} of at most {most_bytes} bytes", path.display());
    }
    std::fs::read_to_string(path).with_context(context)
}
