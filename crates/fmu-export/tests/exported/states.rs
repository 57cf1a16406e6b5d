//! Saved states.

use crate::fmi2::*;
use crate::importer::Importer;
use crate::spring::{Integer, Real, Spring};
use fmu_export::Model;
use fmu_export::ffi::types::{ERROR, FmuState, OK, Status};
use std::ptr;

/// The state of the instance as it is now.
pub fn bytes(importer: &Importer) -> Vec<u8> {
    let mut state = save(importer);
    let mut size = 0;
    // SAFETY: the instance lives; the array is as long as stated.
    unsafe {
        assert_eq!(fmi2SerializedFMUstateSize(importer.component, state, &mut size), OK);
        let mut bytes = vec![0_u8; size];
        assert_eq!(fmi2SerializeFMUstate(importer.component, state, bytes.as_mut_ptr().cast(), size), OK);
        assert_eq!(fmi2FreeFMUstate(importer.component, &mut state), OK);
        bytes
    }
}

fn save(importer: &Importer) -> FmuState {
    let mut state = ptr::null_mut();
    // SAFETY: the instance lives.
    assert_eq!(unsafe { fmi2GetFMUstate(importer.component, &mut state) }, OK);
    assert!(!state.is_null());
    state
}

fn restore(importer: &Importer, state: FmuState) -> Status {
    // SAFETY: the instance lives; a state is never followed.
    unsafe { fmi2SetFMUstate(importer.component, state) }
}

pub fn load(importer: &Importer, bytes: &[u8]) -> Result<FmuState, Status> {
    let untouched = ptr::without_provenance_mut(0x77);
    let mut state = untouched;
    // SAFETY: the instance lives; the array is as long as stated.
    let status = unsafe {
        fmi2DeSerializeFMUstate(importer.component, bytes.as_ptr().cast(), bytes.len(), &mut state)
    };
    assert_eq!(state == untouched, status != OK, "the state is written if and only if there is one");
    if status == OK { Ok(state) } else { Err(status) }
}

/// Brings an instance to where the bytes were saved.
pub fn resume(importer: &Importer, stored: &[u8]) {
    let state = load(importer, stored).unwrap();
    assert_eq!(restore(importer, state), OK);
}

fn go_on(importer: &Importer) -> [u64; 2] {
    for step in 0..10 {
        assert_eq!(importer.step(0.5 + f64::from(step) * 0.125, 0.125), OK, "{:?}", importer.journal.take());
    }
    [Real::X, Real::V].map(|variable| importer.get(variable).to_bits())
}

fn at_half_a_second() -> Importer {
    let importer = Importer::swinging();
    assert_eq!(importer.step(0.0, 0.5), OK);
    assert_eq!(importer.set(Real::Force, 0.75), OK);
    importer
}

#[test]
fn a_state_resumes_bit_for_bit() {
    let importer = at_half_a_second();
    let state = save(&importer);
    let expected = go_on(&importer);
    for _ in 0..2 {
        assert_eq!(restore(&importer, state), OK);
        assert_eq!(go_on(&importer), expected);
    }
    assert_eq!(restore(&importer, state), OK);
    let stored = bytes(&importer);
    let other = Importer::new();
    resume(&other, &stored);
    assert_eq!(bytes(&other), stored, "the same state gives the same bytes");
    assert_eq!(go_on(&other), expected);
}

#[test]
fn a_state_is_saved_over_one_that_is_given() {
    let importer = at_half_a_second();
    let mut state = save(&importer);
    let first = state;
    let expected = go_on(&importer);
    // SAFETY: the instance lives.
    unsafe { assert_eq!(fmi2GetFMUstate(importer.component, &mut state), OK) };
    assert_eq!(state, first);
    assert_eq!(importer.step(1.75, 0.125), OK);
    assert_eq!(restore(&importer, state), OK);
    assert_eq!([Real::X, Real::V].map(|variable| importer.get(variable).to_bits()), expected);
}

#[test]
fn freed_and_foreign_states_are_refused_and_change_nothing() {
    let (importer, other) = (at_half_a_second(), at_half_a_second());
    let mut freed = save(&importer);
    let stale = freed;
    // SAFETY: the instance lives.
    unsafe {
        assert_eq!(fmi2FreeFMUstate(importer.component, &mut freed), OK);
        assert!(freed.is_null());
        // Nothing to free is fine.
        assert_eq!(fmi2FreeFMUstate(importer.component, &mut freed), OK);
        assert_eq!(fmi2FreeFMUstate(importer.component, ptr::null_mut()), OK);
    }
    assert!(importer.journal.take().is_empty());
    let foreign = save(&other);
    for bad in [stale, foreign, ptr::null_mut(), ptr::without_provenance_mut(1), importer.component] {
        assert_eq!(restore(&importer, bad), ERROR);
        importer.expect_error(&["fmi2SetFMUstate"]);
        let mut size = 7;
        // SAFETY: the instance lives; a state is never followed.
        unsafe {
            assert_eq!(fmi2SerializedFMUstateSize(importer.component, bad, &mut size), ERROR);
            assert_eq!(fmi2SerializeFMUstate(importer.component, bad, [0; 4].as_mut_ptr(), 4), ERROR);
            if !bad.is_null() {
                let mut state = bad;
                assert_eq!(fmi2FreeFMUstate(importer.component, &mut state), ERROR);
                assert_eq!(fmi2GetFMUstate(importer.component, &mut state), ERROR);
                assert_eq!(state, bad);
            }
        }
        assert_eq!(size, 7);
        importer.journal.take();
    }
    assert_eq!(go_on(&importer), go_on(&other));
}

#[test]
fn bytes_that_are_damaged_are_refused_and_change_nothing() {
    let importer = at_half_a_second();
    let stored = bytes(&importer);
    for at in 0..stored.len() {
        for bit in 0..8 {
            let mut damaged = stored.clone();
            damaged[at] ^= 1 << bit;
            assert_eq!(load(&importer, &damaged), Err(ERROR), "byte {at}, bit {bit}");
            importer.expect_error(&["fmi2DeSerializeFMUstate"]);
        }
        assert_eq!(load(&importer, &stored[..at]), Err(ERROR), "{at} bytes");
        importer.expect_error(&["fmi2DeSerializeFMUstate"]);
    }
    assert_eq!(load(&importer, &[&stored[..], &[0]].concat()), Err(ERROR));
    assert_eq!(load(&importer, &[&stored[..], &stored[..]].concat()), Err(ERROR));
    assert_eq!(load(&importer, b"PK\x03\x04 something else"), Err(ERROR));
    importer.journal.take();
    assert_eq!(bytes(&importer), stored);
    assert_eq!(go_on(&importer), go_on(&at_half_a_second()));
}

/// `stored` with other bytes as its payload, and a length and checksum that suit them.
fn with_payload(stored: &[u8], change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    // Magic, version, the guid with its length, version of the model's state; then the length of the payload.
    let start = 8 + 8 + (8 + Spring::GUID.len()) + 8;
    let mut payload = stored[start + 8..stored.len() - 8].to_vec();
    change(&mut payload);
    let mut bytes = [&stored[..start], &(payload.len() as u64).to_le_bytes(), &payload].concat();
    // FNV-1a, 64 bits.
    let checksum = bytes.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    bytes.extend(checksum.to_le_bytes());
    bytes
}

#[test]
fn bytes_in_order_are_refused_if_they_are_no_state_of_this_model() {
    let importer = Importer::in_initialization_mode();
    assert_eq!(importer.set_integer(Integer::Substeps, 57), OK);
    let stored = bytes(&importer);
    assert!(load(&importer, &with_payload(&stored, |_| {})).is_ok());
    let refused = |change: &dyn Fn(&mut Vec<u8>), part| {
        assert_eq!(load(&importer, &with_payload(&stored, change)), Err(ERROR), "{part}");
        importer.expect_error(&["fmi2DeSerializeFMUstate", part]);
    };
    refused(&|payload| payload.push(0), "1 bytes more");
    refused(&|payload| payload.truncate(payload.len() - 1), "too short");
    refused(&Vec::clear, "too short");
    // The phase is the first number, the time the second.
    for phase in [5, 8, 255] {
        refused(&|payload| payload[0] = phase, "no known phase");
    }
    // Event Mode, Continuous-Time Mode, and the kind after the time and a truth value
    for (at, value) in [(0, 6), (0, 7), (17, 0), (17, 2)] {
        refused(&|payload| payload[at] = value, "another kind");
    }
    refused(&|payload| payload[8..16].copy_from_slice(&f64::NAN.to_le_bytes()), "instead of a finite number");
    let stiffness = |payload: &mut Vec<u8>, value: f64| {
        let at = payload.windows(8).position(|window| window == 4.0_f64.to_le_bytes()).unwrap();
        payload[at..at + 8].copy_from_slice(&value.to_le_bytes());
    };
    refused(&|payload| stiffness(payload, 0.4), "stiffness = 0.4 N/m is below its minimum");
    refused(&|payload| stiffness(payload, f64::INFINITY), "instead of a finite number");
    refused(
        &|payload| {
            let at = payload.windows(4).position(|window| window == 57_i32.to_le_bytes()).unwrap();
            payload[at] = 0;
        },
        "0 substeps",
    );
}

#[test]
fn the_size_is_the_one_asked_for() {
    let importer = at_half_a_second();
    let state = save(&importer);
    let size = bytes(&importer).len();
    let mut room = vec![7; size + 1];
    for wrong in [0, 1, size - 1, size + 1] {
        // SAFETY: the instance lives; the array is longer than stated.
        unsafe {
            assert_eq!(fmi2SerializeFMUstate(importer.component, state, room.as_mut_ptr(), wrong), ERROR);
        }
        importer.expect_error(&[&wrong.to_string(), &size.to_string()]);
    }
    assert!(room.iter().all(|&byte| byte == 7));
}

#[test]
fn the_experiment_is_part_of_the_state() {
    let importer = Importer::new();
    // SAFETY: the instance lives.
    assert_eq!(unsafe { fmi2SetupExperiment(importer.component, 1, 1e-3, 2.0, 1, 3.0) }, OK);
    importer.expect_ok(&[fmi2EnterInitializationMode, fmi2ExitInitializationMode]);
    let other = Importer::new();
    resume(&other, &bytes(&importer));
    assert_eq!(other.get(Real::Trim), 1e-3);
    assert_eq!(other.step(2.0, 1.0), OK);
    assert_eq!(other.step(3.0, 1.0), ERROR);
    other.expect_error(&["stopTime 3.0 s"]);
}
