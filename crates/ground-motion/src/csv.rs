//! Records as comma-separated values, in one of two forms.
//!
//! A table with a header line, the form of importers' input files; the times are uniform, there are no comments:
//!
//! ```text
//! time,a_g
//! 0.000,0.0012
//! 0.005,0.0031
//! ```
//!
//! Or one column of samples, with the step stated beside it; a first line that names the column and lines that start
//! with `#` are passed over. Neither form has a place for the unit, so the unit has to be stated.

use super::error::{Fault, excerpt};
use super::record::{Parsed, ReadOptions, check_stated_step, lines, notes};
use super::{Unit, index_as_f64};

/// Largest deviation of a time from the uniform grid, in steps. Times are often written with few digits.
const TIME_TOLERANCE: f64 = 0.01;

const FORMS: &str = "a header line `time,a_g` and rows of numbers, or one column of numbers (or the header of another format)";

/// Reads the text of a CSV file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let is_comment = |line: &str| line.starts_with('#');
    let Some((number, first)) = lines(text).find(|(_, line)| !is_comment(line)) else {
        let found = if lines(text).next().is_some() { "comments only" } else { "an empty file" };
        return Err(Fault::new(1, FORMS, found, "check that this is the right file"));
    };
    if first.contains(['\t', ';']) {
        let remedy = "separate the columns by commas and write decimal points";
        return Err(Fault::new(number, "columns separated by commas", excerpt(first), remedy));
    }
    let parsed = if first.contains(',') { table(text, options)? } else { column(text, options)? };
    if options.unit.is_none() {
        let remedy = "give `unit` (on the command line --unit): m/s2, cm/s2, mm/s2 or g";
        return Err(Fault::new(number, "a stated unit (a CSV file has none)", "no unit", remedy));
    }
    Ok(parsed)
}

/// The unit to convert from. Without one the values stay as they are: `parse` refuses the file once the rest is sound.
fn unit(options: &ReadOptions) -> Unit {
    options.unit.unwrap_or(Unit::MetrePerSecondSquared)
}

/// One column of samples.
fn column(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let unit = unit(options);
    let mut samples = Vec::new();
    let mut name = None;
    let mut last_line = 1;
    for (number, line) in lines(text).filter(|(_, line)| !line.starts_with('#')) {
        last_line = number;
        if samples.is_empty() && name.is_none() && is_name(line) {
            name = Some((number, unquoted(line)));
            continue;
        }
        samples.push(unit.to_si(real(line, number)?));
        check_finite(&samples, line, number)?;
    }
    if let Some(wanted) = &options.column
        && name.is_none_or(|(_, name)| name != wanted)
    {
        let found = name.map_or_else(|| "one column without a name".to_owned(), |(_, name)| excerpt(name));
        let line = name.map_or(1, |(number, _)| number);
        return Err(Fault::new(line, format!("the column {}", excerpt(wanted)), found, "state no column"));
    }
    let Some(step) = options.step else {
        let remedy = "state the step in seconds as `step` (on the command line --record-step), or give the file a `time` column";
        return Err(Fault::new(last_line, "a stated step (one column has none)", "no step", remedy));
    };
    let comments = lines(text).map_while(|(_, line)| line.strip_prefix('#')).map(str::trim);
    let notes = notes(comments.chain(name.map(|(_, name)| name)));
    Ok(Parsed::new(step, samples, unit, last_line, notes))
}

/// A table: a header line, then rows that start with the time.
fn table(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let mut rows = lines(text);
    let (header_line, header) = rows.next().unwrap_or((1, ""));
    refuse_comment(header, header_line)?;
    let names: Vec<&str> = header.split(',').map(unquoted).collect();
    let chosen = chosen_column(&names, header_line, options.column.as_deref())?;

    let unit = unit(options);
    let mut times = Times::default();
    let mut samples = Vec::new();
    for (number, line) in rows {
        refuse_comment(line, number)?;
        let found = line.split(',').count();
        if found != names.len() {
            let expected = format!("{} values, one for each column", names.len());
            return Err(Fault::new(
                number,
                expected,
                format!("{found} in {}", excerpt(line)),
                "complete the row",
            ));
        }
        let mut cells = line.split(',');
        times.push(real(cells.next().unwrap_or_default(), number)?, number)?;
        let cell = cells.nth(chosen - 1).unwrap_or_default();
        samples.push(unit.to_si(real(cell, number)?));
        check_finite(&samples, cell, number)?;
    }
    let last_line = times.0.last().map_or(header_line, |&(line, _)| line);
    let Some((first_time, step)) = times.uniform()? else {
        let found = samples.len().to_string();
        return Err(Fault::new(last_line, "at least two rows", found, "check that the file is complete"));
    };
    check_stated_step(options.step, step, header_line)?;
    let mut parsed = Parsed::new(step, samples, unit, last_line, notes([header].into_iter()));
    parsed.first_time = first_time;
    Ok(parsed)
}

/// Index of the column to read; column 0 is the time.
fn chosen_column(names: &[&str], line: usize, wanted: Option<&str>) -> Result<usize, Fault> {
    let listed = || excerpt(&names.join(","));
    let is_time =
        |name: &str| ["time", "time_s", "time [s]", "time (s)", "t"].contains(&name.to_lowercase().as_str());
    if !is_time(names[0]) {
        let remedy = "the first column must be `time`, in seconds, with a header line that names the columns";
        return Err(Fault::new(line, FORMS, listed(), remedy));
    }
    let Some(wanted) = wanted else {
        if names.len() == 2 {
            return Ok(1);
        }
        return Err(Fault::new(
            line,
            "one column beside `time`",
            listed(),
            "state the name of the column to read",
        ));
    };
    let mut matches = (1..names.len()).filter(|&column| names[column] == wanted);
    match (matches.next(), matches.next()) {
        (Some(column), None) => Ok(column),
        (None, _) => Err(Fault::new(
            line,
            format!("a column {}", excerpt(wanted)),
            listed(),
            "state one of these columns",
        )),
        (Some(_), Some(_)) => Err(Fault::new(
            line,
            format!("one column {}", excerpt(wanted)),
            listed(),
            "give each column its own name",
        )),
    }
}

/// The lines of a table and the times on them (s).
#[derive(Default)]
struct Times(Vec<(usize, f64)>);

impl Times {
    /// Takes the next time; it must follow at the first step's distance.
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

    /// The first time and the mean step. Steps that change slowly leave the uniform grid and are refused.
    fn uniform(&self) -> Result<Option<(f64, f64)>, Fault> {
        let [(_, first), .., (_, last)] = self.0[..] else { return Ok(None) };
        let step = rounded((last - first) / index_as_f64(self.0.len() - 1));
        for (index, &(line, time)) in self.0.iter().enumerate() {
            let due = first + index_as_f64(index) * step;
            if (time - due).abs() > TIME_TOLERANCE * step {
                let expected = format!("{} s, at the mean step of {step} s", rounded(due));
                return Err(Fault::new(
                    line,
                    expected,
                    format!("{time} s"),
                    "resample the record to a uniform step",
                ));
            }
        }
        Ok(Some((first, step)))
    }
}

/// The number to twelve digits: steps are decimal fractions, quotients of sums of them are not quite.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

fn refuse_comment(line: &str, number: usize) -> Result<(), Fault> {
    if line.starts_with('#') {
        let remedy = "remove the comment: a table with a `time` column has none";
        return Err(Fault::new(number, "a header line or a row of numbers", excerpt(line), remedy));
    }
    Ok(())
}

/// Whether a line names its column: it starts with a letter and is no number (`nan` and `inf` are).
fn is_name(line: &str) -> bool {
    unquoted(line).starts_with(char::is_alphabetic) && line.parse::<f64>().is_err()
}

fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

fn real(cell: &str, line: usize) -> Result<f64, Fault> {
    let value = cell.trim().parse().ok().filter(|value: &f64| value.is_finite());
    let remedy = "correct the value; columns are separated by commas, decimals by a point";
    value.ok_or_else(|| Fault::new(line, "a finite number", excerpt(cell), remedy))
}

/// The last sample must still be finite after its conversion.
fn check_finite(samples: &[f64], cell: &str, line: usize) -> Result<(), Fault> {
    match samples.last() {
        Some(value) if !value.is_finite() => {
            Err(Fault::new(line, "a finite acceleration", excerpt(cell), "check the value and the unit"))
        }
        _ => Ok(()),
    }
}
