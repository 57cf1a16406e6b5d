//! The floor as an FMI model.

use fmu_export::{Environment, Failure, Input, Interface, Log, Model, StateCodec, Step, VariableId};

use crate::choices::Coupling;
use crate::floor::{Branch, Floor, Parameters};
use crate::inputs::{Base, Inputs, Owner};
use crate::motion::{FloorState, Load, Work};
use crate::values;
use crate::variables::{
    BooleanVariable, CONTINUOUS_STATES, GUID, IntegerVariable, MODEL_IDENTIFIER, RealVariable,
    StringVariable, integer_parameter, real_calculated, real_input, real_local, real_output, real_parameter,
};

/// A floor between the FMI calls.
#[derive(Clone, Debug)]
pub struct Unit {
    parameters: Parameters,
    interface: Interface,
    pub(crate) floor: Floor,
    inputs: Inputs,
    pub(crate) state: FloorState,
    base: Base,
    /// Time of an importer's solver, in Model Exchange \[s\].
    pub(crate) time: f64,
    /// Initialisation is over.
    running: bool,
    ignored_told: bool,
}

impl Unit {
    /// A floor with the start values of the description.
    ///
    /// # Errors
    /// None for a description whose start values make a floor.
    pub fn new() -> Result<Self, Failure> {
        Self::of(Parameters::default())
    }

    /// A floor with these parameters as its start values.
    fn of(parameters: Parameters) -> Result<Self, Failure> {
        let floor = build(&parameters)?;
        let mut unit = Self {
            parameters,
            interface: Interface::CoSimulation,
            floor,
            inputs: Inputs::default(),
            state: FloorState::new(&floor, 0.0, 0.0, Load::default()),
            base: Base::default(),
            time: 0.0,
            running: false,
            ignored_told: false,
        };
        unit.calculate()?;
        Ok(unit)
    }

    /// Acceleration relative to the base \[m/s²\].
    fn acceleration(&self) -> f64 {
        self.state.acceleration(&self.floor, self.load().value)
    }

    /// Acceleration by base and walls now, with its rate over the last step.
    pub(crate) fn load(&self) -> Load {
        self.inputs.present(&self.floor, self.parameters.coupling)
    }

    /// Acceleration by the walls alone.
    fn by_walls(&self) -> Load {
        self.inputs.by_walls(&self.floor, self.parameters.coupling)
    }

    /// Returns a continuous state of Model Exchange; `None` for other variables.
    #[allow(unreachable_patterns, reason = "the states are outputs and local variables, too")]
    pub(crate) fn continuous_state(&mut self, variable: RealVariable) -> Option<&mut f64> {
        match variable {
            RealVariable::Displacement => Some(&mut self.state.displacement),
            RealVariable::Velocity => Some(&mut self.state.velocity),
            RealVariable::EnergyDamping => Some(&mut self.state.damping_energy),
            RealVariable::BaseDisplacement => Some(&mut self.base.displacement),
            RealVariable::BaseVelocity => Some(&mut self.base.velocity),
            real_input!() | real_output!() | real_local!() | real_parameter!() | real_calculated!() => None,
        }
    }

    fn damping_force(&self) -> f64 {
        self.floor.damping * self.state.velocity
    }

    /// One step; on an error `state` is unusable.
    fn advance(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Failure> {
        let Step { from, duration, .. } = step;
        let coupling = self.parameters.coupling;
        let load = self.inputs.ahead(&self.floor, coupling, duration);
        let velocity = self.state.velocity;
        let Work { corners, .. } = self
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
        self.inputs.extrapolate(duration);
        Ok(())
    }

    /// Inputs of the other coupling are set but have no effect.
    pub(crate) fn tell_about_ignored_inputs(&mut self, log: &mut Log<'_>) {
        let Inputs { reactions, impulses, .. } = &self.inputs;
        let (name, other, ignored) = match self.parameters.coupling {
            Coupling::Reactions => ("reactions", "impulses", impulses.iter().any(|impulse| *impulse != 0.0)),
            Coupling::Impulses => ("impulses", "reactions", *reactions != [Input::default(); 8]),
        };
        if ignored && !self.ignored_told {
            self.ignored_told = true;
            log.warning(format_args!(
                "{other} are connected but coupling = {name} ignores them; set coupling to {other} or leave \
                 them at 0"
            ));
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
        let parameters = environment.payload.map_or_else(|| Ok(Parameters::default()), values::read)?;
        Ok(Self { interface: environment.interface, ..Self::of(parameters)? })
    }

    fn real(&self, variable: RealVariable) -> f64 {
        use RealVariable as V;
        let (state, base) = (&self.state, &self.base);
        match variable {
            real_input!() => self.inputs.get(variable),
            V::Displacement => state.displacement,
            V::Velocity => state.velocity,
            V::Acceleration => self.acceleration(),
            V::DisplacementAbsolute => state.displacement + base.displacement,
            V::VelocityAbsolute => state.velocity + base.velocity,
            V::AccelerationAbsolute => state.acceleration(&self.floor, self.by_walls().value),
            V::SpringForce => state.spring_force(&self.floor),
            V::DampingForce => self.damping_force(),
            V::ReactionBottom => -(state.spring_force(&self.floor) + self.damping_force()),
            V::ImpulseBottom => base.impulse,
            V::DisplacementPlastic => state.flow(&self.floor).0,
            V::EnergyDamping => state.damping_energy,
            V::EnergyHysteretic => state.flow(&self.floor).1,
            V::BaseDisplacement => base.displacement,
            V::BaseVelocity => base.velocity,
            V::BaseAcceleration => self.inputs.ground.value,
            V::DampingPower => self.damping_force() * state.velocity,
            V::Omega => self.floor.omega(),
            V::DampingCoefficientUsed => self.floor.damping,
            V::YieldDisplacement => self.floor.yielding.map_or(0.0, |yielding| yielding.displacement),
            real_parameter!() => self.parameters.real(variable).unwrap_or(f64::NAN),
        }
    }

    fn integer(&self, variable: IntegerVariable) -> i32 {
        match variable {
            integer_parameter!() => self.parameters.integer(variable).unwrap_or_default(),
        }
    }

    fn boolean(&self, variable: BooleanVariable) -> bool {
        match variable {
            BooleanVariable::Yielding => self.state.branch != Branch::Elastic,
        }
    }

    fn set_real(&mut self, variable: RealVariable, value: f64) {
        match variable {
            real_input!() => self.inputs.set(variable, value),
            real_parameter!() => assert!(self.parameters.set_real(variable, value), "it is a parameter"),
            real_output!() | real_local!() | real_calculated!() => {
                let Some(state) = self.continuous_state(variable) else {
                    unreachable!("the layer refuses to set {}", variable.variable().name);
                };
                *state = value;
                let load = self.load();
                self.state.event(&self.floor, load);
            }
        }
    }

    fn set_integer(&mut self, variable: IntegerVariable, value: i32) {
        let known = self.parameters.set_integer(variable, value);
        assert!(known, "the layer has checked that {value} is an item of {}", variable.variable().name);
    }

    fn set_boolean(&mut self, _variable: BooleanVariable, _value: bool) {}

    fn set_input_derivative(&mut self, variable: RealVariable, value: f64) -> bool {
        self.inputs.continuous(variable).map(|input| input.rate = value).is_some()
    }

    fn output_derivative(&self, variable: RealVariable) -> Option<f64> {
        use RealVariable as V;
        // rates of spring and damping force [N/s]
        let spring = self.floor.tangent(self.state.branch) * self.state.velocity;
        let damping = self.floor.damping * self.acceleration();
        match variable {
            V::Displacement => Some(self.state.velocity),
            V::Velocity => Some(self.acceleration()),
            V::Acceleration => Some(self.state.jerk(&self.floor, self.load())),
            V::DisplacementAbsolute => Some(self.real(V::VelocityAbsolute)),
            V::VelocityAbsolute => Some(self.real(V::AccelerationAbsolute)),
            V::AccelerationAbsolute => Some(self.by_walls().rate - (spring + damping) / self.floor.mass),
            V::SpringForce => Some(spring),
            V::DampingForce => Some(damping),
            V::ReactionBottom => Some(-(spring + damping)),
            V::DisplacementPlastic => Some(self.state.plastic_rate()),
            V::EnergyDamping => Some(self.damping_force() * self.state.velocity),
            V::EnergyHysteretic => {
                let force = self.floor.yielding.map_or(0.0, |yielding| yielding.force);
                Some(force * self.state.plastic_rate().abs())
            }
            // it changes at communication points alone
            V::ImpulseBottom => Some(0.0),
            real_local!() | real_input!() | real_parameter!() | real_calculated!() => None,
        }
    }

    fn directional_derivative(&self, unknown: RealVariable, known: RealVariable) -> Option<f64> {
        use RealVariable as V;
        let owner = Owner::of(known);
        if owner.is_none() && !CONTINUOUS_STATES.contains(&known) {
            return None;
        }
        let of = |variable: V| if known == variable { 1.0 } else { 0.0 };
        let spring = self.floor.tangent(self.state.branch) * of(V::Displacement);
        let damping = self.floor.damping * of(V::Velocity);
        let walls = match owner {
            Some(Owner::Wall(coupling, _)) => self.inputs.weight(coupling, self.parameters.coupling),
            Some(Owner::Base) | None => 0.0,
        };
        let absolute = -(spring + damping + walls) / self.floor.mass;
        let sign = self.state.branch.sign();
        let flow = of(V::Displacement) * sign.abs();
        match unknown {
            V::Displacement | V::Velocity | V::BaseDisplacement | V::BaseVelocity | V::EnergyDamping => {
                Some(of(unknown))
            }
            V::DisplacementAbsolute => Some(of(V::Displacement) + of(V::BaseDisplacement)),
            V::VelocityAbsolute => Some(of(V::Velocity) + of(V::BaseVelocity)),
            V::BaseAcceleration => Some(of(V::AG)),
            V::DampingPower => Some(2.0 * damping * self.state.velocity),
            V::DisplacementPlastic => Some(flow),
            V::EnergyHysteretic => Some(flow * sign * self.floor.yielding.map_or(0.0, |own| own.force)),
            V::Acceleration => Some(absolute - of(V::AG)),
            V::AccelerationAbsolute => Some(absolute),
            V::SpringForce => Some(spring),
            V::DampingForce => Some(damping),
            V::ReactionBottom => Some(-(spring + damping)),
            // this depends on the past, not on the present state and inputs alone
            V::ImpulseBottom => Some(0.0),
            real_input!() | real_parameter!() | real_calculated!() => None,
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        if self.running {
            return Ok(());
        }
        self.floor = build(&self.parameters)?;
        let Parameters { displacement_start, velocity_start, .. } = self.parameters;
        self.state = FloorState::new(&self.floor, displacement_start, velocity_start, self.load());
        Ok(())
    }

    fn initialize(&mut self, log: &mut Log<'_>) -> Result<(), Failure> {
        self.calculate()?;
        if self.interface == Interface::ModelExchange && self.parameters.coupling == Coupling::Impulses {
            return Err("coupling = impulses needs the steps of co-simulation; set it to reactions".into());
        }
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

    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        self.tell_about_ignored_inputs(log);
        let before = self.state;
        self.advance(step, log).map(|()| None).inspect_err(|_| self.state = before)
    }

    fn transfer_state(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        self.parameters.transfer(codec)?;
        let Inputs { ground, reactions, impulses, last_duration } = &mut self.inputs;
        for input in reactions.iter_mut().chain([ground]) {
            input.transfer(codec)?;
        }
        codec.f64s(impulses)?;
        codec.f64(last_duration)?;
        if codec.is_reading() {
            // what follows from the parameters, before the state itself
            self.calculate()?;
        }
        let FloorState { displacement, velocity, plastic, branch, damping_energy, hysteretic_energy } =
            &mut self.state;
        codec.f64s([displacement, velocity, plastic, damping_energy, hysteretic_energy])?;
        codec.item(branch, &[Branch::Elastic, Branch::YieldingUp, Branch::YieldingDown])?;
        if self.floor.yielding.is_none() && *branch != Branch::Elastic {
            return Err("the state has a yielding spring, but hysteresis = none".into());
        }
        let Base { displacement, velocity, impulse } = &mut self.base;
        codec.f64s([displacement, velocity, impulse])?;
        codec.f64(&mut self.time)?;
        codec.bool(&mut self.running)?;
        codec.bool(&mut self.ignored_told)
    }
}
