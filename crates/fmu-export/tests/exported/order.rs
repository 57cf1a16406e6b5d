//! Every function in every phase.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use crate::exchange::Exchange;
use crate::fmi2::*;
use crate::importer::{Call, Importer};
use crate::spring::{Boolean, COPIES_PANIC, Integer, Real, Text};
use fmu_export::ffi::types::{Component, DISCARD, ERROR, EventInfo, FATAL, FmuState, OK, Status};
use std::ffi::{CStr, c_char};
use std::ptr;

/// Large letters are for co-simulation, small ones for Model Exchange.
const PHASES: [Phase; 12] = [
    ('I', Importer::new),
    ('N', Importer::in_initialization_mode),
    ('S', Importer::in_step_mode),
    ('T', Importer::terminated),
    ('E', in_error),
    ('F', lost),
    ('i', Exchange::instantiated),
    ('n', Exchange::in_initialization_mode),
    ('v', Exchange::in_event_mode),
    ('c', Exchange::in_continuous_time_mode),
    ('t', Exchange::terminated),
    ('e', Exchange::in_error),
];

fn in_error() -> Importer {
    let importer = Importer::in_step_mode();
    assert_eq!(importer.step(f64::NAN, 1.0), ERROR);
    importer
}

pub fn lost() -> Importer {
    let importer = Importer::in_step_mode();
    COPIES_PANIC.set(true);
    let status = importer.call(fmi2Reset);
    COPIES_PANIC.set(false);
    assert_eq!(status, FATAL);
    assert_eq!(importer.journal.take().last().unwrap().category, "logStatusFatal");
    importer
}

/// A letter, and an instance in that phase.
pub type Phase = (char, fn() -> Importer);

/// Each function, the phases it is allowed in by FMI 2.0.5 (sections 3.2.3 and 4.2.4), and a call with
/// arguments that are in order.
#[rustfmt::skip]
const FUNCTIONS: [(&str, &str, Call); 40] = [
    ("fmi2SetDebugLogging", "INSTE.invcte", |c| unsafe { fmi2SetDebugLogging(c, 0, 0, ptr::null()) }),
    ("fmi2SetupExperiment", "I.....i.....", |c| unsafe { fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) }),
    ("fmi2EnterInitializationMode", "I.....i.....", |c| unsafe { fmi2EnterInitializationMode(c) }),
    ("fmi2ExitInitializationMode", ".N.....n....", |c| unsafe { fmi2ExitInitializationMode(c) }),
    ("fmi2Terminate", "..S.....vc..", |c| unsafe { fmi2Terminate(c) }),
    ("fmi2Reset", "INSTE.invcte", |c| unsafe { fmi2Reset(c) }),
    ("fmi2GetReal", ".NSTE..nvcte", |c| unsafe { fmi2GetReal(c, &Real::X.reference(), 1, &mut 0.0) }),
    ("fmi2GetInteger", ".NSTE..nvcte",
     |c| unsafe { fmi2GetInteger(c, &Integer::Count.reference(), 1, &mut 0) }),
    ("fmi2GetBoolean", ".NSTE..nvcte",
     |c| unsafe { fmi2GetBoolean(c, &Boolean::Moving.reference(), 1, &mut 0) }),
    ("fmi2GetString", ".NSTE..nvcte",
     |c| unsafe { fmi2GetString(c, &Text::Label.reference(), 1, &mut ptr::null()) }),
    ("fmi2SetReal", "INS...invc..", |c| unsafe { fmi2SetReal(c, &Real::Force.reference(), 1, &1.0) }),
    ("fmi2SetInteger", "INS...inv...", |c| unsafe { fmi2SetInteger(c, &Integer::Fault.reference(), 1, &0) }),
    ("fmi2SetBoolean", "INS...inv...", |c| unsafe { fmi2SetBoolean(c, &Boolean::Held.reference(), 1, &1) }),
    ("fmi2SetString", "INS...inv...", |c| unsafe { fmi2SetString(c, ptr::null(), 0, ptr::null()) }),
    ("fmi2GetFMUstate", "INSTE.invcte", |c| unsafe { fmi2GetFMUstate(c, &mut ptr::null_mut()) }),
    ("fmi2SetFMUstate", "INSTE.invcte", |c| unsafe { with_state(c, |c, state| fmi2SetFMUstate(c, state)) }),
    ("fmi2FreeFMUstate", "INSTE.invcte",
     |c| unsafe { with_state(c, |c, mut state| fmi2FreeFMUstate(c, &mut state)) }),
    ("fmi2SerializedFMUstateSize", "INSTE.invcte",
     |c| unsafe { with_state(c, |c, state| fmi2SerializedFMUstateSize(c, state, &mut 0)) }),
    ("fmi2SerializeFMUstate", "INSTE.invcte", |c| unsafe { with_state(c, |c, state| serialize(c, state).0) }),
    ("fmi2DeSerializeFMUstate", "INSTE.invcte", |c| unsafe { with_state(c, serialize_and_back) }),
    ("fmi2GetDirectionalDerivative", ".NSTE..nvcte",
     |c| unsafe {
         fmi2GetDirectionalDerivative(c, &Real::V.reference(), 1, &Real::X.reference(), 1, &1.0, &mut 0.0)
     }),
    ("fmi2SetRealInputDerivatives", ".NS.........",
     |c| unsafe { fmi2SetRealInputDerivatives(c, &Real::Force.reference(), 1, &1, &0.5) }),
    ("fmi2GetRealOutputDerivatives", "..STE.......",
     |c| unsafe { fmi2GetRealOutputDerivatives(c, &Real::X.reference(), 1, &1, &mut 0.0) }),
    ("fmi2DoStep", "..S.........", |c| unsafe { fmi2DoStep(c, 0.0, 0.1, 1) }),
    ("fmi2CancelStep", "............", |c| unsafe { fmi2CancelStep(c) }),
    ("fmi2GetStatus", "..STE.......", |c| unsafe { fmi2GetStatus(c, 0, &mut 0) }),
    ("fmi2GetRealStatus", "..STE.......", |c| unsafe { fmi2GetRealStatus(c, 2, &mut 0.0) }),
    ("fmi2GetIntegerStatus", "..STE.......", |c| unsafe { fmi2GetIntegerStatus(c, 0, &mut 0) }),
    ("fmi2GetBooleanStatus", "..STE.......", |c| unsafe { fmi2GetBooleanStatus(c, 3, &mut 0) }),
    ("fmi2GetStringStatus", "..STE.......", |c| unsafe { fmi2GetStringStatus(c, 1, &mut ptr::null()) }),
    ("fmi2EnterEventMode", "........vc..", |c| unsafe { fmi2EnterEventMode(c) }),
    ("fmi2NewDiscreteStates", "........v...",
     |c| unsafe { fmi2NewDiscreteStates(c, &mut EventInfo::default()) }),
    ("fmi2EnterContinuousTimeMode", "........v...", |c| unsafe { fmi2EnterContinuousTimeMode(c) }),
    ("fmi2CompletedIntegratorStep", ".........c..",
     |c| unsafe { fmi2CompletedIntegratorStep(c, 1, &mut 0, &mut 0) }),
    ("fmi2SetTime", "........vc..", |c| unsafe { fmi2SetTime(c, 0.5) }),
    ("fmi2SetContinuousStates", ".........c..",
     |c| unsafe { fmi2SetContinuousStates(c, [1.0, 0.0].as_ptr(), 2) }),
    ("fmi2GetDerivatives", "........vcte", |c| unsafe { fmi2GetDerivatives(c, [0.0; 2].as_mut_ptr(), 2) }),
    ("fmi2GetEventIndicators", ".......nvcte", |c| unsafe { fmi2GetEventIndicators(c, &mut 0.0, 1) }),
    ("fmi2GetContinuousStates", ".......nvcte",
     |c| unsafe { fmi2GetContinuousStates(c, [0.0; 2].as_mut_ptr(), 2) }),
    ("fmi2GetNominalsOfContinuousStates", "......i.vcte",
     |c| unsafe { fmi2GetNominalsOfContinuousStates(c, [0.0; 2].as_mut_ptr(), 2) }),
];

/// Does `body` with a saved state of an instance of either version.
pub unsafe fn with_state(c: Component, body: unsafe fn(Component, FmuState) -> Status) -> Status {
    let mut state = ptr::null_mut();
    // SAFETY: the instance lives. Where it cannot be saved the state stays NULL, which the body's function
    // then sees.
    unsafe {
        fmi2GetFMUstate(c, &mut state);
        body(c, state)
    }
}

unsafe fn serialize(c: Component, state: FmuState) -> (Status, Vec<c_char>) {
    let mut size = 0;
    // SAFETY: the instance lives, and the array is as long as stated.
    unsafe {
        fmi2SerializedFMUstateSize(c, state, &mut size);
        let mut bytes = vec![0; size];
        (fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr(), size), bytes)
    }
}

unsafe fn serialize_and_back(c: Component, state: FmuState) -> Status {
    // SAFETY: the instance lives, and the array is as long as stated.
    unsafe {
        let (_, bytes) = serialize(c, state);
        fmi2DeSerializeFMUstate(c, bytes.as_ptr(), bytes.len(), &mut ptr::null_mut())
    }
}

#[test]
fn every_function_is_served_in_its_phases_alone() {
    check_order(&FUNCTIONS, &PHASES);
}

pub fn check_order(functions: &[(&str, &str, Call)], phases: &[Phase]) {
    for &(name, allowed, function) in functions {
        for &(phase, in_phase) in phases {
            let importer = in_phase();
            importer.journal.take();
            // SAFETY: the instance lives.
            let status = unsafe { function(importer.component) };
            let messages = importer.journal.take();
            if allowed.contains(phase) {
                // Two kinds of status have nothing to tell, and say so in the log if warnings are wanted.
                let expected =
                    if matches!(name, "fmi2GetIntegerStatus" | "fmi2GetStringStatus") { DISCARD } else { OK };
                assert_eq!(status, expected, "{name} in {phase}: {messages:?}");
                assert!(messages.is_empty(), "{name} in {phase}: {messages:?}");
            } else {
                assert_eq!(status, ERROR, "{name} in {phase}");
                let last = messages.last().unwrap_or_else(|| panic!("{name} in {phase} is not logged"));
                assert!(last.text.starts_with(name) && last.category == "logStatusError", "{last:?}");
            }
        }
    }
}

#[test]
fn an_error_leaves_getters_and_reset() {
    let mut failed = 0;
    for (name, allowed, function) in FUNCTIONS {
        // A state that is refused and a getter that fails end no simulation; in the phase S there is no such
        // state.
        if allowed.contains('S') || name.starts_with("fmi2Get") {
            continue;
        }
        failed += 1;
        let importer = Importer::swinging();
        // SAFETY: the instance lives.
        assert_eq!(unsafe { function(importer.component) }, ERROR, "{name}");
        assert_eq!(importer.get(Real::X), 1.0);
        assert_eq!(importer.step(0.0, 0.1), ERROR);
        importer.expect_ok(&[fmi2Reset, fmi2EnterInitializationMode, fmi2ExitInitializationMode]);
        assert_eq!(importer.get(Real::X), 0.0);
        assert_eq!(importer.step(0.0, 0.1), OK);
    }
    assert_eq!(failed, 10);
}

#[test]
fn a_saved_state_brings_an_instance_back_from_an_error() {
    let importer = Importer::swinging();
    let mut state = ptr::null_mut();
    // SAFETY: the instance lives.
    unsafe {
        assert_eq!(fmi2GetFMUstate(importer.component, &mut state), OK);
        assert_eq!(importer.step(5.0, 0.1), ERROR);
        assert_eq!(fmi2SetFMUstate(importer.component, state), OK);
    }
    assert_eq!(importer.step(0.0, 0.1), OK);
}

#[test]
fn no_function_takes_null_for_an_instance() {
    for (name, _, function) in FUNCTIONS {
        // SAFETY: NULL is what is tested.
        assert_eq!(unsafe { function(ptr::null_mut()) }, ERROR, "{name}");
    }
    // SAFETY: NULL is what is tested.
    unsafe { fmi2FreeInstance(ptr::null_mut()) };
}

#[test]
fn the_version_is_2_0_on_the_default_platform() {
    // SAFETY: both return texts that live for ever.
    let [version, platform] =
        unsafe { [fmi2GetVersion(), fmi2GetTypesPlatform()].map(|text| CStr::from_ptr(text)) };
    assert_eq!((version, platform), (c"2.0", c"default"));
}

#[test]
fn reset_gives_a_fresh_instance_bit_for_bit() {
    let fresh = Importer::new();
    let used = Importer::swinging();
    assert_eq!(used.set(Real::Force, 3.0), OK);
    assert_eq!(used.step(0.0, 0.1), OK);
    used.expect_ok(&[fmi2Reset]);
    assert_eq!(crate::states::bytes(&used), crate::states::bytes(&fresh));
}
