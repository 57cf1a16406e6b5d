//! Distributions of parameters, and their truncation.

use fragility::{cumulative, quantile};

/// A distribution before it is truncated. Numbers have the unit of the parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
    },
    /// Lognormal.
    Lognormal {
        /// Median.
        median: f64,
        /// Standard deviation of the logarithm \[-\].
        beta: f64,
    },
    /// Uniform from an end to the other.
    Uniform([f64; 2]),
    /// Triangular: lower end, mode, upper end.
    Triangular([f64; 3]),
    /// Values with weights, of any sum.
    Values(Vec<[f64; 2]>),
}

/// Most of a distribution that limits may cut off.
const MOST_CUT: f64 = 0.5;
/// A distribution whose lowest thousandth ends above this part of its median is one of positive values.
const FAR_FROM_ZERO: f64 = 0.1;

/// Writes limits; the largest numbers stand for none.
pub fn range([least, most]: [f64; 2]) -> String {
    match (least == f64::MIN, most == f64::MAX) {
        (true, true) => "any number".to_owned(),
        (true, false) => format!("at most {most}"),
        (false, true) => format!("at least {least}"),
        (false, false) => format!("{least} to {most}"),
    }
}

/// A part of a distribution that is below every sample.
const LEAST: f64 = 1e-15;

/// A distribution within limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    shape: Shape,
    limits: [f64; 2],
    /// F at the limits.
    parts: [f64; 2],
}

impl Distribution {
    /// Truncates a distribution to its part within limits.
    ///
    /// # Errors
    /// The reason: a number that its distribution cannot have, a value outside the limits, or limits that cut
    /// off more than half.
    pub fn new(shape: Shape, limits: [f64; 2]) -> Result<Self, String> {
        shape.check(limits)?;
        let parts = match shape {
            Shape::Values(_) => [0.0, 1.0],
            _ => limits.map(|limit| shape.cumulative(limit)),
        };
        let distribution = Self { shape, limits, parts };
        let cut = distribution.cut();
        if cut > MOST_CUT {
            return Err(format!(
                "{:.3} % of it is outside its limits ({}), and at most {} % may be; are its unit and order \
                 right?",
                100.0 * cut,
                range(limits),
                100.0 * MOST_CUT
            ));
        }
        Ok(distribution)
    }

    /// Returns the part that the limits cut off \[-\].
    pub fn cut(&self) -> f64 {
        self.parts[0] + (1.0 - self.parts[1])
    }

    /// Returns the limits.
    pub fn limits(&self) -> [f64; 2] {
        self.limits
    }

    /// Returns whether its logarithm is the natural scale: it is lognormal, or its values are positive and
    /// not near 0 (the thousandth is above a tenth of the median, and no sample is at 0 or below).
    pub fn is_logarithmic(&self) -> bool {
        matches!(self.shape, Shape::Lognormal { .. }) || {
            let [least, thousandth, median] = [LEAST, 0.001, 0.5].map(|part| self.value(part));
            least > 0.0 && thousandth > FAR_FROM_ZERO * median
        }
    }

    /// Returns the value that a part, above 0 and below 1, of the truncated distribution is below.
    pub fn value(&self, part: f64) -> f64 {
        let [low, high] = self.parts;
        self.shape.quantile(low + part * (high - low)).clamp(self.limits[0], self.limits[1])
    }
}

impl Shape {
    /// Sees that it has the numbers that it needs, and values within limits.
    fn check(&self, [least, most]: [f64; 2]) -> Result<(), String> {
        let positive = |number: f64| number > 0.0 && number.is_finite();
        match *self {
            Self::Normal { mean, deviation } if !(mean.is_finite() && positive(deviation)) => Err(format!(
                "normal = [{mean}, {deviation}]: the mean must be finite and the standard deviation above 0"
            )),
            Self::Lognormal { median, beta } if !(positive(median) && positive(beta)) => Err(format!(
                "lognormal = [{median}, {beta}]: the median and the standard deviation of the logarithm must \
                 be above 0"
            )),
            Self::Uniform([low, high]) if !positive(high - low) => {
                Err(format!("uniform = [{low}, {high}]: the upper end must be above the lower one"))
            }
            Self::Triangular([a, mode, b]) if !(a <= mode && mode <= b && positive(b - a)) => Err(format!(
                "triangular = [{a}, {mode}, {b}]: the upper end must be above the lower one, and the mode \
                 between them"
            )),
            Self::Values(ref values) if values.is_empty() => {
                Err("values = []: there must be a value at least".to_owned())
            }
            Self::Values(ref values) => {
                let is_wrong = |[x, weight]: &&[f64; 2]| !(x.is_finite() && positive(*weight));
                values.iter().find(is_wrong).map_or(Ok(()), |[x, weight]| {
                    Err(format!(
                        "values with {x} of weight {weight}: values must be finite and weights above 0"
                    ))
                })
            }
            _ => Ok(()),
        }?;
        let values = if let Self::Values(values) = self { &values[..] } else { &[] };
        match values.iter().find(|[value, _]| !(least..=most).contains(value)) {
            Some([value, _]) => {
                Err(format!("its value {value} is outside its limits ({})", range([least, most])))
            }
            None => Ok(()),
        }
    }

    /// Returns F(x) of a continuous distribution.
    fn cumulative(&self, x: f64) -> f64 {
        match *self {
            Self::Normal { mean, deviation } => cumulative((x - mean) / deviation),
            Self::Lognormal { .. } if x <= 0.0 => 0.0,
            Self::Lognormal { median, beta } => cumulative(libm::log(x / median) / beta),
            Self::Uniform([low, high]) => ((x - low) / (high - low)).clamp(0.0, 1.0),
            Self::Triangular([low, _, _]) if x <= low => 0.0,
            Self::Triangular([_, _, high]) if x >= high => 1.0,
            Self::Triangular([low, mode, high]) if x < mode => {
                (x - low) * (x - low) / ((high - low) * (mode - low))
            }
            Self::Triangular([low, mode, high]) => {
                1.0 - (high - x) * (high - x) / ((high - low) * (high - mode))
            }
            Self::Values(_) => f64::NAN,
        }
    }

    /// Returns the x at which F is a part.
    fn quantile(&self, part: f64) -> f64 {
        match self {
            Self::Normal { mean, deviation } => mean + deviation * quantile(part),
            Self::Lognormal { median, beta } => median * libm::exp(beta * quantile(part)),
            Self::Uniform([low, high]) => low + part * (high - low),
            Self::Triangular([low, mode, high]) => {
                let range = high - low;
                if part * range < mode - low {
                    low + libm::sqrt(part * range * (mode - low))
                } else {
                    high - libm::sqrt((1.0 - part) * range * (high - mode))
                }
            }
            Self::Values(values) => {
                let all: f64 = values.iter().map(|[_, weight]| weight).sum();
                let mut sum = 0.0;
                let found = values.iter().find(|[_, weight]| {
                    sum += weight;
                    part * all < sum
                });
                found.or(values.last()).map_or(f64::NAN, |[value, _]| *value)
            }
        }
    }
}
