//! Getting and setting values.

use crate::fmi2::*;
use crate::importer::Importer;
use crate::spring::{Boolean, Integer, Real, Text};
use fmu_export::ffi::types::{Component, ERROR, OK, Status};
use std::ffi::CStr;
use std::ptr;

#[test]
fn a_model_starts_with_the_values_of_its_description() {
    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.get(Real::Stiffness), 4.0);
    assert_eq!(importer.get_integer(Integer::Law), 1);
    assert_eq!(importer.get_integer(Integer::Substeps), 8);
}

#[test]
fn what_is_set_is_got() {
    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.set(Real::Stiffness, 9.0), OK);
    assert_eq!(importer.set_integer(Integer::Law, 2), OK);
    let (c, mut flag) = (importer.component, -1);
    // C's truth is anything but 0.
    assert_eq!(importer.set_boolean(Boolean::Clamped, 2), OK);
    // SAFETY: the instance lives; one reference, one value.
    unsafe {
        assert_eq!(fmi2SetString(c, &Text::Label.reference(), 1, &c"Fäden %s".as_ptr()), OK);
        assert_eq!(fmi2GetBoolean(c, &Boolean::Clamped.reference(), 1, &mut flag), OK);
    }
    assert_eq!((flag, importer.get_text(Text::Label)), (1, "Fäden %s".to_owned()));
    assert_eq!(importer.get(Real::Stiffness), 9.0);
    assert_eq!(importer.get_integer(Integer::Law), 2);
}

#[test]
fn values_that_overflow_are_an_error() {
    let importer = Importer::in_step_mode();
    assert_eq!(importer.set(Real::Push, 1e308), OK);
    assert_eq!(importer.step(0.0, 1e-3), OK);
    let (mut value, c) = (0.0, importer.component);
    // SAFETY: the instance lives; one reference, one value.
    unsafe {
        assert_eq!(fmi2GetReal(c, &Real::V.reference(), 1, &mut value), OK);
        assert_eq!(fmi2GetReal(c, &Real::Energy.reference(), 1, &mut value), ERROR);
    }
    importer.expect_error(&["energy = inf is not a finite number"]);
}

#[test]
fn a_text_lives_until_the_next_is_got() {
    let importer = Importer::in_step_mode();
    let mut texts = [ptr::null(); 2];
    // SAFETY: the instance lives; two references, two values.
    unsafe {
        let references = [Text::Label.reference(), Text::Home.reference()];
        assert_eq!(fmi2GetString(importer.component, references.as_ptr(), 2, texts.as_mut_ptr()), OK);
        importer.step(0.0, 0.1);
        importer.get(Real::X);
        assert_eq!(CStr::from_ptr(texts[0]), c"spring");
        assert_eq!(CStr::from_ptr(texts[1]), c"");
    }
}

#[test]
fn calculated_values_follow_sets_in_initialization_mode() {
    let importer = Importer::in_initialization_mode();
    // 2π/√4 and 2π/√1: exact, as the square roots are.
    assert_eq!(importer.get(Real::Period), std::f64::consts::PI);
    assert_eq!(importer.set(Real::Stiffness, 1.0), OK);
    assert_eq!(importer.get(Real::Period), std::f64::consts::TAU);
}

#[test]
fn contradictions_are_told_when_values_are_asked_for() {
    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.set(Real::XStart, 1.0), OK);
    assert_eq!(importer.set_boolean(Boolean::Clamped, 1), OK);
    assert_eq!(importer.call(fmi2ExitInitializationMode), ERROR);
    importer.expect_error(&["fmi2ExitInitializationMode", "x_start = 1 m"]);

    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.set_integer(Integer::Substeps, 13), OK);
    assert_eq!(importer.call(fmi2ExitInitializationMode), ERROR);
    importer.expect_error(&["substeps = 13"]);
}

#[test]
fn limits_are_checked_and_named() {
    for (variable, value, parts) in [
        (Real::Stiffness, 0.25, ["fmi2SetReal", "stiffness = 0.25 N/m", "minimum, 0.5 N/m"]),
        (Real::Stiffness, 101.0, ["fmi2SetReal", "stiffness = 101.0 N/m", "maximum, 100.0 N/m"]),
        (Real::Stiffness, f64::NAN, ["fmi2SetReal", "stiffness = NaN", "finite"]),
        (Real::Force, f64::INFINITY, ["fmi2SetReal", "force = inf", "finite"]),
        (Real::Push, f64::NEG_INFINITY, ["fmi2SetReal", "push = -inf", "finite"]),
        (Real::Force, -50.001, ["fmi2SetReal", "force = -50.001 N", "minimum, -50.0 N"]),
        (Real::XStart, 5e-324, ["fmi2SetReal", "x_start = 5e-324 m", "smallest size, 1e-100 m"]),
        (Real::XStart, -9e-101, ["fmi2SetReal", "x_start = -9e-101 m", "closer to it"]),
    ] {
        let importer = Importer::in_initialization_mode();
        let before = importer.get(variable);
        assert_eq!(importer.set(variable, value), ERROR);
        importer.expect_error(&parts);
        assert_eq!(importer.get(variable), before);
    }
    for (variable, value, parts) in [
        (Integer::Substeps, 0, ["fmi2SetInteger", "substeps = 0", "minimum, 1"]),
        (Integer::Substeps, 101, ["fmi2SetInteger", "substeps = 101", "maximum, 100"]),
        (Integer::Law, 3, ["fmi2SetInteger", "law = 3", "linear = 1, cubic = 2"]),
    ] {
        let importer = Importer::in_initialization_mode();
        assert_eq!(importer.set_integer(variable, value), ERROR);
        importer.expect_error(&parts);
    }
    let importer = Importer::in_initialization_mode();
    for value in [0.5, 100.0] {
        assert_eq!(importer.set(Real::Stiffness, value), OK, "a limit belongs to its range");
    }
    for (variable, value) in [(Real::XStart, 0.0), (Real::XStart, -1e-100), (Real::Force, 5e-324)] {
        let importer = Importer::in_initialization_mode();
        assert_eq!(importer.set(variable, value), OK, "an input may be of any size");
    }
}

#[test]
fn only_inputs_and_parameters_are_set_and_those_in_their_phase() {
    let settable = |importer: fn() -> Importer, variable| importer().set(variable, 1.0) == OK;
    for (variable, before, in_steps) in [
        (Real::Force, true, true),
        (Real::Push, true, true),
        (Real::Stiffness, true, false),
        (Real::Trim, true, true),
        (Real::Gravity, false, false),
        (Real::Period, false, false),
        (Real::X, false, false),
        (Real::Energy, false, false),
        (Real::Time, false, false),
    ] {
        assert_eq!(settable(Importer::new, variable), before, "{variable:?} instantiated");
        assert_eq!(
            settable(Importer::in_initialization_mode, variable),
            before,
            "{variable:?} in Initialization Mode"
        );
        assert_eq!(settable(Importer::in_step_mode, variable), in_steps, "{variable:?} in step mode");
    }
    let importer = Importer::in_step_mode();
    assert_eq!(importer.set(Real::Stiffness, 1.0), ERROR);
    importer.expect_error(&["stiffness (Parameter, Fixed)", "in step mode"]);
    let importer = Importer::new();
    assert_eq!(importer.set_integer(Integer::Count, 1), ERROR);
    importer.expect_error(&["count (", ") cannot be set"]);
    assert_eq!(Importer::in_step_mode().set_boolean(Boolean::Clamped, 1), ERROR);
    assert_eq!(Importer::new().set_boolean(Boolean::Moving, 1), ERROR);
    let (importer, label) = (Importer::in_step_mode(), Text::Label.reference());
    // SAFETY: the instance lives; one reference, one value.
    assert_eq!(unsafe { fmi2SetString(importer.component, &label, 1, &c"".as_ptr()) }, ERROR);
}

#[test]
fn one_bad_value_leaves_all_as_they_were() {
    let importer = Importer::in_initialization_mode();
    let references = [Real::Force.reference(), Real::Push.reference(), Real::Stiffness.reference()];
    // SAFETY: the instance lives; three references, three values.
    let status =
        unsafe { fmi2SetReal(importer.component, references.as_ptr(), 3, [1.0, 2.0, -1.0].as_ptr()) };
    assert_eq!(status, ERROR);
    assert_eq!((importer.get(Real::Force), importer.get(Real::Push)), (0.0, 0.0));

    let importer = Importer::in_initialization_mode();
    let references = [Integer::Substeps.reference(), 999];
    // SAFETY: the instance lives; two references, two values.
    let status = unsafe { fmi2SetInteger(importer.component, references.as_ptr(), 2, [5, 5].as_ptr()) };
    assert_eq!(status, ERROR);
    assert_eq!(importer.get_integer(Integer::Substeps), 8);

    let importer = Importer::in_initialization_mode();
    let references = [Text::Label.reference(), Text::Label.reference()];
    let latin_1 = c"\xfc".as_ptr();
    let values = [c"other".as_ptr(), latin_1];
    // SAFETY: the instance lives; two references, two values, both texts.
    let status = unsafe { fmi2SetString(importer.component, references.as_ptr(), 2, values.as_ptr()) };
    assert_eq!(status, ERROR);
    importer.expect_error(&["UTF-8"]);
    assert_eq!(importer.get_text(Text::Label), "spring");
}

#[test]
fn unknown_references_are_refused() {
    let refused = |reference: u32, name: &str, call: unsafe fn(Component, &u32) -> Status| {
        let importer = Importer::in_initialization_mode();
        // SAFETY: the instance lives; one reference, one value.
        assert_eq!(unsafe { call(importer.component, &reference) }, ERROR);
        importer.expect_error(&[name, &reference.to_string()]);
    };
    // SAFETY: the instance lives; one reference, one value.
    unsafe {
        // References of another type are unknown as well.
        for reference in [0, 999, u32::MAX, Integer::Law.reference()] {
            refused(reference, "fmi2GetReal", |c, reference| fmi2GetReal(c, reference, 1, &mut 0.0));
            refused(reference, "fmi2SetReal", |c, reference| fmi2SetReal(c, reference, 1, &0.0));
        }
        refused(1, "fmi2GetInteger", |c, reference| fmi2GetInteger(c, reference, 1, &mut 0));
        refused(1, "fmi2SetInteger", |c, reference| fmi2SetInteger(c, reference, 1, &0));
        refused(1, "fmi2GetBoolean", |c, reference| fmi2GetBoolean(c, reference, 1, &mut 0));
        refused(1, "fmi2SetBoolean", |c, reference| fmi2SetBoolean(c, reference, 1, &0));
        refused(1, "fmi2GetString", |c, reference| fmi2GetString(c, reference, 1, &mut ptr::null()));
        refused(1, "fmi2SetString", |c, reference| fmi2SetString(c, reference, 1, &c"".as_ptr()));
    }
}

/// What C finds behind a getter that fails: values up to the refused one, then 0; of texts, NULL.
#[test]
fn values_from_a_refused_one_on_are_zero_and_texts_are_null() {
    let importer = Importer::in_step_mode();
    let (c, unknown) = (importer.component, 999);
    let (mut reals, mut texts) = ([7.0; 3], [c"old".as_ptr(); 2]);
    // SAFETY: the instance lives; as many references as values.
    unsafe {
        let references = [Real::Stiffness.reference(), unknown, Real::Stiffness.reference()];
        assert_eq!(fmi2GetReal(c, references.as_ptr(), 3, reals.as_mut_ptr()), ERROR);
        let references = [Text::Label.reference(), unknown];
        assert_eq!(fmi2GetString(c, references.as_ptr(), 2, texts.as_mut_ptr()), ERROR);
    }
    assert_eq!((reals, texts), ([4.0, 0.0, 0.0], [ptr::null(); 2]));
    // values that contradict each other: the model computes none
    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.set(Real::XStart, 1.0), OK);
    assert_eq!(importer.set_boolean(Boolean::Clamped, 1), OK);
    let (references, mut reals) = ([Real::Stiffness.reference(), Real::X.reference()], [7.0; 2]);
    // SAFETY: the instance lives; as many references as values.
    unsafe { assert_eq!(fmi2GetReal(importer.component, references.as_ptr(), 2, reals.as_mut_ptr()), ERROR) };
    assert_eq!(reals, [0.0; 2]);
}
