//! Hazard curves.

use serde::{Deserialize, Serialize};

/// Annual rates at which intensities are exceeded; between its points ln λ is linear in ln x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<[f64; 2]>", into = "Vec<[f64; 2]>")]
pub struct HazardCurve {
    points: Vec<[f64; 2]>,
}

/// Why points are no hazard curve. Points count from 1.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[allow(missing_docs, reason = "the fields are the words of the message")]
pub enum HazardError {
    /// Fewer than two points.
    #[error("a hazard curve needs two points or more, found {count}")]
    TooFew { count: usize },
    /// A number that has no logarithm.
    #[error("point {point}: the {quantity} {value} must be positive and finite")]
    Value { point: usize, quantity: &'static str, value: f64 },
    /// Intensities that do not rise.
    #[error("point {point}: the intensity {value} must be above {before}, that of the point before it")]
    Intensity { point: usize, value: f64, before: f64 },
    /// Rates that do not fall.
    #[error("point {point}: the annual rate {value} must be below {before}, that of the point before it")]
    Rate { point: usize, value: f64, before: f64 },
}

impl HazardCurve {
    /// Makes a curve of points: an intensity, in any unit, and its annual rate of exceedance \[1/year\].
    ///
    /// # Errors
    /// [`HazardError`] if there are fewer than two points, a number is not positive and finite, the
    /// intensities do not rise, or the rates do not fall.
    pub fn new(points: Vec<[f64; 2]>) -> Result<Self, HazardError> {
        if points.len() < 2 {
            return Err(HazardError::TooFew { count: points.len() });
        }
        for (index, values) in points.iter().enumerate() {
            for (quantity, value) in ["intensity", "annual rate"].into_iter().zip(*values) {
                if !(value > 0.0 && value.is_finite()) {
                    return Err(HazardError::Value { point: index + 1, quantity, value });
                }
            }
        }
        for (index, pair) in points.windows(2).enumerate() {
            let [[x, rate], [next_x, next_rate]] = [pair[0], pair[1]];
            if next_x <= x {
                return Err(HazardError::Intensity { point: index + 2, value: next_x, before: x });
            }
            if next_rate >= rate {
                return Err(HazardError::Rate { point: index + 2, value: next_rate, before: rate });
            }
        }
        Ok(Self { points })
    }

    /// Returns the points: intensity and annual rate.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Returns the curve with its intensities times a positive factor, such as a unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { points: self.points.iter().map(|[x, rate]| [factor * x, *rate]).collect() }
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
        ] {
            let told = HazardCurve::new(points).unwrap_err().to_string();
            assert!(told.contains(words), "{told}");
        }
    }
}
