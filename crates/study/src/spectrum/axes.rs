//! Axes of a rocking spectrum, and errors of their values.

use std::f64::consts::{FRAC_PI_2, TAU};

use ground_motion::{GroundMotion, GroundMotionError, Pulse, Shape};
use rocking_wall::solver::SolverError;
use rocking_wall::wall::{ParameterError, Parameters};

/// Most points of a spectrum.
pub const MOST_POINTS: usize = 250_000;
/// Steps of a pulse in half a period; even, so that the middle is a sample.
const HALF_PERIOD: u32 = 1000;

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

/// Form of a pulse of unit amplitude; `ω_p` = 2π f. Half sine, rectangle and triangles last half a period,
/// 1/(2f).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PulseForm {
    /// Symmetric Ricker pulse (1 − 2z²) exp(−z²), z = π f (t − t₀).
    Ricker,
    /// One cycle of a sine.
    SineCycle,
    /// One cycle of a cosine.
    CosineCycle,
    /// Half a cycle of a sine.
    HalfSine,
    /// A constant acceleration.
    Rectangle,
    /// A triangle that rises to its peak in the middle.
    Triangle,
    /// A triangle that falls from its peak at the start.
    FallingTriangle,
}

/// Why a spectrum could not be made.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum SpectrumError {
    /// A value of an axis makes no pulse or no wall.
    #[error("{name} = {value} is out of range; it must be {limit}")]
    Value { name: &'static str, value: f64, limit: String },
    /// A size and a slenderness make no wall.
    #[error("{} = {}, {} = {}: {reason}", place[0], values[0], place[1], values[1])]
    Shape { place: [&'static str; 2], values: [f64; 2], reason: String },
    /// There are more points than [`MOST_POINTS`].
    #[error("{found} points are more than {MOST_POINTS}; take fewer rows or columns")]
    TooManyPoints { found: usize },
    /// R or α is given for a wall that is not a parapet.
    #[error("{name} is for parapets only; for a vertical spanning wall give heights and h/b")]
    ParapetOnly { name: &'static str },
    /// The wall is none of a height and a thickness.
    #[error("a rocking spectrum takes rectangles: leave [[geometry.part]] and [geometry.body] out")]
    Body,
    /// A wall of a height and thickness \[m\] is invalid.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Wall { height: f64, thickness: f64, source: ParameterError },
    /// A run of the wall of a height and thickness \[m\] failed.
    #[error("wall of {height} m by {thickness} m: {source}")]
    Run { height: f64, thickness: f64, source: SolverError },
    /// The wall does not move.
    #[error("the wall stays at rest under the record, so that every pulse has its peak: scale the record up")]
    AtRest,
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
    /// All forms with their names.
    const NAMED: [(&'static str, Self); 7] = [
        ("ricker", Self::Ricker),
        ("sine_cycle", Self::SineCycle),
        ("cosine_cycle", Self::CosineCycle),
        ("half_sine", Self::HalfSine),
        ("rectangle", Self::Rectangle),
        ("triangle", Self::Triangle),
        ("falling_triangle", Self::FallingTriangle),
    ];

    /// Returns its name.
    pub fn name(self) -> &'static str {
        Self::NAMED.into_iter().find(|(_, form)| *form == self).map_or("", |(name, _)| name)
    }

    /// Returns the form of a name.
    ///
    /// # Errors
    /// The names that there are.
    pub fn from_name(name: &str) -> Result<Self, String> {
        let found = Self::NAMED.into_iter().find(|(own, _)| *own == name);
        found
            .map(|(_, form)| form)
            .ok_or_else(|| format!("{name:?} is not one of {}", Self::NAMED.map(|(own, _)| own).join(", ")))
    }

    /// Samples the pulse of a frequency \[Hz\] and the amplitude 1 m/s² in 2000 steps a period. A Ricker
    /// pulse starts where it is −4e-17.
    ///
    /// # Errors
    /// [`GroundMotionError`] if the frequency is not positive and finite.
    pub fn motion(self, frequency: f64) -> Result<GroundMotion, GroundMotionError> {
        if !(frequency > 0.0 && frequency.is_finite()) {
            let (name, limit) = ("frequency [Hz]", "positive and finite");
            return Err(GroundMotionError::Parameter { name, value: frequency, limit });
        }
        let step = 1.0 / (2.0 * f64::from(HALF_PERIOD) * frequency);
        let curved = |shape| Pulse { shape, amplitude: 1.0, frequency }.sampled(None, step);
        // lines between samples are the pulse itself; a corner lies on a sample
        let straight = |height: fn(f64) -> f64| {
            let half = (0..=HALF_PERIOD).map(|index| height(f64::from(index) / f64::from(HALF_PERIOD)));
            GroundMotion::new(step, half.collect())
        };
        match self {
            Self::Ricker => curved(Shape::Ricker { centre: 6.5 / (0.5 * TAU * frequency) }),
            Self::SineCycle => curved(Shape::SineCycle),
            Self::CosineCycle => curved(Shape::Harmonic { phase: FRAC_PI_2, end: Some(1.0 / frequency) }),
            Self::HalfSine => curved(Shape::HalfSine),
            Self::Rectangle => straight(|_| 1.0),
            Self::Triangle => straight(|part| 1.0 - (2.0 * part - 1.0).abs()),
            Self::FallingTriangle => straight(|part| 1.0 - part),
        }
    }
}
