//! What can be wrong with a scene.

use std::ops::Range;

use crate::simulation::RunError;
use crate::wall::ParameterError;
use ground_motion::GroundMotionError;

/// Why a scene cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{file}: {reason}")]
    File { file: String, reason: String },
    /// A line that is not TOML, an unknown key, a value of the wrong kind or outside its limits. `key` is the
    /// one that the line begins with, if it has one.
    #[error("{file}, line {line}: {message}")]
    Line { file: String, line: usize, key: Option<String>, message: String },
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
            Self::Line { key, .. } => key.as_deref(),
            Self::Motion { source, .. } => source.key(),
            Self::Parameters(error) => error.keys().first().copied(),
            _ => None,
        }
    }
}

/// A scene's file and text, to turn byte ranges into lines.
pub struct Place<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Place<'a> {
    /// Makes the place of a text: that of a file or of a part of one, with the file's name.
    pub fn new(name: &'a str, text: &'a str) -> Self {
        Self { name, text }
    }

    /// Returns the file's name.
    pub fn name(&self) -> &'a str {
        self.name
    }

    /// Returns the file's text.
    pub fn text(&self) -> &'a str {
        self.text
    }

    /// Returns the 1-based line at which a byte range starts.
    pub fn line(&self, span: Range<usize>) -> usize {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        before.split(|&byte| byte == b'\n').count()
    }

    /// Returns an error that names the file and the line of a byte range.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> SceneError {
        self.error_on(self.line(span), message)
    }

    /// Returns an error that names the file and a line of it.
    pub fn error_on(&self, line: usize, message: impl Into<String>) -> SceneError {
        let key = self.text.lines().nth(line - 1).and_then(|text| text.split_once('='));
        let key = key.map(|(key, _)| key.trim().to_owned());
        SceneError::Line { file: self.name.to_owned(), line, key, message: message.into() }
    }
}
