//! Scenes: read or refused, and what is read can start.
#![no_main]

use libfuzzer_sys::fuzz_target;
use rocking_wall::simulation::Simulation;
use rocking_wall::wall::Support;
use scene::{Scene, to_toml};
use std::path::Path;

fuzz_target!(|text: &str| {
    let Ok(scene) = Scene::parse("scene.toml", text, Path::new("nowhere")) else { return };
    let _ = Simulation::new(&scene.parameters, None, 0.0, Support::default());
    let _ = to_toml(&scene, "");
});
