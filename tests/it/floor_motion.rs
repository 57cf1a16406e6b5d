//! Tests walls on floors that move as if there were no wall: `[[storeys]]`, `--floor`, `--records`.

use std::fmt::Write;
use std::fs;

use fmu_export::{Environment, Interface, Log, Model as _, Step};
use ground_motion::{GroundMotion, Storey, Storeys, SyntheticMotion};
use rocking_wall::choices::Mechanism;
use rocking_wall::response::Response;
use rocking_wall::scene::{Floors, Scene, StoreyTable, SupportsTable};
use rocking_wall::simulation::Excitation;
use rocking_wall::unit::Unit;
use rocking_wall::variables::RealVariable;
use study::document::StudyFile;
use study::ida::Study;

use crate::command_line::{folder, refused, text, wall};

const STOREYS: [(f64, f64); 3] = [(2.0e4, 4.0e7), (2.0e4, 3.0e7), (1.5e4, 2.0e7)];
const TAIL: f64 = 4.0;

fn ground() -> GroundMotion {
    SyntheticMotion { duration: 10.0, ..SyntheticMotion::default() }.motion().unwrap()
}

fn storeys(damping_ratio: f64, periods: &[(f64, f64)]) -> Vec<Storey> {
    periods.iter().map(|&(mass, stiffness)| Storey { mass, stiffness, damping_ratio }).collect()
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
fn rounded(count: f64) -> usize {
    count.round() as usize
}

/// Absolute accelerations and displacements of the floors at a small step, by the classical Runge-Kutta
/// method on the chain itself. Dashpots lie between the storeys.
fn integrated(
    storeys: &[Storey],
    dashpots: &[f64],
    ground: &GroundMotion,
    parts: usize,
) -> Vec<Vec<[f64; 2]>> {
    let n = storeys.len();
    let step = ground.step() / parts as f64;
    let forces = |x: &[f64], v: &[f64]| -> Vec<f64> {
        let spring = |i: usize| {
            let (below, rate) = if i == 0 { (0.0, 0.0) } else { (x[i - 1], v[i - 1]) };
            storeys[i].stiffness * (x[i] - below) + dashpots[i] * (v[i] - rate)
        };
        (0..n).map(|i| (if i + 1 < n { spring(i + 1) } else { 0.0 } - spring(i)) / storeys[i].mass).collect()
    };
    let samples = ground.samples();
    let at = |interval: usize, fraction: f64| match samples.get(interval..interval + 2) {
        Some(ends) => ends[0] + fraction * (ends[1] - ends[0]),
        None => 0.0,
    };
    let (mut x, mut v) = (vec![0.0; n], vec![0.0; n]);
    let mut floors = vec![Vec::new(); n];
    let intervals = rounded((ground.duration() + TAIL) / ground.step());
    for interval in 0..intervals {
        for part in 0..parts {
            let absolute = forces(&x, &v);
            for i in 0..n {
                floors[i].push([absolute[i], x[i]]);
            }
            let rates = |x: &[f64], v: &[f64], offset: f64| {
                let a = at(interval, (part as f64 + offset) / parts as f64);
                let relative: Vec<_> = forces(x, v).into_iter().map(|force| force - a).collect();
                (v.to_vec(), relative)
            };
            let moved = |(dx, dv): &(Vec<f64>, Vec<f64>), h: f64| {
                let moved = |from: &[f64], by: &[f64]| from.iter().zip(by).map(|(a, b)| a + h * b).collect();
                (moved(&x, dx), moved(&v, dv))
            };
            let k1 = rates(&x, &v, 0.0);
            let (x2, v2): (Vec<_>, Vec<_>) = moved(&k1, 0.5 * step);
            let k2 = rates(&x2, &v2, 0.5);
            let (x3, v3): (Vec<_>, Vec<_>) = moved(&k2, 0.5 * step);
            let k3 = rates(&x3, &v3, 0.5);
            let (x4, v4): (Vec<_>, Vec<_>) = moved(&k3, step);
            let k4 = rates(&x4, &v4, 1.0);
            for i in 0..n {
                x[i] += step / 6.0 * (k1.0[i] + 2.0 * k2.0[i] + 2.0 * k3.0[i] + k4.0[i]);
                v[i] += step / 6.0 * (k1.1[i] + 2.0 * k2.1[i] + 2.0 * k3.1[i] + k4.1[i]);
            }
        }
    }
    floors
}

/// The nodes differ from the motion itself by (Δt²/12) a″, up to 2e-4 of the peak at the largest phase.
#[test]
fn modes_agree_with_the_chain_itself() {
    let ground = ground();
    let chain = storeys(0.0, &STOREYS);
    let single = storeys(0.05, &STOREYS[..1]);
    let dashpot = 2.0 * 0.05 * (single[0].mass * single[0].stiffness).sqrt();
    for (chain, dashpots) in [(chain, vec![0.0; 3]), (single, vec![dashpot])] {
        let modes = Storeys::new(&chain).unwrap();
        let every = 16;
        let own = modes.floor(&ground, 1.0, 1).unwrap().acceleration.step();
        let parts = every * rounded(ground.step() / own);
        let expected = integrated(&chain, &dashpots, &ground, parts);
        for (index, floor) in expected.iter().enumerate() {
            let found = modes.floor(&ground, ground.duration() + TAIL, index + 1).unwrap();
            for (quantity, nodes) in
                [found.acceleration.samples(), &found.displacement].into_iter().enumerate()
            {
                let peak = floor.iter().fold(0.0_f64, |peak, values| peak.max(values[quantity].abs()));
                let pairs = nodes.iter().zip(floor.iter().step_by(every));
                let apart = pairs.map(|(node, values)| (node - values[quantity]).abs()).fold(0.0, f64::max);
                assert!(apart <= 3e-4 * peak, "floor {index}, quantity {quantity}: {:.1e}", apart / peak);
            }
        }
    }
    let ratios = Storeys::new(&storeys(0.07, &STOREYS)).unwrap().damping_ratios();
    assert!(ratios.iter().all(|ratio| (ratio - 0.07).abs() < 1e-12), "{ratios:?}");
}

const PARAPET: &str = "
[geometry]
height = 1.2
thickness = 0.3
[force_law]
a1 = 0.05
[damping]
damping_model = \"constant_coefficient\"
xi = 0.05
";

const STRIP: &str = "
[geometry]
mechanism = \"vertical_spanning\"
height = 3.0
thickness = 0.2
hinge_ratio = 0.6
overburden = 5000.0
[force_law]
a1 = 0.05
[damping]
damping_model = \"constant_coefficient\"
xi = 0.05
";

/// A wall, its supports, and storeys without damping under the synthetic motion.
fn scene(shape: &str, supports: &str, damping_ratio: f64) -> String {
    let mut text = format!("{shape}[supports]\n{supports}\n");
    for (mass, stiffness) in STOREYS {
        // writing to a String cannot fail
        let _ = write!(text, "[[storeys]]\nmass = {mass:?}\nstiffness = {stiffness:?}\n");
        let _ = writeln!(text, "damping_ratio = {damping_ratio}");
    }
    text + &format!("[motion]\nsynthetic = {{ duration = 10.0 }}\nscale = 0.4\ntail = {TAIL}\n")
}

/// The wall's response to the resampled floor is that to the floor itself, to 1e-6 of its peak. The reference
/// takes 80 samples of the floor for one of the record, corrected by their second differences.
#[test]
fn the_response_on_a_floor_is_right_to_1e_6() {
    let parts = 80;
    let record = ground().scaled(0.4);
    let floors = integrated(&storeys(0.0, &STOREYS), &[0.0; 3], &record, parts);
    let step = record.step() / parts as f64;
    // a − (Δt²/12) a″
    let corrected = |floor: usize, quantity: usize| {
        let value = |index: usize| floors[floor - 1][index][quantity];
        let last = floors[floor - 1].len() - 1;
        let inner = |index: usize| {
            let around = index.clamp(1, last - 1);
            value(index) - (value(around - 1) - 2.0 * value(around) + value(around + 1)) / 12.0
        };
        (0..=last).map(inner).collect::<Vec<f64>>()
    };
    for (shape, supports) in [(PARAPET, "bottom = 3"), (STRIP, "bottom = 2"), (STRIP, "top = 1")] {
        let scene = Scene::parse("scene", &scene(shape, supports, 0.0), ".".as_ref()).unwrap();
        let own = Response::of(&scene).unwrap();
        assert!(own.summary.u_ratio_max > 0.05 && !own.summary.overturned, "{supports}: {:?}", own.summary);
        let motion = |samples| GroundMotion::new(step, samples).unwrap();
        let strip = scene.parameters.mechanism == Mechanism::VerticalSpanning;
        let excitation = match supports {
            "top = 1" => Excitation::new(record.clone(), Some(motion(corrected(1, 0))))
                .with_drift(motion(corrected(1, 1))),
            _ if strip => {
                let (below, above) = (corrected(2, 1), corrected(3, 1));
                let drift = above.iter().zip(below).map(|(above, below)| above - below).collect();
                Excitation::new(motion(corrected(2, 0)), Some(motion(corrected(3, 0))))
                    .with_drift(motion(drift))
            }
            _ => Excitation::new(motion(corrected(3, 0)), None),
        };
        let reference = Scene { floors: None, excitation: Some(excitation), ..scene };
        let reference = Response::of(&reference).unwrap();
        let pairs = own.samples.iter().zip(&reference.samples);
        let apart = pairs.map(|(a, b)| (a.outputs.displacement - b.outputs.displacement).abs());
        let apart = apart.fold(0.0, f64::max) / reference.summary.u_max;
        assert!(apart < 1e-6, "{supports}: {apart:.1e}");
    }
}

/// The unit plays the floor of its scene, whatever the step.
#[test]
fn the_unit_of_a_scene_stands_on_its_floor() {
    let text = scene(STRIP, "bottom = 2\ndrift = true", 0.05);
    let response = Response::of(&Scene::parse("scene", &text, ".".as_ref()).unwrap()).unwrap();
    let environment = Environment {
        interface: Interface::CoSimulation,
        instance_name: "strip",
        resources: None,
        payload: Some(text.as_bytes()),
    };
    let mut unit = Unit::instantiate(environment, &mut Log::silent()).unwrap();
    unit.initialize(&mut Log::silent()).unwrap();
    for step in 0..100 {
        let step = Step { from: 0.1 * f64::from(step), duration: 0.1, may_end_early: false };
        unit.do_step(step, &mut Log::silent()).unwrap();
    }
    let found = unit.real(RealVariable::U);
    let expected = response.samples.iter().find(|sample| (sample.time - 10.0).abs() < 1e-9).unwrap();
    let peak = response.summary.u_max;
    assert!((found - expected.outputs.displacement).abs() < 1e-9 * peak, "{found:e}");
}

#[test]
fn a_scene_with_storeys_is_written_and_read_back() {
    let text = scene(STRIP, "bottom = 1\ntop = 2\ndrift = false", 0.03);
    let first = Scene::parse("scene", &text, ".".as_ref()).unwrap();
    let written = rocking_wall::scene::to_toml(&first, "synthetic = { duration = 10.0 }\n");
    let again = Scene::parse("again", &written, ".".as_ref()).unwrap();
    assert_eq!(first.floors, again.floors);
}

/// A study scales the ground: its intensities stay those of the ground, and a level gives the demand of the
/// scaled record on the floor.
#[test]
fn a_study_shakes_the_ground_below_the_storeys() {
    let text = |storeys: &str| {
        format!(
            "models = [{{ model = \"CDC\", xi = 0.05 }}]\n\
             records = {{ synthetic = {{ count = 1, duration = 10 }} }}\n\
             levels = {{ method = \"grid\", values = [0.04] }}\n\
             intensity = {{ measure = \"PGA\" }}\ntail = {TAIL}\n{storeys}[[walls]]\nname = \"a\"\n\
             geometry = {{ height = 1.2, thickness = 0.3 }}\nforce_law = {{ a1 = 0.05 }}\n"
        )
    };
    let mut storeys = String::from("supports = { bottom = 3 }\n");
    for (mass, stiffness) in STOREYS {
        let _ = writeln!(storeys, "[[storeys]]\nmass = {mass:?}\nstiffness = {stiffness:?}");
    }
    let folder = folder("study_on_storeys");
    let run = |name: &str, text: String| {
        StudyFile::parse(name, &text).unwrap();
        fs::write(folder.join(name), text).unwrap();
        let study: Study = study::loaded::LoadedStudy::read(&folder.join(name)).unwrap().study;
        let curves = study.run(1).unwrap();
        (study.intensity(0), curves[0].runs()[0].demand)
    };
    let (on_ground, ground_demand) = run("ground.toml", text(""));
    let (on_roof, demand) = run("roof.toml", text(&storeys));
    assert_eq!(on_ground, on_roof);
    assert!(demand > 2.0 * ground_demand, "{demand} {ground_demand}");
    let scene = scene(PARAPET, "bottom = 3", 0.05);
    let mut scene = Scene::parse("scene", &scene, ".".as_ref()).unwrap();
    let ground = scene.excitation.take().unwrap().bottom().scaled_to_peak(0.04 * 9.80665).unwrap();
    scene.shake(Excitation::new(ground, None), TAIL, Vec::new());
    let response = Response::of(&scene).unwrap();
    assert!((response.summary.u_ratio_max / demand - 1.0).abs() < 1e-9, "{demand}");
}

#[test]
fn supports_that_do_not_exist_are_refused() {
    let floors =
        |supports| Floors::new(&[StoreyTable { period: Some(0.3), ..StoreyTable::default() }], supports);
    let roof = SupportsTable { bottom: Some(1), ..SupportsTable::default() };
    let floors_of = floors(roof).unwrap();
    assert_eq!(floors_of.supports(Mechanism::Parapet).unwrap(), (1, None));
    assert!(floors_of.supports(Mechanism::VerticalSpanning).is_err(), "a strip on the roof");
    let below = floors(SupportsTable::default()).unwrap();
    assert_eq!(below.supports(Mechanism::VerticalSpanning).unwrap(), (0, Some(1)));
    let folder = folder("floors");
    let storey = "[[storeys]]\nmass = 1e4\nstiffness = 1e6\n";
    let cases: [(String, &[&str]); 7] = [
        ("[supports]\nbottom = 1\n".into(), &["line 1", "[[storeys]]"]),
        (format!("{storey}period = 1.0\n"), &["line 1", "either a stiffness"]),
        (format!("{storey}[[storeys]]\nperiod = 0.2\n"), &["line 4", "mass"]),
        (format!("{storey}[supports]\nbottom = 2\n"), &["line 4", "no floor 2", "1 to 1"]),
        (format!("{storey}damping_ratio = 1.5\n"), &["damping ratio", "1.5"]),
        (storey.into(), &["[motion]", "--record"]),
        (format!("{storey}[supports]\ntop = 1\n[motion]\nsynthetic = {{}}\n"), &["parapet", "top"]),
    ];
    for (text, words) in cases {
        fs::write(folder.join("s.toml"), &text).unwrap();
        refused(&folder, &["simulate", "s.toml"], words);
    }
    let output = wall(&folder, &["simulate", "--synthetic", "--floor", "xi=0.3"]);
    assert!(output.status.code() == Some(2) && text(&output.stderr).contains("a period"));
    refused(&folder, &["simulate", "--synthetic", "--floor", "T=0.3", "--hold"], &["--hold"]);
    let heavy = ["simulate", "--synthetic", "--floor", "T=0.3,xi=0.05,mass=1e4"];
    let output = wall(&folder, &heavy);
    assert!(text(&output.stderr).contains("wall building"), "{}", text(&output.stderr));
    let light = wall(&folder, &["simulate", "--synthetic", "--floor", "T=0.3,xi=0.05,mass=1e6"]);
    assert!(light.status.success() && light.stderr.is_empty());
    assert!(text(&light.stdout).contains("felt on a floor, T = 0.300 s"), "{}", text(&light.stdout));
}

/// A wall with a loaded edge rocks differently under both signs of a record, and a table holds what single
/// runs give.
#[test]
fn many_records_make_a_table() {
    let folder = folder("many_records");
    fs::create_dir(folder.join("records")).unwrap();
    for seed in 0..4 {
        let motion = SyntheticMotion { seed, duration: 10.0, ..SyntheticMotion::default() }.motion().unwrap();
        let rows = motion.samples().iter().enumerate();
        let rows: Vec<_> = rows.map(|(k, a)| format!("{},{a:?}\n", k as f64 * motion.step())).collect();
        fs::write(folder.join(format!("records/{seed}.csv")), format!("time,a_g\n{}", rows.concat()))
            .unwrap();
    }
    let run = |more: &[&str]| {
        let mut arguments = vec!["simulate", "--set", "thickness=0.25", "--unit", "m/s2"];
        arguments.extend(["--set", "overburden=2000", "--set", "overburden_eccentricity=0.05"]);
        arguments.extend(more);
        let output = wall(&folder, &arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let files = ["records/0.csv", "records/1.csv", "records/2.csv", "records/3.csv"];
    let mut arguments = vec!["--records"];
    arguments.extend(files);
    let table = run(&[&arguments[..], &["--both-polarities", "--csv", "table.csv"]].concat());
    assert_eq!(table.lines().count(), 1 + 1 + 8 + 1 + 1, "{table}");
    let csv = fs::read_to_string(folder.join("table.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    for (pair, file) in rows.chunks(2).zip(files) {
        assert_eq!((pair[0][1], pair[1][1]), ("+1", "-1"));
        assert_ne!(pair[0][3..], pair[1][3..], "{file}");
        let single: serde_json::Value = serde_json::from_str(&run(&["--record", file, "--json"])).unwrap();
        let (u, ratio): (f64, f64) = (pair[0][3].parse().unwrap(), pair[0][4].parse().unwrap());
        assert!((single["u_max"].as_f64().unwrap() / u - 1.0).abs() < 1e-9);
        assert!((single["u_ratio_max"].as_f64().unwrap() / ratio - 1.0).abs() < 1e-9);
    }
    let json = run(&[&arguments[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["runs"].as_array().unwrap().len(), 4);
    let html = [&["simulate"], &arguments[..], &["--unit", "m/s2", "--html", "a.html"]].concat();
    refused(&folder, &html, &["--html", "--record"]);
}

/// The picture moves by itself: no script, nothing from elsewhere, small enough for a README.
#[test]
fn the_animated_picture_of_a_wall_is_one_small_file() {
    let folder = folder("animated");
    let strip = ["--set", "mechanism=vertical_spanning", "--set", "thickness=0.2"];
    let cases = [(&[][..], "falls at 12.6 s"), (&["--pga", "2.5"], "stands: 33 %"), (&strip, "falls")];
    for (settings, said) in cases {
        let svg = [&["simulate", "--synthetic", "--svg", "wall.svg"], settings].concat();
        assert!(wall(&folder, &svg).status.success());
        let svg = fs::read_to_string(folder.join("wall.svg")).unwrap();
        assert!(svg.contains(said) && svg.contains("<animateTransform"), "{said}");
        assert!(svg.len() < 40_000 && !svg.contains("<script") && !svg.contains("NaN"), "{}", svg.len());
    }
    let still = ["simulate", "--synthetic", "--scale", "1e-4", "--svg", "still.svg"];
    refused(&folder, &still, &["--svg", "hardly moves"]);
}
