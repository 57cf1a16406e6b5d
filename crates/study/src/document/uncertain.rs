//! Uncertain parameters of a study: names, distributions, correlations.

use std::collections::BTreeMap;

use files::{Described, FileError, Place, Schema, Tables, object, suggestion, tables, with};
use fmu_export::{Kind, VariableId};
use report::counted;
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{Bar, COMPUTED};
use run::wall_parameters::wall_parameters;
use serde::Deserialize;
use toml::{Spanned, Value};

use crate::uncertain::{Distribution, Shape, Uncertain, range};

/// Samples of a table that states no number.
const SAMPLES: u32 = 100;
/// Most samples of a wall.
const MOST_SAMPLES: u32 = 100_000;
/// Part of a distribution that limits may cut off without a word.
const MOST_CUT: f64 = 1e-3;
tables! {
    /// Parameters of the walls that are not known: each wall stands for samples of them.
    #[derive(Debug)]
    pub(super) struct UncertainTable {
        /// Number of samples of each wall.
        #[key(minimum = 2, maximum = MOST_SAMPLES, default = SAMPLES)]
        samples: Option<u32>,
        /// Seed of the samples.
        #[key(default = 1)]
        seed: Option<u64>,
        /// Distributions of parameters by their names.
        parameters: Spanned<Parameters>,
        /// Two parameters and Spearman's correlation of their ranks, as lists.
        #[serde(default)]
        #[key(items = correlation())]
        correlation: Vec<Spanned<Value>>,
    }

    /// The distribution of a parameter: one of normal to values, within limits.
    #[derive(Debug)]
    struct DistributionTable {
        /// Mean and standard deviation.
        normal: Option<[f64; 2]>,
        /// Median and standard deviation of the logarithm.
        lognormal: Option<[f64; 2]>,
        /// Lower and upper end.
        uniform: Option<[f64; 2]>,
        /// Lower end, mode and upper end.
        triangular: Option<[f64; 3]>,
        /// Values that are taken.
        #[key(minItems = 1)]
        values: Option<Vec<f64>>,
        /// Weights of the values; by default equal.
        #[key(minItems = 1)]
        weights: Option<Vec<f64>>,
        /// Limits, lower and upper.
        within: Option<[f64; 2]>,
    }
}

/// Distributions by the names of their parameters.
#[derive(Debug, Deserialize)]
#[serde(transparent)]
struct Parameters(BTreeMap<Spanned<String>, Spanned<DistributionTable>>);

impl Described for Parameters {
    fn describe(key: &str, _tables: &mut Tables) -> Schema {
        // every parameter has the table itself, which the parameters of the Python package follow from
        let mut own = Tables::default();
        DistributionTable::describe(key, &mut own);
        let table = own.schemas.into_iter().next().map_or_else(|| Schema::new().into(), |(_, table)| table);
        object(names().map(|name| (name.to_owned(), table.clone())).collect())
    }
}

/// Names parameters with numbers that a wall of a study may state.
fn names() -> impl Iterator<Item = &'static str> {
    wall_parameters().filter(|name| limits(name).is_some())
}

/// Returns the limits of a parameter, without the number that stands for one that is computed.
fn limits(name: &str) -> Option<[f64; 2]> {
    if Bar::NUMBERS.iter().any(|number| number.usual.name == name) {
        return Some([0.0, f64::MAX]);
    }
    let Kind::Real { min, max, .. } = RealVariable::from_name(name)?.variable().kind else { return None };
    let least = min.unwrap_or(f64::MIN);
    Some([if least == COMPUTED { 0.0 } else { least }, max.unwrap_or(f64::MAX)])
}

fn correlation() -> Schema {
    let list = with(Schema::new(), "type", "array");
    with(with(list, "minItems", 3), "maxItems", 3)
}

/// Reads the uncertain parameters, and what their limits cut off.
pub(super) fn uncertain(
    table: &Spanned<UncertainTable>,
    place: &Place<'_>,
) -> Result<(Uncertain, Vec<String>), FileError> {
    let UncertainTable { samples, seed, parameters, correlation } = table.get_ref();
    let Parameters(given) = parameters.get_ref();
    if given.is_empty() {
        let message = "no parameter is uncertain; give one, such as height = { normal = [3.0, 0.1] }";
        return Err(place.error(parameters.span(), message));
    }
    let (mut all, mut warnings) = (Vec::new(), Vec::new());
    for (key, value) in given {
        let name = key.get_ref();
        let Some(limits) = limits(name).filter(|_| names().any(|known| known == name)) else {
            let meant = suggestion(name, names());
            let known: Vec<_> = names().collect();
            let known = known.join(", ");
            let message = format!("{name:?} is not a number of a wall of a study{meant}: {known}");
            return Err(place.error(key.span(), message));
        };
        let distribution = distribution(value.get_ref(), limits)
            .map_err(|message| place.error(value.span(), format!("{name}: {message}")))?;
        if distribution.cut() > MOST_CUT {
            let (limits, cut) = (range(distribution.limits()), 100.0 * distribution.cut());
            warnings.push(format!("[uncertain] {name}: its limits ({limits}) cut off {cut:.2} % of it"));
        }
        all.push((name.clone(), distribution));
    }
    let mut correlations: Vec<([usize; 2], f64)> = Vec::new();
    for entry in correlation {
        let read = pair(entry.get_ref(), &all).and_then(|(pair, number)| {
            let is_known =
                correlations.iter().any(|(other, _)| *other == pair || *other == [pair[1], pair[0]]);
            if is_known {
                Err("these two parameters are listed twice".to_owned())
            } else {
                Ok((pair, number))
            }
        });
        correlations
            .push(read.map_err(|message| place.error(entry.span(), format!("correlation: {message}")))?);
    }
    let samples = samples.unwrap_or(SAMPLES) as usize;
    let uncertain = Uncertain { samples, seed: seed.unwrap_or(1), parameters: all, correlations };
    uncertain.rows().map_err(|reason| place.error(table.span(), format!("[uncertain] {reason}")))?;
    Ok((uncertain, warnings))
}

/// Reads a distribution of a parameter with limits.
fn distribution(table: &DistributionTable, [least, most]: [f64; 2]) -> Result<Distribution, String> {
    let DistributionTable { normal, lognormal, uniform, triangular, values, weights, within } = table;
    let values = values.as_ref().map(|values| {
        let weights = weights.clone().unwrap_or_else(|| vec![1.0; values.len()]);
        if weights.len() != values.len() {
            let (values, weights) = (counted(values.len(), "value"), counted(weights.len(), "weight"));
            return Err(format!("{values} and {weights}; give as many"));
        }
        Ok(Shape::Values(values.iter().zip(weights).map(|(value, weight)| [*value, weight]).collect()))
    });
    if values.is_none() && weights.is_some() {
        return Err("weights belong to values; leave them out".to_owned());
    }
    let shapes = [
        normal.map(|[mean, deviation]| Shape::Normal { mean, deviation }),
        lognormal.map(|[median, beta]| Shape::Lognormal { median, beta }),
        uniform.map(Shape::Uniform),
        triangular.map(Shape::Triangular),
        values.transpose()?,
    ];
    let mut shapes = shapes.into_iter().flatten();
    let (Some(shape), None) = (shapes.next(), shapes.next()) else {
        return Err("expected one of normal, lognormal, uniform, triangular and values".to_owned());
    };
    let [low, high] = within.unwrap_or([least, most]);
    if !(least <= low && low < high && high <= most) {
        let limits = range([least, most]);
        return Err(format!("within = [{low}, {high}] must rise, and lie within the limits ({limits})"));
    }
    Distribution::new(shape, [low, high])
}

/// Reads the places of two parameters, and the correlation of their ranks.
fn pair(value: &Value, parameters: &[(String, Distribution)]) -> Result<([usize; 2], f64), String> {
    let read = value.clone().try_into::<(String, String, f64)>();
    let (one, other, correlation) = read
        .map_err(|_| "expected [\"height\", \"thickness\", 0.5]: two parameters and a number".to_owned())?;
    let place = |name: &str| {
        let known = || parameters.iter().map(|(name, _)| name.as_str());
        let found = known().position(|known| known == name);
        found.ok_or_else(|| {
            format!("{name:?} is not among [uncertain.parameters]{}", suggestion(name, known()))
        })
    };
    let places = [place(&one)?, place(&other)?];
    if places[0] == places[1] {
        return Err("a parameter has no correlation with itself; name two".to_owned());
    }
    if correlation.abs() < 1.0 {
        return Ok((places, correlation));
    }
    Err(format!("{correlation} must be above -1 and below 1"))
}
