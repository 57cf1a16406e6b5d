//! `wall building`: storeys and walls as a system of FMUs, an SSP 1.0 archive.
//!
//! Each wall becomes the FMU of its scene, and each storey an FMU with its values inside: importers do not
//! agree on how an enumeration is set from outside, and some ignore the parameters of a system.

mod document;
mod ssd;
mod trial;
mod wiring;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use fmu_export::VariableId;
use fmu_export_build::archive::Archive;
use fmu_export_build::{DefaultExperiment, Reduction};
use rocking_wall::scene::Scene;
use rocking_wall::variables::{Mechanism, RealVariable};
use rocking_wall::wall::{Parameters, Wall};
use scene_fmu::of_scene;

use crate::output;
use crate::package::general;
use document::{Building, Floor, Member, Parameter, fmu_path};
use trial::Trial;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The building (TOML): its storeys, and its walls with their scenes
    building: PathBuf,
    /// The SSP to write
    #[arg(short, long, value_name = "FILE", default_value = "fmu_out/building.ssp")]
    output: PathBuf,
    /// The general FMU of walls; `fmu_out/fmi3/wall.fmu` makes FMI 3.0 units
    #[arg(long, value_name = "FILE", default_value = "fmu_out/wall.fmu")]
    wall_fmu: PathBuf,
    /// The FMU of floors; `fmu_out/fmi3/floor.fmu` makes FMI 3.0 units
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
    let (mut scenes, mut walls, mut storeys) = (Vec::new(), Vec::new(), Vec::new());
    let mut warnings = Vec::new();
    for wall in &building.walls {
        let scene = scene(&folder.join(&wall.scene), wall, &mut warnings)
            .with_context(|| format!("wall {:?}", wall.name))?;
        let general = general(&arguments.wall_fmu, "--wall-fmu")?;
        let unit = of_scene(&scene, general).with_context(|| format!("wall {:?}", wall.name))?;
        archive.insert(fmu_path(&wall.name), unit.archive.to_bytes()?);
        scenes.push(scene);
        walls.push(unit.scene);
    }
    output::report_all(warnings);
    for floor in &building.floors {
        let (unit, payload) = storey(&building, floor, &arguments.floor_fmu)?;
        archive.insert(fmu_path(&floor.name), unit.to_bytes()?);
        storeys.push(payload);
    }
    let system = wiring::system(&building, &scenes)?;
    let trial = trial::trial(&building, &system, &[storeys, walls].concat())?;
    archive.insert("SystemStructure.ssd", ssd::text(&system));
    output::to_file(&arguments.output, &archive.to_bytes()?)?;
    let (units, connections) = (system.components.len(), system.connections.len());
    output::to_stdout(&format!(
        "{}: {}, {units} units, {connections} connections\n{}",
        arguments.output.display(),
        system.title,
        advice(&trial, building.step)
    ))
}

/// Says which steps the building needs.
fn advice(trial: &Trial, stated: f64) -> String {
    let milliseconds = |step: f64| format!("{} ms", (1e9 * step).round() / 1e6);
    let found = |step: Option<f64>| {
        step.map_or_else(|| format!("none down to {}", milliseconds(trial.least)), milliseconds)
    };
    let motion = if trial.is_shaken { "under a pulse of the ground" } else { "from its start values" };
    let mut text = format!(
        "step for an error of 1 % of the peak of each u, displacement and acceleration, in a run of {} s\n\
         {motion}, by a master that passes all outputs on at once:\n\
         held inputs    {}\nlinear inputs  {}\n",
        trial.duration,
        found(trial.held),
        found(trial.linear)
    );
    if trial.held.is_none_or(|held| stated > held) {
        // writing to a String cannot fail
        let _ = writeln!(text, "the file states {}, which is too long for held inputs", milliseconds(stated));
    }
    text
}

/// The scene of a wall, with the inputs that its place in the building moves.
fn scene(path: &Path, wall: &Member, warnings: &mut Vec<String>) -> Result<Scene> {
    let mut scene = Scene::read(path)?;
    let made = Wall::new(&scene.parameters).with_context(|| path.display().to_string())?;
    let name = &wall.name;
    warnings.extend(made.warnings().iter().map(|warning| format!("warning: wall {name:?}: {warning}")));
    if scene.parameters.u_start != 0.0 {
        let start = scene.parameters.u_start;
        warnings
            .push(format!("warning: wall {name:?} is released from u_start = {start} m, as its scene says"));
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

/// The FMU of a storey and its `resources/floor.toml`, made from the general one.
fn storey(building: &Building, floor: &Floor, path: &Path) -> Result<(Archive, String)> {
    let mut general = general(path, "--floor-fmu")?;
    if general.description.model_identifier() != "floor" {
        let found = general.description.model_identifier();
        bail!(
            "{}: is the FMU of `{found}`, not of a floor; name the right one with --floor-fmu",
            path.display()
        );
    }
    let mut payload = String::new();
    for Parameter { name, text, .. } in &floor.parameters {
        let _ = writeln!(payload, "{name} = {text}");
    }
    let starts: Vec<_> = floor
        .parameters
        .iter()
        .map(|parameter| (parameter.name.to_owned(), parameter.start.clone()))
        .collect();
    let reduced = general.description.reduced(&Reduction {
        model_name: &floor.name,
        description: &format!("Storey of: {}", building.title),
        guid: &general.guid_with(&payload),
        keep: &|_| true,
        starts: &starts,
        experiment: DefaultExperiment {
            start: 0.0,
            stop: building.stop_time,
            step: building.step,
            tolerance: Parameters::default().tolerance,
        },
    })?;
    general.describe(&reduced)?;
    let mut archive = general.archive;
    archive.insert("resources/floor.toml", payload.as_str());
    Ok((archive, payload))
}
