//! Work shared by threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Does the work of each of some numbers, in their order, on `threads` threads; the first error ends it.
///
/// # Errors
/// That error.
pub fn each<E: Send>(
    numbers: &[usize],
    threads: usize,
    work: impl Fn(usize) -> Result<(), E> + Sync,
) -> Result<(), E> {
    let (next, stop, failure) = (AtomicUsize::new(0), AtomicBool::new(false), Mutex::new(None));
    let labour = || {
        while !stop.load(Ordering::Relaxed) {
            let Some(&index) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
            if let Err(error) = work(index) {
                stop.store(true, Ordering::Relaxed);
                // a poisoned lock would be that of a thread whose panic ends the scope below
                if let Ok(mut place) = failure.lock() {
                    place.get_or_insert(error);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.clamp(1, numbers.len().max(1)) {
            scope.spawn(labour);
        }
        labour();
    });
    failure.into_inner().ok().flatten().map_or(Ok(()), Err)
}
