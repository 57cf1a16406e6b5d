//! Full rotations: Housner's block and the two-body strip.

use rocking_wall::accuracy::linearisation::{STARTS, figure_2, figure_2_wall, figure_3, period};
use rocking_wall::solver::{Memo, Method, Motion, Segment, State};
use rocking_wall::variables::{DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Kinematics, Parameters, Support, Wall};

const MECHANISMS: [Mechanism; 2] = [Mechanism::Parapet, Mechanism::VerticalSpanning];

/// The wall of Figure 2 in full rotations.
fn full(mechanism: Mechanism) -> Parameters {
    Parameters {
        kinematics: Kinematics::Trigonometric,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        u_start: 0.0,
        ..figure_2_wall(mechanism)
    }
}

/// One with everything the model knows.
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

/// Moves through a motion of the ground, linear between samples, from rest at `start` of the unstable equilibrium.
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

/// ∫₀¹ f over the tanh-sinh rule (Takahasi and Mori, 1974), which does not mind singular derivatives at the ends.
fn quadrature(f: impl Fn(f64) -> f64) -> f64 {
    let step = 1.0 / 64.0;
    let term = |index: i32| {
        let t = f64::from(index) * step;
        let inner = std::f64::consts::FRAC_PI_2 * t.sinh();
        let weight = std::f64::consts::FRAC_PI_2 * t.cosh() / inner.cosh().powi(2);
        0.5 * weight * f(1.0 / (1.0 + (-2.0 * inner).exp()))
    };
    step * (-200..=200).map(term).sum::<f64>()
}

/// Housner's block from the energy integral, θ̇² = 2p² (cos(α − θ) − cos(α − θ₀)), which shares nothing with the program.
#[test]
fn the_quarter_period_of_housners_block() {
    for (thickness, start) in [(0.4, 0.9), (0.4, 0.1), (1.2, 0.5), (0.04, 0.99)] {
        let wall = Parameters { thickness, ..figure_2_wall(Mechanism::Parapet) };
        let alpha = libm::atan2(thickness, wall.height);
        let radius = 0.5 * thickness.hypot(wall.height);
        let p = (0.75 * wall.gravity / radius).sqrt();
        let first = start * alpha;
        // θ = θ₀ (1 − y²), and cos a − cos b = 2 sin((a + b)/2) sin((b − a)/2) does not cancel
        let quarter = quadrature(|y| {
            let fallen = first * y * y;
            let drop = 2.0 * libm::sin(alpha - first + 0.5 * fallen) * libm::sin(0.5 * fallen);
            2.0 * first * y / (p * (2.0 * drop).sqrt())
        });
        let found = period(&wall, start).unwrap().trigonometric / 4.0;
        // the tolerance of 1e-12 u_ins over the velocity at the impact, at most 1e-11 here
        assert!((found / quarter - 1.0).abs() < 1e-10, "b = {thickness}, {start}: {found} {quarter}");
    }
}

#[test]
fn figure_2_of_the_paper() {
    let parapet = figure_2(Mechanism::Parapet, 20.0, 0.01).unwrap();
    assert!((parapet.trigonometric.impacts[0] - 1.56459).abs() < 1e-5);
    assert!((parapet.linear.impacts[0] - 1.56059).abs() < 1e-5);
    let apart = parapet.largest_difference();
    assert!((0.085..0.09).contains(&apart), "{apart}");
    let strip = figure_2(Mechanism::VerticalSpanning, 12.0, 0.01).unwrap();
    // the time to the first impact 1.97 % short, and more as the amplitude falls
    let short = 1.0 - strip.time_ratio(0).unwrap();
    assert!((0.019..0.022).contains(&short), "{short}");
    assert!((1..10).all(|n| strip.time_ratio(n).unwrap() < strip.time_ratio(n - 1).unwrap()));
    let apart = strip.largest_difference();
    assert!((0.38..0.40).contains(&apart), "{apart}");
    // out of phase, not of size
    assert!(strip.largest_amplitude_difference() < 2e-3, "{}", strip.largest_amplitude_difference());
    assert!(parapet.largest_amplitude_difference() < 2e-4);
}

#[test]
fn figure_3_of_the_paper() {
    for start in STARTS {
        let periods = figure_3(Mechanism::Parapet, &[0.1, 0.2, 0.3], start).unwrap();
        for (period, expected) in periods.iter().zip([0.9975, 0.990, 0.977]) {
            let ratio = period.over_housner().unwrap();
            assert!((ratio - expected).abs() < 5e-4, "{period:?}");
            // both periods are acosh over a rate: √cos α is exact
            assert!((ratio - period.slenderness.cos().sqrt()).abs() < 1e-12, "{period:?}");
        }
    }
}

/// The error of small rotations is O(α²): halving α divides it by 4.
#[test]
fn small_rotations_are_the_limit() {
    for mechanism in MECHANISMS {
        let angles = [0.08, 0.04, 0.02, 0.01];
        let periods = figure_3(mechanism, &angles, 0.6).unwrap();
        let errors: Vec<f64> = periods.iter().map(|period| 1.0 - period.ratio()).collect();
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            // the next term is O(α⁴), relatively α² = 0.0064 at most
            assert!((order - 2.0).abs() < 0.02, "{mechanism:?}: {errors:?}");
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
