//! The functions on saved states (FMI 2.0.5, section 2.1.8).
//!
//! An `fmi2FMUstate` is only compared with those an instance gave out, never followed: a foreign or freed one
//! is refused.

use super::arguments::{array, array_mut, place};
use super::types::{Byte, Component, FmuState, Status};
use super::with;
use crate::call::Call;
use crate::instance::Instance;
use crate::model::{Failure, Model};
use std::mem::MaybeUninit;
use std::ptr;

/// `fmi2GetFMUstate`
///
/// A state that `state` already points to is used again.
///
/// # Safety
/// `component` is NULL or an instance; `state` is NULL or points to NULL or to a state.
pub unsafe fn get_fmu_state<M: Model>(component: Component, state: *mut FmuState) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let state = unsafe { initialized_place("FMUstate", state) }?;
        *state = handle(instance.save(state.addr())?);
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::GetFmuState, body) }
}

/// `fmi2SetFMUstate`
///
/// # Safety
/// `component` is NULL or an instance.
pub unsafe fn set_fmu_state<M: Model>(component: Component, state: FmuState) -> Status {
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SetFmuState, |instance: &mut Instance<M>| instance.restore(state.addr())) }
}

/// `fmi2FreeFMUstate`
///
/// NULL, and a pointer to NULL, are fine.
///
/// # Safety
/// `component` is NULL or an instance; `state` is NULL or points to NULL or to a state.
pub unsafe fn free_fmu_state<M: Model>(component: Component, state: *mut FmuState) -> Status {
    let body = |instance: &mut Instance<M>| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: as the caller promises.
        let state = unsafe { initialized_place("FMUstate", state) }?;
        if !state.is_null() {
            instance.forget(state.addr())?;
            *state = ptr::null_mut();
        }
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::FreeFmuState, body) }
}

/// `fmi2SerializedFMUstateSize`
///
/// # Safety
/// `component` is NULL or an instance; `size` is NULL or points to a `size_t`.
pub unsafe fn serialized_fmu_state_size<M: Model>(
    component: Component,
    state: FmuState,
    size: *mut usize,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        unsafe { place("size", size) }?.write(instance.serialize(state.addr())?.len());
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SerializedFmuStateSize, body) }
}

/// `fmi2SerializeFMUstate`
///
/// # Safety
/// `component` is NULL or an instance; `bytes` has room for `size` bytes.
pub unsafe fn serialize_fmu_state<M: Model>(
    component: Component,
    state: FmuState,
    bytes: *mut Byte,
    size: usize,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let target = unsafe { array_mut("serializedState", bytes.cast::<u8>(), size) }?;
        let source = instance.serialize(state.addr())?;
        if source.len() != target.len() {
            return Err(Failure(format!(
                "size = {size}, but the state has {} bytes: ask fmi2SerializedFMUstateSize",
                source.len()
            )));
        }
        for (slot, byte) in target.iter_mut().zip(source) {
            slot.write(byte);
        }
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::SerializeFmuState, body) }
}

/// `fmi2DeSerializeFMUstate`
///
/// Makes a new state, whatever `state` points to. Bytes that are refused leave it as it is.
///
/// # Safety
/// `component` is NULL or an instance; `bytes` has `size` bytes; `state` is NULL or points to a state or to
/// NULL.
pub unsafe fn de_serialize_fmu_state<M: Model>(
    component: Component,
    bytes: *const Byte,
    size: usize,
    state: *mut FmuState,
) -> Status {
    let body = |instance: &mut Instance<M>| {
        // SAFETY: as the caller promises.
        let (bytes, state) =
            unsafe { (array("serializedState", bytes.cast::<u8>(), size)?, place("FMUstate", state)?) };
        state.write(handle(instance.deserialize(bytes)?));
        Ok(())
    };
    // SAFETY: as the caller promises.
    unsafe { with(component, Call::DeSerializeFmuState, body) }
}

/// A handle as C has it: an address that nobody follows.
fn handle(address: usize) -> FmuState {
    ptr::without_provenance_mut(address)
}

/// The state at `target`.
///
/// # Safety
/// `target` is NULL or points to a state or to NULL, and nobody else uses it during `'a`.
unsafe fn initialized_place<'a>(name: &str, target: *mut FmuState) -> Result<&'a mut FmuState, Failure> {
    // SAFETY: as the caller promises.
    let place: &mut MaybeUninit<FmuState> = unsafe { place(name, target) }?;
    // SAFETY: as the caller promises; the importer sets a state to NULL before it is first saved.
    Ok(unsafe { place.assume_init_mut() })
}
