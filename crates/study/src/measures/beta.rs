//! The incomplete beta function, for probabilities of Student's t.

/// Relative change of the continued fraction at which it ends, and a bound on its terms: their number grows
/// with the square root of the larger parameter.
const SMALL: f64 = 1e-16;
const MOST_TERMS: u32 = 100_000;
/// What stands for a denominator of 0.
const TINY: f64 = 1e-300;

/// Returns the regularised incomplete beta function `I_x(a, b)`, of positive a and b and x from 0 to 1, to
/// about 1e-13 of it where a and b are below 1000.
///
/// Its continued fraction (NIST Digital Library of Mathematical Functions, 8.17.22) by the method of Lentz.
pub(super) fn incomplete_beta(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        // where the fraction converges slowly; I_x(a, b) = 1 − I_1−x(b, a)
        return 1.0 - incomplete_beta(b, a, 1.0 - x);
    }
    let whole = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let front = libm::exp(whole + a * libm::log(x) + b * libm::log1p(-x)) / a;
    let away_from_zero = |value: f64| if value.abs() < TINY { TINY } else { value };
    let (mut fraction, mut c, mut d) = (1.0, 1.0, 0.0);
    for k in 0..MOST_TERMS {
        let m = f64::from(k / 2);
        let term = match k {
            0 => 1.0,
            _ if k % 2 == 0 => m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
            _ => -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0)),
        };
        d = 1.0 / away_from_zero(1.0 + term * d);
        c = away_from_zero(1.0 + term / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < SMALL && k > 0 {
            break;
        }
    }
    front * (fraction - 1.0)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::incomplete_beta;

    /// Closed forms; the logarithms of the gamma function leave some roundings of 1 to 10.
    #[test]
    fn the_incomplete_beta_function_has_its_closed_forms() {
        for x in [1e-9, 0.01, 0.2, 0.5, 0.7, 0.93, 0.999] {
            let line: f64 = 1.0 - x;
            for (a, b, expected) in [
                (1.0, 1.0, x),
                (3.5, 1.0, x.powf(3.5)),
                (1.0, 4.0, 1.0 - line.powi(4)),
                (0.5, 0.5, 2.0 / PI * x.sqrt().asin()),
                (2.0, 2.0, x * x * (3.0 - 2.0 * x)),
            ] {
                let found = incomplete_beta(a, b, x);
                assert!((found - expected).abs() < 1e-13, "I_{x}({a}, {b}) = {found}, {expected}");
            }
        }
        assert_eq!([0.0, 1.0].map(|x| incomplete_beta(2.0, 3.0, x)), [0.0, 1.0]);
    }

    /// Two-sided probabilities of t with ν degrees of freedom, `2*scipy.stats.t.sf(t, nu)`, version 1.17.1.
    #[test]
    fn probabilities_of_t_are_those_of_scipy() {
        for (t, degrees, expected) in [
            (0.1, 1.0, 0.936_548_965_138_893),
            (2.5, 1.0, 0.242_237_883_181_686_82),
            (0.5, 5.0, 0.638_298_871_640_929_1),
            (2.0, 18.0, 0.060_821_465_669_332_435),
            (6.0, 18.0, 1.126_997_110_600_785_5e-5),
            (0.01, 98.0, 0.992_041_616_291_125_5),
            (4.0, 998.0, 6.801_951_030_767_727e-5),
            (1.3, 100_000.0, 0.193_603_965_543_180_13),
            (25.0, 40.0, 4.963_343_444_478_322e-26),
        ] {
            let found = incomplete_beta(0.5 * degrees, 0.5, degrees / (degrees + t * t));
            assert!((found / expected - 1.0).abs() < 1e-9, "t = {t}, {degrees}: {found}, {expected}");
        }
    }
}
