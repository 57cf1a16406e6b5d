//! The signs with which the records of a study are run.

use files::choices;
use run::records::NamedRecord;
use serde::{Deserialize, Serialize};

use super::Run;

/// What the name of a reversed record ends with.
const REVERSED: &str = " (reversed)";

/// The signs with which records are run. They matter to walls whose sides differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Polarity {
    /// As they are.
    #[default]
    AsRecorded,
    /// Multiplied by −1.
    Reversed,
    /// Each record as it is, and after it reversed, as two records. The bootstrap draws them together.
    Both,
    /// At each level the sign that demands more: it overturns the wall, or has the larger |u|/`u_ins`.
    Worst,
}

choices!(Polarity);

impl Polarity {
    /// Returns the word of study files.
    pub fn name(self) -> &'static str {
        match self {
            Self::AsRecorded => "as_recorded",
            Self::Reversed => "reversed",
            Self::Both => "both",
            Self::Worst => "worst",
        }
    }

    /// Returns how many records of a study come from each one that is given.
    pub fn signs(self) -> usize {
        if self == Self::Both { 2 } else { 1 }
    }

    /// Returns the records that a study runs, made from those that are given.
    pub(super) fn records(self, given: Vec<NamedRecord>) -> Vec<NamedRecord> {
        let reversed = |record: &NamedRecord| NamedRecord {
            listed: record.listed,
            ..NamedRecord::new(format!("{}{REVERSED}", record.name), record.motion.scaled(-1.0))
        };
        match self {
            Self::AsRecorded | Self::Worst => given,
            Self::Reversed => given.iter().map(reversed).collect(),
            Self::Both => given.iter().flat_map(|record| [record.clone(), reversed(record)]).collect(),
        }
    }

    /// Returns the records from which those of a study were made.
    pub(super) fn given(self, records: &[NamedRecord]) -> Vec<NamedRecord> {
        let original = |record: &NamedRecord| {
            let name = record.name.strip_suffix(REVERSED).unwrap_or(&record.name);
            NamedRecord { listed: record.listed, ..NamedRecord::new(name, record.motion.scaled(-1.0)) }
        };
        match self {
            Self::AsRecorded | Self::Worst => records.to_vec(),
            Self::Reversed => records.iter().map(original).collect(),
            Self::Both => records.iter().step_by(2).cloned().collect(),
        }
    }
}

/// Returns the run that demands more: of two that overturned the earlier one, else the one that did, else the
/// one with the larger |u|/`u_ins`.
pub(super) fn worse(one: Run, other: Run) -> Run {
    let is_other = match (one.overturning, other.overturning) {
        (Some(one), Some(other)) => other < one,
        (None, None) => other.demand > one.demand,
        (one, _) => one.is_none(),
    };
    if is_other { other } else { one }
}
