//! Ties that yield and break: an example worked by hand, energy, and what holds for every such tie.

use std::cell::Cell;
use std::sync::Arc;

use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Solver, TieSide};
use rocking_wall::wall::{Parameters, Support, Tie, Wall, Warning};

use crate::configuration::mostly;
use crate::properties::{COMPARED, Run, apart, motions, onset, solvers_agree, splits};
use crate::several_ties::{several, strips};
use crate::ties::tied;
use crate::{start, still};

/// A wall with ties that yield, and break at a plastic elongation: 0 for some, never for others.
pub(crate) fn yielding() -> impl Strategy<Value = Parameters> {
    let ultimate = prop_oneof![Just(0.0), 1e-3_f64..0.3, Just(1e3)];
    (tied(), 1e-3_f64..0.2, ultimate).prop_map(|(parameters, elastic, ultimate)| {
        let scale = 2.0 * parameters.tie_height / parameters.height * scale(&parameters);
        let tie_strength = elastic * scale * parameters.tie_stiffness;
        Parameters { tie_strength, tie_ultimate: ultimate * scale, ..parameters }
    })
}

fn scale(parameters: &Parameters) -> f64 {
    Wall::new(parameters).unwrap().displacement_scale()
}

#[test]
fn a_wall_with_yielding_ties_moves_alike_in_parts() {
    mostly(COMPARED, (yielding(), motions(), 2_u32..7), splits);
}

#[test]
fn a_wall_with_yielding_ties_moves_alike_by_both_solvers() {
    mostly(COMPARED, (yielding(), motions()), solvers_agree);
}

/// Compares the histories of two walls, and what their ties remember. `sign` is -1 for a mirrored motion.
fn are_alike(
    [first, second]: [(Parameters, &[f64]); 2],
    sign: f64,
    remember: bool,
) -> Result<[usize; 2], TestCaseError> {
    let count = first.1.len();
    let scale = scale(&first.0);
    let [first, second] =
        [first, second].map(|(parameters, motion)| Run::new(parameters, motion).history(0.0, 1));
    let (difference, compared) = apart(&first, &second, scale, sign);
    prop_assert!(difference == 0.0, "differs by {difference:e}");
    for (first, second) in first.iter().zip(&second).take(compared) {
        prop_assert_eq!(first.work, second.work);
        let [yielded, other] = [first, second].map(|progress| progress.state.tie.yielded);
        prop_assert!(!remember || (yielded.of(1.0), yielded.of(-1.0)) == (other.of(sign), other.of(-sign)));
    }
    Ok([compared, count])
}

/// Mirrored motion stretches and breaks the tie of the other side.
#[test]
fn yielding_ties_are_mirrored() {
    mostly(COMPARED, (yielding(), motions()), |(parameters, motion)| {
        let mirrored: Vec<_> = motion.iter().map(|a| -a).collect();
        let tie_side = match parameters.tie_side {
            TieSide::Positive => TieSide::Negative,
            TieSide::Negative => TieSide::Positive,
            TieSide::Both => TieSide::Both,
        };
        let other = Parameters { tie_side, ..parameters.clone() };
        are_alike([(parameters, &motion), (other, &mirrored)], -1.0, true)
    });
}

/// A tie stronger than any force of the run is elastic, and one that is too soft to matter changes nothing.
#[test]
fn a_tie_that_does_not_reach_its_strength_is_elastic() {
    mostly(COMPARED, (tied(), motions()), |(parameters, motion)| {
        let strong = Parameters { tie_strength: 1e12, tie_ultimate: 1e-3, ..parameters.clone() };
        are_alike([(parameters, &motion), (strong, &motion)], 1.0, true)
    });
    mostly(COMPARED, (yielding(), motions()), |(parameters, motion)| {
        let free = Parameters { tie_stiffness: 0.0, ..parameters.clone() };
        let without = Parameters { tie_strength: 0.0, tie_ultimate: -1.0, ..free.clone() };
        are_alike([(free, &motion), (without, &motion)], 1.0, true)
    });
}

/// A wall of four times the size takes twice the time under the same accelerations.
#[test]
fn yielding_ties_scale_with_length_and_time() {
    mostly(COMPARED, (yielding(), motions()), |(parameters, motion)| {
        let small = Parameters { xi: 0.0, c_bar: 0.0, overburden: 0.0, ..parameters };
        // the mass grows by 4³ with the width, forces as well, stiffnesses by 4²
        let large = Parameters {
            height: 4.0 * small.height,
            thickness: 4.0 * small.thickness,
            width: 4.0 * small.width,
            tie_height: 4.0 * small.tie_height,
            tie_slack: 4.0 * small.tie_slack,
            tie_stiffness: 16.0 * small.tie_stiffness,
            tie_strength: 64.0 * small.tie_strength,
            tie_ultimate: 4.0 * small.tie_ultimate,
            ..small.clone()
        };
        let scale = scale(&small);
        let [small, large] = [small, large].map(|parameters| Run::new(parameters, &motion).history(0.0, 1));
        let standing = small.iter().zip(&large).take_while(|(small, _)| !small.state.overturned);
        let mut compared = 0;
        for (small, large) in standing {
            let apart = large.state.displacement - 4.0 * small.state.displacement;
            prop_assert!(apart.abs() <= 1e-9 * scale, "{apart:e} at {}", small.time);
            compared += 1;
        }
        Ok([compared, motion.len()])
    });
}

/// The energy of a wall with its ties, plastic work and fractures included \[J\].
fn energy(simulation: &Simulation, alone: &Wall) -> f64 {
    let (wall, state) = (simulation.wall(), simulation.progress().state);
    let m = alone.body().effective_mass;
    let memory = wall.tie_memory_at(state.branch, state.displacement);
    let of_side = |tie: &Tie, sign: f64| {
        let stored = |force: f64| 0.5 * force * force / tie.stiffness;
        let (stretched, broken) = (tie.elongations(&memory).of(sign), tie.is_broken(sign, &memory));
        let reach = tie.lever * sign * state.displacement - tie.slack - stretched;
        let most = if tie.ultimate.is_some() { tie.strength.unwrap() } else { f64::INFINITY };
        let force = if tie.holds(sign) { (tie.stiffness * reach).clamp(0.0, most) } else { 0.0 };
        let plastic = if stretched > 0.0 { most * stretched } else { 0.0 };
        plastic + stored(if broken { most } else { force })
    };
    let ties: f64 = wall.ties().iter().map(|tie| of_side(tie, 1.0) + of_side(tie, -1.0)).sum();
    // Eq. (12) of a strip is twice Lagrange's
    let scale = if alone.body().hinge().is_some() { 2.0 } else { 1.0 };
    m * alone.energy(state.displacement, state.velocity) + scale * ties
}

/// The supports work on the wall, which moves, stores and stretches its ties: section 9 of the law. Constant
/// accelerations a do the work −λ m_eff a Δu. Returns how many samples were compared, and of how many; and
/// how often a tie was stretched, and broke.
fn balances(parameters: &Parameters, motion: &[f64]) -> Result<([usize; 2], [usize; 2]), TestCaseError> {
    let parameters =
        Parameters { damping_model: DampingModel::None, impact: Impact::None, ..parameters.clone() };
    let untied = Parameters { tie_stiffness: 0.0, further_ties: Arc::default(), ..parameters.clone() };
    let alone = Wall::new(&untied).unwrap();
    let (body, mut simulation) = (alone.body(), start(&parameters));
    let step = 0.3 / alone.rocking_rate();
    let weight = body.participation * body.effective_mass;
    let (mut sum, mut given, first) = (0.0, 0.0_f64, energy(&simulation, &alone));
    let mut size = first.abs().max(body.strength.positive * alone.displacement_scale());
    for (count, share) in motion.iter().enumerate() {
        let before = simulation.progress().state.displacement;
        let support = Support::rigid(share * onset(&alone));
        simulation.advance(&Segment { duration: step, from: support, to: support }).unwrap();
        let state = simulation.progress().state;
        let broken = usize::from(simulation.progress().tie_break_time().is_some());
        let stretched = simulation.outputs(support).tie_elongation;
        let stretched = usize::from(stretched.of(1.0) + stretched.of(-1.0) > 0.0);
        if state.departed {
            return Ok(([count, motion.len()], [stretched, broken]));
        }
        let work = -weight * support.bottom * (state.displacement - before);
        (sum, given) = (sum + work, given + work.abs());
        let now = energy(&simulation, &alone);
        size = size.max(now.abs()).max(given);
        // as in `energy_never_grows`: each piece rounds some dozen quantities of this size; a stiff tie
        // multiplies the rounding of u by its force over that of the wall
        let pieces = simulation.progress().work.pieces as f64;
        let wall = simulation.wall();
        let most = |tie: &Tie| tie.force(0.999 * body.departure.positive).max(tie.strength.unwrap());
        let pull: f64 = wall.ties().iter().map(|tie| most(tie) * tie.pull).sum();
        let stiff = 1.0 + pull / body.strength.positive;
        let allowed = 1e-12_f64.max(32.0 * f64::EPSILON * pieces) * size * stiff;
        prop_assert!((now - sum - first).abs() <= allowed, "{:e} of {size:e}", now - sum - first);
        if count + 1 == motion.len() {
            return Ok(([motion.len(), motion.len()], [stretched, broken]));
        }
    }
    unreachable!("a motion has samples")
}

#[test]
fn energy_is_balanced_where_ties_yield_and_break() {
    let (runs, stretched, broken) = (Cell::new(0), Cell::new(0), Cell::new(0));
    let walls = prop_oneof![yielding().boxed(), several(yielding()).boxed(), strips().boxed()];
    mostly(0.6, (walls, motions(), -0.9_f64..0.9), |(parameters, motion, share)| {
        // a start beyond the yield is a stretched tie
        let u_start = share * scale(&parameters);
        let (compared, [stretches, breaks]) = balances(&Parameters { u_start, ..parameters }, &motion)?;
        runs.set(runs.get() + 1);
        stretched.set(stretched.get() + stretches);
        broken.set(broken.get() + breaks);
        Ok(compared)
    });
    assert!(5 * stretched.get() > runs.get(), "{} of {} stretch a tie", stretched.get(), runs.get());
    assert!(8 * broken.get() > runs.get(), "{} of {} break a tie", broken.get(), runs.get());
}

/// A rigid-linear parapet of 3 m by 0.3 m at u = 0 with u̇ = 0.5 m/s, hence 270 J, and a tie of 200 kN/m at
/// 2.6 m with a slack of 20 mm that yields at 3 kN.
pub(crate) fn by_hand(tie_ultimate: f64) -> Parameters {
    Parameters {
        height: 3.0,
        thickness: 0.3,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution: 0.9,
        tie_height: 2.6,
        tie_stiffness: 2e5,
        tie_slack: 0.02,
        tie_strength: 3e3,
        tie_ultimate,
        u_start: 0.0,
        u_dot_start: 0.5,
        ..Parameters::default()
    }
}

/// Compares u and u̇ at times with printed numbers: `allowed` is half a unit of the last decimal, and what
/// half a unit of that of the time adds, with u̇ and ü below 5.
#[track_caller]
fn passes(simulation: &mut Simulation, rows: &[[f64; 3]], allowed: f64) {
    for &[time, displacement, velocity] in rows {
        simulation.advance(&still(time - simulation.progress().time)).unwrap();
        let state = simulation.progress().state;
        assert!((state.displacement - displacement).abs() <= allowed, "{state:?} at {time}");
        assert!((state.velocity - velocity).abs() <= allowed, "{state:?} at {time}");
    }
}

/// Where the tie engages and yields.
const ENGAGES: [f64; 3] = [0.023_471_784_5, 0.011_538_46, 0.483_398_58];
const YIELDS: [f64; 3] = [0.041_893_886_7, 0.020_192_31, 0.448_835_83];

/// The tie engages, yields and breaks; the wall comes back, and loses 22.5 J that were stored and 150 J of
/// plastic work.
#[test]
fn the_example_by_hand_breaks_its_tie_and_comes_back() {
    let mut simulation = start(&by_hand(0.05));
    let alone = Wall::new(&Parameters { tie_stiffness: 0.0, ..by_hand(0.05) }).unwrap();
    let own = |simulation: &Simulation| {
        let state = simulation.progress().state;
        2160.0 * alone.energy(state.displacement, state.velocity)
    };
    assert!((own(&simulation) - 270.0).abs() < 1e-12);
    passes(&mut simulation, &[ENGAGES, YIELDS, [0.135_006_728_6, 0.049_038_46, 0.172_953_99]], 6e-9);
    simulation.advance(&still(1e-9)).unwrap();
    let breaks = simulation.progress().tie_breaks;
    assert!((breaks[0].unwrap() - 0.135_006_728_6).abs() < 1e-10 && breaks[1].is_none(), "{breaks:?}");
    assert!((own(&simulation) - 97.5).abs() < 1e-9, "{}", own(&simulation));
    assert_eq!(simulation.outputs(Support::default()).tie_force, 0.0);
    assert_eq!(simulation.outputs(Support::default()).tie_elongation.positive, 0.05);
    // just before and after the impact
    let back: f64 = 1.275_127_841_3;
    passes(&mut simulation, &[[back - 1e-9, 0.0, -0.300_462_6], [back + 1e-9, 0.0, -0.270_416_3]], 6e-8);
}

/// A tie that does not break holds the wall, and is slack again at g₀ + p.
#[test]
fn the_example_by_hand_turns_where_its_tie_holds() {
    let mut simulation = start(&by_hand(10.0));
    passes(&mut simulation, &[ENGAGES, YIELDS], 6e-9);
    simulation.advance(&still(0.4)).unwrap();
    let state = simulation.progress().state;
    assert!((state.peaks.positive - 0.054_213_86).abs() <= 5e-9, "{state:?}");
    let elongation = simulation.outputs(Support::default()).tie_elongation;
    assert!((elongation.positive - 0.058_970_69).abs() <= 5e-9, "{elongation:?}");
    let hold = simulation.wall().ties().first().unwrap().hold(1.0, &state.tie).unwrap();
    assert!((hold.onset - 0.045_560_01).abs() <= 5e-9, "{hold:?}");
}

/// Demands on ties: the largest force and its first time, p of each side, and each fracture.
#[test]
fn the_example_by_hand_has_its_demands() {
    for (ultimate, elongation, fracture) in [(10.0, 0.058_970_69, None), (0.05, 0.05, Some(0.135_006_728_6))]
    {
        let mut simulation = start(&by_hand(ultimate));
        let mut demands = simulation.demands(Support::default(), &[]);
        for _ in 0..4 {
            simulation.advance_watched(&still(0.1), &mut demands).unwrap();
        }
        let tie = demands.ties[0];
        assert!(tie.force.value == 3e3 && tie.strength == Some(tie.force), "{tie:?}");
        assert!((tie.force.time - YIELDS[0]).abs() < 1e-10, "{tie:?}");
        let yielding = tie.yielding.unwrap();
        assert!((yielding.elongation.positive - elongation).abs() < 5e-9, "{yielding:?}");
        assert_eq!((yielding.elongation.negative, yielding.breaks[1]), (0.0, None));
        let apart = yielding.breaks[0].zip(fracture).map(|(found, wanted): (f64, f64)| found - wanted);
        assert!(
            yielding.breaks[0].is_some() == fracture.is_some()
                && apart.is_none_or(|apart| apart.abs() < 1e-10)
        );
    }
}

#[test]
fn the_example_by_hand_overturns_where_its_tie_is_brittle() {
    let mut simulation = start(&by_hand(0.0));
    passes(&mut simulation, &[ENGAGES, YIELDS], 6e-9);
    simulation.advance(&still(1.0)).unwrap();
    let progress = simulation.progress();
    assert!((progress.tie_breaks[0].unwrap() - YIELDS[0]).abs() < 1e-10, "{progress:?}");
    assert!((progress.overturn_time.unwrap() - 0.384_624_854_6).abs() < 1e-10, "{progress:?}");
    assert_eq!(simulation.outputs(Support::default()).tie_elongation.positive, 0.0);
}

/// A tie that is just reached at the start has broken: one that is brittle at its first yield, too.
#[test]
fn a_tie_that_is_just_reached_has_broken() {
    for ultimate in [0.0, 0.05] {
        let wall = Wall::new(&by_hand(ultimate)).unwrap();
        let breaks = wall.ties().first().and_then(Tie::fracture_displacement).unwrap();
        for (u_start, time) in [(breaks, Some(0.0)), (breaks.next_down(), None)] {
            let simulation = start(&Parameters { u_start, ..by_hand(ultimate) });
            assert_eq!(simulation.progress().tie_break_time(), time, "{ultimate}");
        }
    }
}

/// At first loading N grows with K to `N_y` and stays there. It is 0 on the other side, and from the fracture
/// or the departure on.
#[test]
fn a_tie_that_is_loaded_for_the_first_time_has_its_force() {
    let wall = |ultimate| Wall::new(&by_hand(ultimate)).unwrap();
    let (yielding, elastic) = (wall(0.05), wall(-1.0));
    let [yields, elastic] = [&yielding, &elastic].map(|wall| wall.ties().first().unwrap());
    let [u_y, u_f] = [yields.strength_displacement(), yields.fracture_displacement()].map(Option::unwrap);
    let departure = yielding.body().departure.positive;
    let middle = 0.5 * (yields.onset() + u_y);
    for (u, force) in [(0.9 * yields.onset(), 0.0), (middle, 1.5e3), (1.5 * u_y, 3e3), (-1.5 * u_y, 0.0)] {
        // a rounding of N_y
        assert!((yields.force(u) - force).abs() < 1e-12 * 3e3, "{} at {u} m", yields.force(u));
    }
    assert_eq!([u_f.next_down(), u_f, 1.1 * u_f].map(|u| yields.force(u)), [3e3, 0.0, 0.0]);
    assert!(elastic.force(departure.next_down()) > 3e3 && elastic.force(departure) == 0.0);
    // nor does the wall feel it there
    let alone = Wall::new(&Parameters { tie_stiffness: 0.0, ..by_hand(-1.0) }).unwrap();
    let [tied, alone] =
        [&wall(-1.0), &alone].map(|wall| wall.restoring(wall.branch_of(departure, 1.0), 1.1 * departure));
    assert_eq!(tied, alone);
}

/// A tie that yields holds the wall beyond `u_ins` if ℓ `N_y` exceeds the force that tips the wall at its
/// departure, k₀ u − F₀ = 6357 N, and if it has not broken before.
#[test]
fn a_tie_that_yields_is_warned_of_where_it_holds_beyond_u_ins() {
    let warns = |tie_strength: f64, ultimate: f64| {
        let wall = Wall::new(&Parameters { tie_strength, ..by_hand(ultimate) }).unwrap();
        wall.warnings().iter().any(|warning| matches!(warning, Warning::TieHolds { .. }))
    };
    let limit = (10594.8 * 0.75 - 1589.22) * 3.0 / 5.2;
    assert!(warns(1.001 * limit, 10.0) && !warns(0.999 * limit, 10.0) && !warns(1.001 * limit, 0.5));
}

/// Newmark does not locate the corners of a tie, and its U is that of its steps. It converges.
#[test]
fn newmark_is_of_first_order_where_ties_yield() {
    let error = |newmark_step: f64| {
        let run = |solver: Solver| {
            let damping_model = DampingModel::ConstantCoefficient;
            let parameters = Parameters { damping_model, impact: Impact::None, ..by_hand(10.0) };
            let parameters = Parameters { force_law: ForceLaw::Bilinear, a1: 0.1, ..parameters };
            let mut simulation = start(&Parameters { solver, newmark_step, xi: 0.02, ..parameters });
            simulation.advance(&still(0.7)).unwrap();
            let state = simulation.progress().state;
            assert!(state.tie.yielded.positive > 0.05 && !state.overturned, "{state:?}");
            state.displacement
        };
        (run(Solver::Newmark) - run(Solver::Exact)).abs()
    };
    let errors = [1e-3, 1e-4, 1e-5].map(error);
    // single errors depend on how the steps meet the corners: by two powers of ten, two to four powers
    let order = (errors[0] / errors[2]).log10() / 2.0;
    assert!((0.8..2.1).contains(&order) && errors[2] < 1e-6, "{errors:?}");
}

/// Supports feel hinge and tie together: their impulses are the momentum that the wall gains, also where a
/// tie yields and breaks; and R_b jumps by ¾ ℓ N_y at the fracture.
#[test]
fn reactions_include_a_tie_that_yields() {
    let mut simulation = start(&by_hand(0.05));
    let mass = simulation.wall().body().mass;
    for step in [0.03, 0.03, 0.05, 0.1, 0.3] {
        let before = simulation.progress().state.velocity;
        let done = simulation.advance(&still(step)).unwrap();
        let gained = mass * (simulation.progress().state.velocity - before);
        assert!((done.impulses.bottom - gained).abs() <= 1e-12 * mass, "{done:?} for {gained}");
    }
    let reaction = |ultimate: f64| {
        let simulation = start(&Parameters { u_start: 0.085 / 5.2 * 3.0, ..by_hand(ultimate) });
        simulation.outputs(Support::default()).reactions.bottom
    };
    let jump = reaction(0.05) - reaction(10.0);
    assert!((jump - 0.75 * 5.2 / 3.0 * 3e3).abs() < 1e-9, "{jump}");
}
