//! Records as comma-separated values, in one of two forms.
//!
//! A table with a header line and uniform times, without comments:
//!
//! ```text
//! time,a_g
//! 0.000,0.0012
//! 0.005,0.0031
//! ```
//!
//! Or one column of samples, with the step stated beside it; a first line that names the column and lines
//! that start with `#` are skipped. The unit has to be stated, unless the first name of a table does, as
//! [`CSV_HEADER`] does.

use crate::error::{Fault, excerpt};
use crate::fields::lines;
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;

/// Header of a table of the ground's acceleration in m/s². Importers of FMUs find the input `a_g` by its
/// name, and take the first column for the time under any name; so the unit stands there.
pub const CSV_HEADER: &str = "time (a_g in m/s2),a_g";

/// Largest deviation of a time from the uniform grid, in steps. Times are often written with few digits.
const TIME_TOLERANCE: f64 = 0.01;

const FORMS: &str = "a header line `time,a_g` and rows of numbers, or one column of numbers \
                     (or the header of another format)";

/// Reads the text of a CSV file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Parsed, Fault> {
    let is_comment = |line: &str| line.starts_with('#');
    let Some((number, first)) = lines(text).find(|(_, line)| !is_comment(line)) else {
        let found = if lines(text).next().is_some() { "comments only" } else { "an empty file" };
        return Err(Fault::new(1, FORMS, found, "check that this is the right file"));
    };
    if first.contains(['\t', ';']) {
        let remedy = "separate the columns by commas and write decimal points";
        return Err(Fault::excerpt(number, "columns separated by commas", first, remedy));
    }
    let stated = match stated_unit(first.split(',').next().unwrap_or_default()) {
        Some(word) => Some(options.unit_of(word, number)?),
        None => options.unit,
    };
    // Without a unit the values stay as they are, and the file is refused once the rest is sound.
    let unit = stated.unwrap_or(Unit::MetrePerSecondSquared);
    let parsed = if first.contains(',') { table(text, options, unit)? } else { column(text, options, unit)? };
    if stated.is_none() {
        let remedy = "give `unit` (on the command line --unit): m/s2, cm/s2, mm/s2 or g";
        return Err(Fault::new(number, "a stated unit (a CSV file has none)", "no unit", remedy));
    }
    Ok(parsed)
}

/// Finds the unit in a first name such as `time (a_g in m/s2)`.
fn stated_unit(name: &str) -> Option<&str> {
    let (_, unit) = unquoted(name).strip_prefix("time (")?.strip_suffix(')')?.split_once(" in ")?;
    Some(unit)
}

/// Reads one column of samples.
fn column(text: &str, options: &RecordOptions, unit: Unit) -> Result<Parsed, Fault> {
    let mut parsed = Parsed::new(f64::NAN, unit, 1);
    let mut name = None;
    for (number, line) in lines(text).filter(|(_, line)| !line.starts_with('#')) {
        parsed.last_line = number;
        if parsed.samples.is_empty() && name.is_none() && is_name(line) {
            name = Some((number, unquoted(line)));
            continue;
        }
        parsed.samples.push(sample(line, number, unit)?);
    }
    if let Some(wanted) = &options.column
        && name.is_none_or(|(_, name)| name != wanted)
    {
        let found = name.map_or_else(|| "one column without a name".to_owned(), |(_, name)| excerpt(name));
        let line = name.map_or(1, |(number, _)| number);
        return Err(Fault::new(line, format!("the column {}", excerpt(wanted)), found, "state no column"));
    }
    let Some(step) = options.step else {
        let remedy = "state the step in seconds as `step` (on the command line --record-step), \
                      or give the file a `time` column";
        return Err(Fault::new(parsed.last_line, "a stated step (one column has none)", "no step", remedy));
    };
    parsed.step = step;
    let comments = lines(text).map_while(|(_, line)| line.strip_prefix('#')).map(str::trim);
    parsed.keep_header(comments.chain(name.map(|(_, name)| name)));
    Ok(parsed)
}

/// Reads a table: a header line, then rows that start with the time.
fn table(text: &str, options: &RecordOptions, unit: Unit) -> Result<Parsed, Fault> {
    let mut rows = lines(text);
    let (header_line, header) = rows.next().unwrap_or((1, ""));
    refuse_comment(header, header_line)?;
    let names: Vec<&str> = header.split(',').map(unquoted).collect();
    let chosen = chosen_column(&names, header_line, options.column.as_deref())?;

    let mut parsed = Parsed::new(f64::NAN, unit, header_line);
    let mut times = Times::default();
    for (number, line) in rows {
        refuse_comment(line, number)?;
        let found = line.split(',').count();
        if found != names.len() {
            let expected = format!("{} values, one for each column", names.len());
            let found = format!("{found} in {}", excerpt(line));
            return Err(Fault::new(number, expected, found, "complete the row"));
        }
        let mut cells = line.split(',');
        times.push(real(cells.next().unwrap_or_default(), number)?, number)?;
        parsed.samples.push(sample(cells.nth(chosen - 1).unwrap_or_default(), number, unit)?);
        parsed.last_line = number;
    }
    let Some((first_time, step)) = times.uniform()? else {
        let found = parsed.samples.len().to_string();
        let remedy = "check that the file is complete";
        return Err(Fault::new(parsed.last_line, "at least two rows", found, remedy));
    };
    options.check_step(step, header_line)?;
    (parsed.first_time, parsed.step) = (first_time, step);
    parsed.keep_header([header].into_iter());
    Ok(parsed)
}

/// Finds the index of the column to read; column 0 is the time.
fn chosen_column(names: &[&str], line: usize, wanted: Option<&str>) -> Result<usize, Fault> {
    let refused =
        |expected: String, remedy: &str| Err(Fault::excerpt(line, expected, &names.join(","), remedy));
    let is_time =
        |name: &str| ["time", "time_s", "time [s]", "time (s)", "t"].contains(&name.to_lowercase().as_str());
    if !is_time(names[0]) && stated_unit(names[0]).is_none() {
        let remedy = "the first column must be `time`, in seconds, with a header line that names the columns";
        return refused(FORMS.to_owned(), remedy);
    }
    let Some(wanted) = wanted else {
        let remedy = "state the name of the column to read";
        return if names.len() == 2 { Ok(1) } else { refused("one column beside `time`".to_owned(), remedy) };
    };
    let mut matches = (1..names.len()).filter(|&column| names[column] == wanted);
    match (matches.next(), matches.next()) {
        (Some(column), None) => Ok(column),
        (None, _) => refused(format!("a column {}", excerpt(wanted)), "state one of these columns"),
        (Some(_), Some(_)) => {
            refused(format!("one column {}", excerpt(wanted)), "give each column its own name")
        }
    }
}

/// The lines of a table and the times on them (s).
#[derive(Default)]
struct Times(Vec<(usize, f64)>);

impl Times {
    /// Takes the next time; its distance from the last must be the first step.
    fn push(&mut self, time: f64, line: usize) -> Result<(), Fault> {
        if let Some(&(_, last)) = self.0.last() {
            if time <= last {
                let expected = format!("a time after {last} s");
                return Err(Fault::new(line, expected, format!("{time} s"), "times must increase"));
            }
            let step = time - last;
            let first_step = self.0.get(1).map_or(step, |(_, second)| second - self.0[0].1);
            if !(step.is_finite() && (step - first_step).abs() <= TIME_TOLERANCE * first_step) {
                let expected = format!("the first step of {} s", rounded(first_step));
                let remedy = "resample the record to a uniform step, or write the times with more digits";
                return Err(Fault::new(line, expected, format!("a step of {} s", rounded(step)), remedy));
            }
        }
        self.0.push((line, time));
        Ok(())
    }

    /// Computes the first time and the mean step. Refuses steps that change slowly: they leave the uniform
    /// grid.
    fn uniform(&self) -> Result<Option<(f64, f64)>, Fault> {
        let [(_, first), .., (_, last)] = self.0[..] else { return Ok(None) };
        let step = rounded((last - first) / (self.0.len() - 1) as f64);
        for (index, &(line, time)) in self.0.iter().enumerate() {
            let due = first + index as f64 * step;
            if (time - due).abs() > TIME_TOLERANCE * step {
                let expected = format!("{} s, at the mean step of {step} s", rounded(due));
                let remedy = "resample the record to a uniform step";
                return Err(Fault::new(line, expected, format!("{time} s"), remedy));
            }
        }
        Ok(Some((first, step)))
    }
}

/// Rounds to twelve digits: steps are decimal fractions, and quotients of their sums are so up to rounding.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn refuse_comment(line: &str, number: usize) -> Result<(), Fault> {
    if line.starts_with('#') {
        let remedy = "remove the comment: a table with a `time` column has none";
        return Err(Fault::excerpt(number, "a header line or a row of numbers", line, remedy));
    }
    Ok(())
}

/// Returns whether a line names its column: it starts with a letter and is not a number, as `nan` and `inf`
/// are.
fn is_name(line: &str) -> bool {
    unquoted(line).starts_with(char::is_alphabetic) && line.parse::<f64>().is_err()
}

fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

fn real(cell: &str, line: usize) -> Result<f64, Fault> {
    let value = cell.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let remedy = "correct the value; columns are separated by commas, decimals by a point";
    value.ok_or_else(|| Fault::excerpt(line, "a finite number", cell, remedy))
}

/// Reads the sample (m/s²) of a cell.
fn sample(cell: &str, line: usize, unit: Unit) -> Result<f64, Fault> {
    let sample = Some(unit.to_si(real(cell, line)?)).filter(|sample| sample.is_finite());
    sample.ok_or_else(|| Fault::excerpt(line, "a finite acceleration", cell, "check the value and the unit"))
}
