//! Memory and threads.

use crate::allocator;
use crate::fmi2::{fmi2FreeInstance, fmi2GetFMUstate, fmi2Instantiate};
use crate::fmi3_order::Fmi3;
use crate::fmi3_values::step;
use crate::importer::{Importer, Journal};
use crate::spring::{GUID, Real};
use fmu_export::ffi::types::{CO_SIMULATION, OK, Status};
use std::sync::{Arc, Barrier};
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

/// Two instances of each version, in two threads that take their steps at the same time.
#[test]
fn two_instances_in_two_threads_do_not_meet() {
    type Kind = (fn() -> Importer, fn(&Importer, f64) -> Status);
    let kinds: [Kind; 2] = [
        (Importer::swinging, |importer, time| importer.step(time, 0.01)),
        (|| Fmi3::started(Fmi3::co_simulation(false, false)), |importer, time| step(importer, time, 0.01).0),
    ];
    for (made, step) in kinds {
        let (begin, pushes) = (Arc::new(Barrier::new(2)), [1.5, -0.25]);
        let pushed = move |push, begin: Option<&Barrier>| {
            let importer = made();
            assert_eq!(importer.set(Real::Push, push), OK);
            for count in 0..500 {
                begin.map(Barrier::wait);
                assert_eq!(step(&importer, f64::from(count) * 0.01), OK);
            }
            importer.get(Real::X).to_bits()
        };
        let expected = pushes.map(|push| pushed(push, None));
        assert_ne!(expected[0], expected[1]);
        let threads = pushes.map(|push| {
            let begin = Arc::clone(&begin);
            thread::spawn(move || pushed(push, Some(&begin)))
        });
        assert_eq!(threads.map(|thread| thread.join().unwrap()), expected);
    }
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
