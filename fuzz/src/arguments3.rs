//! Calls of FMI 3.0 with random arguments, of which most make sense.

use crate::arguments::{Arguments, MOST, not_finite};
use fmu_export::ffi::types::{Component, OK, Status};
use fmu_export::ffi::{common, fmi3, model_exchange as me, values as ffi};
use fmu_export::{FIRST_INDICATOR_REFERENCE, Model, ModelExchange, TIME_REFERENCE};
use std::ptr;

impl Arguments {
    pub(crate) fn modes3<M: ModelExchange>(&mut self, c: Component) -> Status {
        let [tolerance_given, stop_given] = [0; 2].map(|_| self.random.once_in(2));
        // SAFETY: the instance lives.
        unsafe {
            match self.random.below(40) {
                0..14 => {
                    let start = self.number(10.0);
                    let (tolerance, stop) = (self.number(1e-3).abs(), start + self.number(100.0).abs());
                    let status = fmi3::start_initialization::<M>(
                        c,
                        tolerance_given,
                        tolerance,
                        start,
                        stop_given,
                        stop,
                    );
                    if status == OK {
                        self.time = start;
                    }
                    status
                }
                14..26 => common::exit_initialization_mode::<M>(c),
                26..36 => fmi3::enter_step_mode::<M>(c),
                36 => common::terminate::<M>(c),
                37 => {
                    self.time = 0.0;
                    common::reset::<M>(c)
                }
                38 => fmi3::refuse::<M>(c, "fmi3EnterConfigurationMode", ptr::null(), 0),
                _ => me::enter_event_mode::<M>(c),
            }
        }
    }

    pub(crate) fn step3<M: Model>(&mut self, c: Component) -> Status {
        let [point, size] = self.step_ahead();
        let (mut event, mut end, mut early, mut time) = (false, false, false, 0.0);
        // SAFETY: the instance lives.
        let status =
            unsafe { fmi3::do_step::<M>(c, point, size, true, &mut event, &mut end, &mut early, &mut time) };
        if status == OK {
            self.time = time;
            if event {
                // SAFETY: as above.
                unsafe { fmi3::enter_step_mode::<M>(c) };
            }
        }
        status
    }

    /// Updates discrete states, or asks for the numbers of states and indicators.
    pub(crate) fn update3<M: ModelExchange>(&mut self, c: Component) -> Status {
        let (mut flags, mut time, mut count) = ([false; 5], 0.0, 0);
        let [again, end, nominals, states, defined] = flags.each_mut().map(ptr::from_mut);
        // SAFETY: the instance lives.
        unsafe {
            match self.random.below(6) {
                0 => fmi3::get_number_of_event_indicators::<M>(c, &mut count),
                1 => fmi3::get_number_of_continuous_states::<M>(c, &mut count),
                _ => fmi3::update_discrete_states::<M>(c, again, end, nominals, states, defined, &mut time),
            }
        }
    }

    pub(crate) fn other_values3<M: Model>(&mut self, c: Component) -> Status {
        let (enumerations, booleans) = (self.references::<M::Integer>(), self.references::<M::Boolean>());
        let (mut number, mut is_true) = (self.random.below(6) as i64, self.random.once_in(2));
        let count = usize::from(!self.random.once_in(3));
        // SAFETY: the instance lives; one reference and one value, or none.
        unsafe {
            match self.random.below(5) {
                0 => ffi::get_int64::<M>(c, enumerations.as_ptr(), count, &mut number, count),
                1 => ffi::set_int64::<M>(c, enumerations.as_ptr(), count, &number, count),
                2 => ffi::get_bool::<M>(c, booleans.as_ptr(), count, &mut is_true, count),
                3 => ffi::set_bool::<M>(c, booleans.as_ptr(), 0, &is_true, 0),
                _ => ffi::get_string::<M>(c, ptr::null(), 0, ptr::null_mut(), 0),
            }
        }
    }

    /// Reads values, time and indicators among them, or derivatives.
    pub(crate) fn read3<M: ModelExchange>(&mut self, c: Component) -> (Status, Option<String>) {
        let (mut unknowns, knowns) = (self.references::<M::Real>(), self.references::<M::Real>());
        let (orders, mut values) = ([1; MOST], [0.0; MOST]);
        let seeds: [f64; MOST] = std::array::from_fn(|_| self.number(100.0));
        let room = values.as_mut_ptr();
        // SAFETY: the instance lives; arrays are as long as stated.
        let status = unsafe {
            match self.random.below(20) {
                0..10 => {
                    if self.random.once_in(4) {
                        unknowns[0] = self.random.one_of(&[TIME_REFERENCE, FIRST_INDICATOR_REFERENCE]);
                    }
                    let count = self.random.below(MOST + 1);
                    ffi::get_float64::<M>(c, unknowns.as_ptr(), count, room, count)
                }
                10..14 => {
                    fmi3::get_output_derivatives::<M>(c, unknowns.as_ptr(), 1, orders.as_ptr(), room, 1)
                }
                which => fmi3::derivatives_along::<M>(
                    which >= 17,
                    c,
                    unknowns.as_ptr(),
                    1,
                    knowns.as_ptr(),
                    1,
                    seeds.as_ptr(),
                    1,
                    room,
                    1,
                ),
            }
        };
        (status, not_finite("a function of FMI 3.0", status, &values))
    }
}
