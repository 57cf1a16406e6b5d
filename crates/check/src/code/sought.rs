//! What a search varies, and within which range.

use rocking_wall::wall::Parameters;

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
}

impl Sought {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Thickness, Self::Height, Self::TieStrength, Self::TieStiffness, Self::BarDiameter];

    /// Name of the parameter.
    pub fn name(self) -> &'static str {
        match self {
            Self::Thickness => "thickness",
            Self::Height => "height",
            Self::TieStrength => "tie_strength",
            Self::TieStiffness => "tie_stiffness",
            Self::BarDiameter => "bar_diameter",
        }
    }

    /// Unit of the parameter.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Thickness | Self::Height | Self::BarDiameter => "m",
            Self::TieStrength => "N",
            Self::TieStiffness => "N/m",
        }
    }

    /// Returns whether it is a number of the tie.
    pub fn is_of_tie(self) -> bool {
        matches!(self, Self::TieStrength | Self::TieStiffness | Self::BarDiameter)
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
        }
        Ok(parameters)
    }

    /// The range of values that is searched, within which a builder would choose: a quarter to four times the
    /// wall's own size; ties up to the weight that the wall carries; bars of 6 to 60 mm.
    pub(crate) fn range(self, parameters: &Parameters) -> [f64; 2] {
        let (weight, load) = (weight(parameters), load(parameters));
        match self {
            Self::Thickness => [0.25 * parameters.thickness, 4.0 * parameters.thickness],
            Self::Height => [0.25 * parameters.height, 4.0 * parameters.height],
            Self::TieStrength => [1e-3 * weight, load],
            Self::TieStiffness => [load / parameters.height, 1e4 * load / parameters.height],
            Self::BarDiameter => [6e-3, 60e-3],
        }
    }
}

fn weight(parameters: &Parameters) -> f64 {
    let Parameters { height, thickness, width, density, gravity, .. } = *parameters;
    density * gravity * height * thickness * width
}

/// W + O \[N\].
pub(crate) fn load(parameters: &Parameters) -> f64 {
    weight(parameters) + parameters.overburden
}
