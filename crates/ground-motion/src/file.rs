//! Files that are read into memory whole.

use std::fs::{File, metadata};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// Reads a regular file of at most `limit` bytes; `what` says in messages what it should be.
///
/// Anything else is refused before it is opened: opening a pipe waits for its other end, and a device never
/// ends.
///
/// ```
/// let error = ground_motion::read_file(&std::env::temp_dir(), "a table", 1000).unwrap_err();
/// assert_eq!(error.to_string(), "expected a table of at most 1000 bytes, found a folder");
/// ```
///
/// # Errors
/// If the file cannot be read; [`ErrorKind::InvalidInput`] if it is not a regular file, or too large.
pub fn read_file(path: &Path, what: &str, limit: u64) -> Result<Vec<u8>> {
    let refused = |found: &str| {
        let message = format!("expected {what} of at most {limit} bytes, found {found}");
        Err(Error::new(ErrorKind::InvalidInput, message))
    };
    let metadata = metadata(path)?;
    if metadata.is_dir() {
        return refused("a folder");
    }
    if !metadata.is_file() {
        return refused("a pipe or device; save its content to a file first");
    }
    if metadata.len() > limit {
        return refused(&metadata.len().to_string());
    }
    // The limit holds while reading too: a file may grow, or state no length.
    let mut bytes = Vec::new();
    File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { refused("more") } else { Ok(bytes) }
}
