//! The tests of the wall, its solver and its unit.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::path::Path;

use fmu_export::{Environment, Interface, Log, Model};
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::unit::{Unit, UnitScene};
use rocking_wall::variables::DampingModel;
use rocking_wall::wall::{Parameters, Support, Wall};
use scene::Scene;

mod bars;
mod bodies;
mod broken;
mod broken_bodies;
mod broken_scenes;
mod capacity;
mod cases;
#[path = "../../crates/ground-motion/tests/it/chain.rs"]
mod chain;
mod closed_forms;
mod configuration;
mod couple;
mod curve;
mod demands;
mod departing_ties;
mod description;
mod distant_outputs;
mod edited_states;
mod extreme_parameters;
mod floor_motion;
mod full_bodies;
mod full_equation;
mod levels;
mod model_exchange;
mod newton_euler;
mod numerics;
mod one_sided;
mod overturning;
mod page;
mod peaks;
mod properties;
mod record_path;
mod refusals;
mod return_mapping;
mod runge_kutta;
mod sequences;
mod several_ties;
mod ties;
mod trigonometric;
mod unit;
mod unit_scene;
mod warnings;
mod yielding;
mod yielding_records;
mod yielding_unit;

/// Returns the root of the workspace.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns the damping models whose damping is not constant on each branch.
fn secant_models() -> impl Iterator<Item = DampingModel> {
    let is_secant = |damping_model: &DampingModel| {
        let parameters = Parameters { damping_model: *damping_model, ..Parameters::default() };
        !Wall::new(&parameters).expect("a valid wall").has_constant_damping()
    };
    DampingModel::ALL.iter().copied().filter(is_secant)
}

/// Returns a wall at its start, between supports that do not move.
fn start(parameters: &Parameters) -> Simulation {
    Simulation::new(parameters, None, 0.0, Support::default()).expect("a valid wall")
}

/// Returns a segment in which the supports do not move.
fn still(duration: f64) -> Segment {
    Segment { duration, from: Support::default(), to: Support::default() }
}

/// Returns a unit as an importer instantiates it, with the scene inside its FMU if there is one.
fn instantiated(interface: Interface, scene: Option<&str>, log: &mut Log<'_>) -> Unit {
    let bytes = scene.map(|text| {
        let scene = Scene::parse("scene", text, Path::new(".")).unwrap();
        let motion = scene.support_motion().unwrap().map(std::borrow::Cow::into_owned);
        UnitScene { parameters: scene.parameters, motion }.bytes()
    });
    of_payload(interface, bytes.as_deref(), log)
}

/// A unit of what its FMU has in `resources/`.
fn of_payload(interface: Interface, payload: Option<&[u8]>, log: &mut Log<'_>) -> Unit {
    Unit::instantiate(Environment { interface, instance_name: "wall", resources: None, payload }, log)
        .unwrap()
}
