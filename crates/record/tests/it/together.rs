//! Runs of several walls through several records together, beside runs by themselves and batches of one wall.

use record::testing::{Way, at_once, run_together_on, way};
use record::{LANES, run_together};

use super::*;

/// Every wall through every record at a few factors, in an order that mixes all three.
fn mixed<'a>(solvers: &'a [RecordSolver<'a>], records: &'a [Blocks<'a>]) -> Vec<BatchRun<'a>> {
    let count = solvers.len() * records.len() * 3;
    let run = |n: usize| {
        let (solver, record) = (&solvers[n % solvers.len()], &records[n / solvers.len() % records.len()]);
        let state = solver.motion().start(0.0, 0.0, Support::default());
        let factor = [1.2, -0.8, 0.5][n * 7 % 3];
        BatchRun { solver, record, start: RunStart { state, factor } }
    };
    (0..count).map(run).collect()
}

/// Parts of a record, of different lengths.
fn parts(samples: &[f64]) -> Vec<Blocks<'_>> {
    let ends = [(0, 6000), (500, 2100), (1000, 1300), (2000, 2004)];
    ends.iter().map(|&(first, last)| Blocks::new(Forcing::Samples(&samples[first..last]))).collect()
}

/// All vectors of the processor, and none.
fn vectors_and_none() -> impl Iterator<Item = Option<Vectors>> {
    Vectors::all().map(Some).chain([None])
}

/// With constant damping a run among others has the bits of a run by itself, wherever it ends.
#[test]
fn runs_with_constant_damping_are_those_by_themselves() {
    let bouncing = |a1| losing(a1, DampingModel::None, Impact::Restitution);
    // the last but one has other steps at once, the last goes by itself
    let motions =
        [motion(0.018), motion(0.01), bouncing(0.018), bouncing(2.4e-3), rigid(), motion(8e-4), motion(1e-5)];
    let samples = shaking();
    let (solvers, records): (Vec<_>, _) =
        (motions.iter().map(|motion| RecordSolver::new(motion, 5e-3)).collect(), parts(&samples));
    assert!(solvers.iter().any(|solver| at_once(solver) != at_once(&solvers[0])));
    let runs = mixed(&solvers, &records);
    // the first runs are those of each wall through the first record
    let by_itself: Vec<_> = runs[..solvers.len()].iter().map(|run| way(run) == Way::Alone).collect();
    assert_eq!(by_itself, [false, false, false, false, false, false, true]);
    for end in [RunEnd::OfRecord, RunEnd::AtOverturning, RunEnd::AtPeaks] {
        let alone = |run: &BatchRun<'_>| run.solver.run(run.start, run.record.forcing(), end);
        let alone: Vec<Outcome> = runs.iter().map(alone).collect::<Result<_, _>>().expect("bounded motions");
        let overturned = alone.iter().filter(|outcome| outcome.overturning.is_some()).count();
        assert!((5..runs.len() - 5).contains(&overturned), "{overturned}");
        for vectors in vectors_and_none() {
            let together = run_together_on(&runs, end, vectors);
            for (number, (together, alone)) in together.into_iter().zip(&alone).enumerate() {
                assert_eq!(together.as_ref(), Ok(alone), "run {number}, {end:?}, {vectors:?}");
            }
        }
    }
}

/// Records prepared for a wall change no bit: its runs go together through all of them, and those of another
/// wall as without.
#[test]
fn prepared_records_change_no_bit() {
    let motions = [motion(0.018), losing(0.018, DampingModel::None, Impact::Restitution)];
    let samples = shaking();
    let (solvers, records): (Vec<_>, _) =
        (motions.iter().map(|motion| RecordSolver::new(motion, 5e-3)).collect(), parts(&samples));
    for vectors in vectors_and_none() {
        let prepared: Vec<_> =
            records.iter().map(|record| Blocks::on(&solvers[0], record.forcing(), vectors)).collect();
        let runs = mixed(&solvers, &prepared);
        // all but the record of four samples, for one wall of two
        let expected = if vectors.is_some() { runs.len() * 3 / 8 } else { 0 };
        assert_eq!(runs.iter().filter(|run| way(run) == Way::Prepared).count(), expected);
        for end in [RunEnd::OfRecord, RunEnd::AtOverturning, RunEnd::AtPeaks] {
            let wanted = run_together_on(&mixed(&solvers, &records), end, None);
            assert_eq!(run_together_on(&runs, end, vectors), wanted, "{end:?}, {vectors:?}");
        }
    }
}

/// With secant damping a run among others has the bits of a batch of one wall and record.
#[test]
fn runs_with_secant_damping_are_those_of_batches() {
    let motions = [
        losing(0.018, DampingModel::ConstantRatio, Impact::None),
        losing(0.01, DampingModel::StiffnessProportional, Impact::None),
        losing(0.012, DampingModel::ConstantRatio, Impact::None),
        motion(0.018),
    ];
    let samples = shaking();
    let (solvers, records): (Vec<_>, _) =
        (motions.iter().map(|motion| RecordSolver::new(motion, 5e-3)).collect(), parts(&samples));
    let runs = mixed(&solvers, &records);
    for vectors in vectors_and_none() {
        let together = run_together_on(&runs, RunEnd::OfRecord, vectors);
        for (run, together) in runs.iter().zip(together) {
            let batch = run.solver.batch_on(run.record.forcing(), vectors);
            let alone = batch.run(&[run.start], RunEnd::OfRecord).expect("a bounded motion")[0];
            assert_eq!(together, Ok(alone), "{vectors:?}");
        }
    }
}

/// A run does not depend on which others there are, nor on how many.
#[test]
fn runs_do_not_depend_on_the_others() {
    let motions = [motion(0.018), losing(0.018, DampingModel::ConstantRatio, Impact::None), motion(0.014)];
    let samples = shaking();
    let (solvers, records): (Vec<_>, _) =
        (motions.iter().map(|motion| RecordSolver::new(motion, 5e-3)).collect(), parts(&samples));
    let runs = mixed(&solvers, &records);
    let all = run_together_on(&runs, RunEnd::AtPeaks, Vectors::widest());
    for count in [1, 2, LANES + 1] {
        let groups = runs.chunks(count).flat_map(|runs| run_together(runs, RunEnd::AtPeaks));
        assert_eq!(groups.collect::<Vec<_>>(), all, "{count} at a time");
    }
    assert!(run_together(&[], RunEnd::AtPeaks).is_empty());
}

/// A run that fails has its own error, and the others have their outcomes.
#[test]
fn a_run_that_fails_leaves_the_others() {
    let (motion, samples) = (motion(0.018), shaking());
    let solvers = [RecordSolver::new(&motion, 5e-3)];
    let records = parts(&samples);
    let mut runs = mixed(&solvers, &records);
    runs[4].start.factor = 1e305;
    let outcomes = run_together(&runs, RunEnd::OfRecord);
    for (number, (run, outcome)) in runs.iter().zip(outcomes).enumerate() {
        assert_eq!(outcome.is_err(), number == 4);
        assert_eq!(outcome, run.solver.run(run.start, run.record.forcing(), RunEnd::OfRecord));
    }
}

/// Of runs that fail side by side the error is that of the first, as if they went one by one.
#[test]
fn a_batch_fails_with_its_first_error() {
    let (motion, samples) = (motion(0.018), shaking());
    let (solver, record) = (RecordSolver::new(&motion, 5e-3), Forcing::Samples(&samples));
    let mut starts = starts(&motion);
    for number in [5, 3, 7] {
        starts[number].factor = 1e305;
        starts[number].state.velocity = 1e-6 * number as f64;
    }
    let error = solver.batch(record).run(&starts, RunEnd::OfRecord).unwrap_err();
    assert_eq!(error, solver.run(starts[3], record, RunEnd::OfRecord).unwrap_err());
    assert_ne!(error, solver.run(starts[5], record, RunEnd::OfRecord).unwrap_err());
}
