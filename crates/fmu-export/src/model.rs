//! What a model does to become an FMU.

use crate::failure::Failure;
use crate::log::Log;
use crate::state::StateCodec;
use crate::variable::VariableId;
use std::fmt;
use std::path::Path;

/// A model that an FMU can be made of.
///
/// The layer has checked call order, references, causality, limits and finiteness before it calls any of
/// these, and keeps the time. `Clone` is what resets an instance and saves its state, so a model is plain
/// data; large constant data belongs in an `Arc`.
///
/// A function with a default need not be written by a model that has no use for it. Those of Integer,
/// Boolean and String variables do not compile for a model whose description has such variables.
///
/// ```compile_fail,E0080
/// # use fmu_export::*;
/// # macro_rules! variables { ($name:ident, $all:expr, $($item:ident)?) => {
/// #     #[derive(Clone, Copy, PartialEq, Eq, Debug)]
/// #     enum $name { $($item)? }
/// #     impl VariableId for $name {
/// #         const ALL: &'static [Self] = $all;
/// #         fn variable(self) -> &'static Variable { unimplemented!() }
/// #         fn from_reference(_: u32) -> Option<Self> { None }
/// #     }
/// # } }
/// # variables!(Count, &[Self::Bounces], Bounces);
/// # variables!(Nothing, &[],);
/// # #[derive(Clone)]
/// # struct Counter;
/// impl Model for Counter {
///     type Integer = Count; // and neither `integer` nor `set_integer`
/// #     type Real = Nothing;
/// #     type Boolean = Nothing;
/// #     type Text = Nothing;
/// #     const GUID: &'static str = "";
/// #     const IDENTIFIER: &'static str = "";
/// #     fn instantiate(_: Environment<'_>, _: &mut Log<'_>) -> Result<Self, Failure> { Ok(Self) }
/// #     fn real(&self, variable: Nothing) -> f64 { match variable {} }
/// #     fn set_real(&mut self, variable: Nothing, _: f64) { match variable {} }
/// #     fn do_step(&mut self, _: Step, _: &mut Log<'_>) -> Result<Option<f64>, Failure> { Ok(None) }
/// #     fn transfer_state(&mut self, _: &mut StateCodec<'_>) -> Result<(), Failure> { Ok(()) }
///     // …
/// }
/// # export_fmu!(Counter);
/// # fn main() {}
/// ```
pub trait Model: Clone + Send + Sized + 'static {
    /// Its Real variables.
    type Real: VariableId;
    /// Its Integer and Enumeration variables.
    type Integer: VariableId;
    /// Its Boolean variables.
    type Boolean: VariableId;
    /// Its String variables.
    type Text: VariableId;

    /// Fingerprint of the model description: hexadecimal digits in braces.
    const GUID: &'static str;
    /// The `modelIdentifier` of the description.
    const IDENTIFIER: &'static str;
    /// The file under `resources/` whose hash is the second half of a guid `{base-payload}`; without folders.
    /// By default no such guid is accepted.
    const PAYLOAD: &'static str = "";
    /// Version of the list of values that [`transfer_state`](Self::transfer_state) passes. A change of that
    /// list raises it: a saved state of another version is refused instead of misread.
    const STATE_VERSION: u64 = 1;

    /// A model with its start values.
    ///
    /// # Errors
    /// When the environment does not suffice; the message states the remedy.
    fn instantiate(environment: Environment<'_>, log: &mut Log<'_>) -> Result<Self, Failure>;

    /// The value of a Real variable, in its unit.
    fn real(&self, variable: Self::Real) -> f64;
    /// The value of an Integer or Enumeration variable.
    fn integer(&self, _variable: Self::Integer) -> i32 {
        const { assert!(Self::Integer::ALL.is_empty(), "Model::integer is to be written") }
        unreachable!("there is no such variable")
    }
    /// The value of a Boolean variable.
    fn boolean(&self, _variable: Self::Boolean) -> bool {
        const { assert!(Self::Boolean::ALL.is_empty(), "Model::boolean is to be written") }
        unreachable!("there is no such variable")
    }
    /// The value of a String variable.
    fn text(&self, _variable: Self::Text) -> &str {
        const { assert!(Self::Text::ALL.is_empty(), "Model::text is to be written") }
        unreachable!("there is no such variable")
    }

    /// Sets a Real parameter or input, in its unit. Setting an input also clears its derivative.
    fn set_real(&mut self, variable: Self::Real, value: f64);
    /// Sets an Integer or Enumeration parameter or input.
    fn set_integer(&mut self, _variable: Self::Integer, _value: i32) {
        const { assert!(Self::Integer::ALL.is_empty(), "Model::set_integer is to be written") }
    }
    /// Sets a Boolean parameter or input.
    fn set_boolean(&mut self, _variable: Self::Boolean, _value: bool) {
        const { assert!(Self::Boolean::ALL.is_empty(), "Model::set_boolean is to be written") }
    }
    /// Sets a String parameter or input.
    fn set_text(&mut self, _variable: Self::Text, _value: &str) {
        const { assert!(Self::Text::ALL.is_empty(), "Model::set_text is to be written") }
    }

    /// Sets the first time derivative of a continuous input for the next step, in its unit per second.
    /// False, and nothing changes, if this input takes none: the default.
    fn set_input_derivative(&mut self, _variable: Self::Real, _value: f64) -> bool {
        false
    }

    /// The first time derivative of an output, in its unit per second; 0 for one that changes at events
    /// alone. None if it has none: the default. A description with `maxOutputDerivativeOrder="1"` promises
    /// one for every Real output.
    fn output_derivative(&self, _variable: Self::Real) -> Option<f64> {
        None
    }

    /// The partial derivative ∂unknown/∂known, in the quotient of their units. `None` if there is no such
    /// derivative: the default.
    fn directional_derivative(&self, _unknown: Self::Real, _known: Self::Real) -> Option<f64> {
        None
    }

    /// Computes what follows from the parameters. Before the end of Initialization Mode it is called
    /// after sets and before gets, and before [`initialize`](Self::initialize).
    ///
    /// # Errors
    /// When the parameters contradict each other.
    fn calculate(&mut self) -> Result<(), Failure> {
        Ok(())
    }

    /// Takes the start, stop and tolerance of the simulation. Not called if the importer leaves them out: the
    /// simulation then starts at 0 s, without a stop time or a tolerance.
    fn setup_experiment(&mut self, _experiment: Experiment) {}

    /// Ends Initialization Mode: checks what relates several variables and computes the start state.
    ///
    /// # Errors
    /// When the model cannot start; the message names variables, values and remedy.
    fn initialize(&mut self, _log: &mut Log<'_>) -> Result<(), Failure> {
        Ok(())
    }

    /// Computes one step. It must be bounded, and should not allocate. A model exported for Model Exchange
    /// alone is never asked.
    ///
    /// Returns the time \[s\] of an event at which it ended early, where [`Step::may_end_early`] allows that.
    ///
    /// # Errors
    /// When it cannot be computed. The model is then as it was before the step.
    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<Option<f64>, Failure>;

    /// Passes all that is not derived to `codec`: parameters, inputs and their derivatives, experiment,
    /// state. Reading starts from a model as instantiated, and ends with computing what is derived.
    ///
    /// # Errors
    /// When the values read are not those of a valid model.
    fn transfer_state(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure>;
}

/// A model whose equations an importer's solver integrates: Model Exchange.
///
/// The layer reads states and derivatives with [`Model::real`], and keeps track of the modes. Between events
/// the discrete state is frozen: what the model computes is smooth in time, states and continuous inputs,
/// also where an event indicator has changed sign already, until [`update`](Self::update).
///
/// A state may also be set with [`Model::set_real`], in Event Mode and in Continuous-Time Mode, as some
/// importers do who only evaluate the equations: the discrete state is then chosen anew. A discrete input may
/// be set in Continuous-Time Mode, which FMI 2.0 forbids and some importers do all the same: it takes effect
/// at once.
pub trait ModelExchange: Model {
    /// The continuous states.
    const STATES: &'static [Self::Real];
    /// Their time derivatives, in the same order.
    const DERIVATIVES: &'static [Self::Real];
    /// The `numberOfEventIndicators` of the description.
    const EVENT_INDICATORS: usize;

    /// Sets the time \[s\]. Solvers go back and forth, and beyond the stop time.
    fn set_time(&mut self, _time: f64) {}

    /// Sets the states, and leaves the discrete state as it is.
    fn set_states(&mut self, states: &[f64]);

    /// The magnitude of a state, above 0, to which the solver relates its tolerance; in its unit.
    fn nominal(&self, _state: Self::Real) -> f64 {
        1.0
    }

    /// Writes the event indicators: an event is where one changes its sign. None is zero after an update.
    fn event_indicators(&self, indicators: &mut [f64]);

    /// Updates the discrete state, and those states that jump, to the event at hand: to be called again while
    /// it asks for that.
    ///
    /// # Errors
    /// When the model cannot go on.
    fn update(&mut self, log: &mut Log<'_>) -> Result<Update, Failure>;

    /// Takes note that the solver has accepted a step to the present time and states. Returns `true` to ask
    /// for Event Mode.
    ///
    /// # Errors
    /// When the model cannot go on.
    fn complete_step(&mut self, _log: &mut Log<'_>) -> Result<bool, Failure> {
        Ok(false)
    }
}

/// What an update in Event Mode did (`fmi2EventInfo`, `fmi3UpdateDiscreteStates`). The model never ends the
/// simulation.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Update {
    /// There is more to update, at the same time.
    pub again: bool,
    /// The solver must restart: states or derivatives have jumped (`valuesOfContinuousStatesChanged`).
    pub states_changed: bool,
    /// Nominal values of states have changed.
    pub nominals_changed: bool,
    /// The next event that is known in advance \[s\].
    pub next_event: Option<f64>,
}

/// How an importer uses an instance.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Interface {
    /// The importer's solver integrates the equations.
    ModelExchange,
    /// The model integrates itself from one communication point to the next.
    #[default]
    CoSimulation,
}

impl fmt::Display for Interface {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::ModelExchange => "Model Exchange",
            Self::CoSimulation => "co-simulation",
        })
    }
}

/// Where an instance lives.
#[derive(Clone, Copy, Debug)]
pub struct Environment<'a> {
    /// How the importer uses it.
    pub interface: Interface,
    /// Name of the instance in the importer; the model identifier if that gave none.
    pub instance_name: &'a str,
    /// The `resources` folder of the unpacked FMU, if the importer stated a usable one.
    pub resources: Option<&'a Path>,
    /// The bytes of `resources/`[`Model::PAYLOAD`], whose hash agrees with the guid. None if the guid states
    /// none.
    pub payload: Option<&'a [u8]>,
}

/// What the importer says about the simulation.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Experiment {
    /// Relative tolerance, above 0.
    pub tolerance: Option<f64>,
    /// Start time \[s\].
    pub start: f64,
    /// Stop time \[s\], not before the start.
    pub stop: Option<f64>,
}

impl Experiment {
    /// Writes or reads the experiment as part of a state.
    ///
    /// # Errors
    /// If the bytes end too early, or a number is not finite.
    pub fn transfer(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        codec.f64(&mut self.start)?;
        codec.option(&mut self.tolerance)?;
        codec.option(&mut self.stop)
    }
}

/// One communication step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Step {
    /// Time at its start \[s\].
    pub from: f64,
    /// Its length \[s\], 1e-30 or more. It may be too small to change the time.
    pub duration: f64,
    /// The importer accepts that the step ends early, at an event (FMI 3.0 `earlyReturnAllowed`).
    pub may_end_early: bool,
}
