//! Loggers that call back into their instance.

use crate::allocator;
use crate::fmi2::*;
use crate::importer::{FixedLogger, SILENT, as_logger};
use crate::spring::{GUID, Integer, Real, TALK_IN_STEP};
use fmu_export::ffi::types::{
    CO_SIMULATION, CallbackFunctions, Component, ComponentEnvironment, ERROR, OK, Status, Text,
};
use std::cell::{Cell, RefCell};
use std::ffi::c_char;
use std::ptr;

thread_local! {
    static INSTANCE: Cell<Component> = const { Cell::new(ptr::null_mut()) };
    static ANSWERS: RefCell<Vec<Status>> = const { RefCell::new(Vec::new()) };
}

/// Calls what an importer might, once there is an instance: a getter, a step, a reset.
unsafe extern "C" fn call_back(
    _: ComponentEnvironment,
    _: Text,
    _: Status,
    _: Text,
    _: Text,
    _: *const c_char,
) {
    let (component, mut value) = (INSTANCE.get(), 0.0);
    if component.is_null() {
        return;
    }
    // SAFETY: the instance lives; one reference, one value.
    let answers = unsafe {
        [
            fmi2GetReal(component, &Real::X.reference(), 1, &mut value),
            fmi2DoStep(component, 0.0, 0.1, 1),
            fmi2Reset(component),
        ]
    };
    ANSWERS.with_borrow_mut(|all| all.extend(answers));
}

unsafe extern "C" fn free(_: ComponentEnvironment, _: Text, _: Status, _: Text, _: Text, _: *const c_char) {
    // SAFETY: the instance lives until the end of the call that logs.
    unsafe { fmi2FreeInstance(INSTANCE.get()) };
}

fn instantiate(logger: FixedLogger) -> Component {
    let callbacks = CallbackFunctions { logger: Some(as_logger(logger)), ..SILENT };
    let (name, guid) = (c"one".as_ptr(), GUID.as_ptr());
    // SAFETY: texts and callbacks live until the call returns.
    let component = unsafe { fmi2Instantiate(name, CO_SIMULATION, guid, ptr::null(), &callbacks, 0, 1) };
    INSTANCE.set(component);
    component
}

/// A call that fails, and so logs.
fn fail(component: Component) {
    // SAFETY: the instance lives; one reference, one value.
    assert_eq!(unsafe { fmi2SetReal(component, &Real::Stiffness.reference(), 1, &f64::NAN) }, ERROR);
}

#[test]
fn calls_from_the_logger_are_refused_and_change_nothing() {
    let component = instantiate(call_back);
    fail(component);
    assert_eq!(ANSWERS.take(), [ERROR; 3]);
    // SAFETY: the instance lives, for the last time in the end.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(component), ERROR, "the failure stands: nothing was reset");
        assert_eq!(fmi2Reset(component), OK);
        assert_eq!(fmi2EnterInitializationMode(component), OK);
        fmi2FreeInstance(component);
    }
}

#[test]
fn an_instance_freed_by_the_logger_goes_at_the_end_of_the_call() {
    let before = allocator::balance();
    let component = instantiate(free);
    // SAFETY: the instance lives until the end of the step, in which it logs three times.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(component), OK);
        assert_eq!(fmi2ExitInitializationMode(component), OK);
        assert_eq!(fmi2SetInteger(component, &Integer::Fault.reference(), 1, &TALK_IN_STEP), OK);
        assert_eq!(fmi2DoStep(component, 0.0, 0.1, 1), OK);
    }
    assert_eq!(allocator::balance(), before, "freed, and once");
}
