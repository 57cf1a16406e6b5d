//! The floor as an FMI model.

mod saved;

use fmi2_export::{
    Environment, Experiment, Failure, Log, Model, StateReader, StateWriter, Step, VariableId,
    set_start_values,
};

use crate::floor::{Branch, Floor, Parameters};
use crate::inputs::{Input, Inputs};
use crate::motion::{Load, State};
use crate::variables::{
    BooleanVariable, Coupling, GUID, Hysteresis, IntegerVariable, MODEL_IDENTIFIER, RealVariable,
    StringVariable,
};
use crate::wiring::{Output, Role, role};

/// A floor between the FMI calls.
#[derive(Clone, Debug)]
pub struct Unit {
    parameters: Parameters,
    floor: Floor,
    inputs: Inputs,
    state: State,
    base: Base,
    /// Initialisation is over.
    running: bool,
    ignored_told: bool,
}

/// The base's motion, integrated from rest, and what it has given the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Base {
    /// \[m\]
    displacement: f64,
    /// \[m/s\]
    velocity: f64,
    /// Impulse on the floor over the last step \[N s\].
    impulse: f64,
}

/// The parameters of the description's start values are set over these.
const UNSET: Parameters = Parameters {
    mass: 1.0,
    stiffness: 0.0,
    damping_ratio: 0.0,
    damping_coefficient: 0.0,
    hysteresis: Hysteresis::None,
    yield_force: 1.0,
    hardening_ratio: 0.0,
    coupling: Coupling::Reactions,
    displacement_start: 0.0,
    velocity_start: 0.0,
};

impl Unit {
    /// A floor with the start values of the description.
    ///
    /// # Errors
    /// None for a description whose start values make a floor.
    pub fn new() -> Result<Self, Failure> {
        let floor = build(&UNSET)?;
        let mut unit = Self {
            parameters: UNSET,
            floor,
            inputs: Inputs::default(),
            state: State::new(&floor, 0.0, 0.0, Load::default()),
            base: Base::default(),
            running: false,
            ignored_told: false,
        };
        set_start_values(&mut unit);
        unit.calculate()?;
        Ok(unit)
    }

    /// Acceleration relative to the base \[m/s²\].
    fn acceleration(&self) -> f64 {
        self.state.acceleration(&self.floor, self.inputs.present(&self.floor, self.parameters.coupling).value)
    }

    fn damping_force(&self) -> f64 {
        self.floor.damping * self.state.velocity
    }

    /// Force of the base on the floor \[N\].
    fn reaction(&self) -> f64 {
        -(self.state.spring_force(&self.floor) + self.damping_force())
    }

    /// Rate of spring and damping force \[N/s\].
    fn force_rates(&self) -> [f64; 2] {
        let spring = self.floor.tangent(self.state.branch) * self.state.velocity;
        [spring, self.floor.damping * self.acceleration()]
    }

    /// One step; on an error `state` is unusable.
    fn advance(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Failure> {
        let Step { from, duration } = step;
        let coupling = self.parameters.coupling;
        let load = self.inputs.ahead(&self.floor, coupling, duration);
        let velocity = self.state.velocity;
        let corners = self
            .state
            .advance(&self.floor, load, duration)
            .map_err(|error| format!("in the step from t = {from} s: {error}"))?;
        if corners > 0 {
            let end = from + duration;
            log.event(format_args!("corners of the hysteresis passed by t = {end} s: {corners}"));
        }
        let Input { value, rate, .. } = self.inputs.ground;
        let gained = duration * (value + 0.5 * rate * duration);
        self.base.displacement +=
            duration * (self.base.velocity + duration * (0.5 * value + rate * duration / 6.0));
        self.base.velocity += gained;
        // momentum: what the floor has gained and handed to the walls came from the base
        self.base.impulse = self.floor.mass * (self.state.velocity - velocity + gained)
            + self.inputs.impulse(coupling, duration);
        self.inputs.pass(duration);
        Ok(())
    }

    /// Inputs of the other coupling are set, and do nothing.
    fn tell_about_ignored_inputs(&mut self, log: &mut Log<'_>) {
        let (name, other, ignored) = match self.parameters.coupling {
            Coupling::Reactions => {
                ("reactions", "impulses", self.inputs.impulses.iter().any(|impulse| *impulse != 0.0))
            }
            Coupling::Impulses => (
                "impulses",
                "reactions",
                self.inputs.reactions.iter().any(|input| *input != Input::default()),
            ),
        };
        if ignored && !self.ignored_told {
            self.ignored_told = true;
            log.warning(format_args!(
                "{other} are connected but coupling = {name} ignores them; set coupling to {other} or leave them at 0"
            ));
        }
    }

    fn input(&mut self, variable: RealVariable) -> Option<&mut Input> {
        match role(variable) {
            Role::Ground => Some(&mut self.inputs.ground),
            Role::Reaction(wall) => self.inputs.reactions.get_mut(wall),
            Role::Impulse(_) | Role::Parameter(_) | Role::Output(_) => None,
        }
    }

    fn output(&self, output: Output) -> f64 {
        let state = &self.state;
        match output {
            Output::Displacement => state.displacement,
            Output::Velocity => state.velocity,
            Output::Acceleration => self.acceleration(),
            Output::DisplacementAbsolute => state.displacement + self.base.displacement,
            Output::VelocityAbsolute => state.velocity + self.base.velocity,
            Output::AccelerationAbsolute => state
                .acceleration(&self.floor, self.inputs.by_walls(&self.floor, self.parameters.coupling).value),
            Output::SpringForce => state.spring_force(&self.floor),
            Output::DampingForce => self.damping_force(),
            Output::ReactionBottom => self.reaction(),
            Output::ImpulseBottom => self.base.impulse,
            Output::DisplacementPlastic => state.plastic,
            Output::EnergyDamping => state.damping_energy,
            Output::EnergyHysteretic => state.hysteretic_energy,
            Output::Omega => self.floor.omega(),
            Output::DampingCoefficientUsed => self.floor.damping,
            Output::YieldDisplacement => self.floor.yielding.map_or(0.0, |yielding| yielding.displacement),
        }
    }
}

fn build(parameters: &Parameters) -> Result<Floor, Failure> {
    Floor::new(parameters).map_err(|error| Failure::from(error.to_string()))
}

impl Model for Unit {
    type Real = RealVariable;
    type Integer = IntegerVariable;
    type Boolean = BooleanVariable;
    type Text = StringVariable;

    const GUID: &'static str = GUID;
    const IDENTIFIER: &'static str = MODEL_IDENTIFIER;
    const PAYLOAD: &'static str = "floor.toml";

    fn instantiate(environment: Environment<'_>, _log: &mut Log<'_>) -> Result<Self, Failure> {
        if environment.payload.is_some() {
            return Err("a floor is set by its parameters; it reads no resources/floor.toml".into());
        }
        Self::new()
    }

    fn real(&self, variable: RealVariable) -> f64 {
        match role(variable) {
            Role::Ground => self.inputs.ground.value,
            Role::Reaction(wall) => self.inputs.reactions[wall].value,
            Role::Impulse(wall) => self.inputs.impulses[wall],
            Role::Parameter(parameter) => self.parameters.get(parameter),
            Role::Output(output) => self.output(output),
        }
    }

    fn integer(&self, variable: IntegerVariable) -> i32 {
        match variable {
            IntegerVariable::Hysteresis => self.parameters.hysteresis.value(),
            IntegerVariable::Coupling => self.parameters.coupling.value(),
        }
    }

    fn boolean(&self, variable: BooleanVariable) -> bool {
        match variable {
            BooleanVariable::Yielding => self.state.branch != Branch::Elastic,
        }
    }

    fn text(&self, variable: StringVariable) -> &str {
        match variable {}
    }

    fn set_real(&mut self, variable: RealVariable, value: f64) {
        match role(variable) {
            Role::Ground => self.inputs.ground.set(value),
            Role::Reaction(wall) => self.inputs.reactions[wall].set(value),
            Role::Impulse(wall) => self.inputs.impulses[wall] = value,
            Role::Parameter(parameter) => *self.parameters.slot(parameter) = value,
            // the layer sets no outputs
            Role::Output(_) => {}
        }
    }

    fn set_integer(&mut self, variable: IntegerVariable, value: i32) {
        let known = match variable {
            IntegerVariable::Hysteresis => {
                Hysteresis::from_value(value).map(|choice| self.parameters.hysteresis = choice)
            }
            IntegerVariable::Coupling => {
                Coupling::from_value(value).map(|choice| self.parameters.coupling = choice)
            }
        };
        assert!(
            known.is_some(),
            "the layer has checked that {value} is an item of {}",
            variable.variable().name
        );
    }

    fn set_boolean(&mut self, _variable: BooleanVariable, _value: bool) {}

    fn set_text(&mut self, variable: StringVariable, _value: &str) {
        match variable {}
    }

    fn set_input_derivative(&mut self, variable: RealVariable, value: f64) -> bool {
        self.input(variable).map(|input| input.rate = value).is_some()
    }

    fn output_derivative(&self, variable: RealVariable) -> Option<f64> {
        let Role::Output(output) = role(variable) else { return None };
        let [spring, damping] = self.force_rates();
        let by_walls = || self.inputs.by_walls(&self.floor, self.parameters.coupling);
        match output {
            Output::Displacement => Some(self.state.velocity),
            Output::Velocity => Some(self.acceleration()),
            Output::Acceleration => {
                Some(self.state.jerk(&self.floor, self.inputs.present(&self.floor, self.parameters.coupling)))
            }
            Output::DisplacementAbsolute => Some(self.output(Output::VelocityAbsolute)),
            Output::VelocityAbsolute => Some(self.output(Output::AccelerationAbsolute)),
            Output::AccelerationAbsolute => Some(by_walls().rate - (spring + damping) / self.floor.mass),
            Output::SpringForce => Some(spring),
            Output::DampingForce => Some(damping),
            Output::ReactionBottom => Some(-(spring + damping)),
            Output::ImpulseBottom
            | Output::DisplacementPlastic
            | Output::EnergyDamping
            | Output::EnergyHysteretic
            | Output::Omega
            | Output::DampingCoefficientUsed
            | Output::YieldDisplacement => None,
        }
    }

    fn directional_derivative(&self, unknown: RealVariable, known: RealVariable) -> Option<f64> {
        let Role::Output(unknown) = role(unknown) else { return None };
        let Floor { mass, damping, .. } = self.floor;
        let along = match role(known) {
            Role::Output(Output::Displacement) => {
                Along { displacement: 1.0, spring: self.floor.tangent(self.state.branch), ..Along::default() }
            }
            Role::Output(Output::Velocity) => Along { velocity: 1.0, damping, ..Along::default() },
            Role::Ground => Along { ground: 1.0, ..Along::default() },
            Role::Reaction(_) => match self.parameters.coupling {
                Coupling::Reactions => Along { walls: 1.0, ..Along::default() },
                Coupling::Impulses => Along::default(),
            },
            Role::Impulse(_) => match self.parameters.coupling {
                Coupling::Impulses if self.inputs.last_duration > 0.0 => {
                    Along { walls: 1.0 / self.inputs.last_duration, ..Along::default() }
                }
                Coupling::Impulses | Coupling::Reactions => Along::default(),
            },
            Role::Parameter(_) | Role::Output(_) => return None,
        };
        let absolute = -(along.spring + along.damping + along.walls) / mass;
        match unknown {
            Output::Displacement | Output::DisplacementAbsolute => Some(along.displacement),
            Output::Velocity | Output::VelocityAbsolute => Some(along.velocity),
            Output::Acceleration => Some(absolute - along.ground),
            Output::AccelerationAbsolute => Some(absolute),
            Output::SpringForce => Some(along.spring),
            Output::DampingForce => Some(along.damping),
            Output::ReactionBottom => Some(-(along.spring + along.damping)),
            // memories of the past: not functions of the present state and inputs
            Output::ImpulseBottom
            | Output::DisplacementPlastic
            | Output::EnergyDamping
            | Output::EnergyHysteretic => Some(0.0),
            Output::Omega | Output::DampingCoefficientUsed | Output::YieldDisplacement => None,
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        if self.running {
            return Ok(());
        }
        self.floor = build(&self.parameters)?;
        let Parameters { displacement_start, velocity_start, coupling, .. } = self.parameters;
        let load = self.inputs.present(&self.floor, coupling);
        self.state = State::new(&self.floor, displacement_start, velocity_start, load);
        Ok(())
    }

    fn setup_experiment(&mut self, _experiment: Experiment) {}

    fn initialize(&mut self, log: &mut Log<'_>) -> Result<(), Failure> {
        self.calculate()?;
        self.running = true;
        let Parameters { stiffness, damping_ratio, damping_coefficient, .. } = self.parameters;
        if stiffness == 0.0 && damping_ratio > 0.0 && damping_coefficient == 0.0 {
            log.warning(format_args!(
                "damping_ratio = {damping_ratio} damps nothing where stiffness = 0; use damping_coefficient"
            ));
        }
        self.tell_about_ignored_inputs(log);
        log.info(format_args!(
            "omega = {} rad/s, damping_coefficient_used = {} N.s/m",
            self.floor.omega(),
            self.floor.damping
        ));
        Ok(())
    }

    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Failure> {
        self.tell_about_ignored_inputs(log);
        let before = self.state;
        self.advance(step, log).inspect_err(|_| self.state = before)
    }

    fn write_state(&self, writer: &mut StateWriter) {
        self.write(writer);
    }

    fn read_state(&mut self, reader: &mut StateReader<'_>) -> Result<(), Failure> {
        *self = self.clone().read(reader)?;
        Ok(())
    }
}

/// Changes along one known.
#[derive(Clone, Copy, Debug, Default)]
struct Along {
    displacement: f64,
    velocity: f64,
    spring: f64,
    damping: f64,
    /// Force of the floor on the walls.
    walls: f64,
    ground: f64,
}
