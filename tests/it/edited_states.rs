//! Edits the bytes of a saved state, and goes on from what is not refused.

use fmu_export::{Log, Model, StateCodec, Step, VariableId};

/// Numbers that break what a state promises: not finite, huge, out of order, or no number of the type.
const EDITS: [[u8; 8]; 8] = [
    f64::NAN.to_le_bytes(),
    f64::INFINITY.to_le_bytes(),
    (-1.0_f64).to_le_bytes(),
    1e300_f64.to_le_bytes(),
    (-1e-300_f64).to_le_bytes(),
    [0; 8],
    [0xff; 8],
    2_u64.to_le_bytes(),
];

/// Writes every second edit, from one on, at each byte of the state of a unit at 0.03 s. Another unit refuses
/// the state, or takes a step from there or refuses that; it does not panic. Returns how many states were
/// accepted.
pub(crate) fn are_refused_or_work<M: Model>(unit: &M, other: &M, from: usize) -> usize {
    let mut state = Vec::new();
    unit.clone().transfer_state(&mut StateCodec::writing(&mut state)).expect("a state can be written");
    let goes_on = |bytes: &[u8]| {
        let (mut read, mut codec) = (other.clone(), StateCodec::reading(bytes));
        let accepted = read.transfer_state(&mut codec).is_ok() && codec.finish().is_ok();
        if accepted {
            let step = Step { from: 0.03, duration: 0.01, may_end_early: false };
            let stepped = read.do_step(step, &mut Log::silent()).is_ok();
            let _ = M::Real::ALL.iter().map(|&variable| read.real(variable)).collect::<Vec<_>>();
            assert!(stepped || bytes != state, "the state itself goes on");
        }
        accepted
    };
    assert!(goes_on(&state));
    let edited = (0..state.len() - 7).flat_map(|at| {
        let state = &state;
        EDITS.iter().skip(from).step_by(2).map(move |edit| [&state[..at], edit, &state[at + 8..]].concat())
    });
    edited.filter(|bytes| goes_on(bytes)).count()
}
