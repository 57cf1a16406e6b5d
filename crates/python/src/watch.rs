//! The number of threads that a user asks for, and work on another thread while this one looks at Ctrl-C.

use std::num::NonZeroUsize;

use pyo3::prelude::*;
use run::parallel;

use crate::errors::refused;

/// Does work on another thread, while this one looks at Ctrl-C and calls `report` with the number of finished
/// parts.
///
/// # Errors
/// `KeyboardInterrupt`, or the error of `report`; the work has then ended. `OSError` where the system refuses
/// the thread.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send,
    report: impl Fn(Python<'_>, usize) -> PyResult<()> + Sync,
) -> PyResult<T> {
    let look = |done, _| Python::attach(|py| py.check_signals().and_then(|()| report(py, done)));
    py.detach(|| parallel::watched(work, look))
}

/// Does work on another thread, while this one looks at Ctrl-C.
///
/// # Errors
/// As [`watched`].
pub(crate) fn stoppable<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    watched(py, work, |_, _| Ok(()))
}

/// Returns the number of threads asked for, or one for each core.
///
/// # Errors
/// `ValueError` for a number below 1.
pub(crate) fn threads_of(given: Option<i64>) -> PyResult<NonZeroUsize> {
    let number = given.map(|given| {
        let number = usize::try_from(given).ok().and_then(NonZeroUsize::new);
        number.ok_or_else(|| refused(format!("threads = {given} must be from 1 on, or None for all cores")))
    });
    Ok(parallel::threads(number.transpose()?))
}
