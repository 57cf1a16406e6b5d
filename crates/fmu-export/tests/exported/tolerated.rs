//! What importers do beside the standard, and is served all the same.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use crate::derivatives::set_rate;
use crate::exchange::Exchange;
use crate::fmi2::*;
use crate::fmi3::*;
use crate::fmi3_order::Fmi3;
use crate::fmi3_values::{ASKED, set_force, step};
use crate::importer::{Call, Importer};
use crate::spring::{Boolean, Integer, Real, Text};
use crate::states::bytes;
use fmu_export::TIME_REFERENCE;
use fmu_export::ffi::types::{Component, ERROR, OK, Status, WARNING};
use std::ptr::{null, null_mut};

/// No variable has it.
const UNKNOWN: u32 = 999;

/// A swinging spring in step mode of FMI 3.0 with Event Mode.
fn stepping_with_events() -> Importer {
    Fmi3::started(Fmi3::co_simulation(true, false)).after(&[fmi3EnterStepMode])
}

#[test]
fn a_discrete_input_is_set_in_step_mode_to_the_value_that_it_has_alone() {
    type Set = fn(Component, bool) -> Status;
    // each sets the value that the input has, or another
    let sets: [(&str, Set); 3] = [
        ("push", |c, other| unsafe {
            fmi3SetFloat64(c, &Real::Push.reference(), 1, &if other { 2.0 } else { 1.5 }, 1)
        }),
        ("fault", |c, other| unsafe {
            fmi3SetInt32(c, &Integer::Fault.reference(), 1, &i32::from(other), 1)
        }),
        ("held", |c, other| unsafe { fmi3SetBoolean(c, &Boolean::Held.reference(), 1, &other, 1) }),
    ];
    for (name, set) in sets {
        let importer = Fmi3::started(Fmi3::co_simulation(true, false));
        let c = importer.component;
        unsafe {
            assert_eq!(fmi3SetFloat64(c, &Real::Push.reference(), 1, &1.5, 1), OK);
            assert_eq!(fmi3EnterStepMode(c), OK);
        }
        let before = bytes(&importer);
        assert_eq!(set(c, false), OK, "{name}: {:?}", importer.journal.take());
        assert_eq!(bytes(&importer), before);
        assert_eq!(step(&importer, 0.0, 0.25).0, OK);
        assert!(importer.journal.take().is_empty());
        assert_eq!(set(c, true), ERROR);
        importer.expect_error(&[&format!("{name} (Input, Discrete)"), "in step mode", "in Event Mode"]);
    }
    // one of two references in the same call has another value: neither is set
    let importer = stepping_with_events();
    let references = [Real::Force.reference(), Real::Push.reference()];
    unsafe {
        let status = fmi3SetFloat64(importer.component, references.as_ptr(), 2, [1.0, 1.0].as_ptr(), 2);
        assert_eq!(status, ERROR);
    }
    assert_eq!(importer.get(Real::Force), 0.0);
}

#[test]
fn a_parameter_is_set_to_the_value_that_it_has_at_any_time() {
    // the kind of each differs, and so does its function; `trim` is tunable but not in Continuous-Time Mode
    type Set = fn(Component, bool) -> Status;
    let sets: [(&str, Set); 5] = [
        ("stiffness", |c, other| unsafe {
            fmi3SetFloat64(c, &Real::Stiffness.reference(), 1, &if other { 5.0 } else { 4.0 }, 1)
        }),
        ("law", |c, other| unsafe {
            fmi3SetInt64(c, &Integer::Law.reference(), 1, &if other { 2 } else { 1 }, 1)
        }),
        ("substeps", |c, other| unsafe {
            fmi3SetInt32(c, &Integer::Substeps.reference(), 1, &if other { 9 } else { 8 }, 1)
        }),
        ("clamped", |c, other| unsafe { fmi3SetBoolean(c, &Boolean::Clamped.reference(), 1, &other, 1) }),
        ("label", |c, other| unsafe {
            let text = if other { c"other" } else { c"spring" };
            fmi3SetString(c, &Text::Label.reference(), 1, &text.as_ptr(), 1)
        }),
    ];
    let in_event_mode = || Fmi3::started(Fmi3::model_exchange());
    for (name, set) in sets {
        for importer in
            [stepping_with_events(), Fmi3::started(Fmi3::co_simulation(false, false)), in_event_mode()]
        {
            let before = bytes(&importer);
            assert_eq!(set(importer.component, false), OK, "{name}: {:?}", importer.journal.take());
            assert_eq!(bytes(&importer), before);
            assert_eq!(set(importer.component, true), ERROR, "{name}");
            importer.expect_error(&[&format!("{name} (Parameter, Fixed) cannot be set")]);
        }
    }
    let importer = in_event_mode().after(&[fmi3EnterContinuousTimeMode]);
    assert_eq!(sets[0].1(importer.component, false), OK, "{:?}", importer.journal.take());
    // a constant and an output are never set
    for variable in [Real::Gravity, Real::Energy] {
        let importer = stepping_with_events();
        let value = importer.get(variable);
        let status = unsafe { fmi3SetFloat64(importer.component, &variable.reference(), 1, &value, 1) };
        assert_eq!(status, ERROR, "{variable:?}");
    }
}

/// GEMSEO-FMU sets every parameter as a Real before each step, enumerations too.
#[test]
fn an_enumeration_is_set_as_a_real_to_the_value_that_it_has() {
    let [law, force, substeps, held] = [
        Integer::Law.reference(),
        Real::Force.reference(),
        Integer::Substeps.reference(),
        Boolean::Held.reference(),
    ];
    for importer in [Importer::new(), Importer::swinging(), Exchange::in_event_mode()] {
        let references = [law, force, substeps, held];
        let set = |values: [f64; 4]| unsafe {
            fmi2SetReal(importer.component, references.as_ptr(), 4, values.as_ptr())
        };
        assert_eq!(set([1.0, 2.0, 8.0, 0.0]), OK, "{:?}", importer.journal.take());
        assert_eq!(set([1.0, 3.0, 8.5, 0.0]), ERROR);
        importer.expect_error(&[
            "fmi2SetReal: no variable of this type has the value reference",
            "substeps has it",
        ]);
    }
    let importer = Importer::swinging();
    let status = unsafe { fmi2SetReal(importer.component, [law, force].as_ptr(), 2, [1.0, 2.0].as_ptr()) };
    assert_eq!((status, importer.get(Real::Force), importer.get_integer(Integer::Law)), (OK, 2.0, 1));
    // an output is not set, whatever its value
    let count = Integer::Count.reference();
    assert_eq!(unsafe { fmi2SetReal(importer.component, &count, 1, &0.0) }, ERROR);
}

#[test]
fn a_boolean_is_read_as_a_real_with_one_warning() {
    let references = [Boolean::Moving.reference(), Real::X.reference(), Boolean::Clamped.reference()];
    for (third, importer) in [
        (false, Importer::swinging()),
        (false, Exchange::in_event_mode()),
        (true, Fmi3::started(Fmi3::co_simulation(false, false))),
        (true, Fmi3::started(Fmi3::model_exchange())),
    ] {
        let c = importer.component;
        let read = || {
            let mut found = [f64::NAN; 3];
            let status = unsafe {
                if third {
                    fmi3GetFloat64(c, references.as_ptr(), 3, found.as_mut_ptr(), 3)
                } else {
                    fmi2GetReal(c, references.as_ptr(), 3, found.as_mut_ptr())
                }
            };
            (status, found)
        };
        // the warning is for who reads warnings
        assert_eq!(read(), (OK, [0.0, 1.0, 0.0]), "{:?}", importer.journal.take());
        assert!(importer.journal.take().is_empty());
        unsafe { assert_eq!(fmi2SetDebugLogging(c, 1, 0, null()), OK) };
        if !third && importer.step(0.0, 0.25) == OK {
            assert_eq!(read().1[0], 1.0, "it moves");
        } else {
            assert_eq!(read().0, OK);
        }
        assert_eq!(read().0, OK);
        let [getter, own] =
            if third { ["fmi3GetFloat64", "fmi3GetBoolean"] } else { ["fmi2GetReal", "fmi2GetBoolean"] };
        let mut messages = importer.journal.take();
        messages.retain(|message| message.status == WARNING);
        assert_eq!(messages.len(), 1, "{messages:?}");
        for part in [getter, "moving is a Boolean", own] {
            assert!(messages[0].text.contains(part), "{messages:?}");
        }
        // a reset instance is the same instance
        importer.expect_ok(&[fmi2Reset]);
        if third {
            assert_eq!(unsafe { fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) }, OK);
        } else {
            importer.expect_ok(&[fmi2EnterInitializationMode]);
        }
        assert_eq!(read(), (OK, [0.0; 3]));
        importer.journal.take().iter().for_each(|message| assert_ne!(message.status, WARNING));
    }
}

#[test]
#[rustfmt::skip]
fn a_function_of_another_type_names_the_variable() {
    let calls: [(Call, &str); 11] = [
        (|c| unsafe { fmi3GetInt32(c, &Real::X.reference(), 1, &mut 0, 1) },
         "fmi3GetInt32: no variable of this type has the value reference 6; x has it: use the function"),
        (|c| unsafe { fmi3GetFloat32(c, &Real::X.reference(), 1, &mut 0.0, 1) },
         "; x has it"),
        (|c| unsafe { fmi3SetFloat32(c, &Real::Force.reference(), 1, &0.0, 1) },
         "; force has it"),
        (|c| unsafe { fmi3GetInt32(c, &Integer::Law.reference(), 1, &mut 0, 1) },
         "; law has it"),
        (|c| unsafe { fmi3SetInt64(c, &Integer::Fault.reference(), 1, &0, 1) },
         "; fault has it"),
        (|c| unsafe { fmi3GetFloat64(c, &Integer::Count.reference(), 1, &mut 0.0, 1) },
         "; count has it"),
        (|c| unsafe { fmi3SetFloat64(c, &Boolean::Held.reference(), 1, &1.0, 1) },
         "; held has it"),
        (|c| unsafe { fmi3GetBinary(c, &Text::Label.reference(), 1, &mut 0, &mut null(), 1) },
         "; label has it"),
        (|c| unsafe { fmi3GetBoolean(c, &TIME_REFERENCE, 1, &mut false, 1) },
         "no variable of this type has the value reference 0"),
        (|c| unsafe { fmi3GetOutputDerivatives(c, &Integer::Count.reference(), 1, &1, &mut 0.0, 1) },
         "; count has it"),
        (|c| unsafe { fmi2SetReal(c, &Integer::Law.reference(), 1, &2.0) },
         "; law has it"),
    ];
    for (call, message) in calls {
        let importer = Fmi3::started(Fmi3::co_simulation(false, false));
        assert_eq!(unsafe { call(importer.component) }, ERROR, "{message}");
        importer.expect_error(&[message]);
    }
}

#[test]
#[rustfmt::skip]
fn a_getter_that_fails_leaves_the_instance_usable() {
    let getters: [(&str, Call); 8] = [
        ("fmi2GetReal", |c| unsafe { fmi2GetReal(c, &UNKNOWN, 1, &mut 0.0) }),
        ("fmi2GetReal", |c| unsafe { fmi2GetReal(c, null(), 1, &mut 0.0) }),
        ("fmi2GetInteger", |c| unsafe { fmi2GetInteger(c, &UNKNOWN, 1, &mut 0) }),
        ("fmi2GetBoolean", |c| unsafe { fmi2GetBoolean(c, &UNKNOWN, 1, &mut 0) }),
        ("fmi2GetString", |c| unsafe { fmi2GetString(c, &UNKNOWN, 1, &mut null()) }),
        ("fmi2GetDirectionalDerivative", |c| unsafe {
            fmi2GetDirectionalDerivative(c, &UNKNOWN, 1, &UNKNOWN, 1, &1.0, &mut 0.0)
        }),
        ("fmi2GetRealOutputDerivatives", |c| unsafe {
            fmi2GetRealOutputDerivatives(c, &Real::X.reference(), 1, &2, &mut 0.0)
        }),
        // of Model Exchange alone
        ("fmi2GetDerivatives", |c| unsafe { fmi2GetDerivatives(c, [0.0; 2].as_mut_ptr(), 2) }),
    ];
    for (name, getter) in getters {
        let importer = Importer::swinging();
        assert_eq!(unsafe { getter(importer.component) }, ERROR, "{name}");
        importer.expect_error(&[name]);
        assert_eq!(importer.set(Real::Force, 1.0), OK, "{name}");
        assert_eq!(importer.step(0.0, 0.25), OK, "{name}");
    }
    let getters: [(&str, Call); 8] = [
        ("fmi3GetFloat64", |c| unsafe { fmi3GetFloat64(c, &UNKNOWN, 1, &mut 0.0, 1) }),
        ("fmi3GetFloat32", |c| unsafe { fmi3GetFloat32(c, &Real::X.reference(), 1, &mut 0.0, 1) }),
        ("fmi3GetInt32", |c| unsafe { fmi3GetInt32(c, &Integer::Law.reference(), 1, &mut 0, 1) }),
        ("fmi3GetInt64", |c| unsafe { fmi3GetInt64(c, &Integer::Count.reference(), 1, &mut 0, 1) }),
        ("fmi3GetBoolean", |c| unsafe { fmi3GetBoolean(c, &Real::X.reference(), 1, &mut false, 1) }),
        ("fmi3GetString", |c| unsafe { fmi3GetString(c, &Text::Label.reference(), 1, null_mut(), 1) }),
        ("fmi3GetClock", |c| unsafe { fmi3GetClock(c, &1, 1, &mut false) }),
        ("fmi3GetOutputDerivatives", |c| unsafe {
            fmi3GetOutputDerivatives(c, &Real::X.reference(), 1, &2, &mut 0.0, 1)
        }),
    ];
    for (name, getter) in getters {
        let importer = stepping_with_events();
        assert_eq!(unsafe { getter(importer.component) }, ERROR, "{name}");
        importer.expect_error(&[name]);
        assert_eq!(step(&importer, 0.0, 0.25), (OK, false, false, 0.25), "{name}");
    }
}

#[test]
fn a_getter_out_of_turn_leaves_the_instance_where_it_is() {
    let (reference, mut value) = (Real::X.reference(), 0.0);
    unsafe {
        let importer = Importer::new();
        assert_eq!(fmi2GetReal(importer.component, &reference, 1, &mut value), ERROR);
        assert_eq!(fmi2EnterInitializationMode(importer.component), OK);
        let importer = Fmi3::model_exchange();
        assert_eq!(fmi3GetContinuousStates(importer.component, &mut value, 1), ERROR);
        assert_eq!(fmi3EnterInitializationMode(importer.component, false, 0.0, 0.0, false, 0.0), OK);
        let importer = Exchange::in_continuous_time_mode();
        assert_eq!(fmi2GetReal(importer.component, &UNKNOWN, 1, &mut value), ERROR);
        assert_eq!(fmi2GetContinuousStates(importer.component, &mut value, 1), ERROR);
        assert_eq!(fmi2SetTime(importer.component, 0.5), OK);
        // parameters that contradict each other can still be mended
        let importer = Importer::in_initialization_mode();
        assert_eq!(importer.set(Real::XStart, 1.0), OK);
        assert_eq!(fmi2SetBoolean(importer.component, &Boolean::Clamped.reference(), 1, &1), OK);
        assert_eq!(fmi2GetReal(importer.component, &reference, 1, &mut value), ERROR);
        importer.expect_error(&["fmi2GetReal: x_start = 1 m of a clamped spring"]);
        assert_eq!(importer.set(Real::XStart, 0.0), OK);
        assert_eq!(fmi2ExitInitializationMode(importer.component), OK);
    }
}

#[test]
fn a_step_of_length_0_does_nothing() {
    let importer = Importer::swinging();
    assert_eq!(importer.step(0.0, 0.5), OK);
    assert_eq!(set_rate(&importer, Real::Force.reference(), 1, 2.0), OK);
    let before = bytes(&importer);
    let short = [0.0, -0.0, f64::from_bits(1), 1e-300, 9.9e-31];
    let steps = short.map(|size| (0.5, size)).into_iter().chain([(0.5 + 1e-10, 0.0), (0.5 - 1e-10, 0.0)]);
    for (point, size) in steps {
        assert_eq!(importer.step(point, size), OK, "{:?}", importer.journal.take());
        assert_eq!(bytes(&importer), before, "{point:?} {size:?}");
    }
    // outputs can be read, and the derivative of the input holds for the step after it
    assert_eq!(importer.get_integer(Integer::Count), 1);
    assert_eq!(importer.step(0.5, 0.5), OK);
    assert_eq!(importer.get(Real::Force), 1.0);
    assert!(importer.journal.take().is_empty());
    // the point must still be the own time
    assert_eq!(importer.step(0.5, 0.0), ERROR);
    importer.expect_error(&["currentCommunicationPoint = 0.5 s, but the last step ended at 1.0 s"]);
    let importer = Importer::swinging();
    assert_eq!(importer.step(0.0, -1e-300), ERROR);
    importer.expect_error(&["communicationStepSize = -1e-300 s is not finite and at least 0"]);
}

#[test]
fn a_step_of_length_0_answers_in_fmi_3() {
    for importer in [stepping_with_events(), Fmi3::started(Fmi3::updated(false, true, Some(set_force)))] {
        let before = bytes(&importer);
        for size in [0.0, 9.9e-31] {
            assert_eq!(step(&importer, 0.0, size), (OK, false, false, 0.0));
            assert_eq!(bytes(&importer), before);
            assert!(ASKED.get().is_nan(), "there are no inputs at its end to ask for");
        }
    }
    let importer = stepping_with_events();
    assert_eq!(step(&importer, 0.0, 0.5).0, OK);
    assert_eq!(step(&importer, 0.5, 0.0), (OK, false, false, 0.5));
    for size in [-0.1, f64::NAN, f64::INFINITY] {
        let importer = stepping_with_events();
        assert_eq!(step(&importer, 0.0, size).0, ERROR);
        importer.expect_error(&["fmi3DoStep", "communicationStepSize"]);
    }
}
