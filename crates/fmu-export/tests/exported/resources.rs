//! Memory and threads.

use crate::allocator;
use crate::fmi2::{fmi2FreeInstance, fmi2GetFMUstate, fmi2Instantiate};
use crate::importer::{Importer, Journal};
use crate::spring::{GUID, Real};
use fmu_export::ffi::types::{CO_SIMULATION, OK};
use std::{ptr, thread};

#[test]
fn a_hundred_thousand_instances_leave_nothing_behind() {
    let journal = Journal::new();
    let callbacks = journal.callbacks();
    let (name, guid) = (c"one".as_ptr(), GUID.as_ptr());
    let cycle = || {
        // SAFETY: texts and callbacks live until the call returns; the instance lives until it is freed.
        unsafe {
            let c = fmi2Instantiate(name, CO_SIMULATION, guid, ptr::null(), &callbacks, 0, 0);
            // A state that the importer forgets goes with its instance.
            let status = fmi2GetFMUstate(c, &mut ptr::null_mut());
            fmi2FreeInstance(c);
            status
        }
    };
    assert_eq!(cycle(), OK);
    let before = allocator::balance();
    assert!((0..100_000).all(|_| cycle() == OK));
    assert_eq!(allocator::balance(), before);
}

fn swing(importer: &Importer, from: u32, to: u32) {
    for step in from..to {
        assert_eq!(importer.step(f64::from(step) * 0.01, 0.01), OK);
    }
}

#[test]
fn eight_threads_swing_alike() {
    let alone = Importer::swinging();
    swing(&alone, 0, 2000);
    let expected = alone.get(Real::X).to_bits();
    let threads = [(); 8].map(|()| {
        thread::spawn(|| {
            let importer = Importer::swinging();
            swing(&importer, 0, 2000);
            importer.get(Real::X).to_bits()
        })
    });
    assert_eq!(threads.map(|thread| thread.join().unwrap()), [expected; 8]);
}

#[test]
fn an_instance_moves_between_threads() {
    let alone = Importer::swinging();
    swing(&alone, 0, 20);
    let mut moving = Importer::swinging();
    for step in 0..20 {
        moving = thread::spawn(move || {
            swing(&moving, step, step + 1);
            moving
        })
        .join()
        .unwrap();
    }
    assert_eq!(moving.get(Real::X).to_bits(), alone.get(Real::X).to_bits());
}
