//! Units of intensities.

use serde::{Deserialize, Serialize};

use ground_motion::STANDARD_GRAVITY;

/// Unit in which results state the intensities of a measure: that of `OpenQuake`, where it knows the measure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum IntensityUnit {
    /// g, of accelerations.
    #[default]
    #[serde(rename = "g")]
    Gravity,
    /// cm/s, of the peak velocity.
    #[serde(rename = "cm/s")]
    CentimetrePerSecond,
    /// cm, of the peak displacement and of Housner's intensity.
    #[serde(rename = "cm")]
    Centimetre,
    /// m/s, of Arias intensity.
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// g s, of the cumulative absolute velocity.
    #[serde(rename = "g s")]
    GravitySecond,
}

impl IntensityUnit {
    /// Its name, the name of the SI unit of the same quantity, and its size in this.
    fn described(self) -> (&'static str, &'static str, f64) {
        match self {
            Self::Gravity => ("g", "m/s²", STANDARD_GRAVITY),
            Self::CentimetrePerSecond => ("cm/s", "m/s", 0.01),
            Self::Centimetre => ("cm", "m", 0.01),
            Self::MetrePerSecond => ("m/s", "m/s", 1.0),
            Self::GravitySecond => ("g s", "m/s", STANDARD_GRAVITY),
        }
    }

    /// Returns its name: `g`, `cm/s`, `cm`, `m/s`, `g s`.
    pub fn name(self) -> &'static str {
        self.described().0
    }

    /// Returns the end of the names of columns in this unit: `theta` and `_cm_s` are `theta_cm_s`.
    pub fn ending(self) -> String {
        format!("_{}", self.name().replace(['/', ' '], "_"))
    }

    /// Returns the name of the SI unit of the same quantity: `m/s²`, `m/s`, `m`.
    pub fn si(self) -> &'static str {
        self.described().1
    }

    /// Returns the end of the names of columns in that SI unit.
    pub fn si_ending(self) -> String {
        format!("_{}", self.si().replace('/', "_").replace('²', "2"))
    }

    /// Returns the unit in SI units.
    pub fn size(self) -> f64 {
        self.described().2
    }

    /// Converts an intensity from SI units to this unit.
    pub fn of(self, intensity: f64) -> f64 {
        intensity / self.size()
    }

    /// Writes an intensity, given in SI units, in those and in this unit, since a study may state either.
    pub(super) fn shown(self, intensity: f64) -> String {
        let rounded = |value: f64| format!("{value:.5e}").parse().unwrap_or(value);
        let (si, own) = (rounded(intensity), rounded(self.of(intensity)));
        match self {
            Self::MetrePerSecond => format!("{si} m/s"),
            _ => format!("{si} {} ({own} {})", self.si(), self.name()),
        }
    }
}
