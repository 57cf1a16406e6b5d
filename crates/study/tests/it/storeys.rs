//! Tests studies of walls on storeys.

use std::fmt::Write;
use std::path::Path;

use rocking_wall::simulation::Excitation;
use scene::Scene;
use scene::response::Response;
use study::codes::NoCodes;
use study::document::StudyFile;
use study::ida::Study;

/// Mass [kg] and stiffness [N/m] of each.
const STOREYS: [(f64, f64); 3] = [(2.0e4, 4.0e7), (2.0e4, 3.0e7), (1.5e4, 2.0e7)];
/// What is computed after the record [s].
const TAIL: f64 = 4.0;

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
    let mut storeys = String::new();
    for (mass, stiffness) in STOREYS {
        let _ = writeln!(storeys, "[[storeys]]\nmass = {mass:?}\nstiffness = {stiffness:?}");
    }
    let run = |name: &str, text: String| {
        StudyFile::parse(name, &text, &NoCodes).unwrap();
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::write(&file, text).unwrap();
        let study: Study = study::loaded::LoadedStudy::read(&file, &NoCodes).unwrap().study;
        let curves = study.run(1).unwrap();
        (study.intensity(0), curves[0].runs()[0].demand)
    };
    let (on_ground, ground_demand) = run("ground.toml", text(""));
    let (on_roof, demand) = run("roof.toml", text(&format!("supports = {{ bottom = 3 }}\n{storeys}")));
    assert_eq!(on_ground, on_roof);
    assert!(demand > 2.0 * ground_demand, "{demand} {ground_demand}");
    let wall = "[geometry]\nheight = 1.2\nthickness = 0.3\n[force_law]\na1 = 0.05\n[damping]\n\
                damping_model = \"constant_coefficient\"\nxi = 0.05\n[supports]\nbottom = 3\n";
    let text = format!("{wall}{storeys}[motion]\nsynthetic = {{ duration = 10.0 }}\n");
    let mut scene = Scene::parse("scene", &text, ".".as_ref()).unwrap();
    let ground = scene.excitation.take().unwrap().bottom().scaled_to_peak(0.04 * 9.80665).unwrap();
    scene.shake(Excitation::new(ground, None), TAIL, Vec::new());
    let response = Response::of(&scene).unwrap();
    assert!((response.summary.u_ratio_max / demand - 1.0).abs() < 1e-9, "{demand}");
}
