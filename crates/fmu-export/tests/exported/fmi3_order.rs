//! Every function of FMI 3.0 in every phase.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use crate::fmi3::*;
use crate::importer::{Call, Importer, Journal, Message, write_down_3};
use crate::order::{Phase, check_order, with_state};
use crate::spring::{Boolean, COPIES_PANIC, GUID, Integer, Real, Text};
use fmu_export::ffi::fmi3::types::IntermediateUpdateCallback;
use fmu_export::ffi::types::{Component, ERROR, FATAL, FmuState, OK, Status};
use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};

/// Instances as FMI 3.0 makes them. Freeing is the same in both versions.
pub struct Fmi3;

impl Fmi3 {
    pub fn co_simulation(event_mode: bool, early_return: bool) -> Importer {
        Self::updated(event_mode, early_return, None)
    }

    /// An instance whose importer sets inputs inside steps.
    pub fn updated(event_mode: bool, early_return: bool, update: IntermediateUpdateCallback) -> Importer {
        Self::with_intermediate(None, false, [event_mode, early_return], update)
    }

    /// An instance whose importer names a variable for intermediate updates.
    fn with_intermediate(
        variable: Option<Real>,
        logging: bool,
        [event_mode, early_return]: [bool; 2],
        update: IntermediateUpdateCallback,
    ) -> Importer {
        let journal = Journal::new();
        let reference = variable.map(Real::reference);
        let component = unsafe {
            fmi3InstantiateCoSimulation(
                c"one".as_ptr(),
                GUID.as_ptr(),
                null(),
                false,
                logging,
                event_mode,
                early_return,
                reference.as_ref().map_or(null(), std::ptr::from_ref),
                usize::from(reference.is_some()),
                journal.environment(),
                Some(write_down_3),
                update,
            )
        };
        Importer::of((component, journal))
    }

    pub fn model_exchange() -> Importer {
        let journal = Journal::new();
        Importer::of((instantiate_exchange(GUID.as_ptr(), &journal), journal))
    }

    fn plain() -> Importer {
        Self::co_simulation(false, false)
    }

    /// In step mode, or in Event Mode if that is used; a spring that swings from 1 m.
    pub fn started(importer: Importer) -> Importer {
        unsafe {
            assert_eq!(fmi3EnterInitializationMode(importer.component, false, 0.0, 0.0, false, 0.0), OK);
            assert_eq!(fmi3SetFloat64(importer.component, &Real::XStart.reference(), 1, &1.0, 1), OK);
            assert_eq!(fmi3ExitInitializationMode(importer.component), OK);
        }
        importer
    }
}

/// An instance for Model Exchange; NULL where the token is refused.
fn instantiate_exchange(token: *const c_char, journal: &Journal) -> Component {
    let (name, log) = (c"one".as_ptr(), Some(write_down_3 as _));
    unsafe { fmi3InstantiateModelExchange(name, token, null(), false, false, journal.environment(), log) }
}

fn initializing(importer: Importer) -> Importer {
    assert_eq!(unsafe { fmi3EnterInitializationMode(importer.component, false, 0.0, 0.0, false, 0.0) }, OK);
    importer
}

fn in_error(importer: Importer) -> Importer {
    let (nan, importer) = (f64::NAN, Fmi3::started(importer));
    assert_eq!(unsafe { fmi3SetFloat64(importer.component, &Real::Force.reference(), 1, &nan, 1) }, ERROR);
    importer
}

fn lost() -> Importer {
    let importer = Fmi3::started(Fmi3::plain());
    COPIES_PANIC.set(true);
    let status = importer.call(fmi3Reset);
    COPIES_PANIC.set(false);
    assert_eq!(status, FATAL);
    importer
}

/// Large letters are for co-simulation (`X` and `Y`: with Event Mode, in it and in step mode), small ones for
/// Model Exchange.
const PHASES: [Phase; 14] = [
    ('I', Fmi3::plain),
    ('N', || initializing(Fmi3::plain())),
    ('S', || Fmi3::started(Fmi3::plain())),
    ('X', || Fmi3::started(Fmi3::co_simulation(true, false))),
    ('Y', || Fmi3::started(Fmi3::co_simulation(true, false)).after(&[fmi3EnterStepMode])),
    ('T', || Fmi3::started(Fmi3::plain()).after(&[fmi3Terminate])),
    ('E', || in_error(Fmi3::plain())),
    ('F', lost),
    ('i', Fmi3::model_exchange),
    ('n', || initializing(Fmi3::model_exchange())),
    ('v', || Fmi3::started(Fmi3::model_exchange())),
    ('c', || Fmi3::started(Fmi3::model_exchange()).after(&[fmi3EnterContinuousTimeMode])),
    ('t', || Fmi3::started(Fmi3::model_exchange()).after(&[fmi3Terminate])),
    ('e', || in_error(Fmi3::model_exchange())),
];

const ALIVE: &str = "INSXYTEinvcte";
const GET: &str = "INSXYTEinvcte";
const DERIVE: &str = "NSXYTEnvcte";
const SET: &str = "INSXYinvc";
const SET_DISCRETE: &str = "INSXYinv";
/// When an input that is not continuous can get another value.
const INPUT: &str = "INSXinv";
const NEVER: &str = "";

/// Each function, the phases it is allowed in by FMI 3.0.2 (sections 2.3, 3.2 and 4.2; getters from the start
/// on, as its text says since June 2026), and a call with arguments that are in order.
#[rustfmt::skip]
const FUNCTIONS: [(&str, &str, Call); 70] = [
    ("fmi3SetDebugLogging", ALIVE, |c| unsafe { fmi3SetDebugLogging(c, false, 0, null()) }),
    ("fmi3EnterInitializationMode", "Ii",
     |c| unsafe { fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) }),
    ("fmi3ExitInitializationMode", "Nn", |c| unsafe { fmi3ExitInitializationMode(c) }),
    ("fmi3EnterEventMode", "Yc", |c| unsafe { fmi3EnterEventMode(c) }),
    ("fmi3Terminate", "SXYvc", |c| unsafe { fmi3Terminate(c) }),
    ("fmi3Reset", ALIVE, |c| unsafe { fmi3Reset(c) }),
    ("fmi3GetFloat32", GET, |c| unsafe { fmi3GetFloat32(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetFloat64", GET, |c| unsafe { fmi3GetFloat64(c, &Real::X.reference(), 1, &mut 0.0, 1) }),
    ("fmi3GetInt8", GET, |c| unsafe { fmi3GetInt8(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetUInt8", GET, |c| unsafe { fmi3GetUInt8(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetInt16", GET, |c| unsafe { fmi3GetInt16(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetUInt16", GET, |c| unsafe { fmi3GetUInt16(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetInt32", GET, |c| unsafe { fmi3GetInt32(c, &Integer::Count.reference(), 1, &mut 0, 1) }),
    ("fmi3GetUInt32", GET, |c| unsafe { fmi3GetUInt32(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetInt64", GET, |c| unsafe { fmi3GetInt64(c, &Integer::Law.reference(), 1, &mut 0, 1) }),
    ("fmi3GetUInt64", GET, |c| unsafe { fmi3GetUInt64(c, null(), 0, null_mut(), 0) }),
    ("fmi3GetBoolean", GET, |c| unsafe { fmi3GetBoolean(c, &Boolean::Moving.reference(), 1, &mut false, 1) }),
    ("fmi3GetString", GET, |c| unsafe { fmi3GetString(c, &Text::Label.reference(), 1, &mut null(), 1) }),
    ("fmi3GetBinary", GET, |c| unsafe { fmi3GetBinary(c, null(), 0, null_mut(), null_mut(), 0) }),
    ("fmi3GetClock", NEVER, |c| unsafe { fmi3GetClock(c, &1, 1, &mut false) }),
    ("fmi3SetFloat32", SET, |c| unsafe { fmi3SetFloat32(c, null(), 0, null(), 0) }),
    ("fmi3SetFloat64", SET, |c| unsafe { fmi3SetFloat64(c, &Real::Force.reference(), 1, &1.0, 1) }),
    ("fmi3SetInt8", SET_DISCRETE, |c| unsafe { fmi3SetInt8(c, null(), 0, null(), 0) }),
    ("fmi3SetUInt8", SET_DISCRETE, |c| unsafe { fmi3SetUInt8(c, null(), 0, null(), 0) }),
    ("fmi3SetInt16", SET_DISCRETE, |c| unsafe { fmi3SetInt16(c, null(), 0, null(), 0) }),
    ("fmi3SetUInt16", SET_DISCRETE, |c| unsafe { fmi3SetUInt16(c, null(), 0, null(), 0) }),
    ("fmi3SetInt32", INPUT, |c| unsafe { fmi3SetInt32(c, &Integer::Fault.reference(), 1, &7, 1) }),
    ("fmi3SetUInt32", SET_DISCRETE, |c| unsafe { fmi3SetUInt32(c, null(), 0, null(), 0) }),
    ("fmi3SetInt64", SET_DISCRETE, |c| unsafe { fmi3SetInt64(c, null(), 0, null(), 0) }),
    ("fmi3SetUInt64", SET_DISCRETE, |c| unsafe { fmi3SetUInt64(c, null(), 0, null(), 0) }),
    ("fmi3SetBoolean", INPUT, |c| unsafe { fmi3SetBoolean(c, &Boolean::Held.reference(), 1, &true, 1) }),
    ("fmi3SetString", SET_DISCRETE, |c| unsafe { fmi3SetString(c, null(), 0, null(), 0) }),
    ("fmi3SetBinary", SET_DISCRETE, |c| unsafe { fmi3SetBinary(c, null(), 0, null(), null(), 0) }),
    ("fmi3SetClock", NEVER, |c| unsafe { fmi3SetClock(c, &1, 1, &false) }),
    ("fmi3GetNumberOfVariableDependencies", NEVER,
     |c| unsafe { fmi3GetNumberOfVariableDependencies(c, Real::X.reference(), &mut 0) }),
    ("fmi3GetVariableDependencies", NEVER, |c| unsafe {
         fmi3GetVariableDependencies(c, 0, null_mut(), null_mut(), null_mut(), null_mut(), 0)
     }),
    ("fmi3GetFMUState", ALIVE, |c| unsafe { fmi3GetFMUState(c, &mut null_mut()) }),
    ("fmi3SetFMUState", ALIVE, |c| unsafe { with_state(c, |c, state| fmi3SetFMUState(c, state)) }),
    ("fmi3FreeFMUState", ALIVE,
     |c| unsafe { with_state(c, |c, mut state| fmi3FreeFMUState(c, &mut state)) }),
    ("fmi3SerializedFMUStateSize", ALIVE,
     |c| unsafe { with_state(c, |c, state| fmi3SerializedFMUStateSize(c, state, &mut 0)) }),
    ("fmi3SerializeFMUState", ALIVE, |c| unsafe { with_state(c, |c, state| serialize(c, state).0) }),
    ("fmi3DeserializeFMUState", ALIVE, |c| unsafe { with_state(c, serialize_and_back) }),
    ("fmi3GetDirectionalDerivative", DERIVE, |c| unsafe {
         let (v, x) = (Real::V.reference(), Real::X.reference());
         fmi3GetDirectionalDerivative(c, &v, 1, &x, 1, &1.0, 1, &mut 0.0, 1)
     }),
    ("fmi3GetAdjointDerivative", DERIVE, |c| unsafe {
         let (v, x) = (Real::V.reference(), Real::X.reference());
         fmi3GetAdjointDerivative(c, &v, 1, &x, 1, &1.0, 1, &mut 0.0, 1)
     }),
    ("fmi3EnterConfigurationMode", NEVER, |c| unsafe { fmi3EnterConfigurationMode(c) }),
    ("fmi3ExitConfigurationMode", NEVER, |c| unsafe { fmi3ExitConfigurationMode(c) }),
    ("fmi3GetIntervalDecimal", NEVER, |c| unsafe { fmi3GetIntervalDecimal(c, &1, 1, &mut 0.0, &mut 0) }),
    ("fmi3GetIntervalFraction", NEVER,
     |c| unsafe { fmi3GetIntervalFraction(c, &1, 1, &mut 0, &mut 0, &mut 0) }),
    ("fmi3GetShiftDecimal", NEVER, |c| unsafe { fmi3GetShiftDecimal(c, &1, 1, &mut 0.0) }),
    ("fmi3GetShiftFraction", NEVER, |c| unsafe { fmi3GetShiftFraction(c, &1, 1, &mut 0, &mut 0) }),
    ("fmi3SetIntervalDecimal", NEVER, |c| unsafe { fmi3SetIntervalDecimal(c, &1, 1, &0.0) }),
    ("fmi3SetIntervalFraction", NEVER, |c| unsafe { fmi3SetIntervalFraction(c, &1, 1, &0, &0) }),
    ("fmi3SetShiftDecimal", NEVER, |c| unsafe { fmi3SetShiftDecimal(c, &1, 1, &0.0) }),
    ("fmi3SetShiftFraction", NEVER, |c| unsafe { fmi3SetShiftFraction(c, &1, 1, &0, &0) }),
    ("fmi3EvaluateDiscreteStates", NEVER, |c| unsafe { fmi3EvaluateDiscreteStates(c) }),
    ("fmi3UpdateDiscreteStates", "Xv", |c| unsafe {
         let mut flags = [false; 5].map(|_| false);
         let [a, b, d, e, f] = &mut flags;
         fmi3UpdateDiscreteStates(c, a, b, d, e, f, &mut 0.0)
     }),
    ("fmi3EnterContinuousTimeMode", "v", |c| unsafe { fmi3EnterContinuousTimeMode(c) }),
    ("fmi3CompletedIntegratorStep", "c",
     |c| unsafe { fmi3CompletedIntegratorStep(c, true, &mut false, &mut false) }),
    ("fmi3SetTime", "vc", |c| unsafe { fmi3SetTime(c, 0.5) }),
    ("fmi3SetContinuousStates", "c", |c| unsafe { fmi3SetContinuousStates(c, [1.0, 0.0].as_ptr(), 2) }),
    ("fmi3GetContinuousStateDerivatives", "nvcte",
     |c| unsafe { fmi3GetContinuousStateDerivatives(c, [0.0; 2].as_mut_ptr(), 2) }),
    ("fmi3GetEventIndicators", "nvcte", |c| unsafe { fmi3GetEventIndicators(c, &mut 0.0, 1) }),
    ("fmi3GetContinuousStates", "nvcte",
     |c| unsafe { fmi3GetContinuousStates(c, [0.0; 2].as_mut_ptr(), 2) }),
    ("fmi3GetNominalsOfContinuousStates", "ivcte",
     |c| unsafe { fmi3GetNominalsOfContinuousStates(c, [0.0; 2].as_mut_ptr(), 2) }),
    ("fmi3GetNumberOfEventIndicators", "invcte", |c| unsafe { fmi3GetNumberOfEventIndicators(c, &mut 0) }),
    ("fmi3GetNumberOfContinuousStates", "invcte", |c| unsafe { fmi3GetNumberOfContinuousStates(c, &mut 0) }),
    ("fmi3EnterStepMode", "X", |c| unsafe { fmi3EnterStepMode(c) }),
    ("fmi3GetOutputDerivatives", "SYTE",
     |c| unsafe { fmi3GetOutputDerivatives(c, &Real::X.reference(), 1, &1, &mut 0.0, 1) }),
    ("fmi3DoStep", "SY", |c| unsafe {
         fmi3DoStep(c, 0.0, 0.1, true, &mut true, &mut true, &mut true, &mut 0.0)
     }),
    ("fmi3ActivateModelPartition", NEVER, |c| unsafe { fmi3ActivateModelPartition(c, 1, 0.0) }),
];

unsafe fn serialize(c: Component, state: FmuState) -> (Status, Vec<u8>) {
    let mut size = 0;
    unsafe {
        fmi3SerializedFMUStateSize(c, state, &mut size);
        let mut bytes = vec![0; size];
        (fmi3SerializeFMUState(c, state, bytes.as_mut_ptr(), size), bytes)
    }
}

unsafe fn serialize_and_back(c: Component, state: FmuState) -> Status {
    unsafe {
        let (_, bytes) = serialize(c, state);
        fmi3DeserializeFMUState(c, bytes.as_ptr(), bytes.len(), &mut null_mut())
    }
}

#[test]
fn every_function_is_served_in_its_phases_alone() {
    check_order(&FUNCTIONS, &PHASES);
}

#[test]
fn no_function_takes_null_for_an_instance() {
    for (name, _, function) in FUNCTIONS {
        assert_eq!(unsafe { function(null_mut()) }, ERROR, "{name}");
    }
    unsafe { fmi3FreeInstance(null_mut()) };
}

#[test]
fn what_is_not_supported_says_why() {
    for (name, reason) in [
        ("fmi3GetClock", "there are no clocks"),
        ("fmi3ActivateModelPartition", "there are no clocks"),
        ("fmi3EnterConfigurationMode", "no structural parameters"),
        ("fmi3GetVariableDependencies", "modelDescription.xml"),
        ("fmi3EvaluateDiscreteStates", "use fmi3UpdateDiscreteStates"),
    ] {
        let (_, _, function) = FUNCTIONS.into_iter().find(|(own, ..)| *own == name).unwrap();
        let importer = Fmi3::started(Fmi3::plain());
        assert_eq!(unsafe { function(importer.component) }, ERROR);
        importer.expect_error(&[name, reason]);
    }
    let importer = Fmi3::started(Fmi3::plain());
    assert_eq!(importer.call(fmi3EnterEventMode), ERROR);
    importer.expect_error(&["fmi3EnterEventMode", "eventModeUsed = fmi3False"]);
}

#[test]
fn the_version_is_3_0() {
    assert_eq!(unsafe { CStr::from_ptr(fmi3GetVersion()) }, c"3.0");
}

#[test]
fn instances_that_cannot_be_had_are_refused_with_a_message() {
    let journal = Journal::new();
    let exchange = |token| instantiate_exchange(token, &journal);
    let refused = |component: Component, parts: &[&str]| {
        assert!(component.is_null());
        crate::importer::expect_error(&journal, parts);
    };
    refused(exchange(c"{0}".as_ptr()), &["fmi3InstantiateModelExchange", "\"{0}\""]);
    refused(exchange(null()), &["instantiationToken is NULL"]);
    refused(exchange([-1, 0].as_ptr()), &["instantiationToken is not UTF-8"]);
    let component = unsafe {
        fmi3InstantiateScheduledExecution(
            null(),
            GUID.as_ptr(),
            null(),
            false,
            false,
            journal.environment(),
            Some(write_down_3),
            None,
            None,
            None,
        )
    };
    refused(component, &["fmi3InstantiateScheduledExecution", "Model Exchange and co-simulation only"]);
    // no name and no callback are fine
    unsafe {
        let component =
            fmi3InstantiateModelExchange(null(), GUID.as_ptr(), null(), false, true, null_mut(), None);
        assert!(!component.is_null());
        assert_eq!(fmi3Terminate(component), ERROR);
        fmi3FreeInstance(component);
    }
}

/// Importers such as fmusim list all that they record.
#[test]
fn intermediate_variables_that_are_no_continuous_inputs_get_a_warning() {
    for (variable, part) in [(Real::X, "x takes no derivative"), (Real::Push, "push takes no derivative")] {
        let importer = Fmi3::with_intermediate(Some(variable), true, [false; 2], None);
        let messages = importer.journal.take();
        let named = |message: &Message| message.category == "logStatusWarning" && message.text.contains(part);
        assert_eq!(messages.iter().filter(|message| named(message)).count(), 1, "{messages:?}");
    }
}
