//! Tests the couple of the contacts of a strip wall: how its reactions are split between the supports.

use nalgebra::{Matrix4, Vector4};
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, EccentricityMode, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Ends, Parameters, Support};

/// A strip of 3 m and 1800 kg/m³ whose force jumps at u = 0.
fn rigid() -> Parameters {
    Parameters {
        mechanism: Mechanism::VerticalSpanning,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        height: 3.0,
        thickness: 0.25,
        density: 1800.0,
        u_start: 0.0,
        ..Parameters::default()
    }
}

fn bilinear() -> Parameters {
    let (force_law, damping_model) = (ForceLaw::Bilinear, DampingModel::ConstantCoefficient);
    Parameters { force_law, damping_model, impact: Impact::None, a1: 0.05, xi: 0.05, ..rigid() }
}

fn placed(parameters: &Parameters, [u, v]: [f64; 2], support: Support) -> Simulation {
    let mut simulation = Simulation::new(parameters, None, 0.0, support).unwrap();
    simulation.place(u, v, support);
    simulation
}

/// Moments of the whole wall about its toe, by hand: R_t h = ∫z a dm + ΣP (x − x_A) − ΣP φ u.
#[test]
fn reactions_have_the_values_of_moments_about_the_toe() {
    let (overburden, u) = (1e4, 0.05);
    let eccentric = Parameters { hinge_ratio: 0.6, overburden, overburden_eccentricity: 0.05, ..rigid() };
    for (parameters, u, ground, bottom, top) in [
        // a start of 0 is at rest
        (rigid(), 1e-90, -2.0, -2544.75, -1441.12),
        (Parameters { overburden, ..rigid() }, u, -4.0, -4232.47, -2516.23),
        (eccentric, u, 3.0, -2620.94, -1802.97),
    ] {
        let support = Support::rigid(ground);
        let found = placed(&parameters, [u, 0.0], support).outputs(support).reactions;
        // to the digits shown
        assert!((found.bottom - bottom).abs() <= 5.1e-3 && (found.top - top).abs() <= 5.1e-3, "{found:?}");
    }
}

/// A wall about to rock under a uniform inertial load q has R_b = q h/2 + (W + O) b/(2h), on both sides, and
/// half of q h without a load: it bears under its centre.
#[test]
fn a_wall_about_to_rock_bears_on_its_edge() {
    let parameters = Parameters { overburden: 1e4, ..rigid() };
    let simulation = Simulation::new(&parameters, None, 0.0, Support::default()).unwrap();
    let body = simulation.wall().body();
    for share in [1.0, -1.0, 0.5, 0.0] {
        let ground = -share * body.strength.positive / (body.participation * body.effective_mass);
        let Ends { bottom, top } = simulation.outputs(Support::rigid(ground)).reactions;
        let edge = share * (body.weight + 1e4) * 0.25 / 6.0;
        let half = body.mass * ground / 2.0;
        for (found, expected) in [(bottom, half - edge), (top, half + edge)] {
            assert!((found - expected).abs() <= 1e-14 * body.weight, "{share}: {found} for {expected}");
        }
        // and starts to rock with these forces: on the line from the edge of the band on
        if share.abs() == 1.0 {
            let support = Support::rigid(ground);
            let moving = placed(&parameters, [1e-90 * share, 0.0], support).outputs(support).reactions;
            assert!((moving.bottom - bottom).abs() <= 1e-13 * body.weight, "{moving:?}");
        }
    }
}

/// Two bodies by Newton and Euler, each with its weight and the forces at its contacts, small rotations:
/// returns R_b, R_t and ü. `damper` is the moment between the bodies [N m].
fn newton_euler(parameters: &Parameters, u: f64, damper: f64, support: Support) -> [f64; 3] {
    let Parameters { height: h, thickness: b, overburden: o, overburden_eccentricity: c, .. } = *parameters;
    let Support { bottom, top, drift: d } = support;
    let (h1, h2) = (parameters.hinge_ratio * h, h - parameters.hinge_ratio * h);
    let [m1, m2] = [h1, h2].map(|part| parameters.density * part * b * parameters.width);
    let (side, g) = (u.signum(), parameters.gravity);
    let c = if parameters.eccentricity_mode == EccentricityMode::FollowsPivot { side * c } else { c };
    // places across the wall: toe, contact at the hinge, load, centroids
    let middle = d * h1 / h + u;
    let (toe, contact, load) = (side * b / 2.0, middle - side * b / 2.0, d + c);
    let [first, second] = [middle / 2.0, f64::midpoint(middle, d)];
    let (at_hinge, at_base) = (m2 * g + o, (m1 + m2) * g + o);
    // the hinge moves with the chord and with ü
    let chord = bottom * h2 / h + top * h1 / h;
    // unknown: R_b, the force of the lower body on the upper one, R_t, ü
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        1.0, -1.0, 0.0, -m1 / 2.0,
        -h1 / 2.0, -h1 / 2.0, 0.0, -m1 * h1 / 12.0,
        0.0, 1.0, 1.0, -m2 / 2.0,
        0.0, -h2 / 2.0, h2 / 2.0, m2 * h2 / 12.0,
    );
    let right = Vector4::new(
        m1 * (bottom + chord) / 2.0,
        m1 * h1 / 12.0 * (chord - bottom) + at_base * (toe - first) - at_hinge * (contact - first) + damper,
        m2 * (chord + top) / 2.0,
        m2 * h2 / 12.0 * (top - chord) + at_hinge * (contact - second) - o * (load - second) - damper,
    );
    let found = matrix.lu().solve(&right).unwrap();
    [found[0], found[2], found[3]]
}

/// The reactions and ü are those of two bodies, with loads, damping, drift, two support motions and on both
/// sides.
#[test]
fn reactions_are_those_of_two_bodies() {
    let damped = Parameters { damping_model: DampingModel::FreeStandingBlock, c_bar: 0.4, ..rigid() };
    for (parameters, hinge_ratio) in [(&rigid(), 0.5), (&damped, 0.6), (&damped, 0.35)] {
        for eccentricity_mode in EccentricityMode::ALL.iter().copied() {
            let (overburden, overburden_eccentricity) = (7e3, 0.04);
            let parameters = Parameters {
                hinge_ratio,
                eccentricity_mode,
                overburden,
                overburden_eccentricity,
                ..parameters.clone()
            };
            for (u, v) in [(0.05, 0.3), (-0.08, 0.2), (-0.02, -0.4)] {
                for (bottom, top, drift) in [(1.0, 1.0, 0.0), (2.0, -3.0, 0.0), (-1.5, 0.7, 0.02)] {
                    let support = Support { bottom, top, drift };
                    let simulation = placed(&parameters, [u, v], support);
                    let found = simulation.outputs(support);
                    let h1 = hinge_ratio * parameters.height;
                    // the damper does half the work of Eq. (12)
                    let turn = 1.0 / h1 + 1.0 / (parameters.height - h1);
                    let damper = 0.5 * found.damping_force / turn;
                    let expected = newton_euler(&parameters, u, damper, support);
                    let size = simulation.wall().body().weight;
                    let values = [found.reactions.bottom, found.reactions.top, found.acceleration];
                    for ((found, expected), size) in values.iter().zip(expected).zip([size, size, 10.0]) {
                        // a few dozen roundings
                        let error = (found - expected).abs();
                        assert!(error <= 1e-14 * size, "{u} {support:?}: {found:?} for {expected:?}");
                    }
                }
            }
        }
    }
}

/// The toe moves with the force that the law spreads: M_A goes through its mean at u = 0, and reaches the
/// edge at the end of the elastic branch. Nothing jumps there, and on the softening line it is at a₃.
#[test]
fn the_toe_moves_with_the_force() {
    let overburden = 5e3;
    for eccentricity_mode in EccentricityMode::ALL.iter().copied() {
        let (a3, overburden_eccentricity) = (0.8, 0.03);
        let wall = Parameters { a3, overburden, overburden_eccentricity, eccentricity_mode, ..bilinear() };
        let simulation = Simulation::new(&wall, None, 0.0, Support::default()).unwrap();
        let body = simulation.wall().body().clone();
        let c = [0.03, if eccentricity_mode == EccentricityMode::FixedToWall { 0.03 } else { -0.03 }];
        let edges = [1.0, -1.0].map(|side: f64| {
            let c = c[usize::from(side < 0.0)];
            side * (body.weight + overburden) * 0.125 - overburden * c
        });
        let mean = f64::midpoint(edges[0], edges[1]);
        let moment = |u: f64| {
            let found = placed(&wall, [u, 0.0], Support::default()).outputs(Support::default());
            // of the top reaction what is neither inertia nor weight
            let inertia = body.mass * body.support_weights[1] / 2.0 * found.acceleration;
            (found.reactions.top - inertia) * 3.0 + body.weight * u / 2.0
        };
        for (side, edge) in [(1.0, edges[0]), (-1.0, edges[1])] {
            let end = 0.05 * body.instability.of(side);
            for (u, share) in [(0.0, 0.0), (0.25, 0.25), (1.0 - 1e-9, 1.0), (1.0 + 1e-9, 1.0), (9.0, 1.0)] {
                let expected = mean + share * a3 * (edge - mean);
                let found = moment(side * u * end);
                // 1e-9 of the elastic branch, and rounding
                assert!((found - expected).abs() <= 2e-9 * edge.abs(), "{side} {u}: {found} {expected}");
            }
        }
    }
}

/// The impulses of steps are the integrals of the reactions: by Simpson's rule where nothing happens, and
/// one step across corners, impacts and rests has those of its parts.
#[test]
fn impulses_are_integrals_over_corners_impacts_and_rests() {
    let eccentric = Parameters { overburden: 5e3, overburden_eccentricity: 0.03, ..bilinear() };
    let ratio = Parameters { damping_model: DampingModel::ConstantRatio, ..eccentric.clone() };
    let trilinear = Parameters { force_law: ForceLaw::Trilinear, d1: 0.7, ..eccentric.clone() };
    let loaded = Parameters { overburden: 5e3, overburden_eccentricity: 0.03, ..rigid() };
    let step = 2e-4;
    for (parameters, rests) in [(eccentric, false), (ratio, false), (trilinear, false), (loaded, true)] {
        let at = |t: f64| {
            let pulse = 7.0 * libm::sin(11.0 * t) * libm::exp(-1.5 * t);
            Support { bottom: pulse, top: 1.2 * pulse, drift: 2e-3 * libm::sin(3.0 * t) }
        };
        let mut fine = Simulation::new(&parameters, None, 0.0, at(0.0)).unwrap();
        let size = fine.wall().body().weight;
        let (mut quiet, mut events, mut resting) = (0, 0, 0);
        for part in 0..5000_u32 {
            let start = 4.0 * step * f64::from(part);
            let ends = [at(start), at(start + 4.0 * step)];
            let support = |quarter: u32| ends[0].towards(ends[1], f64::from(quarter) / 4.0);
            let mut whole = fine.clone();
            let (mut sum, mut simpson, before) = (Ends::default(), Ends::default(), *fine.progress());
            for quarter in 0..=4 {
                let weight = step / 3.0 * [1.0, 4.0, 2.0, 4.0, 1.0][quarter as usize];
                let reactions = fine.outputs(support(quarter)).reactions;
                simpson.bottom += weight * reactions.bottom;
                simpson.top += weight * reactions.top;
                if quarter < 4 {
                    let [from, to] = [support(quarter), support(quarter + 1)];
                    let segment = Segment { duration: step, from, to };
                    let impulses = fine.advance(&segment).unwrap().impulses;
                    sum.bottom += impulses.bottom;
                    sum.top += impulses.top;
                }
            }
            let [from, to] = ends;
            let done = whole.advance(&Segment { duration: 4.0 * step, from, to }).unwrap().impulses;
            let apart = |other: Ends| (done.bottom - other.bottom).abs().max((done.top - other.top).abs());
            // velocities are below 1 m/s, and rounding of u grows by little in a step
            assert!(apart(sum) <= 1e-13 * size, "{start} s: {done:?} for {sum:?}");
            let after = fine.progress();
            let bends = body_bends(&fine, ends);
            if [before, *after]
                .map(|p| (p.state.phase, p.work.corners, p.work.impacts))
                .windows(2)
                .all(|pair| pair[0] == pair[1])
                && before.state.branch == after.state.branch
                && !bends
            {
                // Simpson's rule leaves out h⁵/2880 of the fourth derivative, ω₁⁴ of R and more
                assert!(apart(simpson) <= 1e-10 * size, "{start} s: {done:?} for {simpson:?}");
                quiet += 1;
            } else {
                events += 1;
            }
            resting += i32::from(before.state.phase == rocking_wall::solver::Phase::Resting);
        }
        assert!(quiet > 4000 && events > 3, "{quiet} quiet, {events} with events");
        assert_eq!(resting > 100, rests, "{resting} at rest");
        assert!(!fine.progress().state.overturned);
    }
}

/// Whether the forcing changes its sign: there the reactions at rest bend.
fn body_bends(simulation: &Simulation, ends: [Support; 2]) -> bool {
    let body = simulation.wall().body();
    body.forcing(ends[0]) * body.forcing(ends[1]) < 0.0
}

/// Reactions are linear on a branch, so that differences give their derivatives to rounding.
#[test]
fn derivatives_are_differences() {
    let eccentric = Parameters { overburden: 5e3, overburden_eccentricity: 0.03, ..bilinear() };
    let loaded = Parameters { overburden: 5e3, overburden_eccentricity: 0.03, ..rigid() };
    let change = Support { bottom: 0.3, top: -0.2, drift: 1e-4 };
    let support = Support { bottom: 0.4, top: 0.6, drift: 2e-3 };
    for (parameters, u) in [(&eccentric, 2e-3), (&eccentric, -2e-3), (&eccentric, 0.09), (&loaded, -0.03)] {
        let motion = [1e-4, 0.01];
        let along = placed(parameters, [u, 0.1], support).derivative(support, motion, change).reactions;
        let [ahead, behind] = [1.0, -1.0].map(|part| {
            let moved = support.towards(
                Support {
                    bottom: support.bottom + change.bottom,
                    top: support.top + change.top,
                    drift: support.drift + change.drift,
                },
                part,
            );
            let place = [u + part * motion[0], 0.1 + part * motion[1]];
            placed(parameters, place, moved).outputs(moved).reactions
        });
        for (along, ahead, behind) in
            [(along.bottom, ahead.bottom, behind.bottom), (along.top, ahead.top, behind.top)]
        {
            assert!((along - (ahead - behind) / 2.0).abs() <= 1e-11, "{u}: {along}");
        }
    }
    // at rest the holding force moves the toe
    for ground in [0.4, -0.4] {
        let support = Support::rigid(ground);
        let simulation = Simulation::new(&loaded, None, 0.0, support).unwrap();
        let along = simulation.derivative(support, [0.0; 2], change).reactions;
        let moved = Support { bottom: ground + 0.3, top: ground - 0.2, drift: 1e-4 };
        let [now, ahead] = [support, moved].map(|support| simulation.outputs(support).reactions);
        assert!((along.bottom - (ahead.bottom - now.bottom)).abs() <= 1e-11, "{ground}");
        assert!((along.top - (ahead.top - now.top)).abs() <= 1e-11, "{ground}");
    }
}

/// Demands hold the reactions of a fine history, also where these bend at rest.
#[test]
fn extremes_hold_the_reactions_at_rest() {
    let loaded = Parameters { overburden: 2e4, overburden_eccentricity: 0.06, ..rigid() };
    let ends = [-3.0, 4.0].map(Support::rigid);
    let mut simulation = Simulation::new(&loaded, None, 0.0, ends[0]).unwrap();
    let mut demands = simulation.demands(ends[0], &[]);
    let fine: Vec<Ends> = (0..=700)
        .map(|part| simulation.outputs(ends[0].towards(ends[1], f64::from(part) / 700.0)).reactions)
        .collect();
    let segment = Segment { duration: 1.0, from: ends[0], to: ends[1] };
    simulation.advance_watched(&segment, &mut demands).unwrap();
    assert_eq!(simulation.progress().work.pieces, 0, "it rests");
    for (extremes, pick) in [
        (demands.reaction_bottom, (|ends: &Ends| ends.bottom) as fn(&Ends) -> f64),
        (demands.reaction_top, |ends: &Ends| ends.top),
    ] {
        let [low, high] = [f64::min, f64::max].map(|most| fine.iter().map(pick).reduce(most).unwrap());
        assert!((extremes.lowest.value - low).abs() <= 1e-9, "{extremes:?}, {low}");
        assert!((extremes.highest.value - high).abs() <= 1e-9, "{extremes:?}, {high}");
    }
}
