//! Tests runs of buildings: floors against their modes, walls against the cascade. The system
//! integrated as one and the SSP in FMPy are in tests/python/test_building.py.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::doc_markdown, reason = "formulas keep their letters")]

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use building::{Building, Coupled, Parts, Settings, table};
use ground_motion::{GroundMotion, Storey, Storeys, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use scene::response::Response;
use scene::{Floors, Scene, StoreyTable, SupportsTable};

#[path = "../../../../tests/it/broken.rs"]
mod broken;
mod description;

const STOREYS: [(f64, f64); 3] = [(2.0e4, 4.0e7), (2.0e4, 3.0e7), (1.5e4, 2.0e7)];

/// Makes a folder for the files of a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn ground(scale: f64) -> GroundMotion {
    let motion = SyntheticMotion { duration: 10.0, ..SyntheticMotion::default() };
    motion.motion().unwrap().scaled(scale)
}

fn parapet(width: f64) -> String {
    format!(
        "inputs = [\"a_bottom\"]\n[geometry]\nheight = 1.2\nthickness = 0.3\nwidth = {width:?}\n\
         [force_law]\na1 = 0.05\n[damping]\ndamping_model = \"constant_coefficient\"\n\
         xi = 0.05\n"
    )
}

/// Writes a building and returns its path.
fn written(folder: &Path, storeys: &[(f64, f64)], damping_ratio: f64, walls: &[(&str, &str)]) -> PathBuf {
    let mut building = String::from("title = \"a test\"\n");
    let mut below = "ground".to_owned();
    for (index, (mass, stiffness)) in storeys.iter().enumerate() {
        let name = format!("floor_{}", index + 1);
        // writing to a String cannot fail
        let _ = write!(building, "[[floor]]\nname = \"{name}\"\non = \"{below}\"\nmass = {mass:?}\n");
        let _ = write!(building, "stiffness = {stiffness:?}\ndamping_ratio = {damping_ratio:?}\n");
        below = name;
    }
    for (name, keys) in walls {
        let _ = write!(building, "[[wall]]\nname = \"{name}\"\nscene = \"{name}.toml\"\n{keys}\n");
    }
    let path = folder.join("b.toml");
    fs::write(&path, building).unwrap();
    path
}

fn read(path: &Path) -> (Building, Parts) {
    let building = Building::read(path).unwrap();
    let parts = Parts::read(&building).unwrap();
    (building, parts)
}

fn run(path: &Path, ground: &GroundMotion, end: f64, tolerance: f64) -> Coupled {
    let (_, parts) = read(path);
    Coupled::run(&parts, ground, Settings { end, tolerance }).unwrap()
}

/// Without walls, peaks are those of the modes, to 1e-3 of the floor's.
#[test]
fn floors_without_walls_move_by_their_modes() {
    let path = written(&folder("building_modes"), &STOREYS, 0.0, &[]);
    let (ground, end) = (ground(1.0), 12.0);
    let coupled = run(&path, &ground, end, 2e-4);
    let storeys = STOREYS.map(|(mass, stiffness)| Storey { mass, stiffness, damping_ratio: 0.0 });
    let modes = Storeys::new(&storeys).unwrap();
    for (index, floor) in coupled.floors.iter().enumerate() {
        let own = modes.floor(&ground, end, index + 1).unwrap().acceleration;
        let found = floor.acceleration.peak.value.abs();
        let wanted = own.peak();
        assert!((found - wanted).abs() <= 1e-3 * wanted, "floor {index}: {found} instead of {wanted}");
        let parts = coupled.times.iter().zip(&floor.acceleration.values);
        let apart = parts.map(|(time, value)| (own.at(*time) - value).abs()).fold(0.0, f64::max);
        assert!(apart <= 1e-3 * wanted, "floor {index}: {:.1e}", apart / wanted);
    }
}

/// The peak of the floor differs from that without a wall (the cascade) by at most C times the mass ratio.
///
/// A wall on its elastic branch or rocking pushes the floor by |R| = m |a + ü| with
/// ü = −¾ a − (C u̇ + F)/m_eff. So |R| <= m (A/4 + ¾ g b/h + c V) for a peak A of the floor and V of u̇,
/// with c = C/m_eff. The acceleration of a floor under a force R is R/M − (2ξω ẋ + ω² x), at most
/// (1 + ∫|ω e^{−ξωt} sin ωt| dt + …) R/M. The integral is below 2/(πξ) + 1, and the damping adds 2ξ times
/// as much.
#[test]
fn a_light_wall_changes_its_floor_by_the_mass_ratio() {
    let folder = folder("building_cascade");
    let (mass, stiffness, ratio) = (2.0e5, 2.0e5 * 400.0, 0.05);
    let (ground, end) = (ground(0.3), 14.0);
    let storey = StoreyTable {
        mass: Some(mass),
        stiffness: Some(stiffness),
        damping_ratio: Some(ratio),
        ..StoreyTable::default()
    };
    let floors = Floors::new(&[storey], SupportsTable::default()).unwrap();
    let cascade = floors.storeys().floor(&ground, end, 1).unwrap().acceleration;
    let (mut differences, mut shares) = (Vec::new(), Vec::new());
    for width in [4.0, 2.0, 1.0] {
        fs::write(folder.join("p.toml"), parapet(width)).unwrap();
        let path = written(&folder, &[(mass, stiffness)], ratio, &[("p", "bottom = \"floor_1\"")]);
        let coupled = run(&path, &ground, end, 1e-4);
        let mut scene = Scene::read(&folder.join("p.toml")).unwrap();
        scene.floors = Some(floors.clone());
        scene.shake(Excitation::new(ground.clone(), None), end - ground.duration(), Vec::new());
        let alone = Response::of(&scene).unwrap();
        assert!(!alone.summary.overturned && alone.summary.u_ratio_max > 0.05, "{:?}", alone.summary);
        let wall = rocking_wall::wall::Wall::new(&scene.parameters).unwrap();
        let mass_ratio = wall.body().mass / mass;
        let peak = cascade.peak();
        let difference = (coupled.floors[0].acceleration.peak.value.abs() - peak).abs();
        let damping = 2.0 * 0.05 * wall.omega1();
        let fastest = alone.samples.iter().fold(0.0_f64, |most, s| most.max(s.outputs.velocity.abs()));
        let push = peak / 4.0 + 0.75 * 9.81 * 0.3 / 1.2 + damping * fastest;
        let gain = 1.0 + (1.0 + 2.0 * ratio) * (2.0 / (std::f64::consts::PI * ratio) + 1.0);
        assert!(difference <= gain * push * mass_ratio, "{difference} of {}", gain * push * mass_ratio);
        differences.push(difference);
        // the wall's own relative change is at most that of its floor; it is in fact a twentieth of it
        let share = (coupled.walls[0].largest / alone.summary.u_max - 1.0).abs();
        assert!(share <= difference / peak, "{share} of {}", difference / peak);
        shares.push(share);
    }
    // half the mass gives half the difference: 0.49 to 0.5
    for pair in differences.windows(2).chain(shares.windows(2)) {
        let halved = pair[1] / pair[0];
        assert!((0.45..0.55).contains(&halved), "{differences:?} {shares:?}");
    }
}

/// A floor feels hinge and tie of its wall, also where the tie yields and breaks: M a + k x + R_b = 0 at each
/// communication point, to the 1e-10 at which the loop counts as closed, and ten roundings of M a.
#[test]
fn a_tie_that_yields_reacts_on_its_floor() {
    const BROKEN: &str = "where the tie breaks: it starts broken";
    let folder = folder("building_tied");
    let (mass, stiffness) = (2.0e4, 2.0e4 * 400.0);
    // u at which the ties yield: N_y/K over 2y/h
    let yields = 300.0 / 2e5 / 2.0;
    let mut peaks = Vec::new();
    for (ultimate, least) in [(-1.0, 0.0), (10.0, yields), (2e-3, yields + 1e-3)] {
        let tie = "tie_height = 1.2\ntie_stiffness = 2e5\ntie_strength = 300.0\ntie_side = \"both\"";
        let scene = format!("{}[tie]\n{tie}\ntie_ultimate = {ultimate:?}\n", parapet(2.0));
        fs::write(folder.join("p.toml"), scene).unwrap();
        let path = written(&folder, &[(mass, stiffness)], 0.0, &[("p", "bottom = \"floor_1\"")]);
        let coupled = run(&path, &ground(0.3), 10.0, 1e-3);
        let (floor, wall) = (&coupled.floors[0], &coupled.walls[0]);
        assert!(wall.largest > least && wall.overturn_time.is_none(), "{} of {least}", wall.largest);
        let largest = [mass * floor.acceleration.peak.value, wall.reaction_bottom.peak.value].map(f64::abs);
        let allowed = 1e-10 * largest[1] + 10.0 * f64::EPSILON * largest[0];
        let histories = floor.acceleration.values.iter().zip(&floor.drift.values);
        for ((acceleration, drift), reaction) in histories.zip(&wall.reaction_bottom.values) {
            let sum = mass * acceleration + stiffness * drift + reaction;
            assert!(sum.abs() <= allowed, "{sum:e} of {allowed:e}");
        }
        peaks.push(wall.largest);
        // p = 2y/h (u - u_y), to a rounding, up to p_u
        let longer = (2.0 * (wall.largest - yields)).clamp(0.0, f64::max(ultimate, 0.0));
        assert!((wall.tie_elongation - longer).abs() < 1e-15, "{} {longer}", wall.tie_elongation);
        assert_eq!(wall.tie_break_time.is_some(), ultimate == 2e-3);
        let (building, parts) = read(&path);
        let text = table::walls(&building, &parts, &coupled).text();
        let told = ["tie longer by", "broke at", "yielded"].map(|words| text.contains(words));
        assert_eq!(told, [ultimate >= 0.0, ultimate == 2e-3, ultimate == 10.0], "{text}");
        assert!(!parts.warnings.iter().any(|warning| warning.contains(BROKEN)), "{:?}", parts.warnings);
    }
    assert!(peaks[0] < peaks[1].min(peaks[2]), "an elastic tie holds the wall best: {peaks:?}");
    // pulled beyond the fracture by hand
    let tie = "tie_height = 1.2\ntie_stiffness = 2e5\ntie_strength = 300.0\ntie_ultimate = 2e-3";
    let scene = format!("{}[tie]\n{tie}\n[start]\nu_start = 0.01\n", parapet(2.0));
    fs::write(folder.join("p.toml"), scene).unwrap();
    let path = written(&folder, &[(mass, stiffness)], 0.0, &[("p", "bottom = \"floor_1\"")]);
    let (_, parts) = read(&path);
    assert!(parts.warnings.iter().any(|warning| warning.contains(BROKEN)), "{:?}", parts.warnings);
}

/// Every line of a building, broken in every way: no message speaks in words of the reader.
#[test]
fn broken_files_are_refused_in_plain_words() {
    let text = "title = \"a\"\nstop_time = 10.0\nstep = 0.01\nexpose_ground = false\n[[floor]]\n\
                name = \"one\"\n\
                on = \"ground\"\nmass = 2e4\nstiffness = 4e7\nhysteresis = \"none\"\n[[wall]]\nname = \"p\"\n\
                scene = \"p.toml\"\nbottom = \"ground\"\ntop = \"one\"\ndrift = true\n";
    let read = |text: &str| Building::parse(Path::new("b.toml"), text);
    broken::walk(text, read);
    let error = read(&text.replace("drift = true", "drift = \"yes\"")).unwrap_err().to_string();
    assert_eq!(error, "b.toml, line 16: drift = \"yes\": expected true or false");
    let error = read(&text.replace("mass = 2e4", "mass = 20,5")).unwrap_err().to_string();
    assert!(error.starts_with("b.toml, line 8: cannot read `mass = 20,5`: "), "{error}");
    let named = |name: &str| read(&text.replace("\"p\"", &format!("{name:?}")));
    // Ground.fmu is the file of no other
    assert_eq!(named("Ground").unwrap().walls[0].name, "Ground");
    for (name, words) in [
        ("1p", "a letter first"),
        ("ground", "\"ground\" stands for the ground"),
        ("ONE", "\"one\" is taken"),
        (&"p".repeat(101), "101 characters are too many; use at most 100"),
    ] {
        let told = named(name).unwrap_err().to_string();
        let start = format!("b.toml, line 12: name = {name:?}: ");
        assert!(told.starts_with(&start) && told.contains(words), "{told}");
    }
}
