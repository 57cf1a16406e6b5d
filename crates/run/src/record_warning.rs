//! What the file of a record gives reason to warn about.

use std::fmt;
use std::path::{Path, PathBuf};

use ground_motion::Warning;

/// A warning about the file of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordWarning {
    /// The file.
    pub path: PathBuf,
    /// Why it is named.
    pub reason: Reason,
}

/// Why a warning names the file of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// It is left out: a vertical component of a folder.
    LeftOut,
    /// Its content gives reason to warn.
    Of(Warning),
}

impl RecordWarning {
    /// The warnings about a record of a file.
    pub(crate) fn all(path: &Path, warnings: Vec<Warning>) -> impl Iterator<Item = Self> {
        warnings.into_iter().map(|warning| Self { path: path.to_owned(), reason: Reason::Of(warning) })
    }
}

impl fmt::Display for RecordWarning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: ", self.path.display())?;
        match &self.reason {
            Reason::Of(warning) => warning.fmt(formatter),
            Reason::LeftOut => formatter.write_str("vertical, left out; name the file itself to use it"),
        }
    }
}
