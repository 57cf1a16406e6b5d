//! Calls of an instance: one at a time; no panic leaves the library, and none is printed.

use super::types::{self, Component, ERROR, Status};
use crate::call::Call;
use crate::failure::Failure;
use crate::instance::Instance;
use crate::model::Model;
use std::cell::{Cell, RefCell, UnsafeCell};
use std::panic::{self, AssertUnwindSafe};
use std::ptr::NonNull;
use std::sync::Once;
use std::sync::atomic::{AtomicU8, Ordering};

thread_local! {
    /// Whether this thread is inside a call from C.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
    /// Place and message of the last panic inside a call from C.
    static PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Makes panics inside calls from C silent, in the copy of the standard library that this code is linked
/// with. Other panics go to the hook that was installed before.
pub(super) fn install_panic_hook() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |information| {
            if !INSIDE.get() {
                return before(information);
            }
            // A thread that is ending has no place to keep it; a panic in here would abort.
            let _ = PANIC.try_with(|last| last.replace(information.to_string().replace(":\n", ": ")));
        }));
    });
}

/// What an `fmi2Component` points to. One call at a time has the instance; a logger that calls back is
/// refused.
pub(super) struct Slot<M: Model> {
    instance: UnsafeCell<Instance<M>>,
    use_now: AtomicU8,
}

/// Nobody uses the instance.
const IDLE: u8 = 0;
/// A call is under way.
const BUSY: u8 = 1;
/// The importer has freed the instance; a call that is under way drops it at its end.
const FREED: u8 = 2;

impl<M: Model> Slot<M> {
    pub(super) fn component(instance: Instance<M>) -> Component {
        let slot = Self { instance: UnsafeCell::new(instance), use_now: AtomicU8::new(IDLE) };
        Box::into_raw(Box::new(slot)).cast()
    }

    fn change(&self, from: u8, to: u8) -> bool {
        self.use_now.compare_exchange(from, to, Ordering::AcqRel, Ordering::Relaxed).is_ok()
    }
}

/// Frees an instance: at once, or at the end of the call that is under way.
///
/// # Safety
/// `component` is NULL or what [`Slot::component`] of the same model returned and that has not been dropped.
pub(super) unsafe fn free<M: Model>(component: Component) {
    let slot = component.cast::<Slot<M>>();
    // SAFETY: `component` is NULL or a slot that has not been dropped.
    if unsafe { slot.as_ref() }.is_some_and(|slot| slot.use_now.swap(FREED, Ordering::AcqRel) == IDLE) {
        // SAFETY: `slot` is not NULL, no call is under way, and none begins on a freed instance.
        unsafe { drop_slot(slot) };
    }
}

/// # Safety
/// `slot` lives, and nobody uses it any more.
unsafe fn drop_slot<M: Model>(slot: *mut Slot<M>) {
    // If dropping the model panics, there is no instance left to report it.
    // SAFETY: `slot` came from `Box::into_raw`, has not been dropped, and nobody uses it any more.
    let _ = catch(|| drop(unsafe { Box::from_raw(slot) }));
}

/// An instance that lives until it is freed; `None` for NULL.
pub(super) struct Handle<M: Model>(Option<NonNull<Slot<M>>>);

/// Returns the instance behind `component`.
///
/// # Safety
/// `component` is NULL or what [`Slot::component`] of the same model returned and that has not been dropped.
/// It is not freed before the handle is used.
pub(super) unsafe fn instance<M: Model>(component: Component) -> Handle<M> {
    Handle(NonNull::new(component.cast()))
}

/// Runs `body` on the instance, if no other call is under way and `call` is allowed in the present phase.
pub(super) fn run<M: Model>(
    Handle(slot): Handle<M>,
    call: Call,
    body: impl FnOnce(&mut Instance<M>) -> Result<(), Failure>,
) -> Status {
    let Some(pointer) = slot else { return ERROR };
    // SAFETY: the handle points to a slot that has not been dropped, and it is not freed before this use.
    let slot = unsafe { pointer.as_ref() };
    if !slot.change(IDLE, BUSY) {
        return ERROR;
    }
    // SAFETY: whoever has changed the slot to busy has the instance alone.
    let instance = unsafe { &mut *slot.instance.get() };
    let status = match catch(|| instance.call(call, body)) {
        Ok(status) => status,
        Err(panic) => instance.panicked(call, &panic),
    };
    if !slot.change(BUSY, IDLE) {
        // SAFETY: the importer has freed the instance during this call, so that no other call begins, and
        // this one uses the slot no more.
        unsafe { drop_slot(pointer.as_ptr()) };
    }
    types::status(status)
}

/// Defines functions of an instance of a model: `name<kind of model>(arguments): call, what the instance
/// does`.
macro_rules! functions {
    ($(
        $(#[$doc:meta])*
        $name:ident<$kind:ident>($($argument:ident: $type:ty),*): $call:ident, $body:expr;
    )*) => {$(
        $(#[$doc])*
        ///
        /// # Safety
        /// `component` is NULL or an instance; pointers are NULL or point to what the standard says, arrays
        /// to as many elements as stated; texts end with a NUL.
        #[allow(clippy::too_many_arguments, reason = "the standard's")]
        pub unsafe fn $name<M: $kind>(component: Component, $($argument: $type),*) -> Status {
            // SAFETY: `component` is NULL or an instance of this model that the importer has not freed.
            let instance = unsafe { $crate::ffi::guard::instance::<M>(component) };
            $crate::ffi::guard::run(instance, Call::$call, $body)
        }
    )*};
}
pub(super) use functions;

/// Returns what `body` returns, or the place and the message of its panic.
pub(super) fn catch<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    let outer = INSIDE.replace(true);
    // The body may have left the instance inconsistent. The caller handles that: the instance then counts as
    // failed.
    let result = panic::catch_unwind(AssertUnwindSafe(body));
    INSIDE.set(outer);
    result.map_err(|payload| {
        // Dropping a payload of unknown type could panic in turn.
        std::mem::forget(payload);
        PANIC.try_with(RefCell::take).unwrap_or_default()
    })
}
