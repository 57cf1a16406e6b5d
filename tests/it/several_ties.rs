//! Several ties of one wall, each with its height, its side and its law.

use std::sync::Arc;

use fmu_export::{Interface, Model as _};
use proptest::collection::vec;
use proptest::prelude::*;
use rocking_wall::simulation::Outputs;
use rocking_wall::unit::UnitScene;
use rocking_wall::variables::{BooleanVariable, Mechanism, RealVariable as V, Rocking, TieSide};
use rocking_wall::wall::{Parameters, Support, TieMemory, TieNumbers, Wall};
use scene::{Scene, to_toml};

use crate::configuration::mostly;
use crate::properties::{COMPARED, Run, allowed, apart, motions, solvers_agree, splits};
use crate::record_path::{batches_agree, records_agree};
use crate::yielding::by_hand;
use crate::{return_mapping, start, still, yielding};

/// A wall with one tie and up to three more, softer or stiffer, weaker or stronger; some stay elastic.
pub(crate) fn several(one: impl Strategy<Value = Parameters>) -> impl Strategy<Value = Parameters> {
    let ultimate = prop_oneof![Just(None), Just(Some(0.0)), (0.1_f64..10.0).prop_map(Some)];
    let tie = (0.2_f64..1.0, -1.0_f64..1.0, 0.0_f64..2.0, 0.2_f64..5.0, ultimate, 0..3_usize);
    (one, vec(tie, 1..4)).prop_map(|(parameters, ties)| {
        let first = parameters.ties().next().unwrap();
        let further =
            ties.into_iter().map(|(height, exponent, slack, strength, ultimate, side)| TieNumbers {
                height: height * parameters.height,
                stiffness: first.stiffness * 10.0_f64.powf(exponent),
                slack: first.slack * slack,
                strength: first.strength * strength,
                ultimate: ultimate.map_or(-1.0, |share| share * first.ultimate.clamp(0.0, 0.1)),
                side: TieSide::ALL[side],
                bar: None,
            });
        Parameters { further_ties: further.collect(), ..parameters }
    })
}

#[test]
fn several_ties_move_a_wall_alike_in_parts() {
    mostly(COMPARED, (several(yielding::yielding()), motions(), 2_u32..7), splits);
}

#[test]
fn several_ties_move_a_wall_alike_by_both_solvers() {
    mostly(COMPARED, (several(yielding::yielding()), motions()), solvers_agree);
}

#[test]
fn several_ties_move_alike_over_records_and_in_batches() {
    let walls = || {
        (several(return_mapping::yielding()), 0..6_usize).prop_map(|(parameters, rocking)| {
            let rocking = *Rocking::ALL.get(rocking).unwrap_or(&Rocking::TwoSided);
            let impact = if rocking == Rocking::TwoSided {
                parameters.impact
            } else {
                rocking_wall::variables::Impact::Restitution
            };
            Parameters { rocking, impact, ..parameters }
        })
    };
    // a tie yields or breaks in 0.15 of the runs
    mostly(0.1, (walls(), motions(), 1_u32..40), |(parameters, motion, refinement)| {
        let outcome = records_agree(&parameters, &motion, refinement)?;
        Ok([usize::from(outcome.state.tie != TieMemory::default()), 1])
    });
    batches_agree(4, walls());
}

/// Two ties at one height that share stiffness and strength are one tie.
#[test]
fn a_tie_can_be_halved() {
    mostly(COMPARED, (yielding::yielding(), motions()), |(whole, motion)| {
        let tie = whole.ties().next().unwrap();
        let half = TieNumbers { stiffness: 0.5 * tie.stiffness, strength: 0.5 * tie.strength, ..tie };
        let halves = Parameters { further_ties: [half].into(), ..whole.tied_by(half) };
        let run = Run::new(whole, &motion);
        let Some(allowed) = allowed(&run, &motion, 1) else { return Ok([0, motion.len()]) };
        let other = Run::new(halves, &motion).history(0.0, 1);
        let (difference, compared) = apart(&run.history(0.0, 1), &other, run.scale(), 1.0);
        prop_assert!(difference < allowed, "differs by {difference:e}, allowed {allowed:e}");
        Ok([compared, motion.len()])
    });
}

/// A strip that is held by one tie or several at any height below its top.
pub(crate) fn strips() -> impl Strategy<Value = Parameters> {
    let walls = prop_oneof![yielding::yielding().boxed(), several(yielding::yielding()).boxed()];
    let strip = |parameters: Parameters| {
        let height = |height: f64| 0.95 * height.min(parameters.height);
        let further = parameters.further_ties.iter();
        let lower = |tie: &TieNumbers| TieNumbers { height: height(tie.height), ..*tie };
        Parameters {
            mechanism: Mechanism::VerticalSpanning,
            rocking: Rocking::TwoSided,
            tie_height: height(parameters.tie_height),
            further_ties: further.map(lower).collect(),
            ..parameters
        }
    };
    walls.prop_map(strip).prop_filter("a strip by Eq. (3)", |parameters| Wall::new(parameters).is_ok())
}

#[test]
fn ties_move_a_strip_alike_in_parts_and_by_both_solvers() {
    mostly(COMPARED, (strips(), motions(), 2_u32..7), splits);
    mostly(COMPARED, (strips(), motions()), solvers_agree);
}

/// The force of a tie at φ(y) u is felt twice, as all of Eq. (12) of a strip, and reactions include it by the
/// law of the lever: their moment about the base is that of a strip without the tie.
#[test]
fn a_tie_of_a_strip_has_its_levers() {
    for (tie_height, lever) in [(0.9, 0.6), (1.5, 1.0), (2.4, 0.4)] {
        let untied = Parameters {
            mechanism: Mechanism::VerticalSpanning,
            height: 3.0,
            thickness: 0.25,
            u_start: 0.03,
            ..Parameters::default()
        };
        let tied = Parameters { tie_height, tie_stiffness: 2e5, tie_slack: 0.002, ..untied.clone() };
        let [with, without] =
            [&tied, &untied].map(|parameters| start(parameters).outputs(Support::default()));
        let force = 2e5 * (lever * 0.03 - 0.002);
        // roundings of F and N
        assert!((with.tie_force - force).abs() < 1e-12 * force, "{} for {force}", with.tie_force);
        let added = with.restoring_force - without.restoring_force;
        assert!((added - 2.0 * lever * force).abs() < 1e-9, "{added} of {force}");
        // what the tie adds to the sum of inertia: −2 ℓ N λ
        let sum = |of: &Outputs| of.reactions.bottom + of.reactions.top;
        let body = start(&tied).wall().body().clone();
        let inertia = -body.participation * 2.0 * lever * force;
        let shares: f64 = body.support_weights.iter().sum();
        assert!((sum(&with) - sum(&without) - inertia * shares / 2.0).abs() < 1e-9, "{with:?} {without:?}");
    }
    let at_top = Parameters {
        mechanism: Mechanism::VerticalSpanning,
        tie_height: 4.0,
        tie_stiffness: 1e6,
        ..Parameters::default()
    };
    let error = Wall::new(&at_top).unwrap_err().to_string();
    assert!(error.starts_with("tie_height = 4 m is at the top support of a strip"), "{error}");
}

/// The wall of the example by hand with a second tie above its first, which breaks first.
fn two_ties() -> Parameters {
    let first = by_hand(0.05);
    let upper = TieNumbers {
        height: 3.0,
        stiffness: 1e5,
        slack: 0.03,
        strength: 1e3,
        ultimate: 0.01,
        side: TieSide::Both,
        bar: None,
    };
    Parameters { further_ties: [upper].into(), u_dot_start: 0.6, ..first }
}

/// Each tie breaks where its own elongation says, loses what it has stored, and has its own demands.
#[test]
fn each_tie_breaks_by_itself() {
    let parameters = two_ties();
    let mut simulation = start(&parameters);
    let mut demands = simulation.demands(Support::default(), &[]);
    for _ in 0..10 {
        simulation.advance_watched(&still(0.05), &mut demands).unwrap();
    }
    // (g₀ + N_y/K + p_u) z_G/y
    let wanted = [(0.02 + 0.015 + 0.05) / 2.6 * 1.5, (0.03 + 0.01 + 0.01) / 2.0];
    let first = simulation.progress().tie_breaks[0].unwrap();
    let breaks = demands.ties.iter().map(|tie| tie.yielding.unwrap().breaks[0].unwrap()).collect::<Vec<_>>();
    assert!(breaks[1] < breaks[0] && breaks[1] == first, "{breaks:?}");
    for (time, place) in breaks.iter().zip(wanted) {
        let mut again = start(&parameters);
        again.advance(&still(*time)).unwrap();
        let u = again.progress().state.displacement;
        assert!((u - place).abs() <= 1e-14, "{u} at {time} for {place}");
    }
    // the tie of the other side never pulls; 388.8 J at the start, less what was stored and the plastic work
    let alone =
        Wall::new(&Parameters { tie_stiffness: 0.0, further_ties: Arc::default(), ..parameters }).unwrap();
    let state = simulation.progress().state;
    let left = 2160.0 * alone.energy(state.displacement, state.velocity);
    let spent = 3e3_f64.powi(2) / 4e5 + 3e3 * 0.05 + 1e3_f64.powi(2) / 2e5 + 1e3 * 0.01;
    assert!((left + spent - 0.5 * 2160.0 * 0.36).abs() < 1e-9, "{left} J are left of {spent} J spent");
    assert_eq!([demands.ties[0].force.value, demands.ties[1].force.value], [3e3, 1e3]);
    let [lower, upper] = [0, 1].map(|tie| demands.ties[tie].yielding.unwrap().elongation);
    assert_eq!([lower.positive, lower.negative], [0.05, 0.0]);
    assert_eq!([upper.positive, upper.negative], [0.01, 0.0]);
}

/// A scene of several ties is written and read as it is, also as what an FMU carries, and its FMU gives the
/// sum of the forces.
#[test]
fn scenes_and_units_carry_several_ties() {
    let scene = Scene { parameters: two_ties(), inputs: Vec::new(), ..Scene::default() };
    let text = to_toml(&scene, "");
    assert_eq!(text.matches("[[tie]]").count(), 2, "{text}");
    let read = Scene::parse("scene.toml", &text, std::path::Path::new(".")).unwrap();
    assert_eq!(read.parameters, scene.parameters);
    let of_unit = UnitScene { parameters: two_ties(), motion: None };
    assert_eq!(UnitScene::read(&of_unit.bytes()).unwrap(), of_unit);
    for name in ["tie_height", "tie_stiffness", "tie_strength", "tie_ultimate"] {
        assert!(!scene.uses(name), "{name} is that of one tie");
    }
    assert!(scene.uses("tie_force") && scene.uses("tie_broken"));

    let unit = crate::yielding_unit::initialized(Interface::CoSimulation, &text);
    assert_eq!(unit.real(V::TieForce), 0.0);
    let mut exchange = crate::yielding_unit::initialized(Interface::ModelExchange, &text);
    crate::yielding_unit::integrate(&mut exchange, &mut 0.0, 0.5, 1e-3);
    let mut steps = start(&two_ties());
    steps.advance(&still(0.5)).unwrap();
    let state = steps.progress().state;
    assert!((exchange.real(V::U) - state.displacement).abs() < 1e-9);
    assert!(exchange.boolean(BooleanVariable::TieBroken));
    let first = steps.progress().tie_break_time().unwrap();
    assert!((exchange.real(V::TieBreakTime) - first).abs() < 1e-9);
    // of a tie that is broken p stays
    assert_eq!(exchange.real(V::TieElongation), 0.05);
}

#[test]
fn several_ties_that_cannot_be_are_refused() {
    let read = |ties: &str| {
        Scene::parse("scene.toml", ties, std::path::Path::new(".")).map(|_| ()).unwrap_err().to_string()
    };
    let one = "[[tie]]\ntie_height = 2\ntie_stiffness = 1e6\n";
    let many = one.repeat(101);
    for (ties, message) in [
        (
            format!("{one}[[tie]]\ntie_height = 3\n"),
            "line 5: tie 2 of 2 has no stiffness: give tie_stiffness",
        ),
        (
            format!("{one}[[tie]]\nheight = 3\n"),
            "line 5: unknown key \"height\" in [tie] (did you mean \"tie_height\"?)",
        ),
        (format!("{one}[[tie]]\ntie_stiffness = -1\n"), "line 5: tie_stiffness = -1"),
        (format!("{one}[[tie]]\nbar = {{ diameter = 0.016 }}\n"), "line 5: length is missing in [tie.bar]"),
        ("[[tie]]\ntie_height = 2\n".to_owned(), "line 2: tie 1 of 1 has no stiffness"),
        (one.replace("tie_height = 2\n", ""), "line 2: tie 1 of 1 has no height: give tie_height"),
        ("[[tie]]\n".to_owned(), "tie 1 of 1 has no stiffness"),
        (format!("{one}[[tie.bar]]\nlength = 1\n"), "bar is one table: write [tie.bar] below its [tie]"),
        (
            format!("{one}[tie]\ntie_height = 3\n"),
            "line 4: tie is given twice; leave one out (tables of a list have two brackets: [[tie]])",
        ),
        (many, "line 1: tie needs at least 1 and at most 100 values, found 101"),
        ("tie = 3\n".to_owned(), "line 1: tie = 3: expected a table [tie], or several [[tie]]"),
        ("tie = [3]\n".to_owned(), "line 1: "),
    ] {
        let error = read(&ties);
        assert!(error.contains(message), "{error} for {message}");
    }
    let mut scene = Scene { parameters: two_ties(), ..Scene::default() };
    for name in ["tie_strength", "bar_diameter"] {
        let error = scene.set(name, "1").unwrap_err().to_string();
        assert!(error.contains("is that of one tie, and the wall has several"), "{error}");
    }
    let above = TieNumbers { height: 3.5, ..two_ties().further_ties[0] };
    let error =
        Wall::new(&Parameters { further_ties: [above].into(), ..two_ties() }).unwrap_err().to_string();
    assert!(error.starts_with("tie_height = 3.5 m must be above 0 and at most height = 3 m"), "{error}");
}
