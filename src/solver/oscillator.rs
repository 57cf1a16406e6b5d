//! The linear oscillator of a branch: its impulse response, the integrals of that, and its propagators.
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
//!
//! Where the motion is a sum of two exponentials, e^{r₁t} and e^{r₂t}, products of large G and H would cancel; there
//! α = ü − r₂ u̇ and β = ü − r₁ u̇ obey α̇ = r₁ α + p₁ and β̇ = r₂ β + p₁, each on its own, and
//! ```text
//! u̇ = (α − β)/(r₁ − r₂),   ü = (r₁ α − r₂ β)/(r₁ − r₂)
//! ```

use nalgebra::{Matrix3, Vector3};

use super::event::Kinematics;
use super::polynomial::{HIGHEST_ORDER, Polynomial};

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
    pub(super) regime: Regime,
    /// √|k| and its inverse.
    root: f64,
    inverse_root: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Regime {
    /// Circular frequency √(k − c²/4), possibly 0.
    Oscillating(f64),
    /// Rates r₁ > r₂ of e^{rt}.
    Exponential(f64, f64),
}

/// 1/n! for n = 1, 2, …: for |k| t² + c t ≤ 1 no γₙ exceeds 1, and 1/20! = 4e-19 is the first term left out.
const INVERSE_FACTORIALS: [f64; HIGHEST_ORDER] = {
    let mut inverse = [1.0; HIGHEST_ORDER];
    let mut n = 1;
    while n < HIGHEST_ORDER {
        inverse[n] = inverse[n - 1] / (n as f64 + 1.0);
        n += 1;
    }
    inverse
};

/// Difference of the exponents from which the two modes are followed on their own.
pub(super) const SEPARATE: f64 = 0.5;

/// 1/n for n = 0 (unused), 1, 2, …
const RECIPROCALS: [f64; HIGHEST_ORDER + 1] = {
    let mut reciprocals = [0.0; HIGHEST_ORDER + 1];
    let mut n = 1;
    while n <= HIGHEST_ORDER {
        reciprocals[n] = 1.0 / n as f64;
        n += 1;
    }
    reciprocals
};

/// c t + |k| t² up to which series serve.
const SHORT: f64 = 1.0;

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
        let root = stiffness.abs().sqrt();
        Self { damping, stiffness, regime, root, inverse_root: 1.0 / root }
    }

    /// Time over which the closed form neither overflows nor hides an unbounded number of turning points \[s\].
    pub(super) fn longest_piece(&self) -> f64 {
        match self.regime {
            // a little more than a period; without stiffness and damping there is no limit
            Regime::Oscillating(omega) => 7.0 / omega,
            // a softening branch grows by e³⁶ at most, 1/ε: no displacement lies closer to its equilibrium
            Regime::Exponential(slow, _) if slow > 0.0 => 36.0 / slow,
            Regime::Exponential(..) => f64::INFINITY,
        }
    }

    pub(super) fn green(&self, time: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        if k.abs() * time * time + c * time <= SHORT {
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
                if spread < SEPARATE {
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

    /// The Taylor series of the motion from `start`, for times up to `time`; `None` where it converges too slowly.
    ///
    /// From ü and the jerk on each derivative follows from the two before, u⁽ⁿ⁺²⁾ = −c u⁽ⁿ⁺¹⁾ − k u⁽ⁿ⁾.
    pub(super) fn series_from(&self, start: Kinematics, forcing_rate: f64, time: f64) -> Option<Polynomial> {
        let (c, k) = (self.damping, self.stiffness);
        let reach = k.abs() * time * time + c * time;
        if reach > SHORT {
            return None;
        }
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        let (mut before, mut derivative) =
            (start.acceleration, forcing_rate - c * start.acceleration - k * start.velocity);
        coefficients[0] = start.displacement;
        coefficients[1] = start.velocity;
        coefficients[2] = 0.5 * before;
        coefficients[3] = derivative / 6.0;
        // terms of ü fall at least like those of e^x with x = c t + √|k| t, from the larger of ü and the jerk on
        let ratio = c * time + self.root * time;
        let (mut order, mut size) = (3, ratio);
        while order < HIGHEST_ORDER && size >= NEGLIGIBLE {
            (before, derivative) = (derivative, -(c * derivative + k * before));
            size *= ratio * RECIPROCALS[order - 1];
            order += 1;
            coefficients[order] = derivative * INVERSE_FACTORIALS[order - 1];
        }
        Some(Polynomial { coefficients, order })
    }

    /// [`Self::series_from`] summed at `time` at once.
    pub(super) fn series_at(&self, start: Kinematics, forcing_rate: f64, time: f64) -> Option<Kinematics> {
        let (c, k) = (self.damping, self.stiffness);
        if k.abs() * time * time + c * time > SHORT {
            return None;
        }
        let (mut before, mut derivative) =
            (start.acceleration, forcing_rate - c * start.acceleration - k * start.velocity);
        let (mut du, mut dv, mut da) = (0.5 * before, before, 0.0);
        let ratio = c * time + self.root * time;
        let (mut power, mut size) = (time, ratio);
        for n in 1..HIGHEST_ORDER - 1 {
            let [first, second, third] = [n - 1, n, n + 1].map(|order| INVERSE_FACTORIALS[order]);
            let term = derivative * power;
            da += term * first;
            dv += term * second;
            du += term * third;
            if size < NEGLIGIBLE {
                break;
            }
            (before, derivative) = (derivative, -(c * derivative + k * before));
            power *= time;
            size *= ratio * RECIPROCALS[n + 1];
        }
        Some(Kinematics {
            displacement: start.displacement + time * (start.velocity + time * du),
            velocity: start.velocity + time * dv,
            acceleration: start.acceleration + da,
        })
    }

    /// The motion `time` after `start` under a forcing that changes at the rate `forcing_rate`.
    pub(super) fn propagate(&self, start: Kinematics, forcing_rate: f64, time: f64) -> Kinematics {
        match self.regime {
            Regime::Exponential(slow, fast) if (slow - fast) * time >= SEPARATE => {
                let spread = slow - fast;
                let (p, q) = (Phi::new(slow * time), Phi::new(fast * time));
                let alpha = start.acceleration - fast * start.velocity;
                let beta = start.acceleration - slow * start.velocity;
                // α(t) = α₀ e^{rt} + p₁ t φ₁(rt), and its integral
                let later = |mode: f64, phi: &Phi| mode * phi.exp + forcing_rate * time * phi.one;
                let integral = |mode: f64, phi: &Phi| time * (mode * phi.one + forcing_rate * time * phi.two);
                let (alpha_later, beta_later) = (later(alpha, &p), later(beta, &q));
                Kinematics {
                    displacement: start.displacement + (integral(alpha, &p) - integral(beta, &q)) / spread,
                    velocity: (alpha_later - beta_later) / spread,
                    acceleration: (slow * alpha_later - fast * beta_later) / spread,
                }
            }
            _ => propagated(&self.propagator(time), start, forcing_rate),
        }
    }

    /// d ü/dt = p₁ − c ü − k u̇
    #[inline]
    pub(super) fn jerk(&self, at: Kinematics, forcing_rate: f64) -> f64 {
        forcing_rate - self.damping * at.acceleration - self.stiffness * at.velocity
    }

    /// Bounds on |ü| and on the jerk for `length` seconds after an instant under a forcing that changes at `forcing_rate`.
    #[inline]
    pub(super) fn bounds(&self, from: Kinematics, forcing_rate: f64, length: f64) -> (f64, f64) {
        let (c, k) = (self.damping, self.stiffness);
        let acceleration = from.acceleration.abs();
        // ü obeys the free equation, starting from ü and the jerk p₁ − c ü − k u̇
        let jerk = (forcing_rate - c * from.acceleration - k * from.velocity).abs();
        if k > 0.0 {
            // ü² + (d ü/dt)²/k never grows; the sum of the parts bounds its root
            let most = acceleration + jerk * self.inverse_root;
            (most, most * self.root)
        } else {
            // |ü| ≤ (|ü₀| + |jerk₀| t) cosh(√−k t), and its rate likewise
            let (rate, x) = (self.root, -k * length * length);
            // cosh x − 1 ≤ 0.5431 x² for x ≤ 1
            let growth = if x <= 1.0 { 1.0 + 0.5431 * x } else { x.sqrt().cosh() };
            let most = (acceleration + jerk * length) * growth;
            (most, jerk * growth + rate * rate * length * most)
        }
    }

    /// Whether over `time` the motion is followed by its two modes, not by the propagator.
    pub(super) fn is_spread(&self, time: f64) -> bool {
        matches!(self.regime, Regime::Exponential(slow, fast) if (slow - fast) * time >= SEPARATE)
    }

    /// The propagator of one duration: maps (u̇₀, ü₀, p₁) to (u − u₀, u̇, ü).
    pub(super) fn propagator(&self, time: f64) -> Matrix3<f64> {
        let Green { g, h, j, .. } = self.green(time);
        let (c, k) = (self.damping, self.stiffness);
        Matrix3::new(g + c * h, h, j, 1.0 - k * h, g, h, -k * g, 1.0 - c * g - k * h, g)
    }
}

/// The motion after the duration of a propagator.
pub(super) fn propagated(propagator: &Matrix3<f64>, start: Kinematics, forcing_rate: f64) -> Kinematics {
    let change = propagator * Vector3::new(start.velocity, start.acceleration, forcing_rate);
    Kinematics { displacement: start.displacement + change[0], velocity: change[1], acceleration: change[2] }
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
