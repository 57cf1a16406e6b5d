//! Terms of the likelihood of a lognormal curve.

use crate::normal::{HALF_LOG_2_PI, log_and_hazard};

/// Runs whose exceedances lie between two intensities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    /// Logarithms y of the two intensities: equal of an exact one, −∞ and ∞ where one is not known.
    pub(crate) between: [f64; 2],
    /// Number of runs.
    pub(crate) runs: f64,
    /// Logarithm of the distance of both y, less ln √(2π); 0 of an exact intensity.
    constant: f64,
}

/// ln L and its derivatives along a and c.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Likelihood {
    /// ln L without its constant.
    pub(crate) value: f64,
    /// ∂ ln L/∂a and ∂ ln L/∂c.
    pub(crate) gradient: [f64; 2],
    /// −∂² ln L/∂a², −∂² ln L/∂a∂c and −∂² ln L/∂c².
    pub(crate) curvature: [f64; 3],
}

/// Widest interval of z, times 1 + |z|, that is taken by its series.
const NARROW: f64 = 0.2;

impl Term {
    /// Creates a term from the logarithms of both intensities.
    pub(crate) fn new([from, to]: [f64; 2], runs: f64) -> Self {
        let width = to - from;
        let is_bracket = width > 0.0 && width.is_finite();
        let constant = if is_bracket { libm::log(width) - HALF_LOG_2_PI } else { 0.0 };
        Self { between: [from, to], runs, constant }
    }

    /// Returns this term for another number of runs.
    pub(crate) fn of_runs(self, runs: f64) -> Self {
        Self { runs, ..self }
    }

    /// Returns whether the intensity is exact.
    pub(crate) fn is_exact(&self) -> bool {
        let [from, to] = self.between;
        from == to
    }

    /// Returns the middle of what is known.
    pub(crate) fn middle(&self) -> f64 {
        match self.between {
            [from, to] if from == f64::NEG_INFINITY => to,
            [from, to] if to == f64::INFINITY => from,
            [from, to] => 0.5 * (from + to),
        }
    }

    /// Returns the distance of both logarithms; 0 where one is not known.
    pub(crate) fn width(&self) -> f64 {
        if self.is_bounded() { self.between[1] - self.between[0] } else { 0.0 }
    }

    /// Returns whether both intensities are known.
    pub(crate) fn is_bounded(&self) -> bool {
        self.between.iter().all(|y| y.is_finite())
    }

    /// Returns the likelihood at z = a (y − centre) + c, with β = 1/a; of exact intensities and narrow
    /// intervals without ln a, and whether it is that of one of these.
    #[inline]
    fn likelihood(&self, centre: f64, [a, c]: [f64; 2], beta: f64) -> (Likelihood, bool) {
        let [from, to] = [self.between[0] - centre, self.between[1] - centre];
        let one_sided = |y: f64, sign: f64| {
            let z = a * y + c;
            let (value, h) = log_and_hazard(sign * z);
            let (slope, bend) = (sign * h, h * (h + sign * z));
            Likelihood { value, gradient: [slope * y, slope], curvature: [bend * y * y, bend * y, bend] }
        };
        match (from.is_finite(), to.is_finite()) {
            (false, false) => (Likelihood::default(), false),
            (false, true) => (one_sided(to, 1.0), false),
            (true, false) => (one_sided(from, -1.0), false),
            (true, true) => {
                let y = 0.5 * (from + to);
                let [z, width] = [a * y + c, a * (to - from)];
                if width * (1.0 + z.abs()) < NARROW {
                    let mut one = narrow([y, z, width], beta);
                    one.value += self.constant;
                    (one, true)
                } else {
                    (wide([from, to], [a, c]), false)
                }
            }
        }
    }
}

/// Factors of the powers of w in the series of a narrow interval.
const P: [f64; 4] = [1.0 / 24.0, 1.0 / 2880.0, 1.0 / 181_440.0, 1.0 / 29_030_400.0];

/// An interval of `width` w around z, at y, by the cumulants of a uniform distribution; an exact intensity
/// has w = 0:
///
/// ```text
/// ln ∫ φ(z + t) dt = ln(w φ(z)) + w² (z² − 1)/24 − w⁴ (z⁴ + 4 z² − 2)/2880
///                    + w⁶ (z⁶ + 6 z⁴ + 3 z² − 1)/181440
///                    − w⁸ (3 z⁸ + 24 z⁶ + 36 z⁴ − 8 z² + 2)/29030400 + …     from t = −w/2 to w/2
/// ```
/// For w (1 + |z|) < 0.2 the next term is below 3e-16, and 2e-15 in w times the slope along w. Without ln w
/// and ln √(2π). The curvature is that of the first two, to 1e-8 of it: it leads Newton's steps, and has no
/// part in where they end.
#[inline]
fn narrow([y, z, width]: [f64; 3], beta: f64) -> Likelihood {
    let (s, w) = (z * z, width * width);
    // the factors of w², w⁴, w⁶ and w⁸, and their derivatives along z²
    let q = [
        P[0] * (s - 1.0),
        P[1] * (2.0 - s * (4.0 + s)),
        P[2] * (s * (3.0 + s * (6.0 + s)) - 1.0),
        P[3] * (s * (8.0 - s * (36.0 + s * (24.0 + 3.0 * s))) - 2.0),
    ];
    let dq = [
        P[0],
        -P[1] * (4.0 + 2.0 * s),
        P[2] * (3.0 + s * (12.0 + 3.0 * s)),
        P[3] * (8.0 - s * (72.0 + s * (72.0 + 12.0 * s))),
    ];
    // derivatives along z; along w they are multiplied by w
    let value = w * (q[0] + w * (q[1] + w * (q[2] + w * q[3])));
    let along_z = 2.0 * z * w * (dq[0] + w * (dq[1] + w * (dq[2] + w * dq[3])));
    let along_w = w * (2.0 * q[0] + w * (4.0 * q[1] + w * (6.0 * q[2] + w * 8.0 * q[3])));
    let zz = w * (2.0 * dq[0] + w * (2.0 * dq[1] - 8.0 * P[1] * s));
    let zw = 2.0 * z * w * (2.0 * dq[0] + w * 4.0 * dq[1]);
    let ww = w * (2.0 * q[0] + w * 12.0 * q[1]);
    let slope = along_z - z;
    let (bend, mixed) = (1.0 - zz, zw * beta);
    Likelihood {
        value: value - 0.5 * s,
        gradient: [slope * y + along_w * beta, slope],
        curvature: [(bend * y - 2.0 * mixed) * y - ww * beta * beta, bend * y - mixed, bend],
    }
}

/// An interval by ln(Φ(z₂) − Φ(z₁)), taken in the tail where Φ is small.
fn wide(ys: [f64; 2], [a, c]: [f64; 2]) -> Likelihood {
    let zs = ys.map(|y| a * y + c);
    let [low, high] = if zs[0] + zs[1] > 0.0 { [-zs[1], -zs[0]] } else { zs };
    let (upper, _) = log_and_hazard(high);
    let (lower, _) = log_and_hazard(low);
    let value = upper + libm::log(-libm::expm1(lower - upper));
    // φ(zᵢ)/(Φ(z₂) − Φ(z₁)), of the lower end with a minus
    let p = [0, 1].map(|k| {
        let density = libm::exp(-0.5 * zs[k] * zs[k] - HALF_LOG_2_PI - value);
        if k == 0 { -density } else { density }
    });
    let sum = |power: i32, times_z: bool| -> f64 {
        (0..2).map(|k| p[k] * ys[k].powi(power) * if times_z { zs[k] } else { 1.0 }).sum()
    };
    let gradient = [sum(1, false), sum(0, false)];
    let [ga, gc] = gradient;
    let curvature = [sum(2, true) + ga * ga, sum(1, true) + ga * gc, sum(0, true) + gc * gc];
    Likelihood { value, gradient, curvature }
}

impl Likelihood {
    /// Returns the likelihood of terms at z = a (y − centre) + c.
    pub(crate) fn of(terms: &[Term], centre: f64, at: [f64; 2]) -> Self {
        let mut all = Self::default();
        // runs of which the likelihood is a density, with a factor a
        let (mut dense, a, beta) = (0.0, at[0], 1.0 / at[0]);
        for term in terms {
            let (one, is_dense) = term.likelihood(centre, at, beta);
            dense += if is_dense { term.runs } else { 0.0 };
            all.value += term.runs * one.value;
            for (sum, part) in all.gradient.iter_mut().zip(one.gradient) {
                *sum += term.runs * part;
            }
            for (sum, part) in all.curvature.iter_mut().zip(one.curvature) {
                *sum += term.runs * part;
            }
        }
        all.value += dense * libm::log(a);
        all.gradient[0] += dense * beta;
        all.curvature[0] += dense * beta * beta;
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Just below w (1 + |z|) = 0.2 the series has the value of the interval itself, to roundings of ln Φ.
    #[test]
    fn a_narrow_interval_is_the_limit_of_wide_ones() {
        for z in [-6.0, -1.5, 0.0, 0.4, 3.0] {
            let width = 0.199 / (1.0 + f64::abs(z));
            let [from, to] = [z - 0.5 * width, z + 0.5 * width];
            let term = Term::new([from, to], 1.0);
            let (short, is_narrow) = term.likelihood(0.0, [1.0, 0.0], 1.0);
            let long = wide([from, to], [1.0, 0.0]);
            assert!(is_narrow);
            let allowed = 1e-12 * (1.0 + long.value.abs());
            assert!((short.value - long.value).abs() < allowed, "{z}: {} {}", short.value, long.value);
        }
    }

    /// Derivatives by central differences of 1e-4: an error of 1e-8 of the third ones.
    #[test]
    fn derivatives_are_those_of_the_value() {
        for (between, [a, c]) in [
            ([0.2, 0.2], [2.0, -0.3]),
            ([-0.1, 0.5], [2.5, 0.4]),
            ([-0.1, -0.07], [2.5, 0.4]),
            ([1.5, 1.502], [3.0, 1.0]),
            ([2.0, 3.0], [4.0, 1.0]),
            ([-3.0, -2.0], [4.0, 1.0]),
            ([f64::NEG_INFINITY, 0.3], [2.0, 0.1]),
            ([0.3, f64::INFINITY], [2.0, 0.1]),
        ] {
            let term = Term::new(between, 1.0);
            let at = |da: f64, dc: f64| Likelihood::of(&[term], 0.1, [a + da, c + dc]);
            let h = 1e-4;
            let (one, ra, rc) = (at(0.0, 0.0), [at(h, 0.0), at(-h, 0.0)], [at(0.0, h), at(0.0, -h)]);
            let slope = |pair: &[Likelihood; 2], of: &dyn Fn(&Likelihood) -> f64| {
                (of(&pair[0]) - of(&pair[1])) / (2.0 * h)
            };
            let found = [
                slope(&ra, &|l| l.value),
                slope(&rc, &|l| l.value),
                -slope(&ra, &|l| l.gradient[0]),
                -slope(&rc, &|l| l.gradient[0]),
                -slope(&rc, &|l| l.gradient[1]),
            ];
            let stated = [one.gradient.as_slice(), one.curvature.as_slice()].concat();
            for (found, stated) in found.iter().zip(stated) {
                assert!((found - stated).abs() < 1e-6 * (1.0 + stated.abs()), "{between:?} {found} {stated}");
            }
        }
    }
}
