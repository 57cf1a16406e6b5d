//! The wall as an FMI model for co-simulation.

use fmu_export::{
    Environment, Experiment, Failure, Interface, Log, Model, StateCodec, Step as CommunicationStep,
    VariableId,
};

use crate::simulation::Outputs;
use crate::variables::{
    BooleanVariable, GUID, IntegerVariable, MODEL_IDENTIFIER, RealVariable, StringVariable,
    integer_parameter, real_calculated, real_input, real_local, real_output, real_parameter,
};
use crate::wall::{Parameters, Support};

use super::Unit;
use super::model_exchange::Exchange;
use super::scene::UnitScene;

impl Model for Unit {
    type Real = RealVariable;
    type Integer = IntegerVariable;
    type Boolean = BooleanVariable;
    type Text = StringVariable;

    const GUID: &'static str = GUID;
    const IDENTIFIER: &'static str = MODEL_IDENTIFIER;
    const PAYLOAD: &'static str = "scene.bin";
    const STATE_VERSION: u64 = 4;

    fn instantiate(environment: Environment<'_>, _log: &mut Log<'_>) -> Result<Self, Failure> {
        let exchange = (environment.interface == Interface::ModelExchange).then(Exchange::default);
        let Some(payload) = environment.payload else {
            return Self::new(Parameters::default(), None, exchange);
        };
        let scene = UnitScene::read(payload).map_err(|error| format!("resources/scene.bin: {error}"))?;
        let mut unit = Self::new(scene.parameters.clone(), scene.shared_motion(), exchange)?;
        unit.has_scene = true;
        Ok(unit)
    }

    #[allow(unreachable_patterns, reason = "the outputs that are not computed from the state are above")]
    fn real(&self, variable: RealVariable) -> f64 {
        use RealVariable as V;
        let progress = self.simulation.progress();
        let (wall, body) = (self.wall(), self.wall().body());
        match variable {
            V::AG => self.inputs.ground,
            V::ABottom => self.inputs.bottom.value,
            V::ATop => self.inputs.top.value,
            V::Drift => self.inputs.drift.value,
            V::ImpulseBottom => self.impulses.bottom,
            V::ImpulseTop => self.impulses.top,
            V::OverturnTime => progress.overturn_time.unwrap_or(-1.0),
            V::TieBreakTime => progress.tie_break_time().unwrap_or(-1.0),
            V::UMax => progress.state.peaks.largest(),
            V::Mass => body.mass,
            V::EffectiveMass => body.effective_mass,
            V::Participation => body.participation,
            V::F0 => wall.stated(1.0)[0],
            V::F0Negative => wall.stated(-1.0)[0],
            V::UIns => wall.stated(1.0)[1],
            V::UInsNegative => wall.stated(-1.0)[1],
            V::Omega1 => wall.omega1(),
            V::XiUsed => wall.damping_ratio(),
            V::RestitutionUsed => wall.restitution().positive,
            real_output!() | real_local!() => output(&self.outputs(), variable).unwrap_or(f64::NAN),
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
            BooleanVariable::Overturned => self.simulation.progress().state.overturned,
            BooleanVariable::TieBroken => self.simulation.progress().tie_break_time().is_some(),
        }
    }

    #[allow(unreachable_patterns, reason = "the states are outputs, too")]
    fn set_real(&mut self, variable: RealVariable, value: f64) {
        use RealVariable as V;
        match variable {
            V::AG => self.inputs.ground = value,
            V::ABottom => self.inputs.bottom.set(value),
            V::ATop => self.inputs.top.set(value),
            V::Drift => self.inputs.drift.set(value),
            V::U | V::UDot => self.place(variable, value),
            real_parameter!() => assert!(self.parameters.set_real(variable, value), "it is a parameter"),
            real_output!() | real_local!() | real_calculated!() => {
                unreachable!("the layer refuses to set {}", variable.variable().name)
            }
        }
        self.refresh();
    }

    fn set_integer(&mut self, variable: IntegerVariable, value: i32) {
        let known = self.parameters.set_integer(variable, value);
        assert!(known, "the layer has checked that {value} is an item of {}", variable.variable().name);
    }

    fn set_boolean(&mut self, _variable: BooleanVariable, _value: bool) {}

    fn set_input_derivative(&mut self, variable: RealVariable, value: f64) -> bool {
        self.input(variable).map(|input| input.rate = value).is_some()
    }

    #[allow(unreachable_patterns, reason = "the outputs that are not computed from the state are above")]
    fn output_derivative(&self, variable: RealVariable) -> Option<f64> {
        use RealVariable as V;
        let Outputs { displacement, velocity, acceleration, .. } = self.outputs();
        match variable {
            V::U => Some(velocity),
            V::UDot => Some(acceleration),
            // the largest |u| grows with |u| alone
            V::UMax if displacement.abs() >= self.real(V::UMax) => {
                Some((displacement.signum() * velocity).max(0.0))
            }
            // these change at communication points and events alone
            V::UMax | V::ImpulseBottom | V::ImpulseTop | V::OverturnTime | V::TieBreakTime => Some(0.0),
            real_output!() | real_local!() => {
                let support_rate = self.inputs.rate(|input| input.last_rate);
                let motion = [velocity, acceleration];
                output(&self.simulation.derivative(self.support(), motion, support_rate), variable)
            }
            real_input!() | real_parameter!() | real_calculated!() => None,
        }
    }

    #[allow(unreachable_patterns, reason = "the states are outputs, too")]
    fn directional_derivative(&self, unknown: RealVariable, known: RealVariable) -> Option<f64> {
        use RealVariable as V;
        let (motion, [bottom, top, drift]) = match known {
            V::U => ([1.0, 0.0], [0.0; 3]),
            V::UDot => ([0.0, 1.0], [0.0; 3]),
            V::AG => ([0.0; 2], [1.0, 1.0, 0.0]),
            V::ABottom => ([0.0; 2], [1.0, 0.0, 0.0]),
            V::ATop => ([0.0; 2], [0.0, 1.0, 0.0]),
            V::Drift => ([0.0; 2], [0.0, 0.0, 1.0]),
            real_output!() | real_local!() | real_parameter!() | real_calculated!() => return None,
        };
        let along = self.simulation.derivative(self.support(), motion, Support { bottom, top, drift });
        match unknown {
            // these depend on the past, not on the present state and inputs alone
            V::ImpulseBottom | V::ImpulseTop | V::OverturnTime | V::UMax | V::TieBreakTime => Some(0.0),
            real_output!() | real_local!() => output(&along, unknown),
            real_input!() | real_parameter!() | real_calculated!() => None,
        }
    }

    fn calculate(&mut self) -> Result<(), Failure> {
        self.prepare()
    }

    fn setup_experiment(&mut self, experiment: Experiment) {
        self.experiment = experiment;
    }

    fn initialize(&mut self, log: &mut Log<'_>) -> Result<(), Failure> {
        self.prepare()?;
        self.running = true;
        if self.exchange.is_some() {
            self.begin_own_motion(self.elapsed());
        }
        let of_start = self.wall().start_warning(self.parameters.u_start);
        for warning in self.wall().warnings().iter().chain(&of_start) {
            log.warning(format_args!("{warning}"));
        }
        self.choose_warnings();
        self.warn_of_inputs(log);
        if self.parameters.u_start != 0.0 {
            log.info(format_args!("released from u_start = {} m", self.parameters.u_start));
        }
        if self.exchange.is_none() {
            log.info(format_args!("solver: {}", self.simulation.method()));
        } else {
            self.warn_of_solver(log);
        }
        Ok(())
    }

    fn do_step(&mut self, step: CommunicationStep, log: &mut Log<'_>) -> Result<Option<f64>, Failure> {
        self.warn_of_inputs(log);
        self.advance(step, log)
    }

    fn transfer_state(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        self.transfer(codec)
    }
}

/// Returns an output that follows from the state, or its derivative; `None` for other variables.
#[allow(clippy::match_same_arms, reason = "outputs that have another source, and no outputs")]
fn output(outputs: &Outputs, variable: RealVariable) -> Option<f64> {
    use RealVariable as V;
    match variable {
        V::U => Some(outputs.displacement),
        V::UDot => Some(outputs.velocity),
        V::UDdot => Some(outputs.acceleration),
        V::URatio => Some(outputs.ratio),
        V::RestoringForce => Some(outputs.restoring_force),
        V::DampingForce => Some(outputs.damping_force),
        V::ReactionBottom => Some(outputs.reactions.bottom),
        V::ReactionTop => Some(outputs.reactions.top),
        V::TieForce => Some(outputs.tie_force),
        V::TieElongation => Some(outputs.tie_elongation.positive),
        V::TieElongationNegative => Some(outputs.tie_elongation.negative),
        V::ImpulseBottom | V::ImpulseTop | V::OverturnTime | V::UMax | V::TieBreakTime => None,
        real_input!() | real_parameter!() | real_calculated!() => None,
    }
}
