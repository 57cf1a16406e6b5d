//! The records of a check.

use std::path::PathBuf;

use ground_motion::GroundMotion;
use rocking_wall::scene::Floors;
use rocking_wall::wall::Wall;
use run::records::NamedRecord;

use crate::error::CheckError;
use crate::site::felt;

/// The records of a check: motions of the ground at the site.
#[derive(Clone, Debug, Default)]
pub struct Records {
    /// Their names and motions.
    pub named: Vec<NamedRecord>,
    /// Files that they were read from.
    pub files: Vec<PathBuf>,
    /// Warnings of a quick check of the records.
    pub warnings: Vec<String>,
}

impl Records {
    /// Returns the motion that acts on a wall under each record: the record itself, or the motion of its
    /// floors, those of a strip wall by their weights.
    pub(crate) fn felt(&self, floors: Option<&Floors>, wall: &Wall) -> Result<Vec<GroundMotion>, CheckError> {
        self.named.iter().map(|record| felt(record.motion.clone(), floors, wall)).collect()
    }
}
