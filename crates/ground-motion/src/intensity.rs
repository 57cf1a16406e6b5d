//! Velocity and displacement of the ground, and the intensities that are integrals of the acceleration.
//!
//! The ground is at rest at time zero and the acceleration is linear between samples, so that all integrals
//! are exact up to rounding. With a step h from a₀ to a₁,
//!
//! ```text
//! v₁ = v₀ + h (a₀ + a₁)/2                 u₁ = u₀ + h v₀ + h² (2 a₀ + a₁)/6
//! ∫ a² dt = h (a₀² + a₀ a₁ + a₁²)/3       ∫ |a| dt = h (|a₀| + |a₁|)/2, or with a change of sign
//!                                                    h (a₀² + a₁²)/(2 |a₁ − a₀|)
//! ```
//!
//! Nothing is done to the baseline: a record that ends with a velocity has a displacement that drifts.

use std::f64::consts::{PI, TAU};

use crate::error::GroundMotionError;
use crate::motion::GroundMotion;
use crate::spectrum::Spectrum;
use crate::unit::STANDARD_GRAVITY;

/// Shortest and longest period of [Housner's intensity](Spectrum::housner_intensity), in hundredths of a
/// second.
const HOUSNER_PERIODS: [u32; 2] = [10, 250];
/// Parts of ∫ a² dt between which the duration is significant.
const SIGNIFICANT: [f64; 2] = [0.05, 0.95];
/// Halvings of a step that leave no more than a rounding of it.
const HALVINGS: usize = 53;

impl GroundMotion {
    /// Computes the velocity of the ground at the samples (m/s), from rest.
    pub fn velocities(&self) -> Vec<f64> {
        self.states().map(|[velocity, _]| velocity).collect()
    }

    /// Computes the displacement of the ground at the samples (m), from rest.
    pub fn displacements(&self) -> Vec<f64> {
        self.states().map(|[_, displacement]| displacement).collect()
    }

    /// Computes the peak ground velocity PGV (m/s), the largest |v| up to the last sample. Between samples it
    /// lies where the acceleration changes its sign.
    ///
    /// ```
    /// use ground_motion::GroundMotion;
    ///
    /// // v = t − t²/2 has its largest value of 0.5 m/s at 1 s, between the samples
    /// let motion = GroundMotion::new(2.0, vec![1.0, -1.0])?;
    /// assert_eq!((motion.peak_velocity(), motion.velocities()), (0.5, vec![0.0, 0.0]));
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    pub fn peak_velocity(&self) -> f64 {
        self.pieces().fold(0.0, |peak, piece| {
            let [a0, a1] = piece.ends;
            // a changes its sign after the part a₀/(a₀ − a₁) of the step
            let turning = if a0 * a1 < 0.0 { piece.at(a0 / (a0 - a1))[0] } else { 0.0 };
            peak.max(piece.at(1.0)[0].abs()).max(turning.abs())
        })
    }

    /// Computes the peak ground displacement PGD (m), the largest |u| up to the last sample, also between
    /// samples. It means little for a record whose velocity does not end near zero.
    pub fn peak_displacement(&self) -> f64 {
        self.pieces().fold(0.0, |peak, piece| {
            let turning = piece.still().into_iter().flatten().map(|part| piece.at(part)[1].abs());
            turning.fold(peak.max(piece.at(1.0)[1].abs()), f64::max)
        })
    }

    /// Computes Arias intensity (m/s), π/(2 g) ∫ a² dt.
    ///
    /// A. Arias: A measure of earthquake intensity. In: R. J. Hansen (ed.): Seismic design for nuclear power
    /// plants. MIT Press, 1970, 438–483.
    pub fn arias_intensity(&self) -> f64 {
        let square = |pair: &[f64]| pair[0] * pair[0] + pair[0] * pair[1] + pair[1] * pair[1];
        let sum: f64 = self.samples().windows(2).map(square).sum();
        PI / (2.0 * STANDARD_GRAVITY) * (self.step() * sum / 3.0)
    }

    /// Computes the cumulative absolute velocity CAV (m/s), ∫ |a| dt.
    ///
    /// EPRI: A criterion for determining exceedance of the operating basis earthquake. Report NP-5930, 1988.
    pub fn cumulative_absolute_velocity(&self) -> f64 {
        let area = |pair: &[f64]| {
            let [a0, a1] = [pair[0], pair[1]];
            let sum = a0.abs() + a1.abs();
            if a0 * a1 < 0.0 { (a0 * a0 + a1 * a1) / sum } else { sum }
        };
        self.step() * self.samples().windows(2).map(area).sum::<f64>() / 2.0
    }

    /// Computes the significant duration (s): the time from 5 % to 95 % of ∫ a² dt, also between samples. It
    /// does not depend on the scale; a motion of zeros has none, 0 s.
    ///
    /// M. D. Trifunac, A. G. Brady: A study on the duration of strong earthquake ground motion. Bulletin of
    /// the Seismological Society of America 65(3), 1975, 581–626.
    ///
    /// ```
    /// use ground_motion::GroundMotion;
    ///
    /// // of a constant acceleration, 90 % of its 4 s
    /// let motion = GroundMotion::new(1.0, vec![2.0; 5])?;
    /// assert!((motion.significant_duration() - 3.6).abs() < 1e-12);
    /// # Ok::<(), ground_motion::GroundMotionError>(())
    /// ```
    pub fn significant_duration(&self) -> f64 {
        let whole: f64 = self.samples().windows(2).map(|pair| square_up_to(pair, 1.0)).sum();
        let [from, to] = SIGNIFICANT.map(|part| self.time_of_square(part * whole));
        to - from
    }

    /// Returns the time (s) at which ∫ a² dt, in units of the step, reaches a value; 0 for 0.
    fn time_of_square(&self, value: f64) -> f64 {
        let mut sum = 0.0;
        for (index, pair) in self.samples().windows(2).enumerate().filter(|_| value > 0.0) {
            let next = sum + square_up_to(pair, 1.0);
            if next >= value {
                // it rises with the part of the step
                let [mut low, mut high] = [0.0, 1.0];
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    let end = if sum + square_up_to(pair, middle) < value { &mut low } else { &mut high };
                    *end = middle;
                }
                return self.step() * (index as f64 + high);
            }
            sum = next;
        }
        0.0
    }

    /// Returns velocity and displacement at every sample.
    fn states(&self) -> impl Iterator<Item = [f64; 2]> {
        std::iter::once([0.0; 2]).chain(self.pieces().map(|piece| piece.at(1.0)))
    }

    fn pieces(&self) -> impl Iterator<Item = Piece> {
        let step = self.step();
        self.samples().windows(2).scan([0.0; 2], move |start, pair| {
            let piece = Piece { step, ends: [pair[0], pair[1]], start: *start };
            *start = piece.at(1.0);
            Some(piece)
        })
    }
}

impl Spectrum {
    /// Computes Housner's spectrum intensity (m), the integral of the pseudo-velocity spectrum from 0.1 to
    /// 2.5 s, with the damping of the spectrum. The trapezoidal rule takes the periods 0.10, 0.11 … 2.50 s.
    ///
    /// G. W. Housner: Spectrum intensities of strong-motion earthquakes. Proceedings of the symposium on
    /// earthquake and blast effects on structures. Los Angeles, 1952, 20–36.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn housner_intensity(&self, motion: &GroundMotion) -> Result<f64, GroundMotionError> {
        let [first, last] = HOUSNER_PERIODS;
        let mut sum = 0.0;
        for hundredth in first..=last {
            let period = f64::from(hundredth) / 100.0;
            let weight = if hundredth == first || hundredth == last { 0.5 } else { 1.0 };
            sum += weight * self.acceleration(motion, period)? * period / TAU;
        }
        Ok(sum / 100.0)
    }
}

/// Returns ∫ a² dt over a first part of a step, in units of the step.
fn square_up_to(pair: &[f64], part: f64) -> f64 {
    let [a0, a1] = [pair[0], pair[0] + part * (pair[1] - pair[0])];
    part * (a0 * a0 + a0 * a1 + a1 * a1) / 3.0
}

/// The motion of the ground between two samples.
struct Piece {
    step: f64,
    /// Accelerations at its ends.
    ends: [f64; 2],
    /// Velocity and displacement at its start.
    start: [f64; 2],
}

impl Piece {
    /// Returns velocity and displacement after a part of the step.
    fn at(&self, part: f64) -> [f64; 2] {
        let ([a0, a1], [velocity, displacement]) = (self.ends, self.start);
        let (time, end) = (part * self.step, a0 + part * (a1 - a0));
        [
            velocity + time * (a0 + end) / 2.0,
            displacement + time * velocity + time * time * (2.0 * a0 + end) / 6.0,
        ]
    }

    /// Returns the parts of the step after which the velocity is zero: the roots of
    /// v₀ + h a₀ s + h (a₁ − a₀) s²/2.
    fn still(&self) -> [Option<f64>; 2] {
        let ([a0, a1], [velocity, _]) = (self.ends, self.start);
        let (square, linear) = (self.step * (a1 - a0) / 2.0, self.step * a0);
        let discriminant = linear * linear - 4.0 * square * velocity;
        if discriminant < 0.0 {
            return [None; 2];
        }
        // without the cancellation of the usual formula; a root that is not a number is within no step
        let sum = -(linear + discriminant.sqrt().copysign(linear)) / 2.0;
        [sum / square, velocity / sum].map(|part| Some(part).filter(|part| (0.0..=1.0).contains(part)))
    }
}
