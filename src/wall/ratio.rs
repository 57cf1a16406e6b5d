//! The ratios of damping models, each a parameter.

use super::parameters::{COMPUTED, Parameters};

/// A ratio that damping models take: the parameter of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ratio {
    /// ξ, or ξ₁, on the elastic branch \[-\].
    Xi,
    /// c̄ of a free-standing block \[-\].
    CBar,
}

impl Ratio {
    /// Every variant.
    pub const ALL: [Self; 2] = [Self::Xi, Self::CBar];

    /// Returns the name of the parameter.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xi => "xi",
            Self::CBar => "c_bar",
        }
    }

    /// Returns the parameter: a number from 0 on, or [`COMPUTED`].
    pub fn of(self, parameters: &Parameters) -> f64 {
        match self {
            Self::Xi => parameters.xi,
            Self::CBar => parameters.c_bar,
        }
    }

    pub(super) fn of_mut(self, parameters: &mut Parameters) -> &mut f64 {
        match self {
            Self::Xi => &mut parameters.xi,
            Self::CBar => &mut parameters.c_bar,
        }
    }
}

impl Parameters {
    /// Sets every ratio to [`COMPUTED`].
    pub fn leave_out_ratios(&mut self) {
        for ratio in Ratio::ALL {
            *ratio.of_mut(self) = COMPUTED;
        }
    }
}
