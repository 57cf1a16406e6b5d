//! `wall building`: storeys and walls as a system of FMUs, an SSP 1.0 archive.
//!
//! Each wall becomes the FMU of its scene, so that its choices travel inside it: importers do not agree on how an enumeration is set
//! from outside. The storeys share `floor.fmu`, and their numbers stand in the system's description.

mod document;
mod ssd;
mod wiring;

use std::path::Path;

use anyhow::{Context, Result, bail};
use fmi2_export::VariableId;
use fmi2_export_build::archive::Archive;
use rocking_wall::scene::Scene;
use rocking_wall::variables::{Mechanism, RealVariable};
use rocking_wall::wall::Wall;

use crate::args::BuildingArguments;
use crate::{output, package};
use document::{Building, Member};

/// Where the storeys' FMU lies in the archive.
const FLOOR_SOURCE: &str = "resources/floor.fmu";

pub(crate) fn run(arguments: &BuildingArguments) -> Result<()> {
    let building = Building::read(&arguments.building)?;
    let folder = arguments.building.parent().unwrap_or(Path::new("."));
    let mut archive = Archive::default();
    let mut scenes = Vec::with_capacity(building.walls.len());
    for wall in &building.walls {
        let path = folder.join(&wall.scene);
        let scene = scene(&path, wall).with_context(|| format!("wall {:?}", wall.name))?;
        let (unit, _) = package::of_scene(&scene, &arguments.wall_fmu)?;
        archive.insert(source(&wall.name), unit.to_bytes()?);
        scenes.push(scene);
    }
    if !building.floors.is_empty() {
        archive.insert(FLOOR_SOURCE, floor_unit(&arguments.floor_fmu)?);
    }
    let system = wiring::system(&building, &scenes)?;
    archive.insert("SystemStructure.ssd", ssd::text(&system));
    archive.write(&arguments.output)?;
    let (units, connections) = (system.components.len(), system.connections.len());
    output::to_stdout(&format!(
        "{}: {}, {units} units, {connections} connections\n",
        arguments.output.display(),
        system.title
    ))
}

/// The scene of a wall, with the inputs that its place in the building moves.
fn scene(path: &Path, wall: &Member) -> Result<Scene> {
    let mut scene = Scene::read(path)?;
    Wall::new(&scene.parameters).with_context(|| path.display().to_string())?;
    let spans = scene.parameters.mechanism == Mechanism::VerticalSpanning;
    if scene.excitation.is_some() {
        bail!("{}: a wall in a building is moved by it; remove [motion] from the scene", path.display());
    }
    match (&wall.top, spans) {
        (None, true) => bail!("a vertical spanning wall leans on something: give `top`"),
        (Some(_), false) => bail!("a parapet has no top support: remove `top`, or choose vertical_spanning"),
        _ => {}
    }
    scene.inputs = vec![RealVariable::ABottom];
    if wall.top.is_some() {
        scene.inputs.push(RealVariable::ATop);
    }
    if wall.drift.is_some() {
        scene.inputs.push(RealVariable::Drift);
    }
    debug_assert!(scene.inputs.iter().all(|input| scene.uses(input.variable().name)));
    Ok(scene)
}

/// The general FMU of storeys.
fn floor_unit(path: &Path) -> Result<Vec<u8>> {
    let archive = Archive::open(path).with_context(
        || "the FMU of storeys is missing or damaged; make it with `cargo xtask fmu`, or name it with --floor-fmu",
    )?;
    let description = archive.get("modelDescription.xml").unwrap_or_default();
    let description = fmi2_export_build::Description::parse(&String::from_utf8_lossy(description))
        .with_context(|| path.display().to_string())?;
    if description.model_identifier() != "floor" {
        let found = description.model_identifier();
        bail!(
            "{}: is the FMU of `{found}`, not of a floor; name the right one with --floor-fmu",
            path.display()
        );
    }
    Ok(archive.to_bytes()?)
}

/// Where a wall's FMU lies in the archive.
fn source(wall: &str) -> String {
    format!("resources/{wall}.fmu")
}
