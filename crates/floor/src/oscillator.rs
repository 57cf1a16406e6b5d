//! Closed form of ÿ + c ẏ + k y = q₀ + q₁ t from y = 0.
//!
//! With G the response to a unit impulse, H = ∫G, J = ∫H, K = ∫J, and a₀ = q₀ − c v₀ the acceleration at the start,
//! ```text
//! y(t) = (G + cH) v₀ + H a₀ + J q₁
//! v(t) = (1 − kH) v₀ + G a₀ + H q₁
//! a(t) = −kG v₀ + (1 − cG − kH) a₀ + G q₁
//! ```
//! No particular solution is subtracted: rest stays rest bit for bit, and neither k = 0 nor critical damping is special.
//! The acceleration obeys the free equation, so that its zeros are known in closed form; between them the velocity is monotonic.

use std::f64::consts::PI;

/// G and its integrals.
#[derive(Clone, Copy, Debug)]
struct Green {
    g: f64,
    h: f64,
    j: f64,
    k: f64,
}

/// Damping c \[1/s\] and stiffness k \[1/s²\] per unit mass, neither negative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Oscillator {
    damping: f64,
    stiffness: f64,
    regime: Regime,
}

#[derive(Clone, Copy, Debug)]
enum Regime {
    /// Circular frequency √(k − c²/4), possibly 0.
    Oscillating(f64),
    /// Rates r₁ > r₂ of e^{rt}, neither positive.
    Decaying(f64, f64),
}

/// Terms of the power series: where k t² + c t ≤ 1, the first one left out is below 1/24!.
const TERMS: u32 = 24;

impl Oscillator {
    pub(crate) fn new(damping: f64, stiffness: f64) -> Self {
        let half = 0.5 * damping;
        let discriminant = stiffness - half * half;
        let regime = if discriminant >= 0.0 {
            Regime::Oscillating(discriminant.sqrt())
        } else {
            let fast = -(half + (-discriminant).sqrt());
            // r₁ r₂ = k; the difference of the two terms of r₁ would cancel
            Regime::Decaying(-(stiffness / -fast), fast)
        };
        Self { damping, stiffness, regime }
    }

    fn green(&self, time: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        if k * time * time + c * time <= 1.0 {
            return self.series(time);
        }
        match self.regime {
            Regime::Oscillating(omega) => {
                let decay = (-0.5 * c * time).exp();
                let (sin, cos) = (omega * time).sin_cos();
                let g = if omega == 0.0 { decay * time } else { decay * sin / omega };
                self.integrals(time, g, decay * cos)
            }
            Regime::Decaying(slow, fast) => {
                let (slow, fast) = (slow * time, fast * time);
                let spread = slow - fast;
                if spread < 0.5 {
                    let g = slow.exp() * time * phi(1, -spread);
                    return self.integrals(time, g, 0.5 * (slow.exp() + fast.exp()));
                }
                // ∫…∫G is the divided difference of tⁿ⁺¹ φₙ between the two rates
                let divided = |n| (phi(n, slow) - phi(n, fast)) / spread;
                Green {
                    g: time * divided(0),
                    h: time.powi(2) * divided(1),
                    j: time.powi(3) * divided(2),
                    k: time.powi(4) * divided(3),
                }
            }
        }
    }

    /// H, J, K from G″ + cG′ + kG = 0 integrated once to three times; `even` is G′ + (c/2) G. Only for k t² of order 1.
    fn integrals(&self, time: f64, g: f64, even: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        let h = (1.0 - even - 0.5 * c * g) / k;
        let j = (time - g - c * h) / k;
        Green { g, h, j, k: (0.5 * time * time - h - c * j) / k }
    }

    /// G = t Σ γₙ/(n+1)! with γ₀ = 1, γₙ = −(c t γₙ₋₁ + k t² γₙ₋₂); each integral raises the factorial by one. |γₙ| ≤ 1.
    fn series(&self, time: f64) -> Green {
        let (c, k) = (self.damping * time, self.stiffness * time * time);
        let (mut before, mut term, mut inverse_factorial) = (0.0, 1.0, 1.0);
        let [mut g, mut h, mut j, mut l] = [0.0; 4];
        for n in 0..TERMS {
            let n = f64::from(n);
            inverse_factorial /= n + 1.0;
            let weighted: f64 = term * inverse_factorial;
            g += weighted;
            h += weighted / (n + 2.0);
            j += weighted / ((n + 2.0) * (n + 3.0));
            l += weighted / ((n + 2.0) * (n + 3.0) * (n + 4.0));
            (before, term) = (term, -(c * term + k * before));
        }
        let square = time * time;
        Green { g: time * g, h: square * h, j: square * time * j, k: square * square * l }
    }
}

/// φ₀ = eˣ, φₙ₊₁(x) = (φₙ(x) − 1/n!)/x, for n up to 3 and x not above 0.
fn phi(n: u32, x: f64) -> f64 {
    if x.abs() <= 1.0 {
        // Σ xⁱ/(i + n)!
        let sum = (1..TERMS).rev().fold(1.0, |sum, i| 1.0 + x / f64::from(i + n) * sum);
        return sum / [1.0, 1.0, 2.0, 6.0][n as usize];
    }
    match n {
        0 => x.exp(),
        1 => x.exp_m1() / x,
        2 => (phi(1, x) - 1.0) / x,
        _ => (phi(2, x) - 0.5) / x,
    }
}

/// Where a motion is after some time, relative to its start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// \[m\]
    pub(crate) displacement: f64,
    /// \[m/s\]
    pub(crate) velocity: f64,
}

/// A motion on one branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    pub(crate) oscillator: Oscillator,
    /// Velocity at the start \[m/s\].
    pub(crate) velocity: f64,
    /// Acceleration at the start \[m/s²\].
    pub(crate) acceleration: f64,
    /// Rate of the forcing q₁ \[m/s³\].
    pub(crate) forcing_rate: f64,
}

impl Motion {
    pub(crate) fn at(&self, time: f64) -> Point {
        let Green { g, h, j, .. } = self.oscillator.green(time);
        self.point(g, h, j)
    }

    fn point(&self, g: f64, h: f64, j: f64) -> Point {
        let Oscillator { damping, stiffness, .. } = self.oscillator;
        let Self { velocity, acceleration, forcing_rate, .. } = *self;
        Point {
            displacement: (g + damping * h) * velocity + h * acceleration + j * forcing_rate,
            velocity: (1.0 - stiffness * h) * velocity + g * acceleration + h * forcing_rate,
        }
    }

    /// The point after some time, and the energy c ∫v² dt lost until then, per unit mass \[m²/s²\].
    ///
    /// It is the work of q₀ + q₁ t less what the motion has gained: ∫(q₀ + q₁ t) v dt − Δv²/2 − k y²/2.
    pub(crate) fn with_loss(&self, time: f64) -> (Point, f64) {
        let Oscillator { damping: c, stiffness, .. } = self.oscillator;
        let Self { velocity, acceleration, forcing_rate, .. } = *self;
        let Green { g, h, j, k } = self.oscillator.green(time);
        let point = self.point(g, h, j);
        if c == 0.0 {
            return (point, 0.0);
        }
        let y = point.displacement;
        let y_integral = (h + c * j) * velocity + j * acceleration + k * forcing_rate;
        let push = acceleration + c * velocity + forcing_rate * time;
        let work = push * y - forcing_rate * y_integral;
        let kinetic = 0.5 * (point.velocity - velocity) * (point.velocity + velocity);
        // below 0 by rounding at most
        (point, (work - kinetic - 0.5 * stiffness * y * y).max(0.0))
    }

    /// Ends of the spans, up to `until`, within which the velocity is monotonic: zeros of the acceleration, then `until`.
    pub(crate) fn monotonic_until(&self, until: f64) -> impl Iterator<Item = f64> {
        let (first, every) = self.first_flat();
        let flats = (0_u32..).map(move |n| if n == 0 { first } else { first + f64::from(n) * every });
        flats.take_while(move |&time| time < until).chain(std::iter::once(until))
    }

    /// First zero of the acceleration after the start, and the distance between zeros; infinite where there is none.
    fn first_flat(&self) -> (f64, f64) {
        let Oscillator { damping: c, stiffness: k, regime } = self.oscillator;
        let a = self.acceleration;
        // ȧ at the start
        let jerk = self.forcing_rate - c * a - k * self.velocity;
        let time = match regime {
            // a e^{ct/2} = a₀ cos ωt + (ȧ₀ + c a₀/2)/ω sin ωt
            Regime::Oscillating(omega) if omega > 0.0 => {
                let quadrature = (jerk + 0.5 * c * a) / omega;
                if a == 0.0 && quadrature == 0.0 {
                    return (f64::INFINITY, f64::INFINITY);
                }
                let phase = quadrature.atan2(a) + 0.5 * PI;
                let angle = phase - PI * (phase / PI).floor();
                let angle = if angle > 0.0 { angle } else { PI };
                return (angle / omega, PI / omega);
            }
            Regime::Oscillating(_) => -a / (jerk + 0.5 * c * a),
            // a = A e^{r₁t} + B e^{r₂t} with e^{(r₁ − r₂)t} = −B/A
            Regime::Decaying(slow, fast) => {
                let spread = slow - fast;
                (-spread * a / (jerk - fast * a)).ln_1p() / spread
            }
        };
        // NaN where there is no zero
        (if time > 0.0 { time } else { f64::INFINITY }, f64::INFINITY)
    }

    /// The time in a bracket at which `height` takes the sign that it has at `high`; at `low` it has the other, or is zero.
    pub(crate) fn crossing(&self, low: f64, high: f64, height: impl Fn(Point) -> f64) -> f64 {
        let (mut low, mut high) = (low, high);
        let (mut at_low, mut at_high) = (height(self.at(low)), height(self.at(high)));
        let sign = at_high.signum();
        // Illinois: regula falsi that halves the weight of an end that stays, so that it cannot get stuck
        let mut high_moved = None;
        for _ in 0..MOST_ITERATIONS {
            let secant = high - at_high * (high - low) / (at_high - at_low);
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

/// Illinois takes about ten; bisection of a whole f64 bracket would take 64.
const MOST_ITERATIONS: usize = 100;

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

    #[test]
    fn known_responses() {
        for t in [1e-6_f64, 1e-3, 0.3, 0.9, 1.1, 2.0, 30.0] {
            let free = Oscillator::new(0.0, 0.0).green(t);
            assert!(close(free.g, t, 0.0) && close(free.k, t.powi(4) / 24.0, 0.0));
            let undamped = Oscillator::new(0.0, 9.0).green(t);
            assert!(close(undamped.g, (3.0 * t).sin() / 3.0, 1.0));
            assert!(close(undamped.h, 2.0 * (1.5 * t).sin().powi(2) / 9.0, 1.0), "{t}");
            let critical = Oscillator::new(6.0, 9.0).green(t);
            assert!(close(critical.g, t * (-3.0 * t).exp(), t));
            let dashpot = Oscillator::new(3.0, 0.0).green(t);
            assert!(close(dashpot.g, -(-3.0 * t).exp_m1() / 3.0, 0.0));
            let over = Oscillator::new(10.0, 9.0).green(t);
            assert!(close(over.g, -(-t).exp() * (-8.0 * t).exp_m1() / 8.0, t));
        }
    }

    /// Two steps make one: this ties the regimes, the series and the integrals together.
    #[test]
    fn two_steps_make_one() {
        for (c, k) in CASES {
            let oscillator = Oscillator::new(c, k);
            for whole in [1e-5, 1e-2, 0.2, 0.34, 1.0, 3.0] {
                let motion = Motion { oscillator, velocity: 0.7, acceleration: -2.0, forcing_rate: 11.0 };
                let (end, loss) = motion.with_loss(whole);
                let first = 0.37 * whole;
                let (middle, first_loss) = motion.with_loss(first);
                // ÿ = q₀ + q₁ t − c v − k y with q₀ = a₀ + c v₀
                let acceleration =
                    -2.0 + c * 0.7 + 11.0 * first - c * middle.velocity - k * middle.displacement;
                let rest = Motion { velocity: middle.velocity, acceleration, ..motion };
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
            let motion = Motion { oscillator, velocity: 0.7, acceleration: -2.0, forcing_rate: 1.5 };
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
            for (velocity, acceleration, forcing_rate) in
                [(0.7, -2.0, 11.0), (0.0, 1.0, -1.0), (-1.0, 0.0, 2.0), (0.0, 0.0, 1.0), (0.3, 0.4, 0.0)]
            {
                let motion = Motion { oscillator, velocity, acceleration, forcing_rate };
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
