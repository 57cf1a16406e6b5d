//! Errors of a measurement.

use ground_motion::GroundMotionError;
use rocking_wall::scene::SceneError;
use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;

/// Why a problem could not be measured.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum AccuracyError {
    /// The parameters make no wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The wall does not go with its supports.
    #[error(transparent)]
    Supports(#[from] SceneError),
    /// The motion is invalid.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A wall cannot be compared in both kinematics.
    #[error(transparent)]
    Rotations(#[from] run::rotations::RotationsError),
    /// A run failed.
    #[error("{name}: {source}")]
    Run { name: String, source: SolverError },
}
