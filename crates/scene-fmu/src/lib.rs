#![doc = include_str!("../README.md")]
//!
//! The guid ends in the scene's fingerprint, so that the library refuses to run without it.

mod error;
mod general;
mod page;

use std::borrow::Cow;

use fmu_export_build::archive::Archive;
use fmu_export_build::{DefaultExperiment, Reduction};
use ground_motion::GroundMotion;
use rocking_wall::simulation::Simulation;
use rocking_wall::unit::UnitScene;
use rocking_wall::wall::{Parameters, Support, Wall};
use scene::{self, GROUPS, Scene};

pub use error::SceneFmuError;
pub use general::General;

/// Least communication steps of a scene's default experiment; FMPy records at most 1000 samples.
const STEPS: f64 = 1000.0;

/// The FMU of a scene.
#[derive(Clone, Debug)]
pub struct SceneFmu {
    /// Its files.
    pub archive: Archive,
    /// The scene's parameters as a text, its `documentation/scene.toml`.
    pub scene: String,
    /// Number of its variables.
    pub variables: usize,
    /// Number of the variables of the general FMU.
    pub general_variables: usize,
}

/// Makes the FMU of a scene from the general one. The step of its default experiment is at most that of the
/// scene's own motion.
///
/// # Errors
/// [`SceneFmuError`] of a strip wall in full rotations or of a scene without a wall, or where the description
/// cannot be reduced.
pub fn of_scene(scene: &Scene, general: General) -> Result<SceneFmu, SceneFmuError> {
    let motions = scene.excitation.iter().flat_map(|motion| [Some(motion.bottom()), motion.top()]);
    let step = motions.flatten().map(GroundMotion::step).fold(scene.stop_time / STEPS, f64::min);
    of_scene_in(scene, general, experiment(scene.stop_time, step))
}

/// Returns the default experiment of a unit that runs from 0 to `stop` in steps of `step` \[s\].
pub fn experiment(stop: f64, step: f64) -> DefaultExperiment {
    DefaultExperiment { start: 0.0, stop, step, tolerance: Parameters::default().tolerance }
}

/// Makes the FMU of a scene from the general one, with a default experiment that is not the scene's own.
///
/// # Errors
/// As [`of_scene`].
pub fn of_scene_in(
    scene: &Scene,
    general: General,
    experiment: DefaultExperiment,
) -> Result<SceneFmu, SceneFmuError> {
    let payload = payload(scene)?;
    let mut text = scene::to_toml(scene, "");
    text.extend(scene.motion_notes.iter().flat_map(|note| ["# ", note, "\n"]));
    let numbers = GROUPS.iter().flat_map(|(_, names)| names.iter()).filter(|name| scene.uses(name));
    let starts: Vec<_> = numbers
        .filter_map(|name| Some(((*name).to_owned(), scene::parameter_text(&scene.parameters, name)?)))
        .collect();
    let reduction = Reduction {
        model_name: &scene.title,
        description: &format!("Rocking wall, one scene: {}", scene.title),
        keep: &|name| scene.uses(name),
        starts: &starts,
        experiment,
    };
    let general_variables = general.description.variable_names().count();
    let (mut archive, reduced) = general.unit("scene.bin", payload, &reduction)?;
    archive.insert("documentation/scene.toml", text.clone());
    let variables = reduced.variable_names().count();
    Ok(SceneFmu { archive, scene: text, variables, general_variables })
}

/// Checks that a scene can have an FMU, and returns its wall.
///
/// # Errors
/// [`SceneFmuError::StripInFullRotations`], [`SceneFmuError::Parameters`].
pub fn check(scene: &Scene) -> Result<Wall, SceneFmuError> {
    let wall = Simulation::new(&scene.parameters, None, 0.0, Support::default())?.wall().clone();
    if wall.rotations().is_some() && wall.body().is_strip() {
        return Err(SceneFmuError::StripInFullRotations);
    }
    Ok(wall)
}

/// Returns what the library reads of a scene: its `resources/scene.bin`.
///
/// # Errors
/// Those of [`check`]; [`SceneFmuError::Motion`] where the supports cannot move as the scene says.
pub fn payload(scene: &Scene) -> Result<Vec<u8>, SceneFmuError> {
    check(scene)?;
    let motion = scene.support_motion()?.map(Cow::into_owned);
    Ok(UnitScene { parameters: scene.parameters.clone(), motion }.bytes())
}
