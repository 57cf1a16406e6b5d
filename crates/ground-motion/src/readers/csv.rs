//! Records as text tables, in one of three forms.
//!
//! A table with a header line, whose first column is the time in seconds:
//!
//! ```text
//! time,a_g
//! 0.000,0.0012
//! 0.005,0.0031
//! ```
//!
//! Times and accelerations without a header line. Or one column of samples, with the step stated beside it; a
//! first line may name it, with its unit in brackets.
//!
//! Commas, semicolons, tabs or blanks separate the columns. Beside semicolons, tabs and blanks, decimals may
//! have a comma. Times are uniform. Lines that start with `#` or `%` are skipped, and so are titles above a
//! header line. The unit has to be stated, unless the header line has it in brackets: `t [s],a [g]`, or as in
//! [`CSV_HEADER`]. [`crate::columns`] has the rest.

use crate::check::Warning;
use crate::columns::{Columns, Name};
use crate::error::{Fault, excerpt};
use crate::options::{RecordOptions, is_close};
use crate::parsed::Parsed;
use crate::quantity::Quantity;
use crate::times::Times;
use crate::unit::Unit;

/// Header of a table of the ground's acceleration in m/s². Importers of FMUs find the input `a_g` by its
/// name, so that no unit may follow it. They take the first column for the time whatever its name is, so the
/// unit stands there.
pub const CSV_HEADER: &str = "time (a_g in m/s2),a_g";

const FORMS: &str = "a header line such as `time,a_g` and rows of numbers, times and accelerations in two \
                     columns, or one column of numbers (or the header of another format)";

/// Returns whether one of the first lines is the header line of a table, and the next one a row of it.
pub(super) fn recognises(head: &[&str]) -> bool {
    let text = head.join("\n");
    let Ok(columns) = Columns::of_numbers(&text, is_time, FORMS) else { return false };
    columns.names().len() > 1 && is_time(&columns.names()[0]) && matches!(columns.rows().next(), Some(Ok(_)))
}

/// Returns whether a column is the time: `t`, `time [s]`, `time_s` …
fn is_time(name: &Name) -> bool {
    let words = name.words();
    let is_unit = |word: &String| matches!(Quantity::of(word), Some(Quantity::Time(_)));
    let is_time = words.first().is_some_and(|word| ["t", "time"].contains(&word.as_str()));
    is_time && words[1..].iter().all(is_unit) && words.len() < 3
}

/// Reads the text of a table or a column.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let columns = Columns::of_numbers(text, is_time, FORMS)?;
    let (column, seconds) = if columns.width() == 1 {
        (0, 1.0)
    } else {
        refuse_spectrum(&columns, 1)?;
        let seconds = check_times(&columns, options)?;
        (columns.beside_the_first(options.column.as_deref(), "`time`")?, seconds)
    };
    refuse_spectrum(&columns, column)?;
    let stated = stated_unit(&columns, column, options)?.or(options.unit);
    // Without a unit the values stay as they are, and the file is refused once the rest is sound.
    let mut parsed = Parsed::new(f64::NAN, stated.unwrap_or(Unit::MetrePerSecondSquared), columns.line());
    parsed.keep_header(columns.header());
    parsed.is_vertical = columns.names().get(column).is_some_and(Name::is_vertical);
    if columns.width() == 1 {
        read_column(&columns, options, &mut parsed)?;
    } else {
        read_table(&columns, column, seconds, options, &mut parsed)?;
    }
    if stated.is_none() {
        let remedy = "give `unit` (on the command line --unit): m/s2, cm/s2, mm/s2 or g; or write it into a \
                      header line, `t [s],a [g]`";
        let expected = "a stated unit (this file has none)";
        return Err(Fault::new(columns.line(), expected, "no unit", remedy));
    }
    Ok(vec![parsed])
}

/// Returns how many seconds the unit of the times has. Refuses a first column that is not the time, and times
/// in another unit than seconds where no step is stated.
fn check_times(columns: &Columns<'_>, options: &RecordOptions) -> Result<f64, Fault> {
    let Some(name) = columns.checked_first()? else { return Ok(1.0) };
    let stated = name.stated();
    if !is_time(name) {
        let remedy = "the first column must be `time`, in seconds, with a header line that names the \
                      columns; mark titles with #";
        return Err(Fault::excerpt(columns.line(), FORMS, columns.heading(), remedy));
    }
    match (stated, name.unit()) {
        (Some((_, Quantity::Time(seconds))), _) if seconds == 1.0 || options.step.is_some() => Ok(seconds),
        (None, None) => Ok(1.0),
        // `time (a_g in m/s2)`
        (None, Some(unit)) if unit.contains(" in ") => Ok(1.0),
        (stated, unit) => {
            let last = stated.map(|(unit, _)| unit).unwrap_or_default();
            let unit = unit.unwrap_or(&last);
            let remedy = "write the times in seconds, and so in the header line; or state the step in \
                          seconds as `step` (on the command line --record-step, in Python dt)";
            Err(Fault::excerpt(columns.line(), "times in s", unit, remedy))
        }
    }
}

/// Finds the unit that the names state for a column.
fn stated_unit(columns: &Columns<'_>, column: usize, options: &RecordOptions) -> Result<Option<Unit>, Fault> {
    let Some(name) = columns.names().get(column) else { return Ok(None) };
    if columns.width() > 1 {
        name.refuse_other_quantity(columns.line())?;
    }
    let of_first = columns
        .names()
        .first()
        .and_then(Name::unit)
        .and_then(|unit| unit.split_once(" in "))
        .map(|(_, unit)| unit);
    let unit = match columns.width() {
        // what is in the brackets of a title need not be a unit
        1 => name.unit().filter(|unit| Quantity::of(unit).is_some()),
        _ => name.unit().or(of_first),
    };
    if let Some(unit) = unit {
        return options.unit_of(unit, columns.line()).map(Some);
    }
    Ok(None)
}

/// Refuses a response spectrum: periods in the first column, or a column such as `Sa`. A column `T` beside
/// times is a transverse component.
fn refuse_spectrum(columns: &Columns<'_>, column: usize) -> Result<(), Fault> {
    let names = [columns.names().first(), columns.names().get(column)].into_iter().flatten();
    let is_first_of_several = |index: usize| index == 0 && columns.width() > 1;
    let mut spectral = names.enumerate().filter(|(index, name)| {
        name.says() == Some(Quantity::Spectrum) || is_first_of_several(*index) && name.text() == "T"
    });
    let Some((_, name)) = spectral.next() else { return Ok(()) };
    let expected = "accelerations of the ground at times";
    let remedy = "this is a response spectrum: use the record itself; if it is a record, name its columns \
                  `time` and `a`";
    Err(Fault::excerpt(columns.line(), expected, name.written(), remedy))
}

/// Reads one column of samples.
fn read_column(columns: &Columns<'_>, options: &RecordOptions, parsed: &mut Parsed) -> Result<(), Fault> {
    columns.read(0, |_, sample, line| parsed.push(Some(sample), line, || overflow(sample, line)))?;
    let name = columns.names().first().map(Name::written);
    if let Some(wanted) = &options.column
        && name != Some(wanted)
    {
        let found = name.map_or_else(|| "one column without a name".to_owned(), excerpt);
        let line = if name.is_some() { columns.line() } else { 1 };
        return Err(Fault::new(line, format!("the column {}", excerpt(wanted)), found, "state no column"));
    }
    let Some(step) = options.step else {
        let remedy = "state the step in seconds as `step` (on the command line --record-step, in Python \
                      dt), or give the file a first column `time`";
        return Err(Fault::new(parsed.last_line, "a stated step (one column has none)", "no step", remedy));
    };
    parsed.step = step;
    Ok(())
}

/// Reads the rows of a table; they start with the time, in a unit of some `seconds`.
fn read_table(
    columns: &Columns<'_>,
    column: usize,
    seconds: f64,
    options: &RecordOptions,
    parsed: &mut Parsed,
) -> Result<(), Fault> {
    let mut times = Times::default();
    columns.read(column, |time, sample, line| {
        times.push(seconds * time, line)?;
        parsed.push(Some(sample), line, || overflow(sample, line))
    })?;
    // one sample is refused as such
    let Some((first_time, step)) = times.uniform()? else { return Ok(()) };
    // numbers of samples, and milliseconds whose unit is not written
    let is_other = |stated: f64| stated < 1.0 && (step == 1.0 || step > 1.0 && is_close(step, 1e3 * stated));
    if let Some(stated) = options.step.filter(|stated| seconds != 1.0 || is_other(*stated)) {
        let contradicts = seconds != 1.0 && !is_close(stated, step);
        parsed.warnings.extend(contradicts.then_some(Warning::StatedStep { step, stated }));
        (parsed.first_time, parsed.step) = (first_time * stated / step, stated);
        return Ok(());
    }
    options.check_step(step, columns.line())?;
    (parsed.first_time, parsed.step) = (first_time, step);
    Ok(())
}

/// Makes the fault of a number that is not finite in m/s².
fn overflow(number: f64, line: usize) -> Fault {
    Fault::new(line, "a finite acceleration", format!("`{number:e}`"), "check the value and the unit")
}
