//! The contents of a building's units, scenes of walls and values of storeys; and their system as an SSP
//! archive.

use std::path::Path;

use fmu_export::VariableId;
use fmu_export_build::Reduction;
use fmu_export_build::archive::Archive;
use rocking_wall::variables::{Mechanism, RealVariable};
use rocking_wall::wall::Wall;
use scene::Scene;
use scene_fmu::{General, experiment, of_scene_in};

use crate::document::{Building, Floor, Member, Parameter, fmu_path};
use crate::error::BuildingError;
use crate::ssd;
use crate::units::Plan;
use crate::wiring::{System, system};

/// What a building's units hold, and how they are connected.
#[derive(Clone, Debug)]
pub struct Parts {
    /// Scene of each wall, with the inputs that its place moves.
    pub scenes: Vec<Scene>,
    /// Each wall.
    pub walls: Vec<Wall>,
    pub(crate) system: System,
    /// The units for a run in process.
    pub(crate) plan: Plan,
    /// Warnings and remarks for the user.
    pub warnings: Vec<String>,
}

impl Parts {
    /// Reads the scenes of a building's walls and connects its units.
    ///
    /// # Errors
    /// [`BuildingError`] of a scene that cannot be used, or of a storey that carries too much.
    pub fn read(building: &Building) -> Result<Self, BuildingError> {
        let (mut scenes, mut walls, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
        for member in &building.walls {
            let (scene, wall) = scene(building, member, &mut warnings)
                .map_err(|reason| BuildingError::of_wall(&member.name, reason))?;
            scenes.push(scene);
            walls.push(wall);
        }
        let moves = |floor: &&Floor| floor.parameters.iter().any(|given| given.name.ends_with("_start"));
        for floor in building.floors.iter().filter(moves) {
            warnings.push(format!("floor {:?} does not start at rest, as its file says", floor.name));
        }
        let system = system(building, &scenes)?;
        let payloads = building.floors.iter().map(payload);
        let walls_read = scenes.iter().zip(&building.walls).map(|(scene, member)| {
            scene_fmu::payload(scene).map_err(|error| BuildingError::of_wall(&member.name, error))
        });
        let payloads = payloads.map(Ok).chain(walls_read).collect::<Result<_, _>>()?;
        let plan = Plan::new(building.floors.len(), &system, payloads);
        Ok(Self { scenes, walls, system, plan, warnings })
    }

    /// Returns the numbers of units and of connections.
    pub fn counts(&self) -> (usize, usize) {
        (self.system.components.len(), self.system.described().count())
    }

    /// Writes the description of the system, `SystemStructure.ssd` of the SSP, with the communication step
    /// `step` \[s\].
    pub fn description(&self, building: &Building, step: f64) -> String {
        ssd::text(building, &self.system, step)
    }

    /// Makes the SSP of the building from the general FMUs of walls and floors. The system and each unit
    /// state the building's stop time and the communication step `step` \[s\].
    ///
    /// # Errors
    /// [`BuildingError::Part`] where an FMU cannot be used.
    pub fn archive(
        &self,
        building: &Building,
        step: f64,
        wall_fmu: &Path,
        floor_fmu: &Path,
    ) -> Result<Archive, BuildingError> {
        let mut archive = Archive::default();
        for (scene, member) in self.scenes.iter().zip(&building.walls) {
            let general = general(wall_fmu, "--wall-fmu")?;
            let unit = of_scene_in(scene, general, experiment(building.stop_time, step))
                .map_err(|error| BuildingError::of_wall(&member.name, error))?;
            let bytes =
                unit.archive.to_bytes().map_err(|error| BuildingError::of_wall(&member.name, error))?;
            archive.insert(fmu_path(&member.name), bytes);
        }
        for (floor, payload) in building.floors.iter().zip(&self.plan.payloads) {
            let unit = storey(building, step, floor, payload, floor_fmu)?;
            let bytes = unit.to_bytes().map_err(|error| BuildingError::of_floor(&floor.name, error))?;
            archive.insert(fmu_path(&floor.name), bytes);
        }
        archive.insert("SystemStructure.ssd", self.description(building, step));
        Ok(archive)
    }
}

/// The scene of a wall, with the building's stop time and the inputs that its place in the building moves.
fn scene(building: &Building, wall: &Member, warnings: &mut Vec<String>) -> Result<(Scene, Wall), String> {
    let path = wall.scene.display();
    let mut scene = Scene::read(&wall.scene).map_err(|error| error.to_string())?;
    let made = scene_fmu::check(&scene).map_err(|error| format!("{path}: {error}"))?;
    let name = &wall.name;
    warnings.extend(made.warnings().iter().map(|warning| format!("wall {name:?}: {warning}")));
    let start = scene.parameters.u_start;
    warnings.extend(made.start_warning(start).map(|warning| format!("wall {name:?}: {warning}")));
    if start != 0.0 {
        warnings.push(format!("wall {name:?} is released from u_start = {start} m, as its scene says"));
    }
    let spans = scene.parameters.mechanism == Mechanism::VerticalSpanning;
    if scene.excitation.is_some() || scene.floors.is_some() {
        return Err(format!(
            "{path}: the building moves its walls; remove [motion] and [[storeys]] from the scene"
        ));
    }
    match (&wall.top, spans) {
        (None, true) => return Err("a vertical spanning wall has a top support: give `top`".into()),
        (Some(_), false) => {
            return Err("a parapet has no top support: remove `top`, or choose vertical_spanning".into());
        }
        _ => {}
    }
    scene.stop_time = building.stop_time;
    scene.inputs = vec![RealVariable::ABottom];
    if wall.top.is_some() {
        scene.inputs.push(RealVariable::ATop);
    }
    if wall.drift.is_some() {
        scene.inputs.push(RealVariable::Drift);
    }
    debug_assert!(scene.inputs.iter().all(|input| scene.uses(input.variable().name)));
    Ok((scene, made))
}

/// Opens the general FMU at `path`, which the user names with `option`.
fn general(path: &Path, option: &str) -> Result<General, BuildingError> {
    General::open(path).map_err(|error| {
        let reason = format!(
            "expected a general FMU; make it with `cargo xtask fmu`, or name it with {option}: {error}"
        );
        BuildingError::Part { part: path.display().to_string(), reason }
    })
}

/// The values of a storey, as its `resources/floor.toml`.
fn payload(floor: &Floor) -> Vec<u8> {
    let line = |Parameter { name, text, .. }: &Parameter| format!("{name} = {text}\n");
    floor.parameters.iter().map(line).collect::<String>().into_bytes()
}

/// The FMU of a storey, made from the general one.
fn storey(
    building: &Building,
    step: f64,
    floor: &Floor,
    payload: &[u8],
    path: &Path,
) -> Result<Archive, BuildingError> {
    let general = general(path, "--floor-fmu")?;
    let found = general.description.model_identifier();
    if found != "floor" {
        let reason = format!("is the FMU of `{found}`, not of a floor; name the right one with --floor-fmu");
        return Err(BuildingError::Part { part: path.display().to_string(), reason });
    }
    let starts = floor.parameters.iter().map(|given| (given.name.to_owned(), given.start.clone()));
    let reduction = Reduction {
        model_name: &floor.name,
        description: &format!("Storey of: {}", building.title),
        keep: &|_| true,
        starts: &starts.collect::<Vec<_>>(),
        experiment: experiment(building.stop_time, step),
    };
    let unit = general.unit("floor.toml", payload.to_vec(), &reduction);
    let (archive, _) = unit.map_err(|error| BuildingError::of_floor(&floor.name, error))?;
    Ok(archive)
}
