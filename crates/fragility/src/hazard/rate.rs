//! The annual rate of a lognormal fragility over a hazard curve.

use std::f64::consts::{PI, SQRT_2};

use super::curve::HazardCurve;
use crate::normal::cumulative;

/// From here on Mills' ratio comes from its continued fraction: with [`LEVELS`] it is right to a rounding.
const FAR: f64 = 15.0;
const LEVELS: u32 = 16;

/// Annual rate at which a limit state is exceeded \[1/year\], by intensities.
#[derive(Clone, Debug, PartialEq)]
pub struct Rate {
    /// Rate from each segment between two points of the hazard curve.
    pub segments: Vec<f64>,
    /// Rate from below the first point, if λ had the slope of the first segment there. Curves that flatten
    /// towards low intensities have less.
    pub below: f64,
    /// Least and most of the rate from beyond the last point, λₙ Φ(zₙ) and λₙ: whatever the curve does there.
    pub beyond: [f64; 2],
    /// Rate from beyond the last point, if λ had the slope of the last segment there.
    pub beyond_continued: f64,
}

/// Whether a rate keeps to a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AgainstTarget {
    /// Even the most that the rate can be, within the interval of the records, is not above the target.
    Met,
    /// Even the least is above it.
    Missed,
    /// The choice of the records decides, or what lies outside the points of the hazard curve.
    Open,
}

impl HazardCurve {
    /// Returns the annual rate of a lognormal fragility with θ, in the unit of the curve, and β.
    ///
    /// On a segment from a to b, with λ = `λ_a` (x/a)^−k and z = ln(x/θ)/β,
    ///
    /// ```text
    /// λ_a Φ(z_a) − λ_b Φ(z_b) + λ_a (a/θ)^k exp(k²β²/2) [Φ(z_b + kβ) − Φ(z_a + kβ)]
    /// ```
    /// The result is not a number unless θ and β are positive and finite.
    ///
    /// ```
    /// use fragility::hazard::HazardCurve;
    ///
    /// // one power law, from far below θ to far above: k₀ θ^−k exp(k²β²/2)
    /// let power = |x: f64| [x, 1e-4 * x.powf(-2.5)];
    /// let rate = HazardCurve::new(vec![power(1e-4), power(1e4)])?.rate(0.4, 0.45).within();
    /// assert!((rate / 1.860_702_745_8e-3 - 1.0).abs() < 1e-10);
    /// # Ok::<(), fragility::hazard::HazardError>(())
    /// ```
    pub fn rate(&self, theta: f64, beta: f64) -> Rate {
        let theta = if theta > 0.0 && theta.is_finite() && beta.is_finite() { theta } else { f64::NAN };
        let beta = if beta > 0.0 { beta } else { f64::NAN };
        let ends = |&[x, rate]: &[f64; 2]| End { rate, z: libm::log(x / theta) / beta };
        let points = self.points();
        let all: Vec<End> = points.iter().map(ends).collect();
        let slope = |[from, to]: [[f64; 2]; 2]| libm::log(from[1] / to[1]) / libm::log(to[0] / from[0]);
        let segment = |k: usize| part(all[k], all[k + 1], beta * slope([points[k], points[k + 1]]));
        let last = points.len() - 1;
        let (first, end) = (all[0], all[last]);
        let [k_first, k_last] = [[points[0], points[1]], [points[last - 1], points[last]]].map(slope);
        Rate {
            segments: (0..last).map(segment).collect(),
            below: part(End { rate: 0.0, z: f64::NEG_INFINITY }, first, beta * k_first),
            beyond: [end.rate * cumulative(end.z), end.rate + 0.0 * end.z],
            beyond_continued: part(end, End { rate: 0.0, z: f64::INFINITY }, beta * k_last),
        }
    }
}

/// An end of a segment: λ, and z = ln(x/θ)/β.
#[derive(Clone, Copy)]
struct End {
    rate: f64,
    z: f64,
}

/// Returns the rate from a segment, with kβ.
///
/// The last term of the closed form is too large for a number where k is. But `λ_a (a/θ)^k exp(k²β²/2) φ(w)`
/// = λ φ(z) at every x, with w = z + kβ, and so it is a difference of λ φ(z) M(|w|) with Mills' ratio M.
/// Where w changes its sign the factor is at most `λ_a`.
fn part(a: End, b: End, slope: f64) -> f64 {
    let [wa, wb] = [a, b].map(|end| end.z + slope);
    let tail = |end: End, w: f64| if end.rate > 0.0 { end.rate * density(end.z) * mills(w) } else { 0.0 };
    let third = if wa >= 0.0 {
        tail(a, wa) - tail(b, wb)
    } else if wb <= 0.0 {
        tail(b, -wb) - tail(a, -wa)
    } else {
        // both ends of one infinite side have no λ of their own
        let (near, w) = if a.rate > 0.0 { (a, wa) } else { (b, wb) };
        let factor = near.rate * libm::exp(slope * (near.z + 0.5 * slope));
        if w == wa { factor * (1.0 - cumulative(-wb)) - tail(a, -wa) } else { factor - tail(b, wb) }
    };
    let at = |End { rate, z }: End| if rate > 0.0 { rate * cumulative(z) } else { 0.0 };
    // a rounding below 0 where a segment has next to nothing
    let sum = at(a) - at(b) + third;
    if sum < 0.0 { 0.0 } else { sum }
}

/// Returns φ(z).
fn density(z: f64) -> f64 {
    libm::exp(-0.5 * z * z) / libm::sqrt(2.0 * PI)
}

/// Returns Mills' ratio Φ(−w)/φ(w) for w ≥ 0.
fn mills(w: f64) -> f64 {
    if w < FAR {
        return 0.5 * libm::erfc(w / SQRT_2) / density(w);
    }
    1.0 / (1..=LEVELS).rev().fold(w, |below, level| w + f64::from(level) / below)
}

impl Rate {
    /// Returns the rate from the points of the hazard curve, without what lies outside them.
    pub fn within(&self) -> f64 {
        self.segments.iter().sum()
    }

    /// Returns the least of the rate: that from the points, and the least from beyond the last one.
    pub fn least(&self) -> f64 {
        self.within() + self.beyond[0]
    }

    /// Returns the most of the rate: that from the points, from below the first and beyond the last one.
    pub fn most(&self) -> f64 {
        self.within() + self.below + self.beyond[1]
    }

    /// Returns the part of each segment in the rate from the points.
    pub fn shares(&self) -> Vec<f64> {
        let sum = self.within();
        self.segments.iter().map(|part| part / sum).collect()
    }
}

impl AgainstTarget {
    /// Holds the least and the most that a rate can be against a target \[1/year\].
    pub fn of([least, most]: [f64; 2], target: f64) -> Self {
        if most <= target {
            Self::Met
        } else if least > target {
            Self::Missed
        } else {
            Self::Open
        }
    }

    /// Returns the word of tables: `yes`, `no` or `open`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Met => "yes",
            Self::Missed => "no",
            Self::Open => "open",
        }
    }
}

/// Returns the probability of at least one exceedance in some years of a Poisson process, 1 − exp(−λ t).
pub fn probability(rate: f64, years: f64) -> f64 {
    -libm::expm1(-rate * years)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ Φ(z) k λ d ln x by Simpson's rule in 4,000 steps, which are below 0.01 of β and of 1/k: an error of
    /// the fourth power of that over 180, 6e-11.
    fn quadrature([a, b]: [[f64; 2]; 2], theta: f64, beta: f64) -> f64 {
        let (width, k) = ((b[0] / a[0]).ln(), (a[1] / b[1]).ln() / (b[0] / a[0]).ln());
        let step = width / 4000.0;
        let at = |index: i32| {
            let y = step * f64::from(index);
            let weight = [2.0, 4.0][usize::from(index % 2 == 1)];
            let weight = if [0, 4000].contains(&index) { 1.0 } else { weight };
            weight * k * a[1] * (-k * y).exp() * cumulative(((a[0] / theta).ln() + y) / beta)
        };
        (0..=4000).map(at).sum::<f64>() * step / 3.0
    }

    fn italian() -> HazardCurve {
        let years = [(0.05, 30.0), (0.1, 101.0), (0.2, 475.0), (0.4, 2475.0)];
        HazardCurve::new(years.map(|(x, period)| [x, 1.0 / period]).to_vec()).unwrap()
    }

    #[test]
    fn segments_are_those_of_quadrature() {
        let steep = HazardCurve::new(vec![[0.1, 1e-2], [0.11, 1e-4], [0.5, 2e-5], [4.0, 1.9e-5]]).unwrap();
        for curve in [italian(), steep] {
            for (theta, beta) in [(0.4, 0.45), (0.02, 0.3), (0.1, 0.1), (1.5, 0.7), (2.0, 1.5)] {
                let found = curve.rate(theta, beta);
                for (pair, found) in curve.points().windows(2).zip(&found.segments) {
                    let given = quadrature([pair[0], pair[1]], theta, beta);
                    // what is 1e-12 of the rate of the first point is nothing
                    let allowed = 1e-9 * given + 1e-16;
                    assert!((found - given).abs() < allowed, "{theta} {beta} {found} {given}");
                }
            }
        }
    }

    /// Numbers in arithmetic of 40 digits, printed with 12.
    #[test]
    fn the_example_has_its_numbers() {
        let rate = italian().rate(0.4, 0.45);
        let given = [2.795_769_941_38e-6, 8.594_124_532_53e-5, 3.142_512_950_23e-4];
        for (found, given) in rate.segments.iter().zip(given) {
            assert!((found / given - 1.0).abs() < 1e-11, "{found} {given}");
        }
        assert!((rate.beyond_continued / 3.038_573_345_53e-4 - 1.0).abs() < 1e-11);
        // half of the walls stand at θ, the last point
        assert_eq!(rate.beyond, [0.5 / 2475.0, 1.0 / 2475.0]);
        let ends = [rate.least(), rate.most()];
        assert_eq!(AgainstTarget::of(ends, 1e-4), AgainstTarget::Missed);
        assert_eq!(AgainstTarget::of(ends, 7e-4), AgainstTarget::Open);
        assert_eq!(AgainstTarget::of(ends, 9e-4), AgainstTarget::Met);
        assert!((rate.shares().iter().sum::<f64>() - 1.0).abs() < 1e-15);
        assert!((probability(1.860_702_745_8e-3, 50.0) - 0.088_838_516_0).abs() < 1e-10);
    }

    /// A power law cut anywhere, with both slopes continued, is the whole: k₀ θ^−k exp(k²β²/2).
    #[test]
    fn parts_of_a_power_law_add_up() {
        for k in [0.3, 2.5, 9.0] {
            for theta in [0.01, 0.4, 3.0] {
                for beta in [0.1, 0.45, 1.2] {
                    let points = [0.05, 0.3, 1.0].map(|x: f64| [x, 1e-4 * x.powf(-k)]);
                    let rate = HazardCurve::new(points.to_vec()).unwrap().rate(theta, beta);
                    let sum = rate.within() + rate.below + rate.beyond_continued;
                    let given = 1e-4 * theta.powf(-k) * (0.5 * k * k * beta * beta).exp();
                    assert!((sum / given - 1.0).abs() < 1e-10, "{k} {theta} {beta}: {sum} {given}");
                    assert!((rate.beyond[0]..=rate.beyond[1]).contains(&rate.beyond_continued));
                }
            }
        }
    }

    #[test]
    fn steep_segments_and_mills_ratios_are_numbers() {
        // λ falls by 200 powers of ten at 0.2: the rate from there is that at 0.2
        let curve = HazardCurve::new(vec![[0.1, 1e-1], [0.2, 1e-2], [0.2 * (1.0 + 1e-9), 1e-202]]).unwrap();
        let [_, drop] = curve.rate(0.2, 0.4).segments.try_into().unwrap();
        // Φ(z) at 0.2 is ½, and changes by 1e-9 across the segment
        assert!((drop / 0.5e-2 - 1.0).abs() < 2e-9, "{drop}");
        let below = 0.5 * libm::erfc((FAR - 1e-9) / SQRT_2) / density(FAR - 1e-9);
        assert!((mills(FAR) / below - 1.0).abs() < 1e-9);
        assert!(curve.rate(f64::NAN, 0.4).within().is_nan() && curve.rate(0.4, 0.0).most().is_nan());
    }
}
