//! The tables `[intensity]` and `[levels]`.

use serde::Deserialize;
use toml::Spanned;

use crate::ida::{IntensityMeasure, Levels};
use ground_motion::Unit;
use rocking_wall::scene::{Place, SceneError};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IntensityTable {
    measure: Spanned<String>,
    period: Option<f64>,
    periods: Option<Vec<f64>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LevelsTable {
    method: Spanned<String>,
    unit: Option<Spanned<String>>,
    first: Option<f64>,
    increase: Option<f64>,
    step: Option<f64>,
    top: Option<f64>,
    resolution: Option<f64>,
    gap: Option<f64>,
    values: Option<Vec<f64>>,
}

pub(super) fn measure(
    table: Option<&Spanned<IntensityTable>>,
    place: &Place<'_>,
) -> Result<IntensityMeasure, SceneError> {
    let Some(table) = table else { return Ok(IntensityMeasure::default()) };
    let spec = table.get_ref();
    let refuse = |message: &str| Err(place.error(table.span(), message));
    match (spec.measure.get_ref().as_str(), spec.period, &spec.periods) {
        ("PGA", None, None) => Ok(IntensityMeasure::Pga),
        ("PGA", ..) => refuse("PGA has no periods; leave them out"),
        ("Sa", Some(period), None) => Ok(IntensityMeasure::Sa { period }),
        ("Sa", ..) => refuse("Sa needs one period in s, such as period = 0.5"),
        ("AvgSA", None, None) => Ok(IntensityMeasure::default()),
        ("AvgSA", None, Some(periods)) => Ok(IntensityMeasure::AvgSa { periods: periods.clone() }),
        ("AvgSA", ..) => refuse("AvgSA takes a list of periods in s, such as periods = [0.2, 0.4, 0.6]"),
        (other, ..) => {
            let message = format!("measure = {other:?} is not one of PGA, Sa, AvgSA");
            Err(place.error(spec.measure.span(), message))
        }
    }
}

pub(super) fn levels(table: &Spanned<LevelsTable>, place: &Place<'_>) -> Result<Levels, SceneError> {
    let spec = table.get_ref();
    let unit = match &spec.unit {
        None => Unit::StandardGravity,
        Some(text) => {
            text.get_ref().parse::<Unit>().map_err(|error| place.error(text.span(), error.to_string()))?
        }
    };
    let method = spec.method.get_ref().as_str();
    let keys: &[&str] = match method {
        "hunt" => &["first", "increase", "top", "resolution", "gap"],
        "step" => &["step", "top"],
        "grid" => &["values", "step", "top"],
        other => {
            let message = format!("method = {other:?} is not one of hunt, step, grid");
            return Err(place.error(spec.method.span(), message));
        }
    };
    let given = [
        ("first", spec.first),
        ("increase", spec.increase),
        ("step", spec.step),
        ("top", spec.top),
        ("resolution", spec.resolution),
        ("gap", spec.gap),
        ("values", spec.values.as_ref().map(|_| 0.0)),
    ];
    if let Some((name, _)) = given.iter().find(|(name, value)| value.is_some() && !keys.contains(name)) {
        let message = format!("{name} has no part in method = {method:?}, which takes {}", keys.join(", "));
        return Err(place.error(table.span(), message));
    }
    let needed = |name: &str| {
        let missing = || place.error(table.span(), format!("method = {method:?} needs {name}"));
        let value = given.iter().find(|(given, _)| *given == name).and_then(|(_, value)| *value);
        value.map(|value| unit.to_si(value)).ok_or_else(missing)
    };
    match method {
        "hunt" => Ok(Levels::HuntAndFill {
            first: needed("first")?,
            increase: needed("increase")?,
            top: needed("top")?,
            resolution: spec.resolution.unwrap_or(0.01),
            gap: spec.gap.unwrap_or(0.1),
        }),
        "step" => Ok(Levels::ToOverturning { step: needed("step")?, top: needed("top")? }),
        _ => match (&spec.values, spec.step, spec.top) {
            (Some(values), None, None) => Ok(Levels::Grid(values.iter().map(|&x| unit.to_si(x)).collect())),
            (None, Some(step), Some(top)) => {
                // bounded before it is counted: a study takes no more than 2000
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 2001")]
                let count = (top / step * (1.0 + 1e-12)).floor().clamp(0.0, 2001.0) as u32;
                Ok(Levels::Grid((1..=count).map(|k| unit.to_si(step * f64::from(k))).collect()))
            }
            _ => Err(place.error(table.span(), "method = \"grid\" needs values, or step and top")),
        },
    }
}
