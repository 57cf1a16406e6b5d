//! Response spectra of ground motions, and intensities derived from them.
//!
//! An elastic oscillator with period T and damping ratio ξ, at rest at time zero, obeys
//!
//! ```text
//! ü + 2 ξ ω u̇ + ω² u = −a(t),      ω = 2π / T,      Sa(T) = ω² max |u|
//! ```
//!
//! The acceleration is linear between samples, so the recursion from step to step is exact (N. C. Nigam, P.
//! C. Jennings: Calculation of response spectra from strong-motion earthquake records. Bulletin of the
//! Seismological Society of America 59(2), 1969, 909–922). Pieces are at most a twentieth of the period; over
//! those [`Oscillator`] sums power series, because the printed closed forms lose digits to cancellation where
//! ω · step is small.

use std::f64::consts::TAU;

use oscillator::{Green, KinematicState, Oscillator};

use crate::error::{GroundMotionError, check_parameter};
use crate::motion::{GroundMotion, floor_index};

/// Usual damping ratio of response spectra (-).
pub const DAMPING: f64 = 0.05;

/// Usual periods of AvgSA (s).
pub const AVERAGE_PERIODS: [f64; 7] = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4];

/// Shortest and longest period of an oscillator (s). A period of 0 is allowed too: it stands for the ground.
pub const PERIOD_LIMITS: [f64; 2] = [1e-3, 100.0];

/// Pieces in a period; one turning point is searched in each.
const PIECES_PER_PERIOD: f64 = 20.0;

/// Largest number of pieces in a step.
const PIECES_PER_STEP: f64 = 1e4;

/// Largest velocity at a turning point, relative to the velocities around it. The relative error of the
/// displacement is of the order of its square.
const STILL: f64 = 1e-9;

/// Bound on the steps towards a turning point; few are needed where the velocity is nearly a straight line.
const SEARCH_STEPS: usize = 40;

/// Where the largest displacement is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash, Default)]
pub enum Maxima {
    /// At the turning points wherever they lie, in the free vibration after the motion too: the true maximum.
    #[default]
    Everywhere,
    /// At the samples of the motion only, as many programs do: up to (ω · step)² / 8 too low.
    AtSamples,
}

/// Elastic response spectrum: the damping ratio, and where maxima are searched.
///
/// ```
/// use ground_motion::spectrum::AVERAGE_PERIODS;
/// use ground_motion::{Maxima, Spectrum, SyntheticMotion};
///
/// let motion = SyntheticMotion::default().motion()?;
/// let true_maximum = Spectrum::default().acceleration(&motion, 0.2)?;
/// let at_samples = Spectrum::new(0.05, Maxima::AtSamples)?.acceleration(&motion, 0.2)?;
/// assert!(at_samples <= true_maximum);
/// let average = Spectrum::default().average(&motion, &AVERAGE_PERIODS)?;
/// assert!(average < true_maximum);
/// # Ok::<(), ground_motion::GroundMotionError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Spectrum {
    damping: f64,
    maxima: Maxima,
}

impl Default for Spectrum {
    /// 5 % damping, true maxima.
    fn default() -> Self {
        Self { damping: DAMPING, maxima: Maxima::Everywhere }
    }
}

impl Spectrum {
    /// Makes the spectrum of oscillators with a damping ratio (-).
    ///
    /// # Errors
    /// If the damping ratio is not from 0 to below 1.
    pub fn new(damping: f64, maxima: Maxima) -> Result<Self, GroundMotionError> {
        check_parameter((0.0..1.0).contains(&damping), "damping ratio", damping, "from 0 to below 1")?;
        Ok(Self { damping, maxima })
    }

    /// Computes the pseudo-spectral acceleration Sa (m/s²) at a period (s); at 0, the peak ground
    /// acceleration.
    ///
    /// The largest displacement is searched at the samples and at the turning points between: in each piece
    /// of at most a twentieth of the period in which the velocity changes its sign. After the motion the
    /// acceleration is zero, as [`GroundMotion::at`] says, and the free vibration is followed for one period.
    ///
    /// # Errors
    /// If the period is outside [`PERIOD_LIMITS`], or so short that a step of the motion spans more than 500
    /// of it.
    pub fn acceleration(&self, motion: &GroundMotion, period: f64) -> Result<f64, GroundMotionError> {
        if period == 0.0 {
            return Ok(motion.peak());
        }
        let [shortest, longest] = PERIOD_LIMITS;
        check_parameter(
            (shortest..=longest).contains(&period),
            "period",
            period,
            "0 or from 0.001 to 100 s",
        )?;
        let omega = TAU / period;
        let pieces = (motion.step() / period * PIECES_PER_PERIOD).ceil().max(1.0);
        let limit = "at most 500 periods of the oscillator";
        check_parameter(pieces <= PIECES_PER_STEP, "time step in s", motion.step(), limit)?;
        let oscillator = Oscillator::new(2.0 * self.damping * omega, omega * omega);
        let mut piece = Recursion::new(oscillator, motion.step() / pieces);
        let mut search = Search { state: [0.0; 2], largest: 0.0 };
        for pair in motion.samples().windows(2) {
            let slope = (pair[1] - pair[0]) / pieces;
            let at = |index: usize| pair[0] + slope * index as f64;
            for index in 0..floor_index(pieces) {
                search.follow_piece(&piece, [at(index), at(index + 1)], self.maxima);
            }
            search.largest = search.largest.max(search.state[0].abs());
        }
        if self.maxima == Maxima::Everywhere {
            piece = Recursion::new(oscillator, period / PIECES_PER_PERIOD);
            for _ in 0..floor_index(PIECES_PER_PERIOD) {
                search.follow_piece(&piece, [0.0; 2], self.maxima);
            }
        }
        // ω times the pseudo-velocity
        Ok(omega * (omega * search.largest))
    }

    /// Computes Sa (m/s²) at each period (s).
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn accelerations(
        &self,
        motion: &GroundMotion,
        periods: &[f64],
    ) -> Result<Vec<f64>, GroundMotionError> {
        periods.iter().map(|&period| self.acceleration(motion, period)).collect()
    }

    /// Computes AvgSA (m/s²), the geometric mean of Sa over the periods (s), usually [`AVERAGE_PERIODS`].
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration), and if there is no period.
    pub fn average(&self, motion: &GroundMotion, periods: &[f64]) -> Result<f64, GroundMotionError> {
        check_parameter(!periods.is_empty(), "number of periods of AvgSA", 0.0, "1 or more")?;
        let logarithms = self.accelerations(motion, periods)?.into_iter().map(libm::log).sum::<f64>();
        Ok(libm::exp(logarithms / periods.len() as f64))
    }
}

/// An oscillator's displacement and velocity (m, m/s) and its largest displacement so far (m).
struct Search {
    state: [f64; 2],
    largest: f64,
}

impl Search {
    /// Follows the oscillator through one piece, in which the ground acceleration (m/s²) is linear between
    /// the two values of `ground`.
    fn follow_piece(&mut self, piece: &Recursion, ground: [f64; 2], maxima: Maxima) {
        let (start, end) = (self.state, piece.state_at_end(self.state, ground));
        self.state = end;
        if maxima == Maxima::AtSamples || start[1] * end[1] >= 0.0 {
            return;
        }
        // `reach` is twice what a velocity that changes linearly would add to u. Most turning points are far
        // below the largest displacement, and need no search.
        let reach = piece.duration * (start[1].abs() + end[1].abs());
        if start[0].abs().max(end[0].abs()) + reach > self.largest {
            self.largest = self.largest.max(piece.turning_point(start, end, ground).abs());
        }
    }
}

/// The recursion over a short time, from a state (u, u̇) and the ground acceleration at both ends to the next
/// state.
struct Recursion {
    oscillator: Oscillator,
    /// Duration (s).
    duration: f64,
    /// For u and u̇ at the end, the factors of u and u̇ at the start and of the ground acceleration at both
    /// ends.
    factors: [[f64; 4]; 2],
}

impl Recursion {
    fn new(oscillator: Oscillator, duration: f64) -> Self {
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        let Green { g, h, j, .. } = oscillator.green(duration);
        // ü₀ = −a − c u̇₀ − k u₀ and p₁ = (a − b)/duration, put into the formulas of the oscillator
        let of_u = [1.0 - k * h, g, j / duration - h, -j / duration];
        let of_v = [-k * g, 1.0 - k * h - c * g, h / duration - g, -h / duration];
        Self { oscillator, duration, factors: [of_u, of_v] }
    }

    /// Computes the state at the end of the piece.
    fn state_at_end(&self, [u, v]: [f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
        self.factors.map(|[from_u, from_v, from_a, from_b]| from_u * u + from_v * v + from_a * a + from_b * b)
    }

    /// Computes the state at a time (s) within the piece.
    fn state_after(&self, time: f64, [u, v]: [f64; 2], [a, b]: [f64; 2]) -> [f64; 2] {
        let (c, k) = (self.oscillator.damping(), self.oscillator.stiffness());
        let start = KinematicState { displacement: u, velocity: v, acceleration: -a - c * v - k * u };
        let rate = (a - b) / self.duration;
        let series = self.oscillator.series_at(start, rate, time);
        let end = series.unwrap_or_else(|| self.oscillator.propagate(start, rate, time));
        [end.displacement, end.velocity]
    }

    /// Finds the displacement where the velocity passes zero; its sign differs at start and end.
    fn turning_point(&self, start: [f64; 2], end: [f64; 2], ground: [f64; 2]) -> f64 {
        let ((mut low, mut at_low), (mut high, mut at_high)) = ((0.0, start[1]), (self.duration, end[1]));
        let still = STILL * (at_low.abs() + at_high.abs());
        let mut displacement = start[0];
        for _ in 0..SEARCH_STEPS {
            // The chord's zero, kept off the ends so that each step shortens the bracket.
            let (chord, room) = (low + (high - low) * (at_low / (at_low - at_high)), 0.01 * (high - low));
            let time = chord.clamp(low + room, high - room);
            let [u, v] = self.state_after(time, start, ground);
            displacement = u;
            if v.abs() <= still {
                break;
            }
            if (v < 0.0) == (at_low < 0.0) { (low, at_low) = (time, v) } else { (high, at_high) = (time, v) }
        }
        displacement
    }
}
