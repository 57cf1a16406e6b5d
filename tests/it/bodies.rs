//! Tests bodies of parts, with openings, loads and thrusts, and bodies given by their integrals.

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism, RestitutionSource, Rocking};
use rocking_wall::wall::{
    Body, Hollow, Kinematics, Load, Opening, ParameterError, Parameters, Part, Profile, Sides, Support, Wall,
};

/// A prism of 1 m width on the ground.
pub(crate) const PRISM: Part =
    Part { base: 0.0, height: 3.0, thickness: [0.25; 2], width: [1.0; 2], outer: [0.0; 2], density: 1800.0 };
const RIGID: ForceLaw = ForceLaw::RigidLinear;

/// A rigid wall with impacts.
fn of_rectangle() -> Parameters {
    Parameters {
        force_law: RIGID,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution_source: RestitutionSource::Impulses,
        u_start: 0.0,
        ..Parameters::default()
    }
}

/// A rigid wall with impacts, of parts.
pub(crate) fn of_parts(parts: &[Part], openings: &[Opening], loads: &[Load]) -> Parameters {
    let mut parameters = of_rectangle();
    parameters.set_profile(Profile::new(parts.to_vec(), openings.to_vec(), loads.to_vec()).unwrap());
    parameters
}

/// Supports that keep their motion for some time [s].
pub(crate) fn held(support: Support, duration: f64) -> Segment {
    Segment { duration, from: support, to: support }
}

fn body(parameters: &Parameters) -> Body {
    Wall::new(parameters).unwrap().body().clone()
}

/// m, z_G, m_eff, λ, F₀₊, F₀₋, k₀, u_ins₊, u_ins₋ and e of both directions.
fn constants(body: &Body) -> [f64; 11] {
    let Sides { positive, negative } = body.impulses.unwrap();
    [
        body.mass,
        body.centroid_height,
        body.effective_mass,
        body.participation,
        body.strength.positive,
        body.strength.negative,
        body.geometric_stiffness,
        body.instability.positive,
        body.instability.negative,
        positive,
        negative,
    ]
}

/// The constants of eight bodies, from an independent program, to the digits shown.
#[test]
fn bodies_have_the_constants_of_an_independent_program() {
    let gable = Part { height: 2.4, width: [6.0, 0.0], ..PRISM };
    let trapezium = Part { width: [6.0, 2.0], ..gable };
    let battered = Part { height: 4.0, thickness: [0.5, 0.3], outer: [0.0, 0.2], ..PRISM };
    let wide = Part { width: [3.0; 2], ..PRISM };
    let window = Opening { base: 0.9, height: 1.5, width: 1.2, hollow: None };
    let stone = Part { height: 1.5, thickness: [0.5; 2], density: 2200.0, ..PRISM };
    let brick = Part { base: 1.5, thickness: [0.25; 2], density: 1700.0, ..stone };
    let facade = Part { height: 9.6, thickness: [0.6; 2], ..PRISM };
    let floor = |force, height, inside, thrust| Load {
        moving_mass: Some(1.0),
        thrust,
        ..Load::resting(force, height, inside)
    };
    let floors = [floor(12e3, 3.2, 0.5, 0.0), floor(12e3, 6.4, 0.5, 500.0), floor(8e3, 9.6, 0.4, 1e3)];
    let shaft = Part { height: 1.5, thickness: [0.6; 2], width: [0.6; 2], ..PRISM };
    let cap = Part {
        base: 1.5,
        height: 0.1,
        thickness: [0.8; 2],
        width: [0.8; 2],
        outer: [-0.1; 2],
        density: 2400.0,
    };
    let hollow = Some(Hollow { thickness: 0.3, outer: 0.15 });
    let flue = Opening { base: 0.0, height: 1.5, width: 0.3, hollow };
    #[rustfmt::skip]
    let rows = [
        (of_parts(&[PRISM], &[], &[]), [1350.0, 1.5, 1800.0, 0.75, 1103.625, 1103.625, 8829.0, 0.125, 0.125,
            0.989_655_172_414, 0.989_655_172_414]),
        (of_parts(&[gable], &[], &[]), [3240.0, 0.8, 4860.0, 0.666_666_666_667, 4966.3125, 4966.3125, 39730.5,
            0.125, 0.125, 0.968_139_337_298, 0.968_139_337_298]),
        (of_parts(&[trapezium], &[], &[]), [4320.0, 1.0, 6220.8, 0.694_444_444_444, 5297.4, 5297.4, 42379.2,
            0.125, 0.125, 0.978_608_100_399, 0.978_608_100_399]),
        (of_parts(&[battered], &[], &[]), [2880.0, 1.833_333_333_33, 3_998.677_685_95, 0.720_238_095_238,
            4_558.974_545_45, 3_146.334_545_45, 15_410.618_181_8, 0.295_833_333_333, 0.204_166_666_667,
            0.978_387_438_250, 0.968_984_798_183]),
        (of_parts(&[wide], &[window], &[]), [3240.0, 1.4625, 4_578.461_538_46, 0.707_661_290_323,
            2_716.615_384_62, 2_716.615_384_62, 21_732.923_076_9, 0.125, 0.125, 0.989_731_653_888,
            0.989_731_653_888]),
        (of_parts(&[stone, brick], &[], &[]), [2287.5, 1.168_032_786_89, 3_360.238_227_15, 0.680_755_305_240,
            4_133.753_289_47, 5_472.301_973_68, 19_212.110_526_3, 0.215_163_934_426, 0.284_836_065_574,
            0.932_338_147_006, 0.948_028_378_155]),
        (of_parts(&[facade], &[], &floors), [10368.0, 4.8, 19_804.292_218_8, 0.729_411_170_456, 6856.88,
            9856.88, 29_522.933_333_3, 0.232_256_054_051, 0.333_871_972_975, 0.995_386_965_496,
            0.993_899_098_848]),
        (of_parts(&[shaft, cap], &[flue], &[]), [882.6,
            0.889_225_016_995, 1_158.312_285_16, 0.761_970_680_366,
            2_921.073_688_16, 2_921.073_688_16, 9_736.912_293_87, 0.3, 0.3, 0.845_888_721_662,
            0.845_888_721_662]),
    ];
    for (parameters, expected) in rows {
        let found = constants(&body(&parameters));
        for (index, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            // twelve digits
            assert!((found - expected).abs() <= 6e-12 * expected, "number {index}: {found} for {expected}");
        }
    }
}

/// A strip of two unlike prisms, with a load out of its axis: the constants of an independent program.
#[test]
fn a_stepped_strip_has_the_constants_of_an_independent_program() {
    let lower = Part { height: 1.6, thickness: [0.4; 2], density: 1900.0, ..PRISM };
    let upper =
        Part { base: 1.6, height: 1.4, thickness: [0.25; 2], outer: [0.15; 2], density: 1700.0, ..PRISM };
    let strip = Parameters {
        mechanism: Mechanism::VerticalSpanning,
        hinge_ratio: 1.6 / 3.0,
        overburden: 8e3,
        overburden_eccentricity: 0.05,
        ..of_parts(&[lower, upper], &[], &[])
    };
    let body = body(&strip);
    let found = [
        body.effective_mass,
        body.participation,
        body.geometric_stiffness,
        body.strength.positive,
        body.strength.negative,
        body.instability.positive,
        body.instability.negative,
        body.support_weights[1],
        body.drift_weight / body.height,
        body.impulses.unwrap().positive,
        body.impulses.unwrap().negative,
    ];
    let expected = [
        1_207.333_333_333_33,
        1.5,
        40_349.608_928_6,
        12_943.027_5,
        9_205.742_232_14,
        0.320_772_068_025,
        0.228_149_478_436,
        0.465_071_476_778,
        2.0 * 2_960.985,
        0.814_782_319_455,
        0.776_760_778_495,
    ];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= 6e-12 * expected, "{found} for {expected}");
    }
    let facts = Wall::new(&strip).unwrap().facts();
    let fact = |name| facts.iter().find(|fact| fact.name == name).map(|fact| fact.value);
    assert_eq!(fact("support_weight_top"), Some(body.support_weights[1]));
    assert_eq!(fact("drift_stiffness"), Some(body.drift_weight / body.height));
    assert_eq!(fact("centroid_height"), None);
    // Newton and Euler for both bodies, u = 0.06 m under -5 m/s² of both supports
    let support = Support::rigid(-5.0);
    let mut simulation = Simulation::new(&strip, None, 0.0, support).unwrap();
    simulation.place(0.06, 0.0, support);
    let outputs = simulation.outputs(support);
    for (found, expected) in [
        (outputs.acceleration, -1.215_116_757),
        (outputs.reactions.bottom, -7_494.067_538),
        (outputs.reactions.top, -2_661.220_686),
    ] {
        assert!((found - expected).abs() <= 6e-10 * expected.abs(), "{found} for {expected}");
    }
}

/// The multiplier of a parapet of two unlike prisms, Σ W x / Σ W z about each toe; a rectangle states none.
#[test]
fn multipliers_of_a_stepped_parapet_follow_from_moments() {
    let lower = Part { height: 1.6, thickness: [0.4; 2], density: 1900.0, ..PRISM };
    let upper =
        Part { base: 1.6, height: 1.4, thickness: [0.25; 2], outer: [0.15; 2], density: 1700.0, ..PRISM };
    let fact = |parameters: &Parameters, name| {
        let facts = Wall::new(parameters).unwrap().facts();
        facts.iter().find(|fact| fact.name == name).map(|fact| fact.value)
    };
    let stepped = of_parts(&[lower, upper], &[], &[]);
    let [below, above] = [1.6 * 0.4 * 1900.0, 1.4 * 0.25 * 1700.0];
    let by_height = below * 0.8 + above * 2.3;
    // the outer face is the toe of u > 0, which the upper prism stands 0.15 m behind
    let wanted = [below * 0.2 + above * 0.275, below * 0.2 + above * 0.125].map(|by_arm| by_arm / by_height);
    for (name, wanted) in ["static_multiplier", "static_multiplier_negative"].into_iter().zip(wanted) {
        let found = fact(&stepped, name).unwrap();
        assert!((found - wanted).abs() <= 8.0 * f64::EPSILON, "{name}: {found} for {wanted}");
        assert_eq!(fact(&of_rectangle(), name), None);
    }
}

/// One prism is the rectangle itself.
#[test]
fn one_part_is_a_rectangle() {
    let parameters = of_parts(&[PRISM], &[], &[]);
    assert_eq!(parameters, Parameters { height: 3.0, thickness: 0.25, ..of_rectangle() });
}

/// A rectangle that is cut into two parts equals it to rounding, as a parapet and as a strip.
#[test]
fn two_parts_make_a_rectangle() {
    let lower = Part { height: 1.1, ..PRISM };
    let upper = Part { base: 1.1, height: 3.0 - 1.1, ..PRISM };
    for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
        for hinge_ratio in [0.5, 0.6] {
            let loads = Parameters { mechanism, hinge_ratio, ..of_parts(&[lower, upper], &[], &[]) };
            let loaded = Parameters { overburden: 10e3, overburden_eccentricity: 0.03, ..loads };
            let rectangle = Parameters { profile: None, ..loaded.clone() };
            let [found, expected] = [body(&loaded), body(&rectangle)];
            let all = |body: &Body| {
                let Body { contact, .. } = body;
                let shares = [contact.bottom, contact.top].map(|of| [of.bottom, of.top, of.wall]);
                let forces = [contact.moments.positive, contact.moments.negative];
                let slopes = [contact.by_displacement, contact.by_drift, body.drift_weight];
                let angles = [body.slenderness.positive, body.landing.negative];
                [&constants(body)[..], shares.as_flattened(), &forces, &slopes, &angles].concat()
            };
            for (found, expected) in all(&found).into_iter().zip(all(&expected)) {
                assert!((found - expected).abs() <= 4e-15 * expected.abs(), "{found} for {expected}");
            }
        }
    }
}

/// The body of `[geometry.body]` with its loads as sums equals that of its parts.
#[test]
fn integrals_give_the_body_of_parts() {
    let load = |force, height, inside, thrust| Load {
        moving_mass: Some(0.5),
        thrust,
        ..Load::resting(force, height, inside)
    };
    let loads = [load(9e3, 1.0, 0.2, 300.0), load(4e3, 2.5, 0.1, -100.0)];
    let parts = Parameters { restitution: 0.9, ..of_parts(&[PRISM], &[], &loads) };
    let expected = body(&parts);
    let sum = |of: fn(&Load) -> f64| loads.iter().map(of).sum::<f64>();
    let mass = |load: &Load| 0.5 * load.force / 9.81;
    let [force, moving, thrust] = [sum(|l| l.force), sum(mass), sum(|l| l.thrust)];
    let integrals = Parameters {
        profile: None,
        mechanism: Mechanism::RigidBody,
        height: 3.0,
        body_mass: 1350.0,
        centroid_height: 1.5,
        inertia: 1350.0 * 3.0,
        arm: 0.125,
        load_force: force,
        load_height: sum(|l| l.force * l.height) / force,
        load_arm: sum(|l| l.force * l.inside) / force,
        load_mass: moving,
        load_mass_height: sum(|l| mass_of(l) * l.height) / moving,
        load_inertia: sum(|l| mass_of(l) * l.height * l.height),
        thrust,
        thrust_height: sum(|l| l.thrust * l.height) / thrust,
        ..parts
    };
    let found = body(&integrals);
    let of = |body: &Body| {
        [
            &constants(&Body { impulses: expected.impulses, ..body.clone() })[..],
            &[body.contact.mass, body.contact.bottom.wall, body.contact.thrust],
        ]
        .concat()
    };
    for (found, expected) in of(&found).into_iter().zip(of(&expected)) {
        assert!((found - expected).abs() <= 4e-15 * expected.abs(), "{found} for {expected}");
    }
}

pub(crate) fn mass_of(load: &Load) -> f64 {
    load.moving(9.81)
}

/// A thrust that overturns is refused by name, unless transverse walls hold that side.
#[test]
fn a_thrust_needs_a_side_that_bears_it() {
    let load = Load { thrust: 1e3, ..Load::resting(5e3, 3.0, 0.125) };
    let parameters = of_parts(&[PRISM], &[], &[load]);
    let Err(error) = Wall::new(&parameters) else { panic!("there is a wall") };
    assert!(matches!(error, ParameterError::Overturns { side: "u > 0", .. }), "{error}");
    assert!(error.to_string().contains("thrusts with a moment of 3000 N m overturn it"), "{error}");
    let one_sided = Parameters { rocking: Rocking::OneSidedNegative, restitution: 0.3, ..parameters };
    let wall = Wall::new(&one_sided).unwrap();
    assert!(wall.stated(1.0)[0] < 0.0 && wall.stated(1.0)[1] == 0.0 && wall.stated(-1.0)[0] > 0.0);
    let mut simulation = Simulation::new(&one_sided, None, 0.0, Support::default()).unwrap();
    simulation.place(-0.05, 0.0, Support::default());
    simulation.advance(&held(Support::default(), 2.0)).unwrap();
    assert!(simulation.progress().state.displacement <= 0.0 && simulation.progress().work.impacts > 0);
}

/// Small rotations of a squat body, and formulas of rectangles for a body that is none, are warned of.
#[test]
fn what_is_of_slender_rectangles_is_warned_of() {
    let gable = Part { height: 2.4, width: [6.0, 0.0], ..PRISM };
    for (thickness, is_squat) in [(0.3, false), (0.6, true)] {
        let part = Part { thickness: [thickness; 2], ..gable };
        for (source, is_of_rectangles) in
            [(RestitutionSource::Impulses, false), (RestitutionSource::Calibrated, true)]
        {
            let parameters = Parameters { restitution_source: source, ..of_parts(&[part], &[], &[]) };
            let wall = Wall::new(&parameters).unwrap();
            let told: Vec<_> = wall.warnings().iter().map(ToString::to_string).collect();
            let told = told.join("\n");
            assert_eq!(told.contains("the slenderness angle of this body is 0.359 rad"), is_squat, "{told}");
            assert_eq!(told.contains("; kinematics = trigonometric has full ones, for force"), is_squat);
            let full = Parameters { kinematics: Kinematics::Trigonometric, ..parameters.clone() };
            let full = Wall::new(&full).unwrap();
            assert!(!full.warnings().iter().any(|told| told.to_string().contains("small rotations")));
            let by_impulses = "the restitution of this body is by impulses, times the ratio measured";
            assert_eq!(told.contains(by_impulses), is_of_rectangles, "{told}");
        }
    }
}

/// The base bears the inertia of the masonry and of what moves along, less the thrusts, also at rest.
#[test]
fn the_base_bears_masses_and_thrusts() {
    let load = Load { moving_mass: Some(0.4), thrust: 300.0, ..Load::resting(9.81e3, 2.0, 0.2) };
    let parameters = of_parts(&[PRISM], &[], &[load]);
    let support = Support::rigid(-0.3);
    let mut simulation = Simulation::new(&parameters, None, 0.0, support).unwrap();
    let at_rest = simulation.outputs(support).reactions.bottom;
    assert!((at_rest - (-0.3 * 1750.0 - 300.0)).abs() < 1e-9, "{at_rest}");
    simulation.place(0.02, 0.0, support);
    let outputs = simulation.outputs(support);
    // ü z/z_G of the load at 2 m over the centroid at 1.5 m
    let expected = -0.3 * 1750.0 + outputs.acceleration * (1350.0 + 400.0 * 2.0 / 1.5) - 300.0;
    assert!((outputs.reactions.bottom - expected).abs() < 1e-9, "{outputs:?}");
    let step = simulation.advance(&held(support, 1e-3)).unwrap();
    let mean = step.impulses.bottom / 1e-3;
    assert!((mean - expected).abs() < 1e-2 * expected.abs(), "{mean} for {expected}");
}
