//! Communication steps and the experiment.

use crate::allocator;
use crate::derivatives::set_rate;
use crate::fmi2::*;
use crate::importer::Importer;
use crate::spring::{FAIL_IN_STEP, Integer, Real};
use crate::states::bytes;
use fmu_export::ffi::types::{DISCARD, ERROR, OK, Status};

fn set_up(tolerance: Option<f64>, start: f64, stop: Option<f64>) -> (Importer, Status) {
    let importer = Importer::new();
    let [(has_tolerance, tolerance), (has_stop, stop)] =
        [tolerance, stop].map(|value| (i32::from(value.is_some()), value.unwrap_or(f64::NAN)));
    // SAFETY: the instance lives.
    let status =
        unsafe { fmi2SetupExperiment(importer.component, has_tolerance, tolerance, start, has_stop, stop) };
    (importer, status)
}

fn started(start: f64, stop: Option<f64>) -> Importer {
    let (importer, status) = set_up(None, start, stop);
    assert_eq!(status, OK);
    importer.after(&[fmi2EnterInitializationMode, fmi2ExitInitializationMode])
}

fn time(importer: &Importer) -> f64 {
    let mut time = f64::NAN;
    // SAFETY: the instance lives.
    assert_eq!(unsafe { fmi2GetRealStatus(importer.component, 2, &mut time) }, OK);
    time
}

#[test]
fn an_experiment_has_finite_times_in_order_and_a_tolerance_above_0() {
    for (tolerance, start, stop) in
        [(None, 0.0, None), (Some(1e-8), -1.0, Some(1.0)), (None, 2.0, Some(2.0)), (Some(5.0), 1e9, None)]
    {
        assert_eq!(set_up(tolerance, start, stop).1, OK);
    }
    for (tolerance, start, stop, part) in [
        (Some(f64::NAN), 0.0, None, "tolerance = NaN"),
        (Some(f64::INFINITY), 0.0, None, "tolerance = inf"),
        (Some(0.0), 0.0, None, "tolerance = 0.0"),
        (Some(-1e-6), 0.0, None, "tolerance = -1e-6"),
        (None, f64::NAN, None, "startTime = NaN s"),
        (None, f64::NEG_INFINITY, None, "startTime = -inf s"),
        (None, 1.0, Some(0.5), "stopTime = 0.5 s"),
        (None, 0.0, Some(f64::NAN), "stopTime = NaN s"),
        (None, 0.0, Some(f64::INFINITY), "stopTime = inf s"),
    ] {
        let (importer, status) = set_up(tolerance, start, stop);
        assert_eq!(status, ERROR);
        importer.expect_error(&["fmi2SetupExperiment", part]);
    }
}

#[test]
fn steps_that_make_no_sense_are_refused_and_change_nothing() {
    for (point, size, part) in [
        (0.0, -0.1, "communicationStepSize = -0.1 s"),
        (0.0, f64::NAN, "communicationStepSize = NaN s"),
        (0.0, f64::INFINITY, "communicationStepSize = inf s"),
        (f64::NAN, 0.1, "currentCommunicationPoint = NaN s"),
        (f64::INFINITY, 0.1, "currentCommunicationPoint = inf s"),
        (1e-6, 0.1, "currentCommunicationPoint = 1e-6 s, but the last step ended at 0.0 s"),
        (-0.1, 0.1, "currentCommunicationPoint = -0.1 s, but the last step ended at 0.0 s"),
    ] {
        let importer = Importer::swinging();
        let x = importer.get(Real::X);
        assert_eq!(importer.step(point, size), ERROR);
        importer.expect_error(&["fmi2DoStep", part]);
        assert_eq!(
            (importer.get(Real::X), importer.get_integer(Integer::Count), time(&importer)),
            (x, 0, 0.0)
        );
    }
    let importer = started(1e308, None);
    assert_eq!(importer.step(1e308, 1e308), ERROR);
    importer.expect_error(&["no finite end"]);
}

#[test]
fn the_first_point_is_the_start_time() {
    assert_eq!(started(3.0, None).step(3.0, 0.1), OK);
    let importer = started(3.0, None);
    assert_eq!(importer.step(0.0, 0.1), ERROR);
    importer.expect_error(&["0.0 s", "3.0 s"]);
}

#[test]
fn no_step_goes_past_the_stop_time() {
    let importer = started(0.0, Some(0.3));
    for point in [0.0, 0.1, 0.2] {
        // 0.1 + 0.2 is above 0.3 by rounding, which is no reason to refuse.
        assert_eq!(importer.step(point, 0.1), OK);
    }
    assert_eq!(importer.step(0.3, 1e-6), ERROR);
    importer.expect_error(&["stopTime 0.3 s"]);
}

#[test]
fn importers_may_add_up_times_in_their_own_way() {
    // OMSimulator adds h to h; a counter multiplies; both reach 100 s, rounded differently.
    let (adding, counting) = (Importer::swinging(), Importer::swinging());
    let mut sum = 0.0;
    for step in 0..100_000 {
        assert_eq!(adding.step(sum, 1e-3), OK, "{:?}", adding.journal.take());
        sum += 1e-3;
        assert_eq!(counting.step(f64::from(step) * 1e-3, 1e-3), OK, "{:?}", counting.journal.take());
    }
    assert_eq!(time(&adding), sum);
    assert!((time(&counting) - 100.0).abs() <= 100.0 * f64::EPSILON);
}

#[test]
fn a_step_in_unix_time_is_not_taken_for_rounding() {
    let importer = started(1.7e9, None);
    assert_eq!(importer.step(1.7e9, 1.2), OK);
    // 1.7e9 + 1.2 is rounded to 2.4e-7 s
    assert_eq!(importer.step(1.7e9 + 1.2 - 1e-6, 1.2), OK, "{:?}", importer.journal.take());
    assert_eq!(importer.step(1.7e9 + 1.2, 1.2), ERROR);
    importer.expect_error(&["but the last step ended at"]);
}

#[test]
fn a_clock_that_differs_is_made_up_for() {
    let importer = Importer::in_step_mode();
    assert_eq!(importer.step(0.0, 0.1), OK);
    // A force that grows by 1 N/s measures how long a step is.
    assert_eq!(set_rate(&importer, Real::Force.reference(), 1, 1.0), OK);
    assert_eq!(importer.step(0.1 + 5e-10, 0.1), OK);
    assert_eq!(time(&importer), 0.1 + 5e-10 + 0.1);
    // Eight substeps, each rounded once.
    assert!((importer.get(Real::Force) - (0.1 + 5e-10)).abs() <= 8.0 * f64::EPSILON * 0.1);
}

#[test]
fn tiny_steps_are_taken_and_those_that_do_not_reach_the_own_time_change_nothing() {
    let importer = Importer::swinging();
    assert_eq!(importer.step(0.0, 1.0), OK);
    assert_eq!(importer.step(1.0, 1e-17), OK);
    assert_eq!((importer.get_integer(Integer::Count), time(&importer)), (2, 1.0));
    let before = bytes(&importer);
    assert_eq!(importer.step(1.0 - 1e-10, 1e-10), OK);
    assert_eq!(importer.step(1.0 - 5e-10, 1e-17), OK);
    assert_eq!(bytes(&importer), before);
    assert!(importer.journal.take().is_empty());
}

#[test]
fn a_step_that_fails_is_an_error_and_never_discarded() {
    let importer = Importer::swinging();
    assert_eq!(importer.step(0.0, 0.25), OK);
    assert_eq!(importer.set_integer(Integer::Fault, FAIL_IN_STEP), OK);
    assert_eq!(importer.step(0.25, 0.25), ERROR);
    importer.expect_error(&["fmi2DoStep: no step from 0.25 s"]);
    assert_eq!(time(&importer), 0.25);
}

#[test]
fn what_can_be_told_of_the_status_is_told() {
    let importer = Importer::logging(true);
    let c = importer.component;
    importer.expect_ok(&[fmi2EnterInitializationMode, fmi2ExitInitializationMode]);
    importer.journal.take();
    // SAFETY: the instance lives.
    unsafe {
        let mut status = 77;
        assert_eq!((fmi2GetStatus(c, 0, &mut status), status), (OK, OK));
        let mut terminated = 77;
        assert_eq!((fmi2GetBooleanStatus(c, 3, &mut terminated), terminated), (OK, 0));
        assert!(importer.journal.take().is_empty());
        for kind in [1, 2, 3, 4, u32::MAX] {
            assert_eq!(fmi2GetStatus(c, kind, &mut status), DISCARD);
            assert_eq!(importer.journal.take()[0].category, "logStatusDiscard");
        }
        for kind in [0, 1, 3, 99] {
            assert_eq!(fmi2GetRealStatus(c, kind, &mut 0.0), DISCARD);
        }
        // Asking is no error: the simulation goes on.
        assert_eq!(importer.step(0.0, 0.1), OK);
        assert_eq!(importer.step(9.0, 0.1), ERROR);
        assert_eq!((fmi2GetStatus(c, 0, &mut status), status), (OK, ERROR));
    }
}

#[test]
fn a_step_with_its_sets_and_gets_allocates_nothing() {
    let importer = Importer::swinging();
    let (force, x) = (Real::Force.reference(), Real::X.reference());
    let before = allocator::allocations();
    let mut statuses = 0;
    for step in 0..1000 {
        let point = f64::from(step) * 0.01;
        // SAFETY: the instance lives; one of each.
        unsafe {
            statuses |= fmi2SetReal(importer.component, &force, 1, &0.5)
                | fmi2SetRealInputDerivatives(importer.component, &force, 1, &1, &0.25)
                | fmi2DoStep(importer.component, point, 0.01, 1)
                | fmi2GetReal(importer.component, &x, 1, &mut 0.0)
                | fmi2GetRealOutputDerivatives(importer.component, &x, 1, &1, &mut 0.0)
                | fmi2GetDirectionalDerivative(importer.component, &x, 1, &force, 1, &1.0, &mut 0.0);
        }
    }
    let allocated = allocator::allocations() - before;
    assert_eq!((statuses, allocated), (OK, 0));
    // The counter does count.
    drop(std::hint::black_box(Box::new(1)));
    assert_eq!(allocator::allocations() - before, allocated + 1);
}
