//! A piece of motion: one branch of the spring, and where the motion along it turns or crosses a level.
//!
//! The acceleration obeys the free equation, so its zeros are known in closed form. Between them the velocity
//! is monotonic.

use std::f64::consts::PI;

use oscillator::{KinematicState, Oscillator, Regime};

/// Most steps towards a crossing: Illinois takes about ten, bisection of a whole f64 bracket 64.
const MOST_ITERATIONS: usize = 100;

/// Distance to a zero that there is not; finite, because 0 · ∞ is invalid, which some hosts trap \[s\].
const FAR: f64 = f64::MAX;

/// Motion on one branch; displacements count from its start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) oscillator: Oscillator,
    pub(crate) start: KinematicState,
    /// Rate of the load \[m/s³\].
    pub(crate) rate: f64,
}

impl Piece {
    /// Computes the motion after `time` \[s\].
    pub(crate) fn at(&self, time: f64) -> KinematicState {
        self.oscillator.propagate(self.start, self.rate, time)
    }

    /// Computes the motion after `time` \[s\], and the energy c ∫v² dt lost until then, per unit mass
    /// \[m²/s²\].
    ///
    /// It is the work of the load q₀ + q₁ t, less what the motion has gained:
    /// ```text
    /// ∫(q₀ + q₁ t) v dt − Δv²/2 − k y²/2
    /// ```
    pub(crate) fn with_loss(&self, time: f64) -> (KinematicState, f64) {
        let Self { oscillator, start, rate } = *self;
        let (c, k) = (oscillator.damping(), oscillator.stiffness());
        let end = self.at(time);
        if c == 0.0 {
            return (end, 0.0);
        }
        let y = end.displacement;
        // q₀ = ÿ₀ + c v₀
        let load = start.acceleration + c * start.velocity + rate * time;
        let work = load * y - rate * oscillator.displacement_integral(start, rate, time);
        let kinetic = 0.5 * (end.velocity - start.velocity) * (end.velocity + start.velocity);
        // below 0 by rounding at most
        (end, (work - kinetic - 0.5 * k * y * y).max(0.0))
    }

    /// Lists the ends of the spans up to `until` \[s\] in which the velocity is monotonic: zeros of the
    /// acceleration, then `until`.
    pub(crate) fn monotonic_until(&self, until: f64) -> impl Iterator<Item = f64> {
        let (first, every) = self.first_flat();
        let flats = (0_u32..).map(move |n| if n == 0 { first } else { first + f64::from(n) * every });
        flats.take_while(move |&time| time < until).chain(std::iter::once(until))
    }

    /// Finds the first zero of the acceleration after the start, and the distance between zeros; infinite
    /// and [`FAR`] where there is none.
    fn first_flat(&self) -> (f64, f64) {
        let (c, a) = (self.oscillator.damping(), self.start.acceleration);
        let jerk = self.oscillator.jerk(self.start, self.rate);
        let time = match self.oscillator.regime() {
            // a e^{ct/2} = a₀ cos ωt + (ȧ₀ + c a₀/2)/ω sin ωt
            Regime::Oscillating(omega) if omega > 0.0 => {
                let quadrature = (jerk + 0.5 * c * a) / omega;
                if a == 0.0 && quadrature == 0.0 {
                    return (f64::INFINITY, FAR);
                }
                let phase = quadrature.atan2(a) + 0.5 * PI;
                let angle = phase - PI * (phase / PI).floor();
                let angle = if angle > 0.0 { angle } else { PI };
                return (angle / omega, PI / omega);
            }
            Regime::Oscillating(_) => -quotient(a, jerk + 0.5 * c * a),
            // a = A e^{r₁t} + B e^{r₂t} with e^{(r₁ − r₂)t} = −B/A
            Regime::Exponential(slow, fast) => {
                let spread = slow - fast;
                quotient(-spread * a, jerk - fast * a).max(0.0).ln_1p() / spread
            }
        };
        // 0 or less where there is no zero
        (if time > 0.0 { time } else { f64::INFINITY }, FAR)
    }

    /// Finds the time in a bracket from which `height` has the sign that it has at `high`; at `low` it has
    /// the other sign or is zero.
    pub(crate) fn crossing(&self, low: f64, high: f64, height: impl Fn(KinematicState) -> f64) -> f64 {
        let (mut low, mut high) = (low, high);
        let (mut at_low, mut at_high) = (height(self.at(low)), height(self.at(high)));
        let sign = at_high.signum();
        // Illinois: regula falsi that halves the weight of an end that stays, so that it cannot get stuck
        let mut high_moved = None;
        for _ in 0..MOST_ITERATIONS {
            let secant = high - quotient(at_high * (high - low), at_high - at_low);
            let time = if secant > low && secant < high { secant } else { 0.5 * (low + high) };
            if time <= low || time >= high || high - low <= f64::EPSILON * high {
                break;
            }
            let value = height(self.at(time));
            let moves_high = sign * value > 0.0;
            if moves_high {
                (high, at_high) = (time, value);
            } else {
                (low, at_low) = (time, value);
            }
            if high_moved == Some(moves_high) {
                let other = if moves_high { &mut at_low } else { &mut at_high };
                *other *= 0.5;
            }
            high_moved = Some(moves_high);
        }
        high
    }
}

/// Returns a/b; 0 for b = 0, without a division by zero, which some hosts trap.
fn quotient(a: f64, b: f64) -> f64 {
    let (a, b) = if b == 0.0 { (0.0, 1.0) } else { (a, b) };
    a / b
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of the closed forms: K loses up to about 100 ε where k t² is just above the series' range.
    const ROUNDING: f64 = 2e-14;

    const CASES: [(f64, f64); 12] = [
        (0.0, 0.0),
        (0.0, 9.0),
        (0.6, 9.0),
        (6.0, 9.0),
        (6.0 - 1e-9, 9.0),
        (6.0 + 1e-9, 9.0),
        (6.1, 9.0),
        (7.0, 9.0),
        (60.0, 9.0),
        (3.0, 0.0),
        (1e3, 0.0),
        (1e-3, 1e5),
    ];

    fn close(found: f64, wanted: f64, scale: f64) -> bool {
        (found - wanted).abs() <= ROUNDING * scale.max(wanted.abs())
    }

    fn piece(oscillator: Oscillator, [velocity, acceleration]: [f64; 2], rate: f64) -> Piece {
        Piece { oscillator, start: KinematicState { displacement: 0.0, velocity, acceleration }, rate }
    }

    /// Two steps make one: this ties the regimes, the series and the integrals together.
    #[test]
    fn two_steps_make_one() {
        for (c, k) in CASES {
            let oscillator = Oscillator::new(c, k);
            for whole in [1e-5, 1e-2, 0.2, 0.34, 1.0, 3.0] {
                let motion = piece(oscillator, [0.7, -2.0], 11.0);
                let (end, loss) = motion.with_loss(whole);
                let first = 0.37 * whole;
                let (middle, first_loss) = motion.with_loss(first);
                // ÿ = q₀ + q₁ t − c v − k y with q₀ = a₀ + c v₀
                let acceleration =
                    -2.0 + c * 0.7 + 11.0 * first - c * middle.velocity - k * middle.displacement;
                let rest = piece(oscillator, [middle.velocity, acceleration], 11.0);
                let (second, second_loss) = rest.with_loss(whole - first);
                let context = format!("c = {c}, k = {k}, t = {whole}");
                let way = middle.displacement + second.displacement;
                // the size of what is added up: velocities of 1 over the time, up to 11 t³/6
                let size = whole * (1.0 + whole + whole * whole);
                assert!(close(way, end.displacement, 20.0 * size), "{context}: {way} {end:?}");
                // the phase itself is rounded: √k t ε
                let phase = 1.0 + k.sqrt() * whole;
                assert!(
                    close(second.velocity, end.velocity, 20.0 * phase * (1.0 + whole * whole)),
                    "{context}"
                );
                let energy = 20.0 * phase * (1.0 + k * size * size + (1.0 + whole * whole).powi(2));
                assert!(close(first_loss + second_loss, loss, energy), "{context}: {loss}");
            }
        }
    }

    /// ∫v² by Simpson's rule on 2000 intervals: its error is below 1e-10 of the largest here.
    #[test]
    fn the_loss_is_that_of_the_damper() {
        for (c, k) in CASES.into_iter().filter(|(c, k)| *c < 100.0 && *k < 100.0) {
            let oscillator = Oscillator::new(c, k);
            let motion = piece(oscillator, [0.7, -2.0], 1.5);
            let intervals = 2000;
            let step = 1.4 / f64::from(intervals);
            let squares: f64 = (0..=intervals)
                .map(|n| {
                    let weight = if n == 0 || n == intervals { 1.0 } else { f64::from(2 + 2 * (n % 2)) };
                    weight * motion.at(f64::from(n) * step).velocity.powi(2)
                })
                .sum();
            let wanted = c * squares * step / 3.0;
            let (_, loss) = motion.with_loss(1.4);
            assert!((loss - wanted).abs() <= 1e-8 * wanted.max(1.0), "c = {c}, k = {k}: {loss} {wanted}");
        }
    }

    #[test]
    fn the_velocity_turns_only_where_it_is_said_to() {
        for (c, k) in CASES {
            let oscillator = Oscillator::new(c, k);
            for (velocity, acceleration, rate) in
                [(0.7, -2.0, 11.0), (0.0, 1.0, -1.0), (-1.0, 0.0, 2.0), (0.0, 0.0, 1.0), (0.3, 0.4, 0.0)]
            {
                let motion = piece(oscillator, [velocity, acceleration], rate);
                let until = 2.0_f64.min(40.0 / k.sqrt());
                let mut from = 0.0;
                for to in motion.monotonic_until(until) {
                    assert!(to > from && to <= until);
                    let at = |n: u32| motion.at(from + (to - from) * f64::from(n) / 50.0).velocity;
                    let direction = at(50) - at(0);
                    for n in 0..50 {
                        let rise = at(n + 1) - at(n);
                        assert!(rise * direction.signum() >= -1e-13, "c = {c}, k = {k}, {motion:?}: {rise}");
                    }
                    from = to;
                }
                assert_eq!(from, until);
            }
        }
    }
}
