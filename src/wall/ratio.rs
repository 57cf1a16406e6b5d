//! The ratios of damping models, each a parameter.

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
}
