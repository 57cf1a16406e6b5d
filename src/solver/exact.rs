//! Closed form on a branch with constant damping, under a forcing linear in time.
//!
//! ```text
//! ü + c u̇ + f(u) = p₀ + p₁ t,   f linear with slope k
//! ```
//! With G the response to a unit impulse, H = ∫G and J = ∫H, and ü₀ taken from the equation itself,
//! ```text
//! u(t) = u₀ + (G + cH) u̇₀ + H ü₀ + J p₁
//! u̇(t) = (1 − kH) u̇₀ + G ü₀ + H p₁
//! ü(t) = −kG u̇₀ + (1 − cG − kH) ü₀ + G p₁
//! ```
//! There is no particular solution to subtract, so rest stays rest bit for bit and k → 0 is no special case.

use nalgebra::{Matrix3, Vector3};

use super::event::{Kinematics, Peaks, Piece};

/// Impulse response G and its integrals H = ∫G, J = ∫H, K = ∫J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Green {
    pub(super) g: f64,
    pub(super) h: f64,
    pub(super) j: f64,
    pub(super) k: f64,
}

/// ü + c u̇ + k u: what stays the same on a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Oscillator {
    pub(super) damping: f64,
    pub(super) stiffness: f64,
    regime: Regime,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Regime {
    /// Circular frequency √(k − c²/4), possibly 0.
    Oscillating(f64),
    /// Rates r₁ > r₂ of e^{rt}.
    Exponential(f64, f64),
}

/// 1/n! for n = 1, 2, …: for |k| t² + c t ≤ 1 no γₙ exceeds 1, and 1/20! = 4e-19 is the first term left out.
const INVERSE_FACTORIALS: [f64; 22] = {
    let mut inverse = [1.0; 22];
    let mut n = 1;
    while n < 22 {
        inverse[n] = inverse[n - 1] / (n as f64 + 1.0);
        n += 1;
    }
    inverse
};

/// Size below which a term of the series changes no sum: the first terms are 1, 1/2, 1/6 and 1/24.
const NEGLIGIBLE: f64 = 1e-18;

impl Oscillator {
    pub(super) fn new(damping: f64, stiffness: f64) -> Self {
        let half = 0.5 * damping;
        let discriminant = stiffness - half * half;
        let regime = if discriminant >= 0.0 {
            Regime::Oscillating(discriminant.sqrt())
        } else {
            let root = (-discriminant).sqrt();
            // r₁ = −c/2 + √…, of the two the one that cancels comes from r₁ r₂ = k
            let fast = -(half + root);
            Regime::Exponential(stiffness / fast, fast)
        };
        Self { damping, stiffness, regime }
    }

    /// Time over which the closed form neither overflows nor hides an unbounded number of turning points \[s\].
    fn longest_piece(&self) -> f64 {
        match self.regime {
            // a little more than a period; without stiffness and damping there is no limit
            Regime::Oscillating(omega) => 7.0 / omega,
            // a softening branch grows by e²⁰ at most
            Regime::Exponential(slow, _) if slow > 0.0 => 20.0 / slow,
            Regime::Exponential(..) => f64::INFINITY,
        }
    }

    pub(super) fn green(&self, time: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        if k.abs() * time * time + c * time <= 1.0 {
            return self.series(time);
        }
        match self.regime {
            Regime::Oscillating(omega) => {
                let decay = (-0.5 * c * time).exp();
                let (sin, cos) = (omega * time).sin_cos();
                let g = if omega == 0.0 { decay * time } else { decay * sin / omega };
                self.by_stiffness(time, g, decay * cos)
            }
            Regime::Exponential(slow, fast) => {
                let spread = (slow - fast) * time;
                if spread < 0.5 {
                    // near critical damping, where k t² is of order (c t)²/4
                    let (e1, e2) = ((slow * time).exp(), (fast * time).exp());
                    let g = e1 * time * phi1(-spread);
                    return self.by_stiffness(time, g, 0.5 * (e1 + e2));
                }
                let (p, q) = (Phi::new(slow * time), Phi::new(fast * time));
                Green {
                    g: time * (p.exp - q.exp) / spread,
                    h: time * time * (p.one - q.one) / spread,
                    j: time.powi(3) * (p.two - q.two) / spread,
                    k: time.powi(4) * (p.three - q.three) / spread,
                }
            }
        }
    }

    /// H, J and K from G″ + cG′ + kG = 0 integrated once, twice and three times; `even` is G′ + (c/2) G.
    fn by_stiffness(&self, time: f64, g: f64, even: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        let h = (1.0 - even - 0.5 * c * g) / k;
        let j = (time - g - c * h) / k;
        Green { g, h, j, k: (0.5 * time * time - h - c * j) / k }
    }

    /// Power series, for short times: there the closed forms cancel.
    ///
    /// G = t Σ γₙ/(n+1)! with γ₀ = 1, γₙ = −(c t γₙ₋₁ + k t² γₙ₋₂); each integral raises the factorial by one.
    fn series(&self, time: f64) -> Green {
        let (c, k) = (self.damping * time, self.stiffness * time * time);
        let (mut before, mut term) = (0.0_f64, 1.0_f64);
        let mut sums = [0.0; 4];
        for weights in INVERSE_FACTORIALS.windows(4) {
            for (sum, weight) in sums.iter_mut().zip(weights) {
                *sum += term * weight;
            }
            // the next term is no larger than the sum of the last two
            if (term.abs() + before.abs()) * weights[1] < NEGLIGIBLE {
                break;
            }
            (before, term) = (term, -(c * term + k * before));
        }
        let square = time * time;
        Green {
            g: time * sums[0],
            h: square * sums[1],
            j: square * time * sums[2],
            k: square * square * sums[3],
        }
    }

    /// The propagator of one duration: maps (u̇₀, ü₀, p₁) to (u − u₀, u̇, ü).
    pub(super) fn propagator(&self, time: f64) -> Matrix3<f64> {
        let Green { g, h, j, .. } = self.green(time);
        let (c, k) = (self.damping, self.stiffness);
        Matrix3::new(g + c * h, h, j, 1.0 - k * h, g, h, -k * g, 1.0 - c * g - k * h, g)
    }
}

/// φ₁(x) = (eˣ − 1)/x.
fn phi1(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.exp_m1() / x }
}

/// eˣ and φ₁, φ₂, φ₃ with φₙ₊₁(x) = (φₙ(x) − 1/n!)/x.
struct Phi {
    exp: f64,
    one: f64,
    two: f64,
    three: f64,
}

impl Phi {
    fn new(x: f64) -> Self {
        let (exp, one) = (x.exp(), phi1(x));
        if x.abs() > 1.0 {
            let two = (one - 1.0) / x;
            return Self { exp, one, two, three: (two - 0.5) / x };
        }
        // φ₂ = Σ xⁿ/(n+2)!, φ₃ = Σ xⁿ/(n+3)!
        let (mut two, mut three) = (0.0, 0.0);
        for n in (0..18_u32).rev() {
            let n = f64::from(n);
            two = 1.0 + x / (n + 3.0) * two;
            three = 1.0 + x / (n + 4.0) * three;
        }
        Self { exp, one, two: two / 2.0, three: three / 6.0 }
    }
}

/// Motion on a branch in closed form.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosedForm {
    oscillator: Oscillator,
    start: Kinematics,
    /// Rate of the forcing p₁ \[m/s³\].
    forcing_rate: f64,
    horizon: f64,
    /// The motion at the horizon, where it is known already.
    end: Option<Kinematics>,
}

/// The propagator of the last whole step on a branch: steps of one length need it but once.
///
/// Lengths that differ by the rounding of clocks share one: the length is rounded to 40 bits and the rest, 5e-13 of it, is
/// made up by the Taylor series. What is remembered changes no bit of any result.
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

impl ClosedForm {
    /// The motion from `start`, for `remaining` or as long as the closed form is well behaved. `quiet` is the largest |u|
    /// that an oscillation inside the branch may reach without being looked at.
    pub(super) fn new(
        oscillator: Oscillator,
        start: Kinematics,
        forcing_rate: f64,
        remaining: f64,
        quiet: &Quiet,
    ) -> Self {
        let mut piece = Self { oscillator, start, forcing_rate, horizon: remaining, end: None };
        if remaining > oscillator.longest_piece() && !piece.stays_within(quiet) {
            piece.horizon = oscillator.longest_piece();
        }
        piece
    }

    /// The same piece, its end found with the remembered propagator.
    pub(super) fn remembered(mut self, branch: usize, memo: &mut Memo) -> Self {
        let duration = rounded(self.horizon);
        if memo.duration != duration || memo.branch != branch {
            *memo = Memo { branch, duration, propagator: self.oscillator.propagator(duration) };
        }
        let Kinematics { displacement, velocity, acceleration } = self.propagated(&memo.propagator);
        let rest = self.horizon - duration;
        let Oscillator { damping: c, stiffness: k, .. } = self.oscillator;
        // d ü/dt = p₁ − c ü − k u̇
        let jerk = self.forcing_rate - c * acceleration - k * velocity;
        self.end = Some(Kinematics {
            displacement: displacement + rest * velocity,
            velocity: velocity + rest * acceleration,
            acceleration: acceleration + rest * jerk,
        });
        self
    }

    fn propagated(&self, propagator: &Matrix3<f64>) -> Kinematics {
        let Kinematics { displacement, velocity, acceleration } = self.start;
        let change = propagator * Vector3::new(velocity, acceleration, self.forcing_rate);
        Kinematics { displacement: displacement + change[0], velocity: change[1], acceleration: change[2] }
    }

    /// Whether the whole motion stays in the range: around the moving equilibrium by no more than the amplitude.
    fn stays_within(&self, quiet: &Quiet) -> bool {
        let Oscillator { damping: c, stiffness: k, regime } = self.oscillator;
        let Regime::Oscillating(omega) = regime else { return false };
        if k <= 0.0 || omega == 0.0 {
            return false;
        }
        let Kinematics { displacement, velocity, acceleration } = self.start;
        // moving equilibrium: u_p = u₀ + (ü₀ + c (u̇₀ − u̇_p))/k, u̇_p = p₁/k
        let drift = self.forcing_rate / k;
        let swing_rate = velocity - drift;
        let swing = -(acceleration + c * swing_rate) / k;
        let amplitude = swing.hypot((swing_rate + 0.5 * c * swing) / omega);
        let from = displacement - swing;
        let to = from + drift * self.horizon;
        let (highest, lowest) = (from.max(to) + amplitude, from.min(to) - amplitude);
        let rounding = PEAK_ROUNDING * amplitude;
        highest <= quiet.upper
            && lowest >= quiet.lower
            && quiet.peaks.cover(lowest + rounding, highest - rounding)
    }
}

/// Rounding of the amplitude against a peak already seen.
const PEAK_ROUNDING: f64 = 1e-14;

/// Range within which nothing needs to be looked for.
pub(super) struct Quiet {
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) peaks: Peaks,
}

impl Piece for ClosedForm {
    fn start(&self) -> Kinematics {
        self.start
    }

    fn horizon(&self) -> f64 {
        self.horizon
    }

    fn at(&self, time: f64) -> Kinematics {
        match self.end {
            Some(end) if time == self.horizon => end,
            _ => self.propagated(&self.oscillator.propagator(time)),
        }
    }

    fn bounds(&self, from: Kinematics, length: f64) -> (f64, f64) {
        let Oscillator { damping: c, stiffness: k, .. } = self.oscillator;
        let acceleration = from.acceleration.abs();
        // ü obeys the free equation, starting from ü and the jerk p₁ − c ü − k u̇
        let jerk = (self.forcing_rate - c * from.acceleration - k * from.velocity).abs();
        if k > 0.0 {
            // ü² + (d ü/dt)²/k never grows; the sum of the parts bounds its root
            let root = k.sqrt();
            let most = acceleration + jerk / root;
            (most, most * root)
        } else {
            // |ü| ≤ (|ü₀| + |jerk₀| t) cosh(√−k t), and its rate likewise
            let rate = (-k).sqrt();
            let growth = (rate * length).cosh();
            let most = (acceleration + jerk * length) * growth;
            (most, jerk * growth + rate * rate * length * most)
        }
    }

    fn displacement_integral(&self, time: f64) -> f64 {
        let Green { h, j, k, .. } = self.oscillator.green(time);
        let Kinematics { displacement, velocity, acceleration } = self.start;
        // ∫u dt = u₀ t + (H + cJ) u̇₀ + J ü₀ + K p₁
        displacement * time
            + (h + self.oscillator.damping * j) * velocity
            + j * acceleration
            + k * self.forcing_rate
    }
}
