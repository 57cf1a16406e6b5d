//! Terms of the likelihood of a lognormal curve.

use std::f64::consts::PI;

use super::fit::FitError;
use super::normal::log_and_hazard;
use super::observation::Observation;

/// Runs whose exceedances lie between two intensities.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    /// Logarithms y of the two intensities: equal of an exact one, −∞ and ∞ where one is not known.
    pub(super) between: [f64; 2],
    /// Number of runs.
    pub(super) runs: f64,
}

/// ln L and its derivatives along a and c.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Likelihood {
    /// ln L without its constant.
    pub(super) value: f64,
    /// ∂ ln L/∂a and ∂ ln L/∂c.
    pub(super) gradient: [f64; 2],
    /// −∂² ln L/∂a², −∂² ln L/∂a∂c and −∂² ln L/∂c².
    pub(super) curvature: [f64; 3],
}

/// Abscissae and weights of Gauss and Legendre with four points.
const NODES: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
];
/// Widest interval of z, times 1 + |z|, over which four points integrate φ to 1e-15: their relative error is
/// 6e-10 times the eighth power.
const NARROW: f64 = 0.2;

impl Term {
    /// Returns the terms of an observation.
    pub(super) fn of(observation: &Observation) -> Result<impl Iterator<Item = Self>, FitError> {
        let term = |between: [f64; 2], runs: u32| Self { between: between.map(libm::log), runs: runs.into() };
        let none = term([1.0; 2], 0);
        let (intensity, terms) = match *observation {
            Observation::At(x) => (x, [term([x; 2], 1), none]),
            // a lower level of 0 is below all levels
            Observation::Between([from, to]) if (0.0..=to).contains(&from) => {
                (to, [term([from, to], 1), none])
            }
            Observation::Between(between) => (f64::NAN, [term(between, 0), none]),
            Observation::Above(x) => (x, [term([x, f64::INFINITY], 1), none]),
            Observation::Stripe { intensity, runs, exceeded } => {
                let stand = runs.checked_sub(exceeded).ok_or(FitError::Observation)?;
                let exceeded = term([0.0, intensity], exceeded);
                (intensity, [exceeded, term([intensity, f64::INFINITY], stand)])
            }
        };
        if !(intensity > 0.0 && intensity.is_finite()) {
            return Err(FitError::Observation);
        }
        Ok(terms.into_iter().filter(|term| term.runs > 0.0))
    }

    /// Returns whether the intensity is exact.
    pub(super) fn is_exact(&self) -> bool {
        let [from, to] = self.between;
        from == to
    }

    /// Returns the middle of what is known.
    pub(super) fn middle(&self) -> f64 {
        match self.between {
            [from, to] if from == f64::NEG_INFINITY => to,
            [from, to] if to == f64::INFINITY => from,
            [from, to] => 0.5 * (from + to),
        }
    }

    /// Returns the likelihood at z = a (y − centre) + c.
    fn likelihood(&self, centre: f64, [a, c]: [f64; 2]) -> Likelihood {
        let [from, to] = self.between.map(|y| y - centre);
        let one_sided = |y: f64, sign: f64| {
            let z = a * y + c;
            let (value, h) = log_and_hazard(sign * z);
            let (slope, bend) = (sign * h, h * (h + sign * z));
            Likelihood { value, gradient: [slope * y, slope], curvature: [bend * y * y, bend * y, bend] }
        };
        if from == to {
            let z = a * to + c;
            return Likelihood {
                value: libm::log(a) - 0.5 * z * z,
                gradient: [1.0 / a - z * to, -z],
                curvature: [1.0 / (a * a) + to * to, to, 1.0],
            };
        }
        match (from.is_finite(), to.is_finite()) {
            (false, false) => Likelihood::default(),
            (false, true) => one_sided(to, 1.0),
            (true, false) => one_sided(from, -1.0),
            (true, true) => {
                let [width, z] = [a * (to - from), 0.5 * a * (from + to) + c];
                if width * (1.0 + z.abs()) < NARROW {
                    narrow([0.5 * (from + to), z, width], a)
                } else {
                    wide([from, to], [a, c])
                }
            }
        }
    }
}

/// An interval whose φ has nearly a constant logarithm: the mean of exact terms over it, about its middle.
fn narrow([y, z, width]: [f64; 3], a: f64) -> Likelihood {
    let points = NODES.map(|(node, weight)| {
        let t = 0.5 * width * node;
        (t, 0.5 * weight * libm::exp(-t * (z + 0.5 * t)))
    });
    let mass: f64 = points.iter().map(|(_, weight)| weight).sum();
    let mean = |value: &dyn Fn(f64, f64) -> f64| -> f64 {
        points.iter().map(|(t, weight)| weight * value(y + t / a, z + t)).sum::<f64>() / mass
    };
    let (mean_z, mean_zy) = (mean(&|_, z| z), mean(&|y, z| z * y));
    let [dz, dzy] = [&|_, z| z - mean_z, &|y, z| z * y - mean_zy] as [&dyn Fn(f64, f64) -> f64; 2];
    Likelihood {
        value: libm::log(width * mass) - 0.5 * z * z - 0.5 * libm::log(2.0 * PI),
        gradient: [1.0 / a - mean_zy, -mean_z],
        curvature: [
            1.0 / (a * a) + mean(&|y, z| y * y - dzy(y, z).powi(2)),
            mean(&|y, z| y - dz(y, z) * dzy(y, z)),
            1.0 - mean(&|y, z| dz(y, z).powi(2)),
        ],
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
        let density = libm::exp(-0.5 * zs[k] * zs[k] - 0.5 * libm::log(2.0 * PI) - value);
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
    pub(super) fn of(terms: &[Term], centre: f64, at: [f64; 2]) -> Self {
        let mut all = Self::default();
        for term in terms {
            let one = term.likelihood(centre, at);
            all.value += term.runs * one.value;
            for (sum, part) in all.gradient.iter_mut().zip(one.gradient) {
                *sum += term.runs * part;
            }
            for (sum, part) in all.curvature.iter_mut().zip(one.curvature) {
                *sum += term.runs * part;
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let term = Term { between, runs: 1.0 };
            let at = |da: f64, dc: f64| term.likelihood(0.1, [a + da, c + dc]);
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
