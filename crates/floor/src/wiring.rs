//! Which variable is what: every one of the description is named here.

use crate::floor::Parameters;
use crate::variables::RealVariable;

/// Walls that can push one floor.
pub(crate) const WALLS: usize = 8;

/// What a Real variable is to the floor.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Role {
    Ground,
    Reaction(usize),
    Impulse(usize),
    Parameter(Parameter),
    Output(Output),
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Parameter {
    Mass,
    Stiffness,
    DampingRatio,
    DampingCoefficient,
    YieldForce,
    HardeningRatio,
    DisplacementStart,
    VelocityStart,
}

/// Outputs and calculated parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    Displacement,
    Velocity,
    Acceleration,
    DisplacementAbsolute,
    VelocityAbsolute,
    AccelerationAbsolute,
    SpringForce,
    DampingForce,
    ReactionBottom,
    ImpulseBottom,
    DisplacementPlastic,
    EnergyDamping,
    EnergyHysteretic,
    Omega,
    DampingCoefficientUsed,
    YieldDisplacement,
}

/// The role of a variable.
pub(crate) fn role(variable: RealVariable) -> Role {
    use {Output as O, Parameter as P, RealVariable as V};
    match variable {
        V::AG => Role::Ground,
        V::Reaction1 => Role::Reaction(0),
        V::Reaction2 => Role::Reaction(1),
        V::Reaction3 => Role::Reaction(2),
        V::Reaction4 => Role::Reaction(3),
        V::Reaction5 => Role::Reaction(4),
        V::Reaction6 => Role::Reaction(5),
        V::Reaction7 => Role::Reaction(6),
        V::Reaction8 => Role::Reaction(7),
        V::Impulse1 => Role::Impulse(0),
        V::Impulse2 => Role::Impulse(1),
        V::Impulse3 => Role::Impulse(2),
        V::Impulse4 => Role::Impulse(3),
        V::Impulse5 => Role::Impulse(4),
        V::Impulse6 => Role::Impulse(5),
        V::Impulse7 => Role::Impulse(6),
        V::Impulse8 => Role::Impulse(7),
        V::Displacement => Role::Output(O::Displacement),
        V::Velocity => Role::Output(O::Velocity),
        V::Acceleration => Role::Output(O::Acceleration),
        V::DisplacementAbsolute => Role::Output(O::DisplacementAbsolute),
        V::VelocityAbsolute => Role::Output(O::VelocityAbsolute),
        V::AccelerationAbsolute => Role::Output(O::AccelerationAbsolute),
        V::SpringForce => Role::Output(O::SpringForce),
        V::DampingForce => Role::Output(O::DampingForce),
        V::ReactionBottom => Role::Output(O::ReactionBottom),
        V::ImpulseBottom => Role::Output(O::ImpulseBottom),
        V::DisplacementPlastic => Role::Output(O::DisplacementPlastic),
        V::EnergyDamping => Role::Output(O::EnergyDamping),
        V::EnergyHysteretic => Role::Output(O::EnergyHysteretic),
        V::Mass => Role::Parameter(P::Mass),
        V::Stiffness => Role::Parameter(P::Stiffness),
        V::DampingRatio => Role::Parameter(P::DampingRatio),
        V::DampingCoefficient => Role::Parameter(P::DampingCoefficient),
        V::YieldForce => Role::Parameter(P::YieldForce),
        V::HardeningRatio => Role::Parameter(P::HardeningRatio),
        V::DisplacementStart => Role::Parameter(P::DisplacementStart),
        V::VelocityStart => Role::Parameter(P::VelocityStart),
        V::Omega => Role::Output(O::Omega),
        V::DampingCoefficientUsed => Role::Output(O::DampingCoefficientUsed),
        V::YieldDisplacement => Role::Output(O::YieldDisplacement),
    }
}

impl Parameters {
    /// The parameter, to be got or set.
    pub(crate) fn slot(&mut self, parameter: Parameter) -> &mut f64 {
        match parameter {
            Parameter::Mass => &mut self.mass,
            Parameter::Stiffness => &mut self.stiffness,
            Parameter::DampingRatio => &mut self.damping_ratio,
            Parameter::DampingCoefficient => &mut self.damping_coefficient,
            Parameter::YieldForce => &mut self.yield_force,
            Parameter::HardeningRatio => &mut self.hardening_ratio,
            Parameter::DisplacementStart => &mut self.displacement_start,
            Parameter::VelocityStart => &mut self.velocity_start,
        }
    }

    pub(crate) fn get(mut self, parameter: Parameter) -> f64 {
        *self.slot(parameter)
    }
}
