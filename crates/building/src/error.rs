//! What can be wrong with a building.

use rocking_wall::scene::SceneError;

/// Why a building cannot be used.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum BuildingError {
    /// The file of the building.
    #[error(transparent)]
    Document(#[from] SceneError),
    /// A wall, or its scene.
    #[error("wall {wall:?}: {reason}")]
    Wall { wall: String, reason: String },
    /// A storey.
    #[error("floor {floor:?}: {reason}")]
    Floor { floor: String, reason: String },
    /// The FMU that a part is made of.
    #[error("{file}: {reason}")]
    General { file: String, reason: String },
    /// The run was no longer wanted.
    #[error("the run was stopped")]
    Stopped,
    /// The run.
    #[error("at t = {time} s: {reason}")]
    Run { time: f64, reason: String },
}
