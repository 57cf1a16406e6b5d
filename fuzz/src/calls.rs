//! Calls the functions of FMI 2.0 and 3.0 in random order, with arguments that make sense and some that do
//! not: several instances of each unit, moved between threads.
//!
//! ```text
//! calls [COUNT] [SEED]
//! ```
//!
//! A fault ends it with exit code 1: a panic, a status or value that may not be, memory that is not freed,
//! and, unless assertions slow it down, a call that takes over a second.

use fmu_export::ModelExchange;
use rocking_wall_fuzz::driver::{Figures, Instance};
use scene::Scene;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

const INSTANCES: usize = 8;
const THREADS: usize = 4;
/// Calls of an instance before it moves to another thread.
const BURST: u64 = 500;
/// A scene with its own motion.
const SCENE: &str = "[force_law]\nforce_law = \"trilinear\"\n[motion]\nsynthetic = {}\n";

fn main() -> ExitCode {
    let number = |index, default| std::env::args().nth(index).map_or(Some(default), |text| text.parse().ok());
    let (Some(count), Some(seed)) = (number(1, 1_000_000), number(2, 1)) else {
        eprintln!("usage: calls [COUNT] [SEED]");
        return ExitCode::from(2);
    };
    let folder = std::env::temp_dir().join(format!("rocking-wall-calls-{}", std::process::id()));
    let guid = match write_scene(&folder) {
        Ok(guid) => guid,
        Err(error) => {
            eprintln!("{}: the scene cannot be written: {error}", folder.display());
            return ExitCode::FAILURE;
        }
    };
    let resources = folder.display().to_string();
    let mut sound = drive::<rocking_wall::unit::Unit>("wall", None, count, seed);
    sound &= drive::<rocking_wall::unit::Unit>("scene", Some((&guid, &resources)), count, seed + 1);
    sound &= drive::<rocking_floor::unit::Unit>("floor", None, count, seed + 2);
    let removed = std::fs::remove_dir_all(&folder);
    if sound && removed.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Writes the resources of a scene's FMU into a folder, and returns its guid.
fn write_scene(folder: &Path) -> Result<String, Box<dyn Error>> {
    let payload = scene_fmu::payload(&Scene::parse("scene.toml", SCENE, folder)?)?;
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("scene.bin"), &payload)?;
    Ok(rocking_wall::variables::GUID.replace('}', &format!("-{}}}", scene::fingerprint(&payload))))
}

/// Makes `count` calls of one unit, and prints what came of them. Returns whether all were sound.
fn drive<M: ModelExchange>(name: &str, scene: Option<(&str, &str)>, count: u64, seed: u64) -> bool {
    let seeds = (0..INSTANCES as u64).map(|index| seed * 1000 + index);
    let mut instances: Vec<_> = seeds.map(|seed| Instance::<M>::new(scene, seed)).collect();
    for _ in 0..(count / (BURST * INSTANCES as u64)).max(1) {
        std::thread::scope(|scope| {
            for mine in instances.chunks_mut(INSTANCES / THREADS) {
                scope.spawn(|| mine.iter_mut().for_each(|instance| instance.call(BURST)));
            }
        });
        instances.rotate_left(1);
    }
    let figures = instances.into_iter().map(Instance::end).fold(Figures::default(), Figures::and);
    println!("{name}: {figures}");
    figures.is_sound()
}
