//! Getting and setting values (FMI 3.0.2, section 2.2.6). All variables are scalars.

use super::types::Boolean;
use crate::call::Call;
use crate::ffi::arguments::{to_get, to_set};
use crate::ffi::common::{get_texts, set_texts};
use crate::ffi::guard::functions;
use crate::ffi::types::{Component, Status, Text, ValueReference};
use crate::model::{Failure, Model, ModelExchange};
use crate::variable::Kind;

functions! {
    /// `fmi3GetString`
    ///
    /// The texts live until the next call of this for the instance.
    get_string<Model>(
        references: *const ValueReference, count: usize, values: *mut Text, value_count: usize
    ): GetString, |instance| {
        check_count("nValues", value_count, count)?;
        // SAFETY: `references` and `values` are NULL or point to `count` elements that nobody else changes
        // during the call.
        unsafe { get_texts(instance, references, values, count) }
    };
    /// `fmi3SetString`
    set_string<Model>(
        references: *const ValueReference, count: usize, values: *const Text, value_count: usize
    ): SetString, |instance| {
        check_count("nValues", value_count, count)?;
        // SAFETY: `references` and `values` are NULL or point to `count` elements that stay as they are
        // during the call.
        unsafe { set_texts(instance, references, values, count) }
    };
}

/// Defines getters and setters of the values of a type, and how values to be set lie in memory.
macro_rules! values {
    ($(
        $type:ty as $stored:ty: $get:ident<$kind:ident> $get_call:ident $get_by:ident,
        $set:ident $set_call:ident $set_by:ident $(, $serves:expr)?;
    )*) => {
        functions! { $(
            #[doc = concat!("Gets values of type `", stringify!($type), "`.")]
            $get<$kind>(
                references: *const ValueReference, count: usize, values: *mut $type, value_count: usize
            ): $get_call, |instance| {
                check_count("nValues", value_count, count)?;
                // SAFETY: `references` and `values` are NULL or point to `count` elements, as many as
                // `value_count`, that nobody else changes during the call.
                let (references, values) = unsafe { to_get(references, values, count) }?;
                instance.$get_by(references, values $(, $serves)?)
            };
            #[doc = concat!("Sets values of type `", stringify!($type), "`.")]
            $set<Model>(
                references: *const ValueReference, count: usize, values: *const $type, value_count: usize
            ): $set_call, |instance| {
                check_count("nValues", value_count, count)?;
                // SAFETY: `references` and `values` are NULL or point to `count` elements, as many as
                // `value_count`, that stay as they are during the call. A stored element has the layout of
                // its C type.
                let (references, values) = unsafe { to_set(references, values.cast::<$stored>(), count) }?;
                instance.$set_by(references, values $(, $serves)?)
            };
        )* }
    };
}

values! {
    f64 as f64: get_float64<ModelExchange> GetReal get_float64, set_float64 SetReal set_real;
    // a byte of C that is neither 0 nor 1 is no `bool` of Rust
    Boolean as u8: get_boolean<Model> GetBoolean get_boolean, set_boolean SetBoolean set_boolean;
    i32 as i32: get_int32<Model> GetInteger get_integer, set_int32 SetInteger set_integer,
        |kind| matches!(kind, Kind::Integer { .. });
    i64 as i64: get_int64<Model> GetInt64 get_integer, set_int64 SetInt64 set_integer,
        |kind| matches!(kind, Kind::Enumeration { .. });
}

/// Refuses a number of values that is not that of the scalars they belong to.
pub(in crate::ffi) fn check_count(name: &str, given: usize, scalars: usize) -> Result<(), Failure> {
    if given == scalars {
        return Ok(());
    }
    Err(Failure(format!("{name} = {given}, but the value references are of {scalars} scalars")))
}
