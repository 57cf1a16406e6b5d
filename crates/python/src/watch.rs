//! The number of threads that a user asks for, and work on another thread while this one looks at Ctrl-C.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use run::parallel::{self, STACK};

use crate::errors::refused;

/// Time between two looks at Ctrl-C and at the progress.
const LOOK: Duration = Duration::from_millis(50);

/// Does work on another thread and returns its result. That thread asks from time to time whether the result
/// is still wanted. This thread looks at Ctrl-C and calls `report`.
///
/// # Errors
/// `KeyboardInterrupt`, or the error of `report`; the work has then ended. `OSError` where the system refuses
/// the thread.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
    report: impl Fn() -> PyResult<()>,
) -> PyResult<T> {
    let asked_to_stop = AtomicBool::new(false);
    let is_wanted = || !asked_to_stop.load(Ordering::Relaxed);
    // closed when the work ends, by a panic too
    let (sender, mut receiver) = mpsc::channel::<()>();
    let (outcome, watched) = thread::scope(|scope| {
        let is_wanted = &is_wanted;
        let thread = thread::Builder::new().stack_size(STACK);
        let work = thread.spawn_scoped(scope, move || {
            let _closed = sender;
            work(is_wanted)
        })?;
        let mut watched = Ok(());
        while watched.is_ok() {
            let receiver = &mut receiver;
            if py.detach(move || receiver.recv_timeout(LOOK)) != Err(RecvTimeoutError::Timeout) {
                break;
            }
            watched = py.check_signals().and_then(|()| report());
        }
        asked_to_stop.store(watched.is_err(), Ordering::Relaxed);
        PyResult::Ok((py.detach(|| work.join()), watched))
    })?;
    let outcome = outcome.unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    watched.map(|()| outcome)
}

/// Returns the number of threads asked for, or one for each core.
///
/// # Errors
/// `ValueError` for a whole number below 1, `TypeError` for anything else.
pub(crate) fn threads_of(given: Option<&Bound<'_, PyAny>>) -> PyResult<NonZeroUsize> {
    let number = given.map(|given| {
        given.extract::<NonZeroUsize>().or_else(|_| {
            let shown = given.repr()?;
            let message =
                format!("threads = {shown} must be a whole number from 1 on, or None for one for each core");
            let is_whole = given.hasattr("__index__")?;
            Err(if is_whole { refused(message) } else { PyTypeError::new_err(message) })
        })
    });
    Ok(parallel::threads(number.transpose()?))
}
