//! Numbers of a code that a study of reliability varies.

/// A number in the rule of a check, which a study of reliability varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Displacement capacity over the displacement at which the force vanishes \[-\].
    Fraction,
    /// Factor of π √(d/a) in the period of the demand \[-\].
    PeriodFactor,
    /// Behaviour factor q \[-\].
    BehaviourFactor,
}

impl Rule {
    /// Every variant.
    pub const ALL: [Self; 3] = [Self::Fraction, Self::PeriodFactor, Self::BehaviourFactor];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        ["fraction of d_0", "factor of the period", "q"][self as usize]
    }
}
