//! Intensity measures.

use ground_motion::spectrum::AVERAGE_PERIODS;
use ground_motion::{GroundMotion, GroundMotionError, Spectrum};

/// Intensity measure by which records are scaled; spectral ones are at 5 % damping.
#[derive(Clone, Debug, PartialEq)]
pub enum IntensityMeasure {
    /// Peak ground acceleration.
    Pga,
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
}

impl Default for IntensityMeasure {
    /// `AvgSA` over 0.2, 0.4 … 1.4 s.
    fn default() -> Self {
        Self::AvgSa { periods: AVERAGE_PERIODS.to_vec() }
    }
}

impl IntensityMeasure {
    /// Returns the intensity of a motion \[m/s²\]. It is proportional to the motion.
    ///
    /// # Errors
    /// [`GroundMotionError`] if there is no period, or one is outside its limits.
    pub fn of(&self, motion: &GroundMotion) -> Result<f64, GroundMotionError> {
        match self {
            Self::Pga => Ok(motion.peak()),
            Self::Sa { period } => Spectrum::default().acceleration(motion, *period),
            Self::AvgSa { periods } => Spectrum::default().average(motion, periods),
        }
    }

    /// Describes the measure to all digits: `AvgSA over 0.2, 0.4 s`.
    pub fn description(&self) -> String {
        match self {
            Self::Pga | Self::Sa { .. } => self.name(),
            Self::AvgSa { periods } => {
                let periods: Vec<_> = periods.iter().map(f64::to_string).collect();
                format!("{} over {} s", self.name(), periods.join(", "))
            }
        }
    }

    /// Returns the name for axes and tables: `PGA`, `Sa(0.5 s)`, `AvgSA`.
    pub fn name(&self) -> String {
        match self {
            Self::Pga => "PGA".into(),
            Self::Sa { period } => format!("Sa({period} s)"),
            Self::AvgSa { .. } => "AvgSA".into(),
        }
    }
}
