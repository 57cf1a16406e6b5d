//! A CSV file that grows table by table: walls come one after the other.

use std::io::Write;
use std::path::{Path, PathBuf};

use report::table::Table;
use run::file::{Draft, FileError};

/// A file under construction, whose line of names is that of the first table.
pub struct Rows {
    draft: Draft,
    is_begun: bool,
}

impl Rows {
    /// Begins a file, which appears where it is [complete](Self::commit).
    ///
    /// # Errors
    /// [`FileError`] where there can be none.
    pub fn new(path: &Path) -> Result<Self, FileError> {
        Ok(Self { draft: Draft::new(path, b"")?, is_begun: false })
    }

    /// Adds the rows of a table; all tables have the same columns.
    ///
    /// # Errors
    /// [`FileError`] of a disk that is full.
    pub fn add(&mut self, table: &Table) -> Result<(), FileError> {
        let text = if self.is_begun { table.csv_rows() } else { table.csv() };
        self.is_begun = true;
        self.draft.write(|file| file.write_all(text.as_bytes()))
    }

    /// Completes the file, and returns its path.
    ///
    /// # Errors
    /// [`FileError`] where it cannot take its place.
    pub fn commit(self) -> Result<PathBuf, FileError> {
        self.draft.commit(true)
    }
}
