//! Closed form on a branch with constant damping, under a forcing linear in time.

use std::cell::OnceCell;

use nalgebra::{Matrix3, Vector3};
use oscillator::{KinematicState, Oscillator, Polynomial, Regime};

use super::event::Piece;
use super::state::Peaks;

/// Motion on a branch in closed form.
#[derive(Clone, Debug)]
pub(super) struct ClosedForm<'a> {
    oscillator: &'a Oscillator,
    start: KinematicState,
    /// Rate of the forcing p₁ \[m/s³\].
    forcing_rate: f64,
    horizon: f64,
    /// The motion at the horizon, where it is known already.
    end: Option<KinematicState>,
    /// The Taylor series of a short piece, once needed.
    series: OnceCell<Option<Polynomial>>,
}

/// The propagator of the last whole step on a branch. Steps of one length compute it once.
///
/// Lengths that differ by the rounding of clocks share one. The length is rounded to 40 bits, and the rest,
/// 5e-13 of it, is made up by the Taylor series. The memo changes no bit of any result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memo {
    branch: usize,
    duration: f64,
    propagator: Matrix3<f64>,
}

impl Default for Memo {
    fn default() -> Self {
        Self { branch: 0, duration: f64::NAN, propagator: Matrix3::zeros() }
    }
}

/// Bits of a length that a rounded length leaves out.
const ROUNDED_BITS: u32 = 12;

/// A length rounded to 40 bits of its mantissa.
fn rounded(duration: f64) -> f64 {
    let half = 1_u64 << (ROUNDED_BITS - 1);
    f64::from_bits((duration.to_bits() + half) & !((1 << ROUNDED_BITS) - 1))
}

impl Memo {
    #[cold]
    fn new(branch: usize, oscillator: &Oscillator, duration: f64) -> Self {
        let rows = oscillator.propagator(duration);
        Self { branch, duration, propagator: Matrix3::from_fn(|i, j| rows[i][j]) }
    }

    /// The end of a whole step on a branch, whose propagator it remembers.
    #[inline]
    pub(super) fn end(
        &mut self,
        branch: usize,
        oscillator: &Oscillator,
        start: KinematicState,
        forcing_rate: f64,
        length: f64,
    ) -> KinematicState {
        let duration = rounded(length);
        if self.duration != duration || self.branch != branch {
            *self = Self::new(branch, oscillator, duration);
        }
        let from = Vector3::new(start.velocity, start.acceleration, forcing_rate);
        let change = self.propagator * from;
        let (velocity, acceleration) = (change[1], change[2]);
        let end = KinematicState { displacement: start.displacement + change[0], velocity, acceleration };
        let rest = length - duration;
        KinematicState {
            displacement: end.displacement + rest * velocity,
            velocity: velocity + rest * acceleration,
            acceleration: acceleration + rest * oscillator.jerk(end, forcing_rate),
        }
    }
}

impl<'a> ClosedForm<'a> {
    /// The motion from `start`, for `remaining` or as long as the closed form is well behaved. An oscillation
    /// within the `bounds` of u and its `peaks` so far needs no search for events.
    pub(super) fn new(
        oscillator: &'a Oscillator,
        start: KinematicState,
        forcing_rate: f64,
        remaining: f64,
        bounds: [f64; 2],
        peaks: &Peaks,
    ) -> Self {
        let mut piece =
            Self { oscillator, start, forcing_rate, horizon: remaining, end: None, series: OnceCell::new() };
        if remaining > oscillator.longest_piece() && !piece.stays_within(bounds, peaks) {
            piece.horizon = oscillator.longest_piece();
        }
        piece
    }

    /// Takes the end of the piece as known.
    pub(super) fn end_at(&mut self, end: KinematicState) {
        self.end = Some(end);
    }

    fn series(&self) -> Option<&Polynomial> {
        let make = || self.oscillator.series_from(self.start, self.forcing_rate, self.horizon);
        self.series.get_or_init(make).as_ref()
    }

    /// Whether the whole motion stays in the range, by its amplitude around the moving equilibrium.
    fn stays_within(&self, [lower, upper]: [f64; 2], peaks: &Peaks) -> bool {
        let (c, k) = (self.oscillator.damping(), self.oscillator.stiffness());
        let Regime::Oscillating(omega) = self.oscillator.regime() else { return false };
        if k <= 0.0 || omega == 0.0 {
            return false;
        }
        let KinematicState { displacement, velocity, acceleration } = self.start;
        // moving equilibrium: u_p = u₀ + (ü₀ + c (u̇₀ − u̇_p))/k, u̇_p = p₁/k
        let drift = self.forcing_rate / k;
        let swing_rate = velocity - drift;
        let swing = -(acceleration + c * swing_rate) / k;
        let (cosine, sine) = (swing, (swing_rate + 0.5 * c * swing) / omega);
        let amplitude = (cosine * cosine + sine * sine).sqrt();
        let from = displacement - swing;
        let to = from + drift * self.horizon;
        let (highest, lowest) = (from.max(to) + amplitude, from.min(to) - amplitude);
        let rounding = PEAK_ROUNDING * amplitude;
        highest <= upper && lowest >= lower && peaks.cover(lowest + rounding, highest - rounding)
    }
}

/// Rounding of the amplitude against a peak already seen.
const PEAK_ROUNDING: f64 = 1e-14;

impl Piece for ClosedForm<'_> {
    fn start(&self) -> KinematicState {
        self.start
    }

    fn horizon(&self) -> f64 {
        self.horizon
    }

    fn at(&self, time: f64) -> KinematicState {
        match self.end {
            Some(end) if time == self.horizon => end,
            _ if time == self.horizon => self
                .oscillator
                .series_at(self.start, self.forcing_rate, time)
                .unwrap_or_else(|| self.oscillator.propagate(self.start, self.forcing_rate, time)),
            _ => match self.series() {
                Some(series) => series.at(time),
                None => self.oscillator.propagate(self.start, self.forcing_rate, time),
            },
        }
    }

    fn bounds(&self, from: KinematicState, length: f64) -> (f64, f64) {
        self.oscillator.bounds(from, self.forcing_rate, length)
    }

    fn snap(&self, (acceleration, jerk): (f64, f64)) -> f64 {
        // u⁗ = −c u‴ − k ü
        self.oscillator.damping() * jerk + self.oscillator.stiffness().abs() * acceleration
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        self.oscillator.displacement_integral(self.start, self.forcing_rate, time)
    }
}
