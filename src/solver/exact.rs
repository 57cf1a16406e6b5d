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

/// The propagator of the last whole step on a branch. It is computed once for steps of the same length.
///
/// Lengths that differ only by the rounding of a clock share one propagator. It is computed for the length
/// rounded to 40 bits, and a Taylor series covers the remainder of up to 5e-13 of the length. Results do not
/// depend on the memo, bit for bit.
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

    /// Returns the end of a whole step on a branch, and remembers its propagator.
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
    /// Prepares the motion from `start`, for `remaining` or for the longest piece that the closed form
    /// allows. An oscillation within the `bounds` of u and its `peaks` so far needs no search for events.
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

    /// Sets the end of the piece, which is known already.
    pub(super) fn end_at(&mut self, end: KinematicState) {
        self.end = Some(end);
    }

    fn series(&self) -> Option<&Polynomial> {
        let make = || self.oscillator.series_from(self.start, self.forcing_rate, self.horizon);
        self.series.get_or_init(make).as_ref()
    }

    /// Returns whether the whole motion stays in the range, by its amplitude around the moving equilibrium.
    fn stays_within(&self, [lower, upper]: [f64; 2], peaks: &Peaks) -> bool {
        let (c, k) = (self.oscillator.damping(), self.oscillator.stiffness());
        let omega = match self.oscillator.regime() {
            Regime::Oscillating(omega) if omega > 0.0 => omega,
            Regime::Oscillating(_) | Regime::Exponential(..) => return false,
        };
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

/// Margin for rounding where an amplitude is compared with a peak that has been reached.
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

    fn snap(&self, _between: [f64; 2], (acceleration, jerk): (f64, f64)) -> f64 {
        // u⁗ = −c u‴ − k ü
        self.oscillator.damping() * jerk + self.oscillator.stiffness().abs() * acceleration
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        self.oscillator.displacement_integral(self.start, self.forcing_rate, time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A length within 2¹¹ roundings of a length of 40 bits is rounded to that.
    #[test]
    fn lengths_are_rounded_to_forty_bits() {
        for length in [0.01, 0.02, 1.0 / 3.0, 7.3e-5] {
            let shared = rounded(length);
            assert_eq!(shared.to_bits() % (1 << 12), 0, "{length}");
            assert!(length.to_bits().abs_diff(shared.to_bits()) <= 1 << 11, "{length}");
            for apart in [1, 100, 2047] {
                assert_eq!(rounded(f64::from_bits(shared.to_bits() + apart)), shared);
                assert_eq!(rounded(f64::from_bits(shared.to_bits() - apart)), shared);
            }
        }
    }

    /// The end of a step whose length is rounded is that of the step itself, also where ü is far below the
    /// jerk over the step.
    #[test]
    fn ends_of_steps_are_those_of_their_own_length() {
        let oscillator = Oscillator::new(0.4, 9.0);
        for apart in [2047, 1000, 1] {
            let length = f64::from_bits(rounded(0.7).to_bits() + apart);
            let start = KinematicState { displacement: 0.3, velocity: 20.0, acceleration: -50.0 };
            let found = Memo::default().end(0, &oscillator, start, 90.0, length);
            let wanted = oscillator.propagate(start, 90.0, length);
            // a few roundings of the largest terms; without the remainder of the length it would be a
            // thousand
            let near =
                |found: f64, wanted: f64| assert!((found - wanted).abs() <= 1e-13, "{found}, {wanted}");
            near(found.displacement, wanted.displacement);
            near(found.velocity, wanted.velocity);
            near(found.acceleration, wanted.acceleration);
        }
    }

    /// A motion counts as staying within bounds and peaks where these hold its initial amplitude about both
    /// ends of the way of its equilibrium. Its decay is not used.
    #[test]
    fn a_motion_stays_within_its_amplitude_about_a_moving_equilibrium() {
        let oscillator = Oscillator::new(0.4, 9.0);
        let horizon = 20.0;
        for (u, v, p, rate) in [(0.3, 0.0, 0.0, 0.0), (0.1, -0.7, 0.5, 0.05), (-0.2, 0.4, -1.0, -0.02)] {
            let start = KinematicState { displacement: u, velocity: v, acceleration: p - 0.4 * v - 9.0 * u };
            // u = u_p + e^(−ct/2) (A cos ωt + B sin ωt), with u_p = (p + p₁ t − c p₁/k)/k
            let (omega, slope) = (f64::sqrt(9.0 - 0.04), rate / 9.0);
            let middle = (p - 0.4 * slope) / 9.0;
            let (a, b) = (u - middle, (v - slope + 0.2 * (u - middle)) / omega);
            let amplitude = a.hypot(b);
            let (from, to) = (middle, middle + slope * horizon);
            let [low, high] = [from.min(to) - amplitude, from.max(to) + amplitude];
            let stays = |bounds: [f64; 2], seen: [f64; 2]| {
                let mut peaks = Peaks::at(seen[0]);
                peaks.include(seen[1]);
                let whole = [-9.0, 9.0];
                let piece = ClosedForm::new(&oscillator, start, rate, horizon, whole, &Peaks::at(0.0));
                ClosedForm { horizon, ..piece }.stays_within(bounds, &peaks)
            };
            let wide = |by: f64| [low - by, high + by];
            assert!(stays(wide(1e-9), wide(1e-9)));
            for side in [0, 1] {
                let mut close = wide(1e-9);
                close[side] = wide(-1e-9)[side];
                assert!(!stays(close, wide(1e-9)) && !stays(wide(1e-9), close), "{u}, side {side}");
            }
            // to rounding, peaks that the motion itself has reached count as seen
            assert!(stays(wide(1e-9), wide(-1e-15 * amplitude)));
            assert!(!stays(wide(1e-9), wide(-2.0 * PEAK_ROUNDING * amplitude)));
        }
    }
}
