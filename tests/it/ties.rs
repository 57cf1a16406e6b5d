//! Ties: the same motion by every solver and path, energy, forces, demands, refusals.

use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::ACCURACY;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism, TieSide};
use rocking_wall::wall::{Parameters, Support, Wall, Warning};
use scene::Scene;
use scene::response::Response;

use crate::configuration::{configuration, mostly};
use crate::properties::{COMPARED, motions, solvers_agree, splits, walls};
use crate::record_path::{batches_agree, records_agree};
use crate::{secant_models, still};

/// A parapet with a tie from 0.1 to 1000 times as stiff as the wall.
pub(crate) fn tied() -> impl Strategy<Value = Parameters> {
    let tie = (0.3_f64..1.0, -1.0_f64..3.0, prop_oneof![Just(0.0), 1e-3_f64..0.5], 0..3_usize);
    (walls(), tie).prop_map(|(parameters, (height, exponent, onset, side))| {
        let parapet = Parameters {
            mechanism: Mechanism::Parapet,
            thickness: parameters.thickness.max(0.03 * parameters.height),
            overburden_eccentricity: 0.0,
            ..parameters
        };
        let wall = Wall::new(&parapet).unwrap();
        let body = wall.body();
        let rigid = body.geometric_stiffness;
        let own = (wall.omega1().powi(2) * body.effective_mass).max(rigid);
        let lever = 2.0 * height;
        Parameters {
            tie_height: height * parapet.height,
            tie_stiffness: own * 10.0_f64.powf(exponent) / (lever * lever),
            tie_slack: lever * onset * body.instability.positive,
            tie_side: TieSide::ALL[side],
            ..parapet
        }
    })
}

#[test]
fn a_tied_wall_moves_alike_in_parts() {
    mostly(COMPARED, (tied(), motions(), 2_u32..7), splits);
}

#[test]
fn a_tied_wall_moves_alike_by_both_solvers() {
    mostly(COMPARED, (tied(), motions()), solvers_agree);
}

/// Free motion without damping keeps ½ m u̇² + ∫F du + ½ K (elongation)², F being that of the wall alone: the
/// power of the tie is the rate of its energy.
#[test]
fn the_tie_stores_energy() {
    mostly(0.6, (tied(), -0.9_f64..0.9, 1e-3_f64..0.2), |(parameters, start, step)| {
        let free = Parameters { damping_model: DampingModel::None, impact: Impact::None, ..parameters };
        let alone = Wall::new(&Parameters { tie_stiffness: 0.0, ..free.clone() }).unwrap();
        let u_start = start * alone.body().instability.of(start);
        let parameters = Parameters { u_start, ..free };
        let mut simulation = crate::start(&parameters);
        let (m, stiffness) = (alone.body().effective_mass, parameters.tie_stiffness);
        let energy = |simulation: &Simulation| {
            let state = simulation.progress().state;
            let force = simulation.outputs(Support::default()).tie_force;
            let stored = 0.5 * force * force / stiffness;
            (alone.energy(state.displacement, state.velocity) + stored / m, force)
        };
        let (first, _) = energy(&simulation);
        for count in 0..200 {
            simulation.advance(&still(step)).unwrap();
            let (now, force) = energy(&simulation);
            prop_assert!(force >= 0.0);
            if simulation.progress().state.departed {
                return Ok([count, 200]);
            }
            let pieces = simulation.progress().work.pieces as f64;
            // as in `energy_never_grows`
            let allowed = 1e-12_f64.max(32.0 * f64::EPSILON * pieces);
            prop_assert!((now - first).abs() <= allowed * first, "{:e}", (now - first) / first);
        }
        Ok([200, 200])
    });
}

proptest! {
    #![proptest_config(configuration())]

    #[test]
    fn a_tied_wall_moves_alike_over_records(
        parameters in tied(), motion in motions(), refinement in 1_u32..40,
    ) {
        records_agree(&parameters, &motion, refinement)?;
    }

    /// The force is K max(0, σ w − g₀), and the reaction is the total m (a + ü).
    #[test]
    fn the_tie_pulls_beyond_its_slack(parameters in tied(), u in -0.99_f64..0.99, a in -9.0_f64..9.0) {
        let wall = Wall::new(&parameters).unwrap();
        let u_start = u * wall.body().instability.of(u);
        let Parameters { tie_height, tie_stiffness, tie_slack, tie_side, height, .. } = parameters;
        let support = Support::rigid(a);
        let parameters = Parameters { u_start, ..parameters };
        let simulation = Simulation::new(&parameters, None, 0.0, support).unwrap();
        let outputs = simulation.outputs(support);
        let w = 2.0 * u_start * tie_height / height;
        let pull = |sigma: f64| tie_stiffness * (sigma * w - tie_slack).max(0.0);
        let expected = match tie_side {
            TieSide::Positive => pull(1.0),
            TieSide::Negative => pull(-1.0),
            TieSide::Both => pull(1.0).max(pull(-1.0)),
        };
        let rounding = 1e-14 * tie_stiffness * (w.abs() + tie_slack);
        prop_assert!((outputs.tie_force - expected).abs() <= rounding);
        let free = Parameters { tie_stiffness: 0.0, ..parameters.clone() };
        let alone = Simulation::new(&free, None, 0.0, support).unwrap().outputs(support);
        let added = u_start.signum() * 2.0 * tie_height / height * expected;
        let difference = outputs.restoring_force - alone.restoring_force - added;
        prop_assert!(difference.abs() <= 1e-13 * alone.restoring_force.abs() + 4.0 * rounding);
        let difference = outputs.damping_force - alone.damping_force;
        prop_assert!(difference.abs() <= 1e-14 * alone.damping_force.abs());
        prop_assert_eq!(outputs.reactions.bottom, wall.body().mass * (a + outputs.acceleration));
    }
}

#[test]
fn a_tied_wall_moves_alike_in_batches() {
    // stiff ties take small steps, and the other walls have all their batches
    batches_agree(4, tied());
}

fn tied_parapet() -> Parameters {
    Parameters {
        tie_height: 3.0,
        tie_stiffness: 2e6,
        tie_slack: 0.02,
        tie_strength: 5e3,
        u_start: 0.0,
        ..Parameters::default()
    }
}

/// A tie adds a corner where it begins to pull, on the sides that it holds.
#[test]
fn a_tie_adds_a_corner_on_its_side() {
    // g₀ h/(2y) of 0.02 m at 3 m of 4 m; one beyond the departure at h/4 never pulls
    let onset = 0.02 * 4.0 / 6.0;
    for (tie_side, tie_slack, expected) in [
        (TieSide::Positive, 0.02, vec![onset]),
        (TieSide::Negative, 0.02, vec![-onset]),
        (TieSide::Both, 0.02, vec![-onset, onset]),
        (TieSide::Both, 100.0, vec![]),
    ] {
        let places = |parameters: &Parameters| {
            let wall = Wall::new(parameters).unwrap();
            wall.corners().iter().map(|corner| corner.displacement).collect::<Vec<_>>()
        };
        let own = places(&Parameters { tie_stiffness: 0.0, ..tied_parapet() });
        let mut added = places(&Parameters { tie_side, tie_slack, ..tied_parapet() });
        added.retain(|place| !own.contains(place));
        assert_eq!(added.len(), expected.len(), "{added:?}");
        for (found, expected) in added.iter().zip(&expected) {
            assert!((found - expected).abs() <= f64::EPSILON * onset, "{found} for {expected}");
        }
    }
}

/// Peak and first reaching of the strength are those of a fine history, and the peak that of u.
#[test]
fn tie_force_is_a_demand() {
    let scene = |output_step: f64| {
        let mut scene = Scene::read(&crate::root().join("scenes/shaken_parapet.toml")).unwrap();
        let Parameters { tie_height, tie_stiffness, tie_slack, tie_strength, .. } = tied_parapet();
        scene.parameters =
            Parameters { tie_height, tie_stiffness, tie_slack, tie_strength, ..scene.parameters };
        scene.output_step = output_step;
        scene
    };
    let coarse = Response::of(&scene(0.05)).unwrap();
    let fine = Response::of(&scene(1e-4)).unwrap();
    let tie = coarse.demands.ties[0];
    let demand = coarse.demands.displacement.highest;
    let wall = Wall::new(&scene(0.1).parameters).unwrap();
    let force = wall.ties().first().unwrap().force(demand.value);
    assert!((tie.force.value - force).abs() <= 1e-11 * force, "{} {force}", tie.force.value);
    assert!((tie.force.time - demand.time).abs() < 1e-6);
    let largest = fine.samples.iter().map(|sample| sample.outputs.tie_force).fold(0.0, f64::max);
    assert!(largest <= force * (1.0 + 1e-9) && largest > 0.999 * force, "{largest} {force}");
    let first = fine.samples.iter().find(|sample| sample.outputs.tie_force >= 5e3).unwrap().time;
    let reached = tie.strength.unwrap();
    assert_eq!(reached.value, 5e3);
    assert!(first - 1e-4 <= reached.time && reached.time <= first, "{} {first}", reached.time);
}

/// A wall without a tie, and one whose tie never pulls, move bit for bit alike; secant damping too.
#[test]
fn a_slack_tie_changes_nothing() {
    let scene = |slack: f64, model: DampingModel, law: ForceLaw| {
        let mut scene = Scene::read(&crate::root().join("scenes/shaken_parapet.toml")).unwrap();
        scene.parameters = Parameters {
            tie_height: 4.0,
            tie_stiffness: if slack > 0.0 { 1e8 } else { 0.0 },
            tie_slack: slack,
            damping_model: model,
            xi: 0.03,
            force_law: law,
            ..scene.parameters
        };
        Response::of(&scene).unwrap()
    };
    for model in [DampingModel::ConstantCoefficient].into_iter().chain(secant_models()) {
        let [free, slack] = [0.0, 100.0].map(|slack| scene(slack, model, ForceLaw::Bilinear));
        assert!(free.samples.len() > 1000 && free.summary.u_ratio_max > 0.1, "{:?}", free.summary);
        assert_eq!(free.samples.len(), slack.samples.len());
        for (free, slack) in free.samples.iter().zip(&slack.samples) {
            // as text, in which 0 is not −0
            assert_eq!(format!("{free:?}"), format!("{slack:?}"));
        }
        assert_eq!(free.summary, slack.summary);
    }
}

#[test]
fn bad_ties_are_refused_with_the_remedy() {
    let refused = |change: fn(&mut Parameters), words: [&str; 2]| {
        let mut parameters = tied_parapet();
        change(&mut parameters);
        let message = Wall::new(&parameters).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    refused(|p| p.tie_height = 0.0, ["tie_height = 0", "at most height = 4"]);
    refused(|p| p.tie_height = 4.1, ["tie_height = 4.1", "at most height = 4"]);
    refused(
        |p| {
            p.kinematics = rocking_wall::wall::Kinematics::Trigonometric;
            p.force_law = ForceLaw::RigidLinear;
            p.damping_model = DampingModel::None;
        },
        ["tie_stiffness = 2000000", "kinematics = linear"],
    );
    let mut scene = Scene::default();
    let message = scene.set("tie_stiffness", "-1").unwrap_err().to_string();
    assert!(message.contains("tie_stiffness = -1.0 N/m is below its minimum, 0.0 N/m"), "{message}");
    let message = scene.set("tie_side", "left").unwrap_err().to_string();
    assert!(message.contains("positive, negative, both"), "{message}");
}

/// Overturning stays that of the wall alone; a tie that holds the wall beyond is told.
#[test]
fn a_tie_that_holds_the_wall_is_told() {
    let warns = |parameters: &Parameters| {
        let wall = Wall::new(parameters).unwrap();
        wall.warnings().iter().any(|warning| matches!(warning, Warning::TieHolds { .. }))
    };
    assert!(warns(&tied_parapet()));
    // too soft, or slack until the wall leaves its supports
    assert!(!warns(&Parameters { tie_stiffness: 100.0, ..tied_parapet() }));
    assert!(!warns(&Parameters { tie_slack: 10.0, ..tied_parapet() }));
    assert!(!warns(&Parameters { tie_stiffness: 0.0, ..tied_parapet() }));
    let (tied, free) = (tied_parapet(), Parameters { tie_stiffness: 0.0, ..tied_parapet() });
    let [tied, free] = [tied, free].map(|parameters| Wall::new(&parameters).unwrap());
    assert_eq!(tied.body(), free.body());
    assert_eq!((tied.omega1(), tied.damping_ratio()), (free.omega1(), free.damping_ratio()));
    assert_eq!(tied.rocking_onset(), free.rocking_onset());
}

/// The tie pulls on its own side, from its slack on until the wall leaves its supports.
#[test]
fn the_tie_pulls_on_its_side_while_the_wall_is_on_its_supports() {
    for (tie_side, sides) in
        [(TieSide::Positive, [1.0, 0.0]), (TieSide::Negative, [0.0, 1.0]), (TieSide::Both, [1.0, 1.0])]
    {
        let parameters = Parameters { tie_side, ..tied_parapet() };
        let wall = Wall::new(&parameters).unwrap();
        let (tie, lever) = (wall.ties().first().unwrap(), 2.0 * parameters.tie_height / parameters.height);
        for (sign, holds) in [1.0, -1.0].into_iter().zip(sides) {
            let departure = wall.body().departure.of(sign);
            for (u, pulls) in
                [(0.9 * 0.02 / lever, 0.0), (0.1, 1.0), (0.999 * departure, 1.0), (1.001 * departure, 0.0)]
            {
                let wanted = holds * pulls * 2e6 * (lever * u - 0.02);
                let found = tie.force(sign * u);
                assert!((found - wanted).abs() <= 1e-14 * wanted.abs(), "{tie_side:?} at {u}: {found}");
            }
        }
    }
}

/// The largest force is that at the largest displacement, also where the tie turns the wall back hard.
#[test]
fn the_largest_force_is_at_the_turning_point() {
    let hard =
        Parameters { tie_stiffness: 1e9, tie_slack: 0.0, tie_side: TieSide::Positive, ..tied_parapet() };
    for u_start in [-0.03, -0.05, -0.08, -0.11] {
        let mut simulation = crate::start(&Parameters { u_start, ..hard.clone() });
        let mut demands = simulation.demands(Support::default(), &[]);
        simulation.advance_watched(&still(3.0), &mut demands).unwrap();
        let (tie, highest) = (demands.ties[0], demands.displacement.highest);
        let wanted = simulation.wall().ties().first().unwrap().force(highest.value);
        assert!(highest.value > 0.0 && wanted > 1e4, "{highest:?}");
        // what both searches leave
        assert!((tie.force.value - wanted).abs() <= 2.0 * ACCURACY * wanted, "{tie:?}: {wanted}");
    }
}

/// A tie holds the wall for good where it outweighs the wall's own force until the wall leaves its supports.
#[test]
fn a_tie_holds_that_outweighs_the_wall_to_the_end() {
    // it begins to pull beyond u_ins, so that its force decides and not its slope
    let free = Parameters { damping_model: DampingModel::None, tie_strength: 0.0, ..tied_parapet() };
    let tied = Parameters { tie_slack: 0.36, ..free };
    let wall = Wall::new(&tied).unwrap();
    let (body, lever) = (wall.body(), 2.0 * tied.tie_height / tied.height);
    let (end, u_ins) = (body.departure.positive, body.instability.positive);
    assert!(u_ins < tied.tie_slack / lever && tied.tie_slack / lever < end);
    // K (2y/h) ((2y/h) u − g₀) = F₀ (u/u_ins − 1)
    let own = body.strength.positive * (end / u_ins - 1.0);
    let threshold = own / (lever * (lever * end - tied.tie_slack));
    for (share, holds) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true), (100.0, true), (0.01, false)] {
        let tie_stiffness = share * threshold;
        for &tie_side in TieSide::ALL {
            let wall = Wall::new(&Parameters { tie_stiffness, tie_side, ..tied.clone() }).unwrap();
            let found = wall.warnings().iter().any(|warning| matches!(warning, Warning::TieHolds { .. }));
            assert_eq!(found, holds, "{share}");
        }
    }
}
