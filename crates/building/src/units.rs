//! The units of a building, as a master holds them, and their connections.

use fmu_export::{Environment, Experiment, Interface, Log, Model, Step, VariableId};
use rocking_floor::unit::Unit as FloorUnit;
use rocking_wall::unit::Unit as WallUnit;

use crate::wiring::{Connection, System};

/// The result of a unit: its message, if it fails.
type Result<T, E = String> = std::result::Result<T, E>;

/// A unit in the importer's hands, its variables by reference.
pub(crate) trait Unit {
    fn get(&self, reference: u32) -> f64;
    fn rate(&self, reference: u32) -> f64;
    fn set(&mut self, reference: u32, value: f64, rate: Option<f64>);
    fn start(&mut self) -> Result<()>;
    fn step(&mut self, step: Step) -> Result<()>;
    /// Returns ∂output/∂input within the unit.
    fn derivative(&self, output: u32, input: u32) -> f64;
}

impl<M: Model> Unit for M {
    fn get(&self, reference: u32) -> f64 {
        M::Real::from_reference(reference).map_or(f64::NAN, |variable| self.real(variable))
    }

    fn rate(&self, reference: u32) -> f64 {
        M::Real::from_reference(reference).and_then(|id| self.output_derivative(id)).unwrap_or(0.0)
    }

    fn set(&mut self, reference: u32, value: f64, rate: Option<f64>) {
        if let Some(variable) = M::Real::from_reference(reference) {
            self.set_real(variable, value);
            self.set_input_derivative(variable, rate.unwrap_or(0.0));
        }
    }

    fn start(&mut self) -> Result<()> {
        self.setup_experiment(Experiment::default());
        self.initialize(&mut Log::silent()).map_err(|failure| failure.to_string())
    }

    fn step(&mut self, step: Step) -> Result<()> {
        self.do_step(step, &mut Log::silent()).map(drop).map_err(|failure| failure.to_string())
    }

    fn derivative(&self, output: u32, input: u32) -> f64 {
        let pair = M::Real::from_reference(output).zip(M::Real::from_reference(input));
        pair.and_then(|(output, input)| self.directional_derivative(output, input)).unwrap_or(0.0)
    }
}

/// Makes a unit of what its FMU contains.
pub(crate) fn unit<M: Model>(payload: &[u8]) -> Result<Box<dyn Unit>> {
    let environment = Environment {
        interface: Interface::CoSimulation,
        instance_name: M::IDENTIFIER,
        resources: None,
        payload: Some(payload),
    };
    let unit = M::instantiate(environment, &mut Log::silent()).map_err(|failure| failure.to_string())?;
    Ok(Box::new(unit))
}

/// A building that can be run again and again: the contents of its units, and their connections by reference.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// Contents of the units, storeys first: what their FMUs hold in `resources/`.
    pub(crate) payloads: Vec<Vec<u8>>,
    /// Number of storeys.
    pub(crate) floors: usize,
    /// From a unit and its output to a unit and its input.
    pub(crate) connections: Vec<[(usize, u32); 2]>,
    /// Inputs that the ground moves.
    pub(crate) ground: Vec<(usize, u32)>,
}

impl Plan {
    /// Makes the plan of a building from its system and the contents of its units, storeys first.
    pub(crate) fn new(floors: usize, system: &System, payloads: Vec<Vec<u8>>) -> Self {
        let (mut connections, mut ground) = (Vec::new(), Vec::new());
        for Connection { from, output, to, input } in &system.connections {
            let input = (*to, input.reference);
            match from {
                Some(from) => connections.push([(*from, output.reference), input]),
                None => ground.push(input),
            }
        }
        Self { payloads, floors, connections, ground }
    }

    /// Makes the units and ends their initialisation.
    pub(crate) fn start(&self) -> Result<Vec<Box<dyn Unit>>> {
        let make = |(index, payload): (usize, &Vec<u8>)| {
            if index < self.floors { unit::<FloorUnit>(payload) } else { unit::<WallUnit>(payload) }
        };
        let mut units: Vec<_> = self.payloads.iter().enumerate().map(make).collect::<Result<_>>()?;
        for unit in &mut units {
            unit.start()?;
        }
        Ok(units)
    }
}

/// Returns a unit and the reference of its variable.
pub(crate) fn at(unit: usize, variable: impl VariableId) -> (usize, u32) {
    (unit, variable.variable().reference)
}
