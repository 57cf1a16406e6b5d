//! Values, steps, states and derivatives of FMI 3.0.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use crate::derivatives::set_rate;
use crate::fmi3::*;
use crate::fmi3_order::Fmi3;
use crate::importer::{Call, Importer};
use crate::spring::{Boolean, EVENT_IN_STEP, Integer, Real, Text};
use fmu_export::ffi::types::{Component, ERROR, OK, Status};
use fmu_export::{FIRST_INDICATOR_REFERENCE, TIME_REFERENCE};
use std::cell::Cell;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

fn get(importer: &Importer, reference: u32) -> f64 {
    let mut value = f64::NAN;
    assert_eq!(unsafe { fmi3GetFloat64(importer.component, &reference, 1, &mut value, 1) }, OK);
    value
}

/// What a step came to: status, event handling needed, early return, last successful time.
pub fn step(importer: &Importer, point: f64, size: f64) -> (Status, bool, bool, f64) {
    let (mut event, mut terminate, mut early, mut last) = (true, true, true, f64::NAN);
    let status = unsafe {
        fmi3DoStep(importer.component, point, size, true, &mut event, &mut terminate, &mut early, &mut last)
    };
    assert!(!terminate);
    (status, event, early, last)
}

#[test]
fn each_type_has_its_own_functions() {
    let importer = Fmi3::co_simulation(false, false);
    let c = importer.component;
    unsafe {
        assert_eq!(fmi3SetInt64(c, &Integer::Law.reference(), 1, &2, 1), OK);
        assert_eq!(fmi3SetInt32(c, &Integer::Substeps.reference(), 1, &9, 1), OK);
        // a byte that is neither 0 nor 1 is true
        let seven = 7_u8;
        let held = std::ptr::from_ref(&seven).cast();
        assert_eq!(fmi3SetBoolean(c, &Boolean::Held.reference(), 1, held, 1), OK);
        assert_eq!(fmi3SetString(c, &Text::Label.reference(), 1, &c"new".as_ptr(), 1), OK);
    }
    let importer = Fmi3::started(importer);
    let (mut law, mut substeps, mut held, mut label) = (0, 0, false, null());
    unsafe {
        assert_eq!(fmi3GetInt64(c, &Integer::Law.reference(), 1, &mut law, 1), OK);
        assert_eq!(fmi3GetInt32(c, &Integer::Substeps.reference(), 1, &mut substeps, 1), OK);
        assert_eq!(fmi3GetBoolean(c, &Boolean::Held.reference(), 1, &mut held, 1), OK);
        assert_eq!(fmi3GetString(c, &Text::Label.reference(), 1, &mut label, 1), OK);
        assert_eq!(CStr::from_ptr(label), c"new");
    }
    assert_eq!((law, substeps, held), (2, 9, true));
    assert!(importer.journal.take().is_empty());
}

#[test]
#[rustfmt::skip]
fn bad_arguments_are_refused() {
    let calls: [(Call, &str); 22] = [
        (|c| unsafe { fmi3GetInt32(c, &Integer::Law.reference(), 1, &mut 0, 1) }, "value reference 20"),
        (|c| unsafe { fmi3GetInt64(c, &Integer::Count.reference(), 1, &mut 0, 1) }, "value reference 23"),
        (|c| unsafe { fmi3SetInt32(c, &Integer::Law.reference(), 1, &1, 1) }, "value reference 20"),
        (|c| unsafe { fmi3SetInt64(c, &Integer::Fault.reference(), 1, &1, 1) }, "value reference 22"),
        (|c| unsafe { fmi3GetFloat32(c, &Real::X.reference(), 1, &mut 0.0, 1) }, "value reference 6"),
        (|c| unsafe { fmi3SetUInt8(c, &Real::X.reference(), 1, &0, 1) }, "value reference 6"),
        (|c| unsafe { fmi3GetBinary(c, &1, 1, &mut 0, &mut null(), 1) }, "value reference 1"),
        (|c| unsafe { fmi3GetUInt64(c, null(), 1, &mut 0, 1) }, "valueReferences is NULL"),
        (|c| unsafe { fmi3GetFloat64(c, &99, 1, &mut 0.0, 1) }, "value reference 99"),
        (|c| unsafe { fmi3GetFloat64(c, &(FIRST_INDICATOR_REFERENCE + 1), 1, &mut 0.0, 1) }, "1073741825"),
        (|c| unsafe { fmi3SetFloat64(c, &TIME_REFERENCE, 1, &0.0, 1) }, "value reference 0"),
        (|c| unsafe { fmi3GetFloat64(c, &Real::X.reference(), 1, [0.0; 2].as_mut_ptr(), 2) }, "nValues = 2"),
        (|c| unsafe { fmi3SetFloat64(c, &Real::Force.reference(), 1, null(), 0) }, "nValues = 0"),
        (|c| unsafe { fmi3SetFloat64(c, &Real::Force.reference(), 1, null(), 1) }, "NULL"),
        (|c| unsafe { fmi3SetFloat64(c, &Real::Force.reference(), 1, &f64::NAN, 1) }, "force = NaN"),
        (|c| unsafe { fmi3SetFloat64(c, &Real::Force.reference(), 1, &51.0, 1) }, "maximum, 50.0 N"),
        (|c| unsafe { fmi3SetBoolean(c, &Boolean::Held.reference(), 1, null(), 1) }, "NULL"),
        (|c| unsafe { fmi3GetString(c, &Text::Label.reference(), 1, null_mut(), 1) }, "NULL"),
        (|c| unsafe { fmi3DoStep(c, 0.0, 0.1, true, null_mut(), &mut true, &mut true, &mut 0.0) },
         "eventHandlingNeeded is NULL"),
        (|c| unsafe { fmi3DoStep(c, 0.0, f64::NAN, true, &mut true, &mut true, &mut true, &mut 0.0) },
         "communicationStepSize = NaN s"),
        (|c| unsafe { fmi3GetOutputDerivatives(c, &Real::X.reference(), 1, &2, &mut 0.0, 1) }, "order 2"),
        (|c| unsafe {
            let x = Real::X.reference();
            fmi3GetAdjointDerivative(c, &x, 1, &x, 1, &1.0, 2, &mut 0.0, 1)
        }, "nSeed = 2"),
    ];
    for (call, part) in calls {
        let importer = Fmi3::started(Fmi3::co_simulation(false, false));
        assert_eq!(unsafe { call(importer.component) }, ERROR, "{part}");
        importer.expect_error(&["fmi3", part]);
        assert_eq!(get(&importer, Real::X.reference()), 1.0);
    }
    let importer = Fmi3::co_simulation(false, false);
    for law in [0, 3, i64::MAX, i64::MIN, 1 << 32 | 1] {
        let status = unsafe { fmi3SetInt64(importer.component, &Integer::Law.reference(), 1, &law, 1) };
        assert_eq!(status, ERROR);
        importer.expect_error(&[&format!("law = {law} is not one of its items: linear = 1, cubic = 2")]);
        importer.expect_ok(&[fmi3Reset]);
    }
}

#[test]
fn the_experiment_comes_with_initialization_mode() {
    for (tolerance, start, stop, part) in [
        (0.0, 0.0, 1.0, "tolerance = 0.0"),
        (1e-6, f64::NAN, 1.0, "startTime = NaN s"),
        (1e-6, 1.0, 0.5, "stopTime = 0.5 s"),
    ] {
        let importer = Fmi3::co_simulation(false, false);
        let status =
            unsafe { fmi3EnterInitializationMode(importer.component, true, tolerance, start, true, stop) };
        assert_eq!(status, ERROR);
        importer.expect_error(&["fmi3EnterInitializationMode", part]);
    }
    let importer = Fmi3::co_simulation(false, false);
    let status = unsafe { fmi3EnterInitializationMode(importer.component, true, 1e-6, 2.0, true, 3.0) };
    assert_eq!(status, OK);
    importer.expect_ok(&[fmi3ExitInitializationMode]);
    assert_eq!(get(&importer, TIME_REFERENCE), 2.0);
    assert_eq!(get(&importer, Real::Trim.reference()), 1e-6);
    assert_eq!(step(&importer, 2.0, 1.0), (OK, false, false, 3.0));
    assert_eq!(get(&importer, TIME_REFERENCE), 3.0);
    assert_eq!(step(&importer, 3.0, 0.5).0, ERROR);
    importer.expect_error(&["fmi3DoStep", "stopTime 3.0 s"]);
}

#[test]
fn a_step_ends_early_at_an_event_only_where_that_is_allowed() {
    for (event_mode, early_return) in [(false, false), (false, true), (true, false), (true, true)] {
        let importer = Fmi3::started(Fmi3::co_simulation(event_mode, early_return));
        let c = importer.component;
        let fault = Integer::Fault.reference();
        assert_eq!(unsafe { fmi3SetInt32(c, &fault, 1, &EVENT_IN_STEP, 1) }, OK);
        if event_mode {
            importer.expect_ok(&[fmi3EnterStepMode]);
        }
        let expected = if early_return { 0.5 } else { 1.0 };
        let found = step(&importer, 0.0, 1.0);
        assert_eq!(found, (OK, event_mode && early_return, early_return, expected));
        // the next step starts where that ended
        assert_eq!(step(&importer, expected, 0.25).0, OK);
        assert!(importer.journal.take().is_empty());
    }
}

#[test]
fn discrete_inputs_are_set_in_event_mode_where_it_is_used() {
    let importer = Fmi3::started(Fmi3::co_simulation(true, false));
    let c = importer.component;
    let mut flags = [true; 5];
    unsafe {
        assert_eq!(fmi3SetFloat64(c, &Real::Push.reference(), 1, &1.0, 1), OK);
        let [a, b, d, e, f] = &mut flags;
        assert_eq!(fmi3UpdateDiscreteStates(c, a, b, d, e, f, &mut 0.0), OK);
        assert_eq!(fmi3EnterStepMode(c), OK);
        assert_eq!(fmi3SetFloat64(c, &Real::Force.reference(), 1, &1.0, 1), OK);
        assert_eq!(fmi3SetFloat64(c, &Real::Push.reference(), 1, &2.0, 1), ERROR);
    }
    assert_eq!(flags, [false; 5]);
    importer.expect_error(&["push (Input, Discrete)", "in step mode", "Event Mode"]);
}

#[test]
fn model_exchange_has_its_events_and_their_indicators() {
    let importer = Fmi3::started(Fmi3::model_exchange());
    let c = importer.component;
    assert_eq!(get(&importer, FIRST_INDICATOR_REFERENCE), 1.0);
    let (mut indicators, mut states, mut enter, mut end) = (0, 0, false, true);
    let mut derivatives = [0.0; 2];
    unsafe {
        assert_eq!(fmi3GetNumberOfEventIndicators(c, &mut indicators), OK);
        assert_eq!(fmi3GetNumberOfContinuousStates(c, &mut states), OK);
        assert_eq!(fmi3EnterContinuousTimeMode(c), OK);
        assert_eq!(fmi3SetTime(c, 0.25), OK);
        assert_eq!(fmi3SetContinuousStates(c, [-0.5, -2.0].as_ptr(), 2), OK);
        assert_eq!(fmi3GetContinuousStateDerivatives(c, derivatives.as_mut_ptr(), 2), OK);
        assert_eq!(fmi3CompletedIntegratorStep(c, true, &mut enter, &mut end), OK);
    }
    assert_eq!((indicators, states, derivatives, enter, end), (1, 2, [-2.0, 2.0], true, false));
    assert_eq!(get(&importer, FIRST_INDICATOR_REFERENCE), -0.5);
    assert_eq!(get(&importer, TIME_REFERENCE), 0.25);
    let [mut again, mut terminate, mut nominals, mut values, mut defined] = [true; 5];
    unsafe {
        assert_eq!(fmi3EnterEventMode(c), OK);
        let status = fmi3UpdateDiscreteStates(
            c,
            &mut again,
            &mut terminate,
            &mut nominals,
            &mut values,
            &mut defined,
            &mut 0.0,
        );
        assert_eq!(status, OK);
    }
    assert_eq!([again, terminate, nominals, values, defined], [true, false, false, true, false]);
}

#[test]
fn derivatives_are_summed_over_knowns_or_unknowns() {
    let importer = Fmi3::started(Fmi3::co_simulation(false, false));
    let c = importer.component;
    let [x, v, force] = [Real::X, Real::V, Real::Force].map(Real::reference);
    // ∂v/∂force = 1, ∂v/∂x = -4, ∂x/∂force = 0, ∂x/∂x = 3
    let mut found = [0.0; 2];
    let (unknowns, knowns, seeds) = ([v, x], [force, x], [2.0, 5.0]);
    unsafe {
        let (unknowns, knowns, seeds) = (unknowns.as_ptr(), knowns.as_ptr(), seeds.as_ptr());
        let sums = found.as_mut_ptr();
        assert_eq!(fmi3GetDirectionalDerivative(c, unknowns, 2, knowns, 2, seeds, 2, sums, 2), OK);
        assert_eq!(found, [2.0 - 20.0, 15.0]);
        assert_eq!(fmi3GetAdjointDerivative(c, unknowns, 2, knowns, 2, seeds, 2, sums, 2), OK);
        assert_eq!(found, [2.0, -8.0 + 15.0]);
        let mut derivative = 0.0;
        assert_eq!(fmi3GetOutputDerivatives(c, &v, 1, &1, &mut derivative, 1), OK);
        assert_eq!(derivative, -4.0);
    }
}

#[test]
fn a_state_goes_from_one_version_to_the_other() {
    let (old, new) = (Importer::swinging(), Fmi3::co_simulation(false, false));
    assert_eq!(old.step(0.0, 0.5), OK);
    crate::states::resume(&new, &crate::states::bytes(&old));
    assert_eq!(old.step(0.5, 0.25), OK);
    assert_eq!(step(&new, 0.5, 0.25), (OK, false, false, 0.75));
    assert_eq!(get(&new, Real::X.reference()), old.get(Real::X));
    // Event Mode of co-simulation is no phase of one that does not use it
    let events = Fmi3::started(Fmi3::co_simulation(true, false));
    assert_eq!(crate::states::load(&new, &crate::states::bytes(&events)), Err(ERROR));
    new.expect_error(&["fmi3DeserializeFMUState"]);
}

thread_local! {
    static INSTANCE: Cell<Component> = const { Cell::new(null_mut()) };
    /// What the importer sets `force` to at the end of a step, and the time it was asked for.
    static FORCE: Cell<f64> = const { Cell::new(0.0) };
    pub static ASKED: Cell<f64> = const { Cell::new(f64::NAN) };
}

pub unsafe extern "C" fn set_force(
    _: Component,
    time: f64,
    set_requested: bool,
    get_allowed: bool,
    step_finished: bool,
    can_return_early: bool,
    _: *mut bool,
    _: *mut f64,
) {
    assert_eq!([set_requested, get_allowed, step_finished, can_return_early], [true, false, false, false]);
    ASKED.set(time);
    unsafe { fmi3SetFloat64(INSTANCE.get(), &Real::Force.reference(), 1, &FORCE.get(), 1) };
}

#[test]
fn inputs_run_linearly_to_what_is_set_inside_a_step() {
    let importer = Fmi3::started(Fmi3::updated(false, false, Some(set_force)));
    let reference = Importer::swinging();
    INSTANCE.set(importer.component);
    FORCE.set(1.0);
    assert_eq!(step(&importer, 0.0, 0.5), (OK, false, false, 0.5));
    assert_eq!(ASKED.get(), 0.5);
    // FMI 2.0 says the same with a derivative
    assert_eq!(set_rate(&reference, Real::Force.reference(), 1, 2.0), OK);
    assert_eq!(reference.step(0.0, 0.5), OK);
    assert_eq!(get(&importer, Real::X.reference()).to_bits(), reference.get(Real::X).to_bits());
    assert_eq!(get(&importer, Real::Force.reference()), 1.0);
    // what is refused there ends the simulation
    FORCE.set(f64::NAN);
    assert_eq!(step(&importer, 0.5, 0.5).0, ERROR);
    let messages = importer.journal.take();
    assert!(messages[0].text.starts_with("fmi3SetFloat64: force = NaN"), "{messages:?}");
    assert!(messages[1].text.starts_with("fmi3DoStep: not allowed now"), "{messages:?}");
}

unsafe extern "C" fn step_again(
    _: Component,
    time: f64,
    _: bool,
    _: bool,
    _: bool,
    _: bool,
    _: *mut bool,
    _: *mut f64,
) {
    unsafe {
        fmi3DoStep(INSTANCE.get(), time, 0.1, true, &mut false, &mut false, &mut false, &mut 0.0);
    }
}

#[test]
fn other_calls_inside_a_step_are_refused() {
    let importer = Fmi3::started(Fmi3::updated(false, false, Some(step_again)));
    INSTANCE.set(importer.component);
    assert_eq!(step(&importer, 0.0, 0.5).0, ERROR);
    let messages = importer.journal.take();
    assert!(messages[0].text.contains("in Intermediate Update Mode"), "{messages:?}");
    assert_eq!(get(&importer, Real::X.reference()), 1.0);
}

/// Values are read before Initialization Mode, too: those that are set, and what follows from them.
#[test]
fn values_are_read_from_instantiation_on() {
    let importer = Fmi3::co_simulation(false, false);
    let [stiffness, period] = [Real::Stiffness, Real::Period].map(Real::reference);
    assert_eq!(get(&importer, stiffness), 4.0);
    assert_eq!(get(&importer, period), std::f64::consts::PI);
    assert_eq!(unsafe { fmi3SetFloat64(importer.component, &stiffness, 1, &16.0, 1) }, OK);
    assert_eq!([get(&importer, stiffness), get(&importer, period)], [16.0, std::f64::consts::FRAC_PI_2]);
    // a fixed parameter can still change, and the start is that of an instance nobody has read
    let untouched = Fmi3::co_simulation(false, false);
    assert_eq!(unsafe { fmi3SetFloat64(importer.component, &stiffness, 1, &4.0, 1) }, OK);
    let [read, untouched] = [importer, untouched].map(Fmi3::started);
    assert_eq!(crate::states::bytes(&read), crate::states::bytes(&untouched));
}
