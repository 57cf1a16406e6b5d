//! A line on the terminal: how much is done, how fast, and the time left.

use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::time::{Duration, Instant};

const BAR: usize = 30;
/// How often the line is written anew.
const PAUSE: Duration = Duration::from_millis(200);

pub(crate) struct Progress {
    start: Instant,
    state: Mutex<State>,
    shown: bool,
}

struct State {
    done: usize,
    runs: usize,
    written: Instant,
}

/// Runs `work`, shows its progress on one line, then ends that line.
pub(crate) fn shown<T>(work: impl FnOnce(&Progress) -> T) -> T {
    let now = Instant::now();
    let state = Mutex::new(State { done: 0, runs: 0, written: now });
    let progress = Progress { start: now, state, shown: std::io::stderr().is_terminal() };
    let outcome = work(&progress);
    if progress.shown && progress.state.lock().is_ok_and(|state| state.done > 0) {
        to_terminal("\n");
    }
    outcome
}

impl Progress {
    /// Counts one more finished part, with its number of runs.
    pub(crate) fn add(&self, total: usize, runs: usize) {
        let Ok(mut state) = self.state.lock() else { return };
        state.done += 1;
        state.runs += runs;
        let now = Instant::now();
        if self.shown && (now - state.written >= PAUSE || state.done == total) {
            state.written = now;
            let seconds = (now - self.start).as_secs_f64();
            let left = seconds / state.done as f64 * (total - state.done) as f64;
            let full = BAR * state.done / total;
            let rate = match state.runs {
                0 => String::new(),
                runs => format!("  {:.0} runs/s", runs as f64 / seconds),
            };
            to_terminal(&format!(
                "\r[{}{}] {}/{total}{rate}  {} left   ",
                "#".repeat(full),
                "-".repeat(BAR - full),
                state.done,
                words(left)
            ));
        }
    }
}

/// Writes to the terminal; one that is lost is no reason to stop.
fn to_terminal(text: &str) {
    let mut stderr = std::io::stderr().lock();
    let _ = stderr.write_all(text.as_bytes()).and_then(|()| stderr.flush());
}

/// A time in words.
fn words(seconds: f64) -> String {
    if seconds < 90.0 {
        format!("{seconds:.0} s")
    } else if seconds < 5400.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}
