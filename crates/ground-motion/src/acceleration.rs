//! An acceleration with its unit.

use std::str::FromStr;

use serde::Deserialize;

use crate::error::GroundMotionError;
use crate::unit::Unit;

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
