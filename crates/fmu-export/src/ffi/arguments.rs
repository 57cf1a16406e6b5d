//! What C passes, as Rust sees it.

use super::types::{Text, ValueReference};
use crate::failure::Failure;
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::{slice, str};

/// The array of `count` elements at `start`. NULL is fine if it is empty.
///
/// # Safety
/// `start` is NULL or points to `count` elements that nobody changes during `'a`.
pub(super) unsafe fn array<'a, T>(name: &str, start: *const T, count: usize) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check_array(name, start, count)?;
    // SAFETY: `check_array` has refused NULL, misaligned and oversized arrays; `start` points to `count`
    // elements that nobody changes during `'a`.
    Ok(unsafe { slice::from_raw_parts(start, count) })
}

/// The array of `count` elements at `start` to be written, each set to `blank` whatever is in it.
///
/// # Safety
/// `start` is NULL or points to room for `count` elements that nobody else uses during `'a`.
pub(super) unsafe fn array_mut<'a, T: Copy>(
    name: &str,
    start: *mut T,
    count: usize,
    blank: T,
) -> Result<&'a mut [T], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check_array(name, start, count)?;
    for index in 0..count {
        // SAFETY: `start` points to room for `count` elements, and `check_array` has refused NULL,
        // misaligned and oversized arrays.
        unsafe { start.add(index).write(blank) };
    }
    // SAFETY: the loop has written every element; nobody else uses them during `'a`.
    Ok(unsafe { slice::from_raw_parts_mut(start, count) })
}

/// References, and room for their values, each set to `blank`.
///
/// # Safety
/// As for [`array`] and [`array_mut`].
pub(super) unsafe fn to_get<'a, T: Copy>(
    references: *const ValueReference,
    values: *mut T,
    count: usize,
    blank: T,
) -> Result<(&'a [ValueReference], &'a mut [T]), Failure> {
    // SAFETY: `references` and `values` are NULL or point to `count` elements, those of `values` used by
    // nobody else during `'a`.
    unsafe { Ok((array("vr", references, count)?, array_mut("value", values, count, blank)?)) }
}

/// References and their values.
///
/// # Safety
/// As for [`array`].
pub(super) unsafe fn to_set<'a, T>(
    references: *const ValueReference,
    values: *const T,
    count: usize,
) -> Result<(&'a [ValueReference], &'a [T]), Failure> {
    // SAFETY: `references` and `values` are NULL or point to `count` elements that nobody changes during
    // `'a`.
    unsafe { Ok((array("vr", references, count)?, array("value", values, count)?)) }
}

/// The place at `target`, whatever is in it.
///
/// # Safety
/// As for [`array_mut`] with one element.
pub(super) unsafe fn place<'a, T>(name: &str, target: *mut T) -> Result<&'a mut MaybeUninit<T>, Failure> {
    check_array(name, target, 1)?;
    // SAFETY: `check_array` has refused NULL and misaligned places; `target` points to room for one value
    // that nobody else uses during `'a`.
    Ok(unsafe { &mut *target.cast() })
}

/// The text at `start`. None if it is NULL.
///
/// # Safety
/// As for [`bytes`].
pub(super) unsafe fn text<'a>(name: &str, start: Text) -> Result<Option<&'a str>, Failure> {
    // SAFETY: `start` is NULL or points to a text that ends with a NUL and that nobody changes during `'a`.
    let bytes = unsafe { bytes(start) };
    bytes.map(|bytes| str::from_utf8(bytes).map_err(|_| Failure(format!("{name} is not UTF-8")))).transpose()
}

/// The bytes of the text at `start`, whatever their encoding. None if it is NULL.
///
/// # Safety
/// `start` is NULL or points to a text that ends with a NUL and that nobody changes during `'a`.
pub(super) unsafe fn bytes<'a>(start: Text) -> Option<&'a [u8]> {
    if start.is_null() {
        return None;
    }
    // SAFETY: `start` is not NULL and points to a text that ends with a NUL and that nobody changes during
    // `'a`.
    Some(unsafe { CStr::from_ptr(start) }.to_bytes())
}

/// The text at `start`, which is not NULL.
///
/// # Safety
/// As for [`text`].
pub(super) unsafe fn required_text<'a>(name: &str, start: Text) -> Result<&'a str, Failure> {
    // SAFETY: `start` is NULL or points to a text that ends with a NUL and that nobody changes during `'a`.
    unsafe { text(name, start) }?.ok_or_else(|| Failure(format!("{name} is NULL")))
}

/// Refuses a number of values that is not that of the scalars they belong to.
///
/// # Errors
/// [`Failure`] with both counts.
pub fn check_count(name: &str, given: usize, scalars: usize) -> Result<(), Failure> {
    if given == scalars {
        return Ok(());
    }
    Err(Failure(format!("{name} = {given}, but the value references are of {scalars} scalars")))
}

fn check_array<T>(name: &str, start: *const T, count: usize) -> Result<(), Failure> {
    if start.is_null() {
        return Err(Failure(format!("{name} is NULL")));
    }
    if !start.is_aligned() {
        return Err(Failure(format!("{name} is not aligned to its type")));
    }
    let fits = count.checked_mul(size_of::<T>()).is_some_and(|size| isize::try_from(size).is_ok());
    if fits { Ok(()) } else { Err(Failure(format!("{name} cannot have {count} elements"))) }
}
