//! The oscillator: its Green's functions, series, propagation and bounds.

use crate::green::{Green, Phi, phi1};
use crate::polynomial::{Bounds, HIGHEST_ORDER, KinematicState, Polynomial};

/// A linear oscillator ü + c u̇ + k u = p₀ + p₁ t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    damping: f64,
    stiffness: f64,
    regime: Regime,
    /// √|k| and its inverse.
    root: f64,
    inverse_root: f64,
    longest_piece: f64,
}

/// Form of the free motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Regime {
    /// Up to critical damping: circular frequency √(k − c²/4) \[rad/s\], possibly 0.
    Oscillating(f64),
    /// Beyond it, or with negative stiffness: rates r₁ > r₂ of e^{rt} \[1/s\].
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

/// Difference of the exponents from which the two modes are computed separately.
const SEPARATE: f64 = 0.5;

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

/// Largest c t + |k| t² for which the series are used.
const SHORT: f64 = 1.0;

/// Circular frequency \[rad/s\] below which a motion counts as one without stiffness.
const SLOWEST: f64 = 1e-300;

/// Size below which a term of the series changes no sum: the first terms are 1, 1/2, 1/6 and 1/24.
const NEGLIGIBLE: f64 = 1e-18;

impl Oscillator {
    /// Makes the oscillator with damping c \[1/s\] and stiffness k \[1/s²\], per unit mass and of any sign.
    pub fn new(damping: f64, stiffness: f64) -> Self {
        let half = 0.5 * damping;
        let discriminant = stiffness - half * half;
        // one root for both regimes: compilers may compute two ahead of the branch, and hosts may trap that
        // of a negative number
        let omega = discriminant.abs().sqrt();
        let regime = if discriminant >= 0.0 {
            Regime::Oscillating(omega)
        } else {
            // Of r = −c/2 ± √… the one whose terms cancel follows from r₁ r₂ = k. The other is kept from 0,
            // because compilers may divide before the branch is decided.
            let fast = -(half + omega).max(f64::MIN_POSITIVE);
            Regime::Exponential(stiffness / fast, fast)
        };
        let longest_piece = match regime {
            // a little more than one period; there is no limit without stiffness and damping
            Regime::Oscillating(omega) => 7.0 / omega.max(SLOWEST),
            // a softening branch grows by e³⁶ at most, 1/ε: no displacement lies closer to its equilibrium
            Regime::Exponential(slow, _) if slow > 0.0 => 36.0 / slow.max(SLOWEST),
            Regime::Exponential(..) => f64::INFINITY,
        };
        let root = stiffness.abs().sqrt();
        // without stiffness the inverse is not used; avoid the division by zero, which some hosts trap
        let inverse_root = 1.0 / root.max(f64::MIN_POSITIVE);
        Self { damping, stiffness, regime, root, inverse_root, longest_piece }
    }

    /// Returns damping c \[1/s\].
    #[inline]
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Returns stiffness k \[1/s²\].
    #[inline]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the form of the free motion.
    #[inline]
    pub fn regime(&self) -> Regime {
        self.regime
    }

    /// Returns the time over which the closed form neither overflows nor hides an unbounded number of turning
    /// points \[s\].
    #[inline]
    pub fn longest_piece(&self) -> f64 {
        self.longest_piece
    }

    /// Computes Green's functions after `time` \[s\].
    ///
    /// ```
    /// # use oscillator::Oscillator;
    /// let undamped = Oscillator::new(0.0, 9.0).green(0.7);
    /// assert!((undamped.g - (3.0 * 0.7_f64).sin() / 3.0).abs() < 1e-15);
    /// // a negative stiffness: G = sinh(3 t)/3
    /// let softening = Oscillator::new(0.0, -9.0).green(0.7);
    /// assert!((softening.g - (3.0 * 0.7_f64).sinh() / 3.0).abs() < 1e-14);
    /// ```
    #[inline]
    pub fn green(&self, time: f64) -> Green {
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

    /// Computes H, J and K from G″ + cG′ + kG = 0 integrated once, twice and three times; `even` is G′ +
    /// (c/2) G.
    fn by_stiffness(&self, time: f64, g: f64, even: f64) -> Green {
        let (c, k) = (self.damping, self.stiffness);
        let h = (1.0 - even - 0.5 * c * g) / k;
        let j = (time - g - c * h) / k;
        Green { g, h, j, k: (0.5 * time * time - h - c * j) / k }
    }

    /// Sums Green's functions as power series, for short times: there the closed forms cancel.
    ///
    /// G = t Σ γₙ/(n+1)! with γ₀ = 1, γₙ = −(c t γₙ₋₁ + k t² γₙ₋₂); each integral raises the factorial by
    /// one.
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

    /// Taylor series of the motion from `start` under a load that changes at `rate` \[m/s³\], for times up to
    /// `time` \[s\]; `None` where c t + |k| t² > 1, so that it converges too slowly.
    ///
    /// From ü and the jerk on each derivative follows from the two before, u⁽ⁿ⁺²⁾ = −c u⁽ⁿ⁺¹⁾ − k u⁽ⁿ⁾.
    #[inline]
    pub fn series_from(&self, start: KinematicState, rate: f64, time: f64) -> Option<Polynomial> {
        let (c, k) = (self.damping, self.stiffness);
        let reach = k.abs() * time * time + c * time;
        if reach > SHORT {
            return None;
        }
        let mut coefficients = [0.0; HIGHEST_ORDER + 1];
        let (mut before, mut derivative) = (start.acceleration, self.jerk(start, rate));
        coefficients[0] = start.displacement;
        coefficients[1] = start.velocity;
        coefficients[2] = 0.5 * before;
        coefficients[3] = derivative / 6.0;
        // terms of ü fall at least like those of e^x with x = c t + √|k| t, from the larger of ü and the jerk
        // on
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

    /// Sums [`Self::series_from`] at `time` \[s\] at once.
    #[inline]
    pub fn series_at(&self, start: KinematicState, rate: f64, time: f64) -> Option<KinematicState> {
        let (c, k) = (self.damping, self.stiffness);
        if k.abs() * time * time + c * time > SHORT {
            return None;
        }
        let (mut before, mut derivative) = (start.acceleration, self.jerk(start, rate));
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
        Some(KinematicState {
            displacement: start.displacement + time * (start.velocity + time * du),
            velocity: start.velocity + time * dv,
            acceleration: start.acceleration + da,
        })
    }

    /// Computes the motion `time` \[s\] after `start`, under a load that changes at `rate` \[m/s³\].
    ///
    /// The load itself enters by the acceleration at the start, ü₀ = p₀ − c u̇₀ − k u₀.
    #[inline]
    pub fn propagate(&self, start: KinematicState, rate: f64, time: f64) -> KinematicState {
        match self.regime {
            Regime::Exponential(slow, fast) if self.is_spread(time) => {
                let spread = slow - fast;
                let (p, q) = (Phi::new(slow * time), Phi::new(fast * time));
                let alpha = start.acceleration - fast * start.velocity;
                let beta = start.acceleration - slow * start.velocity;
                // α(t) = α₀ e^{rt} + p₁ t φ₁(rt), and its integral
                let later = |mode: f64, phi: &Phi| mode * phi.exp + rate * time * phi.one;
                let integral = |mode: f64, phi: &Phi| time * (mode * phi.one + rate * time * phi.two);
                let (alpha_later, beta_later) = (later(alpha, &p), later(beta, &q));
                KinematicState {
                    displacement: start.displacement + (integral(alpha, &p) - integral(beta, &q)) / spread,
                    velocity: (alpha_later - beta_later) / spread,
                    acceleration: (slow * alpha_later - fast * beta_later) / spread,
                }
            }
            _ => {
                let rows = self.propagator(time);
                // summed from the left, as a matrix product does
                let [du, velocity, acceleration] =
                    rows.map(|[v, a, p]| v * start.velocity + a * start.acceleration + p * rate);
                KinematicState { displacement: start.displacement + du, velocity, acceleration }
            }
        }
    }

    /// Computes the matrix, row by row, that maps (u̇₀, ü₀, p₁) to (u − u₀, u̇, ü) after `time` \[s\].
    ///
    /// Where [the two modes are spread](Self::is_spread), products with it lose digits to cancellation.
    #[inline]
    pub fn propagator(&self, time: f64) -> [[f64; 3]; 3] {
        let Green { g, h, j, .. } = self.green(time);
        let (c, k) = (self.damping, self.stiffness);
        [[g + c * h, h, j], [1.0 - k * h, g, h], [-k * g, 1.0 - c * g - k * h, g]]
    }

    /// Integrates u over `time` \[s\] from `start` on \[m s\], under a load that changes at `rate` \[m/s³\].
    ///
    /// ```text
    /// ∫u dt = u₀ t + (H + cJ) u̇₀ + J ü₀ + K p₁
    /// ```
    pub fn displacement_integral(&self, start: KinematicState, rate: f64, time: f64) -> f64 {
        let [v, a, p] = self.integral_row(time);
        let KinematicState { displacement, velocity, acceleration } = start;
        displacement * time + v * velocity + a * acceleration + p * rate
    }

    /// Computes the row that maps (u̇₀, ü₀, p₁) to ∫u dt − u₀ t over `time` \[s\].
    pub fn integral_row(&self, time: f64) -> [f64; 3] {
        let Green { h, j, k, .. } = self.green(time);
        [h + self.damping * j, j, k]
    }

    /// Returns whether over `time` \[s\] the two modes differ so much that [`Self::propagate`] computes each
    /// separately.
    #[inline]
    pub fn is_spread(&self, time: f64) -> bool {
        matches!(self.regime, Regime::Exponential(slow, fast) if (slow - fast) * time >= SEPARATE)
    }

    /// Computes the jerk dü/dt = p₁ − c ü − k u̇ \[m/s³\] under a load that changes at `rate` \[m/s³\].
    #[inline]
    pub fn jerk(&self, at: KinematicState, rate: f64) -> f64 {
        rate - self.damping * at.acceleration - self.stiffness * at.velocity
    }

    /// Bounds |ü| \[m/s²\] and the jerk \[m/s³\] for `length` seconds after an instant, under a load
    /// that changes at `rate` \[m/s³\]. Damping must not be negative.
    #[inline]
    pub fn bounds(&self, from: KinematicState, rate: f64, length: f64) -> Bounds {
        let k = self.stiffness;
        let acceleration = from.acceleration.abs();
        // ü obeys the free equation, starting from ü and the jerk
        let jerk = self.jerk(from, rate).abs();
        if k > 0.0 {
            // ü² + (d ü/dt)²/k never grows; the sum of the parts bounds its root
            let most = acceleration + jerk * self.inverse_root;
            Bounds { acceleration: most, jerk: most * self.root }
        } else {
            // |ü| ≤ (|ü₀| + |jerk₀| t) cosh(√−k t), and its rate likewise
            let (growth_rate, x) = (self.root, -k * length * length);
            // cosh x − 1 ≤ 0.5431 x² for x ≤ 1
            let growth = if x <= 1.0 { 1.0 + 0.5431 * x } else { x.sqrt().cosh() };
            let most = (acceleration + jerk * length) * growth;
            let jerk = jerk * growth + growth_rate * growth_rate * length * most;
            Bounds { acceleration: most, jerk }
        }
    }

    /// Bounds the second derivative of ü \[m/s⁴\] where |ü| and the jerk keep within [bounds](Self::bounds):
    /// u⁗ = −c u‴ − k ü.
    #[inline]
    pub fn snap(&self, Bounds { acceleration, jerk }: Bounds) -> f64 {
        self.damping * jerk + self.stiffness.abs() * acceleration
    }
}

#[cfg(test)]
mod tests;
