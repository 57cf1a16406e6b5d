//! NULL where an array belongs.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use crate::fmi2::*;
use crate::importer::{Call, Importer};
use crate::spring::{Boolean, Integer, Real, Text};
use fmu_export::ffi::types::{ERROR, OK};
use std::ptr::{null, null_mut};

#[test]
#[rustfmt::skip]
fn null_is_refused_where_something_is_needed() {
    let calls: [Call; 29] = [
        |c| unsafe { fmi2GetReal(c, null(), 1, &mut 0.0) },
        |c| unsafe { fmi2GetReal(c, &Real::X.reference(), 1, null_mut()) },
        |c| unsafe { fmi2SetReal(c, null(), 1, &0.0) },
        |c| unsafe { fmi2SetReal(c, &Real::Force.reference(), 1, null()) },
        |c| unsafe { fmi2GetInteger(c, null(), 1, &mut 0) },
        |c| unsafe { fmi2GetInteger(c, &Integer::Count.reference(), 1, null_mut()) },
        |c| unsafe { fmi2SetInteger(c, &Integer::Fault.reference(), 1, null()) },
        |c| unsafe { fmi2GetBoolean(c, null(), 1, &mut 0) },
        |c| unsafe { fmi2SetBoolean(c, &Boolean::Held.reference(), 1, null()) },
        |c| unsafe { fmi2GetString(c, &Text::Label.reference(), 1, null_mut()) },
        |c| unsafe { fmi2SetString(c, null(), 1, &c"".as_ptr()) },
        |c| unsafe { fmi2SetString(c, &Text::Label.reference(), 1, &null()) },
        |c| unsafe { fmi2SetRealInputDerivatives(c, &Real::Force.reference(), 1, null(), &0.0) },
        |c| unsafe { fmi2SetRealInputDerivatives(c, &Real::Force.reference(), 1, &1, null()) },
        |c| unsafe { fmi2GetRealOutputDerivatives(c, &Real::X.reference(), 1, null(), &mut 0.0) },
        |c| unsafe { fmi2GetRealOutputDerivatives(c, &Real::X.reference(), 1, &1, null_mut()) },
        |c| unsafe { fmi2GetDirectionalDerivative(c, null(), 1, &Real::X.reference(), 1, &1.0, &mut 0.0) },
        |c| unsafe { fmi2GetDirectionalDerivative(c, &Real::X.reference(), 1, null(), 1, &1.0, &mut 0.0) },
        |c| unsafe {
            let x = Real::X.reference();
            fmi2GetDirectionalDerivative(c, &x, 1, &x, 1, null(), &mut 0.0)
        },
        |c| unsafe {
            let x = Real::X.reference();
            fmi2GetDirectionalDerivative(c, &x, 1, &x, 1, &1.0, null_mut())
        },
        |c| unsafe { fmi2GetStatus(c, 0, null_mut()) },
        |c| unsafe { fmi2GetRealStatus(c, 2, null_mut()) },
        |c| unsafe { fmi2GetIntegerStatus(c, 0, null_mut()) },
        |c| unsafe { fmi2GetBooleanStatus(c, 3, null_mut()) },
        |c| unsafe { fmi2GetStringStatus(c, 1, null_mut()) },
        |c| unsafe { fmi2GetFMUstate(c, null_mut()) },
        |c| unsafe { fmi2DeSerializeFMUstate(c, null(), 8, &mut null_mut()) },
        |c| unsafe { fmi2SetDebugLogging(c, 1, 1, null()) },
        |c| unsafe { fmi2SetDebugLogging(c, 1, 1, &null()) },
    ];
    for (index, call) in calls.into_iter().enumerate() {
        let importer = Importer::in_step_mode();
        // SAFETY: the instance lives, and NULL is what is tested.
        assert_eq!(unsafe { call(importer.component) }, ERROR, "call {index}");
        importer.expect_error(&["NULL"]);
    }
}

#[test]
#[rustfmt::skip]
fn null_is_fine_for_nothing() {
    let calls: [Call; 13] = [
        |c| unsafe { fmi2GetReal(c, null(), 0, null_mut()) },
        |c| unsafe { fmi2SetReal(c, null(), 0, null()) },
        |c| unsafe { fmi2GetInteger(c, null(), 0, null_mut()) },
        |c| unsafe { fmi2SetInteger(c, null(), 0, null()) },
        |c| unsafe { fmi2GetBoolean(c, null(), 0, null_mut()) },
        |c| unsafe { fmi2SetBoolean(c, null(), 0, null()) },
        |c| unsafe { fmi2GetString(c, null(), 0, null_mut()) },
        |c| unsafe { fmi2SetString(c, null(), 0, null()) },
        |c| unsafe { fmi2SetRealInputDerivatives(c, null(), 0, null(), null()) },
        |c| unsafe { fmi2GetRealOutputDerivatives(c, null(), 0, null(), null_mut()) },
        |c| unsafe { fmi2GetDirectionalDerivative(c, null(), 0, null(), 0, null(), null_mut()) },
        |c| unsafe { fmi2SetDebugLogging(c, 1, 0, null()) },
        |c| unsafe { fmi2FreeFMUstate(c, null_mut()) },
    ];
    let importer = Importer::in_step_mode();
    for (index, call) in calls.into_iter().enumerate() {
        // SAFETY: the instance lives, and NULL is what is tested.
        assert_eq!(unsafe { call(importer.component) }, OK, "call {index}");
    }
    assert!(importer.journal.take().is_empty());
}

#[test]
fn arrays_that_cannot_be_are_refused() {
    let importer = Importer::in_step_mode();
    let (reference, mut value) = (Real::X.reference(), 0.0);
    // SAFETY: the instance lives; nothing is read before the count is refused.
    assert_eq!(unsafe { fmi2GetReal(importer.component, &reference, usize::MAX, &mut value) }, ERROR);
    importer.expect_error(&["cannot have 18446744073709551615 elements"]);
    let importer = Importer::in_step_mode();
    let odd = std::ptr::from_mut(&mut value).wrapping_byte_add(1);
    // SAFETY: the instance lives; nothing is written before the address is refused.
    assert_eq!(unsafe { fmi2GetReal(importer.component, &reference, 1, odd) }, ERROR);
    importer.expect_error(&["not aligned"]);
}
