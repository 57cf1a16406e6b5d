//! What a rocking spectrum goes over, and what can be wrong with it.

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, GroundMotionError, Pulse, Shape};
use rocking_wall::solver::SolverError;
use rocking_wall::wall::ParameterError;

use super::MOST_POINTS;

/// Steps of a pulse in a period.
const STEPS_PER_PERIOD: f64 = 2000.0;

/// How the size of a wall is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Height h \[m\].
    Height,
    /// Half the diagonal of a parapet, R = √(h² + b²)/2 \[m\].
    SemiDiagonal,
}

/// How the slenderness of a wall is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slenderness {
    /// h/b \[-\].
    Ratio,
    /// α = atan(b/h) of a parapet \[rad\].
    Angle,
}

/// The form of a pulse of unit amplitude; `ω_p` = 2π f.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PulseForm {
    /// Symmetric Ricker pulse (1 − 2z²) exp(−z²), z = π f (t − t₀).
    Ricker,
    /// One cycle of a sine.
    SineCycle,
    /// Half a cycle of a sine.
    HalfSine,
}

/// Why a spectrum could not be made.
#[derive(Debug, thiserror::Error)]
pub enum SpectrumError {
    /// A value of an axis that makes no wall or pulse.
    #[error("{name} = {value} is out of range; it must be {limit}")]
    Value {
        /// The axis.
        name: &'static str,
        /// The value.
        value: f64,
        /// What is allowed.
        limit: String,
    },
    /// More points than memory or patience are for.
    #[error("{found} points are more than {MOST_POINTS}; take fewer rows or columns")]
    TooManyPoints {
        /// Points asked for.
        found: usize,
    },
    /// R and α belong to a parapet.
    #[error("{name} is that of a parapet; for a vertical spanning wall give heights and h/b")]
    ParapetOnly {
        /// The axis.
        name: &'static str,
    },
    /// One of the walls.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Wall {
        /// Height \[m\].
        height: f64,
        /// Thickness \[m\].
        thickness: f64,
        /// What is wrong with it.
        source: ParameterError,
    },
    /// One of the runs.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Run {
        /// Height \[m\].
        height: f64,
        /// Thickness \[m\].
        thickness: f64,
        /// Why it broke off.
        source: SolverError,
    },
    /// The pulse.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
}

impl Size {
    /// Name and unit, for axes and messages.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Height => "height h (m)",
            Self::SemiDiagonal => "semi-diagonal R (m)",
        }
    }
}

impl Slenderness {
    /// Name and unit, for axes and messages.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Ratio => "slenderness h/b",
            Self::Angle => "slenderness angle α (rad)",
        }
    }
}

impl PulseForm {
    /// The pulse with a frequency \[Hz\] and the amplitude 1 m/s²; a Ricker pulse from where it is −4e-17 on.
    #[must_use]
    pub fn pulse(self, frequency: f64) -> Pulse {
        let shape = match self {
            Self::Ricker => Shape::Ricker { centre: 6.5 / (0.5 * TAU * frequency) },
            Self::SineCycle => Shape::SineCycle,
            Self::HalfSine => Shape::HalfSine,
        };
        Pulse { shape, amplitude: 1.0, frequency }
    }

    /// The pulse as a record, in 2000 steps a period: with a frequency \[Hz\] and the amplitude 1 m/s².
    ///
    /// # Errors
    /// [`GroundMotionError`] if the frequency is not positive and finite.
    pub fn motion(self, frequency: f64) -> Result<GroundMotion, GroundMotionError> {
        self.pulse(frequency).sampled(None, 1.0 / (STEPS_PER_PERIOD * frequency))
    }
}
