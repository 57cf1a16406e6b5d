//! Uncertain parameters of a study: names, distributions, correlations.

use fmu_export::{Kind, VariableId};
use rocking_wall::scene::{Group, Place, SceneError, Schema, number, object, suggestion, with};
use rocking_wall::tables;
use rocking_wall::variables::RealVariable;
use rocking_wall::wall::{Bar, COMPUTED};
use run::walls::wall_parameters;
use toml::{Spanned, Value};

use crate::uncertain::{Distribution, Shape, Uncertain, range};

/// Samples of a table that states no number.
const SAMPLES: u32 = 100;
/// Most samples of a wall.
const MOST_SAMPLES: u32 = 100_000;
/// Part of a distribution that limits may cut off without a word.
const MOST_CUT: f64 = 1e-3;
/// Keys of a distribution, one of which it has, with what each holds.
const SHAPES: [(&str, &str); 5] = [
    ("normal", "[mean, standard deviation]"),
    ("lognormal", "[median, standard deviation of the logarithm]"),
    ("uniform", "[lower end, upper end]"),
    ("triangular", "[lower end, mode, upper end]"),
    ("values", "[value, …], with weights = [weight, …] where they are not equal"),
];

tables! {
    /// Parameters of the walls that are not known: each wall stands for samples of them.
    #[derive(Debug)]
    pub(super) struct UncertainTable {
        /// Number of samples of each wall.
        #[key(minimum = 2, maximum = MOST_SAMPLES, default = SAMPLES)]
        samples: Option<Spanned<u32>>,
        /// Seed of the samples.
        #[key(default = 1)]
        seed: Option<u64>,
        /// Distributions of parameters by their names.
        #[key(properties = distributions())]
        parameters: Spanned<Group>,
        /// Two parameters and Spearman's correlation of their ranks, as lists.
        #[serde(default)]
        #[key(items = correlation())]
        correlation: Vec<Spanned<Value>>,
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

fn list(count: Option<usize>) -> Schema {
    let numbers = with(Schema::new(), "type", "array");
    let item = with(Schema::new(), "type", "number");
    let numbers = with(numbers, "items", item);
    let size =
        |list: Schema, word: &str, count: usize| with(list, word, i64::try_from(count).unwrap_or(i64::MAX));
    let least = size(numbers, "minItems", count.unwrap_or(1));
    count.map_or(least.clone(), |count| size(least, "maxItems", count))
}

fn distributions() -> Schema {
    let mut keys: Schema = SHAPES
        .map(|(key, holds)| {
            let count = (key != "values").then(|| holds.split(", ").count());
            (key.to_owned(), with(list(count), "description", holds).into())
        })
        .into_iter()
        .collect();
    keys.insert("weights".into(), list(None).into());
    keys.insert("within".into(), with(list(Some(2)), "description", "Limits, lower and upper.").into());
    names().map(|name| (name.to_owned(), Value::Table(object(keys.clone())))).collect()
}

fn correlation() -> Schema {
    let list = with(Schema::new(), "type", "array");
    with(with(list, "minItems", 3), "maxItems", 3)
}

/// Reads the uncertain parameters, and what their limits cut off.
pub(super) fn uncertain(
    table: &Spanned<UncertainTable>,
    place: &Place<'_>,
) -> Result<(Uncertain, Vec<String>), SceneError> {
    let UncertainTable { samples, seed, parameters, correlation } = table.get_ref();
    let count = samples.as_ref().map_or(SAMPLES, |samples| *samples.get_ref());
    if let Some(samples) = samples.as_ref().filter(|_| !(2..=MOST_SAMPLES).contains(&count)) {
        let message = format!("samples = {count} must be from 2 to {MOST_SAMPLES}");
        return Err(place.error(samples.span(), message));
    }
    if parameters.get_ref().is_empty() {
        let message = "no parameter is uncertain; give one, such as height = { normal = [3.0, 0.1] }";
        return Err(place.error(parameters.span(), message));
    }
    let (mut all, mut warnings) = (Vec::new(), Vec::new());
    for (key, value) in parameters.get_ref() {
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
    let uncertain =
        Uncertain { samples: count as usize, seed: seed.unwrap_or(1), parameters: all, correlations };
    uncertain.rows().map_err(|reason| place.error(table.span(), format!("[uncertain] {reason}")))?;
    Ok((uncertain, warnings))
}

/// Reads a distribution of a parameter with limits.
fn distribution(value: &Value, [least, most]: [f64; 2]) -> Result<Distribution, String> {
    let keys: Vec<_> = SHAPES.iter().map(|(key, holds)| format!("{key} = {holds}")).collect();
    let expected = || format!("expected a table with one of {}", keys.join("; "));
    let table = value.as_table().ok_or_else(expected)?;
    let known = || SHAPES.iter().map(|(key, _)| *key).chain(["weights", "within"]);
    if let Some(key) = table.keys().find(|key| known().all(|known| known != *key)) {
        return Err(format!("unknown key {key:?}{}; {}", suggestion(key, known()), expected()));
    }
    let mut shapes = SHAPES.iter().filter(|(key, _)| table.contains_key(*key));
    let (Some((shape, holds)), None) = (shapes.next(), shapes.next()) else { return Err(expected()) };
    let numbers = |key: &str, holds: &str| -> Result<Vec<f64>, String> {
        let list = table.get(key).and_then(Value::as_array);
        let list = list.and_then(|list| list.iter().map(number).collect());
        list.ok_or_else(|| format!("{key} must be a list of numbers {holds}"))
    };
    let given = numbers(shape, holds)?;
    let words = format!("{shape} = {given:?}");
    let shape = match (*shape, &*given) {
        ("normal", &[mean, deviation]) => Shape::Normal { mean, deviation },
        ("lognormal", &[median, beta]) => Shape::Lognormal { median, beta },
        ("uniform", &[low, high]) => Shape::Uniform([low, high]),
        ("triangular", &[low, mode, high]) => Shape::Triangular([low, mode, high]),
        ("values", values) => {
            let weights = match table.get("weights") {
                Some(_) => numbers("weights", "")?,
                None => vec![1.0; values.len()],
            };
            if weights.len() != values.len() {
                return Err(format!("{words} needs as many weights, found {}", weights.len()));
            }
            Shape::Values(values.iter().zip(weights).map(|(value, weight)| [*value, weight]).collect())
        }
        _ => return Err(format!("{words}: expected {holds}")),
    };
    if table.contains_key("weights") && !matches!(shape, Shape::Values(_)) {
        return Err("weights belong to values; leave them out".to_owned());
    }
    let within = match table.get("within") {
        Some(_) => numbers("within", "[lower limit, upper limit]")?,
        None => vec![least, most],
    };
    let [low, high] = *within else { return Err("within must be [lower limit, upper limit]".to_owned()) };
    if !(least <= low && low < high && high <= most) {
        let limits = range([least, most]);
        return Err(format!("within = [{low}, {high}] must rise, and lie within the limits ({limits})"));
    }
    Distribution::new(shape, [low, high]).map_err(|reason| format!("{words}: {reason}"))
}

/// Reads the places of two parameters, and the correlation of their ranks.
fn pair(value: &Value, parameters: &[(String, Distribution)]) -> Result<([usize; 2], f64), String> {
    let shape = || "expected [\"height\", \"thickness\", 0.5]: two parameters and a number".to_owned();
    let [one, other, correlation] = value.as_array().map(Vec::as_slice).unwrap_or_default() else {
        return Err(shape());
    };
    let place = |value: &Value| {
        let name = value.as_str().ok_or_else(shape)?;
        let known = || parameters.iter().map(|(name, _)| name.as_str());
        let found = known().position(|known| known == name);
        found.ok_or_else(|| {
            format!("{name:?} is not among [uncertain.parameters]{}", suggestion(name, known()))
        })
    };
    let places = [place(one)?, place(other)?];
    let correlation = number(correlation).ok_or_else(shape)?;
    if places[0] == places[1] {
        return Err("a parameter has no correlation with itself; name two".to_owned());
    }
    if correlation.abs() < 1.0 {
        return Ok((places, correlation));
    }
    Err(format!("{correlation} must be above -1 and below 1"))
}
