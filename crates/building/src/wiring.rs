//! Makes components and connections of a building: what moves each member, and what the member loads.

use fmu_export::{Variable, VariableId};
use rocking_floor::variables::RealVariable as FloorVariable;
use rocking_wall::variables::{BooleanVariable, RealVariable as WallVariable};
use scene::Scene;

use crate::document::{Building, Floor, Member, Support};
use crate::error::BuildingError;

type Result<T> = std::result::Result<T, BuildingError>;

/// Inputs of a floor for what stands on it.
const MOST_LOADS: usize = 8;

/// Outputs of each member that are listed even if nothing is connected to them.
const SHOWN_OF_A_FLOOR: [FloorVariable; 3] =
    [FloorVariable::Displacement, FloorVariable::Velocity, FloorVariable::AccelerationAbsolute];
const SHOWN_OF_A_WALL: [WallVariable; 4] =
    [WallVariable::U, WallVariable::UDot, WallVariable::URatio, WallVariable::OverturnTime];

/// A system of FMUs.
#[derive(Clone, Debug)]
pub(crate) struct System {
    /// The ground's acceleration is an input of the system, connected with all that stands on the ground.
    pub(crate) expose_ground: bool,
    /// Name of each FMU, storeys first, with its inputs and outputs that are connected, or worth showing.
    pub(crate) components: Vec<(String, Vec<&'static Variable>)>,
    /// All of them, those from the ground too.
    pub(crate) connections: Vec<Connection>,
}

/// An output of one component to an input of another.
#[derive(Clone, Debug)]
pub(crate) struct Connection {
    /// `None` for the ground.
    pub(crate) from: Option<usize>,
    pub(crate) output: &'static Variable,
    pub(crate) to: usize,
    pub(crate) input: &'static Variable,
}

/// Components, storeys first, and their connections.
pub(crate) fn system(building: &Building, scenes: &[Scene]) -> Result<System> {
    let expose_ground = building.expose_ground;
    let mut system = System { expose_ground, components: Vec::new(), connections: Vec::new() };
    let mut loads = Loads { taken: vec![0; building.floors.len()], floors: &building.floors };
    for (index, floor) in building.floors.iter().enumerate() {
        system.move_by(floor.base, index, FloorVariable::AG.variable());
        if let Some((below, input)) = loads.next(floor.base)? {
            let output = FloorVariable::ReactionBottom.variable();
            system.connections.push(Connection { from: Some(index), output, to: below, input });
        }
    }
    for (index, wall) in building.walls.iter().enumerate() {
        system.place(building.floors.len() + index, wall, &mut loads)?;
    }
    let floors = building.floors.iter().map(|floor| (&floor.name, None));
    let walls = building.walls.iter().zip(scenes).map(|(wall, scene)| (&wall.name, Some(scene)));
    for (index, (name, scene)) in floors.chain(walls).enumerate() {
        let connectors = system.connectors(index, scene);
        system.components.push((name.clone(), connectors));
    }
    Ok(system)
}

/// The next free input of each storey for a reaction.
struct Loads<'a> {
    taken: Vec<usize>,
    floors: &'a [Floor],
}

impl Loads<'_> {
    fn next(&mut self, support: Support) -> Result<Option<(usize, &'static Variable)>> {
        let Support::Floor(index) = support else { return Ok(None) };
        self.taken[index] += 1;
        let name = format!("reaction_{}", self.taken[index]);
        let Some(variable) = FloorVariable::from_name(&name) else {
            let reason =
                format!("more than {MOST_LOADS} storeys and walls stand on it or lean on it; divide it");
            return Err(BuildingError::of_floor(&self.floors[index].name, reason));
        };
        Ok(Some((index, variable.variable())))
    }
}

impl System {
    /// Returns the connections that the SSD lists. Those from the ground are left out unless the ground is an
    /// input of the system.
    pub(crate) fn described(&self) -> impl Iterator<Item = &Connection> {
        // FMPy cannot read an input connector without a connection
        self.connections.iter().filter(|connection| self.expose_ground || connection.from.is_some())
    }

    /// Connects a support's acceleration to an input.
    fn move_by(&mut self, support: Support, to: usize, input: &'static Variable) {
        let (from, output) = match support {
            Support::Ground => (None, FloorVariable::AG),
            Support::Floor(index) => (Some(index), FloorVariable::AccelerationAbsolute),
        };
        self.connections.push(Connection { from, output: output.variable(), to, input });
    }

    /// Connects a wall with its supports.
    fn place(&mut self, index: usize, wall: &Member, loads: &mut Loads<'_>) -> Result<()> {
        use WallVariable::{ABottom, ATop, Drift, ReactionBottom, ReactionTop};
        let ends = [(Some(wall.bottom), ABottom, ReactionBottom), (wall.top, ATop, ReactionTop)];
        for (support, input, reaction) in ends {
            let Some(support) = support else { continue };
            self.move_by(support, index, input.variable());
            if let Some((floor, load)) = loads.next(support)? {
                let (from, output) = (Some(index), reaction.variable());
                self.connections.push(Connection { from, output, to: floor, input: load });
            }
        }
        if let Some(floor) = wall.drift {
            let (output, input) = (FloorVariable::Displacement.variable(), Drift.variable());
            self.connections.push(Connection { from: Some(floor), output, to: index, input });
        }
        Ok(())
    }

    /// Lists the connectors of a component: what is connected, or worth showing. A wall has a scene.
    fn connectors(&self, index: usize, scene: Option<&Scene>) -> Vec<&'static Variable> {
        let inputs = self.described().filter(|connection| connection.to == index);
        let outputs = self.described().filter(|connection| connection.from == Some(index));
        let mut all: Vec<_> = inputs.map(|connection| connection.input).collect();
        all.extend(outputs.map(|connection| connection.output));
        match scene {
            None => all.extend(SHOWN_OF_A_FLOOR.map(VariableId::variable)),
            Some(_) => all.extend(SHOWN_OF_A_WALL.map(VariableId::variable)),
        }
        let mut connectors = Vec::new();
        for variable in all {
            if !connectors.contains(&variable) {
                connectors.push(variable);
            }
        }
        if scene.is_some_and(|scene| scene.uses("overturned")) {
            connectors.push(BooleanVariable::Overturned.variable());
        }
        connectors
    }
}
