//! What runs have in common that go side by side.

use crate::solver::RecordSolver;
use crate::table::{LONGEST, Law, Stepping};

/// Fewest samples of a record whose runs go side by side.
const FEWEST_SAMPLES: usize = 16;

/// What runs have in common that go side by side: the numbers that a vector has once for all of its lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Common<'a> {
    /// One wall, with constant damping on all branches, through records prepared for it: steps are affine
    /// maps of several at once, by the responses of its branches to the records.
    Prepared(*const RecordSolver<'a>),
    /// All branches have constant damping: the same steps, by the samples of the records.
    Affine {
        step: f64,
        at_once: usize,
        /// The terms of the series of motion, which are summed in pairs.
        pairs: usize,
    },
    /// Damping follows the secant stiffness: steps on such branches, by Taylor series.
    Curved { step: f64, law: Law },
}

impl Common<'_> {
    /// Returns what a run through `count` samples has in common with others; `None` if it goes by itself.
    pub(crate) fn of(solver: &RecordSolver<'_>, count: usize) -> Option<Self> {
        let RecordSolver { step, table, .. } = solver;
        if table.steppings.contains(&Stepping::Curved) {
            return Some(Self::Curved { step: *step, law: table.law });
        }
        let is_affine = table.steppings.iter().all(|stepping| *stepping == Stepping::Affine);
        let suits = is_affine && table.longest <= LONGEST && count >= FEWEST_SAMPLES;
        suits.then(|| Self::Affine { step: *step, at_once: table.at_once, pairs: table.terms.div_ceil(2) })
    }
}
