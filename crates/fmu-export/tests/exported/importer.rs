//! An importer: calls the exported C functions and keeps what they log.

use crate::fmi2::{
    fmi2DoStep, fmi2EnterInitializationMode, fmi2ExitInitializationMode, fmi2FreeInstance, fmi2GetInteger,
    fmi2GetReal, fmi2GetString, fmi2Instantiate, fmi2SetBoolean, fmi2SetInteger, fmi2SetReal,
    fmi2SetupExperiment, fmi2Terminate,
};
use crate::spring::{self, Integer, Real, Spring};
use fmu_export::Model;
use fmu_export::ffi::types::{
    CO_SIMULATION, CallbackFunctions, CallbackLogger, Component, ComponentEnvironment, OK, Status, Text, Type,
};
use std::ffi::{CStr, CString, c_char};
use std::ptr;
use std::sync::Mutex;

#[derive(Clone, PartialEq, Debug)]
pub struct Message {
    pub instance: String,
    pub status: Status,
    pub category: String,
    pub text: String,
}

/// What the importer's environment pointer points to.
pub struct Journal(Mutex<Vec<Message>>);

/// `fmi3LogMessageCallback` of a journal.
pub unsafe extern "C" fn write_down_3(
    environment: ComponentEnvironment,
    status: Status,
    category: Text,
    message: Text,
) {
    // SAFETY: the library passes texts that end with a NUL, and the environment it was given.
    let (text, journal) = unsafe {
        let text = |text| CStr::from_ptr(text).to_str().unwrap().to_owned();
        let (category, text) = (text(category), text(message));
        (Message { instance: String::new(), status, category, text }, &*environment.cast::<Journal>())
    };
    journal.0.lock().unwrap().push(text);
}

impl Journal {
    #[allow(clippy::unnecessary_box_returns, reason = "C keeps its address")]
    pub fn new() -> Box<Self> {
        Box::new(Self(Mutex::default()))
    }

    /// The messages since the last time.
    pub fn take(&self) -> Vec<Message> {
        std::mem::take(&mut *self.0.lock().unwrap())
    }

    /// The pointer that the library hands back with each message.
    pub fn environment(&self) -> ComponentEnvironment {
        ptr::from_ref(self).cast_mut().cast()
    }

    pub fn callbacks(&self) -> CallbackFunctions {
        let logger = Some(as_logger(write_down));
        CallbackFunctions { logger, component_environment: self.environment(), ..SILENT }
    }
}

/// Callbacks without a logger.
pub const SILENT: CallbackFunctions = CallbackFunctions {
    logger: None,
    allocate_memory: None,
    free_memory: None,
    step_finished: None,
    component_environment: ptr::null_mut(),
};

/// A logger that takes the one pointer after the format.
pub type FixedLogger = unsafe extern "C" fn(ComponentEnvironment, Text, Status, Text, Text, *const c_char);

/// Rust cannot define a variadic function, but it can define one with the one pointer that follows the format
/// "%s". On the platforms these tests run on (System V on x86-64, AAPCS on 64-bit Arm Linux) a pointer after
/// the format is passed to a variadic function like to any other. Only tests do this.
pub fn as_logger(fixed: FixedLogger) -> CallbackLogger {
    // SAFETY: both are pointers to C functions; see above for how they are called.
    unsafe { std::mem::transmute::<FixedLogger, CallbackLogger>(fixed) }
}

unsafe extern "C" fn write_down(
    environment: ComponentEnvironment,
    instance: Text,
    status: Status,
    category: Text,
    format: Text,
    message: *const c_char,
) {
    // SAFETY: the library passes texts that end with a NUL, and the environment it was given.
    let (text, format, journal) = unsafe {
        let text = |text| CStr::from_ptr(text).to_str().unwrap().to_owned();
        let message =
            Message { instance: text(instance), status, category: text(category), text: text(message) };
        (message, CStr::from_ptr(format), &*environment.cast::<Journal>())
    };
    assert_eq!(format, c"%s");
    journal.0.lock().unwrap().push(text);
}

/// A C function that takes an instance alone.
pub type Plain = unsafe extern "C" fn(Component) -> Status;

/// A call of a C function with arguments of its own.
pub type Call = unsafe fn(Component) -> Status;

/// An instance that is freed in the end.
pub struct Importer {
    pub component: Component,
    pub journal: Box<Journal>,
}

// SAFETY: an instance may be used by any thread, by one at a time.
unsafe impl Send for Importer {}

impl Importer {
    /// A new instance, not logging.
    pub fn new() -> Self {
        Self::logging(false)
    }

    pub fn logging(on: bool) -> Self {
        Self::of(instantiate("one", CO_SIMULATION, Spring::GUID, None, on))
    }

    /// What was made, which is an instance.
    pub fn of((component, journal): (Component, Box<Journal>)) -> Self {
        assert!(!component.is_null(), "{:?}", journal.take());
        Self { component, journal }
    }

    pub fn in_initialization_mode() -> Self {
        Self::new().initializing()
    }

    pub fn in_step_mode() -> Self {
        Self::in_initialization_mode().after(&[fmi2ExitInitializationMode])
    }

    pub fn swinging() -> Self {
        Self::new().released()
    }

    pub fn terminated() -> Self {
        Self::in_step_mode().after(&[fmi2Terminate])
    }

    /// The instance in Initialization Mode.
    pub fn initializing(self) -> Self {
        // SAFETY: the instance lives.
        assert_eq!(unsafe { fmi2SetupExperiment(self.component, 0, 0.0, 0.0, 0, 0.0) }, OK);
        self.after(&[fmi2EnterInitializationMode])
    }

    /// The instance after Initialization Mode, as a spring that swings from 1 m.
    pub fn released(self) -> Self {
        let importer = self.initializing();
        assert_eq!(importer.set(Real::XStart, 1.0), OK);
        importer.after(&[fmi2ExitInitializationMode])
    }

    /// The instance after some calls, which succeed.
    pub fn after(self, functions: &[Plain]) -> Self {
        self.expect_ok(functions);
        self
    }

    #[track_caller]
    pub fn expect_ok(&self, functions: &[Plain]) {
        for &function in functions {
            assert_eq!(self.call(function), OK, "{:?}", self.journal.take());
        }
    }

    pub fn call(&self, function: Plain) -> Status {
        // SAFETY: the instance lives.
        unsafe { function(self.component) }
    }

    pub fn set(&self, variable: Real, value: f64) -> Status {
        // SAFETY: the instance lives; one reference, one value.
        unsafe { fmi2SetReal(self.component, &variable.reference(), 1, &value) }
    }

    pub fn set_integer(&self, variable: Integer, value: i32) -> Status {
        // SAFETY: the instance lives; one reference, one value.
        unsafe { fmi2SetInteger(self.component, &variable.reference(), 1, &value) }
    }

    pub fn set_boolean(&self, variable: spring::Boolean, value: i32) -> Status {
        // SAFETY: the instance lives; one reference, one value.
        unsafe { fmi2SetBoolean(self.component, &variable.reference(), 1, &value) }
    }

    pub fn get(&self, variable: Real) -> f64 {
        let mut value = f64::NAN;
        // SAFETY: the instance lives; one reference, one value.
        let status = unsafe { fmi2GetReal(self.component, &variable.reference(), 1, &mut value) };
        assert_eq!(status, OK, "{:?}", self.journal.take());
        value
    }

    pub fn get_integer(&self, variable: Integer) -> i32 {
        let mut value = i32::MIN;
        // SAFETY: the instance lives; one reference, one value.
        let status = unsafe { fmi2GetInteger(self.component, &variable.reference(), 1, &mut value) };
        assert_eq!(status, OK, "{:?}", self.journal.take());
        value
    }

    pub fn get_text(&self, variable: spring::Text) -> String {
        let mut text = ptr::null();
        // SAFETY: the instance lives; one reference, one value, which lives until the next call.
        unsafe {
            assert_eq!(fmi2GetString(self.component, &variable.reference(), 1, &mut text), OK);
            CStr::from_ptr(text).to_str().unwrap().to_owned()
        }
    }

    pub fn step(&self, point: f64, size: f64) -> Status {
        // SAFETY: the instance lives.
        unsafe { fmi2DoStep(self.component, point, size, 1) }
    }

    /// The one message since the last time, which is an error and contains `parts`.
    #[track_caller]
    pub fn expect_error(&self, parts: &[&str]) {
        expect_error(&self.journal, parts);
    }
}

impl Drop for Importer {
    fn drop(&mut self) {
        // SAFETY: the instance lives, for the last time.
        unsafe { fmi2FreeInstance(self.component) };
    }
}

#[track_caller]
pub fn expect_error(journal: &Journal, parts: &[&str]) {
    let messages = journal.take();
    let [message] = &messages[..] else { panic!("one message was expected: {messages:?}") };
    assert_eq!(message.category, "logStatusError");
    for part in parts {
        assert!(message.text.contains(part), "{part:?} is missing in {:?}", message.text);
    }
}

pub fn instantiate(
    name: &str,
    kind: Type,
    guid: &str,
    location: Option<&str>,
    logging: bool,
) -> (Component, Box<Journal>) {
    let journal = Journal::new();
    let [name, guid] = [name, guid].map(|text| CString::new(text).unwrap());
    let location = location.map(|text| CString::new(text).unwrap());
    let location = location.as_ref().map_or(ptr::null(), |text| text.as_ptr());
    let callbacks = journal.callbacks();
    // SAFETY: texts and callbacks live until the call returns.
    let component = unsafe {
        fmi2Instantiate(name.as_ptr(), kind, guid.as_ptr(), location, &callbacks, 0, i32::from(logging))
    };
    (component, journal)
}
