//! One-sided rocking: the same motion by every solver and path, rest, restitution, refusals.

use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::{Phase, Segment};
use rocking_wall::variables::{DampingModel, Impact, Mechanism, RestitutionSource, Rocking};
use rocking_wall::wall::{COMPUTED, Parameters, Support, Wall, restitution};

use crate::configuration::{configuration, mostly};
use crate::properties::{COMPARED, motions, solvers_agree, splits, walls};
use crate::record_path::{batches_agree, records_agree};
use crate::ties::tied;

/// A wall that rocks to one side, rigid or elastic, with a tie or without.
pub(crate) fn one_sided() -> impl Strategy<Value = Parameters> {
    (prop_oneof![walls(), tied()], any::<bool>(), 0.0_f64..0.95).prop_map(|(parameters, positive, e)| {
        Parameters {
            rocking: if positive { Rocking::OneSidedPositive } else { Rocking::OneSidedNegative },
            impact: Impact::Restitution,
            restitution: e,
            ..parameters
        }
    })
}

#[test]
fn one_sided_rocking_is_alike_in_batches() {
    batches_agree(1, one_sided());
}

#[test]
fn one_sided_rocking_is_alike_in_parts() {
    mostly(COMPARED, (one_sided(), motions(), 2_u32..7), splits);
}

#[test]
fn one_sided_rocking_is_alike_by_both_solvers() {
    mostly(COMPARED, (one_sided(), motions()), solvers_agree);
}

/// A wall has the sides that it can rock to. Both are alike where the force and a tie are.
#[test]
fn sides_are_those_that_a_wall_can_rock_to() {
    let sides = |parameters: &Parameters| {
        let wall = Wall::new(parameters).unwrap();
        (wall.sides().collect::<Vec<_>>(), wall.has_equal_sides())
    };
    assert_eq!(sides(&Parameters::default()), (vec![1.0, -1.0], true));
    // a law of two sides on a body whose sides are equal
    for (force, is_equal) in [(-0.9, true), (-0.5, false)] {
        let points = [[-1.0, 0.0], [-0.02, force], [0.02, 0.9], [1.0, 0.0]];
        let law = Parameters { multilinear: Some(points.into()), ..Parameters::default() };
        assert_eq!(sides(&law), (vec![1.0, -1.0], is_equal), "{force}");
    }
    for (rocking, side) in [(Rocking::OneSidedPositive, 1.0), (Rocking::OneSidedNegative, -1.0)] {
        assert_eq!(sides(&Parameters { rocking, ..undamped() }), (vec![side], false));
    }
}

/// u never goes behind the transverse walls, at rest they carry the whole inertia force, and the impulses add
/// up to the momentum.
#[test]
fn transverse_walls_stop_the_wall() {
    // at rest in 0.28 of the samples
    mostly(0.15, (one_sided(), motions()), |(parameters, motion)| {
        let wall = Wall::new(&parameters).unwrap();
        let (side, body) = (wall.free_side().unwrap(), wall.body().clone());
        let onset = body.strength.of(side) / (body.participation * body.effective_mass);
        let support = |index: usize| Support::rigid(onset * motion[index]);
        let mut simulation = Simulation::new(&parameters, None, 0.0, support(0)).unwrap();
        let step = 0.3 / wall.rocking_rate();
        let mut resting = 0;
        for index in 1..motion.len() {
            let before = simulation.progress().state.velocity;
            let (from, to) = (support(index - 1), support(index));
            let done = simulation.advance(&Segment { duration: step, from, to }).unwrap();
            let state = simulation.progress().state;
            prop_assert!(side * state.displacement >= 0.0);
            if state.overturned {
                return Ok([resting, motion.len()]);
            }
            let outputs = simulation.outputs(to);
            if state.phase == Phase::Resting {
                resting += 1;
                prop_assert_eq!(outputs.acceleration, 0.0);
                prop_assert_eq!(outputs.restoring_force, body.forcing(to) * body.effective_mass);
                // away from the transverse walls no more than F₀, or 0 with an elastic branch
                let most = if wall.is_rigid() { body.strength.of(side) } else { 0.0 };
                prop_assert!(side * outputs.restoring_force <= most * (1.0 + 1e-15));
            }
            if body.mechanism == Mechanism::Parapet {
                let change = state.velocity - before + 0.5 * step * (from.bottom + to.bottom);
                let rounding = 1e-12 * body.mass * (change.abs() + before.abs() + step * onset);
                prop_assert!((done.impulses.bottom - body.mass * change).abs() <= rounding);
            }
        }
        Ok([resting, motion.len()])
    });
}

proptest! {
    #![proptest_config(configuration())]

    #[test]
    fn one_sided_rocking_is_alike_over_records(
        parameters in one_sided(), motion in motions(), refinement in 1_u32..40,
    ) {
        records_agree(&parameters, &motion, refinement)?;
    }
}

/// The factors of e₁ one by one: changes of pivot of a block, by angular momentum about the new pivot.
#[test]
fn analytic_restitution_against_transverse_walls() {
    // velocity of the centre of a block that turns about `old`, then angular momentum about `new`
    let change = |[b, h]: [f64; 2], old: [f64; 2], new: [f64; 2]| {
        let centre = [0.0, h / 2.0];
        let from = [centre[0] - old[0], centre[1] - old[1]];
        let to = [centre[0] - new[0], centre[1] - new[1]];
        let own = (b * b + h * h) / 12.0;
        // v = ω × from, H = own + to × v
        (own + to[0] * from[0] + to[1] * from[1]) / (own + to[0] * to[0] + to[1] * to[1])
    };
    for [b, h] in [[0.4, 4.0], [0.25, 3.0], [0.6, 1.0]] {
        let alpha = f64::atan2(b, h);
        let (outer, inner, top) = ([b / 2.0, 0.0], [-b / 2.0, 0.0], [-b / 2.0, h]);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} {b}");
        close(restitution::analytic_parapet(alpha), change([b, h], outer, inner));
        close(restitution::toe_to_top(alpha), change([b, h], inner, top));
        // the strict change from the top to the outer toe: no rebound
        close(change([b, h], top, outer), -0.5);
        let e = -restitution::analytic_parapet(alpha).powi(2) * restitution::toe_to_top(alpha);
        let parameters = Parameters {
            thickness: b,
            height: h,
            restitution: COMPUTED,
            restitution_source: RestitutionSource::Analytic,
            ..undamped()
        };
        let wall = Wall::new(&parameters).unwrap();
        close(wall.restitution().positive, e);
        assert_eq!(wall.passage_factor(-1.0), -wall.restitution().positive);
    }
}

/// A parapet that rocks to u > 0 only, at rest at u = 0, e₁ = 0.4.
fn undamped() -> Parameters {
    Parameters {
        rocking: Rocking::OneSidedPositive,
        impact: Impact::Restitution,
        restitution: 0.4,
        damping_model: DampingModel::None,
        u_start: 0.0,
        ..Parameters::default()
    }
}

#[test]
fn bad_one_sided_walls_are_refused_with_the_remedy() {
    let good = undamped();
    assert!(Wall::new(&good).is_ok());
    let refused = |change: fn(&mut Parameters), words: [&str; 2]| {
        let mut parameters = good.clone();
        change(&mut parameters);
        let message = Wall::new(&parameters).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    refused(|p| p.impact = Impact::None, ["impact = none", "set impact = restitution"]);
    refused(|p| p.restitution = 1.0, ["restitution = 1; set", "restitution below 1"]);
    refused(
        |p| p.restitution = COMPUTED,
        ["restitution_source = calibrated", "set restitution, or restitution_source = analytic"],
    );
    refused(
        |p| {
            p.restitution = COMPUTED;
            p.restitution_source = RestitutionSource::Momentum;
        },
        ["restitution_source = momentum", "set restitution, or restitution_source = analytic"],
    );
    refused(
        |p| {
            p.mechanism = Mechanism::VerticalSpanning;
            p.restitution = COMPUTED;
            p.restitution_source = RestitutionSource::Analytic;
        },
        ["restitution_source = analytic", "set restitution, or rocking"],
    );
    refused(
        |p| {
            p.thickness = 3.0;
            p.restitution = COMPUTED;
            p.restitution_source = RestitutionSource::Analytic;
        },
        ["outside 0 to 1", "set restitution"],
    );
    refused(
        |p| p.damping_model = DampingModel::StiffnessProportional,
        ["xi = -1 (computed)", "set it, damping_model = none"],
    );
    let open = Parameters { rocking: Rocking::OneSidedNegative, ..Parameters::default() };
    assert_eq!(
        Wall::new(&open).unwrap_err().to_string(),
        "rocking = one_sided_negative does not go with impact = none; set impact = restitution, or rocking = \
         two_sided"
    );
    // a start is that of a run, not of a wall
    let behind = Wall::new(&good).unwrap().check_start(-0.01).unwrap_err().to_string();
    assert!(behind.contains("u_start = -0.01") && behind.contains("one_sided_positive"), "{behind}");
}

/// A start at u = 0 towards the transverse walls is an impact; at rest the wall leaves where −λ a turns away.
#[test]
fn one_sided_starts_and_rests() {
    let parameters = undamped();
    let towards = Parameters { u_dot_start: -0.1, ..parameters.clone() };
    let start = crate::start(&towards).progress().state;
    assert_eq!((start.velocity, start.phase), (0.1 * 0.4, Phase::Moving));
    // −λ a_g rises through 0 after half of the segment
    let mut simulation = Simulation::new(&parameters, None, 0.0, Support::rigid(1.0)).unwrap();
    assert_eq!(simulation.progress().state.phase, Phase::Resting);
    let half =
        |from: f64, to: f64| Segment { duration: 0.5, from: Support::rigid(from), to: Support::rigid(to) };
    simulation.advance(&half(1.0, 0.0)).unwrap();
    assert_eq!(simulation.progress().state.phase, Phase::Resting);
    simulation.advance(&half(0.0, -1.0)).unwrap();
    let state = simulation.progress().state;
    assert_eq!(state.phase, Phase::Moving);
    assert!(state.displacement > 0.0);
    // as from the root on: the same in one segment
    let mut whole = Simulation::new(&parameters, None, 0.0, Support::rigid(1.0)).unwrap();
    let (from, to) = (Support::rigid(1.0), Support::rigid(-1.0));
    whole.advance(&Segment { duration: 1.0, from, to }).unwrap();
    let apart = whole.progress().state.displacement - state.displacement;
    assert!(apart.abs() < 1e-14, "{apart:e}");
}
