//! Tests where bodies in full rotations stand, fall and lie, and limits and derivatives of their equation.

use proptest::prelude::*;
use rocking_wall::simulation::{Outputs, Simulation};
use rocking_wall::solver::Segment;
use rocking_wall::variables::{Mechanism, Rocking};
use rocking_wall::wall::{Kinematics, Load, ParameterError, Parameters, Part, Support, Wall};

use crate::bodies::{PRISM, of_parts};
use crate::configuration::configuration;
use crate::full_bodies::{Place, Reference, cases, reference_of};
use crate::newton_euler::{at_shares, close, loads, stacks, whole};

/// Free motion keeps its energy between impacts.
#[test]
fn free_motion_of_bodies_keeps_its_energy() {
    for (name, parameters) in cases() {
        let wall = Wall::new(&parameters).unwrap();
        let u_start = 0.4 * wall.body().instability.least();
        let parameters = Parameters { restitution: 1.0, u_start, ..parameters };
        let still = Support::default();
        let mut simulation = Simulation::new(&parameters, None, 0.0, still).unwrap();
        let energy = |simulation: &Simulation| {
            let state = simulation.progress().state;
            simulation.wall().energy(state.displacement, state.velocity)
        };
        let (mut last, mut impacts) = (energy(&simulation), 0);
        for index in 0..1000 {
            simulation.advance(&Segment { duration: 0.01, from: still, to: still }).unwrap();
            let now = simulation.progress().work.impacts;
            if now > impacts {
                // the same u̇ with the μ of the other side
                impacts = now;
            } else {
                let change = energy(&simulation) / last - 1.0;
                assert!(change.abs() < 1e-12, "{name}, step {index}: {change}");
            }
            last = energy(&simulation);
        }
        assert!(impacts > 4, "{name}: {impacts}");
    }
}

/// M₀ and K of the wall about the toe of the side of `sign`, thrusts in both.
fn moments(reference: &Reference, sign: f64) -> [f64; 2] {
    let d = |p: &Place| reference.arm(sign, p);
    [
        reference.sum(|p| p.force * d(p) - sign * p.thrust * p.z),
        reference.sum(|p| p.force * p.z + sign * p.thrust * d(p)),
    ]
}

/// At u = 0 the force is F₀; it vanishes where tan θ = M₀/K; and the body lies flat at u = z_G + x.
#[test]
fn bodies_stand_fall_and_lie_where_their_moments_say() {
    for (name, parameters) in cases() {
        let (wall, reference) = (Wall::new(&parameters).unwrap(), reference_of(&parameters));
        let (body, rotations) = (wall.body(), wall.rotations().unwrap());
        for sign in [1.0, -1.0] {
            let ([moment, overturning], [x, z]) = (moments(&reference, sign), reference.centroid(sign));
            let (turned, onset) = (libm::atan2(moment, overturning), moment / z);
            let force = sign * wall.restoring(wall.branch_of(0.0, sign), 0.0) * body.effective_mass;
            assert!((force / onset - 1.0).abs() < 1e-14, "{name}: {force} for {onset}");
            let u_ins = body.instability.of(sign);
            let expected = z * libm::sin(turned) + x * (1.0 - libm::cos(turned));
            assert!((u_ins / expected - 1.0).abs() < 1e-13, "{name}: {u_ins} for {expected}");
            assert!((rotations.rotation(sign * u_ins) / (sign * turned) - 1.0).abs() < 1e-13);
            let (landing, departure) = (body.landing.of(sign), body.departure.of(sign));
            assert!((landing / (z + x) - 1.0).abs() < 1e-14, "{name}: {landing}");
            assert_eq!(departure, u_ins.max(landing / 2.0), "{name}");
            // as a half turn it falls to where it lies
            let u_start = sign * 0.99 * u_ins;
            let pushed = Parameters { u_start, u_dot_start: sign * 0.1, ..parameters.clone() };
            let still = Support::default();
            let mut simulation = Simulation::new(&pushed, None, 0.0, still).unwrap();
            simulation.advance(&Segment { duration: 60.0, from: still, to: still }).unwrap();
            let state = simulation.progress().state;
            assert_eq!((state.displacement, state.velocity), (sign * landing, 0.0), "{name}");
        }
    }
}

/// A rectangle that is cut into two parts moves as the rectangle, whose equation rounds otherwise.
#[test]
fn two_parts_rotate_as_a_rectangle() {
    let [lower, upper] = [(0.0, 1.1), (1.1, 1.9)].map(|(base, height)| Part { base, height, ..PRISM });
    let parts = Parameters {
        kinematics: Kinematics::Trigonometric,
        restitution: 0.93,
        overburden: 5e3,
        overburden_eccentricity: 0.03,
        u_start: 0.02,
        tolerance: 1e-12,
        ..of_parts(&[lower, upper], &[], &[])
    };
    let rectangle = Parameters { profile: None, ..parts.clone() };
    let [mut parts, mut rectangle] = [parts, rectangle]
        .map(|parameters| Simulation::new(&parameters, None, 0.0, Support::default()).unwrap());
    let sides = |simulation: &Simulation| simulation.wall().body().instability;
    let u_ins = sides(&rectangle);
    for sign in [1.0, -1.0] {
        assert!((sides(&parts).of(sign) / u_ins.of(sign) - 1.0).abs() < 1e-13);
    }
    for index in 0..300 {
        let ground = |index: i32| Support::rigid(0.3 * libm::sin(0.11 * f64::from(index)));
        let segment = Segment { duration: 0.02, from: ground(index), to: ground(index + 1) };
        let outputs = [&mut parts, &mut rectangle].map(|simulation| {
            simulation.advance(&segment).unwrap();
            simulation.outputs(segment.to)
        });
        let apart = outputs[0].displacement - outputs[1].displacement;
        // each step may leave 1e-16 of the scale, the tolerance, and impacts let it grow
        assert!(apart.abs() <= 1e-11 * u_ins.most(), "{index}: {outputs:?}");
    }
    assert!(rectangle.progress().work.impacts > 3);
}

/// Small rotations are the limit of slender bodies: ü differs by O(α²).
#[test]
fn slender_bodies_have_small_rotations() {
    let error = |thickness: f64| {
        let gable = Part { height: 2.4, width: [6.0, 0.0], thickness: [thickness; 2], ..PRISM };
        let (force, inside) = (2e4 * thickness, 0.2 * thickness);
        let load = Load { moving_mass: Some(0.7), ..Load::resting(force, 1.5, inside) };
        let full = of_parts(&[gable], &[], &[load]);
        let full = Parameters { kinematics: Kinematics::Trigonometric, ..full };
        let small = Parameters { kinematics: Kinematics::Linear, ..full.clone() };
        let [full, small] = [full, small].map(|parameters| {
            let wall = Wall::new(&parameters).unwrap();
            let u = 0.5 * wall.body().instability.positive;
            wall.acceleration(wall.branch_of(u, 1.0), u, 0.2 * thickness, -0.5 * thickness)
        });
        (full / small - 1.0).abs()
    };
    let errors = [0.08, 0.04, 0.02, 0.01].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
}

/// The extremes of the reaction of a façade whose floors move along are those of many instants.
#[test]
fn extremes_of_reactions_are_those_of_many_instants() {
    let (name, facade) = cases().pop().unwrap();
    assert_eq!(name, "facade");
    let u_start = 0.4 * Wall::new(&facade).unwrap().body().instability.least();
    let facade = Parameters { u_start, u_dot_start: -0.05, ..facade };
    let ground = |time: f64| Support::rigid(0.03 * libm::sin(5.0 * time));
    let [mut long, mut short] = [ground(0.0); 2].map(|at| Simulation::new(&facade, None, 0.0, at).unwrap());
    let mut demands = long.demands(ground(0.0), &[]);
    let (step, parts) = (0.2, 500);
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for index in 0..50 {
        let time = f64::from(index) * step;
        let [from, to] = [ground(time), ground(time + step)];
        long.advance_watched(&Segment { duration: step, from, to }, &mut demands).unwrap();
        for part in 0..parts {
            let [from, to] =
                [part, part + 1].map(|part| from.towards(to, f64::from(part) / f64::from(parts)));
            let force = short.outputs(from).reactions.bottom;
            (lowest, highest) = (lowest.min(force), highest.max(force));
            short.advance(&Segment { duration: step / f64::from(parts), from, to }).unwrap();
        }
    }
    let progress = long.progress();
    assert!(progress.work.impacts > 1 && !progress.state.overturned);
    let found = [demands.reaction_bottom.lowest.value, demands.reaction_bottom.highest.value];
    let size = highest - lowest;
    for (found, sampled) in found.into_iter().zip([lowest, highest]) {
        // samples miss an extreme, and a jump at an impact, by their share of a step
        assert!((found - sampled).abs() <= 1e-3 * size, "{found} for {sampled}");
    }
    assert!(found[0] <= lowest + 1e-9 * size && found[1] >= highest - 1e-9 * size, "{found:?}");
}

/// Rates of ü, of the force and of the reactions with u, u̇ and the ground, by central differences.
fn rates(simulation: &mut Simulation, [u, v, ground]: [f64; 3]) -> [[f64; 4]; 3] {
    let delta = 1e-6;
    [0, 1, 2].map(|index| {
        let [one, other] = [delta, -delta].map(|step| {
            let mut at = [u, v, ground];
            at[index] += step;
            simulation.place(at[0], at[1], Support::rigid(ground));
            numbers(&simulation.outputs(Support::rigid(at[2])))
        });
        [0, 1, 2, 3].map(|pick| (one[pick] - other[pick]) / (2.0 * delta))
    })
}

fn numbers(outputs: &Outputs) -> [f64; 4] {
    let Outputs { acceleration, restoring_force, reactions, .. } = outputs;
    [*acceleration, *restoring_force, reactions.bottom, reactions.top]
}

/// The derivatives of the outputs are those of small changes, of bodies, a rectangle and a strip.
#[test]
fn derivatives_are_those_of_the_outputs() {
    let (_, gable) = cases().remove(0);
    let rectangle = Parameters { profile: None, overburden: 5e3, overburden_eccentricity: 0.02, ..gable };
    let strip = Parameters { mechanism: Mechanism::VerticalSpanning, hinge_ratio: 0.6, ..rectangle.clone() };
    let walls = cases().into_iter().chain([("rectangle", rectangle), ("strip", strip)]);
    for (name, parameters) in walls {
        let mut simulation = Simulation::new(&parameters, None, 0.0, Support::default()).unwrap();
        let (u_ins, weight) = (simulation.wall().body().instability, simulation.wall().body().weight);
        for (u, v) in [(0.3 * u_ins.positive, 0.4), (-0.6 * u_ins.negative, 0.2)] {
            let expected = rates(&mut simulation, [u, v, 0.7]);
            let support = Support::rigid(0.7);
            simulation.place(u, v, support);
            let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            for ([du, dv, da], expected) in units.into_iter().zip(expected) {
                let found = numbers(&simulation.derivative(support, [du, dv], Support::rigid(da)));
                for index in 0..4 {
                    // rounding of 1e-16/1e-6 of the size, and the third order of a central difference
                    let size = if index == 0 { 10.0 } else { weight };
                    let error = (found[index] - expected[index]).abs();
                    assert!(error <= 1e-8 * size, "{name}, {index}: {found:?} for {expected:?}");
                }
            }
        }
    }
}

/// Transverse walls hold the side to which a thrust would overturn the body; the other has its own equation.
#[test]
fn a_body_that_transverse_walls_hold_rocks_to_its_own_side() {
    let load = Load { moving_mass: Some(1.0), thrust: 1e3, ..Load::resting(5e3, 3.0, 0.125) };
    let [lower, upper] = [(0.0, 2.0), (2.0, 1.0)].map(|(base, height)| Part { base, height, ..PRISM });
    let of = |thrust: f64, rocking: Rocking| Parameters {
        kinematics: Kinematics::Trigonometric,
        rocking,
        restitution: 0.5,
        ..of_parts(&[lower, upper], &[], &[Load { thrust, ..load }])
    };
    assert!(Wall::new(&of(1e3, Rocking::TwoSided)).is_err());
    let free = of(1e3, Rocking::OneSidedNegative);
    let still = Support::default();
    let mut simulation = Simulation::new(&free, None, 0.0, still).unwrap();
    simulation.place(-0.05, 0.0, still);
    simulation.advance(&Segment { duration: 20.0, from: still, to: still }).unwrap();
    let progress = simulation.progress();
    assert!(progress.work.impacts > 5 && progress.state.displacement == 0.0, "{progress:?}");
    // with a thrust that both sides bear it is the two-sided body until it meets the transverse walls
    let [one, two] = [Rocking::OneSidedNegative, Rocking::TwoSided].map(|rocking| {
        let mut simulation = Simulation::new(&of(200.0, rocking), None, 0.0, still).unwrap();
        simulation.place(-0.05, 0.0, still);
        simulation.advance(&Segment { duration: 0.3, from: still, to: still }).unwrap();
        simulation.outputs(still)
    });
    assert!(one.displacement < -0.01 && one == two, "{one:?} {two:?}");
}

/// A wall that leans beyond its toe and that a load holds is refused.
#[test]
fn a_centroid_beyond_its_toe_is_refused() {
    let leaning = Part { outer: [0.0, -0.6], ..PRISM };
    let load = Load::resting(2e4, 1.5, 0.25);
    let small = Parameters { restitution: 0.9, ..of_parts(&[leaning], &[], &[load]) };
    Wall::new(&small).unwrap();
    let full = Parameters { kinematics: Kinematics::Trigonometric, ..small };
    let error = Wall::new(&full).unwrap_err();
    assert!(matches!(error, ParameterError::BeyondToe { side: "u > 0", .. }), "{error}");
    assert!(error.to_string().contains("from the toe is -0.175 m and must be at"), "{error}");
    // a side that transverse walls hold needs no motion of its own
    Wall::new(&Parameters { rocking: Rocking::OneSidedNegative, ..full }).unwrap();
}

proptest! {
    #![proptest_config(configuration())]

    /// Random bodies at random motions have ü and the reaction of the moments about their toe and of their
    /// momentum.
    #[test]
    fn random_bodies_turn_as_their_moments_say(
        parts in stacks(), loads in loads(),
        share in 0.01_f64..0.8, v in -0.5_f64..0.5, ground in -3.0_f64..3.0,
    ) {
        let height = parts.iter().map(Part::top).fold(0.0, f64::max);
        let loads = at_shares(&loads, height);
        let full = Parameters { kinematics: Kinematics::Trigonometric, ..of_parts(&parts, &[], &loads) };
        let wall = Wall::new(&full);
        prop_assume!(wall.is_ok());
        let body = wall.unwrap().body().clone();
        let [m, own, mz, ..] = whole(&parts, &[], [0.0, height]);
        let [moving, mx, first, mx2, mz2] = whole(&parts, &loads, [0.0, height]);
        for side in [1.0, -1.0] {
            let toe = if side > 0.0 { 0.0 } else { parts[0].thickness[0] };
            let arm = |x: f64| side * (x - toe);
            let (x, z) = (arm(own / m), mz / m);
            // θ from u
            let psi = libm::asin((share * (z + x) - x) / z.hypot(x));
            let theta = psi + libm::atan2(x, z);
            let (sine, cosine) = (libm::sin(theta), libm::cos(theta));
            let across = side * (mx - moving * toe);
            let inertia = mz2 + mx2 - 2.0 * mx * toe + moving * toe * toe;
            let up = |d: f64, z: f64| z * cosine + d * sine;
            let out = |d: f64, z: f64| z * sine - d * cosine;
            let loaded = |of: &dyn Fn(&Load) -> f64| loads.iter().map(of).sum::<f64>();
            let moment = m * 9.81 * out(x, z)
                + loaded(&|l| {
                    l.force * out(arm(l.inside), l.height) + side * l.thrust * up(arm(l.inside), l.height)
                })
                - side * ground * (first * cosine + across * sine);
            let (angular, rate) = (moment / inertia, v / (z.hypot(x) * libm::cos(psi)));
            let turned = |z: f64, d: f64| up(d, z) * angular - out(d, z) * rate * rate;
            let support = Support::rigid(ground);
            let mut simulation = Simulation::new(&full, None, 0.0, support).unwrap();
            simulation.place(side * share * (z + x), side * v, support);
            let outputs = simulation.outputs(support);
            close(side * outputs.acceleration, turned(z, x), 10.0)?;
            if !simulation.progress().state.departed && share * (z + x) < body.departure.of(side) {
                let expected = moving * ground + side * turned(first, across) - loaded(&|l| l.thrust);
                close(outputs.reactions.bottom, expected, body.weight)?;
            }
        }
    }
}
