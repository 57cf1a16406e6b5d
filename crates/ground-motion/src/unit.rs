//! Units of acceleration in records.

use std::fmt;
use std::str::FromStr;

use super::GroundMotionError;
use super::error::{Fault, excerpt};
use super::fields::{DAMAGED, after};

/// Standard gravity, the unit g of records (m/s²), whatever gravity acts on the wall
/// (3rd General Conference on Weights and Measures, 1901).
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// The remedy for a record whose unit is not known.
pub(super) const REMEDY: &str = "state the unit of the record (m/s2, cm/s2, mm/s2 or g)";

/// Unit of acceleration of a record.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
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

    /// The unit's name as this project writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MetrePerSecondSquared => "m/s2",
            Self::CentimetrePerSecondSquared => "cm/s2",
            Self::MillimetrePerSecondSquared => "mm/s2",
            Self::StandardGravity => "g",
        }
    }

    /// A value in this unit as m/s².
    ///
    /// Divides where the factor is not a binary fraction but its inverse is a whole number: 1 cm/s² is then the
    /// double nearest to 0.01 m/s².
    #[must_use]
    pub fn to_si(self, value: f64) -> f64 {
        match self {
            Self::MetrePerSecondSquared => value,
            Self::CentimetrePerSecondSquared => value / 100.0,
            Self::MillimetrePerSecondSquared => value / 1000.0,
            Self::StandardGravity => value * STANDARD_GRAVITY,
        }
    }

    /// The value of a field in m/s², which must be finite.
    pub(super) fn checked_to_si(self, value: f64, line: usize, field: &str) -> Result<f64, Fault> {
        let converted = self.to_si(value);
        if converted.is_finite() {
            return Ok(converted);
        }
        Err(Fault::new(line, "a finite number", excerpt(field), DAMAGED))
    }

    /// The unit of a file that writes `word` on `line`. What the user states decides where the word says nothing, and
    /// must not contradict one that does.
    pub(super) fn settled(word: &str, line: usize, given: Option<Self>) -> Result<Self, Fault> {
        match (word.parse::<Self>(), given) {
            (Ok(unit), Some(given)) if unit != given => {
                let expected = format!("the stated unit {given}");
                Err(Fault::new(line, expected, unit.name(), "state no unit: the file has its own"))
            }
            (Ok(unit), _) => Ok(unit),
            (Err(_), Some(given)) => Ok(given),
            (Err(_), None) => Err(Fault::new(line, "a unit of acceleration", excerpt(word), REMEDY)),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Reads the usual spellings, in any case: `m/s2`, `m/s^2`, `m/s²`, `m/s**2`, `m/s/s`, `m/sec2`, `m/sec/sec`,
/// `m s-2`, the same with `cm` and `mm`, `gal`, `g`.
impl FromStr for Unit {
    type Err = GroundMotionError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let plain: String = text
            .to_lowercase()
            .replace("sec", "s")
            .replace('²', "2")
            .replace('−', "-")
            .chars()
            .filter(|c| !c.is_whitespace() && !matches!(c, '^' | '*' | '·' | '(' | ')'))
            .collect();
        match plain.as_str() {
            "g" => return Ok(Self::StandardGravity),
            "gal" | "gals" => return Ok(Self::CentimetrePerSecondSquared),
            _ => {}
        }
        let length = ["/s2", "/s/s", "s-2"].iter().find_map(|per_time| plain.strip_suffix(per_time));
        match length {
            Some("m") => Ok(Self::MetrePerSecondSquared),
            Some("cm") => Ok(Self::CentimetrePerSecondSquared),
            Some("mm") => Ok(Self::MillimetrePerSecondSquared),
            _ => Err(GroundMotionError::Unit { found: text.chars().take(40).collect() }),
        }
    }
}

/// The word after `UNITS OF`, `UNITS ARE`, `UNITS:` …
pub(super) fn unit_word(line: &str) -> Option<&str> {
    let text = after(line, "UNITS")?;
    let is_edge = |c: char| matches!(c, '(' | ')' | '[' | ']' | ',' | '.' | ';' | ':' | '=');
    let words = text.split_ascii_whitespace().map(|word| word.trim_matches(is_edge));
    let is_filler =
        |word: &str| ["of", "are", "is", "in", ""].iter().any(|filler| word.eq_ignore_ascii_case(filler));
    words.into_iter().find(|word| !is_filler(word))
}
