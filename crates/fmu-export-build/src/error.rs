//! What can be wrong with a description.

use std::path::PathBuf;

/// Why [`generate`](crate::generate) gave up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum DescriptionError {
    /// The description cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    /// The generated module cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    /// The description contradicts itself or FMI 2.0.
    #[error("{}:{}: {}", path.display(), fault.line, fault.problem)]
    Invalid { path: PathBuf, fault: Fault },
}

/// What FMI 2.0 forbids in a description and the schema cannot always say.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct Fault {
    /// 1-based line of the XML.
    pub line: usize,
    /// What is wrong there.
    pub problem: String,
}

impl Fault {
    pub(crate) fn new(line: usize, problem: impl Into<String>) -> Self {
        Self { line, problem: problem.into() }
    }
}
