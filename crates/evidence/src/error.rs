//! The error of all comparisons.

use check::CheckError;
use files::FileError;
use fragility::FitError;
use fragility::hazard::HazardError;
use ground_motion::GroundMotionError;
use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;
use run::rotations::RotationsError;
use scene::SceneError;
use study::calibration::CalibrationError;
use study::spectrum::SpectrumError;

/// Why something could not be computed or compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "most are errors of other modules; the fields are the words of the message")]
pub enum EvidenceError {
    #[error(transparent)]
    File(#[from] FileError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    #[error(transparent)]
    Solver(#[from] SolverError),
    #[error(transparent)]
    Rotations(#[from] RotationsError),
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    #[error(transparent)]
    Check(#[from] CheckError),
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    #[error(transparent)]
    Fit(#[from] FitError),
    #[error(transparent)]
    Hazard(#[from] HazardError),
    /// A run of a problem failed.
    #[error("{name}: {source}")]
    Run { name: String, source: SolverError },
    /// A free decay cannot start beyond `u_ins`; both are |u| over the thickness \[-\].
    #[error("the peak |d|/t = {peak} is not below u_ins = {instability} t; leave it out")]
    Peak { peak: f64, instability: f64 },
    /// The model comes to rest before the last peak of a test.
    #[error("the wall comes to rest after {found} of {expected} peaks; leave out the last points")]
    Rest { found: usize, expected: usize },
}
