//! A line on the terminal: how much is done, how fast, how long yet.

#![allow(clippy::print_stderr, reason = "the line of progress")]

use std::io::{IsTerminal, Write};
use std::sync::Mutex;
use std::time::{Duration, Instant};

const BAR: usize = 30;
/// How often the line is written anew.
const PAUSE: Duration = Duration::from_millis(200);

pub(super) struct Progress {
    /// Combinations to run.
    total: usize,
    start: Instant,
    state: Mutex<State>,
    shown: bool,
}

struct State {
    done: usize,
    runs: usize,
    written: Instant,
}

impl Progress {
    pub(super) fn new(total: usize) -> Self {
        let now = Instant::now();
        let state = Mutex::new(State { done: 0, runs: 0, written: now });
        Self { total, start: now, state, shown: std::io::stderr().is_terminal() }
    }

    /// One more combination of so many runs is finished.
    pub(super) fn add(&self, runs: usize) {
        let Ok(mut state) = self.state.lock() else { return };
        state.done += 1;
        state.runs += runs;
        let now = Instant::now();
        if self.shown && (now - state.written >= PAUSE || state.done == self.total) {
            state.written = now;
            let seconds = (now - self.start).as_secs_f64();
            let left = seconds / state.done as f64 * (self.total - state.done) as f64;
            let full = BAR * state.done / self.total;
            eprint!(
                "\r[{}{}] {}/{}  {:.0} runs/s  {} left   ",
                "#".repeat(full),
                "-".repeat(BAR - full),
                state.done,
                self.total,
                state.runs as f64 / seconds,
                words(left)
            );
            // a terminal that is gone is no reason to stop
            let _ = std::io::stderr().flush();
        }
    }

    /// Ends the line.
    pub(super) fn finish(&self) {
        if self.shown && self.total > 0 {
            eprintln!();
        }
    }
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
