//! What can be wrong with a scene.

use files::FileError;
use ground_motion::GroundMotionError;
use rocking_wall::simulation::RunError;
use rocking_wall::wall::ParameterError;

/// Why a scene cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum SceneError {
    /// The file.
    #[error(transparent)]
    File(#[from] FileError),
    /// A value given on its own.
    #[error("{message}")]
    Value { message: String },
    /// The motion.
    #[error("{file}, line {line}: {source}")]
    Motion { file: String, line: usize, source: Box<GroundMotionError> },
    /// Relations between parameters.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The run itself.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Too many output points.
    #[error(
        "stop_time = {stop} s with output_step = {step} s makes more than {limit} output points; raise \
         output_step or shorten the run"
    )]
    TooLong { stop: f64, step: f64, limit: f64 },
}

impl SceneError {
    /// Returns the key or the parameter that the error is about, if it is about one.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::File(error) => error.key.as_deref(),
            Self::Motion { source, .. } => source.key(),
            Self::Parameters(error) => error.keys().first().copied(),
            _ => None,
        }
    }
}
