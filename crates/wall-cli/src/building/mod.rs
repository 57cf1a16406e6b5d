//! `wall building`: storeys and walls as a system of FMUs, an SSP 1.0 archive.
//!
//! Each wall becomes the FMU of its scene, which contains its choices: importers do not agree on how an
//! enumeration is set from outside. The storeys share `floor.fmu`; the system's description holds their
//! numbers.

mod document;
mod ssd;
mod wiring;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use fmi2_export::VariableId;
use fmi2_export_build::archive::Archive;
use rocking_wall::scene::Scene;
use rocking_wall::variables::{Mechanism, RealVariable};
use rocking_wall::wall::Wall;

use crate::{output, package};
use document::{Building, FLOOR_SOURCE, Member, fmu_path};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The building (TOML): its storeys, and its walls with their scenes
    building: PathBuf,
    /// The SSP to write
    #[arg(short, long, value_name = "FILE", default_value = "fmu_out/building.ssp")]
    output: PathBuf,
    /// The general FMU of walls
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    wall_fmu: PathBuf,
    /// The FMU of floors
    #[arg(long, value_name = "FILE", default_value = "fmu_out/floor.fmu")]
    floor_fmu: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let building = Building::read(&arguments.building)?;
    let folder = arguments.building.parent().unwrap_or(Path::new("."));
    let scenes: Vec<_> = building.walls.iter().map(|wall| folder.join(&wall.scene)).collect();
    let inputs = [&arguments.building, &arguments.wall_fmu, &arguments.floor_fmu];
    output::check_distinct(inputs.into_iter().chain(&scenes), [&arguments.output])?;
    let mut archive = Archive::default();
    let mut scenes = Vec::with_capacity(building.walls.len());
    for wall in &building.walls {
        let path = folder.join(&wall.scene);
        let scene = scene(&path, wall).with_context(|| format!("wall {:?}", wall.name))?;
        let (unit, _) = package::of_scene(&scene, &arguments.wall_fmu, "--wall-fmu")?;
        archive.insert(fmu_path(&wall.name), unit.to_bytes()?);
        scenes.push(scene);
    }
    if !building.floors.is_empty() {
        archive.insert(FLOOR_SOURCE, floor_unit(&arguments.floor_fmu)?);
    }
    let system = wiring::system(&building, &scenes)?;
    archive.insert("SystemStructure.ssd", ssd::text(&system));
    output::to_file(&arguments.output, &archive.to_bytes()?)?;
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
    let made = Wall::new(&scene.parameters).with_context(|| path.display().to_string())?;
    for warning in made.warnings() {
        output::warn(&format!("wall {:?}: {warning}", wall.name));
    }
    if scene.parameters.u_start != 0.0 {
        let start = scene.parameters.u_start;
        output::warn(&format!(
            "wall {:?} is released from u_start = {start} m, as its scene says",
            wall.name
        ));
    }
    let spans = scene.parameters.mechanism == Mechanism::VerticalSpanning;
    if scene.excitation.is_some() {
        bail!("{}: the building moves its walls; remove [motion] from the scene", path.display());
    }
    match (&wall.top, spans) {
        (None, true) => bail!("a vertical spanning wall has a top support: give `top`"),
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
    let archive = Archive::open(path).with_context(|| {
        "the FMU of storeys is missing or damaged; make it with `cargo xtask fmu`, or name it with \
            --floor-fmu"
    })?;
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
