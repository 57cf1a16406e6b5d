//! Regressions of groups of points from their sums of squares and products: points need not be kept.
//!
//! ```text
//! y = a_g + b x + r        a_g of each group, b of all        residuals r
//! r = c₀ + c z + s         z a feature of the point           p of c = 0 by Student's t
//! ```
//! With one group this is the usual regression. Sums are taken about the means of each group. Points have
//! weights: the sums of squares and products are those of weighted least squares, with weights of the mean 1.

use super::beta::incomplete_beta;

/// Spread, relative to the sizes of the numbers, that is no more than rounding.
const ROUNDING: f64 = 1e-9;

/// A point: of a regression x and y, and the features that may explain what the regression leaves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point<'a> {
    pub(super) x: f64,
    pub(super) y: f64,
    /// Weight of its record.
    pub(super) weight: f64,
    pub(super) features: &'a [f64],
}

/// Sums over groups of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Moments {
    points: usize,
    groups: usize,
    /// Sum of the weights of the points.
    weight: f64,
    /// Means of x and y of the group, where there is one.
    means: [f64; 2],
    xx: f64,
    xy: f64,
    yy: f64,
    features: Vec<FeatureMoments>,
}

/// Sums of a feature.
#[derive(Clone, Debug, PartialEq)]
struct FeatureMoments {
    /// Mean of all points.
    mean: f64,
    /// Sum of squares about that mean.
    zz: f64,
    /// Sums of products about the means of each group.
    zx: f64,
    zy: f64,
}

/// What a regression finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Number of points.
    pub points: usize,
    /// a, of one group.
    pub intercept: Option<f64>,
    /// b.
    pub slope: Option<f64>,
    /// Standard deviation of the residuals, with the degrees of freedom that the parameters leave.
    pub deviation: Option<f64>,
    /// For each feature, the probability of a slope as steep as that of the residuals over it, or steeper,
    /// where it has no effect: two-sided, by Student's t with two degrees of freedom less than points.
    pub p_values: Vec<Option<f64>>,
}

impl Moments {
    /// Takes one group.
    pub(super) fn of(points: &[Point<'_>]) -> Self {
        let Some(first) = points.first() else { return Self::default() };
        let sum =
            |of: &dyn Fn(&Point<'_>) -> f64| points.iter().map(|point| point.weight * of(point)).sum::<f64>();
        let weight = sum(&|_| 1.0);
        let mean = |of: &dyn Fn(&Point<'_>) -> f64| sum(of) / weight;
        let means = [mean(&|point| point.x), mean(&|point| point.y)];
        let [x, y] = [|point: &Point<'_>| point.x, |point: &Point<'_>| point.y];
        let (dx, dy) = (|point: &Point<'_>| x(point) - means[0], |point: &Point<'_>| y(point) - means[1]);
        let feature = |place: usize| {
            let mean = mean(&|point| point.features[place]);
            let dz = |point: &Point<'_>| point.features[place] - mean;
            FeatureMoments {
                mean,
                zz: sum(&|point| dz(point) * dz(point)),
                zx: sum(&|point| dz(point) * dx(point)),
                zy: sum(&|point| dz(point) * dy(point)),
            }
        };
        Self {
            points: points.len(),
            groups: 1,
            weight,
            means,
            xx: sum(&|point| dx(point) * dx(point)),
            xy: sum(&|point| dx(point) * dy(point)),
            yy: sum(&|point| dy(point) * dy(point)),
            features: (0..first.features.len()).map(feature).collect(),
        }
    }

    /// Adds other groups.
    pub(super) fn add(&mut self, other: &Self) {
        if self.groups == 0 || other.groups == 0 {
            if self.groups == 0 {
                self.clone_from(other);
            }
            return;
        }
        let [own, others] = [self.weight, other.weight];
        for (feature, more) in self.features.iter_mut().zip(&other.features) {
            // Chan, Golub, LeVeque 1983
            let apart = more.mean - feature.mean;
            feature.zz += more.zz + apart * apart * own * others / (own + others);
            feature.mean += apart * others / (own + others);
            feature.zx += more.zx;
            feature.zy += more.zy;
        }
        self.points += other.points;
        self.weight += other.weight;
        self.groups += other.groups;
        self.xx += other.xx;
        self.xy += other.xy;
        self.yy += other.yy;
    }

    /// Fits a of each group and b.
    pub(super) fn line(&self) -> Fit {
        let is_spread = self.xx.sqrt() > ROUNDING * (self.points as f64).sqrt();
        if !is_spread {
            return Fit { slope: None, intercept: None, ..self.fit(0.0, usize::MAX) };
        }
        let slope = self.xy / self.xx;
        let intercept = (self.groups == 1).then(|| self.means[1] - slope * self.means[0]);
        Fit { slope: Some(slope), intercept, ..self.fit(slope, 1) }
    }

    /// Fits a of each group, without x.
    pub(super) fn level(&self) -> Fit {
        self.fit(0.0, 0)
    }

    /// Takes the residuals about lines of a slope, which has so many parameters beside the a of each group.
    fn fit(&self, slope: f64, parameters: usize) -> Fit {
        let rest = (self.yy - slope * self.xy).max(0.0);
        let freedom = self.points.checked_sub(self.groups).and_then(|left| left.checked_sub(parameters));
        let freedom = freedom.filter(|freedom| *freedom > 0);
        let p_value = |feature: &FeatureMoments| {
            freedom.filter(|_| rest.sqrt() > ROUNDING * self.yy.sqrt())?;
            feature.p_value(self.points, slope, rest)
        };
        Fit {
            points: self.points,
            intercept: None,
            slope: None,
            // weights of any sum count as if it were the number of points
            deviation: freedom
                .map(|freedom| (rest * (self.points as f64 / self.weight) / freedom as f64).sqrt()),
            p_values: self.features.iter().map(p_value).collect(),
        }
    }
}

impl FeatureMoments {
    /// Returns the p-value of the slope of residuals over the feature, by the sum of their squares. `None` of
    /// two points, and of a feature that is the same in all.
    fn p_value(&self, points: usize, slope: f64, rest: f64) -> Option<f64> {
        let freedom = points.checked_sub(2).filter(|freedom| *freedom > 0)? as f64;
        if self.zz.sqrt() <= ROUNDING * (points as f64).sqrt() * self.mean.abs() {
            return None;
        }
        // t² = ν r²/(1 − r²), so that ν/(ν + t²) = 1 − r²
        let covariance = self.zy - slope * self.zx;
        let explained = covariance * covariance / (self.zz * rest);
        Some(incomplete_beta(0.5 * freedom, 0.5, 1.0 - explained.min(1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::{Moments, Point};

    /// x, y, z of two groups.
    const FIRST: [[f64; 3]; 7] = [
        [0.1, 0.32, 5.0],
        [0.4, 0.81, 11.5],
        [0.9, 1.1, 8.0],
        [1.3, 2.02, 21.0],
        [1.7, 2.0, 14.0],
        [2.2, 3.1, 9.5],
        [2.6, 3.05, 17.0],
    ];
    const SECOND: [[f64; 3]; 5] =
        [[0.2, 1.5, 30.0], [0.8, 2.6, 12.0], [1.1, 2.4, 7.0], [1.9, 3.9, 19.0], [2.5, 4.0, 25.0]];

    fn moments(points: &[[f64; 3]]) -> Moments {
        let points: Vec<_> = points
            .iter()
            .map(|[x, y, z]| Point { x: *x, y: *y, weight: 1.0, features: std::slice::from_ref(z) })
            .collect();
        Moments::of(&points)
    }

    fn near(found: Option<f64>, expected: f64) {
        assert!((found.unwrap() / expected - 1.0).abs() < 1e-9, "{found:?}, {expected}");
    }

    /// `scipy.stats.linregress(x, y)`, version 1.17.1, then of its residuals over z; s is the root of the sum
    /// of squares over n − 2. Without x, y less its mean over z, and `numpy.std(y, ddof=1)`.
    #[test]
    fn one_group_is_the_regression_of_scipy() {
        let line = moments(&FIRST).line();
        near(line.slope, 1.149_210_822_998_872_7);
        near(line.intercept, 0.261_037_204_058_623_96);
        near(line.deviation, 0.245_640_730_861_962_61);
        near(line.p_values[0], 0.703_215_155_892_392);
        let level = moments(&FIRST).level();
        near(level.deviation, 1.079_790_544_062_883_9);
        near(level.p_values[0], 0.214_268_602_253_479_6);
        assert_eq!((level.slope, level.intercept, level.points), (None, None, 7));
    }

    /// Groups with an a of their own: `numpy.linalg.lstsq` with an indicator of each group and x, s with
    /// n − 3 degrees of freedom; `scipy.stats.linregress` of the residuals over z.
    #[test]
    fn groups_share_a_slope() {
        let mut both = Moments::default();
        both.add(&moments(&FIRST));
        both.add(&Moments::default());
        both.add(&moments(&SECOND));
        let line = both.line();
        near(line.slope, 1.139_364_970_979_856_1);
        near(line.deviation, 0.266_667_392_169_264_55);
        near(line.p_values[0], 0.949_837_617_989_001_9);
        assert_eq!((line.intercept, line.points), (None, 12));
        let level = both.level();
        near(level.deviation, 1.072_552_363_024_095_6);
        near(level.p_values[0], 0.506_630_365_200_560_8);
    }

    /// `statsmodels.api.WLS` 0.15.0, with weights of the mean 1; of the residuals over z again with these.
    #[test]
    fn weighted_points_are_those_of_statsmodels() {
        let weights = [0.5, 2.0, 1.0, 1.5, 0.25, 3.0, 1.0];
        let point = |([x, y, z], weight): (&'static [f64; 3], f64)| Point {
            x: *x,
            y: *y,
            weight,
            features: std::slice::from_ref(z),
        };
        let points: Vec<_> = FIRST.iter().zip(weights).map(point).collect();
        let (line, level) = (Moments::of(&points).line(), Moments::of(&points).level());
        near(line.slope, 1.205_511_975_298_339_4);
        near(line.intercept, 0.291_519_235_583_743_65);
        near(line.deviation, 0.235_360_725_290_254_92);
        near(line.p_values[0], 0.932_200_093_745_262_8);
        near(level.deviation, 1.110_590_649_145_015_5);
        near(level.p_values[0], 0.707_590_032_068_819_1);
    }

    #[test]
    fn what_points_do_not_determine_is_not_stated() {
        // no point, one, two on a line, and points of one x
        assert_eq!(Moments::default().line().deviation, None);
        assert_eq!(moments(&FIRST[..1]).level().deviation, None);
        let two = moments(&FIRST[..2]).line();
        assert!(two.slope.is_some() && two.deviation.is_none() && two.p_values == [None]);
        let same = moments(&[[1.0, 2.0, 3.0], [1.0, 3.0, 4.0], [1.0, 5.0, 4.5]]).line();
        assert_eq!((same.slope, same.deviation, same.p_values[0]), (None, None, None));
        // a line without residuals, and a feature that is the same in all
        let exact = moments(&[[1.0, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 6.0, 4.0]]).line();
        assert_eq!((exact.slope, exact.p_values[0]), (Some(2.0), None));
        let constant = moments(&[[1.0, 2.0, 3.0], [2.0, 4.5, 3.0], [3.0, 6.0, 3.0]]).line();
        assert!(constant.deviation.is_some() && constant.p_values == [None]);
    }
}
