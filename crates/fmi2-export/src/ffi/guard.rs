//! Calls of an instance: no panic leaves the library, and none is printed.

use super::types::{self, Component, ERROR, Status};
use crate::call::Call;
use crate::failure::Failure;
use crate::instance::Instance;
use crate::model::Model;
use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether this thread is inside a call from C.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
    /// Where the last panic inside a call from C happened.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Makes panics inside calls from C silent, in the copy of the standard library that this code is linked
/// with. Elsewhere the hook that was there before goes on.
pub fn install_panic_hook() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |information| {
            if !INSIDE.get() {
                return before(information);
            }
            if let Some(location) = information.location() {
                let place = format!("{}:{}", location.file(), location.line());
                // A thread that is ending has no place to keep it; a panic in here would abort.
                let _ = PLACE.try_with(|last| last.replace(place));
            }
        }));
    });
}

/// Returns the instance behind `component`; `None` for NULL.
///
/// # Safety
/// `component` is NULL or what `instantiate` of the same model returned and `free_instance` has not taken,
/// and no other thread uses it.
pub(super) unsafe fn instance<'a, M: Model>(component: Component) -> Option<&'a mut Instance<M>> {
    // SAFETY: as the caller promises.
    unsafe { component.cast::<Instance<M>>().as_mut() }
}

/// Lets the instance do `body`, if it is the turn of `call`.
pub(super) fn run<M: Model>(
    instance: Option<&mut Instance<M>>,
    call: Call,
    body: impl FnOnce(&mut Instance<M>) -> Result<(), Failure>,
) -> Status {
    let Some(instance) = instance else { return ERROR };
    let status = match catch(|| instance.call(call, body)) {
        Ok(status) => status,
        Err(panic) => instance.panicked(call, &panic),
    };
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
        pub unsafe fn $name<M: $kind>(component: Component, $($argument: $type),*) -> Status {
            // SAFETY: as the caller promises.
            let instance = unsafe { $crate::ffi::guard::instance::<M>(component) };
            $crate::ffi::guard::run(instance, Call::$call, $body)
        }
    )*};
}
pub(super) use functions;

/// Returns what `body` returns, or the message of its panic.
pub(super) fn catch<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    let outer = INSIDE.replace(true);
    // What the body may have left half done is dealt with by who asked: the instance counts as failed.
    let result = panic::catch_unwind(AssertUnwindSafe(body));
    INSIDE.set(outer);
    result.map_err(|payload| {
        let place = PLACE.try_with(RefCell::take).unwrap_or_default();
        format!("{} ({place})", message(payload))
    })
}

fn message(payload: Box<dyn Any + Send>) -> String {
    let payload = match payload.downcast::<String>() {
        Ok(text) => return *text,
        Err(payload) => payload,
    };
    match payload.downcast::<&'static str>() {
        Ok(text) => (*text).to_owned(),
        Err(payload) => {
            // Dropping what is unknown could panic in turn.
            std::mem::forget(payload);
            "panic without a text".to_owned()
        }
    }
}
