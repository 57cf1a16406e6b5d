//! Eight lanes, each with a run at its own place in the record.
//!
//! Lanes go on by four plain steps at once until all but one of them wait: at a corner, at the end of a stretch, near an extreme
//! in looking back. Those at a corner pass it side by side; what is not ordinary is left to the lane by itself. What a lane
//! does never depends on the others.

use super::super::lane::{Lane, Plain};
use super::super::stretches::AT_ONCE;
use super::super::{Forcing, Passage, RecordSolver, SolverError, Start, Work};
use super::corners::{Arrival, Leaving};
use super::responses::{By, ROWS_AHEAD, Responses};
use super::vector::{Row, Vector, WIDTH};

/// Lanes that go on by plain steps while the others wait, at most: a round of those that wait costs as much as some thirty of
/// plain steps, however few they are.
const FEW: u32 = 1;

/// Runs side by side.
pub(super) struct Lanes<'a, F> {
    solver: &'a RecordSolver<'a>,
    forcing: &'a F,
    largest: &'a [f64],
    responses: &'a Responses,
    starts: &'a [Start],
    until_overturning: bool,
    /// Each lane's run by itself.
    alone: [Option<Lane<'a, F>>; WIDTH],
    /// The run of each lane.
    runs: [usize; WIDTH],
    rows: Rows,
    /// Lanes that have a run; of them those that may take plain steps, those for which [`Lane`] is to take up the next stretch,
    /// those whose u has grown beyond half the reach of f̂.
    busy: u8,
    ready: u8,
    ended: u8,
    grown: u8,
    next: usize,
    passages: Vec<Option<Passage>>,
    failure: Option<(usize, SolverError)>,
}

/// The lanes' numbers while they go side by side; [`Lane`] hears of them by [`Lanes::tell`].
struct Rows {
    /// The sample, and the first at which no plain steps begin.
    index: Row,
    limit: Row,
    factor: Row,
    u: Row,
    v: Row,
    branch: Row,
    /// Of [`Lane`].
    highest: Row,
    lowest: Row,
    largest_forcing: Row,
    /// P + f̂ \[m/s²\], half the reach of f̂ \[m\], up to where u may go by what is known.
    driving: Row,
    half_reach: Row,
    known: [Row; 2],
    /// Corners passed since [`Lane`] was told.
    corners: Row,
    /// Where one step, and four at once, may start and end, u and |u̇|.
    range: [Row; 2],
    range4: [Row; 2],
    fastest: Row,
    /// A h of one step \[m/s\].
    slow: Row,
}

/// Lanes by their bits.
fn each(bits: u8) -> impl Iterator<Item = usize> {
    (0..WIDTH).filter(move |i| bits >> i & 1 == 1)
}

impl<'a, F: Forcing> Lanes<'a, F> {
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        forcing: &'a F,
        largest: &'a [f64],
        responses: &'a Responses,
        starts: &'a [Start],
        until_overturning: bool,
    ) -> Self {
        Self {
            solver,
            forcing,
            largest,
            responses,
            starts,
            until_overturning,
            alone: [const { None }; WIDTH],
            runs: [0; WIDTH],
            rows: Rows::ZERO,
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
    pub(super) fn follow<V: Vector>(&mut self) {
        (0..WIDTH).for_each(|i| self.begin(i));
        while self.busy != 0 {
            self.measure_ranges::<V>();
            if self.ready.count_ones() > FEW.min(self.busy.count_ones() - 1) {
                self.plain::<V>();
            }
            each(self.ended).for_each(|i| self.turn_pages(i));
            let waiting = self.busy & !(self.ready | self.ended);
            each(waiting & self.grown).for_each(|i| self.measure(i));
            let waiting = waiting & !self.grown;
            if waiting != 0 {
                let odd = self.step::<V>(waiting);
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
            let Self { solver, forcing, largest, until_overturning, .. } = *self;
            let plain = Plain { steps: AT_ONCE, growth: self.responses.growth };
            self.alone[i] = Some(Lane::new(solver, forcing, largest, until_overturning, plain, start));
            self.runs[i] = self.next;
            self.rows.factor.0[i] = start.factor;
            self.rows.corners.0[i] = 0.0;
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
        rows.index.0[i] = lane.index as f64;
        rows.limit.0[i] = lane.limit as f64;
        [rows.u.0[i], rows.v.0[i]] = lane.now;
        rows.branch.0[i] = lane.state.branch as f64;
        (rows.highest.0[i], rows.lowest.0[i]) = (lane.highest, lane.lowest);
        rows.largest_forcing.0[i] = lane.largest_forcing;
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
        let corners = rows.corners.0[i] as u64;
        rows.corners.0[i] = 0.0;
        lane.work.add(Work { pieces: 2 * corners, corners, impacts: 0 });
        lane.searched += corners;
        lane.index = rows.index.0[i] as usize;
        lane.forcing_now = rows.factor.0[i] * self.forcing.at(lane.index);
        (lane.highest, lane.lowest) = (rows.highest.0[i], rows.lowest.0[i]);
        (lane.state.displacement, lane.state.velocity) = (rows.u.0[i], rows.v.0[i]);
        lane.state.branch = rows.branch.0[i] as usize;
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

    /// Where the lanes may go, and which of them may take plain steps.
    #[inline(always)]
    fn measure_ranges<V: Vector>(&mut self) {
        let step = self.solver.step;
        let rows = &mut self.rows;
        let branch = self.responses.of(V::load(&rows.branch));
        let driving = V::load(&rows.driving);
        let braked = driving + branch.by(By::Braking) * driving;
        let [most, most4] = [By::Growth, By::Growth4].map(|growth| branch.by(growth) * braked);
        let step4 = AT_ONCE as f64 * step;
        let (margin, margin4) =
            (V::splat(0.125 * step * step) * most, V::splat(0.125 * step4 * step4) * most4);
        let lower = branch.by(By::Lower).max(V::load(&rows.known[0]));
        let upper = branch.by(By::Upper).min(V::load(&rows.known[1]));
        let (low, high) = (lower + margin4, upper - margin4);
        let fastest = branch.by(By::Speed) * driving;
        (lower + margin).store(&mut rows.range[0]);
        (upper - margin).store(&mut rows.range[1]);
        low.store(&mut rows.range4[0]);
        high.store(&mut rows.range4[1]);
        fastest.store(&mut rows.fastest);
        (V::splat(step) * most).store(&mut rows.slow);
        let (u, speed) = (V::load(&rows.u), V::load(&rows.v).abs());
        let inside = low.at_most(u) & u.at_most(high);
        // as fast as that, u̇ keeps its sign over four steps: then u is between its values at their ends
        let steady = (V::splat(step4) * most4).at_most(speed) & lower.at_most(u) & u.at_most(upper);
        let ready = (inside | steady) & speed.at_most(fastest);
        let index = V::load(&rows.index);
        self.sort(u, index, ready);
    }

    /// Finds out which lanes may go on, and which wait for what.
    #[inline(always)]
    fn sort<V: Vector>(&mut self, u: V, index: V, ready: V::Mask) {
        let open = index.below(V::load(&self.rows.limit));
        self.ready = V::bits(ready & open) & self.busy;
        self.ended = V::bits(!open) & self.busy;
        self.grown = V::bits(V::load(&self.rows.half_reach).below(u.abs()));
    }

    /// Plain steps, four at once, until all lanes but a few wait.
    ///
    /// Lanes that wait are taken along, and what they come to is not kept: so no step waits for a comparison.
    #[inline(always)]
    fn plain<V: Vector>(&mut self) {
        let responses = self.responses;
        let rows = &mut self.rows;
        let branch = responses.of(V::load(&rows.branch));
        let start = V::load(&rows.index);
        let room = V::load(&rows.limit) - start;
        let (samples, first_rows) = (start.whole(), branch.by(By::Response).whole());
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers, none negative"
        )]
        let ahead: [&[[f64; 2]]; WIDTH] =
            std::array::from_fn(|i| responses.ahead(first_rows[i] as usize, samples[i] as usize));
        let (uu, uv, u_force) = (branch.by(By::UByU4), branch.by(By::UByV4), branch.by(By::UByForce4));
        let (vu, vv, v_force) = (branch.by(By::VByU4), branch.by(By::VByV4), branch.by(By::VByForce4));
        let factor = V::load(&rows.factor);
        let (low, high, fastest) =
            (V::load(&rows.range4[0]), V::load(&rows.range4[1]), V::load(&rows.fastest));
        let at_once = V::splat(AT_ONCE as f64);
        let mut goes = V::mask(self.ready);
        let (mut u, mut v) = (V::load(&rows.u), V::load(&rows.v));
        let (mut kept_u, mut kept_v, mut kept_gone) = (u, v, V::splat(0.0));
        let started = goes;
        let known_nodes = [V::load(&rows.highest), V::load(&rows.lowest)];
        let (mut highest, mut lowest) = (known_nodes[0].max(u), known_nodes[1].min(u));
        let mut gone = V::splat(0.0);
        let few = FEW.min(self.busy.count_ones() - 1);
        #[allow(clippy::needless_range_loop, reason = "eight tables at once")]
        for row in 0..ROWS_AHEAD {
            let [of_u, of_v] = V::unzip(std::array::from_fn(|i| &ahead[i][row]));
            let next_u = u + ((factor * of_u + u_force) + (uu * u + uv * v));
            v = v + ((factor * of_v + v_force) + (vu * u + vv * v));
            u = next_u;
            goes = goes & low.at_most(u) & u.at_most(high) & v.abs().at_most(fastest) & gone.below(room);
            gone = gone + at_once;
            kept_u = V::choose(goes, u, kept_u);
            kept_v = V::choose(goes, v, kept_v);
            kept_gone = V::choose(goes, gone, kept_gone);
            highest = highest.max(kept_u);
            lowest = lowest.min(kept_u);
            if V::bits(goes).count_ones() <= few {
                break;
            }
        }
        kept_u.store(&mut rows.u);
        kept_v.store(&mut rows.v);
        V::choose(started, highest, known_nodes[0]).store(&mut rows.highest);
        V::choose(started, lowest, known_nodes[1]).store(&mut rows.lowest);
        let index = start + kept_gone;
        index.store(&mut rows.index);
        self.sort(kept_u, index, goes);
    }

    /// One to four steps of lanes that wait, plain ones and at last one that passes a corner; tells which made none.
    #[inline(always)]
    fn step<V: Vector>(&mut self, waiting: u8) -> u8 {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let responses = self.responses;
        let rows = &mut self.rows;
        let branches = V::load(&rows.branch);
        let branch = responses.of(branches);
        let (uu, uv, u0, u1) =
            (branch.by(By::UByU), branch.by(By::UByV), branch.by(By::UByP0), branch.by(By::UByP1));
        let (vu, vv, v0, v1) =
            (branch.by(By::VByU), branch.by(By::VByV), branch.by(By::VByP0), branch.by(By::VByP1));
        let (lower, upper, force) = (branch.by(By::Lower), branch.by(By::Upper), branch.by(By::Force));
        let known = [V::load(&rows.known[0]), V::load(&rows.known[1])];
        let (low, high) = (V::load(&rows.range[0]), V::load(&rows.range[1]));
        let (fastest, slow) = (V::load(&rows.fastest), V::load(&rows.slow));
        let holds = |u: V, v: V| low.at_most(u) & u.at_most(high) & v.abs().at_most(fastest);
        let index = V::load(&rows.index);
        let samples = index.whole();
        // lanes that do not wait may be near the end
        let furthest = self.forcing.count() - 1 - AT_ONCE;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers, none negative"
        )]
        let samples: [&[f64]; WIDTH] =
            std::array::from_fn(|i| self.forcing.from((samples[i] as usize).min(furthest), AT_ONCE + 1));
        let factor = V::load(&rows.factor);
        let forcing = |n: usize| factor * V::load(&Row(std::array::from_fn(|i| samples[i][n])));

        let (mut u, mut v, mut count) = (V::load(&rows.u), V::load(&rows.v), zero);
        let (mut from, mut p0) = ([u, v], forcing(0));
        let mut from_holds = holds(u, v);
        let waits = V::mask(waiting);
        let mut goes = waits;
        let known_nodes = [V::load(&rows.highest), V::load(&rows.lowest)];
        let (mut highest, mut lowest) = (known_nodes[0].max(u), known_nodes[1].min(u));
        let mut leaving = V::mask(0);
        let (mut beyond, mut ends) = ([zero; 2], [zero; 2]);
        for n in 1..=AT_ONCE {
            let p1 = forcing(n);
            let (q0, q1) = (p0 - force, p1 - force);
            let to = [
                from[0] + ((u0 * q0 + u1 * q1) + (uu * from[0] + uv * from[1])),
                from[1] + ((v0 * q0 + v1 * q1) + (vu * from[0] + vv * from[1])),
            ];
            let to_holds = holds(to[0], to[1]);
            let inside = lower.below(to[0]) & to[0].below(upper);
            let (speed0, speed1) = (from[1].abs(), to[1].abs());
            let steady = zero.below(from[1] * to[1])
                & slow.below(speed0 + speed1)
                & speed0.max(speed1).at_most(fastest)
                & known[0].at_most(from[0].min(to[0]))
                & from[0].max(to[0]).at_most(known[1]);
            let stays = goes & ((from_holds & to_holds) | (inside & steady));
            let leaves = goes & !stays & !inside;
            leaving = leaving | leaves;
            beyond = [V::choose(leaves, to[0], beyond[0]), V::choose(leaves, to[1], beyond[1])];
            ends = [V::choose(leaves, p0, ends[0]), V::choose(leaves, p1, ends[1])];
            u = V::choose(stays, to[0], u);
            v = V::choose(stays, to[1], v);
            count = V::choose(stays, count + one, count);
            (highest, lowest) = (highest.max(u), lowest.min(u));
            goes = stays;
            if V::bits(goes) == 0 {
                break;
            }
            (from, p0, from_holds) = (to, p1, to_holds);
        }
        if V::bits(leaving) != 0 {
            let leaving = Leaving {
                lanes: leaving,
                branch: branches,
                from: [u, v],
                to: beyond,
                forcing: ends,
                largest_forcing: V::load(&rows.largest_forcing),
                known,
                step: V::splat(self.solver.step),
                inverse_step: V::splat(1.0 / self.solver.step),
            };
            let Arrival { lanes, end, branch } = leaving.pass(responses);
            u = V::choose(lanes, end[0], u);
            v = V::choose(lanes, end[1], v);
            count = V::choose(lanes, count + one, count);
            V::choose(lanes, branch, branches).store(&mut rows.branch);
            let corners = V::load(&rows.corners);
            V::choose(lanes, corners + one, corners).store(&mut rows.corners);
        }
        V::choose(waits, highest.max(u), known_nodes[0]).store(&mut rows.highest);
        V::choose(waits, lowest.min(u), known_nodes[1]).store(&mut rows.lowest);
        u.store(&mut rows.u);
        v.store(&mut rows.v);
        (index + count).store(&mut rows.index);
        V::bits(count.below(one)) & waiting
    }
}

impl Rows {
    const ZERO: Self = Self {
        index: Row::ZERO,
        limit: Row::ZERO,
        factor: Row::ZERO,
        u: Row::ZERO,
        v: Row::ZERO,
        branch: Row::ZERO,
        highest: Row::ZERO,
        lowest: Row::ZERO,
        largest_forcing: Row::ZERO,
        driving: Row::ZERO,
        half_reach: Row::ZERO,
        known: [Row::ZERO; 2],
        corners: Row::ZERO,
        range: [Row::ZERO; 2],
        range4: [Row::ZERO; 2],
        fastest: Row::ZERO,
        slow: Row::ZERO,
    };

    /// What follows from the forces a lane may meet.
    fn set_reach<F: Forcing>(&mut self, i: usize, lane: &Lane<'_, F>) {
        self.driving.0[i] = lane.largest_forcing + lane.largest_force;
        // in looking back nothing grows
        self.half_reach.0[i] = if lane.looks_back() { f64::INFINITY } else { 0.5 * lane.reach };
        [self.known[0].0[i], self.known[1].0[i]] = lane.known();
    }
}
