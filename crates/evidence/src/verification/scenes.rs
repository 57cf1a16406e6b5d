//! Formulas that the variables of a wall show.

use std::collections::BTreeMap;
use std::path::Path;

use ground_motion::{GroundMotion, GroundMotionError};
use rocking_wall::simulation::{Excitation, Simulation, segment_of};
use rocking_wall::wall::{Branch, Support};
use scene::response::{COLUMNS, Sample};
use scene::{Scene, SceneError, variable};
use serde::Deserialize;

use crate::{Comparison, EvidenceError};

/// Motion of the supports, straight between samples.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Samples {
    step: f64,
    bottom: Vec<f64>,
    top: Option<Vec<f64>>,
    drift: Option<Vec<f64>>,
}

impl Samples {
    fn excitation(&self) -> Result<Excitation, GroundMotionError> {
        let motion = |samples: &Vec<f64>| GroundMotion::new(self.step, samples.clone());
        let excitation = Excitation::new(motion(&self.bottom)?, self.top.as_ref().map(motion).transpose()?);
        Ok(match &self.drift {
            Some(drift) => excitation.with_drift(motion(drift)?),
            None => excitation,
        })
    }
}

/// A variable of the model description at a time of a scene \[s\], by rising times; its reference, what the
/// error is relative to, and the largest error over it.
struct Reference {
    name: &'static str,
    time: f64,
    value: f64,
    scale: f64,
    bound: f64,
}

/// The references of a scene.
fn references(scene: &str) -> impl Iterator<Item = Reference> {
    let lines = include_str!("references.csv").lines().filter_map(move |line| line.strip_prefix(scene));
    lines.filter_map(|line| line.strip_prefix(',')).map(|line| {
        let (name, numbers) = line.split_once(',').unwrap_or_default();
        let numbers: Vec<f64> = numbers.split(',').filter_map(|field| field.parse().ok()).collect();
        let [time, value, scale, bound] = numbers[..] else { panic!("references.csv: {line}") };
        Reference { name, time, value, scale, bound }
    })
}

/// Compares the variables of scenes with their references.
pub(super) fn compare(
    scenes: &BTreeMap<String, String>,
    motion: Option<&Samples>,
) -> Result<Vec<Comparison>, EvidenceError> {
    let mut comparisons = Vec::new();
    for (name, text) in scenes {
        let mut scene = Scene::parse(name, text, Path::new("."))?;
        if let Some(samples) = motion {
            scene.excitation = Some(samples.excitation()?);
        }
        let motion = scene.support_motion()?;
        let motion = motion.as_deref();
        let support = |time: f64| segment_of(motion, time, 0.0).from;
        let mut simulation = Simulation::new(&scene.parameters, None, 0.0, support(0.0))?;
        for Reference { name: quantity, time, value, scale, bound } in references(name) {
            simulation.advance_to(time, motion, None).map_err(SceneError::from)?;
            let at = if time == 0.0 { String::new() } else { format!(" at {time:.3} s") };
            let unit = variable(quantity).map_or(Some("J"), |known| known.unit);
            let unit = unit.filter(|unit| *unit != "1").unwrap_or("-");
            let computed = computed(&simulation, support(time), quantity);
            let what = format!("{quantity}{at}");
            let compared = Comparison::new(name, what, unit, [computed, value], bound);
            comparisons.push(Comparison { scale, ..compared });
        }
    }
    Ok(comparisons)
}

/// Returns a variable of the model description, or a fact of the wall, by its name.
fn computed(simulation: &Simulation, support: Support, name: &str) -> f64 {
    let outputs = simulation.outputs(support);
    if let Some((.., value)) = COLUMNS.iter().find(|(column, ..)| *column == name) {
        return value(&Sample { time: simulation.progress().time, support, outputs });
    }
    match name {
        "tie_break_time" => simulation.progress().tie_break_time().unwrap_or(-1.0),
        "energy" => energy(simulation, outputs.tie_force),
        "overturn_time" => simulation.progress().overturn_time.unwrap_or(-1.0),
        _ => {
            let facts = simulation.wall().facts();
            facts.iter().find(|fact| fact.name == name).map_or(f64::NAN, |fact| fact.value)
        }
    }
}

/// Returns the energy of a wall with its tie on u > 0, of which it has what has been lost \[J\].
fn energy(simulation: &Simulation, tie_force: f64) -> f64 {
    let (wall, state) = (simulation.wall(), simulation.progress().state);
    let part = |branch: &Branch| {
        let (from, to) = (branch.lower.max(0.0), branch.upper.min(state.displacement).max(0.0));
        if from < to { 0.5 * (branch.own.at(from) + branch.own.at(to)) * (to - from) } else { 0.0 }
    };
    let own = 0.5 * state.velocity.powi(2) + wall.branches().iter().map(part).sum::<f64>();
    let in_tie = wall.ties().first().map_or(0.0, |tie| {
        let (strength, stored) =
            (tie.strength.unwrap_or_default(), |force: f64| force * force / tie.stiffness / 2.0);
        let lost = if tie.is_broken(1.0, &state.tie) { stored(strength) } else { 0.0 };
        stored(tie_force) + lost + strength * simulation.outputs(Support::default()).tie_elongation.positive
    });
    wall.body().effective_mass * own + in_tie
}
