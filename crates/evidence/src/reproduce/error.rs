//! Errors of a reproduction.

use crate::accuracy::AccuracyError;
use ground_motion::GroundMotionError;
use rocking_wall::scene::SceneError;
use rocking_wall::wall::ParameterError;
use study::calibration::CalibrationError;

/// Why the paper could not be reproduced.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
#[allow(missing_docs, reason = "each variant is an error of another module, passed on")]
pub enum ReproductionError {
    Parameters(#[from] ParameterError),
    Scene(#[from] SceneError),
    Rotations(#[from] AccuracyError),
    Calibration(#[from] CalibrationError),
    Motion(#[from] GroundMotionError),
}
