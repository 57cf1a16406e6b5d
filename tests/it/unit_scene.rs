//! Tests what an FMU of a scene carries: every scene comes back bit by bit, and broken bytes are refused.

use std::path::PathBuf;

use fmu_export::{Interface, Log};
use ground_motion::GroundMotion;
use rocking_wall::simulation::Excitation;
use rocking_wall::unit::UnitScene;
use rocking_wall::wall::{Kinematics, Parameters};
use scene::Scene;

use crate::of_payload;

/// The scenes of the repository.
fn scenes() -> Vec<(PathBuf, UnitScene)> {
    let folder = crate::root().join("scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    let read = |path: PathBuf| {
        let scene = Scene::read(&path).ok()?;
        let motion = scene.support_motion().unwrap().map(std::borrow::Cow::into_owned);
        Some((path, UnitScene { parameters: scene.parameters, motion }))
    };
    files.filter_map(read).collect()
}

#[test]
fn every_scene_comes_back_bit_by_bit() {
    let scenes = scenes();
    assert!(scenes.len() >= 8, "{} scenes", scenes.len());
    assert!(scenes.iter().any(|(_, scene)| scene.parameters.multilinear.is_some()), "no law of points");
    assert!(scenes.iter().any(|(_, scene)| scene.motion.is_some()), "no motion");
    for (path, mut scene) in scenes {
        // the unit has the numbers that the bar has given to the tie
        scene.parameters.bar = None;
        assert_eq!(UnitScene::read(&scene.bytes()).unwrap(), scene, "{}", path.display());
        drop(of_payload(Interface::CoSimulation, Some(&scene.bytes()), &mut Log::silent()));
    }
}

#[test]
fn full_rotations_are_carried() {
    let parameters = Parameters { kinematics: Kinematics::Trigonometric, ..Parameters::default() };
    let scene = UnitScene { parameters, motion: None };
    assert_eq!(UnitScene::read(&scene.bytes()).unwrap(), scene);
}

#[test]
fn each_support_keeps_its_motion() {
    let [bottom, top, drift] = [0.01, 0.02, 0.005].map(|step| {
        let samples = (0..50).map(|k| (f64::from(k) * step).sin() / 3.0).collect();
        GroundMotion::new(step, samples).unwrap()
    });
    let motion = Excitation::new(bottom, Some(top)).with_drift(drift);
    let scene = UnitScene { motion: Some(motion), ..UnitScene::default() };
    assert_eq!(UnitScene::read(&scene.bytes()).unwrap(), scene);
}

#[test]
fn broken_bytes_are_refused() {
    let bytes = UnitScene::default().bytes();
    for length in 0..bytes.len() {
        assert!(UnitScene::read(&bytes[..length]).is_err(), "{length} of {} bytes", bytes.len());
    }
    let longer = [&bytes[..], &[0]].concat();
    let message = |bytes: &[u8]| UnitScene::read(bytes).unwrap_err().to_string();
    assert!(message(&longer).contains("1 bytes more"), "{}", message(&longer));
    // the version is the last letter of the first text
    let other = [&bytes[..8], b"rocking-wall scene 4", &bytes[28..]].concat();
    let words = "\"rocking-wall scene 4\" where \"rocking-wall scene 3\" is expected: package the FMU again";
    assert!(message(&other).contains(words), "{}", message(&other));
}
