//! Getting and setting values (FMI 2.0.5, section 2.1.7; FMI 3.0.2, section 2.2.6). All variables are
//! scalars: the number of values, which FMI 3.0 states too, is that of references.

use super::arguments::{check_count, text, to_get, to_set};
use super::fmi3;
use super::guard::functions;
use super::types::{Boolean, Component, Integer, Real, Status, Text, ValueReference};
use crate::call::Call;
use crate::failure::Failure;
use crate::model::{Model, ModelExchange};
use crate::variable::Kind;

functions! {
    /// `fmi2GetString`, `fmi3GetString`
    ///
    /// The texts live until the next call of this for the instance.
    get_string<Model>(
        references: *const ValueReference, count: usize, values: *mut Text, value_count: usize
    ): GetString, |instance| {
        check_count("nValues", value_count, count)?;
        // SAFETY: `references` and `values` are NULL or point to `count` elements that nobody else changes
        // during the call.
        let (references, values) = unsafe { to_get(references, values, count, std::ptr::null()) }?;
        for (value, text) in values.iter_mut().zip(instance.get_string(references)?) {
            *value = text.as_ptr();
        }
        Ok(())
    };
    /// `fmi2SetString`, `fmi3SetString`
    ///
    /// If one value is refused, none is set.
    set_string<Model>(
        references: *const ValueReference, count: usize, values: *const Text, value_count: usize
    ): SetString, |instance| {
        check_count("nValues", value_count, count)?;
        // SAFETY: `references` and `values` are NULL or point to `count` elements that stay as they are
        // during the call.
        let (references, values) = unsafe { to_set(references, values, count) }?;
        let texts = values.iter().map(|&value| {
            // SAFETY: `value` is NULL or a text that ends with a NUL.
            unsafe { text("value", value) }?.ok_or_else(|| Failure::from("a value is NULL"))
        });
        instance.set_string(references, &texts.collect::<Result<Vec<_>, _>>()?)
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
                let (references, values) = unsafe { to_get(references, values, count, <$type>::default()) }?;
                instance.$get_by(references, values $(, $serves)?)
            };
            #[doc = concat!("Sets values of type `", stringify!($type), "`. If one is refused, none is set.")]
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
    Real as Real: get_real<Model> GetReal get_real, set_real SetReal set_real;
    Integer as Integer: get_integer<Model> GetInteger get_integer, set_integer SetInteger set_integer,
        |_| true;
    Boolean as Boolean: get_boolean<Model> GetBoolean get_boolean, set_boolean SetBoolean set_boolean;
}

// FMI 3.0 has other types
values! {
    f64 as f64: get_float64<ModelExchange> GetReal get_float64, set_float64 SetReal set_real;
    // a byte of C that is neither 0 nor 1 is no `bool` of Rust
    fmi3::types::Boolean as u8: get_bool<Model> GetBoolean get_boolean, set_bool SetBoolean set_boolean;
    i32 as i32: get_int32<Model> GetInteger get_integer, set_int32 SetInteger set_integer,
        |kind| matches!(kind, Kind::Integer { .. });
    i64 as i64: get_int64<Model> GetInt64 get_integer, set_int64 SetInt64 set_integer,
        |kind| matches!(kind, Kind::Enumeration { .. });
}
