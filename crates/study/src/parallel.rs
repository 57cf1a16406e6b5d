//! Work shared by threads.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Most threads: more would wait for one another, and a system that has no more to give would end the program.
const MOST_THREADS: usize = 512;

/// The threads asked for, or one for each core.
#[must_use]
pub fn threads(given: Option<NonZeroUsize>) -> NonZeroUsize {
    given.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
}

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
        for _ in 1..threads.clamp(1, numbers.len().clamp(1, MOST_THREADS)) {
            scope.spawn(labour);
        }
        labour();
    });
    failure.into_inner().ok().flatten().map_or(Ok(()), Err)
}

/// The results of pieces of work 0, 1, … below `count`, in their order, on `threads` threads.
///
/// # Errors
/// That of the first piece, in their order, that failed.
pub fn map<T: Send, E: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let next = AtomicUsize::new(0);
    let places: Vec<Mutex<Option<Result<T, E>>>> = (0..count).map(|_| Mutex::new(None)).collect();
    let labour = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(place) = places.get(index) else { return };
            let result = work(index);
            if result.is_err() {
                // pieces before this one are under way or done; none after it can be the first to fail
                next.store(count, Ordering::Relaxed);
            }
            if let Ok(mut place) = place.lock() {
                *place = Some(result);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.clamp(1, count.clamp(1, MOST_THREADS)) {
            scope.spawn(labour);
        }
        labour();
    });
    // a place left empty lies behind a failure
    places.into_iter().filter_map(|place| place.into_inner().ok().flatten()).collect()
}
