//! Standard normal distribution.

use std::f64::consts::{PI, SQRT_2};

/// Below this ln Φ comes from its asymptotic series, since Φ itself underflows at −38.
const ASYMPTOTIC: f64 = -20.0;
/// Above this 1 − Φ is below half a rounding of 1.
const NEAR_ONE: f64 = 8.5;

/// Returns Φ(z).
pub fn cumulative(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// Returns ln Φ(z) and its derivative φ(z)/Φ(z).
pub(super) fn log_and_hazard(z: f64) -> (f64, f64) {
    if z > NEAR_ONE {
        return (0.0, 0.0);
    }
    let log = if z > ASYMPTOTIC {
        libm::log(cumulative(z))
    } else {
        // 1 − 1/z² + 3/z⁴ − 15/z⁶: the next term is 105/z⁸, 4e-9 at z = −20
        let s = 1.0 / (z * z);
        -0.5 * z * z - libm::log(-z * libm::sqrt(2.0 * PI))
            + libm::log1p(-s * (1.0 - 3.0 * s * (1.0 - 5.0 * s)))
    };
    (log, libm::exp(-0.5 * z * z - 0.5 * libm::log(2.0 * PI) - log))
}
