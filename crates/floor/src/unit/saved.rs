//! Saving and reading the state of a floor.

use fmi2_export::{Failure, Model, StateReader, StateWriter, VariableId};

use super::{Base, Unit};
use crate::floor::Branch;
use crate::inputs::{Input, Inputs};
use crate::motion::State;
use crate::variables::{Coupling, Hysteresis, RealVariable};
use crate::wiring::{Role, role};

impl Unit {
    pub(super) fn write(&self, writer: &mut StateWriter) {
        for &variable in RealVariable::ALL {
            if let Role::Parameter(parameter) = role(variable) {
                writer.f64(self.parameters.get(parameter));
            }
        }
        writer.i32(self.parameters.hysteresis.value());
        writer.i32(self.parameters.coupling.value());
        let Inputs { ground, reactions, impulses, last_duration } = self.inputs;
        for Input { value, rate, last_rate } in reactions.into_iter().chain([ground]) {
            for number in [value, rate, last_rate] {
                writer.f64(number);
            }
        }
        for number in impulses.into_iter().chain([last_duration]) {
            writer.f64(number);
        }
        let State { displacement, velocity, plastic, branch, damping_energy, hysteretic_energy } = self.state;
        for number in [displacement, velocity, plastic, damping_energy, hysteretic_energy] {
            writer.f64(number);
        }
        writer.u64(branch_number(branch));
        let Base { displacement, velocity, impulse } = self.base;
        for number in [displacement, velocity, impulse] {
            writer.f64(number);
        }
        writer.bool(self.running);
        writer.bool(self.ignored_told);
    }

    pub(super) fn read(mut self, reader: &mut StateReader<'_>) -> Result<Self, Failure> {
        for &variable in RealVariable::ALL {
            if let Role::Parameter(parameter) = role(variable) {
                *self.parameters.slot(parameter) = reader.f64()?;
            }
        }
        self.parameters.hysteresis = Hysteresis::from_value(reader.i32()?).ok_or("an unknown hysteresis")?;
        self.parameters.coupling = Coupling::from_value(reader.i32()?).ok_or("an unknown coupling")?;
        let Inputs { ground, reactions, impulses, last_duration } = &mut self.inputs;
        for input in reactions.iter_mut().chain([ground]) {
            *input = Input { value: reader.f64()?, rate: reader.f64()?, last_rate: reader.f64()? };
        }
        for number in impulses.iter_mut().chain([last_duration]) {
            *number = reader.f64()?;
        }
        // what follows from the parameters, before the state itself
        self.running = false;
        self.calculate()?;
        self.state = State {
            displacement: reader.f64()?,
            velocity: reader.f64()?,
            plastic: reader.f64()?,
            damping_energy: reader.f64()?,
            hysteretic_energy: reader.f64()?,
            branch: branch_of(reader.u64()?)?,
        };
        self.base = Base { displacement: reader.f64()?, velocity: reader.f64()?, impulse: reader.f64()? };
        self.running = reader.bool()?;
        self.ignored_told = reader.bool()?;
        Ok(self)
    }
}

fn branch_number(branch: Branch) -> u64 {
    match branch {
        Branch::Elastic => 0,
        Branch::YieldingUp => 1,
        Branch::YieldingDown => 2,
    }
}

fn branch_of(number: u64) -> Result<Branch, Failure> {
    match number {
        0 => Ok(Branch::Elastic),
        1 => Ok(Branch::YieldingUp),
        2 => Ok(Branch::YieldingDown),
        _ => Err("an unknown branch".into()),
    }
}
