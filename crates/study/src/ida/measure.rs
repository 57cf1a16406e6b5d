//! Intensity measures.

use ground_motion::spectrum::AVERAGE_PERIODS;
use ground_motion::{GroundMotion, GroundMotionError, STANDARD_GRAVITY, Spectrum, Unit};
use rocking_wall::wall::Usual;

use super::unit::IntensityUnit;

/// Converts an intensity of a study file to SI units.
pub type ToSi = fn(f64) -> f64;

/// Units of velocities and lengths, with what converts them.
const VELOCITIES: [(&str, ToSi); 3] = [("cm/s", |x| x / 100.0), ("m/s", |x| x), ("mm/s", |x| x / 1000.0)];
const LENGTHS: [(&str, ToSi); 3] = [("cm", |x| x / 100.0), ("m", |x| x), ("mm", |x| x / 1000.0)];
/// Units of the cumulative absolute velocity.
const G_SECONDS: [(&str, ToSi); 3] =
    [("g s", |x| x * STANDARD_GRAVITY), ("m/s", |x| x), ("cm/s", |x| x / 100.0)];

/// Intensity measure by which records are scaled; spectral ones are at 5 % damping.
#[derive(Clone, Debug, PartialEq)]
pub enum IntensityMeasure {
    /// Peak ground acceleration.
    Pga,
    /// Peak ground velocity.
    Pgv,
    /// Peak ground displacement.
    Pgd,
    /// Arias intensity; it grows with the square of the motion.
    Arias,
    /// Cumulative absolute velocity.
    Cav,
    /// Housner's spectrum intensity, from 0.1 to 2.5 s.
    Housner,
    /// Spectral acceleration Sa(T).
    Sa {
        /// T \[s\].
        period: f64,
    },
    /// Geometric mean of Sa over periods.
    AvgSa {
        /// Periods \[s\].
        periods: Vec<f64>,
    },
    /// Ground acceleration of the site's spectrum that a motion is worth: the geometric mean, over periods,
    /// of Sa over the shape of that spectrum.
    Code {
        /// Periods \[s\].
        periods: Vec<f64>,
        /// Spectrum over its ground acceleration at each period, `S_e`(T)/`a_g` \[-\].
        shape: Vec<f64>,
    },
}

/// How a motion, scaled to the ground acceleration of a spectrum that it is worth, differs from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Least ratio of Sa to the spectrum \[-\].
    pub least: f64,
    /// Largest ratio \[-\].
    pub largest: f64,
    /// Root of the mean square of the logarithms of the ratios \[-\].
    pub rms: f64,
}

impl Misfit {
    /// Takes the ratios of a motion, or the mean ratios of several.
    pub fn of(ratios: &[f64]) -> Self {
        let squares = ratios.iter().map(|ratio| libm::log(*ratio).powi(2)).sum::<f64>();
        Self {
            least: ratios.iter().copied().fold(f64::INFINITY, f64::min),
            largest: ratios.iter().copied().fold(0.0, f64::max),
            rms: libm::sqrt(squares / ratios.len() as f64),
        }
    }
}

impl Default for IntensityMeasure {
    /// `AvgSA` over 0.2, 0.4 … 1.4 s.
    fn default() -> Self {
        Self::AvgSa { periods: AVERAGE_PERIODS.to_vec() }
    }
}

impl IntensityMeasure {
    /// Returns the intensity of a motion in SI units: m/s² of accelerations, m/s of PGV, Arias intensity and
    /// CAV, m of PGD and Housner's intensity.
    ///
    /// # Errors
    /// [`GroundMotionError`] if there is no period, or one is outside its limits.
    pub fn of(&self, motion: &GroundMotion) -> Result<f64, GroundMotionError> {
        match self {
            Self::Pga => Ok(motion.peak()),
            Self::Pgv => Ok(motion.peak_velocity()),
            Self::Pgd => Ok(motion.peak_displacement()),
            Self::Arias => Ok(motion.arias_intensity()),
            Self::Cav => Ok(motion.cumulative_absolute_velocity()),
            Self::Housner => Spectrum::default().housner_intensity(motion),
            Self::Sa { period } => Spectrum::default().acceleration(motion, *period),
            Self::AvgSa { periods } => Spectrum::default().average(motion, periods),
            Self::Code { periods, shape } => {
                let mean =
                    shape.iter().map(|ordinate| libm::log(*ordinate)).sum::<f64>() / shape.len() as f64;
                Ok(Spectrum::default().average(motion, periods)? / libm::exp(mean))
            }
        }
    }

    /// Returns the factor on a motion that multiplies its intensity by a ratio: the ratio itself, of Arias
    /// intensity its square root.
    pub fn factor(&self, ratio: f64) -> f64 {
        if *self == Self::Arias { ratio.sqrt() } else { ratio }
    }

    /// Returns by what a factor on a motion multiplies its intensity, the inverse of
    /// [`factor`](Self::factor).
    pub fn ratio(&self, factor: f64) -> f64 {
        if *self == Self::Arias { factor * factor } else { factor }
    }

    /// Returns the unit in which results state it.
    pub fn unit(&self) -> IntensityUnit {
        match self {
            Self::Pga | Self::Sa { .. } | Self::AvgSa { .. } | Self::Code { .. } => IntensityUnit::Gravity,
            Self::Pgv => IntensityUnit::CentimetrePerSecond,
            Self::Pgd | Self::Housner => IntensityUnit::Centimetre,
            Self::Arias => IntensityUnit::MetrePerSecond,
            Self::Cav => IntensityUnit::GravitySecond,
        }
    }

    /// Returns the intensities that sites have at a return period of 2475 years, in the unit of results, and
    /// the units in which others are given: from the quietest to the strongest, with a margin.
    pub(crate) fn usual(&self) -> Usual {
        const CM: &[(&str, f64)] = &[("in m", 100.0), ("in mm", 0.1)];
        const G: f64 = 1.0 / STANDARD_GRAVITY;
        const ACCELERATIONS: &[(&str, f64)] = &[("in m/s2", G), ("in cm/s2", 0.01 * G)];
        let (name, range, others): (_, _, &[_]) = match self {
            Self::Pga => ("PGA", [0.004, 2.0], ACCELERATIONS),
            Self::Code { .. } => ("a_g", [0.004, 2.0], ACCELERATIONS),
            Self::Sa { .. } => ("Sa", [0.0005, 5.0], ACCELERATIONS),
            Self::AvgSa { .. } => ("AvgSA", [0.0005, 5.0], ACCELERATIONS),
            Self::Pgv => ("PGV", [0.5, 400.0], &[("in m/s", 100.0), ("in mm/s", 0.1)]),
            Self::Pgd => ("PGD", [0.1, 1000.0], CM),
            Self::Arias => ("Arias", [1e-4, 50.0], &[("in cm/s", 0.01), ("in mm/s", 0.001)]),
            Self::Cav => ("CAV", [0.01, 30.0], &[("in m/s", G), ("in cm/s", 0.01 * G)]),
            Self::Housner => ("Housner", [1.0, 2000.0], CM),
        };
        Usual { name, unit: self.unit().name(), range, others }
    }

    /// Returns Sa of a motion over the spectrum of the ground acceleration that it is worth, at each period;
    /// `None` for other measures.
    ///
    /// # Errors
    /// As [`of`](Self::of).
    pub fn ratios(&self, motion: &GroundMotion) -> Result<Option<Vec<f64>>, GroundMotionError> {
        let Self::Code { periods, shape } = self else { return Ok(None) };
        let worth = self.of(motion)?;
        let found = Spectrum::default().accelerations(motion, periods)?;
        Ok(Some(found.iter().zip(shape).map(|(sa, ordinate)| sa / (worth * ordinate)).collect()))
    }

    /// Returns the periods at which it takes spectra \[s\].
    pub fn periods(&self) -> &[f64] {
        match self {
            Self::Pga | Self::Pgv | Self::Pgd | Self::Arias | Self::Cav | Self::Housner => &[],
            Self::Sa { period } => std::slice::from_ref(period),
            Self::AvgSa { periods } | Self::Code { periods, .. } => periods,
        }
    }

    /// Describes the measure to all digits: `AvgSA over 0.2, 0.4 s`.
    pub fn description(&self) -> String {
        match self {
            Self::AvgSa { periods } => format!("{} over {} s", self.name(), listed(periods)),
            Self::Code { periods, shape } => {
                format!("{} over {} s of a spectrum {}", self.name(), listed(periods), listed(shape))
            }
            _ => self.name(),
        }
    }

    /// Returns the name for axes and tables: `PGA`, `Sa(0.5 s)`, `AvgSA`, `a_g`, `Arias`.
    pub fn name(&self) -> String {
        match self {
            Self::Pga => "PGA".into(),
            Self::Pgv => "PGV".into(),
            Self::Pgd => "PGD".into(),
            Self::Arias => "Arias".into(),
            Self::Cav => "CAV".into(),
            Self::Housner => "Housner".into(),
            Self::Sa { period } => format!("Sa({period} s)"),
            Self::AvgSa { .. } => "AvgSA".into(),
            Self::Code { .. } => "a_g".into(),
        }
    }

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

fn listed(values: &[f64]) -> String {
    values.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
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
