//! Errors of a calibration.

use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;

use super::decay::{DECAYED, MOST_SAMPLES};

/// Why a wall could not be calibrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum CalibrationError {
    /// The damping model has no damping to calibrate.
    #[error(
        "there is no damping to calibrate with damping_model = \"none\"; name one of the others, such as \
         constant_ratio"
    )]
    NoDamping,
    /// There is no such damping model.
    #[error("{name:?} is not one of {models}")]
    UnknownModel { name: String, models: String },
    /// A value is out of range.
    #[error("{name} = {value}: must be above {low} and below {high}")]
    Range { name: &'static str, value: f64, low: f64, high: f64 },
    /// A list is empty.
    #[error("no value of {name} to calibrate over; give at least one")]
    Empty { name: &'static str },
    /// The parameters make no wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A run failed.
    #[error("a1 = {a1}, u0/u_ins = {start}, e = {restitution}: {source}")]
    Run { a1: f64, start: f64, restitution: f64, source: SolverError },
    /// The decay takes too many samples.
    #[error(
        "e = {restitution}, u0/u_ins = {start}: the rocking has not decayed to {DECAYED} u_ins after \
         {MOST_SAMPLES} samples of {step} s; take a smaller e or a longer step"
    )]
    NoDecay { restitution: f64, start: f64, step: f64 },
    /// The minimiser failed.
    #[error("the minimiser stopped: {0}")]
    Minimiser(String),
    /// Eq. (18) has no minimum within the dampings searched.
    #[error(
        "e = {restitution}, a1 = {a1}: Eq. (18) has no minimum for a damping from {low:.2e} to {high:.2e}"
    )]
    NoMinimum { restitution: f64, a1: f64, low: f64, high: f64 },
}
