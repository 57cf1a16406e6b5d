//! What can be wrong with the general FMU, or with a scene for it.

use std::path::PathBuf;

use fmu_export_build::archive::ArchiveError;
use fmu_export_build::{Fault, ReductionError};
use rocking_wall::wall::ParameterError;
use scene::SceneError;

/// Why there is no FMU of a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum SceneFmuError {
    /// The general FMU cannot be read.
    #[error(transparent)]
    Archive(#[from] ArchiveError),
    /// Its description is missing or not UTF-8.
    #[error("{}: modelDescription.xml is missing or not UTF-8", path.display())]
    NoDescription { path: PathBuf },
    /// Its description is wrong.
    #[error("{}: modelDescription.xml: {source}", path.display())]
    Description { path: PathBuf, source: Box<Fault> },
    /// It is not a general FMU.
    #[error("{}: its guid {guid} is not of a general FMU", path.display())]
    Guid { path: PathBuf, guid: String },
    /// It is the FMU of a scene.
    #[error("{}: is itself an FMU of a scene, not the general one", path.display())]
    OfScene { path: PathBuf },
    /// A strip wall in full rotations.
    #[error(
        "a strip wall in an FMU has small rotations only, as its supports may move apart; set kinematics = \
         linear, or use `wall simulate`, which needs no FMU"
    )]
    StripInFullRotations,
    /// The parameters are not those of a valid wall, or the wall cannot be moved or started as the scene
    /// asks.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The supports cannot move as the scene says.
    #[error(transparent)]
    Motion(#[from] SceneError),
    /// The description cannot be reduced to the scene.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
}
