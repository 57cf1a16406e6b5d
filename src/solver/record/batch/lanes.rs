//! Eight lanes, each with a run at its own place in the record.
//!
//! Lanes go on by four plain steps at once until all but one of them wait: at a corner, at the end of a stretch, near an extreme
//! in looking back. Those at a corner pass it side by side; what is not ordinary is left to the lane by itself. What a lane
//! does never depends on the others.

use fearless_simd::Simd;

use super::super::lane::{Lane, Plain};
use super::super::stretches::AT_ONCE;
use super::super::{Forcing, Passage, SolverError, Start, Work};
use super::Batch;
use super::responses::Responses;
use super::vector::{Row, WIDTH};

/// Runs side by side.
pub(super) struct Lanes<'a, F> {
    pub(super) batch: &'a Batch<'a, F>,
    pub(super) responses: &'a Responses,
    starts: &'a [Start],
    until_overturning: bool,
    /// Each lane's run by itself.
    alone: [Option<Lane<'a, F>>; WIDTH],
    /// The run of each lane.
    runs: [usize; WIDTH],
    pub(super) rows: Rows,
    /// Lanes that have a run; of them those that may take plain steps, those for which [`Lane`] is to take up the next stretch,
    /// those whose u has grown beyond half the reach of f̂.
    pub(super) busy: u8,
    pub(super) ready: u8,
    pub(super) ended: u8,
    pub(super) grown: u8,
    next: usize,
    passages: Vec<Option<Passage>>,
    failure: Option<(usize, SolverError)>,
}

/// The lanes' numbers while they go side by side; [`Lane`] hears of them by [`Lanes::tell`].
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
    /// Of [`Lane`].
    pub(super) highest: Row,
    pub(super) lowest: Row,
    pub(super) largest_forcing: Row,
    /// P + f̂ \[m/s²\], half the reach of f̂ \[m\], up to where u may go by what is known.
    pub(super) driving: Row,
    pub(super) half_reach: Row,
    pub(super) known: [Row; 2],
    /// Corners passed since [`Lane`] was told.
    pub(super) corners: Row,
    /// Where one step, and four at once, may start and end, u and |u̇|.
    pub(super) range: [Row; 2],
    pub(super) range4: [Row; 2],
    pub(super) fastest: Row,
    /// A h of one step \[m/s\].
    pub(super) slow: Row,
}

/// Lanes by their bits.
fn each(bits: u8) -> impl Iterator<Item = usize> {
    (0..WIDTH).filter(move |i| bits >> i & 1 == 1)
}

impl<'a, F: Forcing> Lanes<'a, F> {
    pub(super) fn new(
        batch: &'a Batch<'a, F>,
        responses: &'a Responses,
        starts: &'a [Start],
        until_overturning: bool,
    ) -> Self {
        Self {
            batch,
            responses,
            starts,
            until_overturning,
            alone: [const { None }; WIDTH],
            runs: [0; WIDTH],
            rows: Rows::default(),
            busy: 0,
            ready: 0,
            ended: 0,
            grown: 0,
            next: 0,
            passages: vec![None; starts.len()],
            failure: None,
        }
    }

    /// Follows all runs to their ends.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(&mut self, simd: S) {
        (0..WIDTH).for_each(|i| self.begin(i));
        while self.busy != 0 {
            self.measure_ranges(simd);
            if self.ready.count_ones() > self.few() {
                self.plain(simd);
            }
            each(self.ended).for_each(|i| self.turn_pages(i));
            let waiting = self.busy & !(self.ready | self.ended);
            each(waiting & self.grown).for_each(|i| self.measure(i));
            let waiting = waiting & !self.grown;
            if waiting != 0 {
                let odd = self.step(simd, waiting);
                each(odd).for_each(|i| self.step_alone(i));
            }
        }
    }

    /// What became of the runs.
    ///
    /// # Errors
    /// Of the first run that could not be followed.
    pub(super) fn passages(self) -> Result<Vec<Passage>, SolverError> {
        match self.failure {
            Some((_, error)) => Err(error),
            None => Ok(self.passages.into_iter().flatten().collect()),
        }
    }

    /// Takes up the next run, if there is one.
    fn begin(&mut self, i: usize) {
        self.busy &= !(1 << i);
        while let Some(&start) = self.starts.get(self.next) {
            let Batch { solver, forcing, ref largest, .. } = *self.batch;
            let plain = Plain { steps: AT_ONCE, growth: self.responses.growth };
            self.alone[i] = Some(Lane::new(solver, forcing, largest, self.until_overturning, plain, start));
            self.runs[i] = self.next;
            self.rows.factor[i] = start.factor;
            self.rows.corners[i] = 0.0;
            self.next += 1;
            if self.bring(i) {
                self.busy |= 1 << i;
                return;
            }
        }
    }

    /// Lets the lane go by itself until it may go on side by side; tells whether that comes before its run is over.
    fn bring(&mut self, i: usize) -> bool {
        let Some(lane) = &mut self.alone[i] else { return false };
        let unseen = &mut |_, _, _| {};
        loop {
            if let Some(passage) = lane.turn_pages(unseen) {
                self.passages[self.runs[i]] = Some(passage);
                return false;
            }
            if lane.map.is_some() && lane.index < lane.limit {
                break;
            }
            if let Err(error) = lane.step(unseen) {
                return self.fail(i, error);
            }
        }
        let rows = &mut self.rows;
        rows.index[i] = lane.index as f64;
        rows.limit[i] = lane.limit as f64;
        [rows.u[i], rows.v[i]] = lane.now;
        rows.branch[i] = lane.state.branch as f64;
        (rows.highest[i], rows.lowest[i]) = (lane.highest, lane.lowest);
        rows.largest_forcing[i] = lane.largest_forcing;
        rows.set_reach(i, lane);
        true
    }

    /// Gives up a run that could not be followed: its lane does not go on.
    fn fail(&mut self, i: usize, error: SolverError) -> bool {
        let run = self.runs[i];
        if self.failure.as_ref().is_none_or(|(first, _)| run < *first) {
            self.failure = Some((run, error));
        }
        false
    }

    /// Tells the lane where it has come to.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole numbers, none negative"
    )]
    fn tell(&mut self, i: usize) -> Option<&mut Lane<'a, F>> {
        let rows = &mut self.rows;
        let lane = self.alone[i].as_mut()?;
        let corners = rows.corners[i] as u64;
        rows.corners[i] = 0.0;
        lane.work.add(Work { pieces: 2 * corners, corners, impacts: 0 });
        lane.searched += corners;
        lane.index = rows.index[i] as usize;
        lane.forcing_now = rows.factor[i] * self.batch.forcing.at(lane.index);
        (lane.highest, lane.lowest) = (rows.highest[i], rows.lowest[i]);
        (lane.state.displacement, lane.state.velocity) = (rows.u[i], rows.v[i]);
        lane.state.branch = rows.branch[i] as usize;
        lane.load();
        Some(lane)
    }

    /// At the end of a stretch.
    fn turn_pages(&mut self, i: usize) {
        self.tell(i);
        if !self.bring(i) {
            self.begin(i);
        }
    }

    /// Takes the forces the lane may meet anew.
    fn measure(&mut self, i: usize) {
        if let Some(lane) = self.tell(i) {
            lane.measure();
        }
        if let Some(lane) = &self.alone[i] {
            self.rows.set_reach(i, lane);
        }
    }

    /// One step of a lane by itself.
    fn step_alone(&mut self, i: usize) {
        let result = self.tell(i).map_or(Ok(()), |lane| lane.step(&mut |_, _, _| {}));
        let goes_on = match result {
            Ok(()) => self.bring(i),
            Err(error) => self.fail(i, error),
        };
        if !goes_on {
            self.begin(i);
        }
    }
}

impl Rows {
    /// What follows from the forces a lane may meet.
    fn set_reach<F: Forcing>(&mut self, i: usize, lane: &Lane<'_, F>) {
        self.driving[i] = lane.largest_forcing + lane.largest_force;
        // in looking back nothing grows
        self.half_reach[i] = if lane.looks_back() { f64::INFINITY } else { 0.5 * lane.reach };
        [self.known[0][i], self.known[1][i]] = lane.known();
    }
}
