//! Errors of the libraries as exceptions with the same messages.

use std::fmt::Display;
use std::io::ErrorKind;
use std::path::Path;

use files::FileError;
use ground_motion::GroundMotionError;
use pyo3::PyErr;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyRuntimeError, PyValueError};
use scene::SceneError;

/// Makes a `ValueError`: something given cannot be used.
pub(crate) fn refused(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Makes a `RuntimeError`: a run could not be followed to its end.
pub(crate) fn failed(error: impl Display) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Makes the exception of a file: `FileNotFoundError` where there is none.
pub(crate) fn of_file(error: impl Display, path: &Path) -> PyErr {
    if path.exists() { refused(error) } else { PyFileNotFoundError::new_err(error.to_string()) }
}

/// Makes the exception of a record: `OSError` where its file cannot be read.
pub(crate) fn of_motion(error: GroundMotionError) -> PyErr {
    match &error {
        GroundMotionError::Io { reason, .. } if reason.kind() == ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(error.to_string())
        }
        GroundMotionError::Io { reason, .. } if reason.kind() != ErrorKind::InvalidInput => {
            PyOSError::new_err(error.to_string())
        }
        _ => refused(error),
    }
}

/// Makes the exception of a scene or a study: `FileNotFoundError` where there is no such file.
pub(crate) fn of_scene(error: SceneError) -> PyErr {
    match &error {
        SceneError::File(FileError { file, line: None, .. }) => of_file(&error, Path::new(file)),
        SceneError::Run(_) => failed(error),
        _ => refused(error),
    }
}
