//! One instance of a unit, and what an importer keeps for it.
//!
//! It is generic: a program can have the exported C functions of one unit alone, which the importer of
//! `fmu-export`'s tests calls. `tests/importer` loads a packed FMU by a crate that others wrote.

use fmu_export::Model;
use fmu_export::ffi::types::ValueReference;
use fmu_export::ffi::types::{
    CallbackFunctions, CallbackLogger, Component, ComponentEnvironment, ERROR, FmuState, OK, Status, Text,
    Type,
};
use fmu_export::ffi::{Kinds, common, fmi3, states, values};
use fmu_export::{Causality, ModelExchange, Variability, VariableId};
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, CString, c_char};
use std::marker::PhantomData;
use std::ptr;

/// What the logger of an instance has heard.
#[derive(Debug, Default)]
pub struct Journal {
    component: Cell<Component>,
    /// Messages about panics.
    pub faults: RefCell<Vec<String>>,
}

/// An instance of the unit `M`; it is freed in the end.
#[derive(Debug)]
pub struct Importer<M: Model> {
    component: Component,
    /// What was logged.
    pub journal: Box<Journal>,
    unit: PhantomData<M>,
}

// SAFETY: an instance may be used by any thread, by one at a time.
unsafe impl<M: Model> Send for Importer<M> {}

impl<M: Model> Importer<M> {
    /// Makes an instance; none if the unit refuses.
    pub fn new(kinds: &Kinds<M>, kind: Type, guid: &str, resources: Option<&str>, log: bool) -> Option<Self> {
        let journal = Box::new(Journal::default());
        let guid = CString::new(guid).ok()?;
        let resources = resources.map(CString::new).transpose().ok()?;
        let callbacks = CallbackFunctions {
            logger: Some(logger::<M>()),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::from_ref(&*journal).cast_mut().cast(),
        };
        let location = resources.as_ref().map_or(ptr::null(), |text| text.as_ptr());
        let (name, log) = (c"instance".as_ptr(), i32::from(log));
        // SAFETY: texts and callbacks live until the call returns.
        let component =
            unsafe { common::instantiate(kinds, name, kind, guid.as_ptr(), location, &callbacks, 0, log) };
        journal.component.set(component);
        (!component.is_null()).then_some(Self { component, journal, unit: PhantomData })
    }

    /// The instance as C has it.
    pub fn component(&self) -> Component {
        self.component
    }

    /// The state as bytes.
    pub fn bytes(&self) -> Option<Vec<u8>> {
        let (c, mut state, mut size) = (self.component, ptr::null_mut(), 0);
        // SAFETY: the instance lives; the array is as long as stated.
        unsafe {
            (states::get_fmu_state::<M>(c, &mut state) == OK).then_some(())?;
            let mut bytes = Vec::new();
            if states::serialized_fmu_state_size::<M>(c, state, &mut size) == OK {
                bytes.resize(size, 0_u8);
                assert_eq!(states::serialize_fmu_state::<M>(c, state, bytes.as_mut_ptr(), size), OK);
            }
            assert_eq!(states::free_fmu_state::<M>(c, &mut state), OK);
            Some(bytes)
        }
    }

    /// Makes a state of bytes.
    pub fn load(&self, bytes: &[u8]) -> Option<FmuState> {
        let mut state = ptr::null_mut();
        // SAFETY: the instance lives; the array is as long as stated.
        let status = unsafe {
            states::de_serialize_fmu_state::<M>(self.component, bytes.as_ptr(), bytes.len(), &mut state)
        };
        (status == OK).then_some(state)
    }
}

impl<M: ModelExchange> Importer<M> {
    /// Makes an instance of FMI 3.0; none if the unit refuses. `flags`: Model Exchange, logs, uses Event
    /// Mode, lets steps end early, sets inputs in intermediate updates.
    pub fn fmi3(token: &str, resources: Option<&str>, flags: [bool; 5]) -> Option<Self> {
        let [exchanges, log, event_mode, early_return, updates] = flags;
        let journal = Box::new(Journal::default());
        let token = CString::new(token).ok()?;
        let resources = resources.map(|folder| CString::new(format!("{folder}/"))).transpose().ok()?;
        let environment = ptr::from_ref(&*journal).cast_mut().cast();
        let (name, token) = (c"instance".as_ptr(), token.as_ptr());
        let path = resources.as_ref().map_or(ptr::null(), |text| text.as_ptr());
        let hears: fmi3::types::LogMessageCallback = Some(hear3::<M>);
        let update: fmi3::types::IntermediateUpdateCallback = updates.then_some(set_inputs::<M>);
        let inputs: Vec<ValueReference> = inputs::<M>().collect();
        // SAFETY: the texts and the array live until the call returns.
        let component = unsafe {
            if exchanges {
                fmi3::instantiate_model_exchange::<M>(name, token, path, false, log, environment, hears)
            } else {
                let (inputs, count) = (inputs.as_ptr(), inputs.len());
                fmi3::instantiate_co_simulation::<M>(
                    name,
                    token,
                    path,
                    false,
                    log,
                    event_mode,
                    early_return,
                    inputs,
                    count,
                    environment,
                    hears,
                    update,
                )
            }
        };
        journal.component.set(component);
        (!component.is_null()).then_some(Self { component, journal, unit: PhantomData })
    }
}

/// Lists the continuous inputs.
fn inputs<M: Model>() -> impl Iterator<Item = ValueReference> {
    let variables = M::Real::ALL.iter().map(|id| id.variable());
    let continuous = variables.filter(|variable| variable.variability == Variability::Continuous);
    continuous.filter(|variable| variable.causality == Causality::Input).map(|variable| variable.reference)
}

impl<M: Model> Drop for Importer<M> {
    fn drop(&mut self) {
        // SAFETY: the instance lives, for the last time.
        unsafe { common::free_instance::<M>(self.component) };
    }
}

/// Rust cannot define a variadic function. On the platforms this runs on (System V on x86-64, AAPCS on 64-bit
/// Arm Linux) the one pointer after the format "%s" is passed as to any function.
fn logger<M: Model>() -> CallbackLogger {
    type Fixed = unsafe extern "C" fn(ComponentEnvironment, Text, Status, Text, Text, *const c_char);
    let fixed: Fixed = hear::<M>;
    // SAFETY: both are pointers to C functions; see above for how they are called.
    unsafe { std::mem::transmute::<Fixed, CallbackLogger>(fixed) }
}

unsafe extern "C" fn hear<M: Model>(
    environment: ComponentEnvironment,
    _: Text,
    status: Status,
    _: Text,
    category: Text,
    message: *const c_char,
) {
    // SAFETY: as for `hear3`.
    unsafe { hear3::<M>(environment, status, category, message) }
}

/// Sets all continuous inputs for the end of a step.
unsafe extern "C" fn set_inputs<M: ModelExchange>(
    environment: ComponentEnvironment,
    time: f64,
    _: bool,
    _: bool,
    _: bool,
    _: bool,
    _: *mut bool,
    _: *mut f64,
) {
    // SAFETY: the library passes the environment it was given.
    let journal = unsafe { &*environment.cast::<Journal>() };
    for reference in inputs::<M>() {
        let value = time % 3.0;
        // SAFETY: the instance lives: its step has not returned.
        let status = unsafe { values::set_float64::<M>(journal.component.get(), &reference, 1, &value, 1) };
        // refused where a change so large in a step so short overflows
        if status != OK && status != ERROR {
            journal.faults.borrow_mut().push(format!("status {status} in an intermediate update"));
        }
    }
}

/// Writes panics down, and calls back into the instance, which has to refuse that.
unsafe extern "C" fn hear3<M: Model>(
    environment: ComponentEnvironment,
    _: Status,
    _: Text,
    message: *const c_char,
) {
    // SAFETY: the library passes a text that ends with a NUL, and the environment it was given.
    let (message, journal) = unsafe { (CStr::from_ptr(message), &*environment.cast::<Journal>()) };
    let message = message.to_string_lossy();
    if message.contains("internal error") {
        journal.faults.borrow_mut().push(message.into_owned());
    }
    // SAFETY: NULL, or an instance that lives: its call has not returned.
    let answer = unsafe { common::reset::<M>(journal.component.get()) };
    assert_eq!(answer, ERROR, "a call from inside the logger is refused");
}
