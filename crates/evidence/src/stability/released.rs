//! A wall released at rest, and its energy.

use rocking_wall::solver::{Memo, Motion, SolverError, State};
use rocking_wall::wall::Support;
use run::free_motion::advance;

/// A wall in free motion after its release.
pub(super) struct Released {
    pub(super) motion: Motion,
    pub(super) state: State,
    pub(super) first_energy: f64,
    energy: f64,
    memo: Memo,
}

impl Released {
    /// Releases a wall from a fraction of `u_ins`.
    pub(super) fn new(motion: Motion, fraction: f64) -> Self {
        let start = fraction * motion.wall().body().instability.positive;
        let state = motion.start(start, 0.0, Support::default());
        let energy = motion.wall().energy(start, 0.0);
        Self { motion, state, first_energy: energy, energy, memo: Memo::default() }
    }

    /// Advances by `duration` \[s\]; returns the growth of the energy over that at the start \[-\].
    pub(super) fn advance(&mut self, duration: f64) -> Result<f64, SolverError> {
        advance(&self.motion, &mut self.state, duration, &mut self.memo)?;
        let energy = self.motion.wall().energy(self.state.displacement, self.state.velocity);
        let growth = (energy - self.energy) / self.first_energy;
        self.energy = energy;
        Ok(growth)
    }
}
