//! Motion as a polynomial in time.

use super::event::Kinematics;

/// Highest power of time.
pub(super) const HIGHEST_ORDER: usize = 26;

/// u(t) = Σ uₙ tⁿ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial {
    pub(super) coefficients: [f64; HIGHEST_ORDER + 1],
    pub(super) order: usize,
}

impl Polynomial {
    fn used(&self) -> &[f64] {
        &self.coefficients[..=self.order]
    }

    pub(super) fn start(&self) -> Kinematics {
        let [displacement, velocity, half_acceleration, ..] = self.coefficients;
        Kinematics { displacement, velocity, acceleration: 2.0 * half_acceleration }
    }

    pub(super) fn at(&self, time: f64) -> Kinematics {
        let (mut displacement, mut velocity, mut half_acceleration) = (0.0, 0.0, 0.0);
        for &coefficient in self.used().iter().rev() {
            half_acceleration = half_acceleration * time + velocity;
            velocity = velocity * time + displacement;
            displacement = displacement * time + coefficient;
        }
        Kinematics { displacement, velocity, acceleration: 2.0 * half_acceleration }
    }

    /// Bounds on |ü| and on the jerk up to `horizon`: Σ n(n−1) |uₙ| Tⁿ⁻² and Σ n(n−1)(n−2) |uₙ| Tⁿ⁻³.
    pub(super) fn bounds(&self, horizon: f64) -> (f64, f64) {
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

    /// Bound on the rate of the jerk up to `horizon`: Σ n(n−1)(n−2)(n−3) |uₙ| Tⁿ⁻⁴.
    pub(super) fn snap(&self, horizon: f64) -> f64 {
        let terms = self.used().iter().enumerate().skip(4).rev();
        terms.fold(0.0, |sum, (n, coefficient)| {
            sum * horizon + (n * (n - 1) * (n - 2) * (n - 3)) as f64 * coefficient.abs()
        })
    }

    /// ∫u dt from 0.
    pub(super) fn integral(&self, time: f64) -> f64 {
        let mut sum = 0.0;
        for (n, coefficient) in self.used().iter().enumerate().rev() {
            sum = sum * time + coefficient / (n + 1) as f64;
        }
        sum * time
    }
}
