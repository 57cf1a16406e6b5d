//! The state of a unit as bytes: everything that does not follow from the rest.

use fmi2_export::{Experiment, Failure, Model, StateReader, StateWriter, VariableId};

use crate::simulation::Progress;
use crate::solver::{Peaks, Phase, State, Work};
use crate::variables::{IntegerVariable, RealVariable};
use crate::wall::{Ends, Support};

use super::exchange::{Exchange, Stretch};
use super::{Input, Inputs, Unit};

pub(super) fn write(unit: &Unit, writer: &mut StateWriter) {
    for &variable in RealVariable::ALL {
        if let Some(value) = unit.parameters.real(variable) {
            writer.f64(value);
        }
    }
    for &variable in IntegerVariable::ALL {
        writer.u64(u64::from(unit.parameters.choice(variable).unsigned_abs()));
    }
    let Inputs { ground, bottom, top, drift } = unit.inputs;
    writer.f64(ground);
    for Input { value, rate, last_rate } in [bottom, top, drift] {
        writer.f64(value);
        writer.f64(rate);
        writer.f64(last_rate);
    }
    let Experiment { tolerance, start, stop } = unit.experiment;
    writer.f64(start);
    for optional in [tolerance, stop, unit.simulation.progress().overturn_time] {
        writer.bool(optional.is_some());
        writer.f64(optional.unwrap_or(0.0));
    }
    writer.bool(unit.running);
    writer.bool(unit.top_ignored_told);
    writer.f64(unit.impulses.bottom);
    writer.f64(unit.impulses.top);
    let Progress { time, state, drift, work, .. } = *unit.simulation.progress();
    for value in [time, state.displacement, state.velocity, state.peaks.positive, state.peaks.negative] {
        writer.f64(value);
    }
    for value in [state.branch as u64, phase_number(state.phase), work.pieces, work.corners, work.impacts] {
        writer.u64(value);
    }
    for value in [state.overturned, state.departed, drift] {
        writer.bool(value);
    }
    if let Some(exchange) = &unit.exchange {
        write_exchange(exchange, writer);
    }
}

/// What Model Exchange adds; the layer keeps the two kinds of instances apart.
fn write_exchange(exchange: &Exchange, writer: &mut StateWriter) {
    let Exchange { continuous, rising, ground, stretch } = *exchange;
    let Stretch { from, support, rate, end } = stretch;
    writer.bool(continuous);
    writer.bool(rising);
    for value in [ground, from] {
        writer.f64(value);
    }
    for Support { bottom, top, drift } in [support, rate] {
        for value in [bottom, top, drift] {
            writer.f64(value);
        }
    }
    writer.bool(end.is_some());
    writer.f64(end.unwrap_or(0.0));
}

fn read_exchange(reader: &mut StateReader<'_>) -> Result<Exchange, Failure> {
    let (continuous, rising) = (reader.bool()?, reader.bool()?);
    let (ground, from) = (reader.f64()?, reader.f64()?);
    let mut support = || -> Result<Support, Failure> {
        Ok(Support { bottom: reader.f64()?, top: reader.f64()?, drift: reader.f64()? })
    };
    let (support, rate) = (support()?, support()?);
    let (some, end) = (reader.bool()?, reader.f64()?);
    let stretch = Stretch { from, support, rate, end: some.then_some(end) };
    Ok(Exchange { continuous, rising, ground, stretch })
}

/// # Errors
/// If the bytes are no state of such a unit.
pub(super) fn read(before: &Unit, reader: &mut StateReader<'_>) -> Result<Unit, Failure> {
    let mut unit = before.clone();
    for &variable in RealVariable::ALL {
        if let Some(field) = unit.parameters.real_mut(variable) {
            *field = reader.f64()?;
        }
    }
    for &variable in IntegerVariable::ALL {
        let value = i32::try_from(reader.u64()?).map_err(|_| "an enumeration out of range")?;
        if !unit.parameters.set_choice(variable, value) {
            return Err(format!("{value} is not an item of {}", variable.variable().name).into());
        }
    }
    let input = |input: &mut Input, reader: &mut StateReader<'_>| -> Result<(), Failure> {
        *input = Input { value: reader.f64()?, rate: reader.f64()?, last_rate: reader.f64()? };
        Ok(())
    };
    unit.inputs.ground = reader.f64()?;
    input(&mut unit.inputs.bottom, reader)?;
    input(&mut unit.inputs.top, reader)?;
    input(&mut unit.inputs.drift, reader)?;
    let start_time = reader.f64()?;
    let mut optional = || -> Result<Option<f64>, Failure> {
        let (some, value) = (reader.bool()?, reader.f64()?);
        Ok(some.then_some(value))
    };
    let (tolerance, stop, overturn_time) = (optional()?, optional()?, optional()?);
    unit.experiment = Experiment { tolerance, start: start_time, stop };
    let running = reader.bool()?;
    unit.top_ignored_told = reader.bool()?;
    unit.impulses = Ends { bottom: reader.f64()?, top: reader.f64()? };
    let mut number = || reader.f64();
    let (time, displacement, velocity) = (number()?, number()?, number()?);
    let peaks = Peaks { positive: number()?, negative: number()? };
    let (branch, phase) = (reader.u64()?, reader.u64()?);
    let work = Work { pieces: reader.u64()?, corners: reader.u64()?, impacts: reader.u64()? };
    let state = State {
        displacement,
        velocity,
        branch: usize::try_from(branch).map_err(|_| "a branch out of range")?,
        phase: phase_of(phase)?,
        peaks,
        overturned: reader.bool()?,
        departed: reader.bool()?,
    };
    let drift = reader.bool()?;
    if unit.exchange.is_some() {
        unit.exchange = Some(read_exchange(reader)?);
    }
    unit.running = false;
    unit.calculate()?;
    if state.branch >= unit.wall().branches().len() {
        return Err("a branch the wall does not have".into());
    }
    unit.simulation.restore(Progress { time, state, overturn_time, drift, work });
    unit.running = running;
    unit.refresh();
    Ok(unit)
}

fn phase_number(phase: Phase) -> u64 {
    match phase {
        Phase::Moving => 0,
        Phase::Resting => 1,
        Phase::Landed => 2,
    }
}

fn phase_of(number: u64) -> Result<Phase, Failure> {
    match number {
        0 => Ok(Phase::Moving),
        1 => Ok(Phase::Resting),
        2 => Ok(Phase::Landed),
        _ => Err("an unknown phase".into()),
    }
}
