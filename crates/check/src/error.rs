//! Why a check is impossible, and which key of the table `[check]` that is about.

use files::FileError;
use ground_motion::GroundMotionError;
use rocking_wall::wall::{ParameterError, Warning};
use scene::SceneError;

/// Why a check is impossible.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum CheckError {
    /// A key of the table `[check]` that it does not hold or that is missing, or a value that cannot be used.
    #[error("{message}")]
    Value { keys: Vec<String>, message: String },
    /// A wall that the code does not cover.
    #[error("{message}")]
    Wall { message: String },
    /// A check that is impossible and has numbers that are improbable: they may be the cause.
    #[error("{}; as given, {error}", doubts.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Improbable { doubts: Vec<Warning>, error: Box<CheckError> },
    /// A record or a spectrum.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
    /// A file.
    #[error(transparent)]
    File(#[from] FileError),
    /// A scene or a run.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The parameters of the wall.
    // not #[from]: that would make it the cause, too, and who prints causes would tell it twice
    #[error("{_0}{}", falls(_0))]
    Parameters(ParameterError),
}

impl From<ParameterError> for CheckError {
    fn from(error: ParameterError) -> Self {
        Self::Parameters(error)
    }
}

/// What a check has to add about a wall that falls by its own loads.
fn falls(error: &ParameterError) -> &'static str {
    if matches!(error, ParameterError::Overturns { .. }) {
        "; the body falls at rest: without a tie its α0 and d_0 are below 0. d_0 counts no tie \
         (C8.7.1.2.1.6), so that ζ_E by displacement is 0 also with one"
    } else {
        ""
    }
}

impl CheckError {
    pub(crate) fn value(keys: &[&str], message: impl Into<String>) -> Self {
        let keys = keys.iter().map(|key| (*key).to_owned()).collect();
        Self::Value { keys, message: message.into() }
    }

    pub(crate) fn wall(message: impl Into<String>) -> Self {
        Self::Wall { message: message.into() }
    }

    /// Says with which hinge of a strip the check is impossible.
    pub(crate) fn at_hinge(self, ratio: f64) -> Self {
        self.within(&format!("with the hinge at hinge_ratio = {ratio}"))
    }

    /// Says where the check is impossible.
    pub(crate) fn within(self, place: &str) -> Self {
        let at = |message: String| format!("{place}: {message}");
        match self {
            Self::Value { keys, message } => Self::Value { keys, message: at(message) },
            Self::Wall { message } => Self::Wall { message: at(message) },
            error @ Self::Parameters(_) => Self::Wall { message: at(error.to_string()) },
            Self::Scene(error) => Self::Wall { message: at(error.to_string()) },
            error => error,
        }
    }

    /// Returns the keys from the table `[check]` to the value that the error is about, such as `SLV`, `ag`,
    /// be it there or missing; `None` where it is about no value of the table.
    pub fn keys(&self) -> Option<&[String]> {
        match self {
            Self::Value { keys, .. } => Some(keys),
            Self::Improbable { error, .. } => error.keys(),
            _ => None,
        }
    }

    /// Adds the numbers that may be the cause; a wall that is refused has named its own.
    pub(crate) fn with_doubts(self, doubts: Vec<Warning>) -> Self {
        match self {
            Self::Parameters(_) | Self::File(_) | Self::Scene(_) | Self::Motion(_) => self,
            _ if doubts.is_empty() => self,
            error => Self::Improbable { doubts, error: Box::new(error) },
        }
    }
}
