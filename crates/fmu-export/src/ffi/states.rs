//! The functions on saved states (FMI 2.0.5, section 2.1.8; FMI 3.0.2, section 2.2.6).
//!
//! An `fmi2FMUstate` is only compared with those that an instance has returned, and never dereferenced. A
//! foreign or freed one is refused.

use super::arguments::{array, array_mut, place};
use super::guard::functions;
use super::types::{Component, FmuState, Status};
use crate::call::Call;
use crate::failure::Failure;
use crate::model::Model;
use std::mem::MaybeUninit;
use std::ptr;

functions! {
    /// `fmi2GetFMUstate`, `fmi3GetFMUState`
    ///
    /// A state that `state` already points to is used again.
    get_fmu_state<Model>(state: *mut FmuState): GetFMUstate, |instance| {
        // SAFETY: `state` is NULL or points to a state or to NULL, and nobody else uses it during the call.
        let state = unsafe { initialized_place("FMUstate", state) }?;
        *state = handle(instance.save(state.addr())?);
        Ok(())
    };
    /// `fmi2SetFMUstate`, `fmi3SetFMUState`
    set_fmu_state<Model>(state: FmuState): SetFMUstate, |instance| instance.restore(state.addr());
    /// `fmi2FreeFMUstate`, `fmi3FreeFMUState`
    ///
    /// NULL, and a pointer to NULL, are fine.
    free_fmu_state<Model>(state: *mut FmuState): FreeFMUstate, |instance| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: `state` points to a state or to NULL, and nobody else uses it during the call.
        let state = unsafe { initialized_place("FMUstate", state) }?;
        if !state.is_null() {
            instance.forget(state.addr())?;
            *state = ptr::null_mut();
        }
        Ok(())
    };
    /// `fmi2SerializedFMUstateSize`, `fmi3SerializedFMUStateSize`
    serialized_fmu_state_size<Model>(state: FmuState, size: *mut usize): SerializedFMUstateSize, |instance| {
        // SAFETY: `size` is NULL or points to room for one value that nobody else uses during the call.
        unsafe { place("size", size) }?.write(instance.serialize(state.addr())?.len());
        Ok(())
    };
    /// `fmi2SerializeFMUstate`, `fmi3SerializeFMUState`
    serialize_fmu_state<Model>(
        state: FmuState, bytes: *mut impl Sized, size: usize
    ): SerializeFMUstate, |instance| {
        let source = instance.serialize(state.addr())?;
        if source.len() != size {
            return Err(Failure(format!(
                "size = {size}, but the state has {} bytes: ask for its size first",
                source.len()
            )));
        }
        // SAFETY: `bytes` is NULL or points to room for `size` bytes that nobody else uses during the call.
        unsafe { array_mut("serializedState", bytes.cast::<u8>(), size, 0) }?.copy_from_slice(&source);
        Ok(())
    };
    /// `fmi2DeSerializeFMUstate`, `fmi3DeserializeFMUState`
    ///
    /// Makes a new state, whatever `state` points to. Bytes that are refused leave it as it is.
    de_serialize_fmu_state<Model>(
        bytes: *const impl Sized, size: usize, state: *mut FmuState
    ): DeSerializeFMUstate, |instance| {
        // SAFETY: `bytes` is NULL or points to `size` bytes that stay as they are during the call; `state`
        // is NULL or points to room for one state that nobody else uses.
        let (bytes, state) =
            unsafe { (array("serializedState", bytes.cast::<u8>(), size)?, place("FMUstate", state)?) };
        state.write(handle(instance.deserialize(bytes)?));
        Ok(())
    };
}

/// Returns a handle for C: an address that is never dereferenced.
fn handle(address: usize) -> FmuState {
    ptr::without_provenance_mut(address)
}

/// The state at `target`.
///
/// # Safety
/// `target` is NULL or points to a state or to NULL, and nobody else uses it during `'a`.
unsafe fn initialized_place<'a>(name: &str, target: *mut FmuState) -> Result<&'a mut FmuState, Failure> {
    // SAFETY: `target` is NULL or points to a state or to NULL, and nobody else uses it during `'a`.
    let place: &mut MaybeUninit<FmuState> = unsafe { place(name, target) }?;
    // SAFETY: `target` holds a state or NULL: the importer sets it to NULL before it first saves a state.
    Ok(unsafe { place.assume_init_mut() })
}
