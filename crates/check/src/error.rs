//! Why a check is impossible, and which key of the table `[check]` that is about.

use ground_motion::GroundMotionError;
use rocking_wall::scene::SceneError;
use rocking_wall::wall::{ParameterError, Warning};

/// Why a check is impossible.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the numbers of the message")]
pub enum CheckError {
    /// A value of the table `[check]`.
    #[error("{message}")]
    Value {
        /// Keys from the table on, such as `SLV`, `ag`.
        keys: Vec<&'static str>,
        message: String,
    },
    /// A wall whose curve the check cannot take.
    #[error("{message}")]
    Wall { message: String },
    /// The force does not vanish.
    #[error("the restoring force never falls to zero, so d_0 does not exist")]
    NoZero,
    /// The force at a limit state is not positive.
    #[error("{state}: a is not positive at d = {displacement} m")]
    NotPositive { state: &'static str, displacement: f64 },
    /// The elastic branch goes on to the limit state.
    #[error(
        "the elastic branch reaches d_{state}: the wall does not rock before {state} (it ends at d_y = \
         {elastic} m with T0 = {t0} s; d_{state} = {displacement} m with T = {period} s)"
    )]
    Elastic { state: &'static str, elastic: f64, t0: f64, displacement: f64, period: f64 },
    /// A displacement of the limit state SLC beyond the zero of the force.
    #[error("SLC.displacement = {given} m must be above 0 and below u_0 = {zero} m")]
    LocalInstability { given: f64, zero: f64 },
    /// A displacement of the limit state SLC that comes before that of SLV.
    #[error("SLC comes before SLV: d_SLC = {slc} m is below d_SLV = {slv} m")]
    Order { slc: f64, slv: f64 },
    /// A spectrum given by points that ends too early.
    #[error("{state} needs the spectrum up to T = {period} s; it goes from {from} to {to} s")]
    Period { state: &'static str, period: f64, from: f64, to: f64 },
    /// A spectrum of another damping.
    #[error("{state} needs the spectrum at {needed} % damping; the given one is at {given} %")]
    Damping { state: &'static str, needed: f64, given: f64 },
    /// A check that is impossible and has numbers that are improbable: they may be the cause.
    #[error("{}; as given, {error}", doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Improbable { doubts: Vec<Warning>, error: Box<CheckError> },
    /// The force at the secant displacement is not positive.
    #[error(
        "the force at d* = {displacement} m is not positive: it has no secant period; reduce the fractions"
    )]
    NoSecant { displacement: f64 },
    /// A record.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A scene or a run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The parameters of the wall.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
}

impl CheckError {
    pub(crate) fn value(keys: &[&'static str], message: impl Into<String>) -> Self {
        Self::Value { keys: keys.to_vec(), message: message.into() }
    }

    /// Returns the keys from the table `[check]` on that the error is about, such as `SLV`, `ag`; `None` for
    /// an error that is about no key.
    pub fn keys(&self) -> Option<Vec<&'static str>> {
        match self {
            Self::Value { keys, .. } => Some(keys.clone()),
            Self::LocalInstability { .. } | Self::Order { .. } => Some(vec!["SLC", "displacement"]),
            Self::Period { state, .. } => Some(vec![state, "spectrum"]),
            Self::Damping { state, .. } => Some(vec![state, "spectrum_damping"]),
            Self::NoSecant { .. } => Some(vec!["displacement_fraction"]),
            Self::Improbable { error, .. } => error.keys(),
            _ => None,
        }
    }

    /// Adds the numbers that may be the cause; a wall that is refused has named its own.
    pub(crate) fn with_doubts(self, doubts: impl FnOnce() -> Vec<Warning>) -> Self {
        if matches!(self, Self::Parameters(_) | Self::Scene(_) | Self::Motion(_)) {
            return self;
        }
        match doubts() {
            doubts if doubts.is_empty() => self,
            doubts => Self::Improbable { doubts, error: Box::new(self) },
        }
    }

    pub(crate) fn wall(message: impl Into<String>) -> Self {
        Self::Wall { message: message.into() }
    }
}
