//! Errors of comparisons with tests.

use rocking_wall::scene::SceneError;
use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;

/// Why a test cannot be compared with the model.
#[derive(Debug, thiserror::Error)]
pub enum ValidationError {
    /// The files of the test.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A run.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// A free decay cannot start beyond `u_ins`.
    #[error("the peak |d|/t = {peak} is not below u_ins = {instability} t; leave it out")]
    Peak {
        /// |u|/t of the peak \[-\].
        peak: f64,
        /// `u_ins` over the thickness \[-\].
        instability: f64,
    },
    /// The model comes to rest before the last peak.
    #[error("the wall comes to rest after {found} of {expected} peaks; leave out the last points")]
    Rest {
        /// Peaks of the model.
        found: usize,
        /// Peaks of the test after its start.
        expected: usize,
    },
}
