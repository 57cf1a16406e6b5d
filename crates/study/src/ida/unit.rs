//! Units of intensities.

use serde::{Deserialize, Serialize};

use ground_motion::{STANDARD_GRAVITY, Unit};

use super::measure::IntensityMeasure;

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

/// Converts an intensity of a study file to SI units.
pub type ToSi = fn(f64) -> f64;

/// Units of velocities and lengths, with what converts them.
const VELOCITIES: [(&str, ToSi); 3] = [("cm/s", |x| x / 100.0), ("m/s", |x| x), ("mm/s", |x| x / 1000.0)];
const LENGTHS: [(&str, ToSi); 3] = [("cm", |x| x / 100.0), ("m", |x| x), ("mm", |x| x / 1000.0)];
/// Units of the cumulative absolute velocity.
const G_SECONDS: [(&str, ToSi); 3] =
    [("g s", |x| x * STANDARD_GRAVITY), ("m/s", |x| x), ("cm/s", |x| x / 100.0)];

impl IntensityMeasure {
    /// Returns what converts an intensity in a unit to SI units; without a name, in the unit of results.
    ///
    /// # Errors
    /// A message with the units of the measure, if the unit is none of them.
    pub fn to_si(&self, unit: Option<&str>) -> Result<ToSi, String> {
        let own = self.unit();
        let name = unit.unwrap_or(own.name());
        let units = match own {
            IntensityUnit::Gravity => {
                let unit: Unit = name.parse().map_err(|_| {
                    format!("unit {name:?} of {}: expected m/s2, cm/s2, mm/s2 or g", self.name())
                })?;
                return Ok(match unit {
                    Unit::MetrePerSecondSquared => |x| Unit::MetrePerSecondSquared.to_si(x),
                    Unit::CentimetrePerSecondSquared => |x| Unit::CentimetrePerSecondSquared.to_si(x),
                    Unit::MillimetrePerSecondSquared => |x| Unit::MillimetrePerSecondSquared.to_si(x),
                    Unit::StandardGravity => |x| Unit::StandardGravity.to_si(x),
                });
            }
            IntensityUnit::CentimetrePerSecond | IntensityUnit::MetrePerSecond => VELOCITIES,
            IntensityUnit::Centimetre => LENGTHS,
            IntensityUnit::GravitySecond => G_SECONDS,
        };
        let found = units.iter().find(|(known, _)| *known == name);
        found.map(|(_, to_si)| *to_si).ok_or_else(|| {
            let known: Vec<_> = units.iter().map(|(known, _)| *known).collect();
            format!("unit {name:?} of {}: expected {}", self.name(), known.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_their_sizes() {
        for (measure, unit, size) in [
            (IntensityMeasure::Pga, None, 9.806_65),
            (IntensityMeasure::Pga, Some("cm/s2"), 0.01),
            (IntensityMeasure::Pgv, None, 0.01),
            (IntensityMeasure::Pgv, Some("m/s"), 1.0),
            (IntensityMeasure::Pgd, Some("mm"), 0.001),
            (IntensityMeasure::Arias, None, 1.0),
            (IntensityMeasure::Cav, None, 9.806_65),
            (IntensityMeasure::Housner, None, 0.01),
            (IntensityMeasure::Pga, Some("mm/s2"), 0.001),
            (IntensityMeasure::Pga, Some("m/s2"), 1.0),
            (IntensityMeasure::Pga, Some("g"), 9.806_65),
            (IntensityMeasure::Pgv, Some("mm/s"), 0.001),
            (IntensityMeasure::Pgd, Some("m"), 1.0),
            (IntensityMeasure::Pgd, Some("cm"), 0.01),
            (IntensityMeasure::Arias, Some("cm/s"), 0.01),
            (IntensityMeasure::Cav, Some("m/s"), 1.0),
            (IntensityMeasure::Cav, Some("cm/s"), 0.01),
        ] {
            assert_eq!(measure.to_si(unit).unwrap()(1.0), size, "{measure:?} {unit:?}");
            // what is written is read again
            let own = measure.unit();
            assert_eq!(measure.to_si(Some(own.name())).unwrap()(1.0), own.size());
        }
        let told = IntensityMeasure::Arias.to_si(Some("cm")).unwrap_err();
        assert_eq!(told, "unit \"cm\" of Arias: expected cm/s, m/s, mm/s");
        let told = IntensityMeasure::Pgv.to_si(Some("g")).unwrap_err();
        assert_eq!(told, "unit \"g\" of PGV: expected cm/s, m/s, mm/s");
        assert_eq!(IntensityUnit::Gravity.shown(9.806_65), "9.80665 m/s² (1 g)");
        assert_eq!(IntensityUnit::MetrePerSecond.shown(2.0), "2 m/s");
    }

    #[test]
    fn units_have_their_names() {
        for (measure, name, ending, si, si_ending, shown) in [
            (IntensityMeasure::Pga, "g", "_g", "m/s²", "_m_s2", "0.5 m/s² (0.0509858 g)"),
            (IntensityMeasure::Pgv, "cm/s", "_cm_s", "m/s", "_m_s", "0.5 m/s (50 cm/s)"),
            (IntensityMeasure::Pgd, "cm", "_cm", "m", "_m", "0.5 m (50 cm)"),
            (IntensityMeasure::Housner, "cm", "_cm", "m", "_m", "0.5 m (50 cm)"),
            (IntensityMeasure::Arias, "m/s", "_m_s", "m/s", "_m_s", "0.5 m/s"),
            (IntensityMeasure::Cav, "g s", "_g_s", "m/s", "_m_s", "0.5 m/s (0.0509858 g s)"),
        ] {
            let unit = measure.unit();
            assert_eq!((unit.name(), unit.ending().as_str()), (name, ending));
            assert_eq!((unit.si(), unit.si_ending().as_str()), (si, si_ending));
            assert_eq!(unit.shown(0.5), shown);
            assert_eq!(unit.of(0.5) * unit.size(), 0.5);
        }
    }
}
