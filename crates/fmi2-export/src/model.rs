//! What a model does to become an FMU.

use crate::log::Log;
use crate::state::{StateReader, StateWriter};
use crate::variable::VariableId;
use std::fmt;
use std::path::Path;

/// A model that an FMU can be made of.
///
/// The layer has checked call order, references, causality, limits and finiteness before it calls any of
/// these, and keeps the time. `Clone` is what resets an instance and saves its state, so a model is plain
/// data; large constant data belongs in an `Arc`.
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
    const PAYLOAD: &'static str;

    /// A model with its start values.
    ///
    /// # Errors
    /// When the environment does not suffice; the message states the remedy.
    fn instantiate(environment: Environment<'_>, log: &mut Log<'_>) -> Result<Self, Failure>;

    /// The value of a Real variable, in its unit.
    fn real(&self, variable: Self::Real) -> f64;
    /// The value of an Integer or Enumeration variable.
    fn integer(&self, variable: Self::Integer) -> i32;
    /// The value of a Boolean variable.
    fn boolean(&self, variable: Self::Boolean) -> bool;
    /// The value of a String variable.
    fn text(&self, variable: Self::Text) -> &str;

    /// Sets a Real parameter or input, in its unit. Setting an input also clears its derivative.
    fn set_real(&mut self, variable: Self::Real, value: f64);
    /// Sets an Integer or Enumeration parameter or input.
    fn set_integer(&mut self, variable: Self::Integer, value: i32);
    /// Sets a Boolean parameter or input.
    fn set_boolean(&mut self, variable: Self::Boolean, value: bool);
    /// Sets a String parameter or input.
    fn set_text(&mut self, variable: Self::Text, value: &str);

    /// Sets the first time derivative of a continuous input for the next step, in its unit per second.
    /// False, and nothing changes, if this input takes none.
    fn set_input_derivative(&mut self, variable: Self::Real, value: f64) -> bool;

    /// The first time derivative of an output, in its unit per second. None if it has none.
    fn output_derivative(&self, variable: Self::Real) -> Option<f64>;

    /// The partial derivative ∂unknown/∂known, in the quotient of their units. None if they are no such pair.
    fn directional_derivative(&self, unknown: Self::Real, known: Self::Real) -> Option<f64>;

    /// Computes what follows from the parameters. In Initialization Mode it is called after sets and before
    /// gets, and before [`initialize`](Self::initialize).
    ///
    /// # Errors
    /// When the parameters contradict each other.
    fn calculate(&mut self) -> Result<(), Failure>;

    /// Takes the start, stop and tolerance of the simulation. Not called if the importer leaves them out: the
    /// simulation then starts at 0 s, without a stop time or a tolerance.
    fn setup_experiment(&mut self, experiment: Experiment);

    /// Ends Initialization Mode: checks what relates several variables and computes the start state.
    ///
    /// # Errors
    /// When the model cannot start; the message names variables, values and remedy.
    fn initialize(&mut self, log: &mut Log<'_>) -> Result<(), Failure>;

    /// Computes one step. It must be bounded, and should not allocate.
    ///
    /// # Errors
    /// When it cannot be computed. The model is then as it was before the step.
    fn do_step(&mut self, step: Step, log: &mut Log<'_>) -> Result<(), Failure>;

    /// Writes all that is not derived: parameters, inputs and their derivatives, experiment, state.
    fn write_state(&self, writer: &mut StateWriter);

    /// Reads what [`write_state`](Self::write_state) wrote, into a model as instantiated, and computes what
    /// is derived.
    ///
    /// # Errors
    /// When the values are not those of a valid model.
    fn read_state(&mut self, reader: &mut StateReader<'_>) -> Result<(), Failure>;
}

/// Where an instance lives.
#[derive(Clone, Copy, Debug)]
pub struct Environment<'a> {
    /// Name of the instance in the importer; the model identifier if that gave none.
    pub instance_name: &'a str,
    /// The `resources` folder of the unpacked FMU, if the importer told of a usable one.
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

/// One communication step.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Step {
    /// Time at its start \[s\].
    pub from: f64,
    /// Its length \[s\], above 0. It may be too small to change the time.
    pub duration: f64,
}

/// Why a call failed: logged as an error, and returned as `fmi2Error`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Failure(pub String);

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for Failure {}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self(message)
    }
}

impl From<&str> for Failure {
    fn from(message: &str) -> Self {
        Self(message.to_owned())
    }
}
