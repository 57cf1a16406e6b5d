//! Motion as a polynomial in time.

use crate::kinematic_state::KinematicState;

/// Highest power of time in a [`Polynomial`].
pub const HIGHEST_ORDER: usize = 26;

/// Motion as a polynomial in time, u(t) = Σ uₙ tⁿ.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial {
    /// u₀, u₁ … \[m/sⁿ\]; those beyond `order` are not used.
    pub coefficients: [f64; HIGHEST_ORDER + 1],
    /// Highest power in use.
    pub order: usize,
}

impl Polynomial {
    fn used(&self) -> &[f64] {
        &self.coefficients[..=self.order]
    }

    /// Returns the motion at time zero.
    #[inline]
    pub fn start(&self) -> KinematicState {
        let [displacement, velocity, half_acceleration, ..] = self.coefficients;
        KinematicState { displacement, velocity, acceleration: 2.0 * half_acceleration }
    }

    /// Evaluates the motion at a time \[s\].
    #[inline]
    pub fn at(&self, time: f64) -> KinematicState {
        let (mut displacement, mut velocity, mut half_acceleration) = (0.0, 0.0, 0.0);
        for &coefficient in self.used().iter().rev() {
            half_acceleration = half_acceleration * time + velocity;
            velocity = velocity * time + displacement;
            displacement = displacement * time + coefficient;
        }
        KinematicState { displacement, velocity, acceleration: 2.0 * half_acceleration }
    }

    /// Evaluates u and its first four derivatives at a time \[s\].
    #[inline]
    pub fn derivatives(&self, time: f64) -> [f64; 5] {
        let mut terms = [0.0; 5];
        for &coefficient in self.used().iter().rev() {
            for n in (1..5).rev() {
                terms[n] = terms[n] * time + terms[n - 1];
            }
            terms[0] = terms[0] * time + coefficient;
        }
        // n! times the n-th coefficient about that time
        let [u, v, a, jerk, snap] = terms;
        [u, v, 2.0 * a, 6.0 * jerk, 24.0 * snap]
    }

    /// Bounds |ü| \[m/s²\] and the jerk \[m/s³\] up to the time T = `horizon` \[s\]: Σ n(n−1) |uₙ| Tⁿ⁻²
    /// and Σ n(n−1)(n−2) |uₙ| Tⁿ⁻³.
    #[inline]
    pub fn bounds(&self, horizon: f64) -> (f64, f64) {
        let (mut acceleration, mut jerk) = (0.0, 0.0);
        for (n, coefficient) in self.used().iter().enumerate().skip(2).rev() {
            let second = (n * (n - 1)) as f64 * coefficient.abs();
            acceleration = acceleration * horizon + second;
            if n > 2 {
                jerk = jerk * horizon + second * (n - 2) as f64;
            }
        }
        (acceleration, jerk)
    }

    /// Bounds the rate of the jerk \[m/s⁴\] up to the time T = `horizon` \[s\]: Σ n(n−1)(n−2)(n−3) |uₙ|
    /// Tⁿ⁻⁴.
    #[inline]
    pub fn snap(&self, horizon: f64) -> f64 {
        let terms = self.used().iter().enumerate().skip(4).rev();
        terms.fold(0.0, |sum, (n, coefficient)| {
            sum * horizon + (n * (n - 1) * (n - 2) * (n - 3)) as f64 * coefficient.abs()
        })
    }

    /// Integrates u from time zero to `time` \[m s\].
    #[inline]
    pub fn integral(&self, time: f64) -> f64 {
        let mut sum = 0.0;
        for (n, coefficient) in self.used().iter().enumerate().rev() {
            sum = sum * time + coefficient / (n + 1) as f64;
        }
        sum * time
    }
}
