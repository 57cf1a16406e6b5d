//! Tests bodies of parts, with openings, loads and thrusts, and bodies given by their integrals.

use crate::configuration::configuration;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{
    DampingModel, ForceLaw, Impact, Mechanism, RestitutionSource, Rocking, Solver,
};
use rocking_wall::wall::{
    Body, Hollow, Load, Opening, ParameterError, Parameters, Part, Profile, Sides, Support, Wall,
};

/// A prism of 1 m width on the ground.
const PRISM: Part =
    Part { base: 0.0, height: 3.0, thickness: [0.25; 2], width: [1.0; 2], outer: [0.0; 2], density: 1800.0 };
const RIGID: ForceLaw = ForceLaw::RigidLinear;

/// A rigid wall with impacts, of parts.
fn of_parts(parts: &[Part], openings: &[Opening], loads: &[Load]) -> Parameters {
    let mut parameters = Parameters {
        force_law: RIGID,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution_source: RestitutionSource::Impulses,
        u_start: 0.0,
        ..Parameters::default()
    };
    parameters.set_profile(Profile::new(parts.to_vec(), openings.to_vec(), loads.to_vec()).unwrap());
    parameters
}

/// Supports that keep their motion for some time [s].
fn held(support: Support, duration: f64) -> Segment {
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
    let floor = |force, height, inside, thrust| Load { force, height, inside, moving_mass: 1.0, thrust };
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
        (of_parts(&[battered], &[], &[]), [2880.0, 1.833_333_333_33, 3998.677_685_95, 0.720_238_095_238,
            4558.974_545_45, 3146.334_545_45, 15410.618_181_8, 0.295_833_333_333, 0.204_166_666_667,
            0.978_387_438_250, 0.968_984_798_183]),
        (of_parts(&[wide], &[window], &[]), [3240.0, 1.4625, 4578.461_538_46, 0.707_661_290_323,
            2716.615_384_62, 2716.615_384_62, 21732.923_076_9, 0.125, 0.125, 0.989_731_653_888,
            0.989_731_653_888]),
        (of_parts(&[stone, brick], &[], &[]), [2287.5, 1.168_032_786_89, 3360.238_227_15, 0.680_755_305_240,
            4133.753_289_47, 5472.301_973_68, 19212.110_526_3, 0.215_163_934_426, 0.284_836_065_574,
            0.932_338_147_006, 0.948_028_378_155]),
        (of_parts(&[facade], &[], &floors), [10368.0, 4.8, 19804.292_218_8, 0.729_411_170_456, 6856.88,
            9856.88, 29522.933_333_3, 0.232_256_054_051, 0.333_871_972_975, 0.995_386_965_496,
            0.993_899_098_848]),
        (of_parts(&[shaft, cap], &[flue], &[]), [882.6, 0.889_225_016_995, 1158.312_285_16, 0.761_970_680_366,
            2921.073_688_16, 2921.073_688_16, 9736.912_293_87, 0.3, 0.3, 0.845_888_721_662,
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

/// A rectangle of one part, as a parapet and as a strip, equals the rectangle by its size.
#[test]
fn one_part_is_a_rectangle() {
    for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
        for hinge_ratio in [0.5, 0.6] {
            let loads = Parameters { mechanism, hinge_ratio, ..of_parts(&[PRISM], &[], &[]) };
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
    let load = |force, height, inside, thrust| Load { force, height, inside, moving_mass: 0.5, thrust };
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

fn mass_of(load: &Load) -> f64 {
    load.moving_mass * load.force / 9.81
}

/// A thrust that overturns is refused by name, unless transverse walls hold that side.
#[test]
fn a_thrust_needs_a_side_that_bears_it() {
    let load = Load { force: 5e3, height: 3.0, inside: 0.125, moving_mass: 0.0, thrust: 1e3 };
    let parameters = of_parts(&[PRISM], &[], &[load]);
    let Err(error) = Wall::new(&parameters) else { panic!("there is a wall") };
    assert!(matches!(error, ParameterError::Overturns { side: "u > 0", .. }), "{error}");
    assert!(error.to_string().contains("thrusts of 1000 N overturn it"), "{error}");
    let one_sided = Parameters { rocking: Rocking::OneSidedNegative, restitution: 0.3, ..parameters };
    let wall = Wall::new(&one_sided).unwrap();
    assert!(wall.stated(1.0)[0] < 0.0 && wall.stated(1.0)[1] == 0.0 && wall.stated(-1.0)[0] > 0.0);
    let mut simulation = Simulation::new(&one_sided, None, 0.0, Support::default()).unwrap();
    simulation.place(-0.05, 0.0, Support::default());
    simulation.advance(&held(Support::default(), 2.0)).unwrap();
    assert!(simulation.progress().state.displacement <= 0.0 && simulation.progress().work.impacts > 0);
}

/// The base bears the inertia of the masonry and of what moves along, less the thrusts, also at rest.
#[test]
fn the_base_bears_masses_and_thrusts() {
    let load = Load { force: 9.81e3, height: 2.0, inside: 0.2, moving_mass: 0.4, thrust: 300.0 };
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

/// A polynomial in z by its coefficients.
fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// m, ∫x, ∫z, ∫x², ∫z² dm of a part between two heights, by the exact integrals of polynomials.
fn integrals(part: &Part, [from, to]: [f64; 2]) -> [f64; 5] {
    let line = |[bottom, top]: [f64; 2]| {
        let slope = (top - bottom) / part.height;
        vec![bottom - slope * part.base, slope]
    };
    let (t, w, o) = (line(part.thickness), line(part.width), line(part.outer));
    let over = |polynomial: &[f64]| {
        let term = |(power, c): (usize, &f64)| {
            let power = i32::try_from(power).unwrap() + 1;
            c * (to.powi(power) - from.powi(power)) / f64::from(power)
        };
        part.density * polynomial.iter().enumerate().map(term).sum::<f64>()
    };
    let area = times(&w, &t);
    let added = |a: &[f64], factor: f64, b: &[f64]| {
        let mut sum = a.to_vec();
        sum.resize(a.len().max(b.len()), 0.0);
        sum.iter_mut().zip(b).for_each(|(x, y)| *x += factor * y);
        sum
    };
    // x: o + t/2; x²: o² + o t + t²/3
    let middle = added(&o, 0.5, &t);
    let square = added(&added(&times(&o, &o), 1.0, &times(&o, &t)), 1.0 / 3.0, &times(&t, &t));
    [
        over(&area),
        over(&times(&area, &middle)),
        over(&times(&area, &[0.0, 1.0])),
        over(&times(&area, &square)),
        over(&times(&area, &[0.0, 0.0, 1.0])),
    ]
}

/// The sums over the parts of a body, with loads as points.
fn whole(parts: &[Part], loads: &[Load], range: [f64; 2]) -> [f64; 5] {
    let mut sums = [0.0; 5];
    for part in parts {
        let range = [part.base.max(range[0]), part.top().min(range[1])];
        if range[0] < range[1] {
            sums.iter_mut().zip(integrals(part, range)).for_each(|(sum, one)| *sum += one);
        }
    }
    for load in loads.iter().filter(|load| range[0] < load.height && load.height <= range[1]) {
        let (m, x, z) = (mass_of(load), load.inside, load.height);
        sums.iter_mut().zip([m, m * x, m * z, m * x * x, m * z * z]).for_each(|(sum, one)| *sum += one);
    }
    sums
}

/// Three stacked parts that taper, with steps on both faces.
fn stacks() -> impl Strategy<Value = Vec<Part>> {
    let part = (
        0.3_f64..2.0,
        [0.25_f64..0.6, 0.25..0.6],
        [0.5_f64..3.0, 0.5..3.0],
        [-0.05_f64..0.05, -0.05..0.05],
        1500.0_f64..2500.0,
    );
    prop::collection::vec(part, 1..4).prop_map(|parts| {
        let mut base = 0.0;
        let stacked = parts.into_iter().map(|(height, thickness, width, outer, density)| {
            let outer = if base == 0.0 { [0.0, outer[1]] } else { outer };
            let part = Part { base, height, thickness, width, outer, density };
            base += height;
            part
        });
        stacked.collect()
    })
}

fn loads() -> impl Strategy<Value = Vec<[f64; 5]>> {
    prop::collection::vec([0.0..2e4, 0.05_f64..1.0, 0.05..0.3, 0.0..1.0, -50.0..50.0], 0..3)
}

/// Loads at shares of a height.
fn at_shares(loads: &[[f64; 5]], height: f64) -> Vec<Load> {
    let load = |&[force, share, inside, moving_mass, thrust]: &[f64; 5]| Load {
        force,
        height: share * height,
        inside,
        moving_mass,
        thrust,
    };
    loads.iter().map(load).collect()
}

fn close(found: f64, expected: f64, scale: f64) -> Result<(), TestCaseError> {
    // the rounding of some dozen terms
    prop_assert!(
        (found - expected).abs() <= 1e-12 * scale.abs().max(expected.abs()),
        "{found} for {expected}"
    );
    Ok(())
}

proptest! {
    #![proptest_config(configuration())]

    /// One body: its constants by exact integrals, its acceleration by moments about the toe, and e by the
    /// impulses at the new toe.
    #[test]
    fn one_body_is_that_of_newton_and_euler(parts in stacks(), loads in loads(), share in -0.5_f64..0.5) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let loads = at_shares(&loads, height);
        let parameters = of_parts(&parts, &[], &loads);
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let body = wall.body();
        let [m, mx, mz, ..] = whole(&parts, &[], [0.0, height]);
        let (x_g, z_g, weight) = (mx / m, mz / m, m * 9.81);
        close(body.mass, m, 0.0)?;
        close(body.centroid_height, z_g, 0.0)?;
        let [moving, mx, mz, mx2, mz2] = whole(&parts, &loads, [0.0, height]);
        let [outer, inner] = [0.0, parts[0].thickness[0]];
        let sum = |of: &dyn Fn(&Load) -> f64| loads.iter().map(of).sum::<f64>();
        for side in [1.0, -1.0] {
            let toe = if side > 0.0 { outer } else { inner };
            let moment = weight * side * (x_g - toe)
                + sum(&|l| l.force * side * (l.inside - toe) - side * l.thrust * l.height);
            let overturning = weight * z_g + sum(&|l| l.force * l.height);
            // θ̈ of a small θ under a ground acceleration, u = θ z_G
            let u = side * share.abs() * body.instability.of(side);
            let ground = share;
            let theta = (-ground * mz - side * moment + overturning * u / z_g) / mz2;
            let support = Support::rigid(ground);
            let mut simulation = Simulation::new(&parameters, None, 0.0, support).unwrap();
            simulation.place(u, 0.0, support);
            close(simulation.outputs(support).acceleration, theta * z_g, moment * z_g / mz2)?;
            // impact: the body leaves `toe` for `other`; unknown are both impulses there and the new rate
            let other = if side > 0.0 { inner } else { outer };
            let (x, z) = (mx / moving, mz / moving);
            let inertia = mx2 + mz2 - moving * (x * x + z * z);
            // outwards is -x: a rate towards the outside moves the centroid by (z, x - toe) outwards and up
            #[rustfmt::skip]
            let matrix = Matrix3::new(
                1.0, 0.0, -moving * z,
                0.0, 1.0, -moving * (x - other),
                z, x - other, inertia,
            );
            let right = Vector3::new(-moving * z, -moving * (x - toe), inertia);
            let found = matrix.lu().solve(&right).unwrap()[2];
            close(body.impulses.unwrap().of(side), found, 1.0)?;
        }
    }

    /// A strip: e by the impulses at the base, at the hinge and at the top support.
    #[test]
    fn a_strip_loses_what_impulses_at_its_contacts_take(
        parts in stacks(), loads in loads(), hinge_ratio in 0.3_f64..0.7,
    ) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let loads = at_shares(&loads, height);
        let parameters = Parameters {
            mechanism: Mechanism::VerticalSpanning,
            hinge_ratio,
            restitution: 0.9,
            ..of_parts(&parts, &[], &loads)
        };
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let h1 = hinge_ratio * height;
        let h2 = height - h1;
        let holds_hinge = |part: &&Part| part.base < h1 && h1 < part.top();
        let section = parts.iter().find(holds_hinge).unwrap().section(h1);
        let bodies = [[0.0, h1], [h1, height]].map(|range| whole(&parts, &loads, range));
        for side in [1.0, -1.0] {
            let [toe, new_toe] = if side > 0.0 { [0.0, parts[0].thickness[0]] } else { [parts[0].thickness[0], 0.0] };
            let edges = [section.inner, section.outer];
            let [edge, new_edge] = if side > 0.0 { edges } else { [edges[1], edges[0]] };
            // per unit u̇ outwards: rates of turning, and velocities of the centroids outwards and up
            let velocity = |toe: f64, edge: f64| {
                let [lower, upper] = bodies.map(|[m, mx, mz, ..]| (mx / m, mz / m));
                let at_hinge = (edge - toe) / h1;
                let lower = [1.0 / h1, lower.1 / h1, (lower.0 - toe) / h1];
                let upper = [-1.0 / h2, (height - upper.1) / h2, at_hinge + (edge - upper.0) / h2];
                [lower, upper]
            };
            let [before, after] = [velocity(toe, edge), velocity(new_toe, new_edge)];
            // unknown: impulses at the base, at the hinge on the lower body, at the top; u̇ after the impact
            let mut matrix = Matrix6::zeros();
            let mut right = Vector6::zeros();
            let contacts = [(new_toe, 0.0), (new_edge, h1)];
            for (index, [m, mx, mz, mx2, mz2]) in bodies.into_iter().enumerate() {
                let (x, z) = (mx / m, mz / m);
                let inertia = mx2 + mz2 - m * (x * x + z * z);
                let row = 3 * index;
                // the base acts on the lower body, the hinge on both, the top on the upper one
                let impulses: &[(usize, (f64, f64), f64)] = if index == 0 {
                    &[(0, contacts[0], 1.0), (2, contacts[1], 1.0)]
                } else {
                    &[(2, contacts[1], -1.0)]
                };
                for &(column, (at_x, at_z), sign) in impulses {
                    matrix[(row, column)] += sign;
                    matrix[(row + 1, column + 1)] += sign;
                    // about the centroid, turning outwards; x counts inwards
                    matrix[(row + 2, column)] += sign * (at_z - z);
                    matrix[(row + 2, column + 1)] += sign * (at_x - x);
                }
                if index == 1 {
                    matrix[(row, 4)] += 1.0;
                    matrix[(row + 2, 4)] += height - z;
                }
                let [rate, out, up] = after[index];
                matrix[(row, 5)] = -m * out;
                matrix[(row + 1, 5)] = -m * up;
                matrix[(row + 2, 5)] = -inertia * rate;
                let [rate, out, up] = before[index];
                right[row] = -m * out;
                right[row + 1] = -m * up;
                right[row + 2] = -inertia * rate;
            }
            let found = matrix.lu().solve(&right).unwrap()[5];
            let e = wall.body().impulses.unwrap().of(side);
            prop_assert!((e - found).abs() <= 1e-10 * found.abs().max(1.0), "{e} for {found}");
        }
    }

    /// A free motion with impacts of different strength on both sides is the same in three solvers.
    #[test]
    fn solvers_agree_on_unlike_sides(parts in stacks(), loads in loads(), share in 0.2_f64..0.8) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let parameters = of_parts(&parts, &[], &at_shares(&loads, height));
        let wall = Wall::new(&parameters);
        prop_assume!(wall.is_ok());
        let wall = wall.unwrap();
        let end = 3.0 / wall.rocking_rate();
        let u_start = share * wall.body().instability.positive;
        let run = |solver| {
            let given = Parameters { solver, u_start, tolerance: 1e-13, newmark_step: 1e-4, ..parameters.clone() };
            let mut simulation = Simulation::new(&given, None, 0.0, Support::default()).unwrap();
            simulation.advance(&held(Support::default(), end)).unwrap();
            simulation.progress().state.displacement
        };
        let [exact, adaptive, newmark] = [Solver::Exact, Solver::Adaptive, Solver::Newmark].map(run);
        prop_assert!((exact - adaptive).abs() <= 1e-9 * u_start, "{exact}, {adaptive}");
        // of second order, and a passage of u = 0 is located within a step
        prop_assert!((exact - newmark).abs() <= 1e-3 * u_start, "{exact}, {newmark}");
    }
}
