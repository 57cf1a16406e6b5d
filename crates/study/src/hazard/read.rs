//! Hazard curves from files: two columns, or a table of `OpenQuake`.

use rocking_wall::scene::{Place, SceneError};

use crate::ida::{IntensityMeasure, ToSi};

use super::curve::HazardCurve;

/// A curve, intensities in SI units, and what was left out or could not be checked.
type Read = (HazardCurve, Vec<String>);

const FORMS: &str = "expected a line of names with a measure or \"intensity\" and \"annual_rate\", or a \
                     hazard-curve CSV of OpenQuake";

/// Reads the hazard curve of a study's measure from a file; `to_si` converts the intensities of two columns,
/// and `site` is the number from 1 of a site of `OpenQuake`, which alone has sites.
///
/// # Errors
/// [`SceneError`] with line, value and remedy: the file is of another measure, a cell is no number, there is
/// no such site, or the points are no hazard curve.
pub fn read(
    file: &Place<'_>,
    measure: &IntensityMeasure,
    to_si: ToSi,
    site: Option<u32>,
) -> Result<Read, SceneError> {
    let lines = file.text().trim_start_matches('\u{feff}').lines().zip(1..);
    let lines: Vec<_> =
        lines.map(|(text, line)| (line, text.trim())).filter(|(_, text)| !text.is_empty()).collect();
    let Some((first, rest)) = lines.split_first() else {
        return Err(file.error_on(1, format!("the file is empty; {FORMS}")));
    };
    if is_open_quake(file.text()) {
        open_quake(file, *first, rest, measure, site)
    } else {
        two_columns(file, *first, rest, measure, to_si)
    }
}

/// Returns whether the text of a file is a table of `OpenQuake`, which begins with a comment.
pub fn is_open_quake(text: &str) -> bool {
    let mut lines = text.trim_start_matches('\u{feff}').lines().map(str::trim);
    let first = lines.find(|line| !line.is_empty());
    first.is_some_and(|line| line.starts_with('#') && line.contains("investigation_time"))
}

fn two_columns(
    file: &Place<'_>,
    (line, names): (usize, &str),
    rows: &[(usize, &str)],
    measure: &IntensityMeasure,
    to_si: ToSi,
) -> Result<Read, SceneError> {
    let cells: Vec<_> = names.split(',').map(str::trim).collect();
    let [name, "annual_rate"] = cells[..] else {
        return Err(file.error_on(line, format!("found {names:?}; {FORMS}")));
    };
    let warning = if name == "intensity" { Ok(None) } else { same_measure(name, measure) };
    let warning = warning.map_err(|message| file.error_on(line, message))?;
    let point = |&(line, row): &(usize, &str)| {
        let numbers: Vec<_> =
            row.split(',').map(|cell| number(file, cell, line)).collect::<Result<_, _>>()?;
        let [x, rate] = numbers[..] else {
            let message = format!("found {} cells, expected an intensity and an annual rate", numbers.len());
            return Err(file.error_on(line, message));
        };
        Ok([to_si(x), rate])
    };
    let points = rows.iter().map(point).collect::<Result<Vec<_>, _>>()?;
    let curve = HazardCurve::new(points).map_err(|error| {
        let line = error.point.map_or(line, |point| rows[point - 1].0);
        file.error_on(line, error.to_string())
    });
    Ok((curve?, warning.into_iter().collect()))
}

/// Reads a table of `OpenQuake`: a comment, a line of names, and one site in a row. A probability P in t
/// years is a rate of −ln(1 − P)/t; levels are in the unit of results.
fn open_quake(
    file: &Place<'_>,
    (line, comment): (usize, &str),
    rest: &[(usize, &str)],
    measure: &IntensityMeasure,
    site: Option<u32>,
) -> Result<Read, SceneError> {
    let fail = |line: usize, message: String| Err(file.error_on(line, message));
    // an imt may have brackets, but no comma: SA(0.5)
    let stated = |key: &str| {
        let found = comment
            .split_once(&format!("{key}="))
            .and_then(|(_, after)| after.trim_start_matches('\'').split([',', '\'', '"']).next());
        let missing = || file.error_on(line, format!("the comment has no {key}=, which OpenQuake writes"));
        found.ok_or_else(missing)
    };
    let years = number(file, stated("investigation_time")?, line)?;
    if !(years > 0.0 && years.is_finite()) {
        return fail(line, format!("investigation_time={years} years must be positive and finite"));
    }
    let warning = same_measure(stated("imt")?, measure).map_err(|message| file.error_on(line, message))?;
    let mut warnings: Vec<_> = warning.into_iter().collect();
    let Some(((heading, names), sites)) = rest.split_first() else {
        return fail(line, "the table ends after its comment".into());
    };
    let count = sites.len();
    if count == 0 {
        return fail(
            *heading,
            "the table has no row below its names; give one with at least one site".into(),
        );
    }
    let at = site.map_or(1, |site| site as usize);
    if !(1..=count).contains(&at) || (site.is_none() && count > 1) {
        let found = site.map_or_else(String::new, |site| format!(", and not site {site}"));
        return fail(
            *heading,
            format!("the table has {count} sites{found}; give site = n, from 1 to {count}"),
        );
    }
    let (line, row) = sites[at - 1];
    let cells: Vec<_> = row.split(',').collect();
    let (mut points, unit) = (Vec::new(), measure.unit());
    for (column, name) in names.split(',').enumerate() {
        let Some(level) = name.trim().strip_prefix("poe-") else { continue };
        let level = number(file, level, *heading)?;
        let Some(cell) = cells.get(column) else {
            return fail(line, format!("the row ends before {level} {}", unit.name()));
        };
        let poe = number(file, cell, line)?;
        if !(0.0..=1.0).contains(&poe) {
            return fail(
                line,
                format!("the probability {poe} at {level} {} must be from 0 to 1", unit.name()),
            );
        }
        points.push([level * unit.size(), -libm::log1p(-poe) / years]);
    }
    if points.is_empty() {
        return fail(*heading, "no column is named poe-LEVEL, as OpenQuake names them".into());
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
    let curve = HazardCurve::new(points).map_err(|error| file.error_on(line, error.to_string()))?;
    Ok((curve, warnings))
}

/// Reads a number.
fn number(file: &Place<'_>, cell: &str, line: usize) -> Result<f64, SceneError> {
    let text = cell.trim();
    text.parse().map_err(|_| file.error_on(line, format!("{text:?} is not a number")))
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
        let file = Place::new("oq.csv", OPEN_QUAKE);
        let read = |site| read(&file, &measure, G, site);
        let (curve, warnings) = read(Some(1)).unwrap();
        let given = [[0.1, 0.5], [0.2, 0.1], [0.4, 0.02]];
        assert_eq!(curve.points().len(), 3, "{warnings:?}");
        for (found, [level, poe]) in curve.points().iter().zip(given) {
            let rate = -(1.0_f64 - poe).ln() / 50.0;
            assert!((found[1] / rate - 1.0).abs() < 1e-14);
            assert_eq!(found[0], level * 9.80665);
        }
        assert!(warnings[0].starts_with("2 of 5 levels"), "{warnings:?}");
        assert_eq!(read(Some(2)).unwrap().0.points().len(), 4);
        for (site, words) in [
            (None, "has 2 sites; give site = n"),
            (Some(3), "2 sites, and not site 3; give site = n, from 1 to 2"),
        ] {
            assert!(read(site).unwrap_err().to_string().contains(words));
        }
        let empty = OPEN_QUAKE.split_inclusive('\n').take(2).collect::<String>();
        let told = super::read(&Place::new("oq.csv", &empty), &measure, G, None).unwrap_err().to_string();
        assert!(told.contains("line 2") && told.contains("has no row"), "{told}");
        let other = super::read(&file, &IntensityMeasure::Pga, G, Some(1));
        let told = other.unwrap_err().to_string();
        assert!(told.contains("line 1") && told.contains("\"SA(0.5)\", the study of PGA"), "{told}");
    }

    #[test]
    fn two_columns_have_a_unit_and_their_measure() {
        let read = |text| read(&Place::new("a.csv", text), &IntensityMeasure::Pga, G, None);
        let table = read("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-3\n").unwrap();
        assert_eq!(table.0.points(), [[0.980_665, 1e-2], [1.961_33, 2e-3]]);
        assert_eq!(read("intensity, annual_rate\n0.1, 1e-2\n0.2, 2e-3\n").unwrap(), table);
        for (text, line, words) in [
            ("", 1, "is empty"),
            ("a,b\n", 1, "found \"a,b\""),
            ("AvgSA,annual_rate\n0.1,1e-2\n", 1, "the study of PGA"),
            ("PGA,annual_rate\n0.1,x\n", 2, "\"x\" is not a number"),
            ("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-2\n", 4, "must be below 0.01"),
            ("PGA,annual_rate\n0.1,1e-2,3\n", 2, "found 3 cells"),
        ] {
            let told = read(text).unwrap_err().to_string();
            assert!(told.contains(&format!("line {line}")) && told.contains(words), "{told}");
        }
    }
}
