//! The number of threads that a user asks for.

use std::num::NonZeroUsize;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use run::parallel;

use crate::errors::refused;

/// A number of threads.
pub(crate) struct Threads(NonZeroUsize);

impl<'py> FromPyObject<'_, 'py> for Threads {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let message = || {
            let shown = given.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
            format!("threads = {shown} must be a whole number from 1 on, or None for one for each core")
        };
        let is_whole = given.hasattr("__index__")?;
        let number = given.extract::<NonZeroUsize>();
        number
            .map(Self)
            .map_err(|_| if is_whole { refused(message()) } else { PyTypeError::new_err(message()) })
    }
}

/// Returns the number of threads asked for, or one for each core.
pub(crate) fn count(given: Option<Threads>) -> NonZeroUsize {
    parallel::threads(given.map(|Threads(number)| number))
}
