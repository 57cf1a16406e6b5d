//! Eight lanes, each with a run at its own place in the record.

use super::super::active_run::{ActiveRun, LaneValues, PlainSteps};
use super::super::block::Nodes;
use super::super::forcing::{AT_ONCE, Blocks};
use super::super::solver::{Outcome, RecordSolver, RunStart, unseen};
use super::responses::Responses;
use super::vector::{Row, WIDTH};
use crate::solver::{SolverError, Work};

/// Runs side by side.
pub(super) struct Lanes<'a> {
    pub(super) solver: &'a RecordSolver<'a>,
    pub(super) record: &'a Blocks<'a>,
    pub(super) responses: &'a Responses,
    pub(super) rows: Rows,
    /// Lanes that have a run.
    pub(super) busy: u8,
    until_overturning: bool,
    starts: &'a [RunStart],
    /// The next start to take up.
    next: usize,
    /// The run of each lane, and its number.
    runs: [Option<ActiveRun<'a>>; WIDTH],
    numbers: [usize; WIDTH],
    outcomes: Vec<Option<Outcome>>,
    /// The first run that could not be followed.
    failure: Option<(usize, SolverError)>,
}

/// The lanes' numbers while they go side by side.
#[derive(Default)]
#[repr(align(64))]
pub(super) struct Rows {
    /// The sample, and the first at which no plain steps begin.
    pub(super) index: Row,
    pub(super) limit: Row,
    pub(super) factor: Row,
    pub(super) u: Row,
    pub(super) v: Row,
    pub(super) branch: Row,
    /// Extremes of u at the ends of plain steps \[m\].
    pub(super) highest: Row,
    pub(super) lowest: Row,
    /// P and D = P + f̂ \[m/s²\].
    pub(super) forcing: Row,
    pub(super) driving: Row,
    /// The |u| beyond which f̂ is to be taken anew, and where u is known to stay \[m\].
    pub(super) half_reach: Row,
    pub(super) limits: [Row; 2],
    /// Corners passed side by side, of these the passages of u = 0, and the steps that passed any.
    pub(super) corners: Row,
    pub(super) impacts: Row,
    pub(super) crossings: Row,
    /// Where one step, and four at once, may start and end, u and |u̇|.
    pub(super) range: [Row; 2],
    pub(super) range4: [Row; 2],
    pub(super) speed: Row,
    /// A h of one step \[m/s\].
    pub(super) velocity_change: Row,
}

impl Rows {
    fn enter(&mut self, i: usize, values: &LaneValues) {
        self.index[i] = values.index as f64;
        self.limit[i] = values.limit as f64;
        [self.u[i], self.v[i]] = values.now;
        self.branch[i] = values.branch as f64;
        (self.highest[i], self.lowest[i]) = (values.nodes.highest, values.nodes.lowest);
        (self.forcing[i], self.driving[i]) = (values.forcing, values.driving);
        self.half_reach[i] = values.half_reach;
        [self.limits[0][i], self.limits[1][i]] = values.limits;
    }
}

impl<'a> Lanes<'a> {
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        record: &'a Blocks<'a>,
        responses: &'a Responses,
        starts: &'a [RunStart],
        until_overturning: bool,
    ) -> Self {
        Self {
            solver,
            record,
            responses,
            rows: Rows::default(),
            busy: 0,
            until_overturning,
            starts,
            next: 0,
            runs: [const { None }; WIDTH],
            numbers: [0; WIDTH],
            outcomes: vec![None; starts.len()],
            failure: None,
        }
    }

    /// Returns what became of the runs.
    ///
    /// # Errors
    /// Of the first run that could not be followed.
    pub(super) fn outcomes(self) -> Result<Vec<Outcome>, SolverError> {
        match self.failure {
            Some((_, error)) => Err(error),
            None => Ok(self.outcomes.into_iter().flatten().collect()),
        }
    }

    /// Gives a lane the next run that goes side by side, if there is one.
    pub(super) fn fill(&mut self, i: usize) {
        self.busy &= !(1 << i);
        while let Some(&start) = self.starts.get(self.next) {
            let plain = PlainSteps { at_once: AT_ONCE, growth: self.responses.growth, parts: false };
            let run = ActiveRun::new(self.solver, self.record, self.until_overturning, plain, start);
            self.runs[i] = Some(run);
            self.numbers[i] = self.next;
            self.rows.factor[i] = start.factor;
            self.next += 1;
            if self.advance(i, false) {
                self.busy |= 1 << i;
                return;
            }
        }
    }

    /// Lets the run of a lane go on by itself, by one step at least if asked to, until it may go side by side
    /// again; where it ends the lane gets another.
    pub(super) fn go_alone(&mut self, i: usize, step: bool) {
        self.hand_back(i);
        if !self.advance(i, step) {
            self.fill(i);
        }
    }

    /// Takes the bound on the forces of a lane anew.
    pub(super) fn bound_force(&mut self, i: usize) {
        self.hand_back(i);
        if let Some(run) = &mut self.runs[i] {
            run.bound_force();
            if let Some(values) = run.lane_values() {
                self.rows.enter(i, &values);
            }
        }
    }

    /// Lets a run go by itself until it may go side by side; tells whether that comes before its end.
    fn advance(&mut self, i: usize, mut step: bool) -> bool {
        let Some(run) = &mut self.runs[i] else { return false };
        loop {
            if step && let Err(error) = run.step(&mut unseen) {
                if self.failure.as_ref().is_none_or(|(first, _)| self.numbers[i] < *first) {
                    self.failure = Some((self.numbers[i], error));
                }
                return false;
            }
            if let Some(outcome) = run.next_block(&mut unseen) {
                self.outcomes[self.numbers[i]] = Some(outcome);
                return false;
            }
            if let Some(values) = run.lane_values() {
                self.rows.enter(i, &values);
                return true;
            }
            step = true;
        }
    }

    /// Tells the run of a lane where that has taken it.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole numbers, none negative"
    )]
    fn hand_back(&mut self, i: usize) {
        let rows = &mut self.rows;
        if let Some(run) = &mut self.runs[i] {
            let nodes = Nodes { highest: rows.highest[i], lowest: rows.lowest[i] };
            let (index, branch) = (rows.index[i] as usize, rows.branch[i] as usize);
            let [corners, impacts, crossings] = [&mut rows.corners, &mut rows.impacts, &mut rows.crossings]
                .map(|row| std::mem::take(&mut row[i]) as u64);
            // each step makes one piece more than it passes corners
            let work = Work { pieces: crossings + corners, corners, impacts };
            run.resume(index, [rows.u[i], rows.v[i]], branch, nodes, work);
        }
    }
}
