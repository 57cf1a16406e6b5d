//! Units of acceleration in records.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

use crate::error::GroundMotionError;
use crate::quantity::Quantity;

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

/// An acceleration \[m/s²\], read from a number in m/s² or from a text with its unit.
///
/// ```
/// use ground_motion::Acceleration;
///
/// assert_eq!("0.5g".parse::<Acceleration>()?.0, 0.5 * 9.80665);
/// assert_eq!("3".parse::<Acceleration>()?.0, 3.0);
/// assert!("3 km".parse::<Acceleration>().is_err());
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "NumberOrText")]
pub struct Acceleration(pub f64);

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "expected an acceleration: a number in m/s2, or a text with its unit, such as \"0.3g\""
)]
enum NumberOrText {
    Number(f64),
    Text(String),
}

impl TryFrom<NumberOrText> for Acceleration {
    type Error = GroundMotionError;

    fn try_from(given: NumberOrText) -> Result<Self, Self::Error> {
        match given {
            NumberOrText::Number(value) => Ok(Self(value)),
            NumberOrText::Text(text) => text.parse(),
        }
    }
}

impl FromStr for Acceleration {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let unknown = || GroundMotionError::Acceleration { found: text.chars().take(40).collect() };
        // the `e` of an exponent does not begin a unit
        let is_unit = |c: char| c.is_alphabetic() && !matches!(c, 'e' | 'E');
        let (number, unit) = match text.find(is_unit) {
            Some(at) if text.parse::<f64>().is_err() => text.split_at(at),
            _ => (text, "m/s2"),
        };
        let number: f64 = number.trim().parse().map_err(|_| unknown())?;
        let unit: Unit = unit.parse().map_err(|_| unknown())?;
        Ok(Self(unit.to_si(number)))
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Reads the usual spellings, in any case: `m/s2`, `m/s^2`, `m/s²`, `m/s**2`, `m/s/s`, `m/sec2`, `m/sec/sec`,
/// `m s-2`, `m.s⁻²`, each of them with `cm` or `mm` too, and `gal` and `g`.
impl FromStr for Unit {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match Quantity::of(text) {
            Some(Quantity::Acceleration(unit)) => Ok(unit),
            _ => Err(GroundMotionError::Unit { found: text.chars().take(40).collect() }),
        }
    }
}

impl TryFrom<String> for Unit {
    type Error = GroundMotionError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}
