//! A model that panics.

use crate::fmi2::{fmi2GetReal, fmi2Reset, fmi2SetFMUstate};
use crate::importer::Importer;
use crate::spring::{Integer, PANIC_IN_GET, PANIC_IN_STEP, Real};
use fmu_export::ffi::types::{ERROR, OK};
use std::process::Command;

#[test]
fn a_panic_is_an_error_with_its_place() {
    let importer = Importer::swinging();
    assert_eq!(importer.set_integer(Integer::Fault, PANIC_IN_STEP), OK);
    assert_eq!(importer.step(0.0, 0.1), ERROR);
    importer.expect_error(&["fmi2DoStep", "spring snapped in a step", "spring.rs:"]);
    assert_eq!(importer.get(Real::X), 1.0);
    assert_eq!(importer.step(0.0, 0.1), ERROR);
    importer.expect_ok(&[fmi2Reset]);

    let importer = Importer::in_step_mode();
    assert_eq!(importer.set_integer(Integer::Fault, PANIC_IN_GET), OK);
    // SAFETY: the instance lives; one reference, one value.
    assert_eq!(unsafe { fmi2GetReal(importer.component, &Real::V.reference(), 1, &mut 0.0) }, ERROR);
    importer.expect_error(&["fmi2GetReal", "spring snapped in a get"]);
}

#[test]
fn an_instance_that_cannot_be_reset_is_lost() {
    let importer = crate::order::lost();
    assert_eq!(importer.call(fmi2Reset), ERROR);
    // SAFETY: the instance lives.
    assert_eq!(unsafe { fmi2SetFMUstate(importer.component, std::ptr::null_mut()) }, ERROR);
}

/// Runs the tests above in a process of their own and reads all that it prints.
#[test]
fn a_panic_prints_nothing() {
    let program = std::env::current_exe().unwrap();
    let output = Command::new(program)
        .args(["--nocapture", "panics::a_panic_is_an_error_with_its_place"])
        .output()
        .unwrap();
    let printed =
        format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success() && printed.contains("1 passed"), "{printed}");
    assert!(!printed.contains("snapped") && !printed.contains("panicked"), "{printed}");
}
