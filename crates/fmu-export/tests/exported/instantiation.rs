//! Instantiation: kinds, guids, resources, names, callbacks.

use crate::fmi2::*;
use crate::fmi3::fmi3InstantiateModelExchange;
use crate::importer::{Importer, Journal, SILENT, expect_error, instantiate, write_down_3};
use crate::spring::{GUID, Spring, Text};
use fmu_export::ffi::types::{CO_SIMULATION, CallbackFunctions, ERROR, OK};
use fmu_export::{Model, fnv1a_128};
use std::ffi::CString;
use std::path::PathBuf;
use std::process::Command;
use std::{fs, ptr};

/// What an instance with this guid and location made of them; None if it was refused.
fn made_of(guid: &str, location: Option<&str>) -> Result<[String; 2], Box<Journal>> {
    let (component, journal) = instantiate("one", CO_SIMULATION, guid, location, false);
    if component.is_null() {
        return Err(journal);
    }
    let importer = Importer::of((component, journal)).after(&[fmi2EnterInitializationMode]);
    Ok([Text::Label, Text::Home].map(|variable| importer.get_text(variable)))
}

/// A resources folder with a name that needs escapes, and the guid of what is in it.
fn resources(name: &str, payload: &str) -> (PathBuf, String) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name} mit Ümlaut %41"));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join(Spring::PAYLOAD), payload).unwrap();
    let hash = fnv1a_128(payload.bytes());
    (folder, format!("{{0123456789abcdef0123456789abcdef-{hash:032x}}}"))
}

#[test]
fn other_kinds_are_refused() {
    for kind in [2, 77, u32::MAX] {
        let (component, journal) = instantiate("one", kind, Spring::GUID, None, false);
        assert!(component.is_null());
        expect_error(&journal, &["fmi2Instantiate", &format!("fmuType {kind}"), "co-simulation"]);
    }
}

#[test]
fn the_guid_is_compared_in_full() {
    let base = "0123456789abcdef0123456789abcdef";
    for wrong in [
        String::new(),
        "{}".to_owned(),
        base.to_owned(),
        format!("{{{base}"),
        format!("{{{base}0}}"),
        format!("{{{base}-}}"),
        format!("{{{base}-123}}"),
        format!("{{{base}-+123456789abcdef0123456789abcdef}}"),
        "{0123456789abcdef0123456789abcdee}".to_owned(),
        "{0123456789abcdef0123456789abcde}".to_owned(),
        "{1123456789abcdef0123456789abcdef-0123456789abcdef0123456789abcdef}".to_owned(),
    ] {
        let journal = made_of(&wrong, None).unwrap_err();
        expect_error(&journal, &["fmi2Instantiate", &format!("{wrong:?}"), Spring::GUID]);
    }
    assert!(made_of(Spring::GUID, None).is_ok());
}

#[test]
fn a_payload_is_what_the_guid_states() {
    let (folder, guid) = resources("payload", "label");
    let path = folder.to_str().unwrap();
    let escaped = path.replace('%', "%25").replace(' ', "%20").replace('Ü', "%C3%9C");
    for location in [
        path.to_owned(),
        format!("{path}/"),
        format!("file://{escaped}"),
        format!("file:{escaped}"),
        format!("file://localhost{escaped}/"),
    ] {
        let made = made_of(&guid, Some(&location)).map_err(|journal| journal.take());
        assert_eq!(made, Ok(["label".to_owned(), path.to_owned()]), "{location}");
    }
    // A plain unit takes no payload, even if there is one.
    let made = made_of(Spring::GUID, Some(path)).map_err(|journal| journal.take());
    assert_eq!(made, Ok(["spring".to_owned(), path.to_owned()]));

    fs::write(folder.join(Spring::PAYLOAD), "lapel").unwrap();
    let journal = made_of(&guid, Some(path)).unwrap_err();
    expect_error(&journal, &["resources/spring.toml has the fingerprint", "states"]);
    fs::remove_file(folder.join(Spring::PAYLOAD)).unwrap();
    let journal = made_of(&guid, Some(path)).unwrap_err();
    expect_error(&journal, &["spring.toml", "cannot be read"]);
    fs::create_dir(folder.join(Spring::PAYLOAD)).unwrap();
    let journal = made_of(&guid, Some(path)).unwrap_err();
    expect_error(&journal, &["spring.toml", "cannot be read"]);
    // nobody writes into this pipe: to open it would be to wait for ever
    fs::remove_dir(folder.join(Spring::PAYLOAD)).unwrap();
    assert!(Command::new("mkfifo").arg(folder.join(Spring::PAYLOAD)).status().unwrap().success());
    let journal = made_of(&guid, Some(path)).unwrap_err();
    expect_error(&journal, &["spring.toml", "cannot be read: it is not a regular file"]);
    let journal = made_of(&guid, None).unwrap_err();
    expect_error(&journal, &["needs resources/spring.toml"]);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn hostile_locations_harm_nobody() {
    let long = "x/".repeat(100_000);
    for location in [
        "",
        "file://",
        "http://host/p",
        "file:///%",
        "file:///%00",
        "%s%n%s%n",
        "/dev/null",
        "../../..",
        &long,
    ] {
        assert!(made_of(Spring::GUID, Some(location)).is_ok(), "a plain unit needs no resources");
        let (_, guid) = resources("hostile", "label");
        assert!(made_of(&guid, Some(location)).is_err(), "{location}");
    }
}

#[test]
fn an_unusable_location_is_a_warning() {
    let made = instantiate("one", CO_SIMULATION, Spring::GUID, Some("http://host/p"), true);
    let messages = Importer::of(made).journal.take();
    assert_eq!(messages[0].category, "logStatusWarning");
    assert!(messages[0].text.contains("http://host/p"));
}

/// Nothing is in a plain unit's resources that it would need.
#[test]
fn a_location_that_is_not_utf_8_is_a_warning() {
    let (journal, of_3) = (Journal::new(), Journal::new());
    let (name, latin_1) = (c"one".as_ptr(), c"/home/J\xfcrgen".as_ptr());
    // SAFETY: texts and callbacks live until the call returns.
    let made = unsafe {
        [
            fmi2Instantiate(name, CO_SIMULATION, GUID.as_ptr(), latin_1, &journal.callbacks(), 0, 1),
            fmi3InstantiateModelExchange(
                name,
                GUID.as_ptr(),
                latin_1,
                false,
                true,
                of_3.environment(),
                Some(write_down_3),
            ),
        ]
    };
    for (component, journal) in made.into_iter().zip([journal, of_3]) {
        let messages = Importer::of((component, journal)).journal.take();
        assert_eq!(messages[0].category, "logStatusWarning");
        assert!(
            messages[0].text.contains("/home/J\u{fffd}rgen\" is not a local folder in UTF-8"),
            "{messages:?}"
        );
    }
}

#[test]
fn a_model_that_refuses_or_panics_gives_no_instance() {
    for (name, part) in [("fail", "no spring today"), ("panic", "spring snapped at once")] {
        let (component, journal) = instantiate(name, CO_SIMULATION, Spring::GUID, None, false);
        assert!(component.is_null());
        expect_error(&journal, &["fmi2Instantiate", part]);
    }
}

#[test]
fn names_may_be_missing_and_callbacks_too() {
    let guid = GUID.as_ptr();
    for name in [ptr::null(), c"".as_ptr(), c"\xff\xfe".as_ptr(), c"%s%n".as_ptr()] {
        for callbacks in [ptr::null(), ptr::from_ref(&SILENT)] {
            // SAFETY: texts and callbacks live until the call returns; the instance lives until it is freed.
            unsafe {
                let c = fmi2Instantiate(name, CO_SIMULATION, guid, ptr::null(), callbacks, 1, 1);
                assert!(!c.is_null());
                assert_eq!(fmi2EnterInitializationMode(c), OK);
                assert_eq!(fmi2ExitInitializationMode(c), OK);
                assert_eq!(fmi2DoStep(c, 0.0, 0.1, 1), OK);
                assert_eq!(fmi2DoStep(c, 7.0, 0.1, 1), ERROR);
                fmi2FreeInstance(c);
                // Refused without a logger to tell.
                assert!(fmi2Instantiate(name, 2, guid, ptr::null(), callbacks, 1, 1).is_null());
                assert!(
                    fmi2Instantiate(name, CO_SIMULATION, ptr::null(), ptr::null(), callbacks, 1, 1).is_null()
                );
            }
        }
    }
}

#[test]
fn texts_that_are_no_text_are_refused() {
    let journal = Journal::new();
    let callbacks = journal.callbacks();
    let (name, latin_1) = (c"one".as_ptr(), c"\xfc".as_ptr());
    let with_payload = CString::new(Spring::GUID.replace('}', &format!("-{:032x}}}", 0))).unwrap();
    for (guid, location, message) in [
        (ptr::null(), ptr::null(), "fmuGUID is NULL"),
        (latin_1, ptr::null(), "fmuGUID is not UTF-8"),
        (with_payload.as_ptr(), latin_1, "needs resources/spring.toml"),
    ] {
        // SAFETY: texts and callbacks live until the call returns.
        let made = unsafe { fmi2Instantiate(name, CO_SIMULATION, guid, location, &callbacks, 0, 0) };
        assert!(made.is_null());
        expect_error(&journal, &[message]);
    }
}

#[test]
fn an_environment_may_be_null_while_there_is_a_logger() {
    use fmu_export::ffi::types::{CallbackLogger, ComponentEnvironment, Status, Text};
    unsafe extern "C" fn deaf(environment: ComponentEnvironment, _: Text, _: Status, _: Text, _: Text) {
        assert!(environment.is_null());
    }
    type Fixed = unsafe extern "C" fn(ComponentEnvironment, Text, Status, Text, Text);
    // SAFETY: both are pointers to C functions, and one that takes fewer arguments leaves the rest alone.
    let logger = unsafe { std::mem::transmute::<Fixed, CallbackLogger>(deaf) };
    let callbacks = CallbackFunctions { logger: Some(logger), ..SILENT };
    // SAFETY: texts and callbacks live until the call returns; the instance lives until it is freed.
    unsafe {
        let guid = GUID.as_ptr();
        let c = fmi2Instantiate(c"one".as_ptr(), CO_SIMULATION, guid, ptr::null(), &callbacks, 0, 1);
        assert_eq!(fmi2DoStep(c, 0.0, 0.1, 1), ERROR);
        fmi2FreeInstance(c);
    }
}
