//! A bouncing ball as an FMU: co-simulation and Model Exchange, FMI 2.0 and 3.0.

use fmu_export::{Environment, Failure, Log, Model, ModelExchange, StateCodec, Step, Update};

include!(concat!(env!("OUT_DIR"), "/choices.rs")); // start_values!
include!(concat!(env!("OUT_DIR"), "/variables.rs"));

/// The parameters of the description, by their names.
#[derive(Clone)]
pub struct Parameters {
    h_start: f64,
    e: f64,
}

#[derive(Clone)]
struct Ball {
    parameters: Parameters,
    h: f64,
    v: f64,
    g: f64,
    rests: bool,
}

impl Ball {
    fn bounce(&mut self, log: &mut Log<'_>) {
        (self.h, self.v) = (0.0, -self.parameters.e * self.v);
        self.rests = self.v < 0.01; // m/s
        log.event(format_args!("the ball bounces with {} m/s", self.v));
    }

    fn fall(&mut self, time: f64) {
        (self.h, self.v) = (self.h + (self.v - self.g / 2.0 * time) * time, self.v - self.g * time);
    }
}

impl Model for Ball {
    type Real = RealVariable;
    type Integer = IntegerVariable;
    type Boolean = BooleanVariable;
    type Text = StringVariable;
    const GUID: &'static str = GUID;
    const IDENTIFIER: &'static str = MODEL_IDENTIFIER;

    fn instantiate(_: Environment<'_>, _: &mut Log<'_>) -> Result<Self, Failure> {
        Ok(Self { parameters: start_values!(Parameters {}), h: 1.0, v: 0.0, g: 9.81, rests: false })
    }

    fn real(&self, variable: RealVariable) -> f64 {
        match variable {
            RealVariable::H => self.h,
            RealVariable::V if self.rests => 0.0,
            RealVariable::V => self.v,
            RealVariable::A if self.rests => 0.0,
            RealVariable::A => -self.g,
            RealVariable::G => self.g,
            RealVariable::HStart => self.parameters.h_start,
            RealVariable::E => self.parameters.e,
        }
    }

    fn set_real(&mut self, variable: RealVariable, value: f64) {
        match variable {
            RealVariable::H => self.h = value,
            RealVariable::V => self.v = value,
            RealVariable::G => self.g = value,
            parameter => drop(self.parameters.set_real(parameter, value)),
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        self.h = self.parameters.h_start;
        Ok(())
    }

    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        let mut left = step.duration;
        while !self.rests && left > 0.0 {
            // h + v t - g t^2/2 = 0
            let impact = (self.v + (self.v * self.v + 2.0 * self.g * self.h).sqrt()) / self.g;
            self.fall(impact.min(left));
            left -= impact;
            if left >= 0.0 {
                self.bounce(log);
            }
        }
        Ok(None) // the step did not end early
    }

    fn transfer_state(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        self.parameters.transfer(codec)?;
        codec.f64s([&mut self.h, &mut self.v, &mut self.g])?;
        codec.bool(&mut self.rests)
    }
}

impl ModelExchange for Ball {
    const STATES: &'static [RealVariable] = CONTINUOUS_STATES;
    const DERIVATIVES: &'static [RealVariable] = DERIVATIVES;
    const EVENT_INDICATORS: usize = EVENT_INDICATORS;

    fn set_states(&mut self, states: &[f64]) {
        (self.h, self.v) = (states[0], states[1]);
    }

    fn event_indicators(&self, indicators: &mut [f64]) {
        indicators[0] = self.h + 1e-9; // a nanometre lower: none may be zero after an event
    }

    fn update(&mut self, log: &mut Log<'_>) -> Result<Update, Failure> {
        let bounces = self.h < 0.0 && self.v < 0.0;
        if bounces {
            self.bounce(log);
        }
        Ok(Update { states_changed: bounces, ..Update::default() })
    }

    fn complete_step(&mut self, _: &mut Log<'_>) -> Result<bool, Failure> {
        Ok(self.h < 0.0 && self.v < 0.0) // a solver may step over short bounces
    }
}

fmu_export::export_fmu!(Ball, co_simulation + model_exchange);
