//! What can go wrong in a calibration.

use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;

use super::decay::{DECAYED, MOST_SAMPLES};

/// Why a wall could not be calibrated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// No damping to calibrate.
    #[error(
        "there is no damping to calibrate with damping_model = \"none\"; name one of the others, such as \
         constant_ratio"
    )]
    NoDamping,
    /// A value out of range.
    #[error("{name} = {value}: must be above {low} and below {high}")]
    Range {
        /// What.
        name: &'static str,
        /// The value.
        value: f64,
        /// Limits, excluded.
        low: f64,
        /// See `low`.
        high: f64,
    },
    /// A list without values.
    #[error("no value of {name} to calibrate over; give at least one")]
    Empty {
        /// What.
        name: &'static str,
    },
    /// The wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A run.
    #[error("a1 = {a1}, u0/u_ins = {start}, e = {restitution}: {source}")]
    Run {
        /// a₁.
        a1: f64,
        /// u₀/`u_ins`.
        start: f64,
        /// e.
        restitution: f64,
        /// What stopped it.
        source: SolverError,
    },
    /// The decay is too long.
    #[error(
        "e = {restitution}, u0/u_ins = {start}: the rocking has not decayed to {DECAYED} u_ins after {MOST_SAMPLES} samples \
         of {step} s; take a smaller e or a longer step"
    )]
    NoDecay {
        /// e.
        restitution: f64,
        /// u₀/`u_ins`.
        start: f64,
        /// Time between samples \[s\].
        step: f64,
    },
    /// The minimiser.
    #[error("the minimiser stopped: {0}")]
    Minimiser(String),
    /// The error falls on without a minimum.
    #[error(
        "e = {restitution}, a1 = {a1}: Eq. (18) has no minimum for a damping from {low:.2e} to {high:.2e}"
    )]
    NoMinimum {
        /// e.
        restitution: f64,
        /// a₁.
        a1: f64,
        /// Damping searched.
        low: f64,
        /// See `low`.
        high: f64,
    },
}
