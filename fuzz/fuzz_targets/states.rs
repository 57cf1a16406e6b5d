//! Saved states with edited bytes and a checksum that suits them: refused, or states to go on from.
#![no_main]

use fmu_export::Model;
use fmu_export::VariableId;
use fmu_export::ffi::types::{CO_SIMULATION, Component, OK, Real};
use fmu_export::ffi::{Kinds, co_simulation, common, states, values};
use libfuzzer_sys::fuzz_target;
use rocking_wall_fuzz::importer::Importer;

fuzz_target!(|edits: &[u8]| {
    let Some((unit, edits)) = edits.split_first() else { return };
    // one in eight steps on: a wall at an absurd velocity crosses thousands of branches
    let steps = unit & 0b1110 == 0;
    match unit % 2 {
        0 => go_on::<rocking_wall::unit::Unit>(edits, steps),
        _ => go_on::<rocking_floor::unit::Unit>(edits, steps),
    }
});

/// Each edit is a place, two bytes, and the eight bytes to put there.
fn go_on<M: Model>(edits: &[u8], steps: bool) {
    let kinds = Kinds::<M>::CO_SIMULATION;
    let Some(importer) = Importer::new(&kinds, CO_SIMULATION, M::GUID, None, false) else { return };
    let c = importer.component();
    // SAFETY: the instance lives.
    unsafe {
        assert_eq!(common::enter_initialization_mode::<M>(c), OK);
        assert_eq!(common::exit_initialization_mode::<M>(c), OK);
        assert_eq!(co_simulation::do_step::<M>(c, 0.0, 0.01, 1), OK);
    }
    let Some(mut bytes) = importer.bytes() else { return };
    let start = 16 + 8 + M::GUID.len() + 8;
    let end = bytes.len() - 8;
    for edit in edits.chunks_exact(10) {
        let at = start + usize::from(u16::from_le_bytes([edit[0], edit[1]])) % (end - 7 - start);
        bytes[at..at + 8].copy_from_slice(&edit[2..]);
    }
    // FNV-1a, 64 bits
    let checksum = bytes[..end].iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    if let Some(state) = importer.load(&bytes) {
        // SAFETY: the instance lives.
        let restored = unsafe { states::set_fmu_state::<M>(c, state) };
        assert_eq!(restored, OK);
        check_values::<M>(c);
        if steps {
            // SAFETY: as above.
            unsafe { co_simulation::do_step::<M>(c, 0.01, 1e-4, 1) };
            check_values::<M>(c);
        }
    }
    assert!(importer.journal.faults.borrow().is_empty(), "{:?}", importer.journal.faults);
}

/// What can be read is finite.
fn check_values<M: Model>(component: Component) {
    for variable in M::Real::ALL {
        let mut value: Real = 0.0;
        // SAFETY: the instance lives; one reference, one value.
        unsafe { values::get_real::<M>(component, &variable.variable().reference, 1, &mut value, 1) };
        assert!(value.is_finite(), "{}", variable.variable().name);
    }
}
