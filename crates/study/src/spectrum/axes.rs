//! Axes of a rocking spectrum, and errors of their values.

use std::f64::consts::TAU;

use ground_motion::{GroundMotion, GroundMotionError, Pulse, Shape};
use rocking_wall::solver::SolverError;
use rocking_wall::wall::{ParameterError, Parameters};

/// Most points of a spectrum.
pub const MOST_POINTS: usize = 250_000;
/// Steps of a pulse in one period.
const STEPS_PER_PERIOD: f64 = 2000.0;

/// What an axis counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// Name in tables, with its unit.
    pub name: &'static str,
    /// Label for people, with its unit.
    pub label: &'static str,
}

/// What the axes of rocking spectra can count.
pub const QUANTITIES: [Quantity; 6] = [
    Quantity { name: "height_m", label: "height h (m)" },
    Quantity { name: "semi_diagonal_m", label: "semi-diagonal R (m)" },
    Quantity { name: "slenderness", label: "slenderness h/b" },
    Quantity { name: "angle_rad", label: "slenderness angle α (rad)" },
    Quantity { name: "frequency_ratio", label: "ω_p / p" },
    Quantity { name: "amplitude_ratio", label: "a_p / a₀" },
];

/// Measure of the size of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// Height h \[m\].
    Height,
    /// Half the diagonal of a parapet, R = √(h² + b²)/2 \[m\].
    SemiDiagonal,
}

/// Measure of the slenderness of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slenderness {
    /// h/b \[-\].
    Ratio,
    /// α = atan(b/h) of a parapet \[rad\].
    Angle,
}

/// Form of a pulse of unit amplitude; `ω_p` = 2π f.
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
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum SpectrumError {
    /// A value of an axis makes no wall or pulse.
    #[error("{name} = {value} is out of range; it must be {limit}")]
    Value { name: &'static str, value: f64, limit: String },
    /// There are more points than [`MOST_POINTS`].
    #[error("{found} points are more than {MOST_POINTS}; take fewer rows or columns")]
    TooManyPoints { found: usize },
    /// R or α is given for a wall that is not a parapet.
    #[error("{name} is for parapets only; for a vertical spanning wall give heights and h/b")]
    ParapetOnly { name: &'static str },
    /// A wall of a height and thickness \[m\] is invalid.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Wall { height: f64, thickness: f64, source: ParameterError },
    /// A run of the wall of a height and thickness \[m\] failed.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Run { height: f64, thickness: f64, source: SolverError },
    /// A pulse is invalid.
    #[error(transparent)]
    Motion(#[from] GroundMotionError),
}

impl Size {
    /// Returns the size of a wall.
    pub fn of(self, parameters: &Parameters) -> f64 {
        let Parameters { height, thickness, .. } = *parameters;
        match self {
            Self::Height => height,
            Self::SemiDiagonal => height.hypot(thickness) / 2.0,
        }
    }

    /// Returns what an axis of sizes counts.
    pub fn quantity(self) -> Quantity {
        QUANTITIES[usize::from(self == Self::SemiDiagonal)]
    }
}

impl Slenderness {
    /// Returns the slenderness of a wall.
    pub fn of(self, parameters: &Parameters) -> f64 {
        let Parameters { height, thickness, .. } = *parameters;
        match self {
            Self::Ratio => height / thickness,
            Self::Angle => (thickness / height).atan(),
        }
    }

    /// Returns what an axis of slendernesses counts.
    pub fn quantity(self) -> Quantity {
        QUANTITIES[2 + usize::from(self == Self::Angle)]
    }
}

impl PulseForm {
    /// Returns the form of a name: `ricker`, `sine_cycle`, `half_sine`.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "ricker" => Some(Self::Ricker),
            "sine_cycle" => Some(Self::SineCycle),
            "half_sine" => Some(Self::HalfSine),
            _ => None,
        }
    }

    /// Returns the pulse with a frequency \[Hz\] and the amplitude 1 m/s². A Ricker pulse starts where it is
    /// −4e-17.
    pub fn pulse(self, frequency: f64) -> Pulse {
        let shape = match self {
            Self::Ricker => Shape::Ricker { centre: 6.5 / (0.5 * TAU * frequency) },
            Self::SineCycle => Shape::SineCycle,
            Self::HalfSine => Shape::HalfSine,
        };
        Pulse { shape, amplitude: 1.0, frequency }
    }

    /// Samples the pulse of a frequency \[Hz\] and the amplitude 1 m/s² in 2000 steps a period.
    ///
    /// # Errors
    /// [`GroundMotionError`] if the frequency is not positive and finite.
    pub fn motion(self, frequency: f64) -> Result<GroundMotion, GroundMotionError> {
        self.pulse(frequency).sampled(None, 1.0 / (STEPS_PER_PERIOD * frequency))
    }
}
