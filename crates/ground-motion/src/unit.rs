//! Units of acceleration in records.

use std::fmt;

use serde::Deserialize;

/// Standard gravity, the unit g of records (m/s²): 3rd General Conference on Weights and Measures, 1901.
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// Unit of acceleration of a record.
///
/// ```
/// use ground_motion::Unit;
///
/// assert_eq!("cm/s^2".parse::<Unit>()?, Unit::CentimetrePerSecondSquared);
/// assert_eq!(Unit::StandardGravity.to_si(2.0), 19.6133);
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash, Deserialize)]
#[serde(try_from = "String")]
pub enum Unit {
    /// m/s².
    MetrePerSecondSquared,
    /// cm/s², also called gal.
    CentimetrePerSecondSquared,
    /// mm/s².
    MillimetrePerSecondSquared,
    /// g, 9.80665 m/s².
    StandardGravity,
}

impl Unit {
    /// Every unit.
    pub const ALL: [Self; 4] = [
        Self::MetrePerSecondSquared,
        Self::CentimetrePerSecondSquared,
        Self::MillimetrePerSecondSquared,
        Self::StandardGravity,
    ];

    /// Returns the unit's plain name, such as `cm/s2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::MetrePerSecondSquared => "m/s2",
            Self::CentimetrePerSecondSquared => "cm/s2",
            Self::MillimetrePerSecondSquared => "mm/s2",
            Self::StandardGravity => "g",
        }
    }

    /// Converts a value in this unit to m/s².
    ///
    /// Divides where the factor is not a binary fraction but its inverse is a whole number: 1 cm/s² is then
    /// the double nearest to 0.01 m/s².
    pub fn to_si(self, value: f64) -> f64 {
        match self {
            Self::MetrePerSecondSquared => value,
            Self::CentimetrePerSecondSquared => value / 100.0,
            Self::MillimetrePerSecondSquared => value / 1000.0,
            Self::StandardGravity => value * STANDARD_GRAVITY,
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
