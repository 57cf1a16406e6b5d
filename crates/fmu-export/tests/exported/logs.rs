//! Log categories.

use crate::fmi2::fmi2SetDebugLogging;
use crate::importer::{Importer, Message};
use crate::spring::{Integer, TALK_IN_STEP};
use fmu_export::ffi::types::{ERROR, OK, Status, WARNING};
use std::ffi::CString;

fn want(importer: &Importer, on: bool, categories: &[&str]) -> Status {
    let categories: Vec<_> = categories.iter().map(|&name| CString::new(name).unwrap()).collect();
    let pointers: Vec<_> = categories.iter().map(|name| name.as_ptr()).collect();
    // SAFETY: the instance lives; the texts live until the call returns.
    unsafe { fmi2SetDebugLogging(importer.component, i32::from(on), pointers.len(), pointers.as_ptr()) }
}

/// What a step that has a warning, an event and information to tell leaves in the log.
fn told(importer: &Importer) -> Vec<(Status, String)> {
    assert_eq!(importer.set_integer(Integer::Fault, TALK_IN_STEP), OK);
    importer.journal.take();
    assert_eq!(importer.step(0.0, 0.1), OK);
    importer.journal.take().into_iter().map(|Message { status, category, .. }| (status, category)).collect()
}

#[test]
fn the_log_holds_what_was_asked_for() {
    let warning = || (WARNING, "logStatusWarning".to_owned());
    let event = || (OK, "logEvents".to_owned());
    let information = || (OK, "logAll".to_owned());
    for (on, categories, expected) in [
        (false, &[][..], vec![]),
        (false, &["logAll"], vec![]),
        (true, &[], vec![warning(), event(), information()]),
        (true, &["logAll"], vec![warning(), event(), information()]),
        (true, &["logEvents"], vec![event()]),
        (true, &["logStatusWarning", "logEvents"], vec![warning(), event()]),
        (true, &["logStatusError", "logStatusFatal", "logStatusDiscard"], vec![]),
    ] {
        let importer = Importer::in_step_mode();
        assert_eq!(want(&importer, on, categories), OK);
        assert_eq!(told(&importer), expected, "{on} {categories:?}");
    }
}

#[test]
fn errors_are_always_logged() {
    for categories in [&[][..], &["logEvents"]] {
        for on in [false, true] {
            let importer = Importer::in_step_mode();
            assert_eq!(want(&importer, on, categories), OK);
            assert_eq!(importer.step(7.0, 0.1), ERROR);
            importer.expect_error(&["fmi2DoStep"]);
        }
    }
}

#[test]
fn an_unknown_category_is_warned_of_and_left_out() {
    for (categories, events) in [(&["logEvents", "logNonsense"][..], 1), (&["logNonsense"], 0)] {
        let importer = Importer::in_step_mode();
        assert_eq!(want(&importer, true, categories), OK);
        let messages = importer.journal.take();
        let [message] = &messages[..] else { panic!("{messages:?}") };
        assert_eq!((message.status, message.category.as_str()), (WARNING, "logStatusWarning"));
        for part in ["fmi2SetDebugLogging", "\"logNonsense\"", "logStatusWarning", "logAll"] {
            assert!(message.text.contains(part), "{message:?}");
        }
        // the others hold
        assert_eq!(told(&importer), vec![(OK, "logEvents".to_owned()); events]);
        assert_eq!(want(&importer, false, categories), OK);
        assert!(importer.journal.take().is_empty(), "who wants no log gets none");
    }
}

#[test]
fn messages_go_to_their_instance_and_are_no_format() {
    let importer = Importer::logging(true);
    let messages = importer.journal.take();
    assert_eq!(messages.len(), 1);
    assert_eq!((messages[0].instance.as_str(), messages[0].text.as_str()), ("one", "one is a spring"));
    let importer = Importer::in_step_mode();
    assert_eq!(want(&importer, true, &["logStatusWarning"]), OK);
    assert_eq!(importer.set_integer(Integer::Fault, TALK_IN_STEP), OK);
    assert_eq!(importer.step(0.0, 0.1), OK);
    assert_eq!(importer.journal.take()[0].text, "100%s warning");
}

#[test]
fn a_clean_run_is_silent() {
    let importer = Importer::swinging();
    for step in 0..100 {
        assert_eq!(importer.step(f64::from(step) * 0.01, 0.01), OK);
    }
    assert!(importer.journal.take().is_empty());
}
