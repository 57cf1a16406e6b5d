//! Runs of one wall side by side, step by step.

use super::super::event::{Kinematics, Verdict, crossing, settle};
use super::super::run::Run;
use super::super::{Memo, Phase, Report, SolverError, State, Work};
use super::{Forcing, Passage, RecordSolver, StepMap};

/// Runs side by side.
pub(super) struct Lanes<'a, const N: usize> {
    solver: &'a RecordSolver<'a>,
    pub(super) u: [f64; N],
    pub(super) v: [f64; N],
    /// Coefficients of the step of each lane's branch.
    to_u: [[f64; N]; 5],
    to_v: [[f64; N]; 5],
    /// Range of u and of |u̇| within which a step is plain.
    low: [f64; N],
    high: [f64; N],
    fastest: [f64; N],
    margin: [f64; N],
    /// Whether the present state is within that range.
    inside: [bool; N],
    pub(super) all_inside: bool,
    rest: [Lane; N],
    pub(super) running: usize,
    until_overturning: bool,
}

/// Largest correction δ of a corner's first guess, over the step h: beyond, the general search takes over. What the expansion
/// leaves out is (ωδ)³ of u̇, 1e-18 even for ωh = 1.
const SMALL_SHIFT: f64 = 1e-6;

/// What a plain step does not touch.
#[derive(Clone, Copy)]
struct Lane {
    state: State,
    largest_forcing: f64,
    overturning: Option<f64>,
    /// Work of the steps that were not plain, and their number.
    work: Work,
    searched: u64,
    stilled: bool,
    /// The sample at which the run stopped.
    stopped: Option<usize>,
    memo: Memo,
}

impl<'a, const N: usize> Lanes<'a, N> {
    pub(super) fn new(
        solver: &'a RecordSolver<'a>,
        states: [State; N],
        largest: [f64; N],
        until_overturning: bool,
    ) -> Self {
        let lane = |index: usize| Lane {
            state: states[index],
            largest_forcing: largest[index],
            overturning: states[index].overturned.then_some(0.0),
            work: Work::default(),
            searched: 0,
            stilled: false,
            stopped: None,
            memo: Memo::default(),
        };
        let mut lanes = Self {
            solver,
            u: [0.0; N],
            v: [0.0; N],
            to_u: [[0.0; N]; 5],
            to_v: [[0.0; N]; 5],
            low: [0.0; N],
            high: [0.0; N],
            fastest: [0.0; N],
            margin: [0.0; N],
            inside: [false; N],
            all_inside: false,
            rest: std::array::from_fn(lane),
            running: N,
            until_overturning,
        };
        for index in 0..N {
            lanes.load(index);
        }
        lanes.all_inside = lanes.inside.iter().all(|&inside| inside);
        lanes
    }

    /// The plain step of each lane: its end, and whether it is plain as far as the end tells.
    #[allow(clippy::needless_bitwise_bool, reason = "no branches, so that lanes go side by side")]
    #[inline]
    fn mapped(
        &self,
        [u0, v0]: [&[f64; N]; 2],
        [from, to]: [&[f64; N]; 2],
    ) -> ([f64; N], [f64; N], [bool; N]) {
        let (mut u, mut v, mut plain) = ([0.0; N], [0.0; N], [false; N]);
        for i in 0..N {
            // the products with the state last: they are what the next step waits for
            let given = |c: &[[f64; N]; 5]| c[2][i] * from[i] + c[3][i] * to[i] + c[4][i];
            let own = |c: &[[f64; N]; 5]| c[0][i] * u0[i] + c[1][i] * v0[i];
            u[i] = (u0[i] + given(&self.to_u)) + own(&self.to_u);
            v[i] = (v0[i] + given(&self.to_v)) + own(&self.to_v);
            plain[i] = (u[i] >= self.low[i]) & (u[i] <= self.high[i]) & (v[i].abs() <= self.fastest[i]);
        }
        (u, v, plain)
    }

    /// Steps from `index` on as long as they are plain in all lanes; returns the sample reached.
    #[inline]
    pub(super) fn plain_steps<F: Forcing<N>>(
        &mut self,
        start: usize,
        forcing: &F,
        observe: &mut impl FnMut(usize, &[f64; N], &[f64; N]),
    ) -> usize {
        let (mut u, mut v, mut from) = (self.u, self.v, forcing.at(start));
        let mut reached = forcing.count() - 1;
        for index in start + 1..forcing.count() {
            let to = forcing.at(index);
            let (next_u, next_v, plain) = self.mapped([&u, &v], [&from, &to]);
            if !plain.iter().fold(true, |all, &one| all & one) {
                reached = index - 1;
                break;
            }
            (u, v, from) = (next_u, next_v, to);
            observe(index, &u, &v);
        }
        (self.u, self.v) = (u, v);
        reached
    }

    /// One step of all lanes, plain or not.
    pub(super) fn step<F: Forcing<N>>(&mut self, index: usize, forcing: &F) -> Result<(), SolverError> {
        let (from, to) = (forcing.at(index), forcing.at(index + 1));
        let (u, v, plain) = self.mapped([&self.u, &self.v], [&from, &to]);
        for i in 0..N {
            if plain[i] & self.inside[i] {
                (self.u[i], self.v[i]) = (u[i], v[i]);
            } else {
                self.careful(i, index, [from[i], to[i]], [u[i], v[i]])?;
            }
        }
        self.all_inside = self.inside.iter().all(|&inside| inside);
        Ok(())
    }

    /// A step that may reach a corner or a new extreme.
    fn careful(
        &mut self,
        i: usize,
        index: usize,
        forcing: [f64; 2],
        end: [f64; 2],
    ) -> Result<(), SolverError> {
        let lane = &mut self.rest[i];
        if lane.stopped.is_some() {
            return Ok(());
        }
        let mut known_end = None;
        let solver = self.solver;
        let moving = lane.state.phase == Phase::Moving;
        let map = if moving { solver.maps[lane.state.branch].as_ref() } else { None };
        if let Some(map) = map {
            let kinematics = |[displacement, velocity]: [f64; 2], forcing: f64| Kinematics {
                displacement,
                velocity,
                acceleration: forcing
                    - map.damping * velocity
                    - (map.force_at_zero + map.oscillator.stiffness * displacement),
            };
            let (from, to) = (kinematics([self.u[i], self.v[i]], forcing[0]), kinematics(end, forcing[1]));
            let rate = (forcing[1] - forcing[0]) / self.solver.step;
            let bounds = map.oscillator.bounds(from, rate, self.solver.step);
            let verdict = settle([from, to], self.solver.step, bounds, map.corners, &lane.state.peaks);
            let within = end[0] > map.corners[0] && end[0] < map.corners[1];
            if matches!(verdict, Verdict::Quiet | Verdict::Monotone) && within {
                lane.state.peaks.include(end[0]);
                [self.u[i], self.v[i]] = end;
                self.bound(i, map);
                return Ok(());
            }
            if matches!(verdict, Verdict::Monotone) && self.cross(i, [from, to], rate) {
                return Ok(());
            }
            known_end = Some(to);
        }
        self.search(i, index, forcing, known_end)
    }

    /// A step on which u, monotone, leaves the branch through a corner where nothing but the stiffness changes, and stays on
    /// the next one: the ordinary case of a corner, without the general search. Tells whether it was that.
    fn cross(&mut self, i: usize, [from, to]: [Kinematics; 2], rate: f64) -> bool {
        let (motion, step) = (self.solver.motion, self.solver.step);
        let branch = self.rest[i].state.branch;
        let upwards = to.displacement > from.displacement;
        let corner = motion.wall.corners()[branch + usize::from(upwards)];
        let next = if upwards { branch + 1 } else { branch.wrapping_sub(1) };
        let Some(Some(map)) = self.solver.maps.get(next) else { return false };
        if corner.is_marked() || from.displacement == corner.displacement {
            return false;
        }
        let oscillator = motion.oscillators[branch];
        let guess = step * crossing([from, to], step, corner.displacement, 2);
        let Some(near) = oscillator.series_at(from, rate, guess) else { return false };
        let Kinematics { velocity, acceleration, .. } = near;
        let jerk = oscillator.jerk(near, rate);
        // u(δ) = corner, from the value on by the derivatives there; δ is at most 1e-6 of the step, and δ⁴ nothing
        let first = (corner.displacement - near.displacement) / velocity;
        let shift = first * (1.0 - 0.5 * acceleration * first / velocity);
        let time = guess + shift;
        if shift.abs() > SMALL_SHIFT * step || !(0.0..step).contains(&time) {
            return false;
        }
        let velocity = velocity + shift * (acceleration + 0.5 * shift * jerk);
        let acceleration = acceleration + shift * jerk;
        let start = Kinematics { displacement: corner.displacement, velocity, acceleration };
        let remaining = step - time;
        let Some(end) = map.oscillator.series_at(start, rate, remaining) else { return false };
        let bounds = map.oscillator.bounds(start, rate, remaining);
        let lane = &mut self.rest[i];
        let within = end.displacement > map.corners[0] && end.displacement < map.corners[1];
        if !within
            || !matches!(
                settle([start, end], remaining, bounds, map.corners, &lane.state.peaks),
                Verdict::Quiet | Verdict::Monotone
            )
        {
            return false;
        }
        lane.searched += 1;
        lane.work.add(Work { pieces: 2, corners: 1, impacts: 0 });
        let state = &mut lane.state;
        state.branch = next;
        (state.displacement, state.velocity) = (end.displacement, end.velocity);
        state.peaks.include(corner.displacement);
        state.peaks.include(end.displacement);
        self.load(i);
        true
    }

    /// A step through the search for events.
    #[cold]
    fn search(
        &mut self,
        i: usize,
        index: usize,
        forcing: [f64; 2],
        known_end: Option<Kinematics>,
    ) -> Result<(), SolverError> {
        let (motion, step) = (self.solver.motion, self.solver.step);
        let lane = &mut self.rest[i];
        (lane.state.displacement, lane.state.velocity) = (self.u[i], self.v[i]);
        let run = Run::new(motion, lane.state, step, forcing, false, &mut lane.memo);
        let (state, report) = run.ending_at(known_end).finish()?;
        let Report { overturning, work, stilled, .. } = report;
        lane.state = state;
        lane.work.add(work);
        lane.searched += 1;
        lane.stilled |= stilled;
        if let (Some(offset), None) = (overturning, lane.overturning) {
            lane.overturning = Some(index as f64 * step + offset);
            if self.until_overturning {
                lane.stopped = Some(index + 1);
                self.running -= 1;
            }
        }
        self.load(i);
        Ok(())
    }

    /// Takes up the state and the branch of a lane.
    fn load(&mut self, i: usize) {
        let Lane { state, stopped, .. } = self.rest[i];
        (self.u[i], self.v[i]) = (state.displacement, state.velocity);
        let still = stopped.is_some() || state.phase == Phase::Landed;
        let solver = self.solver;
        let moving = !still && state.phase == Phase::Moving;
        let map = if moving { solver.maps[state.branch].as_ref() } else { None };
        for term in 0..5 {
            self.to_u[term][i] = map.map_or(0.0, |map| map.u[term]);
            self.to_v[term][i] = map.map_or(0.0, |map| map.v[term]);
        }
        if let Some(map) = map {
            self.measure(i, map);
        } else if still {
            (self.low[i], self.high[i]) = (f64::NEG_INFINITY, f64::INFINITY);
            (self.fastest[i], self.inside[i]) = (f64::INFINITY, true);
        } else {
            (self.low[i], self.high[i], self.inside[i]) = (f64::INFINITY, f64::NEG_INFINITY, false);
        }
    }

    /// The margin of plain steps on the present branch, and their range.
    fn measure(&mut self, i: usize, map: &StepMap) {
        let largest_forcing = self.rest[i].largest_forcing;
        let fastest = 2.0 * (largest_forcing + map.force) / map.damping;
        let braking = if map.damping > 0.0 { map.damping * fastest } else { 0.0 };
        let step = self.solver.step;
        self.margin[i] = 0.125 * step * step * map.growth * (largest_forcing + map.force + braking);
        self.fastest[i] = fastest;
        self.bound(i, map);
    }

    /// The range of plain steps with the present extremes.
    #[inline]
    fn bound(&mut self, i: usize, map: &StepMap) {
        let peaks = self.rest[i].state.peaks;
        self.low[i] = map.corners[0].max(-peaks.negative) + self.margin[i];
        self.high[i] = map.corners[1].min(peaks.positive) - self.margin[i];
        let (u, v) = (self.u[i], self.v[i]);
        self.inside[i] = u >= self.low[i] && u <= self.high[i] && v.abs() <= self.fastest[i];
    }

    pub(super) fn passages(&self, steps: u64) -> [Passage; N] {
        std::array::from_fn(|i| {
            let Lane { mut state, overturning, mut work, searched, stilled, stopped, .. } = self.rest[i];
            if stopped.is_none() {
                (state.displacement, state.velocity) = (self.u[i], self.v[i]);
            }
            // a plain step is one piece of motion
            work.pieces += stopped.map_or(steps, |index| index as u64) - searched;
            Passage { state, overturning, work, stilled }
        })
    }
}
