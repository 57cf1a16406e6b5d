//! A line on the terminal: how much is done, and the time left.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use anyhow::Result;
use run::parallel::watched;

/// Time after which work has a line.
const LONG: Duration = Duration::from_millis(200);

/// Does work and shows its progress on one line where somebody sees it.
pub(crate) fn shown<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T> {
    if !std::io::stderr().is_terminal() {
        return Ok(work());
    }
    let start = Instant::now();
    let mut end = "";
    let outcome = watched(work, |done, all| {
        let time = start.elapsed();
        if done > 0 && time >= LONG {
            let left = time.as_secs_f64() / done as f64 * all.saturating_sub(done) as f64;
            to_terminal(&format!("\r{done} of {all} done, {:.1} min left   ", left / 60.0));
            end = "\n";
        }
        anyhow::Ok(())
    });
    to_terminal(end);
    outcome
}

/// Writes to the terminal; one that is lost is no reason to stop.
fn to_terminal(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
}
