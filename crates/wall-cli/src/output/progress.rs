//! A line on the terminal: how much is done, and the time left.

use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How often the line is written anew.
const PAUSE: Duration = Duration::from_millis(200);

pub(crate) struct Progress {
    start: Instant,
    /// Finished parts, and when the line was last written; `None` where nobody sees it.
    state: Option<Mutex<(usize, Instant)>>,
}

/// Runs `work`, shows its progress on one line, then ends that line.
pub(crate) fn shown<T>(work: impl FnOnce(&Progress) -> T) -> T {
    let start = Instant::now();
    let state = std::io::stderr().is_terminal().then(|| Mutex::new((0, start)));
    let progress = Progress { start, state };
    let outcome = work(&progress);
    if progress.state.as_ref().is_some_and(|state| state.lock().is_ok_and(|state| state.0 > 0)) {
        to_terminal("\n");
    }
    outcome
}

impl Progress {
    /// Counts one more finished part of `total`.
    pub(crate) fn add(&self, total: usize) {
        let Some(Ok(mut state)) = self.state.as_ref().map(Mutex::lock) else { return };
        state.0 += 1;
        let (done, written) = *state;
        if written.elapsed() >= PAUSE || done == total {
            state.1 = Instant::now();
            let left = self.start.elapsed().as_secs_f64() / done as f64 * (total - done) as f64;
            to_terminal(&format!("\r{done} of {total} done, {:.1} min left   ", left / 60.0));
        }
    }
}

/// Writes to the terminal; one that is lost is no reason to stop.
fn to_terminal(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
}
