//! Decay of a free vibration.

use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::{Memo, Motion, SolverError, State};
use rocking_wall::wall::{ParameterError, Parameters};
use run::free_motion::{advance, as_in};

/// Part of `u_ins` below which |u| stays once the decay has ended.
pub(super) const DECAYED: f64 = 1e-3;
/// Samples beyond the end of the decay, as a part of those before.
const MARGIN: f64 = 0.1;
/// Number of parts in which a decay is run. After each, a run whose error is too large already ends.
const PARTS: usize = 16;
/// Most samples of a decay.
pub(super) const MOST_SAMPLES: usize = 200_000;

/// A free vibration at its start.
pub(super) struct Decay {
    motion: Motion,
    state: State,
}

impl Decay {
    pub(super) fn new(parameters: &Parameters) -> Result<Self, ParameterError> {
        let motion = Motion::of(parameters, parameters.tolerance)?;
        motion.wall().check_start(parameters.u_start)?;
        let state = motion.start_under(parameters.u_start, parameters.u_dot_start, 0.0);
        Ok(Self { motion, state })
    }

    /// Returns |u|/`u_ins` at each step until the motion has decayed, and a margin more; `None` if that takes
    /// too many steps.
    pub(super) fn samples(mut self, step: f64) -> Result<Option<Vec<f64>>, SolverError> {
        let u_ins = self.motion.wall().body().instability;
        let (mut samples, mut count, mut memo) = (Vec::new(), None, Memo::default());
        while samples.len() < count.unwrap_or(MOST_SAMPLES) {
            advance(&self.motion, &mut self.state, step, &mut memo)?;
            let (u, velocity) = (self.state.displacement, self.state.velocity);
            samples.push(u.abs() / u_ins.of(u));
            let wall = as_in(self.motion.wall(), &self.state);
            // the energy falls at impacts and where a tie yields, and is constant otherwise: once it is below
            // this one, |u| stays below `DECAYED`
            let [positive, negative] =
                [u_ins.positive, -u_ins.negative].map(|u| wall.energy(DECAYED * u, 0.0));
            if count.is_none() && wall.energy(u, velocity) < positive.min(negative) {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 2e5")]
                let margin = (MARGIN * samples.len() as f64).ceil() as usize;
                count = Some(samples.len() + margin);
            }
        }
        Ok(count.map(|_| samples))
    }

    /// Returns Err of Eq. (18) \[-\] against the samples of a reference. Where it exceeds `most` \[-\] early,
    /// the run ends, and a part of the sum above `most` is returned.
    pub(super) fn error(&self, reference: &[f64], step: f64, most: f64) -> Result<f64, SolverError> {
        let u_ins = self.motion.wall().body().instability;
        let solver = RecordSolver::new(&self.motion, step);
        let (mut sum, mut state) = (0.0, self.state);
        for part in reference.chunks(reference.len().div_ceil(PARTS)) {
            let mut add = |index: usize, u: f64, _| {
                let difference = part[index - 1] - u.abs() / u_ins.of(u);
                // a call of powi takes longer where this crate is not optimised
                sum += difference * difference;
            };
            let start = RunStart { state, factor: 1.0 };
            let still = Forcing::Still(part.len() + 1);
            state = solver.run_observed(start, still, RunEnd::OfRecord, &mut add)?.state;
            if sum > most {
                break;
            }
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_wall::variables::DampingModel;
    use run::free_motion::{with_damping, with_restitution};

    /// A run that ends early has an error above the bound, and not yet that of the whole run.
    #[test]
    fn a_run_ends_where_its_error_is_too_large() {
        let rocking = with_restitution(&Parameters::default(), 0.85);
        let step = 0.01;
        let reference = Decay::new(&rocking).unwrap().samples(step).unwrap().unwrap();
        let damped = Decay::new(&with_damping(&rocking, DampingModel::ConstantRatio, 0.1)).unwrap();
        let error = |most: f64| damped.error(&reference, step, most).unwrap();
        let whole = error(f64::INFINITY);
        assert_eq!(error(whole), whole);
        let part = error(0.25 * whole);
        assert!(0.25 * whole < part && part < whole, "{part} of {whole}");
    }
}
