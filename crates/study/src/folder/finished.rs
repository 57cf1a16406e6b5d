//! What a part of the report of a study has come to.

use std::path::PathBuf;

/// A finished part of a report.
pub(crate) struct Finished {
    /// The files that it has written.
    pub(crate) files: Vec<PathBuf>,
    /// What is to be said of it.
    pub(crate) words: String,
    /// Its section of the page.
    pub(crate) html: String,
}
