//! What can be wrong with a building.

use std::fmt::Display;

use files::FileError;

/// Why a building cannot be used.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum BuildingError {
    /// The file of the building.
    #[error(transparent)]
    Document(#[from] FileError),
    /// A value given on its own.
    #[error("{message}")]
    Value { message: String },
    /// A wall, a storey, or the file of the FMU that they are made of.
    #[error("{part}: {reason}")]
    Part { part: String, reason: String },
    /// The run.
    #[error("at t = {time} s: {reason}")]
    Run { time: f64, reason: String },
}

impl BuildingError {
    pub(crate) fn of_wall(name: &str, reason: impl Display) -> Self {
        Self::Part { part: format!("wall {name:?}"), reason: reason.to_string() }
    }

    pub(crate) fn of_floor(name: &str, reason: impl Display) -> Self {
        Self::Part { part: format!("floor {name:?}"), reason: reason.to_string() }
    }
}
