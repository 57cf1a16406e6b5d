//! The functions that WebAssembly exports: bytes in, bytes out.
//!
//! The page asks for space with `reserve`, writes into it, and calls `answer` (the bytes are a request) or
//! `keep_record` (they are a record file). `answer` returns the length of the answer that `reply` points to.
//! Both buffers stay where they are until the next `reserve` or `answer`.

use std::cell::RefCell;

use crate::Session;

/// The session and the two buffers of the page.
#[derive(Default)]
struct Page {
    session: Session,
    input: Vec<u8>,
    output: String,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Returns where the page may write `length` bytes.
// SAFETY: no other symbol has this name.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
extern "C" fn reserve(length: usize) -> *mut u8 {
    PAGE.with_borrow_mut(|page| {
        page.input.clear();
        page.input.resize(length, 0);
        page.input.as_mut_ptr()
    })
}

/// Keeps what was written as the record file.
// SAFETY: no other symbol has this name.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
extern "C" fn keep_record() {
    PAGE.with_borrow_mut(|page| page.session.keep_record(std::mem::take(&mut page.input)));
}

/// Answers the request that was written; returns the length of the answer in bytes.
// SAFETY: no other symbol has this name.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
extern "C" fn answer() -> usize {
    PAGE.with_borrow_mut(|page| {
        let request = String::from_utf8_lossy(&page.input);
        page.output = page.session.answer(&request);
        page.output.len()
    })
}

/// Returns where the answer is.
// SAFETY: no other symbol has this name.
#[unsafe(no_mangle)]
#[allow(unsafe_code)]
extern "C" fn reply() -> *const u8 {
    PAGE.with_borrow(|page| page.output.as_ptr())
}
