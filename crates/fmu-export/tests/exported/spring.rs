//! The model of these tests: a mass of 1 kg on a damped spring.

use fmu_export::{
    Causality, Environment, Experiment, Failure, Item, Kind, Log, Model, ModelExchange, StateCodec, Step,
    Update, Variability, Variable, VariableId,
};
use std::cell::Cell;
use std::ffi::CStr;

thread_local! {
    /// Makes every copy of a spring on this thread panic.
    pub static COPIES_PANIC: Cell<bool> = const { Cell::new(false) };
}

/// What the input `fault` makes the next step do.
pub const PANIC_IN_STEP: i32 = 1;
pub const FAIL_IN_STEP: i32 = 2;
pub const TALK_IN_STEP: i32 = 3;
/// Makes getting `v` panic.
pub const PANIC_IN_GET: i32 = 4;
/// Ends the next step at its middle, if it may end early.
pub const EVENT_IN_STEP: i32 = 5;

macro_rules! variables {
    ($id:ident: $(
        $variant:ident $reference:literal $name:literal $causality:ident $variability:ident $unit:expr,
        $kind:expr;
    )*) => {
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub enum $id { $($variant,)* }

        impl VariableId for $id {
            const ALL: &'static [Self] = &[$(Self::$variant,)*];
            const INTERPOLATES: bool = true;
            fn variable(self) -> &'static Variable {
                static TABLE: &[Variable] = &[$(Variable {
                    name: $name, reference: $reference, description: "", unit: $unit,
                    causality: Causality::$causality, variability: Variability::$variability, kind: $kind,
                },)*];
                &TABLE[self as usize]
            }
            fn from_reference(reference: u32) -> Option<Self> {
                match reference { $($reference => Some(Self::$variant),)* _ => None }
            }
        }

        impl $id {
            pub fn reference(self) -> u32 { self.variable().reference }
        }
    };
}

/// The guid for C.
pub const GUID: &CStr = c"{0123456789abcdef0123456789abcdef}";

const FREE: Kind = Kind::Real { start: Some(0.0), min: None, max: None };

variables! { Real:
    Stiffness 1 "stiffness" Parameter Fixed Some("N/m"),
        Kind::Real { start: Some(4.0), min: Some(0.5), max: Some(100.0) };
    XStart 2 "x_start" Parameter Fixed Some("m"), FREE;
    Period 3 "period" CalculatedParameter Fixed Some("s"), Kind::Real { start: None, min: None, max: None };
    Force 4 "force" Input Continuous Some("N"),
        Kind::Real { start: Some(0.0), min: Some(-50.0), max: Some(50.0) };
    Push 5 "push" Input Discrete Some("N"), FREE;
    X 6 "x" Output Continuous Some("m"), FREE;
    V 7 "v" Output Continuous Some("m/s"), FREE;
    Energy 8 "energy" Local Continuous Some("J"), FREE;
    Gravity 9 "gravity" Parameter Constant None, FREE;
    Trim 10 "trim" Parameter Tunable None, FREE;
    Time 11 "time" Independent Continuous Some("s"), FREE;
    Bias 12 "bias" Input Continuous Some("N"), FREE;
    A 13 "a" Local Continuous Some("m/s2"), FREE;
}
variables! { Integer:
    Law 20 "law" Parameter Fixed None, Kind::Enumeration { start: Some(1), items: &[
        Item { name: "linear", value: 1, description: "" },
        Item { name: "cubic", value: 2, description: "" }] };
    Substeps 21 "substeps" Parameter Fixed None,
        Kind::Integer { start: Some(8), min: Some(1), max: Some(100) };
    Fault 22 "fault" Input Discrete None, Kind::Integer { start: Some(0), min: None, max: None };
    Count 23 "count" Output Discrete None, Kind::Integer { start: None, min: None, max: None };
}
variables! { Boolean:
    Clamped 30 "clamped" Parameter Fixed None, Kind::Boolean { start: Some(false) };
    Held 31 "held" Input Discrete None, Kind::Boolean { start: Some(false) };
    Moving 32 "moving" Output Discrete None, Kind::Boolean { start: None };
}
variables! { Text:
    Label 40 "label" Parameter Fixed None, Kind::String { start: Some("spring") };
    Home 41 "home" Output Discrete None, Kind::String { start: None };
}

#[derive(PartialEq, Debug, Default)]
pub struct Spring {
    stiffness: f64,
    x_start: f64,
    period: f64,
    force: f64,
    force_rate: f64,
    push: f64,
    trim: f64,
    bias: f64,
    x: f64,
    v: f64,
    law: i32,
    substeps: i32,
    fault: i32,
    count: i32,
    clamped: bool,
    held: bool,
    /// On the side x < 0, as of the last event.
    below: bool,
    time: f64,
    label: String,
    home: String,
}

impl Clone for Spring {
    fn clone(&self) -> Self {
        assert!(!COPIES_PANIC.get(), "spring snapped in a copy");
        Self { label: self.label.clone(), home: self.home.clone(), ..*self }
    }
}

impl Spring {
    fn restoring(&self, x: f64) -> f64 {
        self.stiffness * if self.law == 1 { x } else { x * x * x }
    }
}

impl Model for Spring {
    type Real = Real;
    type Integer = Integer;
    type Boolean = Boolean;
    type Text = Text;

    const GUID: &'static str = "{0123456789abcdef0123456789abcdef}";
    const IDENTIFIER: &'static str = "spring";
    const PAYLOAD: &'static str = "spring.toml";

    fn instantiate(environment: Environment<'_>, log: &mut Log<'_>) -> Result<Self, Failure> {
        assert!(environment.instance_name != "panic", "spring snapped at once");
        if environment.instance_name == "fail" {
            return Err("no spring today".into());
        }
        log.info(format_args!("{} is a spring", environment.instance_name));
        let label = environment.payload.map_or("spring".into(), String::from_utf8_lossy);
        let home = environment.resources.map(|path| path.to_string_lossy()).unwrap_or_default();
        let (label, home) = (label.into_owned(), home.into_owned());
        Ok(Self { stiffness: 4.0, law: 1, substeps: 8, label, home, ..Self::default() })
    }

    fn real(&self, variable: Real) -> f64 {
        match variable {
            Real::Stiffness => self.stiffness,
            Real::XStart => self.x_start,
            Real::Period => self.period,
            Real::Force => self.force,
            Real::Push => self.push,
            Real::X => self.x,
            Real::V => {
                assert!(self.fault != PANIC_IN_GET, "spring snapped in a get");
                self.v
            }
            Real::Energy => 0.5 * (self.v * self.v + self.stiffness * self.x * self.x),
            Real::Gravity => 9.81,
            Real::Trim => self.trim,
            Real::Time => self.time,
            Real::A => self.force + self.push + self.bias - self.restoring(self.x),
            Real::Bias => self.bias,
        }
    }

    fn integer(&self, variable: Integer) -> i32 {
        match variable {
            Integer::Law => self.law,
            Integer::Substeps => self.substeps,
            Integer::Fault => self.fault,
            Integer::Count => self.count,
        }
    }

    fn boolean(&self, variable: Boolean) -> bool {
        match variable {
            Boolean::Clamped => self.clamped,
            Boolean::Held => self.held,
            Boolean::Moving => self.v != 0.0,
        }
    }

    fn text(&self, variable: Text) -> &str {
        match variable {
            Text::Label => &self.label,
            Text::Home => &self.home,
        }
    }

    fn set_real(&mut self, variable: Real, value: f64) {
        match variable {
            Real::Stiffness => self.stiffness = value,
            Real::XStart => self.x_start = value,
            Real::Force => (self.force, self.force_rate) = (value, 0.0),
            Real::Push => self.push = value,
            Real::Trim => self.trim = value,
            Real::Bias => self.bias = value,
            // set as if it were an input, a state chooses its side anew
            Real::X => (self.x, self.below) = (value, value < 0.0),
            Real::V => self.v = value,
            _ => unreachable!("the layer lets nobody set {variable:?}"),
        }
    }

    fn set_integer(&mut self, variable: Integer, value: i32) {
        match variable {
            Integer::Law => self.law = value,
            Integer::Substeps => self.substeps = value,
            Integer::Fault => self.fault = value,
            Integer::Count => unreachable!("the layer lets nobody set an output"),
        }
    }

    fn set_boolean(&mut self, variable: Boolean, value: bool) {
        match variable {
            Boolean::Clamped => self.clamped = value,
            Boolean::Held => self.held = value,
            Boolean::Moving => unreachable!("the layer lets nobody set an output"),
        }
    }

    fn set_text(&mut self, variable: Text, value: &str) {
        match variable {
            Text::Label => value.clone_into(&mut self.label),
            Text::Home => unreachable!("the layer lets nobody set an output"),
        }
    }

    fn set_input_derivative(&mut self, variable: Real, value: f64) -> bool {
        if variable == Real::Force {
            self.force_rate = value;
        }
        variable == Real::Force
    }

    fn output_derivative(&self, variable: Real) -> Option<f64> {
        match variable {
            Real::X => Some(self.v),
            Real::V => Some(self.force + self.push - self.restoring(self.x)),
            _ => None,
        }
    }

    fn directional_derivative(&self, unknown: Real, known: Real) -> Option<f64> {
        match (unknown, known) {
            (Real::V, Real::Force) => Some(1.0),
            (Real::V, Real::X) => Some(-self.stiffness),
            (Real::X, Real::Force) => Some(0.0),
            (Real::X, Real::X) => Some(3.0),
            _ => None,
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        if self.clamped && self.x_start != 0.0 {
            return Err(Failure(format!("x_start = {} m of a clamped spring: set it to 0", self.x_start)));
        }
        self.period = std::f64::consts::TAU / self.stiffness.sqrt();
        self.x = self.x_start;
        Ok(())
    }

    fn setup_experiment(&mut self, experiment: Experiment) {
        // Anything that shows whether a reset undoes it.
        self.trim = experiment.tolerance.unwrap_or(0.0);
    }

    fn initialize(&mut self, _: &mut Log<'_>) -> Result<(), Failure> {
        if self.substeps == 13 {
            return Err("substeps = 13 brings bad luck: take another".into());
        }
        Ok(())
    }

    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        match self.fault {
            PANIC_IN_STEP => panic!("spring snapped in a step"),
            FAIL_IN_STEP => return Err(Failure(format!("no step from {} s", step.from))),
            TALK_IN_STEP => {
                log.warning("100%s warning");
                log.event("event");
                log.info("information");
            }
            _ => {}
        }
        assert!(step.duration > 0.0, "the layer asks for no step backwards");
        let early = step.may_end_early && self.fault == EVENT_IN_STEP;
        let duration = if early { 0.5 * step.duration } else { step.duration };
        let h = duration / f64::from(self.substeps);
        for _ in 0..self.substeps {
            let force = self.force + self.push + self.bias;
            if !self.held {
                self.v += h * (force - self.restoring(self.x) - 0.1 * self.v);
                self.x += h * self.v;
            }
            self.force += h * self.force_rate;
        }
        self.force_rate = 0.0;
        self.count += 1;
        Ok(early.then_some(step.from + duration))
    }

    fn transfer_state(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        codec.real(Real::Stiffness, &mut self.stiffness)?;
        codec.f64s([&mut self.x_start, &mut self.period, &mut self.force])?;
        codec.f64s([&mut self.force_rate, &mut self.push, &mut self.trim, &mut self.bias])?;
        codec.f64s([&mut self.x, &mut self.v, &mut self.time])?;
        for value in [&mut self.law, &mut self.substeps, &mut self.fault, &mut self.count] {
            codec.i32(value)?;
        }
        [&mut self.clamped, &mut self.held, &mut self.below].into_iter().try_for_each(|b| codec.bool(b))?;
        codec.text(&mut self.label)?;
        if self.substeps < 1 {
            return Err(Failure(format!("the state has {} substeps", self.substeps)));
        }
        Ok(())
    }
}

/// An event is where x changes its sign; it halves the velocity.
impl ModelExchange for Spring {
    const STATES: &'static [Real] = &[Real::X, Real::V];
    const DERIVATIVES: &'static [Real] = &[Real::V, Real::A];
    const EVENT_INDICATORS: usize = 1;

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn set_states(&mut self, states: &[f64]) {
        (self.x, self.v) = (states[0], states[1]);
    }

    fn nominal(&self, state: Real) -> f64 {
        if state == Real::X { 0.5 } else { 0.25 }
    }

    fn event_indicators(&self, indicators: &mut [f64]) {
        indicators[0] = if self.below { -self.x } else { self.x };
    }

    fn update(&mut self, log: &mut Log<'_>) -> Result<Update, Failure> {
        match self.fault {
            PANIC_IN_STEP => panic!("spring snapped in an update"),
            FAIL_IN_STEP => return Err(Failure(format!("no update at {} s", self.time))),
            TALK_IN_STEP => log.event("event"),
            _ => {}
        }
        let passed = self.below != (self.x < 0.0);
        if passed {
            self.below = !self.below;
            self.v *= 0.5;
        }
        self.count += 1;
        // after a passage it asks for one more call
        Ok(Update {
            again: passed,
            states_changed: passed,
            nominals_changed: false,
            next_event: (self.push != 0.0).then_some(self.time + 1.0),
        })
    }

    fn complete_step(&mut self, log: &mut Log<'_>) -> Result<bool, Failure> {
        if self.fault == TALK_IN_STEP {
            log.event("step");
        }
        Ok(self.below != (self.x < 0.0))
    }
}
