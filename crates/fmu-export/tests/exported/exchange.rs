//! Model Exchange.

use crate::allocator;
use crate::fmi2::*;
use crate::importer::{Importer, instantiate};
use crate::spring::{FAIL_IN_STEP, GUID, Integer, PANIC_IN_STEP, Real, Spring};
use fmu_export::Model;
use fmu_export::ffi::types::{CO_SIMULATION, ERROR, EventInfo, MODEL_EXCHANGE, OK, Status};
use fmu_export::ffi::{Kinds, common};
use std::ptr;

/// Instances for Model Exchange.
pub struct Exchange;

impl Exchange {
    pub fn instantiated() -> Importer {
        Importer::of(instantiate("one", MODEL_EXCHANGE, Spring::GUID, None, false))
    }

    pub fn in_initialization_mode() -> Importer {
        Self::instantiated().initializing()
    }

    pub fn in_event_mode() -> Importer {
        Self::instantiated().released()
    }

    pub fn in_continuous_time_mode() -> Importer {
        let importer = Self::in_event_mode();
        assert_eq!(update(&importer), Ok(EventInfo::default()));
        importer.after(&[fmi2EnterContinuousTimeMode])
    }

    pub fn terminated() -> Importer {
        Self::in_event_mode().after(&[fmi2Terminate])
    }

    pub fn in_error() -> Importer {
        let importer = Self::in_event_mode();
        assert_eq!(set_time(&importer, f64::NAN), ERROR);
        importer
    }
}

fn update(importer: &Importer) -> Result<EventInfo, Status> {
    let mut information = EventInfo::default();
    // SAFETY: the instance lives.
    let status = unsafe { fmi2NewDiscreteStates(importer.component, &mut information) };
    if status == OK { Ok(information) } else { Err(status) }
}

fn set_time(importer: &Importer, time: f64) -> Status {
    // SAFETY: the instance lives.
    unsafe { fmi2SetTime(importer.component, time) }
}

fn set_states(importer: &Importer, states: [f64; 2]) -> Status {
    // SAFETY: the instance lives; two states.
    unsafe { fmi2SetContinuousStates(importer.component, states.as_ptr(), 2) }
}

type Getter = unsafe extern "C" fn(*mut std::ffi::c_void, *mut f64, usize) -> Status;

fn numbers<const N: usize>(importer: &Importer, getter: Getter) -> [f64; N] {
    let mut values = [f64::NAN; N];
    // SAFETY: the instance lives; the array is as long as stated.
    assert_eq!(unsafe { getter(importer.component, values.as_mut_ptr(), N) }, OK);
    values
}

#[test]
fn states_go_in_and_derivatives_come_out() {
    let importer = Exchange::in_continuous_time_mode();
    assert_eq!(numbers(&importer, fmi2GetContinuousStates), [1.0, 0.0]);
    assert_eq!(numbers(&importer, fmi2GetNominalsOfContinuousStates), [0.5, 0.25]);
    assert_eq!(set_states(&importer, [0.5, 0.125]), OK);
    assert_eq!(importer.set(Real::Force, 3.0), OK);
    // dx/dt = v, dv/dt = F − 4 x
    assert_eq!(numbers(&importer, fmi2GetDerivatives), [0.125, 1.0]);
    assert_eq!(numbers(&importer, fmi2GetEventIndicators), [0.5]);
    assert_eq!(set_time(&importer, 2.5), OK);
    assert_eq!(importer.get(Real::Time), 2.5);
}

#[test]
fn an_event_changes_the_discrete_state() {
    let importer = Exchange::in_continuous_time_mode();
    assert_eq!(set_states(&importer, [-0.25, -1.0]), OK);
    // frozen until the event: the indicator tells of it
    assert_eq!(numbers(&importer, fmi2GetEventIndicators), [-0.25]);
    let (mut event, mut end) = (7, 7);
    // SAFETY: the instance lives.
    let status = unsafe { fmi2CompletedIntegratorStep(importer.component, 1, &mut event, &mut end) };
    assert_eq!((status, event, end), (OK, 1, 0));
    importer.expect_ok(&[fmi2EnterEventMode]);
    let changed = EventInfo {
        new_discrete_states_needed: 1,
        values_of_continuous_states_changed: 1,
        ..EventInfo::default()
    };
    assert_eq!(update(&importer), Ok(changed));
    assert_eq!(update(&importer), Ok(EventInfo::default()));
    assert_eq!(numbers(&importer, fmi2GetContinuousStates), [-0.25, -0.5]);
    assert_eq!(numbers(&importer, fmi2GetEventIndicators), [0.25]);
    assert_eq!(importer.set(Real::Push, 1.0), OK);
    let timed = EventInfo { next_event_time_defined: 1, next_event_time: 1.0, ..EventInfo::default() };
    assert_eq!(update(&importer), Ok(timed));
}

#[test]
fn counts_and_numbers_that_are_wrong_are_refused() {
    type Wrong = (&'static str, fn(&Importer) -> Status, [&'static str; 2]);
    // SAFETY: the instance lives; no array is shorter than stated.
    let wrong: [Wrong; 6] = [
        (
            "few states",
            |i| unsafe { fmi2SetContinuousStates(i.component, [0.0].as_ptr(), 1) },
            ["1 continuous states", "the model has 2"],
        ),
        ("infinite state", |i| set_states(i, [0.0, f64::INFINITY]), ["v = inf", "finite"]),
        ("NaN", |i| set_states(i, [f64::NAN, 0.0]), ["x = NaN", "finite"]),
        ("time", |i| set_time(i, f64::INFINITY), ["time = inf", "finite"]),
        (
            "indicators",
            |i| unsafe { fmi2GetEventIndicators(i.component, [0.0; 2].as_mut_ptr(), 2) },
            ["2 event indicators", "the model has 1"],
        ),
        (
            "no derivatives",
            |i| unsafe { fmi2GetDerivatives(i.component, ptr::null_mut(), 2) },
            ["derivatives", "NULL"],
        ),
    ];
    for (what, call, parts) in wrong {
        let importer = Exchange::in_continuous_time_mode();
        assert_eq!(call(&importer), ERROR, "{what}");
        importer.expect_error(&parts);
        assert_eq!(importer.get(Real::X), 1.0, "{what}: all is as it was");
    }
}

/// What the simulation computes from `state` on: an explicit step and an event.
fn go_on(importer: &Importer) -> Vec<u64> {
    let [v, a] = numbers(importer, fmi2GetDerivatives);
    let [x, _] = numbers(importer, fmi2GetContinuousStates);
    assert_eq!(set_states(importer, [x + 0.75 * v, v + 0.75 * a]), OK);
    importer.expect_ok(&[fmi2EnterEventMode]);
    let information = update(importer).unwrap();
    let mut all = vec![u64::from(information.values_of_continuous_states_changed.unsigned_abs())];
    all.extend(numbers::<2>(importer, fmi2GetContinuousStates).map(f64::to_bits));
    all.extend(numbers::<1>(importer, fmi2GetEventIndicators).map(f64::to_bits));
    importer.expect_ok(&[fmi2EnterContinuousTimeMode]);
    all
}

#[test]
fn a_state_resumes_in_another_instance_of_its_kind_alone() {
    let importer = Exchange::in_continuous_time_mode();
    assert_eq!(set_states(&importer, [0.5, -2.0]), OK);
    let stored = crate::states::bytes(&importer);
    let expected = go_on(&importer);
    let other = Exchange::instantiated();
    crate::states::resume(&other, &stored);
    assert_eq!(crate::states::bytes(&other), stored);
    assert_eq!(go_on(&other), expected);
    let steps = Importer::in_step_mode();
    assert_eq!(crate::states::load(&steps, &stored), Err(ERROR));
    steps.expect_error(&["another kind of instance"]);
}

#[test]
fn failures_and_panics_in_an_update_are_errors() {
    for (fault, part) in [(FAIL_IN_STEP, "no update at 0 s"), (PANIC_IN_STEP, "snapped in an update")] {
        let importer = Exchange::in_event_mode();
        assert_eq!(importer.set_integer(Integer::Fault, fault), OK);
        assert_eq!(update(&importer), Err(ERROR));
        importer.expect_error(&["fmi2NewDiscreteStates", part]);
        assert_eq!(numbers(&importer, fmi2GetContinuousStates), [1.0, 0.0]);
    }
}

#[test]
fn the_functions_of_the_other_kind_say_so() {
    let importer = Exchange::in_event_mode();
    assert_eq!(importer.step(0.0, 0.1), ERROR);
    importer.expect_error(&["fmi2DoStep", "not for an instance of Model Exchange"]);
    let importer = Importer::in_step_mode();
    assert_eq!(set_time(&importer, 0.0), ERROR);
    importer.expect_error(&["fmi2SetTime", "not for an instance of co-simulation"]);
}

#[test]
fn a_state_may_be_set_like_an_input_once_it_runs() {
    let importer = Exchange::in_event_mode();
    assert_eq!(importer.set(Real::X, -0.5), OK);
    assert_eq!(numbers(&importer, fmi2GetEventIndicators), [0.5]);
    let importer = Exchange::in_initialization_mode();
    assert_eq!(importer.set(Real::X, -0.5), ERROR);
    let importer = Importer::in_step_mode();
    assert_eq!(importer.set(Real::X, -0.5), ERROR);
    let importer = Exchange::in_continuous_time_mode();
    assert_eq!(importer.set(Real::Trim, 0.5), ERROR);
    importer.expect_error(&[
        "trim (Parameter, Tunable) cannot be set",
        "in Continuous-Time Mode",
        "in Event Mode",
    ]);
}

#[test]
fn a_library_of_one_kind_refuses_the_other() {
    let make = |kinds: &Kinds<Spring>, kind| {
        let (name, guid) = (c"one".as_ptr(), GUID.as_ptr());
        // SAFETY: the texts live; NULL callbacks are allowed.
        unsafe {
            let component =
                common::instantiate::<Spring>(kinds, name, kind, guid, ptr::null(), ptr::null(), 0, 0);
            fmi2FreeInstance(component);
            !component.is_null()
        }
    };
    for (kinds, exchange, steps) in
        [(Kinds::CO_SIMULATION, false, true), (Kinds::MODEL_EXCHANGE, true, false), (Kinds::BOTH, true, true)]
    {
        assert_eq!([make(&kinds, MODEL_EXCHANGE), make(&kinds, CO_SIMULATION)], [exchange, steps]);
    }
}

#[test]
fn nothing_is_allocated_between_events() {
    let importer = Exchange::in_continuous_time_mode();
    let before = allocator::allocations();
    for index in 0..100_u32 {
        assert_eq!(set_states(&importer, [1.0 - f64::from(index) / 70.0, 0.5]), OK);
        numbers::<2>(&importer, fmi2GetDerivatives);
        numbers::<1>(&importer, fmi2GetEventIndicators);
        // SAFETY: the instance lives.
        unsafe {
            fmi2CompletedIntegratorStep(importer.component, 1, &mut 0, &mut 0);
            fmi2EnterEventMode(importer.component);
            fmi2NewDiscreteStates(importer.component, &mut EventInfo::default());
            fmi2EnterContinuousTimeMode(importer.component);
        }
    }
    assert_eq!(allocator::allocations() - before, 0);
}
