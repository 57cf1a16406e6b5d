//! What the tests of runs side by side need. They stand outside of this crate: inside, rustc would compile
//! every step again for each width of vectors.

use rocking_wall::solver::SolverError;

use crate::blocks::Blocks;
use crate::common::Common;
use crate::forcing::Forcing;
use crate::lanes::{Lanes, Waiting};
use crate::run::{BatchRun, NoObserver, Outcome, RunEnd, RunStart};
use crate::solver::RecordSolver;
use crate::together::follow;

pub use crate::number::{MOST_BRANCHES, Vectors};
pub use crate::together::run_together_on;

/// How a run goes among others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// By itself.
    Alone,
    /// Side by side, from the samples of the record.
    SideBySide,
    /// Side by side, from responses that were prepared for this wall and record.
    Prepared,
}

/// Returns how a run goes among others.
pub fn way(run: &BatchRun<'_>) -> Way {
    match run.record.common(run.solver) {
        None => Way::Alone,
        Some(Common::Prepared(_)) => Way::Prepared,
        Some(Common::Affine { .. } | Common::Curved { .. }) => Way::SideBySide,
    }
}

/// Returns how many plain steps are taken at once.
pub fn at_once(solver: &RecordSolver<'_>) -> usize {
    solver.table.at_once
}

/// What runs side by side take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rounds {
    /// Calls that take steps side by side, until lanes wait.
    pub rounds: u32,
    /// Times that a lane has to go on by itself.
    pub to_resolve: u32,
}

/// Moves a wall through a whole record that is prepared for it, and counts the rounds.
///
/// # Errors
/// As of [`Batch::run`](crate::Batch::run).
///
/// # Panics
/// If the runs do not go side by side, or the record could not be prepared for a wall with constant damping.
pub fn counted(
    solver: &RecordSolver<'_>,
    forcing: Forcing<'_>,
    starts: &[RunStart],
    vectors: Vectors,
) -> Result<(Vec<Outcome>, Rounds), SolverError> {
    let record = Blocks::on(solver, forcing, Some(vectors));
    let given: Vec<_> = starts.iter().map(|&start| BatchRun { solver, record: &record, start }).collect();
    let lanes = Lanes::new(&given, RunEnd::OfRecord, NoObserver);
    let mut counted = Rounds::default();
    let mut count = |waiting: Waiting| {
        counted.rounds += 1;
        counted.to_resolve += waiting.to_resolve.count_ones();
    };
    let kind = match record.common(solver) {
        Some(kind @ (Common::Prepared(_) | Common::Curved { .. })) => kind,
        None | Some(Common::Affine { .. }) => {
            panic!("the runs go one by one, or the record is not prepared for the wall")
        }
    };
    let outcomes = follow(Some((vectors, kind)), lanes, &mut count).into_iter().collect::<Result<_, _>>()?;
    Ok((outcomes, counted))
}
