//! Full rotations: Housner's block and the two-body strip.

use std::path::Path;

use rocking_wall::solver::{Memo, Method, Motion, Segment, State};
use rocking_wall::variables::{DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism, Solver};
use rocking_wall::wall::{Kinematics, Parameters, Support, Wall};
use scene::Scene;
use scene::response::Response;

const MECHANISMS: [Mechanism; 2] = [Mechanism::Parapet, Mechanism::VerticalSpanning];

/// The wall of Figure 2 in full rotations.
fn full(mechanism: Mechanism) -> Parameters {
    Parameters {
        kinematics: Kinematics::Trigonometric,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        u_start: 0.0,
        mechanism,
        height: 4.0,
        thickness: 0.4,
        restitution: if mechanism == Mechanism::Parapet { 0.985 } else { 0.955 },
        ..Parameters::default()
    }
}

/// A wall that uses all features of the model.
fn loaded(mechanism: Mechanism, eccentricity_mode: EccentricityMode) -> Parameters {
    Parameters {
        hinge_ratio: 0.58,
        overburden: 20_000.0,
        overburden_eccentricity: 0.07,
        eccentricity_mode,
        restitution: 0.9,
        ..full(mechanism)
    }
}

fn motion(parameters: &Parameters, tolerance: f64) -> Motion {
    let wall = Wall::new(parameters).unwrap();
    let method = Method::new(parameters, &wall, tolerance).unwrap();
    Motion::new(wall, method)
}

/// Moves through a motion of the ground, linear between samples, from rest at `start` of the unstable
/// equilibrium.
fn shaken(motion: &Motion, start: f64, samples: &[f64], step: f64) -> Vec<State> {
    let u_ins = motion.wall().body().instability.of(start);
    let mut state = motion.start(start * u_ins, 0.0, Support::rigid(samples[0]));
    let mut states = vec![state];
    for ends in samples.windows(2) {
        let [from, to] = [ends[0], ends[1]].map(Support::rigid);
        motion
            .advance(&mut state, &Segment { duration: step, from, to }, false, &mut Memo::default())
            .unwrap();
        states.push(state);
    }
    states
}

#[test]
fn full_rotations_refuse_what_needs_small_ones() {
    type Change = fn(&mut Parameters);
    let cases: [(Change, &str); 7] = [
        (|wall| wall.multilinear = Some([[0.1, 0.9], [1.0, 0.0]].into()), "force_law = multilinear"),
        (|wall| wall.force_law = ForceLaw::Bilinear, "force_law = bilinear"),
        (|wall| wall.a3 = 0.9, "a3 = 0.9"),
        (|wall| wall.damping_model = DampingModel::FreeStandingBlock, "damping_model = free_standing_block"),
        (|wall| wall.solver = Solver::Exact, "solver = exact"),
        (|wall| wall.solver = Solver::Newmark, "solver = newmark"),
        (|wall| wall.tie_stiffness = 1e5, "tie_stiffness = 100000"),
    ];
    for (change, named) in cases {
        let mut parameters = full(Mechanism::Parapet);
        Wall::new(&parameters).unwrap();
        change(&mut parameters);
        let error = Wall::new(&parameters).unwrap_err().to_string();
        assert!(error.contains(&format!("trigonometric does not go with {named}; set")), "{error}");
    }
}

/// ü is that at which the energy of a free motion stays: E(u + u̇ δ, u̇ + ü δ) differs from E(u, u̇) only by
/// terms of order δ².
#[test]
fn accelerations_keep_the_energy() {
    for mechanism in MECHANISMS {
        let motion = motion(&loaded(mechanism, EccentricityMode::FixedToWall), 1e-13);
        let (wall, rotations) = (motion.wall(), motion.wall().rotations().unwrap());
        let u_ins = wall.body().instability.positive;
        for (u, v) in [(0.2 * u_ins, 0.5), (0.5 * u_ins, -1.0), (0.4 * u_ins, 0.1)] {
            let a = rotations.acceleration(u, v, 0.0, 1.0);
            let after = |time: f64| rotations.energy(u + time * v, v + time * a);
            // a central difference: what is left is of third order, and rounding of 1e-16/1e-5
            let rate = (after(1e-5) - after(-1e-5)) / 2e-5;
            let size = (v * a).abs() + (v * rotations.restoring(u, 1.0)).abs();
            assert!(rate.abs() < 1e-8 * size, "{mechanism:?}: {rate:e} of {size:e}");
            // the energy at rest is the integral of the restoring force from u = 0, with the errors above
            let slope = (rotations.energy(u + 1e-5, 0.0) - rotations.energy(u - 1e-5, 0.0)) / 2e-5;
            let force = rotations.restoring(u, 1.0);
            assert!((slope - force).abs() < 1e-8 * force, "{mechanism:?}: {slope} for {force}");
            assert_eq!(rotations.energy(0.0, 0.0), 0.0);
        }
    }
}

#[test]
fn free_motion_keeps_its_energy_between_impacts() {
    for mechanism in MECHANISMS {
        use EccentricityMode::{FixedToWall, FollowsPivot};
        // where the sides differ, a start near the equilibrium of one overturns on the other
        for (mode, start) in [(FixedToWall, 0.3), (FixedToWall, -0.3), (FollowsPivot, 0.95)] {
            let parameters = Parameters { restitution: 1.0, ..loaded(mechanism, mode) };
            let motion = motion(&parameters, 1e-13);
            let wall = motion.wall();
            let states = shaken(&motion, start, &vec![0.0; 2000], 0.01);
            let energy = |state: &State| wall.energy(state.displacement, state.velocity);
            let first = energy(&states[0]);
            // of 2000 steps each leaves out terms of 1e-17 of the scale
            let drift = states.iter().map(|s| (energy(s) / first - 1.0).abs()).fold(0.0, f64::max);
            assert!(drift < 1e-12, "{mechanism:?} {start}: {drift}");
            assert!(
                states.iter().any(|s| s.displacement > 0.01) && states.iter().any(|s| s.displacement < -0.01)
            );
        }
    }
}

/// θ̈ = −p² (sin(α − θ) + (a_g/g) cos(α − θ)) for θ > 0, with u = ½ (b + D sin(θ − α)) substituted.
#[test]
fn a_parapet_obeys_housners_equation() {
    let motion = motion(&full(Mechanism::Parapet), 1e-12);
    let (wall, h, b, g) = (motion.wall(), 4.0_f64, 0.4_f64, 9.81);
    let (alpha, diagonal) = (libm::atan2(b, h), h.hypot(b));
    let p_squared = 1.5 * g / diagonal;
    for (theta, rate, ground) in [(0.05, 0.3, 0.0), (0.12, -0.2, 2.0), (0.6, 1.0, -5.0), (1e-9, 0.0, 3.0)] {
        let psi = theta - alpha;
        let angular = p_squared * (libm::sin(psi) - ground / g * libm::cos(psi));
        let u = 0.5 * (b + diagonal * libm::sin(psi));
        let velocity = 0.5 * diagonal * libm::cos(psi) * rate;
        let expected = 0.5 * diagonal * (libm::cos(psi) * angular - libm::sin(psi) * rate * rate);
        for sign in [1.0, -1.0] {
            let branch = wall.branch_of(sign * u, sign);
            let forcing = wall.body().forcing(Support::rigid(sign * ground));
            let found = sign * wall.acceleration(branch, sign * u, sign * velocity, forcing);
            assert!((found - expected).abs() < 1e-13 * (g + ground.abs()), "θ = {theta}: {found} {expected}");
            let rotations = wall.rotations().unwrap();
            assert!((rotations.rotation(sign * u) - sign * theta).abs() < 1e-15);
            assert!((rotations.displacement(sign * theta) - sign * u).abs() < 1e-15);
        }
    }
    // Table 2 at u = 0, and the equilibrium of full rotations without overburden
    let body = wall.body();
    let onset = wall.restoring(wall.branch_of(0.0, 1.0), 0.0) * body.effective_mass;
    assert!((onset / body.strength.positive - 1.0).abs() < 1e-15);
    assert_eq!(body.instability.positive, b / 2.0);
}

/// F₀ of Table 2 with overburden, eccentricity and any hinge height.
#[test]
fn the_strength_is_that_of_table_2() {
    for mechanism in MECHANISMS {
        for mode in [EccentricityMode::FixedToWall, EccentricityMode::FollowsPivot] {
            let motion = motion(&loaded(mechanism, mode), 1e-12);
            let (wall, body) = (motion.wall(), motion.wall().body());
            for (sign, strength) in [(1.0, body.strength.positive), (-1.0, body.strength.negative)] {
                let found = sign * wall.restoring(wall.branch_of(0.0, sign), 0.0) * body.effective_mass;
                assert!((found / strength - 1.0).abs() < 1e-14, "{mechanism:?} {sign}: {found} {strength}");
                let u_ins = body.instability.of(sign);
                let rest = wall.restoring(wall.branch_of(sign * u_ins, sign), sign * u_ins);
                assert!(rest.abs() < 1e-14 * strength / body.effective_mass, "no force at u_ins: {rest}");
            }
        }
    }
}

/// A harmonic motion of the ground that makes the wall of `loaded` rock through some impacts.
fn harmonic(count: u32, duration: f64, amplitude: f64) -> (Vec<f64>, f64) {
    let step = duration / f64::from(count);
    let sample = |index: u32| amplitude * libm::sin(7.0 * step * f64::from(index) + 0.4);
    ((0..=count).map(sample).collect(), step)
}

#[test]
fn the_mirror_image_moves_as_the_mirror_image() {
    for mechanism in MECHANISMS {
        let motion = motion(&loaded(mechanism, EccentricityMode::FollowsPivot), 1e-8);
        let (samples, step) = harmonic(400, 4.0, 1.5);
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        let (one, other) = (shaken(&motion, 0.5, &samples, step), shaken(&motion, -0.5, &mirrored, step));
        assert!(one.iter().any(|state| state.displacement < 0.0), "it passes u = 0");
        for (a, b) in one.iter().zip(&other) {
            assert_eq!((a.displacement, a.velocity), (-b.displacement, -b.velocity), "{mechanism:?}");
        }
    }
}

/// The error stays below the tolerance, and the straight lines between samples give order 2, across impacts
/// too.
#[test]
fn forced_motion_follows_its_tolerance_and_the_order_of_its_samples() {
    for mechanism in MECHANISMS {
        let parameters = loaded(mechanism, EccentricityMode::FixedToWall);
        let end = |tolerance: f64, count: u32| {
            let motion = motion(&parameters, tolerance);
            let (samples, step) = harmonic(count, 2.0, 0.8);
            let last = *shaken(&motion, 0.4, &samples, step).last().unwrap();
            last.displacement / motion.wall().displacement_scale()
        };
        let best = end(1e-13, 40);
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let error = (end(tolerance, 40) - best).abs();
            assert!(error < tolerance, "{mechanism:?} {tolerance}: {error}");
        }
        // against the next finer: the differences of a scheme of order 2 fall by 4
        let values: Vec<f64> = (0..7).map(|k| end(1e-13, 50 << k)).collect();
        let differences: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
        let order = (differences[0] / differences[5]).log2() / 5.0;
        assert!((order - 2.0).abs() < 0.2, "{mechanism:?}: {differences:?}");
    }
}

const SCENE: &str = "[geometry]\nkinematics = \"trigonometric\"\n[force_law]\nforce_law = \"rigid_linear\"\n\
                     [damping]\ndamping_model = \"none\"\n[impact]\nimpact = \"restitution\"\n";

/// Under g b/h a block rests; under a strong pulse it overturns, falls, and lies where its side meets the
/// ground.
#[test]
fn a_ricker_pulse_overturns_or_does_not() {
    let run = |amplitude: f64, mechanism: &str| {
        let motion =
            format!("[motion]\nricker = {{ amplitude = {amplitude}, frequency = 0.8, centre = 2.0 }}\n");
        let text =
            SCENE.replacen("[geometry]", &format!("[geometry]\nmechanism = {mechanism:?}"), 1) + &motion;
        Response::of(&Scene::parse("ricker", &text, Path::new(".")).unwrap()).unwrap()
    };
    for (mechanism, onset, end) in [("parapet", 0.981, 2.2), ("vertical_spanning", 3.924, 2.4)] {
        let resting = run(0.999 * onset, mechanism);
        assert_eq!(resting.summary.u_max, 0.0, "{mechanism}: below its onset it rests");
        let rocking = run(1.2 * onset, mechanism);
        assert!(rocking.summary.u_max > 0.0 && !rocking.summary.overturned, "{mechanism}");
        let fallen = run(6.0 * onset, mechanism);
        assert!(fallen.summary.overturned, "{mechanism}");
        let last = fallen.samples.last().unwrap().outputs;
        assert_eq!((last.displacement.abs(), last.velocity), (end, 0.0), "{mechanism}");
        assert!(fallen.samples.iter().all(|sample| sample.outputs.acceleration.is_finite()));
    }
}
