//! The state of a unit as bytes: everything that does not follow from the rest.

use fmu_export::{Failure, StateCodec};

use crate::simulation::Progress;
use crate::solver::{Peaks, Phase, State, Work};
use crate::wall::{Ends, Support, TieMemory};

use super::model_exchange::{Exchange, OwnMotion};
use super::{Inputs, Unit};

impl Unit {
    /// Writes or reads the state. A unit that has read a state continues exactly like the unit that wrote it.
    ///
    /// # Errors
    /// If the bytes are not a state of such a unit.
    pub(super) fn transfer(&mut self, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
        let mut progress = *self.simulation.progress();
        self.parameters.transfer(codec)?;
        let Inputs { ground, bottom, top, drift } = &mut self.inputs;
        codec.f64(ground)?;
        for input in [bottom, top, drift] {
            input.transfer(codec)?;
        }
        self.experiment.transfer(codec)?;
        codec.bool(&mut self.running)?;
        for warned in &mut self.warned {
            codec.bool(warned)?;
        }
        let Ends { bottom, top } = &mut self.impulses;
        codec.f64s([bottom, top])?;
        transfer_progress(&mut progress, codec)?;
        if let Some(exchange) = &mut self.exchange {
            transfer_exchange(exchange, codec)?;
        }
        if codec.is_reading() { self.resume(progress) } else { Ok(()) }
    }

    /// Computes what follows from the parameters, and goes on from `progress`.
    fn resume(&mut self, progress: Progress) -> Result<(), Failure> {
        let running = std::mem::take(&mut self.running);
        self.prepare()?;
        let State { displacement, branch, tie, .. } = progress.state;
        let yielded = [tie.yielded.positive, tie.yielded.negative];
        if yielded.iter().any(|yielded| !yielded.is_finite() || *yielded < 0.0) {
            return Err(Failure(format!("the state has ties that have yielded up to {yielded:?} m")));
        }
        self.simulation.prepare(&progress.state);
        let Some(branch) = self.wall().branches().get(branch) else {
            return Err("the state has a branch that the wall does not have".into());
        };
        // an importer's solver may go beyond the ends of a branch; a communication step may not
        if self.exchange.is_none() && !(branch.lower..=branch.upper).contains(&displacement) {
            return Err(Failure(format!(
                "the state has u = {displacement} m on the branch from {} to {} m",
                branch.lower, branch.upper
            )));
        }
        self.simulation.restore(progress);
        self.running = running;
        self.refresh();
        Ok(())
    }
}

fn transfer_progress(progress: &mut Progress, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let Progress { time, state, overturn_time, tie_breaks, work } = progress;
    let State { displacement, velocity, branch, phase, peaks, overturned, departed, tie } = state;
    let TieMemory { yielded, lost } = tie;
    let Peaks { positive, negative } = peaks;
    let Work { pieces, corners, impacts } = work;
    codec.f64s([time, displacement, velocity, positive, negative])?;
    codec.f64s([&mut yielded.positive, &mut yielded.negative])?;
    for time in std::iter::once(overturn_time).chain(tie_breaks) {
        codec.option(time)?;
    }
    codec.usize(branch)?;
    codec.item(phase, &[Phase::Moving, Phase::Resting, Phase::Landed])?;
    for count in [pieces, corners, impacts] {
        codec.u64(count)?;
    }
    for flag in [overturned, departed, lost] {
        codec.bool(flag)?;
    }
    Ok(())
}

/// Transfers what only Model Exchange stores. The layer keeps the states of the two kinds of instances apart.
fn transfer_exchange(exchange: &mut Exchange, codec: &mut StateCodec<'_>) -> Result<(), Failure> {
    let Exchange { rising, ground, own_motion } = exchange;
    let OwnMotion { from, support, rate, end } = own_motion;
    codec.bool(rising)?;
    codec.f64s([ground, from])?;
    for Support { bottom, top, drift } in [support, rate] {
        codec.f64s([bottom, top, drift])?;
    }
    codec.option(end)
}
