//! Bounds on the motion over plain steps: docs/record-path.md, §2.

use super::super::Peaks;
use super::solver::RecordSolver;
use super::step_map::StepMap;

/// The |u| up to which f̂ is taken, over the largest so far.
const ROOM: f64 = 4.0;
/// Most of the |u| up to which f̂ is taken, over the largest so far, for f̂ to serve another block.
const MOST_ROOM: f64 = 16.0;

/// Bounds on forces, and on the motion on the present branch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bounds {
    /// P, over the block \[m/s²\].
    forcing: f64,
    /// f̂, for |u| up to r \[m/s²\].
    force: f64,
    /// r \[m\].
    reach: f64,
    /// V \[m/s\].
    speed: f64,
    /// A h²/8 over one step and over two \[m\].
    margins: [f64; 2],
    /// A h over one step \[m/s\].
    velocity_change: f64,
}

impl Bounds {
    /// Returns P \[m/s²\].
    pub(super) fn forcing(&self) -> f64 {
        self.forcing
    }

    /// Returns f̂ \[m/s²\].
    pub(super) fn force(&self) -> f64 {
        self.force
    }

    /// Returns D = P + f̂ \[m/s²\].
    #[inline(always)]
    pub(super) fn driving(&self) -> f64 {
        self.forcing + self.force
    }

    /// Returns the |u| up to which f̂ holds \[m\].
    #[inline(always)]
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Takes the forcing of a new block; tells whether f̂ holds there: while u is far below `reach`, yet not
    /// too far.
    pub(super) fn enter_block(&mut self, forcing: f64, peaks: &Peaks, step: f64) -> bool {
        self.forcing = forcing;
        let largest = peaks.largest() + forcing * step * step;
        2.0 * largest < self.reach && self.reach < MOST_ROOM * largest
    }

    /// Takes f̂ anew; a run that only looks for extremes goes no further than those known.
    pub(super) fn take_force(&mut self, solver: &RecordSolver<'_>, peaks: &Peaks, within_known: bool) {
        let room = if within_known { 1.0 } else { ROOM };
        self.reach = room * (peaks.largest() + self.forcing * solver.step * solver.step);
        self.force = solver.largest_force(self.reach);
    }

    /// Takes the bounds on the motion on a branch.
    #[inline(always)]
    pub(super) fn take_branch(&mut self, map: &StepMap, step: f64) {
        let driving = self.driving();
        self.speed = map.speed_share * driving;
        // A over one step and over two
        let most = map.growth.map(|growth| growth * (driving + map.damping_share() * driving));
        self.margins = [0.125 * step * step * most[0], 0.5 * step * step * most[1]];
        self.velocity_change = most[0] * step;
    }

    /// Returns where plain steps on a branch, one or two at once, may start and end while u stays within
    /// `limits`.
    #[inline(always)]
    pub(super) fn range(&self, map: &StepMap, limits: [f64; 2], steps: usize) -> Range {
        let margin = self.margins[steps - 1];
        let [lowest, highest] = limits;
        Range {
            low: map.corners[0].max(lowest) + margin,
            high: map.corners[1].min(highest) - margin,
            speed: self.speed,
        }
    }

    /// Tells whether u̇ keeps its sign over a step, by docs/record-path.md, §3.
    #[inline(always)]
    pub(super) fn keep_sign(&self, v0: f64, [u1, v1]: [f64; 2]) -> bool {
        u1.abs() <= self.reach
            && v0 * v1 > 0.0
            && v0.abs() + v1.abs() > self.velocity_change
            && v0.abs().max(v1.abs()) <= self.speed
    }
}

/// Where plain steps may start and end: u from `low` to `high`, |u̇| up to `speed`.
#[derive(Clone, Copy)]
pub(super) struct Range {
    low: f64,
    high: f64,
    speed: f64,
}

impl Range {
    #[inline(always)]
    pub(super) fn holds(&self, [u, v]: [f64; 2]) -> bool {
        u >= self.low && u <= self.high && v.abs() <= self.speed
    }
}
