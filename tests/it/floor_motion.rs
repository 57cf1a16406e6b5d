//! Tests walls on floors that move as if there were no wall: `[[storeys]]`.

use std::fmt::Write;

use fmu_export::{Interface, Log, Model as _, Step};
use ground_motion::GroundMotion;
use rocking_wall::choices::Mechanism;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::RealVariable;
use scene::Scene;
use scene::response::Response;

use crate::chain::{STOREYS, TAIL, ground, integrated, storeys};
use crate::instantiated;

const PARAPET: &str = "
[geometry]
height = 1.2
thickness = 0.3
";

const STRIP: &str = "
[geometry]
mechanism = \"vertical_spanning\"
height = 3.0
thickness = 0.2
hinge_ratio = 0.6
overburden = 5000.0
";

/// Force law and damping of both.
const LAW: &str = "
[force_law]
a1 = 0.05
[damping]
damping_model = \"constant_coefficient\"
xi = 0.05
";

/// A wall, its supports, and storeys without damping under the synthetic motion.
fn scene(shape: &str, supports: &str, damping_ratio: f64) -> String {
    let mut text = format!("{shape}{LAW}[supports]\n{supports}\n");
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
    let mut unit = instantiated(Interface::CoSimulation, Some(&text), &mut Log::silent());
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
fn storeys_refuse_a_motion_that_is_held() {
    let text = scene(STRIP, "bottom = 2\ndrift = true", 0.05);
    let scene = Scene::parse("scene", &text, ".".as_ref()).unwrap();
    let (floors, motion) = (scene.floors.unwrap(), scene.excitation.unwrap());
    let mechanism = scene.parameters.mechanism;
    assert!(floors.motion(mechanism, &motion, 12.0).is_ok());
    let error = floors.motion(mechanism, &motion.held(), 12.0).unwrap_err().to_string();
    assert!(error.contains("leave out [motion.top] and --hold"), "{error}");
}

#[test]
fn a_scene_with_storeys_is_written_and_read_back() {
    let text = scene(STRIP, "bottom = 1\ntop = 2\ndrift = false", 0.03);
    let first = Scene::parse("scene", &text, ".".as_ref()).unwrap();
    let written = scene::to_toml(&first, "synthetic = { duration = 10.0 }\n");
    let again = Scene::parse("again", &written, ".".as_ref()).unwrap();
    assert_eq!(first.floors, again.floors);
}
