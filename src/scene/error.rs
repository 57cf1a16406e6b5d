//! What can be wrong with a scene.

use std::ops::Range;

use toml::Spanned;

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
    /// A line that is not TOML, an unknown key, a value of the wrong kind or outside its limits.
    #[error("{file}, line {line}: {message}")]
    Line { file: String, line: usize, message: String },
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

/// A scene's file and text, to turn byte ranges into lines.
pub struct Place<'a> {
    name: &'a str,
    text: &'a str,
}

impl<'a> Place<'a> {
    /// The text of a file, or of a part of one, under its name.
    pub fn new(name: &'a str, text: &'a str) -> Self {
        Self { name, text }
    }

    /// The file's name.
    pub fn name(&self) -> &'a str {
        self.name
    }

    /// Its text.
    pub fn text(&self) -> &'a str {
        self.text
    }

    /// The 1-based line of a byte range.
    pub fn line(&self, span: Range<usize>) -> usize {
        let before = &self.text.as_bytes()[..span.start.min(self.text.len())];
        before.split(|&byte| byte == b'\n').count()
    }

    /// An error that names the file and the line of a byte range.
    pub fn error(&self, span: Range<usize>, message: impl Into<String>) -> SceneError {
        SceneError::Line { file: self.name.to_owned(), line: self.line(span), message: message.into() }
    }

    /// A positive number up to `limit`, or `natural` where none is given.
    ///
    /// # Errors
    /// [`SceneError::Line`] for a number outside the limits.
    pub fn within(
        &self,
        key: &str,
        given: Option<&Spanned<f64>>,
        natural: f64,
        limit: f64,
    ) -> Result<f64, SceneError> {
        let Some(value) = given else { return Ok(natural) };
        let number = *value.get_ref();
        if number > 0.0 && number <= limit {
            Ok(number)
        } else {
            let message = format!("{key} = {number} s must be above 0 and at most {limit} s");
            Err(self.error(value.span(), message))
        }
    }
}
