//! Errors of a verification.

use ground_motion::GroundMotionError;
use rocking_wall::scene::SceneError;
use rocking_wall::wall::ParameterError;

use check::CheckError;
use study::fragility::FitError;
use study::spectrum::SpectrumError;

/// Why a formula could not be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerificationError {
    /// A scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A motion or its spectrum.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A check of capacity.
    #[error(transparent)]
    Check(#[from] CheckError),
    /// A rocking spectrum.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// A fragility.
    #[error(transparent)]
    Fit(#[from] FitError),
}
