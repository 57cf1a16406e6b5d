//! Hazard curves from files: two columns, or a table of `OpenQuake`.

use crate::ida::{IntensityMeasure, ToSi};

use super::curve::{HazardCurve, HazardError};

/// Why a file has no hazard curve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ReadError {
    /// Line from 1; `None` for the file as a whole.
    pub line: Option<usize>,
    /// What is wrong, and the remedy.
    pub message: String,
}

/// A curve of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The curve, intensities in SI units.
    pub curve: HazardCurve,
    /// What was left out or could not be checked.
    pub warnings: Vec<String>,
}

const FORMS: &str = "expected a line of names with a measure or \"intensity\" and \"annual_rate\", or a \
                     hazard-curve CSV of OpenQuake";

/// Reads the hazard curve of a study's measure from the text of a file; `to_si` converts the
/// intensities of two columns, and `site` is the number from 1 of a site of `OpenQuake`.
///
/// # Errors
/// [`ReadError`] with line, value and remedy: the file is of another measure, a cell is no number, there is
/// no such site, or the points are no hazard curve.
pub fn read(
    text: &str,
    measure: &IntensityMeasure,
    (to_si, has_unit): (ToSi, bool),
    site: Option<u32>,
) -> Result<Table, ReadError> {
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let lines: Vec<_> =
        lines.map(|(k, line)| (k + 1, line.trim())).filter(|(_, line)| !line.is_empty()).collect();
    let Some((first, rest)) = lines.split_first() else {
        return Err(ReadError { line: None, message: format!("the file is empty; {FORMS}") });
    };
    if first.1.starts_with('#') && first.1.contains("investigation_time") {
        if has_unit {
            let message = "a hazard-curve CSV of OpenQuake has units of its own; leave out unit";
            return Err(ReadError { line: None, message: message.into() });
        }
        return open_quake(*first, rest, measure, site);
    }
    if site.is_some() {
        let message = "site belongs to a hazard-curve CSV of OpenQuake; leave it out for two columns";
        return Err(ReadError { line: None, message: message.into() });
    }
    two_columns(*first, rest, measure, to_si)
}

fn two_columns(
    (line, names): (usize, &str),
    rows: &[(usize, &str)],
    measure: &IntensityMeasure,
    to_si: ToSi,
) -> Result<Table, ReadError> {
    let fail = |message: String| ReadError { line: Some(line), message };
    let cells: Vec<_> = names.split(',').map(str::trim).collect();
    let [name, "annual_rate"] = cells[..] else {
        return Err(fail(format!("found {names:?}; {FORMS}")));
    };
    let warnings = if name == "intensity" { None } else { same_measure(name, measure).map_err(fail)? };
    let point = |&(line, row): &(usize, &str)| {
        let numbers: Vec<_> = row.split(',').map(|cell| number(cell, line)).collect::<Result<_, _>>()?;
        let [x, rate] = numbers[..] else {
            let message = format!("found {} cells, expected an intensity and an annual rate", numbers.len());
            return Err(ReadError { line: Some(line), message });
        };
        Ok([to_si(x), rate])
    };
    let points = rows.iter().map(point).collect::<Result<Vec<_>, _>>()?;
    let place = |error: HazardError| {
        let point = match error {
            HazardError::TooFew { .. } => None,
            HazardError::Value { point, .. }
            | HazardError::Intensity { point, .. }
            | HazardError::Rate { point, .. } => Some(point),
        };
        let line = point.and_then(|point| rows.get(point - 1)).map(|row| row.0);
        ReadError { line, message: error.to_string() }
    };
    Ok(Table { curve: HazardCurve::new(points).map_err(place)?, warnings: warnings.into_iter().collect() })
}

/// Reads a table of `OpenQuake`: a comment, a line of names, and one site in a row. A probability P in t
/// years is a rate of −ln(1 − P)/t; levels are in the unit of
/// results.
fn open_quake(
    (line, comment): (usize, &str),
    rest: &[(usize, &str)],
    measure: &IntensityMeasure,
    site: Option<u32>,
) -> Result<Table, ReadError> {
    let fail = |line: usize, message: String| ReadError { line: Some(line), message };
    let stated = |key: &str| {
        let (_, after) = comment.split_once(&format!("{key}="))?;
        let end = after.trim_start_matches('\'').find([',', '\'', '"']);
        let text = after.trim_start_matches('\'');
        Some(text[..end.unwrap_or(text.len())].to_owned())
    };
    let needed = |key: &str| {
        stated(key).ok_or_else(|| fail(line, format!("the comment has no {key}=, which OpenQuake writes")))
    };
    let years = number(&needed("investigation_time")?, line)?;
    if !(years > 0.0 && years.is_finite()) {
        return Err(fail(line, format!("investigation_time={years} years must be positive and finite")));
    }
    let mut warnings = Vec::new();
    // an imt may have brackets, but no comma: SA(0.5)
    warnings.extend(same_measure(&needed("imt")?, measure).map_err(|message| fail(line, message))?);
    let Some(((heading, names), sites)) = rest.split_first().map(|(first, sites)| (*first, sites)) else {
        return Err(fail(line, "the table ends after its comment".into()));
    };
    let level = |(column, name): (usize, &str)| {
        let level = name.trim().strip_prefix("poe-")?;
        Some(number(level, heading).map(|level| (column, level)))
    };
    let levels = names.split(',').enumerate().filter_map(level).collect::<Result<Vec<_>, _>>()?;
    if levels.is_empty() {
        return Err(fail(heading, "no column is named poe-LEVEL, as OpenQuake names them".into()));
    }
    let at = match (site, sites.len()) {
        (None, 1) => 0,
        (Some(site), count) if (1..=count).contains(&(site as usize)) => site as usize - 1,
        (None, count) => return Err(fail(heading, format!("the table has {count} sites; give site = n"))),
        (Some(site), count) => {
            return Err(fail(
                heading,
                format!("site = {site} must be from 1 to {count}, those of the table"),
            ));
        }
    };
    let (line, row) = sites[at];
    let cells: Vec<_> = row.split(',').collect();
    let (mut points, unit) = (Vec::new(), measure.unit());
    for (column, level) in levels {
        let cell = cells
            .get(column)
            .ok_or_else(|| fail(line, format!("the row ends before {level} {}", unit.name())))?;
        let poe = number(cell, line)?;
        if !(0.0..=1.0).contains(&poe) {
            return Err(fail(
                line,
                format!("the probability {poe} at {level} {} must be from 0 to 1", unit.name()),
            ));
        }
        points.push([level * unit.size(), -libm::log1p(-poe) / years]);
    }
    let all = points.len();
    // the certain and the impossible have no rate; at its ends a table repeats what its digits cannot tell
    points.retain(|[_, rate]| *rate > 0.0 && rate.is_finite());
    let equal = points.windows(2).take_while(|pair| pair[0][1] == pair[1][1]).count();
    points.drain(..equal);
    if points.len() < all {
        let left = all - points.len();
        warnings.push(format!("{left} of {all} levels have a probability of 0, of 1 or of the next level"));
    }
    let curve = HazardCurve::new(points).map_err(|error| fail(line, error.to_string()))?;
    Ok(Table { curve, warnings })
}

/// Reads a number.
fn number(cell: &str, line: usize) -> Result<f64, ReadError> {
    let text = cell.trim();
    text.parse().map_err(|_| ReadError { line: Some(line), message: format!("{text:?} is not a number") })
}

/// Refuses the name of another measure; warns where a name does not tell the periods.
fn same_measure(name: &str, measure: &IntensityMeasure) -> Result<Option<String>, String> {
    let spectral = |name: &str| -> Option<f64> {
        let lower = name.to_ascii_lowercase();
        let inner = lower.strip_prefix("sa(")?.strip_suffix(')')?;
        inner.trim().trim_end_matches('s').trim().parse().ok()
    };
    let is_same = match measure {
        IntensityMeasure::Sa { period } => spectral(name) == Some(*period),
        IntensityMeasure::Arias => ["Arias", "IA"].iter().any(|own| name.eq_ignore_ascii_case(own)),
        IntensityMeasure::Code { .. } => ["a_g", "ag"].iter().any(|own| name.eq_ignore_ascii_case(own)),
        _ => name.eq_ignore_ascii_case(&measure.name()),
    };
    let own = measure.name();
    if !is_same {
        return Err(format!(
            "the hazard is of {name:?}, the study of {own}; give the hazard of {own}, or change [intensity]"
        ));
    }
    let is_average = matches!(measure, IntensityMeasure::AvgSa { .. });
    Ok(is_average
        .then(|| format!("the hazard must be of {}, which it does not state", measure.description())))
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: ToSi = |x| 9.806_65 * x;

    const OPEN_QUAKE: &str = "#,,,,\"generated_by='OpenQuake engine 3.16.3', checksum=1, kind='mean', \
        investigation_time=50.0, imt='SA(0.5)'\"\n\
        lon,lat,depth,poe-0.0500000,poe-0.1000000,poe-0.2000000,poe-0.4000000,poe-0.8000000\n\
        12.0,42.0,0.0,1.000000E+00,5.0E-01,1.0E-01,2.0E-02,0.0\n\
        13.0,42.0,0.0,9.0E-01,9.0E-01,2.0E-01,4.0E-02,1.0E-02\n";

    #[test]
    fn tables_of_openquake_have_rates() {
        let measure = IntensityMeasure::Sa { period: 0.5 };
        let read = |site| read(OPEN_QUAKE, &measure, (G, false), site);
        let Table { curve, warnings } = read(Some(1)).unwrap();
        let given = [[0.1, 0.5], [0.2, 0.1], [0.4, 0.02]];
        assert_eq!(curve.points().len(), 3, "{warnings:?}");
        for (found, [level, poe]) in curve.points().iter().zip(given) {
            let rate = -(1.0_f64 - poe).ln() / 50.0;
            assert!((found[1] / rate - 1.0).abs() < 1e-14);
            assert_eq!(found[0], level * 9.80665);
        }
        assert!(warnings[0].starts_with("2 of 5 levels"), "{warnings:?}");
        assert_eq!(read(Some(2)).unwrap().curve.points().len(), 4);
        for (site, words) in [(None, "has 2 sites; give site = n"), (Some(3), "must be from 1 to 2")] {
            assert!(read(site).unwrap_err().message.contains(words));
        }
        let other = super::read(OPEN_QUAKE, &IntensityMeasure::Pga, (G, false), Some(1));
        let told = super::read(OPEN_QUAKE, &measure, (G, true), Some(1)).unwrap_err();
        assert!(told.message.contains("leave out unit"), "{told}");
        let told = other.unwrap_err();
        assert!(told.line == Some(1) && told.message.contains("\"SA(0.5)\", the study of PGA"), "{told}");
    }

    #[test]
    fn two_columns_have_a_unit_and_their_measure() {
        let read = |text| read(text, &IntensityMeasure::Pga, (G, false), None);
        let table = read("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-3\n").unwrap();
        assert_eq!(table.curve.points(), [[0.980_665, 1e-2], [1.961_33, 2e-3]]);
        assert_eq!(read("intensity, annual_rate\n0.1, 1e-2\n0.2, 2e-3\n").unwrap(), table);
        for (text, line, words) in [
            ("", None, "is empty"),
            ("a,b\n", Some(1), "found \"a,b\""),
            ("AvgSA,annual_rate\n0.1,1e-2\n", Some(1), "the study of PGA"),
            ("PGA,annual_rate\n0.1,x\n", Some(2), "\"x\" is not a number"),
            ("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-2\n", Some(4), "must be below 0.01"),
            ("PGA,annual_rate\n0.1,1e-2,3\n", Some(2), "found 3 cells"),
        ] {
            let told = read(text).unwrap_err();
            assert!(told.line == line && told.message.contains(words), "{told:?}");
        }
    }
}
