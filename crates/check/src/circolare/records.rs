//! The records of a check.

use std::path::{Path, PathBuf};

use ground_motion::GroundMotion;
use rocking_wall::scene::{Floors, Place, SceneError};
use rocking_wall::wall::Wall;

use super::table::CheckTable;
use crate::error::CheckError;
use crate::site::felt;
use run::records::NamedRecord;
use run::records::records;
use run::records::{all_records, record_files};

/// Fewest records, NTC 7.3.5.
pub(super) const FEWEST: usize = 3;

/// The records of a check: motions of the ground at the site.
#[derive(Clone, Debug, Default)]
pub struct Records {
    named: Vec<NamedRecord>,
    /// Files that they were read from.
    pub files: Vec<PathBuf>,
    /// Warnings of a quick check of the records.
    pub warnings: Vec<String>,
}

impl Records {
    /// Takes records that are given by name and motion.
    ///
    /// # Errors
    /// [`CheckError::Value`] of fewer than 3, if there are any.
    pub fn new(records: Vec<NamedRecord>) -> Result<Self, CheckError> {
        if (1..FEWEST).contains(&records.len()) {
            let message = format!("records: found {}; at least 3 records (NTC 7.3.5)", records.len());
            return Err(CheckError::value(&["records"], message));
        }
        Ok(Self { named: records, ..Self::default() })
    }

    /// Reads the records that a table names, beside its file; none of a table without records.
    ///
    /// # Errors
    /// [`SceneError`] of a file, or of fewer than 3 records.
    pub fn read(table: &CheckTable, place: &Place<'_>, folder: &Path) -> Result<Self, SceneError> {
        let Some(table) = &table.records else { return Ok(Self::default()) };
        let entry = records(table, place)?;
        let files = record_files(&entry, folder, place.name())?;
        let mut warnings = Vec::new();
        let records = all_records(&entry, &files, place.name(), &mut warnings)?;
        let records = Self::new(records).map_err(|error| crate::code::in_table(error, place))?;
        let files = files.into_iter().map(|file| file.path).collect();
        Ok(Self { files, warnings, ..records })
    }

    /// Returns whether there are no records.
    pub fn is_empty(&self) -> bool {
        self.named.is_empty()
    }

    /// The records.
    pub fn named(&self) -> &[NamedRecord] {
        &self.named
    }

    /// Returns the motion that acts on a wall under each record: the record itself, or the motion of its
    /// floors, those of a strip wall by their weights.
    pub(super) fn felt(&self, floors: Option<&Floors>, wall: &Wall) -> Result<Vec<GroundMotion>, CheckError> {
        self.named.iter().map(|record| felt(record.motion.clone(), floors, wall)).collect()
    }
}
