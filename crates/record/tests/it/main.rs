//! Runs side by side beside runs by themselves, with each of AVX2 and AVX-512 that the processor has; without
//! either, no runs go side by side.

use record::testing::{MOST_BRANCHES, Vectors};
use record::{BatchRun, Blocks, Forcing, Outcome, RecordSolver, RunEnd, RunStart};
use rocking_wall::choices::{DampingModel, ForceLaw, Impact};
use rocking_wall::solver::{Memo, Motion, Peaks, State, Work};
use rocking_wall::wall::{Parameters, Support};

mod peaks;
mod together;
#[cfg(target_arch = "x86_64")]
mod work;

/// Two sines of 30 s in steps of 5 ms, under which some of the walls overturn.
fn shaking() -> Vec<f64> {
    let at = |n: i32| {
        let t = 5e-3 * f64::from(n);
        (t / 5.0).min(1.0) * (2.2 * (5.1 * t).sin() + 1.1 * (17.0 * t).cos() + 0.4 * (90.0 * t).sin())
    };
    (0..6000).map(at).collect()
}

/// A wall of 6 m, its first corner at a share a₁ of its instability.
fn motion(a1: f64) -> Motion {
    losing(a1, DampingModel::ConstantCoefficient, Impact::None)
}

/// The same wall with another damping model and impact.
fn losing(a1: f64, damping_model: DampingModel, impact: Impact) -> Motion {
    let wall = Parameters { height: 6.0, thickness: 0.6, ..Parameters::default() };
    Motion::of(&Parameters { a1, damping_model, impact, ..wall }, 1e-8).expect("a valid wall")
}

/// A rigid wall of 6 m, which passes u = 0 a hundred times before it comes to rest.
fn rigid() -> Motion {
    let (force_law, damping_model) = (ForceLaw::RigidLinear, DampingModel::None);
    let wall =
        Parameters { height: 6.0, thickness: 0.6, impact: Impact::Restitution, ..Parameters::default() };
    Motion::of(&Parameters { force_law, damping_model, ..wall }, 1e-8).expect("a valid wall")
}

/// A run by itself, through the whole record.
fn whole(solver: &RecordSolver<'_>, start: RunStart, forcing: Forcing<'_>) -> Outcome {
    solver.run(start, forcing, RunEnd::OfRecord).expect("a bounded motion")
}

/// Moves walls side by side with the widest vectors, or one by one on a processor without wide ones.
fn side_by_side(solver: &RecordSolver<'_>, forcing: Forcing<'_>, starts: &[RunStart]) -> Vec<Outcome> {
    let batch = solver.batch(forcing);
    assert_eq!(batch.is_side_by_side(), Vectors::widest().is_some(), "a wall for lanes");
    batch.run(starts, RunEnd::OfRecord).expect("bounded motions")
}

/// Factors of the forcing, more than there are lanes.
fn starts(motion: &Motion) -> Vec<RunStart> {
    let state = motion.start(0.0, 0.0, Support::default());
    (0..21).map(|i| RunStart { state, factor: 1.3 - 0.06 * f64::from(i) }).collect()
}

/// Side by side, with many corners passed, all vectors that the processor has give the same bits, and with
/// constant damping those of runs by themselves. With secant damping only a processor that has AVX-512, too,
/// can tell a difference.
#[test]
fn runs_do_not_depend_on_the_processor() {
    let models =
        [DampingModel::ConstantCoefficient, DampingModel::ConstantRatio, DampingModel::StiffnessProportional];
    for model in models {
        let motion = losing(0.018, model, Impact::None);
        let samples = shaking();
        let (solver, samples) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(&samples));
        let starts = starts(&motion);
        let widest = side_by_side(&solver, samples, &starts);
        for vectors in Vectors::all() {
            let batch = solver.batch_on(samples, Some(vectors));
            assert!(batch.is_side_by_side());
            assert_eq!(batch.run(&starts, RunEnd::OfRecord).expect("bounded motions"), widest);
        }
        if model == DampingModel::ConstantCoefficient {
            // as on a processor that has none
            let alone: Vec<_> = starts.iter().map(|&start| whole(&solver, start, samples)).collect();
            assert_eq!(alone, widest);
        }
        let corners: u64 = widest.iter().map(|outcome| outcome.work.corners).sum();
        let overturned = widest.iter().filter(|outcome| outcome.overturning.is_some()).count();
        assert!(corners > 500 && (1..20).contains(&overturned), "{corners} corners, {overturned} overturned");
    }
}

/// Walls whose elastic branch is narrower than their way in a step, with impacts: a step may pass three
/// corners. Side by side they have the outcomes of single runs.
#[test]
fn steps_with_several_corners_are_those_of_single_runs() {
    let bouncing = |a1| losing(a1, DampingModel::None, Impact::Restitution);
    for motion in [bouncing(1.2e-3), bouncing(2.4e-3), motion(8e-4), motion(2e-4), rigid()] {
        let samples = &shaking()[..2000];
        let (solver, samples) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(samples));
        let starts = starts(&motion);
        for (start, lane) in starts.iter().zip(side_by_side(&solver, samples, &starts)) {
            let single = whole(&solver, *start, samples);
            assert_eq!(lane, single);
        }
    }
}

/// Where |u| outgrows the bound on the forces in the last step of a block, a lane and a run by itself go on
/// with the same bits.
#[test]
fn motions_that_grow_at_the_end_of_a_block_are_those_of_single_runs() {
    let (motion, step) = (motion(3.5e-3), 5e-3);
    let solver = RecordSolver::new(&motion, step);
    let starts = starts(&motion);
    for still in 230..256 {
        let shaken = shaking().into_iter().skip(600).take(500).enumerate();
        // far stronger in the next block, whose bound depends on its forcing
        let grown = shaken.map(|(n, p)| if n + still > 256 { p } else { 0.05 * p });
        let samples: Vec<f64> = std::iter::repeat_n(0.0, still).chain(grown).collect();
        let forcing = Forcing::Samples(&samples);
        for (start, lane) in starts.iter().zip(side_by_side(&solver, forcing, &starts)) {
            assert_eq!(lane, whole(&solver, *start, forcing), "{still}");
        }
    }
}

/// Walls that turn shortly before a corner, on either side, within the margin that four steps at once keep
/// from it, but not within that of one step. The turning point is found, alone as beside others, as by the
/// general search.
#[test]
fn extremes_before_a_corner_are_found() {
    let (motion, step) = (motion(0.018), 5e-3);
    let wall = motion.wall();
    let corner =
        wall.corners().iter().map(|corner| corner.displacement).find(|u| *u > 0.0).expect("a corner");
    let pull = wall.branches()[wall.branch_of(0.5 * corner, 0.0)].restoring(corner);
    let start = |side: f64, u: f64, v: f64| {
        let mut state = motion.start(side * u, side * v, Support::default());
        // it has been further out on the other side, so that no extreme is searched there
        state.peaks.include(-side * corner);
        RunStart { state, factor: 1.0 }
    };
    let (still, solver) = ([0.0; 300], RecordSolver::new(&motion, step));
    let still = Forcing::Samples(&still);
    for (side, distance) in (1..40).flat_map(|i| [1.0, -1.0].map(|side| (side, 0.25 * f64::from(i)))) {
        let others = (1..8).map(|i| start(side, 0.05 * corner * f64::from(i), 0.0));
        for speed in (0..12).map(|i| 0.25 * f64::from(i)).take_while(|speed| 0.5 * speed * speed < distance) {
            let turning = start(side, corner - distance * pull * step * step, speed * pull * step);
            let starts: Vec<_> = std::iter::once(turning).chain(others.clone()).collect();
            let alone = side_by_side(&solver, still, &[turning])[0];
            assert_eq!(alone, side_by_side(&solver, still, &starts)[0]);
            assert_eq!(alone, whole(&solver, turning, still));
            let [found, wanted] = [alone.state, searched(&motion, turning, &[0.0; 300], step).0]
                .map(|State { peaks: Peaks { positive, negative }, .. }| [positive, negative]);
            for (found, wanted) in found.into_iter().zip(wanted) {
                // a few roundings of u
                let missed = (found - wanted).abs();
                assert!(missed <= 8.0 * f64::EPSILON * corner, "{side} {distance} {speed}: {missed:e} m");
            }
        }
    }
}

/// Walls that pass u = 0 in the last step of a record, and turn before it ends. The turning point is found as
/// by the general search, although no later step starts from there.
#[test]
fn extremes_after_a_corner_in_the_last_step_are_found() {
    let wall = Parameters {
        height: 1.0,
        thickness: 0.2,
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution: 0.9,
        ..Parameters::default()
    };
    let (motion, step) = (Motion::of(&wall, 1e-8).expect("a valid wall"), 0.02);
    let (solver, still) = (RecordSolver::new(&motion, step), [0.0; 2]);
    let pull = motion.rest_band()[1];
    let mut turning = 0;
    for (side, speed) in
        (1..20).flat_map(|i| [1.0, -1.0].map(|side| (side, 0.05 * f64::from(i) * pull * step)))
    {
        for share in (1..10).map(|i| 0.1 * f64::from(i)) {
            // u = 0 after about that share of the step
            let mut state = motion.start(-side * speed * share * step, side * speed, Support::default());
            state.peaks.include(-0.02 * side);
            let start = RunStart { state, factor: 1.0 };
            let found = whole(&solver, start, Forcing::Samples(&still)).state;
            let wanted = searched(&motion, start, &still, step).0;
            turning += u32::from(side * wanted.velocity < 0.0);
            for (found, wanted) in
                [(found.peaks.positive, wanted.peaks.positive), (found.peaks.negative, wanted.peaks.negative)]
            {
                // some roundings of the way in the step
                let missed = (found - wanted).abs();
                assert!(missed <= 16.0 * f64::EPSILON * speed * step, "{side} {speed} {share}: {missed:e} m");
            }
        }
    }
    assert!(turning > 100, "{turning}");
}

/// Moves a wall by the general search alone.
fn searched(motion: &Motion, start: RunStart, samples: &[f64], step: f64) -> (State, Work) {
    let (mut state, mut work) = (start.state, Work::default());
    for p in samples.windows(2) {
        let p = [start.factor * p[0], start.factor * p[1]];
        let moved = motion.advance_under(&mut state, step, p, &mut Memo::default());
        work.add(moved.expect("a bounded motion").work);
    }
    (state, work)
}

/// Pieces, corners and impacts are those that the general search counts.
#[test]
fn work_is_counted_as_by_the_general_search() {
    for (motion, least) in [(losing(0.018, DampingModel::None, Impact::Restitution), 50), (rigid(), 500)] {
        let samples = &shaking()[..1000];
        let (solver, forcing, mut impacts) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(samples), 0);
        for (start, lane) in starts(&motion).into_iter().zip(side_by_side(&solver, forcing, &starts(&motion)))
        {
            assert_eq!(lane.work, searched(&motion, start, samples, 5e-3).1);
            impacts += lane.work.impacts;
        }
        assert!(impacts > least, "{impacts}");
    }
}

/// Runs do not go side by side where steps are long beside the wall's period, or samples are few.
#[test]
fn what_does_not_suit_goes_one_by_one() {
    let samples = shaking();
    let all = Forcing::Samples(&samples);
    let (soft, stiff) = (motion(0.018), motion(1e-5));
    let goes_side_by_side = |motion: &Motion, samples, vectors| {
        RecordSolver::new(motion, 5e-3).batch_on(samples, vectors).is_side_by_side()
    };
    let widest = Vectors::widest();
    assert_eq!(goes_side_by_side(&soft, all, widest), widest.is_some());
    assert!(!goes_side_by_side(&soft, all, None));
    assert!(!goes_side_by_side(&stiff, all, widest));
    assert!(!goes_side_by_side(&soft, Forcing::Samples(&samples[..15]), widest));
    let solver = RecordSolver::new(&stiff, 5e-3);
    let starts = starts(&stiff);
    let together = solver.batch(all).run(&starts, RunEnd::OfRecord).expect("bounded motions");
    for (start, outcome) in starts.iter().zip(together) {
        assert_eq!(whole(&solver, *start, all), outcome);
    }
    let none = solver.batch(Forcing::Samples(&[])).run(&starts, RunEnd::OfRecord).expect("no motion");
    assert_eq!(none.len(), starts.len());
}

/// An observer does not change the outcome of a run, and what it is shown ends with the run.
#[test]
fn an_observed_run_is_the_same_run() {
    let samples = shaking();
    let forcing = Forcing::Samples(&samples);
    for &model in DampingModel::ALL {
        let impact = if model == DampingModel::None { Impact::Restitution } else { Impact::None };
        let motion = losing(0.018, model, impact);
        let solver = RecordSolver::new(&motion, 5e-3);
        for start in starts(&motion).into_iter().step_by(4) {
            for end in [RunEnd::OfRecord, RunEnd::AtOverturning] {
                let mut seen = Vec::new();
                let mut observe = |sample: usize, u: f64, v: f64| seen.push((sample, u, v));
                let observed = solver.run_observed(start, forcing, end, &mut observe);
                let outcome = observed.expect("a bounded motion");
                assert_eq!(solver.run(start, forcing, end).expect("the same"), outcome);
                assert!(seen.iter().enumerate().all(|(n, &(sample, ..))| sample == n + 1));
                let &(last, u, v) = seen.last().expect("samples");
                assert_eq!((u, v), (outcome.state.displacement, outcome.state.velocity));
                let stopped = end == RunEnd::AtOverturning && outcome.overturning.is_some();
                assert_eq!(last < samples.len() - 1, stopped);
                if stopped && model == DampingModel::ConstantCoefficient {
                    // each step is a piece, and each corner begins another
                    assert_eq!(outcome.work.pieces, last as u64 + outcome.work.corners);
                }
            }
        }
    }
}

/// A wall of more branches than are prepared goes on by the general search for events beyond them, and comes
/// back.
#[test]
fn many_branches_go_by_the_general_search() {
    // a law that rises to its twelfth corner and falls from there
    let points: Vec<_> = (1..=12).map(|n| 0.02 * f64::from(n)).map(|u| [u, (4.0 * u).sqrt()]).collect();
    let multilinear = Some(points.into_iter().chain([[1.0, 0.0]]).collect());
    let wall = Parameters { height: 6.0, thickness: 0.6, multilinear, ..Parameters::default() };
    let motion = Motion::of(&wall, 1e-8).expect("a valid wall");
    assert!(motion.wall().branches().len() > MOST_BRANCHES);
    let samples = &shaking()[..1000];
    let solver = RecordSolver::new(&motion, 5e-3);
    let start = starts(&motion)[10];
    let outcome = whole(&solver, start, Forcing::Samples(samples));
    let (state, work) = searched(&motion, start, samples, 5e-3);
    assert_eq!(outcome.work.corners, work.corners);
    let u_ins = motion.wall().displacement_scale();
    let apart = (outcome.state.displacement - state.displacement)
        .abs()
        .max((outcome.state.peaks.largest() - state.peaks.largest()).abs());
    // 16 ε for each piece, amplified by up to a thousand
    assert!(apart <= 1e3 * 16.0 * f64::EPSILON * work.pieces as f64 * u_ins, "{:e}", apart / u_ins);
    // many times beyond the eight corners of a side that are prepared
    assert!(state.peaks.largest() > 0.17 * u_ins && work.corners > 100, "{state:?}");
}
