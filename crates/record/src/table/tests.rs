//! Tests what the steps of a run need of its branches: maps, bounds, and the length of series.

use oscillator::KinematicState;
use rocking_wall::choices::{DampingModel, Impact};
use rocking_wall::wall::Parameters;

use super::*;

/// The first term left out is negligible, the last one kept is not.
#[test]
fn series_end_where_their_terms_are_negligible() {
    let left_out = |reach: f64, n: usize| (0..n).fold(1.0, |share, m| share * reach / (m as f64 + 2.0));
    for reach in [1e-6, 0.01, 0.06, 0.25, 0.5, LONGEST] {
        let n = terms(reach);
        assert!(left_out(reach, n) <= NEGLIGIBLE, "{reach}: {n}");
        assert!(n == 2 || left_out(reach, n - 1) > NEGLIGIBLE, "{reach}: {n}");
    }
    assert_eq!([0.25, LONGEST].map(terms), [13, 19]);
}

/// Maps of one step, of two and of four lead where the closed form leads, step by step.
#[test]
fn maps_are_the_closed_form() {
    let step = 0.01;
    for [c, k] in [[0.0, 0.0], [2.0, 300.0], [0.5, -200.0], [4.0, 0.0]] {
        let oscillator = Oscillator::new(c, k);
        let one = Affine::one_step(&oscillator, step);
        // f(0) = 0.7: q = p − 0.7
        let p = [0.3, -1.1, 2.3, 0.9, -0.4];
        let q = p.map(|p| p - 0.7);
        for (count, map) in [1, 2, 4].map(|count| (count, Affine::steps(&one, count, &oscillator, step))) {
            let [mut u, mut v] = [0.05, -0.3];
            let by_state = |part: usize| map.of_state[0][part] * u + map.of_state[1][part] * v;
            let forced = map.respond(&q);
            let found = [0, 1].map(|part| by_state(part) + forced[part]);
            let before = [u, v];
            for n in 0..count {
                let start =
                    KinematicState { displacement: u, velocity: v, acceleration: q[n] - c * v - k * u };
                let end = oscillator.propagate(start, (q[n + 1] - q[n]) / step, step);
                [u, v] = [end.displacement, end.velocity];
            }
            let wanted = [u - before[0], v - before[1]];
            for (part, size) in [0.3 * 4.0 * step, 20.0 * 4.0 * step].into_iter().enumerate() {
                // some roundings of |u̇| and of |ü| ≤ 20 over the steps
                let error = (found[part] - wanted[part]).abs();
                assert!(error <= 16.0 * f64::EPSILON * size, "{c}, {k}, {count} steps: {error:e} of {size}");
            }
            assert!(map.of_forcing[count + 1..].iter().all(|term| *term == [0.0; 2]));
        }
    }
}

/// γ(L) = 1/(1 − c L/2 − |k| L²/8); from a vanishing denominator on no step is plain (docs/record-path.md,
/// Eq. (2)).
#[test]
fn bounds_grow_with_the_length() {
    for sign in [1.0, -1.0] {
        assert_eq!(growth(&Oscillator::new(2.0, sign * 16.0), 0.25), 1.0 / (1.0 - 0.25 - 0.125));
        assert_eq!(growth(&Oscillator::new(4.0, sign * 16.0), 0.5), f64::INFINITY);
        assert_eq!(reach(&Oscillator::new(3.0, sign * 16.0), 0.5), 3.5);
    }
}

/// Blocks are searched by the largest γ L² of their steps, single and plain, and by c V = D/4 where there is
/// damping.
#[test]
fn margins_of_blocks_are_those_of_their_longest_steps() {
    let step = 5e-3;
    let walls = [([6.0, 0.6, 0.018], 4), ([1.5, 0.3, 0.0012], 2)];
    let models = [DampingModel::None, DampingModel::ConstantCoefficient];
    for (model, ([height, thickness, a1], at_once)) in
        models.into_iter().flat_map(|model| walls.map(|wall| (model, wall)))
    {
        let wall = Parameters { height, thickness, a1, damping_model: model, ..Parameters::default() };
        let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
        let table = BranchTable::new(&motion, step);
        assert_eq!(table.at_once, at_once);
        let mut largest = 0.0_f64;
        for (branch, oscillator) in motion.oscillators().iter().enumerate() {
            let c = oscillator.damping();
            assert_eq!(get(&table.damping_share, branch), if c > 0.0 { 0.25 } else { 0.0 });
            let share = if c > 0.0 { 0.25 * (1.0 / c) } else { f64::MAX };
            assert_eq!(get(&table.speed_share, branch), share);
            let n = table.at_once as f64;
            assert_eq!(get(&table.growth, branch), growth(oscillator, step));
            assert_eq!(get(&table.plain_growth, branch), growth(oscillator, n * step));
            largest = largest.max(growth(oscillator, n * step) * n * n);
        }
        assert_eq!(table.most_growth, largest);
        assert_eq!(table.most_damping, if model == DampingModel::None { 0.0 } else { 0.25 });
    }
}

/// Steps of secant damping are taken by series below c h = 1; from there on their bound (8) is infinite.
#[test]
fn secant_damping_is_curved_up_to_a_decay_of_one_in_a_step() {
    let wall = Parameters { damping_model: DampingModel::StiffnessProportional, ..Parameters::default() };
    let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
    let curved = motion.secants().iter().rposition(Option::is_some).expect("a branch with secant damping");
    let of = &motion.wall().branches()[curved];
    let largest = of.damping_at(of.lower).max(of.damping_at(of.upper));
    for (share, expected) in [(0.99, Stepping::Curved), (1.01, Stepping::General)] {
        assert_eq!(stepping(&motion, curved, share / largest), expected, "{largest}");
    }
}

/// A corner is passed only between branches on both of which steps are short.
#[test]
fn corners_of_a_branch_with_long_steps_are_closed() {
    for (a1, expected) in [(0.05, BranchExit::Ordinary), (1e-6, BranchExit::Search)] {
        let wall =
            Parameters { a1, damping_model: DampingModel::ConstantCoefficient, ..Parameters::default() };
        let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
        let elastic = motion.wall().branch_of(0.0, 1.0);
        let step = 5e-3;
        let short = motion.oscillators().iter().map(|oscillator| reach(oscillator, step) <= LONGEST);
        let long: Vec<usize> =
            short.enumerate().filter(|(_, short)| !short).map(|(branch, _)| branch).collect();
        assert_eq!(long, if expected == BranchExit::Search { vec![elastic] } else { vec![] });
        let table = BranchTable::new(&motion, step);
        // out of the elastic branch on both sides, and into it
        for (side, branch) in [(0, elastic), (1, elastic), (1, elastic - 1), (0, elastic + 1)] {
            assert_eq!(table.exit(branch, side), expected, "{a1}: branch {branch}");
        }
    }
}

/// Steps are affine maps on as many branches as a row holds; of a wall with more on those about u = 0.
#[test]
fn a_row_holds_sixteen_branches() {
    let mut counts = vec![];
    for corners in 2..10_u32 {
        let points = (1..=corners).map(|n| 0.02 * f64::from(n)).map(|u| [u, (4.0 * u).sqrt()]);
        let multilinear = Some(points.chain([[1.0, 0.0]]).collect());
        let (damping_model, impact) = (DampingModel::None, Impact::Restitution);
        let wall = Parameters { multilinear, damping_model, impact, u_start: 0.0, ..Parameters::default() };
        let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
        let count = motion.wall().branches().len();
        let affine = |branch: &usize| stepping(&motion, *branch, 5e-3) == Stepping::Affine;
        let found: Vec<usize> = (0..count).filter(affine).collect();
        let left_out = count.saturating_sub(MOST_BRANCHES);
        assert_eq!(found, (left_out / 2..count - left_out.div_ceil(2)).collect::<Vec<_>>(), "{count}");
        counts.push(count);
    }
    assert!(counts.contains(&MOST_BRANCHES) && counts.contains(&(MOST_BRANCHES + 2)), "{counts:?}");
}
