//! Hazard curves from files: two columns, or a table of `OpenQuake`.

use files::{FileError, Place};
use fragility::hazard::{HazardCurve, SWAPPED};
use ground_motion::columns::{Columns, Fault, Name, Numbers, TextRow};

use crate::ida::IntensityMeasure;

/// A curve, intensities in SI units, and what was left out or could not be checked.
type Read = (HazardCurve, Vec<String>);

const FORMS: &str = "a line of names with a measure or `intensity` and `annual_rate`, or a hazard-curve CSV \
                     of OpenQuake";

/// Reads the hazard curve of a study's measure from a file; `unit` is that of the intensities of two columns
/// whose name states none, and `site` is the number from 1 of a site of `OpenQuake`, which alone has sites.
///
/// # Errors
/// [`FileError`] with line, value and remedy: the file is of another measure, a cell is no number, there is
/// no such site, or the points are no hazard curve.
pub(super) fn read(
    file: &Place<'_>,
    measure: &IntensityMeasure,
    unit: Option<&str>,
    site: Option<u32>,
) -> Result<Read, FileError> {
    let text = file.text().trim_start_matches('\u{feff}');
    let read = || {
        let columns = Columns::of_texts(text, FORMS).map_err(in_file)?;
        let rows: Vec<_> = columns.rows().collect::<Result<_, _>>().map_err(in_file)?;
        match (comment(text), unit, site) {
            (Some((line, _)), Some(_), _) => Err((
                line,
                "a table of OpenQuake has units of its own; leave out unit of [hazard]".to_owned(),
            )),
            (Some((line, comment)), ..) => open_quake(line, comment, &columns, &rows, measure, site),
            (None, _, Some(_)) => {
                let message = "site of [hazard] belongs to a table of OpenQuake; leave it out";
                Err((columns.line(), message.to_owned()))
            }
            (None, ..) => two_columns(&columns, measure, unit),
        }
    };
    read().map_err(|(line, message)| file.error_on(line, message))
}

/// The line of what is wrong, and the message.
type LineFault = (usize, String);

#[allow(clippy::needless_pass_by_value, reason = "`map_err` hands it over")]
fn in_file(fault: Fault) -> LineFault {
    (fault.line(), fault.to_string())
}

/// Return period at which the intensities of sites are compared \[years\].
const PERIOD: f64 = 2475.0;

/// Return period at which probabilities and percentages in place of rates are noticed \[years\], and the
/// largest intensity there relative to the usual ones: .125 g for PGA, which no site exceeds.
const SHORT_PERIOD: f64 = 10.0;
const LARGEST: f64 = 1.0 / 16.0;

/// Warns of a curve in another unit than the study states, or of other numbers than rates.
pub(super) fn unusual(curve: &HazardCurve, measure: &IntensityMeasure) -> Option<String> {
    let (usual, unit) = (measure.usual(), measure.unit());
    let at = |period: f64| unit.of(curve.intensity(1.0 / period));
    if let Some(warning) = usual.warning(at(PERIOD)) {
        return Some(format!("at a return period of {PERIOD} years, {warning}; state its unit"));
    }
    let often = at(SHORT_PERIOD);
    let points = curve.points();
    let lowest = points[points.len() - 1][1];
    // walls fall more rarely than once in a hundred years
    if lowest > 0.01 {
        return Some(format!("the lowest annual rate is {lowest}{SWAPPED}"));
    }
    let begins = points[0][1] >= 1.0 / SHORT_PERIOD;
    (begins && often > LARGEST * usual.range[1]).then(|| {
        format!(
            "{} = {often:.3} {} every {SHORT_PERIOD} years is more than any site has; are these annual \
             rates, and not probabilities in 50 years or per cent? A probability P in t years is a rate of \
             -ln(1 - P)/t",
            usual.name, usual.unit
        )
    })
}

/// Returns the comment that begins a table of `OpenQuake`, and its line.
fn comment(text: &str) -> Option<(usize, &str)> {
    let mut lines = (1..).zip(text.lines().map(str::trim));
    let first = lines.find(|(_, line)| !line.is_empty())?;
    (first.1.starts_with('#') && first.1.contains("investigation_time")).then_some(first)
}

fn two_columns(
    columns: &Columns<'_>,
    measure: &IntensityMeasure,
    unit: Option<&str>,
) -> Result<Read, LineFault> {
    let (line, names) = (columns.line(), columns.names());
    let [name, rate] = names else {
        let found: Vec<_> = names.iter().map(Name::written).collect();
        return Err((line, format!("expected {FORMS}, found {found:?}")));
    };
    if rate.written() != "annual_rate" {
        return Err((line, format!("expected {FORMS}, found {:?}", rate.written())));
    }
    let given = measure.to_si(unit).map_err(|message| (line, message))?;
    // brackets may hold a period, too
    let is_measure = name.text() == "intensity" || same_measure(name.text(), measure).is_ok();
    let own = name.unit().filter(|_| is_measure).map(|own| Ok((own, measure.to_si(Some(own))?)));
    let own = own.transpose().map_err(|message| (line, message))?;
    if let (Some((own, of_name)), Some(unit)) = (own, unit)
        && of_name(1.0) != given(1.0)
    {
        let message = format!("the column states {own}, the study unit = {unit:?}; leave out unit");
        return Err((line, message));
    }
    let (name, to_si) = own.map_or((name.written(), given), |(_, to_si)| (name.text(), to_si));
    let warning = if name == "intensity" { Ok(None) } else { same_measure(name, measure) };
    let warning = warning.map_err(|message| (line, message))?;
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    let read = columns.read(1, |intensity, rate, line| {
        points.push([intensity, rate]);
        lines.push(line);
        Ok(())
    });
    read.map_err(in_file)?;
    let curve = HazardCurve::converted(points, to_si)
        .map_err(|error| (error.point.map_or(line, |point| lines[point - 1]), error.to_string()))?;
    let unusual = unusual(&curve, measure);
    Ok((curve, warning.into_iter().chain(unusual).collect()))
}

/// Reads a table of `OpenQuake`: a comment, a line of names, and one site in a row. A probability P in t
/// years is a rate of −ln(1 − P)/t; levels are in the unit of results.
fn open_quake(
    line: usize,
    comment: &str,
    columns: &Columns<'_>,
    rows: &[TextRow<'_>],
    measure: &IntensityMeasure,
    site: Option<u32>,
) -> Result<Read, LineFault> {
    // an imt may have brackets, but no comma: SA(0.5)
    let stated = |key: &str| {
        let found = comment
            .split_once(&format!("{key}="))
            .and_then(|(_, after)| after.trim_start_matches('\'').split([',', '\'', '"']).next());
        found.ok_or_else(|| (line, format!("the comment has no {key}=, which OpenQuake writes")))
    };
    let years = stated("investigation_time")?;
    let positive = years.parse().ok().filter(|years: &f64| *years > 0.0 && years.is_finite());
    let wrong = || (line, format!("investigation_time={years} years must be positive and finite"));
    let years = positive.ok_or_else(wrong)?;
    let warning = same_measure(stated("imt")?, measure).map_err(|message| (line, message))?;
    let mut warnings: Vec<_> = warning.into_iter().collect();
    let statistic = stated("kind").ok().filter(|kind| *kind != "mean");
    warnings.extend(statistic.map(|kind| format!("these are rates of {kind}; the mean is usual")));
    let (heading, count) = (columns.line(), rows.len());
    if count == 0 {
        let message = "the table has no row below its names; give one with at least one site";
        return Err((heading, message.into()));
    }
    let at = site.map_or(1, |site| site as usize);
    if !(1..=count).contains(&at) || (site.is_none() && count > 1) {
        let found = site.map_or_else(String::new, |site| format!(", and not site {site}"));
        return Err((
            heading,
            format!("the table has {count} sites{found}; give site = n, from 1 to {count}"),
        ));
    }
    let (row, unit) = (rows[at - 1], measure.unit());
    let (mut points, mut numbers) = (Vec::new(), Numbers::new(columns));
    for (name, cell) in columns.names().iter().zip(row.cells()) {
        let Some(level) = name.written().strip_prefix("poe-") else { continue };
        let no_level = |_| (heading, format!("{level:?} of {:?} is not a number", name.written()));
        let level: f64 = level.parse().map_err(no_level)?;
        let poe = numbers.real(&cell, row.line).map_err(in_file)?;
        if !(0.0..=1.0).contains(&poe) {
            let message = format!("the probability {poe} at {level} {} must be from 0 to 1", unit.name());
            return Err((row.line, message));
        }
        points.push([level, -libm::log1p(-poe) / years]);
    }
    if points.is_empty() {
        return Err((heading, "no column is named poe-LEVEL, as OpenQuake names them".into()));
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
    let curve = HazardCurve::converted(points, |level| level * unit.size());
    let curve = curve.map_err(|error| (row.line, error.to_string()))?;
    warnings.extend(unusual(&curve, measure));
    Ok((curve, warnings))
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

    const OPEN_QUAKE: &str = "#,,,,\"generated_by='OpenQuake engine 3.16.3', checksum=1, kind='mean', \
        investigation_time=50.0, imt='SA(0.5)'\"\n\
        lon,lat,depth,poe-0.0500000,poe-0.1000000,poe-0.2000000,poe-0.4000000,poe-0.8000000\n\
        12.0,42.0,0.0,1.000000E+00,5.0E-01,1.0E-01,2.0E-02,0.0\n\
        13.0,42.0,0.0,9.0E-01,9.0E-01,2.0E-01,4.0E-02,1.0E-02\n";

    #[test]
    fn tables_of_openquake_have_rates() {
        let measure = IntensityMeasure::Sa { period: 0.5 };
        let file = Place::new("oq.csv", OPEN_QUAKE);
        let read = |site| read(&file, &measure, None, site);
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
        for (kind, told) in [("quantile-0.95", true), ("mean", false)] {
            let text = OPEN_QUAKE.replace("kind='mean'", &format!("kind='{kind}'"));
            let (_, warnings) = super::read(&Place::new("oq.csv", &text), &measure, None, Some(2)).unwrap();
            let words = format!("these are rates of {kind}; the mean is usual");
            assert_eq!(warnings.contains(&words), told, "{warnings:?}");
        }
        let empty = OPEN_QUAKE.split_inclusive('\n').take(2).collect::<String>();
        let told = super::read(&Place::new("oq.csv", &empty), &measure, None, None).unwrap_err().to_string();
        assert!(told.contains("line 2") && told.contains("has no row"), "{told}");
        let other = super::read(&file, &IntensityMeasure::Pga, None, Some(1));
        let told = other.unwrap_err().to_string();
        assert!(told.contains("line 1") && told.contains("\"SA(0.5)\", the study of PGA"), "{told}");
    }

    #[test]
    fn tables_of_openquake_are_read_as_excel_saves_them() {
        let saved = OPEN_QUAKE.replace(',', ";").replace('.', ",").replace("poe-0,", "poe-0.");
        let saved = saved.replace("; ", ", ").replace("50,0", "50.0").replace("0,5)", "0.5)");
        let measure = IntensityMeasure::Sa { period: 0.5 };
        let read = |text| read(&Place::new("oq.csv", text), &measure, None, Some(2)).unwrap();
        assert!(saved.contains("13,0;42,0;0,0;9,0E-01"), "{saved}");
        assert_eq!(read(&saved), read(OPEN_QUAKE));
    }

    #[test]
    fn two_columns_have_a_unit_and_their_measure() {
        let of = |text, unit| read(&Place::new("a.csv", text), &IntensityMeasure::Pga, unit, None);
        let read = |text| of(text, None);
        let table = read("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-3\n").unwrap();
        assert_eq!(table.0.points(), [[0.980_665, 1e-2], [1.961_33, 2e-3]]);
        for text in [
            "intensity, annual_rate\n0.1, 1e-2\n0.2, 2e-3\n",
            "PGA;annual_rate\r\n0,1;0,01\r\n0,2;0,002\r\n",
            "\u{feff}PGA\tannual_rate\n0,1\t1E-2\n0,2\t2E-3\n",
            "PGA annual_rate\n0.1 1e-2\n0.2 2e-3\n",
            "\"PGA\",\"annual_rate\"\n\"0,1\",\"0,01\"\n\"0,2\",\"0,002\"\n",
            "# my site\nPGA,annual_rate\n0.1,1e-2\n# strong\n0.2,2e-3\n,\n,\n",
            "PGA [g],annual_rate\n0.1,1e-2\n0.2,2e-3\n",
        ] {
            assert_eq!(read(text).unwrap(), table, "{text}");
            assert_eq!(of(text, Some("g")).unwrap(), table, "{text}");
        }
        let swapped = read("PGA,annual_rate\n1e-4,0.8\n2e-3,0.2\n3e-2,0.05\n").unwrap().1;
        assert!(swapped[0].starts_with("the lowest annual rate is 0.05; are intensity and"), "{swapped:?}");
        let gal = "PGA [cm/s2],annual_rate\n98.0665,1e-2\n196.133,2e-3\n";
        for unit in [None, Some("gal")] {
            let points = of(gal, unit).unwrap().0.points().to_vec();
            assert!((points[1][0] / 1.961_33 - 1.0).abs() < 1e-15, "{points:?}");
        }
        let told = of(gal, Some("g")).unwrap_err().to_string();
        assert!(told.contains("line 1") && told.contains("the column states cm/s2, the study"), "{told}");
        for (text, line, words) in [
            ("", 1, "found an empty file"),
            ("a,b\n", 1, "found \"b\""),
            ("PGA;annual_rate;return_period\n1;1;1\n", 1, "found [\"PGA\", \"annual_rate\", \"ret"),
            ("AvgSA,annual_rate\n0.1,1e-2\n", 1, "the study of PGA"),
            ("PGA [cm],annual_rate\n0.1,1e-2\n", 1, "unit \"cm\" of PGA: expected m/s2"),
            ("PGA,annual_rate\n0.1,x\n", 2, "a finite number, found `x`"),
            ("PGA,annual_rate\n0.1,1e-2\n\n0.2,\n", 4, "a finite number, found ``"),
            ("PGA,annual_rate\n0.1,1e-2\n\n0.2,2e-2\n", 4, "must be below 0.01"),
            ("PGA,annual_rate\n1.6,5e-6\n0.8,5e-5\n", 3, "intensity 0.8 must be above 1.6"),
            ("PGA;annual_rate\n0,1;0,01\n0.2;0.002\n", 3, "`,` before the decimals, as on line 2"),
            ("PGA,annual_rate\n0.1,1e-2,3\n", 2, "found 3"),
        ] {
            let told = read(text).unwrap_err().to_string();
            assert!(told.contains(&format!("line {line}")) && told.contains(words), "{told}");
        }
    }
}
