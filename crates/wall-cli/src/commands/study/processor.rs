//! The time that a thread has spent on a processor. What other programs take of the processor does not count.

use std::cell::Cell;
use std::time::Duration;

thread_local! {
    /// The time of this thread when it was last asked for. A new thread begins at 0.
    static LAST: Cell<Duration> = const { Cell::new(Duration::ZERO) };
}

/// Begins to count on this thread, which may have worked before.
pub(super) fn begin() {
    LAST.set(of_thread());
}

/// Returns the time of this thread since it was last asked for \[s\].
pub(super) fn since_last() -> f64 {
    let now = of_thread();
    now.saturating_sub(LAST.replace(now)).as_secs_f64()
}

#[cfg(unix)]
fn of_thread() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    // a time of the system is in range
    clock_gettime(ClockId::ThreadCPUTime).try_into().unwrap_or_default()
}

/// Where the time of a thread is not known, that of a clock since [`begin`].
#[cfg(not(unix))]
fn of_thread() -> Duration {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}
