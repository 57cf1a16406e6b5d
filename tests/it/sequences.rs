//! Sequences of records: the wall goes on from one shock to the next, and each has its demands.

use std::path::PathBuf;

use fmu_export::{Interface, Log, Model as _, Step, VariableId as _};
use ground_motion::{GroundMotion, SyntheticMotion};
use rocking_wall::simulation::Excitation;
use rocking_wall::unit::UnitScene;
use rocking_wall::variables::RealVariable as V;
use scene::Scene;
use scene::response::Response;

use crate::of_payload;
use crate::yielding_unit::scene as tied;

/// Samples of filtered noise, at rest at both ends \[m/s²\].
fn noise(seed: u64, step: f64, peak: f64) -> Vec<f64> {
    let motion = SyntheticMotion { seed, step, duration: 10.0, peak }.motion().unwrap();
    [&[0.0], motion.samples(), &[0.0; 3]].concat()
}

fn motion(step: f64, samples: &[f64]) -> GroundMotion {
    GroundMotion::new(step, samples.to_vec()).unwrap()
}

fn run(wall: &str, motion: GroundMotion, output_step: Option<f64>) -> Response {
    let mut scene = Scene::parse("scene.toml", wall, &PathBuf::new()).unwrap();
    scene.shake(Excitation::new(motion, None), 5.0, Vec::new());
    scene.output_step = output_step.map_or(scene.output_step, |step| step.min(scene.stop_time));
    Response::of(&scene).unwrap()
}

/// Walls of every kind of solver and of memory.
fn walls() -> [String; 6] {
    [
        "geometry = { height = 3.0, thickness = 0.3 }".into(),
        "[geometry]\nheight = 3.0\nthickness = 0.3\n[damping]\ndamping_model = \"constant_ratio\"\nxi = 0.05"
            .into(),
        "[geometry]\nmechanism = \"vertical_spanning\"\nheight = 3.0\nthickness = 0.2".into(),
        "[geometry]\nheight = 3.0\nthickness = 0.3\nkinematics = \"trigonometric\"\n\
         [force_law]\nforce_law = \"rigid_linear\"\n[damping]\ndamping_model = \"none\"\n\
         [impact]\nimpact = \"restitution\"\nrestitution = 0.9"
            .into(),
        tied(0.05, 0.0, 0.0),
        tied(1.0, 0.0, 0.0),
    ]
}

/// A record that is cut in two where it rests is the same run, bit for bit, at any step of the output.
#[test]
fn a_record_cut_in_two_is_the_whole_record() {
    let (first, second) = (noise(1, 0.01, 2.5), noise(2, 0.01, 2.5));
    let whole = motion(0.01, &[&first[..], &[0.0; 199], &second].concat());
    let cut = GroundMotion::sequence(&[motion(0.01, &first), motion(0.01, &second)], 2.0).unwrap();
    assert_eq!(cut.samples(), whole.samples());
    assert_eq!(cut.shocks().len(), 2);
    let mut standing = 0;
    for wall in walls() {
        let [one, two] = [&whole, &cut].map(|motion| run(&wall, motion.clone(), Some(1e3)));
        assert_eq!((one.samples, one.demands), (two.samples, two.demands));
        let [one, two] = [&whole, &cut].map(|motion| run(&wall, motion.clone(), None));
        assert_eq!(one.samples, two.samples, "{wall}");
        assert_eq!((one.residual, one.demands), (two.residual, two.demands.clone()), "{wall}");
        assert_eq!((one.shocks.len(), two.shocks.len()), (0, 2));
        assert_eq!(two.shocks[1].start, two.shocks[0].end);
        if two.summary.overturned {
            continue;
        }
        standing += 1;
        // the turning point is found twice
        let larger = two.shocks.iter().map(|shock| shock.u_max).fold(0.0, f64::max);
        assert!((larger - two.summary.u_max).abs() < 1e-12, "{wall}: {larger}");
    }
    assert!(standing >= 4, "{standing} of 6 stand");
}

/// The demands of a shock are those of the second record from the state that the first one left.
#[test]
fn a_tie_begins_the_second_shock_as_the_first_left_it() {
    let (first, second) = (noise(3, 0.01, 4.0), noise(4, 0.01, 4.0));
    let both = GroundMotion::sequence(&[motion(0.01, &first), motion(0.01, &second)], 6.0).unwrap();
    let wall = tied(1.0, 0.0, 0.0);
    let response = run(&wall, both, None);
    let elongation = |shock: usize| {
        let demands = &response.shocks[shock].demands;
        demands.ties[0].yielding.unwrap().elongation.positive
    };
    // the same first shock by itself, with the pause after it
    let alone = run(&wall, motion(0.01, &[&first[..], &[0.0; 100]].concat()), None);
    let after_first = alone.demands.ties[0].yielding.unwrap().elongation.positive;
    // a run of shocks takes other steps than the output, which round otherwise
    let alike = (elongation(0) - after_first).abs() < 1e-12;
    assert!(after_first > 1e-3 && alike, "{after_first} {}", elongation(0));
    assert!(elongation(1) >= elongation(0));
    let at_start = response.samples.partition_point(|sample| sample.time < response.shocks[1].start);
    assert_eq!(response.ties[0][at_start].elongation.positive, after_first);
    // a new tie would stretch anew
    let fresh = run(&wall, motion(0.01, &second), None).demands.ties[0].yielding.unwrap();
    assert_ne!(fresh.elongation.positive, elongation(1));
}

/// A tie that breaks in the first shock keeps the time of its break in the second one.
#[test]
fn a_broken_tie_does_not_break_again() {
    let shock = noise(3, 0.01, 8.0);
    let both = GroundMotion::sequence(&[motion(0.01, &shock), motion(0.01, &shock)], 6.0).unwrap();
    let response = run(&tied(1e-3, 0.0, 0.0), both, None);
    let [first, second] =
        [0, 1].map(|shock: usize| response.shocks[shock].demands.ties[0].yielding.unwrap().breaks);
    let broken = first.into_iter().zip(second).filter(|(first, _)| first.is_some());
    let broken: Vec<_> = broken.collect();
    assert!(!broken.is_empty() && broken.iter().all(|(first, second)| first == second), "{broken:?}");
}

/// A shock says whether the wall had fallen before it began.
#[test]
fn shocks_after_a_fall_say_so() {
    let shock = noise(3, 0.01, 20.0);
    let twice = GroundMotion::sequence(&[motion(0.01, &shock), motion(0.01, &shock)], 6.0).unwrap();
    let response = run("[geometry]\nheight = 3.0\nthickness = 0.3", twice, None);
    assert!(response.summary.fate.falls());
    let fallen = response.shocks.iter().map(|shock| (shock.fallen_before, shock.falls));
    assert_eq!(fallen.collect::<Vec<_>>(), [(false, true), (true, true)]);
}

/// Records of two steps are each the motion that they are at a step that divides both.
#[test]
fn a_finer_step_is_the_same_motion() {
    let coarse = noise(5, 0.02, 1.0);
    let short = motion(0.005, &[0.0, 1e-3, 0.0]);
    let both = GroundMotion::sequence(&[motion(0.02, &coarse), short], 5.0).unwrap();
    assert_eq!(both.step(), 0.005);
    let [one, two] = [motion(0.02, &coarse), both].map(|motion| run(&walls()[0], motion, Some(0.02)));
    let shaken = coarse.len();
    for (one, two) in one.samples.iter().zip(&two.samples).take(shaken) {
        let (u, other) = (one.outputs.displacement, two.outputs.displacement);
        // fourfold as many roundings, of a wall that does not amplify them beyond 1e3
        assert!((u - other).abs() < 1e-12, "{}: {u} and {other}", one.time);
    }
}

/// A factor of 2 in a scene is the doubled record, bit for bit; files keep their own step and unit.
#[test]
fn scenes_state_sequences() {
    let folder = std::env::temp_dir().join(format!("rocking_wall_sequences_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, step: f64, samples: &[f64]| {
        let rows: Vec<_> =
            samples.iter().enumerate().map(|(k, a)| format!("{:?},{a:?}\n", k as f64 * step)).collect();
        std::fs::write(folder.join(name), format!("t,a\n{}", rows.concat())).unwrap();
    };
    write("main.csv", 0.02, &[0.0, 2.0, -1.0, 0.0]);
    write("after.csv", 0.01, &[0.0, 0.1, -0.2, 0.0]);
    let read =
        |motion: &str| Scene::parse("scene.toml", &format!("[motion]\nunit = \"m/s2\"\n{motion}"), &folder);
    let scene =
        read("pause = 0.02\nrecord = [\"main.csv\", { record = \"after.csv\", unit = \"g\", scale = 2 }]\n")
            .unwrap();
    let found = scene.excitation.as_ref().unwrap().bottom();
    let g = 9.80665;
    let expected = [0.0, 1.0, 2.0, 0.5, -1.0, -0.5, 0.0, 0.0, 0.0, 2.0 * (0.1 * g), -2.0 * (0.2 * g), 0.0];
    assert_eq!((found.step(), found.samples()), (0.01, &expected[..]));
    assert_eq!(found.shocks()[1].start, 8);
    assert_eq!(scene.files.len(), 2);
    let joined = "0.02 s between them, in steps of 0.01 s".to_owned();
    assert!(scene.motion_notes.contains(&joined), "{:?}", scene.motion_notes);
    // a step that nine decimals would show as 0
    write("fast.csv", 2e-10, &[0.0, 2.0, -1.0, 0.0]);
    let fast = read("pause = 0\nrecord = [\"fast.csv\", \"fast.csv\"]\n").unwrap().motion_notes;
    assert!(fast.contains(&"0 s between them, in steps of 2e-10 s".to_owned()), "{fast:?}");
    // one in a list is a record by itself
    let [one, alone] =
        ["record = [\"main.csv\"]\n", "record = \"main.csv\"\n"].map(|text| read(text).unwrap());
    assert_eq!(one.excitation, alone.excitation);
    for (motion, message) in [
        ("record = []\n", "expected a path in quotes, or a list such as"),
        ("record = [[\"main.csv\"]]\n", "expected a path in quotes, or a list such as"),
        ("record = [\"main.csv\", 3]\n", "expected a path in quotes, or a list such as"),
        ("record = [\"main.csv\", { scale = 2 }]\n", "record is missing"),
        ("record = [\"main.csv\", { record = \"after.csv\", factor = 2 }]\n", "unknown key \"factor\""),
        ("record = [\"main.csv\", \"gone.csv\"]\n", "gone.csv: cannot be read"),
        ("pause = 1\nrecord = \"main.csv\"\n", "pause is the time between the records of a sequence"),
        ("pause = 1\nricker = { amplitude = 1, frequency = 1, centre = 1 }\n", "pause is the time between"),
        ("pause = -1\nrecord = [\"main.csv\", \"after.csv\"]\n", "pause = -1"),
        ("pause = 1e6\nrecord = [\"main.csv\", \"after.csv\"]\n", "shorten the pause"),
        ("from = 90\nrecord = [\"main.csv\", \"after.csv\"]\n", "the interval must lie within the record"),
        ("fingerprint = \"0\"\nrecord = [\"main.csv\", \"after.csv\"]\n", "state it in the table of each"),
        ("record = [\"main.csv\", { record = \"after.csv\", fingerprint = \"0\" }]\n", "has the fingerprint"),
        ("record = [\"main.csv\", { record = \"after.csv\", scale = 1, pga = 1 }]\n", "exclude each other"),
    ] {
        let found = read(motion).unwrap_err().to_string();
        assert!(found.starts_with("scene.toml, line ") && found.contains(message), "{motion}{found}");
    }
    write("odd.csv", 0.0117, &[0.0, 1.0, 0.0]);
    let found = read("record = [\"main.csv\", \"odd.csv\"]\n").unwrap_err().to_string();
    assert!(found.contains("step [s] is 0.02") && found.contains("resample"), "{found}");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The unit of a scene with a sequence moves as the run does.
#[test]
fn a_unit_runs_through_a_sequence() {
    let shocks = [motion(0.02, &noise(6, 0.02, 4.0)), motion(0.01, &noise(7, 0.01, 4.0))];
    let mut scene = Scene::parse("scene.toml", &tied(0.05, 0.0, 0.0), &PathBuf::new()).unwrap();
    scene.shake(Excitation::new(GroundMotion::sequence(&shocks, 3.0).unwrap(), None), 2.0, Vec::new());
    let response = Response::of(&scene).unwrap();
    assert_eq!(response.shocks.len(), 2);
    let payload =
        UnitScene { parameters: scene.parameters.clone(), motion: scene.excitation.clone() }.bytes();
    let mut unit = of_payload(Interface::CoSimulation, Some(&payload), &mut Log::silent());
    unit.initialize(&mut Log::silent()).unwrap();
    let mut before = 0.0;
    for sample in &response.samples[1..] {
        let step = Step { from: before, duration: sample.time - before, may_end_early: false };
        unit.do_step(step, &mut Log::silent()).unwrap();
        before = sample.time;
        let u = sample.outputs.displacement;
        // the unit sums its steps
        assert!((unit.real(V::U) - u).abs() < 1e-9, "{before}: {} and {u}", unit.real(V::U));
    }
    let stretched = response.shocks[1].demands.ties[0].yielding.unwrap();
    assert!(stretched.elongation.positive > 0.0);
    assert!((unit.real(V::TieElongation) - stretched.elongation.positive).abs() < 1e-9);
    assert_eq!(V::TieElongation.variable().name, "tie_elongation");
}
