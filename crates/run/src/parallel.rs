//! Work shared by threads.

use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Most threads. More would only wait for one another.
const MOST_THREADS: usize = 512;
/// Stack of each thread that works on runs \[bytes\]: what the main thread of Linux and macOS has.
/// Unoptimised vectors of the record path need more than the 2 MiB that Rust gives.
pub const STACK: usize = 8 << 20;

/// Returns the number of threads asked for, or one for each core.
pub fn threads(given: Option<NonZeroUsize>) -> NonZeroUsize {
    given.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
}

/// Maps the numbers 0, 1, … below `count` on `threads` threads and returns the results in their order.
///
/// ```
/// let squares = run::parallel::map(4, 2, |index| Ok::<_, String>(index * index));
/// assert_eq!(squares, Ok(vec![0, 1, 4, 9]));
/// ```
///
/// # Errors
/// The error of the first number, in their order, whose work failed. No work starts after a failure.
pub fn map<T: Send, E: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> Result<T, E> + Sync,
) -> Result<Vec<T>, E> {
    let slots: Vec<Mutex<Option<T>>> = (0..count).map(|_| Mutex::new(None)).collect();
    each(count, threads, |index| {
        let result = work(index)?;
        // only the panic of a thread could poison the lock, and a panic ends the scope
        if let Ok(mut slot) = slots[index].lock() {
            *slot = Some(result);
        }
        Ok(())
    })?;
    Ok(slots.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect())
}

/// Works on each of the numbers 0, 1, … below `count`, which start in this order, on `threads` threads.
///
/// # Errors
/// As [`map`].
pub fn each<E: Send>(
    count: usize,
    threads: usize,
    work: impl Fn(usize) -> Result<(), E> + Sync,
) -> Result<(), E> {
    #[cfg(all(target_env = "gnu", target_pointer_width = "64"))]
    keep_freed_memory();
    let next = AtomicUsize::new(0);
    let failure: Mutex<Option<(usize, E)>> = Mutex::new(None);
    let worker = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return;
            }
            let Err(error) = work(index) else { continue };
            // lower numbers are running or done, and no higher one can be the first to fail
            next.store(count, Ordering::Relaxed);
            if let Ok(mut failure) = failure.lock()
                && failure.as_ref().is_none_or(|(first, _)| index < *first)
            {
                *failure = Some((index, error));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.clamp(1, count.clamp(1, MOST_THREADS)) {
            let thread = std::thread::Builder::new().stack_size(STACK);
            // a system that refuses one more thread leaves the work to those there are
            if thread.spawn_scoped(scope, worker).is_err() {
                break;
            }
        }
        worker();
    });
    failure.into_inner().ok().flatten().map_or(Ok(()), |(_, error)| Err(error))
}

/// Lets the memory of some runs serve the next ones. Otherwise glibc returns it to the system each time, and
/// a twentieth of a study's time goes into getting it back. It keeps as much as twice the largest block
/// of up to 32 MiB that was ever freed (mallopt(3), `M_MMAP_THRESHOLD`); nothing is written to this one.
#[cfg(all(target_env = "gnu", target_pointer_width = "64"))]
fn keep_freed_memory() {
    let mut block = Vec::<u8>::new();
    // without this much memory, studies are slower
    let _ = block.try_reserve_exact(31 << 20);
    drop(std::hint::black_box(block));
}
