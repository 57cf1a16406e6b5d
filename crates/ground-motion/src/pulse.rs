//! Motions given by a formula: pulses and harmonics, sampled so that a piecewise-linear record reproduces
//! them.
//!
//! # Sampling
//! Between samples of the formula itself, a straight line differs from the curve by ½ s(Δt − s) a″ at the
//! distance s from a sample, by Δt²/12 a″ in the mean. The nodes are therefore
//!
//! ```text
//! aᵢ = a(tᵢ) − (Δt²/12) a″(tᵢ)
//! ```
//!
//! which removes the mean and, by symmetry, the first moment of the error from each interval by itself. So
//! the correction is the same at the ends of a motion, with the derivative taken from inside, and nothing is
//! smeared across a jump. For a = sin ωt the transfer of the linear interpolation, sinc²(ωΔt/2) = 1 −
//! (ωΔt)²/12 + (ωΔt)⁴/360 − …, times 1 + (ωΔt)²/12 leaves the relative error −(ωΔt)⁴/240: 4e-13 at the 2000
//! steps a period taken here, 3e-11 at three times the frequency, where the spectrum of a Ricker pulse has
//! died out.

use std::f64::consts::PI;

use crate::error::{GroundMotionError, check_parameter, check_positive};
use crate::motion::{GroundMotion, floor_index};

/// Steps in a period.
const STEPS_PER_PERIOD: f64 = 2000.0;
/// Longest step (s).
const LONGEST_STEP: f64 = 1e-3;
/// Most samples of a motion (40 MB).
const MAX_SAMPLES: usize = 5_000_000;
/// Half length of a Ricker pulse as z = π f (t − t₀): beyond it |a| < 1e-16 A.
const RICKER_HALF_LENGTH: f64 = 6.5;

/// Form of a motion given by a formula; time in s, phase in rad.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// a = A (1 − 2z²) exp(−z²), z = π f (t − t₀): second derivative of a Gaussian (Ricker, 1953).
    Ricker {
        /// Time t₀ of the peak (s).
        centre: f64,
    },
    /// a = A sin(2π f t + φ), zero after the end if there is one.
    Harmonic {
        /// Phase φ at time zero (rad).
        phase: f64,
        /// Time at which the motion stops abruptly (s).
        end: Option<f64>,
    },
    /// One cycle a = A sin(2π f t), 0 ≤ t ≤ 1/f.
    SineCycle,
    /// Half a cycle a = A sin(2π f t), 0 ≤ t ≤ 1/(2f).
    HalfSine,
}

/// A motion given by a formula.
///
/// ```
/// use ground_motion::{Pulse, Shape};
///
/// let pulse = Pulse { shape: Shape::SineCycle, amplitude: 3.0, frequency: 2.0 };
/// let motion = pulse.motion(None)?;
/// assert_eq!(motion.duration(), 0.5);
/// assert!((motion.at(0.125) - 3.0).abs() < 1e-5);
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pulse {
    /// Form of the motion.
    pub shape: Shape,
    /// Amplitude A (m/s²).
    pub amplitude: f64,
    /// Frequency f (Hz).
    pub frequency: f64,
}

impl Pulse {
    /// Samples the pulse from time zero to its own end, or to `duration` (s) if that comes first. No zeros
    /// follow.
    ///
    /// # Errors
    /// If a parameter is outside its limits, if the motion has no end, or if it would take too many samples.
    pub fn motion(&self, duration: Option<f64>) -> Result<GroundMotion, GroundMotionError> {
        self.sampled(duration, (1.0 / (STEPS_PER_PERIOD * self.frequency)).min(LONGEST_STEP))
    }

    /// Samples the pulse as [`motion`](Self::motion) does, with steps of at most `longest_step` (s); the step
    /// taken divides the duration.
    ///
    /// # Errors
    /// As [`motion`](Self::motion), and if the step is not positive and finite.
    pub fn sampled(
        &self,
        duration: Option<f64>,
        longest_step: f64,
    ) -> Result<GroundMotion, GroundMotionError> {
        self.check()?;
        if !(longest_step > 0.0 && longest_step.is_finite()) {
            return Err(GroundMotionError::Step { step: longest_step });
        }
        if let Some(duration) = duration {
            check_positive("duration [s]", duration)?;
        }
        let ends = self.end().into_iter().chain(duration);
        let end = ends.reduce(f64::min).ok_or(GroundMotionError::Endless)?;
        // The last sample lies on the end: a jump there must not turn into a ramp.
        let intervals = (end / longest_step).ceil().max(1.0);
        if intervals >= MAX_SAMPLES as f64 {
            return Err(GroundMotionError::TooManySamples { found: intervals + 1.0, limit: MAX_SAMPLES });
        }
        let step = end / intervals;
        let node = |index| {
            let time = index as f64 * step;
            self.acceleration(time) - step * step / 12.0 * self.second_derivative(time)
        };
        GroundMotion::new(step, (0..=floor_index(intervals)).map(node).collect())
    }

    /// Returns the time after which the motion is zero (s); a harmonic may have none.
    pub fn end(&self) -> Option<f64> {
        match self.shape {
            Shape::Ricker { centre } => Some(centre + RICKER_HALF_LENGTH / (PI * self.frequency)),
            Shape::Harmonic { end, .. } => end,
            Shape::SineCycle => Some(1.0 / self.frequency),
            Shape::HalfSine => Some(0.5 / self.frequency),
        }
    }

    /// Computes the acceleration of the formula at a time within the motion (s), in m/s².
    fn acceleration(&self, time: f64) -> f64 {
        match self.shape {
            Shape::Ricker { centre } => {
                let z = PI * self.frequency * (time - centre);
                self.amplitude * (1.0 - 2.0 * z * z) * libm::exp(-z * z)
            }
            Shape::Harmonic { phase, .. } => {
                self.amplitude * libm::sin(self.angular_frequency() * time + phase)
            }
            Shape::SineCycle | Shape::HalfSine => self.amplitude * libm::sin(self.angular_frequency() * time),
        }
    }

    /// Computes a″ of the formula at a time within the motion (s), in m/s⁴.
    fn second_derivative(&self, time: f64) -> f64 {
        match self.shape {
            // (1 − 2z²) exp(−z²) = −½ d²/dz² exp(−z²), so its second derivative is −½ H₄(z) exp(−z²).
            Shape::Ricker { centre } => {
                let rate = PI * self.frequency;
                let z = rate * (time - centre);
                let half_hermite_4 = (8.0 * z * z - 24.0) * z * z + 6.0;
                -self.amplitude * rate * rate * half_hermite_4 * libm::exp(-z * z)
            }
            // a″ = −ω² a
            Shape::Harmonic { .. } | Shape::SineCycle | Shape::HalfSine => {
                -self.angular_frequency() * self.angular_frequency() * self.acceleration(time)
            }
        }
    }

    /// Returns ω = 2π f (rad/s).
    fn angular_frequency(&self) -> f64 {
        2.0 * PI * self.frequency
    }

    fn check(&self) -> Result<(), GroundMotionError> {
        check_finite("amplitude [m/s2]", self.amplitude)?;
        check_positive("frequency [Hz]", self.frequency)?;
        match self.shape {
            Shape::Ricker { centre } => {
                let holds = centre >= 0.0 || centre.is_nan();
                check_parameter(holds, "centre [s]", centre, "zero or positive")?;
                check_finite("centre [s]", centre)
            }
            Shape::Harmonic { phase, end } => {
                check_finite("phase [rad]", phase)?;
                end.map_or(Ok(()), |end| check_positive("end [s]", end))
            }
            Shape::SineCycle | Shape::HalfSine => Ok(()),
        }
    }
}

fn check_finite(name: &'static str, value: f64) -> Result<(), GroundMotionError> {
    check_parameter(value.is_finite(), name, value, "finite")
}
