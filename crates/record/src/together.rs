//! Runs of any walls through any records together.

use rocking_wall::solver::SolverError;

use crate::common::Common;
use crate::lanes::{Lanes, Waiting};
use crate::number::Vectors;
use crate::run::{BatchRun, NoObserver, Outcome, RunEnd};
#[cfg(target_arch = "x86_64")]
use crate::wide::in_lanes;

/// Moves walls through records, each run as if it were alone; returns what became of each, in their order.
///
/// Walls, records and factors may all differ. Runs go side by side where they have the same law of damping
/// and step, and about the same stiffness for their step; so many runs are faster in one call than in
/// several. A run never depends on the others: with constant damping it has the bits of
/// [`RecordSolver::run`](crate::RecordSolver::run), with secant damping those of a [`Batch`](crate::Batch).
///
/// Many factors of one wall and record are faster still in a [`Batch`](crate::Batch), or here if the record
/// is prepared for the wall ([`Blocks::for_many`](crate::Blocks::for_many)).
///
/// ```
/// use record::{BatchRun, Blocks, Forcing, RecordSolver, RunEnd, RunStart, run_together};
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::{Parameters, Support};
///
/// // walls of 1 and 2 m, each through a record of its own
/// let motion = |height| {
///     let parameters = Parameters { height, u_start: 0.0, ..Parameters::default() };
///     Motion::of(&parameters, parameters.tolerance)
/// };
/// let motions = [motion(1.0)?, motion(2.0)?];
/// let samples = [0.06, 0.03].map(|rate| (0..500).map(|n| (rate * f64::from(n)).sin()).collect::<Vec<_>>());
/// let solvers = motions.each_ref().map(|motion| RecordSolver::new(motion, 0.01));
/// let records = [0, 1].map(|n| Blocks::new(Forcing::Samples(&samples[n])));
/// let runs = [0, 1].map(|n| {
///     let start = RunStart { state: motions[n].start(0.0, 0.0, Support::default()), factor: 0.5 };
///     BatchRun { solver: &solvers[n], record: &records[n], start }
/// });
/// let outcomes = run_together(&runs, RunEnd::AtOverturning);
/// let alone = solvers[1].run(runs[1].start, Forcing::Samples(&samples[1]), RunEnd::AtOverturning);
/// assert_eq!(outcomes[1], alone);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run_together(runs: &[BatchRun<'_>], end: RunEnd) -> Vec<Result<Outcome, SolverError>> {
    run_together_on(runs, end, Vectors::widest())
}

/// Moves walls as [`run_together`] does, with some vectors; `None` lets runs go one by one.
pub fn run_together_on(
    runs: &[BatchRun<'_>],
    end: RunEnd,
    vectors: Option<Vectors>,
) -> Vec<Result<Outcome, SolverError>> {
    let mut kinds: Vec<(Option<Common<'_>>, Vec<usize>)> = Vec::new();
    for (number, run) in runs.iter().enumerate() {
        let kind = vectors.and_then(|_| run.record.common(run.solver));
        match kinds.iter_mut().find(|(known, _)| *known == kind) {
            Some((_, numbers)) => numbers.push(number),
            None => kinds.push((kind, vec![number])),
        }
    }
    let mut outcomes: Vec<(usize, _)> = Vec::with_capacity(runs.len());
    for (kind, numbers) in kinds {
        let given: Vec<_> = numbers.iter().map(|&number| runs[number]).collect();
        let lanes = Lanes::new(&given, end, NoObserver);
        outcomes.extend(numbers.into_iter().zip(follow(vectors.zip(kind), lanes, &mut |_| ())));
    }
    outcomes.sort_by_key(|(number, _)| *number);
    outcomes.into_iter().map(|(_, outcome)| outcome).collect()
}

/// Follows runs, side by side with some vectors or one by one. `watch` is shown which lanes wait after each
/// round.
#[cfg_attr(not(target_arch = "x86_64"), allow(unused_variables, reason = "no rounds to watch"))]
pub(crate) fn follow(
    side_by_side: Option<(Vectors, Common<'_>)>,
    lanes: Lanes<'_, NoObserver>,
    watch: &mut dyn FnMut(Waiting),
) -> Vec<Result<Outcome, SolverError>> {
    match side_by_side {
        #[cfg(target_arch = "x86_64")]
        Some((Vectors::Avx2(simd), kind)) => in_lanes(simd, kind, lanes, watch),
        #[cfg(target_arch = "x86_64")]
        Some((Vectors::Avx512(simd), kind)) => in_lanes(simd, kind, lanes, watch),
        _ => lanes.one_by_one(),
    }
}
