//! What "overturned", "falls" and "beyond `u_ins` and back" mean, and the one rule for u/`u_ins` after it.

use ground_motion::SyntheticMotion;
use rocking_wall::simulation::Excitation;
use rocking_wall::variables::TieSide;
use rocking_wall::wall::Parameters;
use scene::Scene;
use scene::response::{Fate, Response};

/// The default parapet under `scale` times the synthetic motion, with a tie of a stiffness [N/m].
fn scene(scale: f64, tie_stiffness: f64, tie_side: TieSide) -> Scene {
    let parameters = Parameters { tie_height: 3.0, tie_stiffness, tie_side, ..Parameters::default() };
    let mut scene = Scene { parameters, ..Scene::default() };
    let motion = SyntheticMotion::default().motion().unwrap().checked_scaled(scale).unwrap();
    scene.shake(Excitation::new(motion, None), 10.0, Vec::new());
    scene
}

fn respond(scale: f64, tie_stiffness: f64, tie_side: TieSide) -> Response {
    Response::of(&scene(scale, tie_stiffness, tie_side)).unwrap()
}

#[test]
fn a_wall_falls_once_it_stays_beyond() {
    let history = |ratios: [f64; 6]| (0..6).map(f64::from).zip(ratios).collect::<Vec<_>>().into_iter();
    let fate = |overturning, ratios| Fate::of(overturning, history(ratios));
    assert_eq!(fate(None, [0.0, 0.5, -0.9, 0.2, 0.1, 0.0]), Fate::Stands);
    let back = [0.0, 0.5, 1.2, 0.8, -0.3, 0.1];
    assert_eq!(fate(Some(1.7), back), Fate::ComesBack { exceeds: 1.7 });
    let at_once = [0.0, 0.5, -1.2, -2.8, -5.0, -10.0];
    assert_eq!(fate(Some(1.7), at_once), Fate::Falls { exceeds: 1.7, falls: 1.7 });
    // from 0.8 at 3 s to 1.3 at 4 s, 1 lies at 3.4 s
    let later = [0.0, 0.5, 1.2, 0.8, 1.3, 10.0];
    let Fate::Falls { exceeds, falls } = fate(Some(1.7), later) else { panic!("it falls") };
    assert!(exceeds == 1.7 && (falls - 3.4).abs() < 1e-12, "{falls}");
    // a wall that lies where u_ins is the end of its fall
    assert!(fate(Some(1.7), [0.0, 0.5, 1.0, 1.0, 1.0, 1.0]).falls());
}

/// Before: 9.99 and more, up to the end of the fall (h/2 over `u_ins`).
#[test]
fn a_fall_counts_up_to_u_ins() {
    let free = respond(3.0, 0.0, TieSide::Both);
    let (summary, end) = (&free.summary, free.samples.last().unwrap().outputs.ratio);
    assert!(summary.fate.falls() && end.abs() > 5.0, "{summary:?}, {end}");
    let u_ins = scene(1.0, 0.0, TieSide::Both).parameters.thickness / 2.0;
    assert_eq!(summary.u_ratio_max, 1.0);
    assert!((summary.u_max / u_ins - 1.0).abs() < 1e-12, "{}", summary.u_max);
    // a tie that pulls the wall back leaves it its own peak
    let held = respond(3.0, 1e4, TieSide::Both).summary;
    assert!(held.overturned && matches!(held.fate, Fate::ComesBack { .. }), "{held:?}");
    let largest = respond(3.0, 1e4, TieSide::Both).samples;
    let largest = largest.iter().fold(0.0_f64, |most, sample| most.max(sample.outputs.ratio.abs()));
    assert!(held.u_ratio_max >= largest && largest > 1.1, "{held:?}, {largest}");
}
