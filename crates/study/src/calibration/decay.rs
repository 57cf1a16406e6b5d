//! A free vibration, and how far two of them are apart.

use rocking_wall::solver::record::{RecordSolver, Start, Still};
use rocking_wall::solver::{Memo, Motion, Segment, SolverError, State};
use rocking_wall::wall::{ParameterError, Parameters, Support};

/// The decay has ended when |u| stays below this part of `u_ins`.
pub(super) const DECAYED: f64 = 1e-3;
/// Samples beyond the end of the decay, as a part of those before.
const MARGIN: f64 = 0.1;
/// Most samples of a decay.
pub(super) const MOST_SAMPLES: usize = 200_000;

/// A free vibration.
pub(super) struct Decay {
    motion: Motion,
    state: State,
    memo: Memo,
}

impl Decay {
    pub(super) fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let motion = Motion::of(parameters, parameters.tolerance)?;
        let state = motion.start_under(parameters.u_start, parameters.u_dot_start, 0.0);
        Ok(Self { motion, state, memo: Memo::default() })
    }

    /// One step on: u and u̇ there.
    fn advance(&mut self, step: f64) -> Result<[f64; 2], SolverError> {
        let still = Support::default();
        let segment = Segment { duration: step, from: still, to: still };
        self.motion.advance(&mut self.state, &segment, false, &mut self.memo)?;
        Ok([self.state.displacement, self.state.velocity])
    }

    /// |u|/`u_ins` at each step until the motion has decayed, and a margin more; `None` if that takes too many.
    pub(super) fn samples(mut self, step: f64) -> Result<Option<Vec<f64>>, SolverError> {
        let u_ins = self.motion.wall().body().instability;
        // Between impacts the energy stays, and at impacts it falls: below this one |u| cannot come back.
        let decayed = self
            .motion
            .wall()
            .energy(DECAYED * u_ins.positive, 0.0)
            .min(self.motion.wall().energy(-DECAYED * u_ins.negative, 0.0));
        let mut samples = Vec::new();
        let mut count = None;
        while samples.len() < count.unwrap_or(MOST_SAMPLES) {
            let state = self.advance(step)?;
            samples.push(state[0].abs() / u_ins.of(state[0]));
            if count.is_none() && self.motion.wall().energy(state[0], state[1]) < decayed {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 2e5")]
                let margin = (MARGIN * samples.len() as f64).ceil() as usize;
                count = Some(samples.len() + margin);
            }
        }
        Ok(count.map(|_| samples))
    }

    /// Err of Eq. (18) against the samples of a reference.
    pub(super) fn difference(&self, reference: &[f64], step: f64) -> Result<f64, SolverError> {
        let u_ins = self.motion.wall().body().instability;
        let solver = RecordSolver::new(&self.motion, step);
        let mut sum = 0.0;
        let start = Start { state: self.state, factor: 1.0 };
        solver.run(start, &Still(reference.len() + 1), false, |index, u, _| {
            sum += (reference[index - 1] - u.abs() / u_ins.of(u)).powi(2);
        })?;
        Ok(sum)
    }
}
