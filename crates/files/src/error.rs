//! What can be wrong with a file.

use std::fmt;

/// Why a file cannot be used: a file that cannot be read, a line that is not TOML, an unknown key, a value of
/// the wrong kind or outside its limits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file, as the user named it.
    pub file: String,
    /// The line, from 1; `None` of an error of the whole file.
    pub line: Option<usize>,
    /// The key that the line begins with, if it has one.
    pub key: Option<String>,
    /// What is wrong, and the remedy.
    pub reason: String,
}

impl FileError {
    /// Makes the error of a whole file.
    pub fn whole(file: impl Into<String>, reason: impl Into<String>) -> Self {
        Self { file: file.into(), line: None, key: None, reason: reason.into() }
    }

    /// Makes the error of a line without a key, such as one of a table of numbers.
    pub fn on_line(file: impl Into<String>, line: usize, reason: impl Into<String>) -> Self {
        Self { line: Some(line), ..Self::whole(file, reason) }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, reason, .. } = self;
        match line {
            Some(line) => write!(f, "{file}, line {line}: {reason}"),
            None => write!(f, "{file}: {reason}"),
        }
    }
}

impl std::error::Error for FileError {}
