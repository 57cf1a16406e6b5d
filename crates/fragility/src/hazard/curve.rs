//! Hazard curves.

use serde::{Deserialize, Serialize};

/// Annual rates at which intensities are exceeded; between its points ln λ is linear in ln x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>", into = "Vec<[f64; 2]>")]
pub struct HazardCurve {
    points: Vec<[f64; 2]>,
}

/// Why points are no hazard curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct HazardError {
    /// The point that is wrong, from 1; `None` where there are too few.
    pub point: Option<usize>,
    message: String,
}

/// What may be wrong with points whose columns make a curve the other way round.
pub const SWAPPED: &str = "; are intensity and annual rate swapped? A point is [intensity, annual rate]";

impl HazardCurve {
    /// Makes a curve of points: an intensity, in any unit, and its annual rate of exceedance \[1/year\].
    ///
    /// # Errors
    /// [`HazardError`] if there are fewer than two points, a number is not positive and finite, the
    /// intensities do not rise, or the rates do not fall.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, HazardError> {
        if points.len() < 2 {
            let message = format!("a hazard curve needs two points or more, found {}", points.len());
            return Err(HazardError { point: None, message });
        }
        for (index, values) in points.iter().enumerate() {
            let point = index + 1;
            let refused = |what: String| {
                Err(HazardError { point: Some(point), message: format!("point {point}: the {what}") })
            };
            for (quantity, value) in ["intensity", "annual rate"].into_iter().zip(*values) {
                if !(value > 0.0 && value.is_finite()) {
                    return refused(format!("{quantity} {value} must be positive and finite"));
                }
            }
            let ([x, rate], Some([x_before, rate_before])) =
                (values, index.checked_sub(1).map(|k| points[k]))
            else {
                continue;
            };
            if *x <= x_before {
                let hint = if *rate > rate_before { SWAPPED } else { "" };
                return refused(format!(
                    "intensity {x} must be above {x_before}, that of the point before it; sort the \
                     points{hint}"
                ));
            }
            if *rate >= rate_before {
                return refused(format!(
                    "annual rate {rate} must be below {rate_before}, that of the point before it"
                ));
            }
        }
        Ok(Self { points })
    }

    /// Returns the points: intensity and annual rate.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Makes a curve of points whose intensities `to_si` converts. Messages have the numbers as given.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn converted(points: Vec<[f64; 2]>, to_si: impl Fn(f64) -> f64) -> Result<Self, HazardError> {
        let in_si = points.iter().map(|[x, rate]| [to_si(*x), *rate]).collect();
        Self::new(points).and(Self::new(in_si))
    }

    /// Returns the intensity at an annual rate, between the points; beyond them that of the first or last.
    ///
    /// ```
    /// use fragility::hazard::HazardCurve;
    ///
    /// let curve = HazardCurve::new(vec![[0.1, 1e-2], [0.4, 1e-4]])?;
    /// assert!((curve.intensity(1e-3) - 0.2).abs() < 1e-15);
    /// assert_eq!([1.0, 1e-9].map(|rate| curve.intensity(rate)), [0.1, 0.4]);
    /// # Ok::<(), fragility::hazard::HazardError>(())
    /// ```
    pub fn intensity(&self, rate: f64) -> f64 {
        let last = self.points.len() - 1;
        let after = self.points.partition_point(|[_, own]| *own > rate).clamp(1, last);
        let [[from, high], [to, low]] = [self.points[after - 1], self.points[after]];
        let part = (libm::log(high / rate) / libm::log(high / low)).clamp(0.0, 1.0);
        from * libm::pow(to / from, part)
    }
}

impl TryFrom<Vec<[f64; 2]>> for HazardCurve {
    type Error = HazardError;

    fn try_from(points: Vec<[f64; 2]>) -> Result<Self, HazardError> {
        Self::new(points)
    }
}

impl From<HazardCurve> for Vec<[f64; 2]> {
    fn from(curve: HazardCurve) -> Self {
        curve.points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_say_what_is_wrong_and_where() {
        for (points, words) in [
            (vec![[0.1, 1e-2]], "two points or more, found 1"),
            (vec![[0.1, 1e-2], [0.2, 0.0]], "point 2: the annual rate 0 must be positive"),
            (vec![[f64::NAN, 1e-2], [0.2, 1e-3]], "point 1: the intensity NaN"),
            (vec![[0.1, 1e-2], [0.2, 1e-3], [0.2, 1e-4]], "point 3: the intensity 0.2 must be above 0.2"),
            (vec![[0.1, 1e-2], [0.2, 1e-2]], "point 2: the annual rate 0.01 must be below 0.01"),
            (vec![[3e-2, 0.05], [2e-3, 0.2], [1e-4, 0.8]], "sort the points; are intensity and annual rate"),
        ] {
            let told = HazardCurve::new(points).unwrap_err().to_string();
            assert!(told.contains(words), "{told}");
        }
    }
}
