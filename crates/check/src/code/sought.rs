//! What a search varies, and within which range.

use rocking_wall::variables::Mechanism;
use rocking_wall::wall::{Load, Parameters};

use crate::error::CheckError;

/// Force of a tie over W + O above which it is large \[-\].
pub(crate) const LARGE: f64 = 0.5;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// The smallest thickness \[m\].
    Thickness,
    /// The largest height \[m\].
    Height,
    /// The smallest strength of the tie \[N\].
    TieStrength,
    /// The smallest stiffness of the tie \[N/m\].
    TieStiffness,
    /// The smallest diameter of the bar of the tie \[m\]: its stiffness, strength and elongation follow.
    BarDiameter,
    /// The largest sum of the thrusts on a wall of parts, in proportion \[N\].
    Thrust,
    /// The largest sum of the loads on a wall of parts, in proportion \[N\].
    Load,
}

impl Sought {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Thickness,
        Self::Height,
        Self::TieStrength,
        Self::TieStiffness,
        Self::BarDiameter,
        Self::Thrust,
        Self::Load,
    ];

    /// Name of the parameter.
    pub fn name(self) -> &'static str {
        match self {
            Self::Thickness => "thickness",
            Self::Height => "height",
            Self::TieStrength => "tie_strength",
            Self::TieStiffness => "tie_stiffness",
            Self::BarDiameter => "bar_diameter",
            Self::Thrust => "thrust",
            Self::Load => "load",
        }
    }

    /// Unit of the parameter.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Thickness | Self::Height | Self::BarDiameter => "m",
            Self::TieStrength | Self::Thrust | Self::Load => "N",
            Self::TieStiffness => "N/m",
        }
    }

    /// Returns whether it is a number of the tie.
    pub fn is_of_tie(self) -> bool {
        matches!(self, Self::TieStrength | Self::TieStiffness | Self::BarDiameter)
    }

    /// Returns whether the largest value that passes is sought.
    pub fn is_largest(self) -> bool {
        matches!(self, Self::Height | Self::Thrust | Self::Load)
    }

    /// The sum of the thrusts or of the loads on a wall of parts; 0 of what is neither \[N\].
    pub(crate) fn sum(self, parameters: &Parameters) -> f64 {
        let loads = parameters.profile.iter().flat_map(|profile| profile.loads());
        match self {
            Self::Thrust => loads.map(|load| load.thrust.abs()).sum(),
            Self::Load => loads.map(|load| load.force).sum(),
            _ => 0.0,
        }
    }

    /// The loads with the sum of the thrusts or of the forces, in proportion.
    fn with_sum(self, parameters: &mut Parameters, sum: f64) {
        let factor = sum / self.sum(parameters);
        let scaled = |load: &Load| match self {
            Self::Thrust => Load { thrust: factor * load.thrust, ..*load },
            _ => Load { force: factor * load.force, ..*load },
        };
        let Some(profile) = &parameters.profile else { return };
        let loads = profile.loads().iter().map(scaled).collect();
        parameters.profile = Some(profile.with_loads(loads).into());
    }

    /// The wall with another value of the parameter.
    ///
    /// # Errors
    /// [`CheckError`] of a bar that cannot be.
    pub fn applied(self, parameters: &Parameters, value: f64) -> Result<Parameters, CheckError> {
        let mut parameters = parameters.clone();
        match self {
            Self::Thickness => parameters.thickness = value,
            Self::Height => parameters.height = value,
            Self::TieStrength => parameters.tie_strength = value,
            Self::TieStiffness => parameters.tie_stiffness = value,
            Self::BarDiameter => {
                if let Some(bar) = &mut parameters.bar {
                    bar.diameter = value;
                }
                parameters.apply_bars()?;
            }
            Self::Thrust | Self::Load => self.with_sum(&mut parameters, value),
        }
        Ok(parameters)
    }

    /// The range of values that is searched, within which a builder would choose: a quarter to four times the
    /// wall's own size or load; ties up to the weight that the wall carries; bars of 6 to 60 mm; thrusts of a
    /// hundredth to ten times the wall's own.
    pub(crate) fn range(self, parameters: &Parameters) -> [f64; 2] {
        let (weight, load) = (weight(parameters), load(parameters));
        match self {
            Self::Thickness => [0.25 * parameters.thickness, 4.0 * parameters.thickness],
            Self::Height => [0.25 * parameters.height, 4.0 * parameters.height],
            Self::TieStrength => [1e-3 * weight, load],
            Self::TieStiffness => [load / parameters.height, 1e4 * load / parameters.height],
            Self::BarDiameter => [6e-3, 60e-3],
            Self::Thrust => [1e-2, 10.0].map(|factor| factor * self.sum(parameters)),
            Self::Load => [0.25, 4.0].map(|factor| factor * self.sum(parameters)),
        }
    }
}

fn weight(parameters: &Parameters) -> f64 {
    let Parameters { height, thickness, width, density, gravity, .. } = *parameters;
    match &parameters.profile {
        Some(profile) => gravity * profile.centroid([0.0, height]).mass,
        None if parameters.mechanism == Mechanism::RigidBody => gravity * parameters.body_mass,
        None => density * gravity * height * thickness * width,
    }
}

/// W + O, with the loads on a body \[N\].
pub(crate) fn load(parameters: &Parameters) -> f64 {
    weight(parameters) + parameters.overburden + Sought::Load.sum(parameters) + parameters.load_force
}
