//! Work shared by threads, which another thread can watch and stop.
//!
//! A thread that works for [`watched`], and those that [`each`] starts for it, have a variable of their own.
//! There they count what is done and see that they are to stop. So no function between hands this on.

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

/// Most threads. More would only wait for one another.
const MOST_THREADS: usize = 512;
/// Stack of each thread that works on runs \[bytes\]: what the main thread of Linux and macOS has.
/// Unoptimised vectors of the record path need more than the 2 MiB that Rust gives.
pub const STACK: usize = 8 << 20;

/// Returns the number of threads asked for, or one for each core.
pub fn threads(given: Option<NonZeroUsize>) -> NonZeroUsize {
    given.or_else(|| thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
}

/// Time between two looks at work that is watched.
const LOOK: Duration = Duration::from_millis(50);

/// What work and the thread that watches it share.
#[derive(Default)]
struct Watch {
    is_to_stop: AtomicBool,
    done: AtomicUsize,
    all: AtomicUsize,
}

thread_local! {
    static WATCH: RefCell<Option<Arc<Watch>>> = const { RefCell::new(None) };
}

/// Does work on another thread, whose result it returns. Several times a second, and at the end, it calls
/// `look` with the number of parts that are [done](count_done) and that of all.
///
/// ```
/// use run::parallel::{each, watched};
///
/// let endless = || each(usize::MAX, 2, |_| Ok::<_, String>(()));
/// let stopped = watched(endless, |_, _| Err(std::io::Error::other("enough")));
/// assert_eq!(stopped.unwrap_err().to_string(), "enough");
/// ```
///
/// # Errors
/// That of `look`, which stops the work between two numbers of [`each`], or where it calls
/// [`stop_if_asked`]. That of a system that refuses the thread.
pub fn watched<T: Send, E: From<std::io::Error>>(
    work: impl FnOnce() -> T + Send,
    mut look: impl FnMut(usize, usize) -> Result<(), E>,
) -> Result<T, E> {
    let watch = Arc::new(Watch::default());
    let of_work = Some(Arc::clone(&watch));
    // closed when the work ends, by a panic too
    let (sender, receiver) = mpsc::channel::<()>();
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || {
            let _closed = sender;
            WATCH.set(of_work);
            work()
        })?;
        let looked = loop {
            let is_done = receiver.recv_timeout(LOOK) != Err(RecvTimeoutError::Timeout);
            let looked = look(watch.done.load(Ordering::Relaxed), watch.all.load(Ordering::Relaxed));
            if is_done || looked.is_err() {
                break looked;
            }
        };
        watch.is_to_stop.store(looked.is_err(), Ordering::Relaxed);
        let outcome = thread.join();
        looked.map(|()| outcome.unwrap_or_else(|panic| resume_unwind(panic)))
    })
}

/// Counts one more finished part of all, for the thread that watches.
pub fn count_done(all: usize) {
    WATCH.with_borrow(|watch| {
        if let Some(watch) = watch {
            watch.all.store(all, Ordering::Relaxed);
            watch.done.fetch_add(1, Ordering::Relaxed);
        }
    });
}

/// Ends work that is to stop: unwinds, without a message, to [`watched`].
pub fn stop_if_asked() {
    if is_to_stop() {
        resume_unwind(Box::new("stopped"));
    }
}

fn is_to_stop() -> bool {
    WATCH.with_borrow(|watch| watch.as_ref().is_some_and(|watch| watch.is_to_stop.load(Ordering::Relaxed)))
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

/// Works on each of the numbers 0, 1, … below `count`, which start in this order, on `threads` threads. Work
/// on a number does not call this again.
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
            if index >= count || is_to_stop() {
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
    let watch = WATCH.with_borrow(Clone::clone);
    thread::scope(|scope| {
        for _ in 1..threads.clamp(1, count.clamp(1, MOST_THREADS)) {
            let thread = thread::Builder::new().stack_size(STACK);
            let watch = watch.clone();
            let work = || {
                WATCH.set(watch);
                worker();
            };
            // a system that refuses one more thread leaves the work to those there are
            if thread.spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        worker();
    });
    stop_if_asked();
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
