//! The wall as an FMI model.

mod exchange;
mod state;

use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;

use fmi2_export::{
    Environment, Experiment, Failure, Interface, Kind, Log, Model, StateReader, StateWriter,
    Step as CommunicationStep, VariableId,
};

use crate::scene::Scene;
use crate::simulation::{Excitation, Outputs, Sensitivity, Simulation};
use crate::solver::Segment;
use crate::variables::{
    BooleanVariable, GUID, IntegerVariable, MODEL_IDENTIFIER, Mechanism, RealVariable, StringVariable,
};
use crate::wall::{Ends, Kinematics, Parameters, Support, Wall};

use exchange::Exchange;

/// The inputs as they stand, and their rates for the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Inputs {
    /// Ground acceleration, held over a step \[m/s²\].
    ground: f64,
    bottom: Input,
    top: Input,
    drift: Input,
}

/// A continuous input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Input {
    value: f64,
    /// Rate for the next step; zero after it.
    rate: f64,
    /// Rate over the last step, for output derivatives.
    last_rate: f64,
}

impl Input {
    fn set(&mut self, value: f64) {
        *self = Self { value, ..Self::default() };
    }

    /// After a step the input counts as extrapolated to its end.
    fn pass(&mut self, duration: f64) {
        *self = Self { value: self.value + self.rate * duration, rate: 0.0, last_rate: self.rate };
    }
}

impl Inputs {
    /// The supports' motion `ahead` seconds after the present, given the motion a scene brings along.
    fn support(&self, own: Support, ahead: f64) -> Support {
        let at = |input: &Input| input.value + input.rate * ahead;
        Support {
            bottom: own.bottom + self.ground + at(&self.bottom),
            top: own.top + self.ground + at(&self.top),
            drift: own.drift + at(&self.drift),
        }
    }

    fn rate(&self, pick: fn(&Input) -> f64) -> Support {
        Support { bottom: pick(&self.bottom), top: pick(&self.top), drift: pick(&self.drift) }
    }
}

/// A wall between the FMI calls.
#[derive(Clone, Debug)]
pub struct Unit {
    parameters: Parameters,
    excitation: Option<Arc<Excitation>>,
    inputs: Inputs,
    experiment: Experiment,
    /// The wall as the parameters stand: while they may change, without a past.
    simulation: Simulation,
    /// Initialisation is over.
    running: bool,
    impulses: Ends,
    /// What Model Exchange adds; none in co-simulation.
    exchange: Option<Exchange>,
    /// The outputs as they follow from state and inputs, once asked for.
    outputs: Cell<Option<Outputs>>,
    top_ignored_told: bool,
}

impl Unit {
    fn new(parameters: Parameters, excitation: Option<Arc<Excitation>>) -> Result<Self, Failure> {
        let simulation = start(&parameters, Experiment::default(), Support::default())?;
        let mut unit = Self {
            parameters,
            excitation,
            inputs: Inputs::default(),
            experiment: Experiment::default(),
            simulation,
            running: false,
            impulses: Ends::default(),
            exchange: None,
            outputs: Cell::new(None),
            top_ignored_told: false,
        };
        unit.calculate()?;
        Ok(unit)
    }

    /// The motion the scene brings along, at the present.
    fn own_support(&self) -> Support {
        let elapsed = self.simulation.progress().time - self.experiment.start;
        if let (Some(exchange), true) = (&self.exchange, self.running) {
            return exchange.stretch.at(elapsed);
        }
        self.excitation.as_ref().map_or_else(Support::default, |motion| motion.stretch(elapsed, 0.0).from)
    }

    /// The supports now.
    fn support(&self) -> Support {
        self.inputs.support(self.own_support(), 0.0)
    }

    fn outputs(&self) -> Outputs {
        let outputs = self.outputs.get().unwrap_or_else(|| self.simulation.outputs(self.support()));
        self.outputs.set(Some(outputs));
        outputs
    }

    /// State or inputs have changed.
    fn refresh(&mut self) {
        self.outputs.set(None);
    }

    fn wall(&self) -> &Wall {
        self.simulation.wall()
    }

    fn input(&mut self, variable: RealVariable) -> Option<&mut Input> {
        match variable {
            RealVariable::ABottom => Some(&mut self.inputs.bottom),
            RealVariable::ATop => Some(&mut self.inputs.top),
            RealVariable::Drift => Some(&mut self.inputs.drift),
            _ => None,
        }
    }

    /// One communication step, through the samples of the scene's own motion; on an error all is as it was.
    fn advance(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<(), Failure> {
        let before = *self.simulation.progress();
        self.simulation.set_time(step.from);
        match self.segments(step, log) {
            Ok(impulses) => {
                self.impulses = impulses;
                self.simulation.set_time(step.from + step.duration);
                for input in [&mut self.inputs.bottom, &mut self.inputs.top, &mut self.inputs.drift] {
                    input.pass(step.duration);
                }
                self.refresh();
                Ok(())
            }
            Err(error) => {
                self.simulation.restore(before);
                Err(error)
            }
        }
    }

    /// Moves the wall through a step and returns the impulses of the supports.
    fn segments(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<Ends, Failure> {
        let end = step.from + step.duration;
        let mut impulses = Ends::default();
        let mut done = 0.0;
        for _ in 0..MOST_SEGMENTS {
            let remaining = step.duration - done;
            let segment = self.segment(done, remaining);
            let time = self.simulation.progress().time;
            let outcome =
                self.simulation.advance(&segment).map_err(|error| format!("at t = {time} s: {error}"))?;
            impulses.bottom += outcome.impulses.bottom;
            impulses.top += outcome.impulses.top;
            done += segment.duration;
            if outcome.stilled {
                log.warning(format_args!(
                    "impacts accumulate: the wall was put to rest at u = 0 by t = {end} s"
                ));
            }
            if outcome.overturned {
                let time = self.simulation.progress().overturn_time.unwrap_or(end);
                log.event(format_args!("overturned at t = {time} s: |u| exceeded u_ins"));
            }
            if outcome.departed {
                log.event(format_args!(
                    "left the supports by t = {end} s: reactions and impulses are 0 from there on"
                ));
            }
            if segment.duration >= remaining {
                return Ok(impulses);
            }
        }
        Err(format!(
            "the step of {} s spans more than {MOST_SEGMENTS} samples; use smaller steps",
            step.duration
        )
        .into())
    }

    /// The next piece of a step over which the supports move linearly.
    fn segment(&self, done: f64, remaining: f64) -> Segment {
        let own = self.excitation.as_ref().map(|motion| {
            let elapsed = self.simulation.progress().time - self.experiment.start;
            motion.stretch(elapsed, remaining)
        });
        let own =
            own.unwrap_or(Segment { duration: remaining, from: Support::default(), to: Support::default() });
        Segment {
            duration: own.duration,
            from: self.inputs.support(own.from, done),
            to: self.inputs.support(own.to, done + own.duration),
        }
    }

    fn tell_about_the_top(&mut self, log: &mut Log<'_>) {
        let driven = self.inputs.top != Input::default();
        if driven && !self.top_ignored_told && self.parameters.mechanism == Mechanism::Parapet {
            self.top_ignored_told = true;
            log.warning(format_args!(
                "a_top is ignored: a parapet has no top support; give its base motion in a_bottom or a_g"
            ));
        }
    }
}

/// Samples of a scene's own motion in one communication step.
const MOST_SEGMENTS: usize = 100_000_000;

fn start(parameters: &Parameters, experiment: Experiment, support: Support) -> Result<Simulation, Failure> {
    // an importer may ask for less than rounding, which no step would reach
    let tolerance = experiment.tolerance.map(|given| match RealVariable::Tolerance.variable().kind {
        Kind::Real { min: Some(least), .. } => given.max(least),
        _ => given,
    });
    Simulation::new(parameters, tolerance, experiment.start, support)
        .map_err(|error| Failure::from(error.to_string()))
}

impl Model for Unit {
    type Real = RealVariable;
    type Integer = IntegerVariable;
    type Boolean = BooleanVariable;
    type Text = StringVariable;

    const GUID: &'static str = GUID;
    const IDENTIFIER: &'static str = MODEL_IDENTIFIER;
    const PAYLOAD: &'static str = "scene.toml";

    fn instantiate(environment: Environment<'_>, _log: &mut Log<'_>) -> Result<Self, Failure> {
        let exchange = (environment.interface == Interface::ModelExchange).then(Exchange::default);
        let Some(payload) = environment.payload else {
            return Ok(Self { exchange, ..Self::new(Parameters::default(), None)? });
        };
        let text = std::str::from_utf8(payload).map_err(|_| "resources/scene.toml is not UTF-8 text")?;
        let folder = environment.resources.unwrap_or(Path::new("."));
        let scene = Scene::parse("resources/scene.toml", text, folder).map_err(|error| error.to_string())?;
        if scene.parameters.kinematics != Kinematics::Linear {
            return Err("resources/scene.toml: an FMU knows kinematics = linear only".into());
        }
        Ok(Self { exchange, ..Self::new(scene.parameters, scene.excitation.map(Arc::new))? })
    }

    fn real(&self, variable: RealVariable) -> f64 {
        use RealVariable as V;
        let progress = self.simulation.progress();
        let (wall, body) = (self.wall(), self.wall().body());
        match variable {
            V::AG => self.exchange.map_or(self.inputs.ground, |exchange| exchange.ground),
            V::ABottom => self.inputs.bottom.value,
            V::ATop => self.inputs.top.value,
            V::Drift => self.inputs.drift.value,
            V::U => self.outputs().displacement,
            V::UDot => self.outputs().velocity,
            V::UDdot => self.outputs().acceleration,
            V::URatio => self.outputs().ratio,
            V::RestoringForce => self.outputs().restoring_force,
            V::DampingForce => self.outputs().damping_force,
            V::ReactionBottom => self.outputs().reactions.bottom,
            V::ReactionTop => self.outputs().reactions.top,
            V::ImpulseBottom => self.impulses.bottom,
            V::ImpulseTop => self.impulses.top,
            V::OverturnTime => progress.overturn_time.unwrap_or(-1.0),
            V::UMax => progress.state.peaks.largest(),
            V::Mass => body.mass,
            V::EffectiveMass => body.effective_mass,
            V::Participation => body.participation,
            V::F0 => body.strength.positive,
            V::F0Negative => body.strength.negative,
            V::UIns => body.instability.positive,
            V::UInsNegative => body.instability.negative,
            V::Omega1 => wall.omega1(),
            V::XiUsed => wall.damping_ratio(),
            V::RestitutionUsed => wall.restitution(),
            parameter => self.parameters.real(parameter).unwrap_or(f64::NAN),
        }
    }

    fn integer(&self, variable: IntegerVariable) -> i32 {
        self.parameters.choice(variable)
    }

    fn boolean(&self, variable: BooleanVariable) -> bool {
        match variable {
            BooleanVariable::Overturned => self.simulation.progress().state.overturned,
        }
    }

    fn text(&self, variable: StringVariable) -> &str {
        match variable {}
    }

    fn set_real(&mut self, variable: RealVariable, value: f64) {
        if variable == RealVariable::AG {
            self.set_ground(value);
        } else if matches!(variable, RealVariable::U | RealVariable::UDot) {
            self.place(variable, value);
        } else if let Some(input) = self.input(variable) {
            input.set(value);
        } else if let Some(parameter) = self.parameters.real_mut(variable) {
            *parameter = value;
        }
        self.refresh();
    }

    fn set_integer(&mut self, variable: IntegerVariable, value: i32) {
        let known = self.parameters.set_choice(variable, value);
        assert!(known, "the layer has checked that {value} is an item of {}", variable.variable().name);
    }

    fn set_boolean(&mut self, _variable: BooleanVariable, _value: bool) {}

    fn set_text(&mut self, variable: StringVariable, _value: &str) {
        match variable {}
    }

    fn set_input_derivative(&mut self, variable: RealVariable, value: f64) -> bool {
        self.input(variable).map(|input| input.rate = value).is_some()
    }

    fn output_derivative(&self, variable: RealVariable) -> Option<f64> {
        let support_rate = self.inputs.rate(|input| input.last_rate);
        let rates = || self.simulation.rates(self.support(), support_rate);
        match variable {
            RealVariable::U => Some(self.outputs().velocity),
            RealVariable::UDot => Some(self.outputs().acceleration),
            RealVariable::UDdot => Some(rates().acceleration),
            RealVariable::ReactionBottom => Some(rates().reactions.bottom),
            RealVariable::ReactionTop => Some(rates().reactions.top),
            _ => None,
        }
    }

    fn directional_derivative(&self, unknown: RealVariable, known: RealVariable) -> Option<f64> {
        use RealVariable as V;
        let ratio = 1.0 / self.wall().body().instability.of(self.outputs().displacement);
        let support = |bottom, top, drift| self.simulation.by_support(Support { bottom, top, drift });
        let (by_u, by_velocity, along) = match known {
            V::U => (1.0, 0.0, self.simulation.by_displacement(self.support())),
            V::UDot => (0.0, 1.0, self.simulation.by_velocity()),
            V::AG => (0.0, 0.0, support(1.0, 1.0, 0.0)),
            V::ABottom => (0.0, 0.0, support(1.0, 0.0, 0.0)),
            V::ATop => (0.0, 0.0, support(0.0, 1.0, 0.0)),
            V::Drift => (0.0, 0.0, support(0.0, 0.0, 1.0)),
            _ => return None,
        };
        let Sensitivity { acceleration, restoring_force, damping_force, reactions } = along;
        match unknown {
            V::U => Some(by_u),
            V::UDot => Some(by_velocity),
            V::UDdot => Some(acceleration),
            V::URatio => Some(by_u * ratio),
            V::RestoringForce => Some(restoring_force),
            V::DampingForce => Some(damping_force),
            V::ReactionBottom => Some(reactions.bottom),
            V::ReactionTop => Some(reactions.top),
            // memories of the past: not functions of the present state and inputs
            V::ImpulseBottom | V::ImpulseTop | V::OverturnTime | V::UMax => Some(0.0),
            _ => None,
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        if self.running {
            return Ok(());
        }
        let elapsed_zero = self.excitation.as_ref().map(|motion| motion.stretch(0.0, 0.0).from);
        let support = self.inputs.support(elapsed_zero.unwrap_or_default(), 0.0);
        self.simulation = start(&self.parameters, self.experiment, support)?;
        self.refresh();
        Ok(())
    }

    fn setup_experiment(&mut self, experiment: Experiment) {
        self.experiment = experiment;
    }

    fn initialize(&mut self, log: &mut Log<'_>) -> Result<(), Failure> {
        self.calculate()?;
        self.running = true;
        if self.exchange.is_some() {
            self.begin_stretch();
        }
        for warning in self.wall().warnings() {
            log.warning(format_args!("{warning}"));
        }
        self.tell_about_the_top(log);
        if self.parameters.u_start != 0.0 {
            log.info(format_args!(
                "released from u_start = {} m; a wall that is coupled or shaken wants u_start = 0",
                self.parameters.u_start
            ));
        }
        log.info(format_args!("solver: {:?}", self.simulation.method()));
        Ok(())
    }

    fn do_step(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<(), Failure> {
        self.tell_about_the_top(log);
        self.advance(step, log)
    }

    fn write_state(&self, writer: &mut StateWriter) {
        state::write(self, writer);
    }

    fn read_state(&mut self, reader: &mut StateReader<'_>) -> Result<(), Failure> {
        *self = state::read(self, reader)?;
        Ok(())
    }
}
