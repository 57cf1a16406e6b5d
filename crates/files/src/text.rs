//! Reads text files.

use std::path::Path;

use ground_motion::columns::Fault;

use crate::error::FileError;

/// Reads a text file of at most `limit` bytes; `what` says in messages what it should be.
///
/// # Errors
/// [`FileError`] of a file that cannot be read or is too large, and with the line where it is not UTF-8.
pub fn read_text(path: &Path, what: &str, limit: u64) -> Result<String, FileError> {
    let file = ground_motion::shown_path(path);
    let unread = |error| FileError::whole(file.clone(), format!("cannot be read: {error}"));
    let bytes = ground_motion::read_file(path, what, limit).map_err(unread)?;
    let in_file = |fault: Fault| FileError::on_line(file, fault.line(), fault.to_string());
    ground_motion::utf8_text(bytes, what).map_err(in_file)
}
