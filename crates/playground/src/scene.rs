//! From a request to a scene, and to its text.

use std::fmt::Write;
use std::sync::Arc;

use ground_motion::{GroundMotion, GroundMotionError, Pulse, Shape, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Profile, Wall};
use scene::{DEFAULT_TAIL, Scene, read_shape, to_toml};

use crate::check_table;
use crate::request::{Faults, Fields, Inputs, fault_of};
use crate::upload::Upload;

/// Most points of a history: more than a screen shows.
const MOST_POINTS: f64 = 4000.0;

/// A scene, its wall, and the text of its scene file.
#[derive(Debug)]
pub(crate) struct Prepared {
    pub(crate) scene: Scene,
    pub(crate) wall: Wall,
    pub(crate) toml: String,
}

/// Prepares the scene that the inputs describe.
pub(crate) fn prepare(inputs: &Inputs, upload: &mut Upload) -> Result<Prepared, Faults> {
    let (mut scene, motion) = shaken(&inputs.motion, upload)?;
    if !inputs.parts.trim().is_empty() {
        scene.parameters.set_profile(profile(&inputs.parts)?);
    }
    let mut faults = Faults::new();
    for (name, text) in &inputs.parameters {
        if let Err(error) = scene.set(name, text) {
            faults.insert(name.clone(), error.to_string());
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    let wall = Wall::new(&scene.parameters).map_err(|error| {
        let field = error.keys().into_iter().find(|key| inputs.parameters.contains_key(*key));
        fault_of(field.unwrap_or("wall"), error.to_string())
    })?;
    // a multiple of the step of the motion
    scene.output_step *= (scene.stop_time / (MOST_POINTS * scene.output_step)).ceil().max(1.0);
    scene.title = title(&scene);
    let toml = to_toml(&scene, &motion) + &check_table::table(&inputs.check);
    Ok(Prepared { scene, wall, toml })
}

/// Reads the parts of a wall with their openings and loads.
fn profile(text: &str) -> Result<Profile, Faults> {
    let fault = |message| fault_of("parts", message);
    let wall = read_shape("parts", text).map_err(|error| fault(error.to_string()))?;
    let profile = wall.profile.map(Arc::unwrap_or_clone);
    profile.ok_or_else(|| fault("a wall needs a table [[geometry.part]]".to_owned()))
}

fn title(scene: &Scene) -> String {
    if scene.parameters.profile.is_some() {
        return format!("A wall of parts, {} m high", scene.parameters.height);
    }
    let kind = match scene.parameters.mechanism {
        Mechanism::Parapet => "parapet",
        Mechanism::RigidBody => "rigid body",
        Mechanism::VerticalSpanning => "strip wall",
    };
    format!("A {kind}, {} m × {} m", scene.parameters.height, scene.parameters.thickness)
}

/// The default wall under the motion of a request, and the text of its `[motion]` table.
fn shaken(motion: &Fields, upload: &mut Upload) -> Result<(Scene, String), Faults> {
    let kind = motion.get("kind").map_or("none", String::as_str);
    if kind == "none" {
        return Ok((Scene::default(), String::new()));
    }
    if kind == "record" {
        return recorded(motion, upload);
    }
    let (made, text) = if kind == "synthetic" { synthetic(motion) } else { pulse(kind, motion) }?;
    let made = made.map_err(|error| {
        let field = error.key().filter(|key| motion.contains_key(*key)).unwrap_or("motion").to_owned();
        fault_of(field, error.to_string())
    })?;
    let mut scene = Scene::default();
    scene.shake(Excitation::new(made, None), DEFAULT_TAIL, Vec::new());
    Ok((scene, text))
}

/// The default wall under the record file, times its scale.
fn recorded(motion: &Fields, upload: &mut Upload) -> Result<(Scene, String), Faults> {
    let scale = number(motion, "scale")?;
    let record = upload.record(motion)?;
    let scaled = record.motion.checked_scaled(scale).map_err(|error| fault_of("scale", error.to_string()))?;
    let mut notes = vec![format!("record {} ({})", motion["record"], record.format.description())];
    notes.extend(record.check().warnings.iter().map(ToString::to_string));
    let mut scene = Scene::default();
    scene.shake(Excitation::new(scaled, None), DEFAULT_TAIL, notes);
    let mut text = String::new();
    for key in ["record", "unit", "column", "channel", "format"] {
        if let Some(value) = motion.get(key).filter(|value| !value.trim().is_empty()) {
            // a string of JSON is one of TOML
            let _ = writeln!(text, "{key} = {}", serde_json::Value::from(value.trim()));
        }
    }
    if motion.get("step").is_some_and(|step| !step.trim().is_empty()) {
        let _ = writeln!(text, "step = {:?}", number(motion, "step")?);
    }
    let _ = writeln!(text, "fingerprint = \"{}\"\nscale = {scale:?}", upload.fingerprint());
    Ok((scene, text))
}

/// A motion that is made from numbers, or what is wrong with them, and the text of its `[motion]` table.
type Made = Result<(Result<GroundMotion, GroundMotionError>, String), Faults>;

fn synthetic(motion: &Fields) -> Made {
    let seed = motion.get("seed").map_or("", |seed| seed.trim());
    let Ok(number_of) = seed.parse::<u32>() else {
        return Err(fault_of(
            "seed",
            format!("seed = {seed:?} is not a whole number from 0 to {}", u32::MAX),
        ));
    };
    let (pga, default) = (number(motion, "pga")?, SyntheticMotion::default());
    let made = SyntheticMotion { seed: number_of.into(), ..default }.motion();
    let text = format!("synthetic = {{ seed = {seed} }}\npga = {pga:?}\n");
    Ok((made.and_then(|made| made.scaled_to_peak(pga)), text))
}

fn pulse(kind: &str, motion: &Fields) -> Made {
    let value = |key| number(motion, key);
    let (shape, own) = match kind {
        "ricker" => {
            let centre = value("centre")?;
            (Shape::Ricker { centre }, format!(", centre = {centre:?}"))
        }
        "harmonic" => {
            let duration = value("duration")?;
            let shape = Shape::Harmonic { phase: 0.0, end: Some(duration) };
            (shape, format!(", duration = {duration:?}"))
        }
        "sine_cycle" => (Shape::SineCycle, String::new()),
        "half_sine" => (Shape::HalfSine, String::new()),
        other => return Err(fault_of("motion", format!("there is no motion {other:?}"))),
    };
    let (amplitude, frequency) = (value("amplitude")?, value("frequency")?);
    let text = format!("{kind} = {{ amplitude = {amplitude:?}, frequency = {frequency:?}{own} }}\n");
    Ok((Pulse { shape, amplitude, frequency }.motion(None), text))
}

/// A number of the motion.
fn number(motion: &Fields, key: &str) -> Result<f64, Faults> {
    let text = motion.get(key).map_or("", |text| text.trim());
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(fault_of(key, format!("{key} = {text:?} is not a number"))),
    }
}
