//! The tables `[intensity]` and `[levels]`.

use std::ops::Range;

use toml::Spanned;

use crate::codes::Codes;
use crate::ida::{IntensityMeasure, Levels, ToSi};
use files::{FileError, Place, TomlFile, tables};
use run::records::Selection;
use scene::SceneError;

/// Names of the intensity measures.
pub(super) const MEASURES: [&str; 9] =
    ["PGA", "PGV", "PGD", "Sa", "AvgSA", "Arias", "CAV", "Housner", "code"];
/// Names of the ways to choose levels.
const METHODS: [&str; 5] = ["hunt", "step", "grid", "cloud", "stripes"];
/// Resolution and gap of a hunt that states none.
const RESOLUTION: f64 = 0.01;
const GAP: f64 = 0.1;

tables! {
    /// Intensity measure by which records are scaled; spectral ones at 5 % damping.
    #[derive(Debug)]
    pub(super) struct IntensityTable {
        /// The measure.
        #[key(enum = MEASURES.to_vec())]
        pub(super) measure: Spanned<String>,
        /// Period of Sa \[s\].
        period: Option<f64>,
        /// Periods of AvgSA and of code \[s\]; by default 0.2, 0.4 to 1.4 s, and 0.2, 0.3 to 2 s.
        periods: Option<Vec<f64>>,
        /// With code: takes so many of the records, those whose spectra fit that of the site best.
        #[key(minimum = 1)]
        pub(super) select: Option<Spanned<usize>>,
        /// Measures that the runs compare, by the names of measure; Sa has its period in s, as "Sa(0.5)".
        #[key(minItems = 1)]
        pub(super) compare: Option<Spanned<Vec<Spanned<String>>>>,
        /// With compare: a table (CSV) with a column record, and magnitude, `distance_km` or both.
        pub(super) records_table: Option<Spanned<String>>,
    }

    /// Levels of intensity: hunt, step (to the first overturning), grid, cloud (each record once), or stripes
    /// (each with its own records).
    #[derive(Debug)]
    pub(super) struct LevelsTable {
        /// How levels are chosen.
        #[key(enum = METHODS.to_vec())]
        method: Spanned<String>,
        /// Unit of the levels: of an acceleration m/s2, cm/s2, mm/s2 or g; of PGV and Arias cm/s, m/s or
        /// mm/s; of PGD and Housner cm, m or mm; of CAV g s, m/s or cm/s. By default that of the results.
        unit: Option<Spanned<String>>,
        /// First level and first step of a hunt.
        first: Option<f64>,
        /// Increase of each step of a hunt.
        increase: Option<f64>,
        /// Distance between levels of step and grid.
        step: Option<f64>,
        /// Highest level.
        top: Option<f64>,
        /// Largest bracket of the collapse in a hunt, as a part of the collapse intensity.
        #[key(default = RESOLUTION)]
        resolution: Option<f64>,
        /// Largest gap between levels of a hunt, as a part of the collapse intensity.
        #[key(default = GAP)]
        gap: Option<f64>,
        /// Levels of a grid.
        values: Option<Vec<f64>>,
        /// Factor on the records of a cloud.
        #[key(exclusiveMinimum = 0, default = 1)]
        scale: Option<f64>,
        /// Stripes, from the lowest on.
        #[serde(default)]
        stripe: Vec<Spanned<StripeTable>>,
    }

    /// A level with its own records, which are run as their list scales them.
    #[derive(Debug)]
    pub(super) struct StripeTable {
        /// Level.
        intensity: f64,
        /// List of its records: a table, or its folder.
        selection: Spanned<String>,
    }
}

/// Returns the lists of the stripes.
pub(super) fn stripes(table: &Spanned<LevelsTable>, place: &Place<'_>) -> Vec<Selection> {
    let list = |(number, stripe): (usize, &Spanned<StripeTable>)| {
        let list = &stripe.get_ref().selection;
        Selection { path: list.get_ref().clone(), line: place.line(list.span()), stripe: Some(number) }
    };
    table.get_ref().stripe.iter().enumerate().map(list).collect()
}

pub(super) fn measure(
    table: Option<&Spanned<IntensityTable>>,
    codes: &dyn Codes,
    file: &TomlFile<'_>,
) -> Result<IntensityMeasure, SceneError> {
    let Some(table) = table else { return Ok(IntensityMeasure::default()) };
    let (spec, place) = (table.get_ref(), file.place());
    let refuse = |message: &str| Err(place.error(table.span(), message).into());
    if let Some(select) = spec.select.as_ref().filter(|_| spec.measure.get_ref() != "code") {
        let message =
            "select takes the records that fit the spectrum of the site; it needs measure = \"code\"";
        return Err(place.error(select.span(), message).into());
    }
    let name = spec.measure.get_ref().as_str();
    if let Some(measure) = without_periods(name) {
        if spec.period.is_some() || spec.periods.is_some() {
            return refuse(&format!("{name} takes no periods; leave them out"));
        }
        return Ok(measure);
    }
    match (name, spec.period, &spec.periods) {
        ("Sa", Some(period), None) => Ok(IntensityMeasure::Sa { period }),
        ("Sa", ..) => refuse("Sa needs one period in s, such as period = 0.5"),
        ("AvgSA", None, None) => Ok(IntensityMeasure::default()),
        ("AvgSA", None, Some(periods)) => Ok(IntensityMeasure::AvgSa { periods: periods.clone() }),
        ("AvgSA", ..) => refuse("AvgSA takes a list of periods in s, such as periods = [0.2, 0.4, 0.6]"),
        ("code", None, periods) => of_code(periods.clone(), table.span(), codes, file),
        ("code", ..) => refuse("code takes a list of periods in s, such as periods = [0.2, 0.4, 0.6]"),
        (other, ..) => {
            let message = format!("measure = {other:?} is not one of {}", MEASURES.join(", "));
            Err(place.error(spec.measure.span(), message).into())
        }
    }
}

/// Returns the measure of a name that takes no periods.
pub(super) fn without_periods(name: &str) -> Option<IntensityMeasure> {
    match name {
        "PGA" => Some(IntensityMeasure::Pga),
        "PGV" => Some(IntensityMeasure::Pgv),
        "PGD" => Some(IntensityMeasure::Pgd),
        "Arias" => Some(IntensityMeasure::Arias),
        "CAV" => Some(IntensityMeasure::Cav),
        // it has periods of its own
        "Housner" => Some(IntensityMeasure::Housner),
        _ => None,
    }
}

/// The ground acceleration of the spectrum that the table `[check]` states, over periods, by default 0.2, 0.3
/// to 2 s; `span` is where the study asks for it.
pub(super) fn of_code(
    periods: Option<Vec<f64>>,
    span: Range<usize>,
    codes: &dyn Codes,
    file: &TomlFile<'_>,
) -> Result<IntensityMeasure, SceneError> {
    let place = file.place();
    let periods = periods.unwrap_or_else(|| (2..=20).map(|tenth| f64::from(tenth) / 10.0).collect());
    if let Some(period) = periods.iter().find(|period| !(**period > 0.0 && period.is_finite())) {
        return Err(place.error(span, format!("periods: {period} s must be above 0")).into());
    }
    let missing = || {
        place
            .error(span, "measure = \"code\" needs the spectrum of the site: ag, F0 and TC of SLV in [check]")
    };
    let shape = codes.spectral_shape(file, &periods)?;
    let shape = shape.filter(|shape| !shape.is_empty()).ok_or_else(missing)?;
    Ok(IntensityMeasure::Code { periods, shape })
}

pub(super) fn levels(
    table: &Spanned<LevelsTable>,
    measure: &IntensityMeasure,
    place: &Place<'_>,
) -> Result<Levels, FileError> {
    let spec = table.get_ref();
    let to_si = to_si(measure, spec.unit.as_ref(), place)?;
    let method = spec.method.get_ref().as_str();
    let keys: &[&str] = match method {
        "hunt" => &["first", "increase", "top", "resolution", "gap"],
        "step" => &["step", "top"],
        "grid" => &["values", "step", "top"],
        "cloud" => &["scale"],
        "stripes" => &["[[levels.stripe]]"],
        other => {
            let message = format!("method = {other:?} is not one of {}", METHODS.join(", "));
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
        ("scale", spec.scale),
        ("[[levels.stripe]]", spec.stripe.first().map(|_| 0.0)),
        ("unit", spec.unit.as_ref().filter(|_| method == "cloud").map(|_| 0.0)),
    ];
    let is_taken = |name: &str| keys.contains(&name);
    if let Some((name, _)) = given.iter().find(|(name, value)| value.is_some() && !is_taken(name)) {
        let message = format!("{name} has no part in method = {method:?}, which takes {}", keys.join(", "));
        return Err(place.error(table.span(), message));
    }
    let needed = |name: &str| {
        let missing = || place.error(table.span(), format!("method = {method:?} needs {name}"));
        let value = given.iter().find(|(given, _)| *given == name).and_then(|(_, value)| *value);
        value.map(to_si).ok_or_else(missing)
    };
    match method {
        "hunt" => Ok(Levels::HuntAndFill {
            first: needed("first")?,
            increase: needed("increase")?,
            top: needed("top")?,
            resolution: spec.resolution.unwrap_or(RESOLUTION),
            gap: spec.gap.unwrap_or(GAP),
        }),
        "cloud" => Ok(Levels::Cloud { scale: spec.scale.unwrap_or(1.0) }),
        "stripes" => {
            needed("[[levels.stripe]]")?;
            Ok(Levels::Stripes(spec.stripe.iter().map(|stripe| to_si(stripe.get_ref().intensity)).collect()))
        }
        "step" => Ok(Levels::ToOverturning { step: needed("step")?, top: needed("top")? }),
        _ => match (&spec.values, spec.step, spec.top) {
            (Some(values), None, None) => Ok(Levels::Grid(values.iter().map(|&x| to_si(x)).collect())),
            (None, Some(step), Some(top)) => {
                // bounded before it is counted: a study takes no more than 2000
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 2001")]
                let count = (top / step * (1.0 + 1e-12)).floor().clamp(0.0, 2001.0) as u32;
                Ok(Levels::Grid((1..=count).map(|k| to_si(step * f64::from(k))).collect()))
            }
            _ => Err(place.error(table.span(), "method = \"grid\" needs values, or step and top")),
        },
    }
}

/// Returns what converts intensities of a file, in a unit or without one in that of the results, to SI units.
pub(super) fn to_si(
    measure: &IntensityMeasure,
    unit: Option<&Spanned<String>>,
    place: &Place<'_>,
) -> Result<ToSi, FileError> {
    let given = unit.map(|unit| unit.get_ref().as_str());
    measure.to_si(given).map_err(|message| match unit {
        Some(unit) => place.error(unit.span(), message),
        None => unreachable!("a measure knows its own unit: {message}"),
    })
}
