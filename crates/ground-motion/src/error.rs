//! Errors of reading and making ground motions.

use std::io;

/// Why a ground motion could not be read or made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum GroundMotionError {
    /// The time step is zero or negative, or the duration not finite.
    #[error("the time step of a ground motion must be positive and finite, found {step} s")]
    Step { step: f64 },
    /// Fewer than two samples.
    #[error("a ground motion needs at least two samples, found {found}")]
    TooFewSamples { found: usize },
    /// A sample that is no acceleration.
    #[error("sample {index} (counted from 0) is {value:?}; every sample must be finite and at most 1e6 m/s²")]
    NotFinite { index: usize, value: f64 },
    /// A scale factor that is not finite or makes a sample too large.
    #[error(
        "a ground motion with the peak {peak:?} m/s² cannot be scaled by {factor:?}: it may have 1e6 m/s²; \
         give a smaller finite factor"
    )]
    Factor { factor: f64, peak: f64 },
    /// A target peak that is negative or not finite.
    #[error("the target peak acceleration must be finite and not negative, found {peak} m/s²")]
    Peak { peak: f64 },
    /// A record of zeros has no peak to scale.
    #[error(
        "every sample of the ground motion is 0, so it cannot be scaled to the peak {peak} m/s²; \
         choose another record"
    )]
    NoPeak { peak: f64 },
    /// A trimming interval outside the record or shorter than one step.
    #[error(
        "cannot trim a ground motion of {duration} s to {from} s ... {to} s; \
         the interval must lie within the record and span at least one step"
    )]
    Trim { from: f64, to: f64, duration: f64 },
    /// A parameter of a pulse or of the synthetic motion is outside its limits.
    #[error("{name} is {value}; it must be {limit}")]
    Parameter { name: &'static str, value: f64, limit: &'static str },
    /// A harmonic motion without an end.
    #[error("a harmonic motion without an end needs a duration; state one of the two")]
    Endless,
    /// More samples than a motion may have.
    #[error("the motion would take {found:.0} samples, more than {limit}; shorten it or lower its frequency")]
    TooManySamples { found: f64, limit: usize },
    /// A unit of acceleration that is not known.
    #[error("unknown unit of acceleration `{found}`; use one of m/s2, cm/s2 (or gal), mm/s2, g")]
    Unit { found: String },
    /// A text that is no acceleration.
    #[error("{found:?} is not an acceleration; expected a number in m/s2, or one with a unit, such as 0.3g")]
    Acceleration { found: String },
    /// A record format that is not known.
    #[error("unknown record format `{found}`; use one of {known}")]
    Format { found: String, known: String },
    /// The file could not be opened or read, or is not a regular file, or larger than any record.
    #[error("{file}: cannot be read: {reason}")]
    Io { file: String, reason: io::Error },
    /// Not one channel: several and none was asked for, or not one of the name that was.
    #[error(
        "{file}: expected one channel{wanted}, found {found}; state the number of one of these as \
         `channel` (on the command line --channel), or none if there is only one"
    )]
    Channel { file: String, wanted: String, found: String },
    /// Content that is not what the format requires.
    #[error("{file}, line {line}: expected {expected}, found {found}; {remedy}")]
    Content { file: String, line: usize, expected: String, found: String, remedy: String },
}

impl GroundMotionError {
    /// Returns the key of the value that the error is about, as scenes and options of records have it.
    pub fn key(&self) -> Option<&'static str> {
        match self {
            Self::Step { .. } => Some("step"),
            Self::Factor { .. } => Some("scale"),
            Self::Peak { .. } | Self::NoPeak { .. } | Self::Acceleration { .. } => Some("pga"),
            Self::Trim { .. } => Some("from"),
            // without its unit
            Self::Parameter { name, .. } => name.split(' ').next(),
            Self::Endless => Some("duration"),
            Self::TooManySamples { .. } => Some("frequency"),
            Self::Unit { .. } => Some("unit"),
            Self::Format { .. } => Some("format"),
            Self::Channel { .. } => Some("channel"),
            Self::Io { .. } | Self::Content { .. } => Some("record"),
            Self::TooFewSamples { .. } | Self::NotFinite { .. } => None,
        }
    }
}

/// Refuses a parameter that is outside its limits.
pub(crate) fn check_parameter(
    holds: bool,
    name: &'static str,
    value: f64,
    limit: &'static str,
) -> Result<(), GroundMotionError> {
    if holds { Ok(()) } else { Err(GroundMotionError::Parameter { name, value, limit }) }
}

/// Refuses a parameter that is not positive and finite.
pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), GroundMotionError> {
    check_parameter(value > 0.0 && value.is_finite(), name, value, "positive and finite")
}

/// A fault in a text, before the name of its file is known.
#[derive(Debug, thiserror::Error)]
#[error("expected {expected}, found {found}; {remedy}")]
pub struct Fault {
    pub(crate) line: usize,
    pub(crate) expected: String,
    pub(crate) found: String,
    pub(crate) remedy: String,
}

impl Fault {
    pub(crate) fn new(
        line: usize,
        expected: impl Into<String>,
        found: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { line, expected: expected.into(), found: found.into(), remedy: remedy.into() }
    }

    /// Returns the line, from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// Makes a fault that quotes what was found in the file.
    pub(crate) fn excerpt(
        line: usize,
        expected: impl Into<String>,
        found: &str,
        remedy: impl Into<String>,
    ) -> Self {
        Self::new(line, expected, excerpt(found), remedy)
    }

    /// Makes the fault of a cell or field that should be a number; `remedy` is that of any other text.
    pub(crate) fn no_number(line: usize, expected: impl Into<String>, cell: &str, remedy: &str) -> Self {
        let remedy = match cell.trim() {
            "" => "the cell is empty: complete it",
            cell if cell.starts_with('#') => {
                "this is an error of a spreadsheet: correct its cell there and save the file again"
            }
            cell if cell.starts_with(char::is_alphabetic) && cell.parse::<f64>().is_err() => {
                "delete this line if it is a title or a summary; mark a comment with `# `; write numbers \
                 with digits"
            }
            cell if cell.contains("**") => {
                "asterisks stand for a number that was too wide for its field: write the file again with \
                 wider fields"
            }
            _ => remedy,
        };
        Self::excerpt(line, expected, cell, remedy)
    }

    /// Makes the fault of something wrong in a header, which it quotes.
    pub(crate) fn in_header(line: usize, expected: impl Into<String>, found: &str) -> Self {
        Self::excerpt(line, expected, found, "correct the header")
    }

    /// Makes the fault of something that a header does not have.
    pub(crate) fn missing(line: usize, expected: impl Into<String>) -> Self {
        Self::new(line, expected, "none", "complete the header")
    }

    pub(crate) fn in_file(self, file: &str) -> GroundMotionError {
        let Self { line, expected, found, remedy } = self;
        GroundMotionError::Content { file: file.to_owned(), line, expected, found, remedy }
    }
}

/// Quotes the start of a piece of a file, made printable for a message.
pub(crate) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 40;
    let shown: String = text.chars().take(LONGEST).map(shown).collect();
    let more = if text.chars().nth(LONGEST).is_some() { "…" } else { "" };
    format!("`{shown}{more}`")
}

/// Writes a character so that it can be seen: one that has no shape by its number, `U+202F`.
fn shown(c: char) -> String {
    match c {
        '\t' => " ".to_owned(),
        '"' | '\'' | '\\' => c.to_string(),
        _ if c.escape_debug().len() > 1 => format!("U+{:04X}", u32::from(c)),
        _ => c.to_string(),
    }
}

/// The remedy for a file whose numbers are not where they should be.
pub(crate) const DAMAGED: &str = "correct the file or fetch it again";

/// The remedy for a file that ends too early.
pub(crate) const CUT_SHORT: &str = "the file is cut short or damaged: fetch it again";

/// The remedy for a file with more samples than it states.
pub(crate) const TOO_MANY: &str =
    "the file has more samples than it states: correct the number, or remove what does not belong to it";

/// The remedy for samples at times that are not uniform.
pub(crate) const UNEVEN: &str =
    "unevenly spaced film data are not read: use the corrected record, or resample it to a uniform step";
