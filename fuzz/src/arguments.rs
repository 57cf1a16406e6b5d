//! Calls of FMI 2.0 with random arguments, of which most make sense.

use crate::random::Random;
use fmu_export::ffi::types::{Component, EventInfo, OK, Status};
use fmu_export::ffi::{co_simulation as cs, common, model_exchange as me, values as ffi};
use fmu_export::{Causality, Kind, Model, ModelExchange, Variable, VariableId};
use std::ptr;

/// Most values of one call.
pub(crate) const MOST: usize = 8;
/// Numbers that make no sense, or hardly any.
const ODD: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    -1.0,
    -0.0,
    1e-17,
    1e9,
    1e300,
    -1e300,
];

/// Random arguments of calls, and the time \[s\] as an importer counts it.
#[derive(Debug)]
pub struct Arguments {
    pub(crate) random: Random,
    pub(crate) time: f64,
}

impl Arguments {
    /// A number of about `size`, or an odd one.
    pub(crate) fn number(&mut self, size: f64) -> f64 {
        if self.random.once_in(200) {
            self.random.one_of(&ODD)
        } else {
            size * (2.0 * self.random.unit() - 1.0)
        }
    }

    pub(crate) fn references<V: VariableId>(&mut self) -> [u32; MOST] {
        std::array::from_fn(|_| match V::ALL {
            all if !all.is_empty() && !self.random.once_in(200) => {
                self.random.one_of(all).variable().reference
            }
            _ => self.random.bits() as u32 % 300,
        })
    }

    /// A value for a variable: mostly within its limits, mostly near its start. Limits of inputs are far
    /// beyond what walls see: few values of inputs come near them.
    pub(crate) fn value(&mut self, variable: &Variable) -> f64 {
        let Kind::Real { start, min, max } = variable.kind else { return 0.0 };
        let start = start.unwrap_or(0.0);
        let ways = if variable.causality == Causality::Input { 1000 } else { 20 };
        match (self.random.below(ways), min, max) {
            (0, Some(limit), _) | (1, _, Some(limit)) => limit,
            (2..8, Some(low), Some(high)) if low > 0.0 => low * (high / low).powf(self.random.unit()),
            (2..8, Some(low), Some(high)) => low + (high - low) * self.random.unit(),
            _ if start == 0.0 => self.number(3.0),
            _ => start * (1.0 + self.number(0.5)),
        }
    }

    pub(crate) fn modes<M: Model>(&mut self, c: Component) -> Status {
        let flags = [0, 1].map(|_| i32::from(self.random.once_in(2)));
        // SAFETY: the instance lives; texts end with a NUL.
        unsafe {
            match self.random.below(40) {
                0..4 => {
                    let start = self.number(10.0);
                    let (tolerance, stop) = (self.number(1e-3).abs(), start + self.number(100.0).abs());
                    let status = common::setup_experiment::<M>(c, flags[0], tolerance, start, flags[1], stop);
                    if status == OK {
                        self.time = start;
                    }
                    status
                }
                4..18 => common::enter_initialization_mode::<M>(c),
                18..36 => common::exit_initialization_mode::<M>(c),
                36 => common::terminate::<M>(c),
                37 => {
                    self.time = 0.0;
                    common::reset::<M>(c)
                }
                38 => {
                    let names =
                        [c"logAll".as_ptr(), c"logEvents".as_ptr(), c"nonsense".as_ptr(), ptr::null()];
                    let known = if self.random.once_in(20) { 4 } else { 2 };
                    let name = names[self.random.below(known)];
                    common::set_debug_logging::<M>(c, flags[0], usize::from(flags[1] == 1), &name)
                }
                _ => cs::cancel_step::<M>(c),
            }
        }
    }

    /// The start of a step, mostly where the last one ended, and its length.
    pub(crate) fn step_ahead(&mut self) -> [f64; 2] {
        let size = match self.random.below(60) {
            0 => 1e-17,
            1 => 10.0_f64.powf(7.0 * self.random.unit() - 1.0),
            2 => self.number(1.0),
            n if n < 20 => 0.1 * self.random.unit(),
            _ => 0.01,
        };
        let point = self.time + if self.random.once_in(500) { self.number(1e-9) } else { 0.0 };
        [point, size]
    }

    pub(crate) fn step<M: Model>(&mut self, c: Component) -> Status {
        let [point, size] = self.step_ahead();
        // SAFETY: the instance lives.
        let status = unsafe { cs::do_step::<M>(c, point, size, 1) };
        if status == OK {
            self.time = point + size;
        }
        status
    }

    pub(crate) fn set_real<M: Model>(&mut self, c: Component) -> Status {
        let references = self.references::<M::Real>();
        let values = references.map(|reference| {
            let variable = M::Real::from_reference(reference).map(VariableId::variable);
            variable.map_or(0.0, |variable| self.value(variable))
        });
        // after the start only inputs can be set: take one
        let settable = |reference: &u32, causality| {
            M::Real::from_reference(*reference).is_some_and(|id| id.variable().causality == causality)
        };
        let wanted = self.random.one_of(&[Causality::Input, Causality::Input, Causality::Parameter]);
        let from = references.iter().position(|reference| settable(reference, wanted)).unwrap_or(0);
        // SAFETY: the instance lives; arrays are as long as stated.
        unsafe {
            match self.random.below(300) {
                0 => ffi::set_real::<M>(c, ptr::null(), 1, values.as_ptr(), 1),
                1 => ffi::set_real::<M>(c, references.as_ptr(), MOST, values.as_ptr(), MOST),
                _ => ffi::set_real::<M>(c, &references[from], 1, &values[from], 1),
            }
        }
    }

    /// Sets some parameters, numbers and choices; the status is that of the last one, or of the one refused.
    pub(crate) fn parameters<M: Model>(&mut self, c: Component) -> Status {
        let numbers = M::Real::ALL.iter().map(|id| id.variable());
        let choices = M::Integer::ALL.iter().map(|id| id.variable());
        let all: Vec<_> = numbers.chain(choices).filter(|of| of.causality == Causality::Parameter).collect();
        for _ in 0..=self.random.below(MOST) {
            let variable = self.random.one_of(&all);
            let reference = &variable.reference;
            // SAFETY: the instance lives; one reference and one value.
            let status = unsafe {
                if let Kind::Enumeration { items, .. } = variable.kind {
                    ffi::set_integer::<M>(c, reference, 1, &self.random.one_of(items).value, 1)
                } else {
                    ffi::set_real::<M>(c, reference, 1, &self.value(variable), 1)
                }
            };
            if status != OK {
                return status;
            }
        }
        OK
    }

    pub(crate) fn get_real<M: Model>(&mut self, c: Component) -> (Status, Option<String>) {
        let (references, mut values) = (self.references::<M::Real>(), [0.0; MOST]);
        let count = self.random.below(MOST + 1);
        // SAFETY: the instance lives; arrays are as long as stated.
        let status = unsafe { ffi::get_real::<M>(c, references.as_ptr(), count, values.as_mut_ptr(), count) };
        (status, not_finite("fmi2GetReal", status, &values))
    }

    pub(crate) fn other_values<M: Model>(&mut self, c: Component) -> Status {
        let integers = self.references::<M::Integer>();
        let (booleans, texts) = (self.references::<M::Boolean>(), self.references::<M::Text>());
        let mut number = self.random.below(6) as i32;
        let (mut text, count) = (ptr::null(), usize::from(!self.random.once_in(3)));
        // SAFETY: the instance lives; one reference and one value, or none.
        unsafe {
            match self.random.below(6) {
                0 => ffi::get_integer::<M>(c, integers.as_ptr(), count, &mut number, count),
                1 => ffi::set_integer::<M>(c, integers.as_ptr(), count, &number, count),
                2 => ffi::get_boolean::<M>(c, booleans.as_ptr(), count, &mut number, count),
                3 => ffi::set_boolean::<M>(c, booleans.as_ptr(), 0, &number, 0),
                4 => ffi::get_string::<M>(c, texts.as_ptr(), 0, &mut text, 0),
                _ => ffi::set_string::<M>(c, texts.as_ptr(), 0, &text, 0),
            }
        }
    }

    pub(crate) fn derivatives<M: Model>(&mut self, c: Component) -> (Status, Option<String>) {
        let (unknowns, knowns) = (self.references::<M::Real>(), self.references::<M::Real>());
        let (orders, mut values) = ([1; MOST], [0.0; MOST]);
        let seeds: [f64; MOST] = std::array::from_fn(|_| self.number(100.0));
        let (unknowns, knowns) = (unknowns.as_ptr(), knowns.as_ptr());
        let room = values.as_mut_ptr();
        let mut number = 0;
        let mut status = 0;
        let mut text = ptr::null();
        // SAFETY: the instance lives; arrays are as long as stated.
        let answer = unsafe {
            match self.random.below(10) {
                0..3 => cs::set_real_input_derivatives::<M>(c, knowns, 1, orders.as_ptr(), seeds.as_ptr()),
                3..6 => cs::get_real_output_derivatives::<M>(c, unknowns, 1, orders.as_ptr(), room),
                6..9 => {
                    common::get_directional_derivative::<M>(c, unknowns, 1, knowns, 1, seeds.as_ptr(), room)
                }
                _ => match self.random.below(5) {
                    0 => cs::get_status::<M>(c, 0, &mut status),
                    1 => cs::get_real_status::<M>(c, self.random.below(4) as u32, room),
                    2 => cs::get_integer_status::<M>(c, 1, &mut number),
                    3 => cs::get_boolean_status::<M>(c, 3, &mut number),
                    _ => cs::get_string_status::<M>(c, 1, &mut text),
                },
            }
        };
        (answer, not_finite("a derivative", answer, &values))
    }

    /// Calls a random function of Model Exchange.
    pub(crate) fn exchange<M: ModelExchange>(&mut self, c: Component) -> Status {
        let time = self.time + self.number(0.01).abs();
        let states: [f64; MOST] = std::array::from_fn(|_| self.number(0.2));
        let (count, mut room) = (M::STATES.len(), [0.0; MOST]);
        let (mut event, mut end, mut information) = (0, 0, EventInfo::default());
        let values = room.as_mut_ptr();
        // SAFETY: the instance lives; arrays are as long as stated.
        unsafe {
            match self.random.below(12) {
                0 => me::enter_event_mode::<M>(c),
                1..3 => me::new_discrete_states::<M>(c, &mut information),
                3..5 => me::enter_continuous_time_mode::<M>(c),
                5 => me::completed_integrator_step::<M>(c, 1, &mut event, &mut end),
                6 => {
                    self.time = time;
                    me::set_time::<M>(c, time)
                }
                7 => me::set_continuous_states::<M>(c, states.as_ptr(), count),
                8 => me::get_derivatives::<M>(c, values, count),
                9 => me::get_event_indicators::<M>(c, values, M::EVENT_INDICATORS),
                10 => me::get_continuous_states::<M>(c, values, count),
                _ => me::get_nominals_of_continuous_states::<M>(c, values, count),
            }
        }
    }
}

pub(crate) fn not_finite(call: &str, status: Status, values: &[f64]) -> Option<String> {
    let odd = values.iter().find(|value| !value.is_finite()).filter(|_| status == OK)?;
    Some(format!("{call} gave {odd} with fmi2OK"))
}
