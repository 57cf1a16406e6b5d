//! A motion at one time, and as a polynomial in time.

/// Highest power of time in a [`Polynomial`].
pub const HIGHEST_ORDER: usize = 26;

/// Displacement, velocity and acceleration at one instant \[m, m/s, m/s²\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinematicState {
    /// u \[m\].
    pub displacement: f64,
    /// u̇ \[m/s\].
    pub velocity: f64,
    /// ü \[m/s²\].
    pub acceleration: f64,
}

/// Bounds on a motion over a length of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// On |ü| \[m/s²\].
    pub acceleration: f64,
    /// On the jerk \[m/s³\].
    pub jerk: f64,
}

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
        // two terms at a time, p = q t² + c₁ t + c₀ and its derivatives: the chain of operations that wait
        // for each other is half as long
        let (pairs, last) = self.used().as_chunks::<2>();
        let (square, double) = (time * time, 2.0 * time);
        let (mut velocity, mut half_acceleration) = (0.0, 0.0);
        let mut displacement = last.first().copied().unwrap_or(0.0);
        for &[even, odd] in pairs.iter().rev() {
            half_acceleration = half_acceleration * square + (double * velocity + displacement);
            velocity = velocity * square + (double * displacement + odd);
            displacement = displacement * square + (odd * time + even);
        }
        KinematicState { displacement, velocity, acceleration: 2.0 * half_acceleration }
    }

    /// Bounds |ü| \[m/s²\] and the jerk \[m/s³\] up to the time T = `horizon` \[s\]: Σ n(n−1) |uₙ| Tⁿ⁻²
    /// and Σ n(n−1)(n−2) |uₙ| Tⁿ⁻³.
    #[inline]
    pub fn bounds(&self, horizon: f64) -> Bounds {
        let (mut acceleration, mut jerk) = (0.0, 0.0);
        for (n, coefficient) in self.used().iter().enumerate().skip(2).rev() {
            let second = (n * (n - 1)) as f64 * coefficient.abs();
            acceleration = acceleration * horizon + second;
            if n > 2 {
                jerk = jerk * horizon + second * (n - 2) as f64;
            }
        }
        Bounds { acceleration, jerk }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Σ n (n − 1) … (n − d + 1) |uₙ| tⁿ⁻ᵈ, term by term.
    fn term_by_term(coefficients: &[f64], derivative: i32, time: f64) -> f64 {
        let term = |(n, u): (i32, &f64)| {
            let factor: f64 = (0..derivative).map(|step| f64::from(n - step)).product();
            if n < derivative { 0.0 } else { factor * u * time.powi(n - derivative) }
        };
        (0..).zip(coefficients).map(term).sum()
    }

    /// Terms beyond the order in use do not count. Ten operations round to 1e-14 of positive sums.
    #[test]
    fn values_and_bounds_are_sums_of_terms() {
        let used = [0.3, 1.1, 0.7, 2.3, 0.4, 1.9, 0.6];
        let mut coefficients = [1e6; HIGHEST_ORDER + 1];
        coefficients[..used.len()].copy_from_slice(&used);
        let motion = Polynomial { coefficients, order: used.len() - 1 };
        let time = 0.83;
        let near =
            |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-14, "{found} for {wanted}");
        let wanted = [0, 1, 2, 3, 4].map(|derivative| term_by_term(&used, derivative, time));
        let at = motion.at(time);
        for (found, wanted) in [at.displacement, at.velocity, at.acceleration].into_iter().zip(wanted) {
            near(found, wanted);
        }
        let start = motion.start();
        assert_eq!([start.displacement, start.velocity, start.acceleration], [0.3, 1.1, 1.4]);
        let integral: f64 = (1..).zip(used).map(|(n, u)| u * time.powi(n) / f64::from(n)).sum();
        near(motion.integral(time), integral);
        // signs do not count in a bound
        let mut signed = motion;
        signed.coefficients.iter_mut().skip(1).step_by(2).for_each(|u| *u = -*u);
        for bounded in [motion, signed] {
            let Bounds { acceleration, jerk } = bounded.bounds(time);
            near(acceleration, wanted[2]);
            near(jerk, wanted[3]);
            near(bounded.snap(time), wanted[4]);
        }
    }
}
