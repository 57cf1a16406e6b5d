//! A model whose description does not say `canInterpolateInputs`.

#![allow(
    clippy::undocumented_unsafe_blocks,
    reason = "each call states what it is given; the instance lives"
)]

use fmu_export::ffi::common::{exit_initialization_mode, free_instance};
use fmu_export::ffi::fmi3::{do_step, instantiate_co_simulation, start_initialization};
use fmu_export::ffi::types::{Component, OK};
use fmu_export::{
    Environment, Failure, Log, Model, ModelExchange, StateCodec, Step, Update, Variable, VariableId,
};
use std::cell::Cell;
use std::ptr::{null, null_mut};

/// No variables: the default of [`VariableId::INTERPOLATES`] holds, as for the ball of the README.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum None {}

impl VariableId for None {
    const ALL: &'static [Self] = &[];
    fn variable(self) -> &'static Variable {
        match self {}
    }
    fn from_reference(_: u32) -> Option<Self> {
        Option::None
    }
}

#[derive(Clone)]
struct Stone;

impl Model for Stone {
    type Real = None;
    type Integer = None;
    type Boolean = None;
    type Text = None;
    const GUID: &'static str = "{0}";
    const IDENTIFIER: &'static str = "stone";
    fn instantiate(_: Environment<'_>, _: &mut Log<'_>) -> Result<Self, Failure> {
        Ok(Self)
    }
    fn real(&self, variable: None) -> f64 {
        match variable {}
    }
    fn set_real(&mut self, variable: None, _: f64) {
        match variable {}
    }
    fn do_step(&mut self, _: Step, _: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        Ok(Option::None)
    }
    fn transfer_state(&mut self, _: &mut StateCodec<'_>) -> Result<(), Failure> {
        Ok(())
    }
}

impl ModelExchange for Stone {
    const STATES: &'static [None] = &[];
    const DERIVATIVES: &'static [None] = &[];
    const EVENT_INDICATORS: usize = 0;
    fn set_states(&mut self, _: &[f64]) {}
    fn event_indicators(&self, _: &mut [f64]) {}
    fn update(&mut self, _: &mut Log<'_>) -> Result<Update, Failure> {
        Ok(Update::default())
    }
}

thread_local! {
    static CALLED: Cell<bool> = const { Cell::new(false) };
}

unsafe extern "C" fn update(
    _: Component,
    _: f64,
    _: bool,
    _: bool,
    _: bool,
    _: bool,
    _: *mut bool,
    _: *mut f64,
) {
    CALLED.set(true);
}

/// `fmi3_values` has the other case: inputs that run linearly to what is set inside a step.
#[test]
fn no_intermediate_update_is_made_that_the_description_does_not_announce() {
    unsafe {
        let name = c"stone".as_ptr();
        let c = instantiate_co_simulation::<Stone>(
            name,
            c"{0}".as_ptr(),
            null(),
            false,
            false,
            false,
            false,
            null(),
            0,
            null_mut(),
            Option::None,
            Some(update),
        );
        assert!(!c.is_null());
        assert_eq!(start_initialization::<Stone>(c, false, 0.0, 0.0, false, 0.0), OK);
        assert_eq!(exit_initialization_mode::<Stone>(c), OK);
        let (mut event, mut terminate, mut early, mut time) = (true, true, true, f64::NAN);
        let status = do_step::<Stone>(c, 0.0, 0.5, true, &mut event, &mut terminate, &mut early, &mut time);
        assert_eq!((status, time, CALLED.get()), (OK, 0.5, false));
        free_instance::<Stone>(c);
    }
}
