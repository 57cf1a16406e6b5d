//! The types of `fmi3PlatformTypes.h` and `fmi3FunctionTypes.h`, FMI 3.0.2, where they are not those of
//! [`ffi::types`](crate::ffi::types).

use crate::ffi::types::{Enumeration, Status, Text};
use std::ffi::c_void;

/// `fmi3Instance`
pub type Instance = *mut c_void;
/// `fmi3InstanceEnvironment`: belongs to the importer.
pub type InstanceEnvironment = *mut c_void;
/// `fmi3Boolean`
pub type Boolean = bool;
/// `fmi3Clock`
pub type Clock = bool;
/// `fmi3Byte`
pub type Byte = u8;
/// `fmi3Binary`
pub type Binary = *const Byte;
/// `fmi3IntervalQualifier`
pub type IntervalQualifier = Enumeration;
/// `fmi3DependencyKind`
pub type DependencyKind = Enumeration;

/// `fmi3LogMessageCallback`
pub type LogMessageCallback =
    Option<unsafe extern "C" fn(InstanceEnvironment, Status, category: Text, message: Text)>;
/// A function that is called inside a step.
pub type IntermediateUpdate = unsafe extern "C" fn(
    InstanceEnvironment,
    time: f64,
    set_requested: Boolean,
    get_allowed: Boolean,
    step_finished: Boolean,
    can_return_early: Boolean,
    early_return_requested: *mut Boolean,
    early_return_time: *mut f64,
);
/// `fmi3IntermediateUpdateCallback`
pub type IntermediateUpdateCallback = Option<IntermediateUpdate>;
/// `fmi3ClockUpdateCallback`
pub type ClockUpdateCallback = Option<unsafe extern "C" fn(InstanceEnvironment)>;
/// `fmi3LockPreemptionCallback`, `fmi3UnlockPreemptionCallback`
pub type PreemptionCallback = Option<unsafe extern "C" fn()>;
