//! Closed form on a branch with constant damping, under a forcing linear in time.

use std::cell::OnceCell;

use oscillator::{Bounds, KinematicState, Oscillator, Polynomial, Regime};

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
    pub(super) end: Option<KinematicState>,
    /// ∫u dt up to the horizon, where it is known already \[m s\].
    pub(super) integral: Option<f64>,
    /// The Taylor series of a short piece, once needed.
    series: OnceCell<Option<Polynomial>>,
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
        let (horizon, end, integral, series) = (remaining, None, None, OnceCell::new());
        let mut piece = Self { oscillator, start, forcing_rate, horizon, end, integral, series };
        if remaining > oscillator.longest_piece() && !piece.stays_within(bounds, peaks) {
            piece.horizon = oscillator.longest_piece();
        }
        piece
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
            _ => match self.series() {
                Some(series) => series.at(time),
                None => self.oscillator.propagate(self.start, self.forcing_rate, time),
            },
        }
    }

    fn bounds(&self, from: KinematicState, length: f64) -> Bounds {
        self.oscillator.bounds(from, self.forcing_rate, length)
    }

    fn curvatures(&self, [left, right]: [f64; 2], from: KinematicState) -> [f64; 3] {
        let bounds = self.bounds(from, right - left);
        [bounds.acceleration, bounds.jerk, self.oscillator.snap(bounds)]
    }

    fn period(&self) -> f64 {
        match self.oscillator.regime() {
            Regime::Oscillating(_) if self.forcing_rate == 0.0 => self.oscillator.longest_piece(),
            _ => f64::INFINITY,
        }
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        match self.integral {
            Some(integral) if time == self.horizon => integral,
            _ => self.oscillator.displacement_integral(self.start, self.forcing_rate, time),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
