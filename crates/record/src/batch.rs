//! Runs through records: one, or many of one wall.

use rocking_wall::solver::SolverError;

use crate::blocks::Blocks;
use crate::forcing::Forcing;
use crate::lanes::Lanes;
use crate::number::{Vectors, WIDTH};
use crate::run::{BatchRun, NoObserver, Observer, Outcome, RunEnd, RunStart};
use crate::solver::RecordSolver;
use crate::together::run_together_on;

/// Runs that go side by side in a [`Batch`]. A batch of fewer leaves lanes empty.
pub const LANES: usize = WIDTH;

impl RecordSolver<'_> {
    /// Moves a wall through a record, up to `end`. A record of one sample, or of none, leaves the wall as it
    /// was.
    ///
    /// # Errors
    /// [`SolverError`] if the motion could not be followed: too many pieces of motion in one step, or numbers
    /// that are not finite. Its times count from the start of the step, or of what was left of it.
    pub fn run(&self, start: RunStart, forcing: Forcing<'_>, end: RunEnd) -> Result<Outcome, SolverError> {
        self.run_through(start, &Blocks::new(forcing), end, NoObserver)
    }

    /// Moves a wall through a record as [`run`](Self::run) does, and shows `observe` the number, u \[m\] and
    /// u̇ \[m/s\] of each sample after the first, in their order. Sample 0 is the state given.
    ///
    /// ```
    /// # use record::{Forcing, RecordSolver, RunEnd, RunStart};
    /// # use rocking_wall::solver::Motion;
    /// # use rocking_wall::wall::{Parameters, Support};
    /// # let parameters = Parameters::default();
    /// # let motion = Motion::of(&parameters, parameters.tolerance)?;
    /// // free vibration from 10 mm, in steps of 5 ms
    /// let start = RunStart { state: motion.start(0.01, 0.0, Support::default()), factor: 1.0 };
    /// let solver = RecordSolver::new(&motion, 5e-3);
    /// let mut history = vec![0.01];
    /// let mut observe = |_, u, _| history.push(u);
    /// let outcome = solver.run_observed(start, Forcing::Still(401), RunEnd::OfRecord, &mut observe)?;
    /// assert_eq!(history.len(), 401);
    /// assert_eq!(history[400], outcome.state.displacement);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn run_observed(
        &self,
        start: RunStart,
        forcing: Forcing<'_>,
        end: RunEnd,
        observe: &mut dyn FnMut(usize, f64, f64),
    ) -> Result<Outcome, SolverError> {
        self.run_through(start, &Blocks::new(forcing), end, observe)
    }

    /// Moves a wall through a record whose blocks are known.
    fn run_through(
        &self,
        start: RunStart,
        record: &Blocks<'_>,
        end: RunEnd,
        observer: impl Observer,
    ) -> Result<Outcome, SolverError> {
        let given = [BatchRun { solver: self, record, start }];
        let mut outcomes = Lanes::new(&given, end, observer).one_by_one();
        outcomes.swap_remove(0)
    }

    /// Prepares a record for many runs, with the widest vectors of this processor. A large record may take
    /// some MB for each branch.
    pub fn batch<'b>(&'b self, forcing: Forcing<'b>) -> Batch<'b> {
        self.batch_on(forcing, Vectors::widest())
    }

    /// Prepares a record for some vectors; `None` lets runs go one by one.
    #[doc(hidden)]
    pub fn batch_on<'b>(&'b self, forcing: Forcing<'b>, vectors: Option<Vectors>) -> Batch<'b> {
        Batch { solver: self, record: Blocks::on(self, forcing, vectors), vectors }
    }
}

/// A record prepared for many runs of one wall.
///
/// What becomes of a run never depends on the other runs. Where processor, wall and step allow it, eight runs
/// go side by side, with the same bits on every processor. With constant damping each has the bits of
/// [`RecordSolver::run`]; with secant damping it agrees with that within the tolerance.
///
/// ```
/// use record::{Forcing, RecordSolver, RunEnd, RunStart};
/// use rocking_wall::solver::Motion;
/// use rocking_wall::wall::{Parameters, Support};
///
/// let parameters = Parameters { u_start: 0.0, ..Parameters::default() };
/// let motion = Motion::of(&parameters, parameters.tolerance)?;
/// let samples: Vec<f64> = (0..500).map(|n| (0.06 * f64::from(n)).sin()).collect();
/// let solver = RecordSolver::new(&motion, 0.01);
/// let state = motion.start(0.0, 0.0, Support::default());
/// let starts = [0.1, 1.0, 100.0].map(|factor| RunStart { state, factor });
/// let outcomes = solver.batch(Forcing::Samples(&samples)).run(&starts, RunEnd::AtOverturning)?;
/// assert!(outcomes[0].overturning.is_none() && outcomes[2].overturning.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Batch<'a> {
    solver: &'a RecordSolver<'a>,
    record: Blocks<'a>,
    vectors: Option<Vectors>,
}

impl Batch<'_> {
    /// Returns whether runs go side by side, not one by one. They go one by one on a processor without AVX2,
    /// and where the wall, the step or the length of the record does not suit.
    pub fn is_side_by_side(&self) -> bool {
        self.vectors.is_some() && self.record.common(self.solver).is_some()
    }

    /// Moves walls through the record, each as if it were alone and up to `end`. Returns one outcome for each
    /// start, in their order.
    ///
    /// # Errors
    /// [`SolverError`] of the first start that could not be followed, as of [`RecordSolver::run`].
    pub fn run(&self, starts: &[RunStart], end: RunEnd) -> Result<Vec<Outcome>, SolverError> {
        let given = |&start| BatchRun { solver: self.solver, record: &self.record, start };
        let given: Vec<_> = starts.iter().map(given).collect();
        run_together_on(&given, end, self.vectors).into_iter().collect()
    }
}
