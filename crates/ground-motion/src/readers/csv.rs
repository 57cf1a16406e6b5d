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

use super::numbers;
use crate::columns::{Columns, Name};
use crate::error::{Fault, excerpt};
use crate::options::{RecordOptions, is_close, no_unit};
use crate::parsed::Parsed;
use crate::quantity::Quantity;
use crate::times::Times;
use crate::unit::Unit;
use crate::warning::Warning;

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
    let has_times = columns.width() > 1;
    let (column, seconds) = if has_times {
        refuse_spectrum(&columns, 1)?;
        // brackets may have a unit, or what `time (a_g in m/s2)` says
        let has_unit = |unit: &str| Quantity::of(unit).is_some() || unit.contains(" in ");
        let may_be_time = |name: &Name| {
            columns.are_named_by_a_comment() || is_time(name) && name.unit().is_none_or(has_unit)
        };
        let seconds = columns.seconds(may_be_time, options.step.is_some(), ["times in s", NAME_TIMES])?;
        (columns.beside_the_first(options.column.as_deref(), "`time`")?, seconds)
    } else {
        (0, 1.0)
    };
    refuse_spectrum(&columns, column)?;
    let stated = columns.unit(column, options)?;
    // Without a unit the values stay as they are, and the file is refused once the rest is sound.
    let mut parsed = Parsed::new(f64::NAN, stated.unwrap_or(Unit::MetrePerSecondSquared), columns.line());
    parsed.keep_header(columns.header());
    parsed.is_vertical = columns.names().get(column).is_some_and(Name::is_vertical);
    let mut times = Times::default();
    columns.read(column, |time, sample, line| {
        if has_times {
            times.push(seconds * time, line)?;
        }
        parsed.push(Some(sample), line, || overflow(sample, line))
    })?;
    if let Some(step) = options.step.filter(|_| !has_times) {
        numbers::warn(&mut parsed, step, columns.header(), columns.lines_below());
    }
    match (times.uniform()?, options.step) {
        (Some(of_times), _) => take_times(&mut parsed, of_times.into(), seconds, options, columns.line())?,
        (None, Some(step)) => parsed.step = step,
        // one sample is refused as such
        (None, None) if has_times => {}
        (None, None) => {
            let remedy = "state the step in seconds as `step` (on the command line --record-step, in Python \
                          dt), or give the file a first column `time`";
            let expected = "a stated step (one column has none)";
            return Err(Fault::new(parsed.last_line, expected, "no step", remedy));
        }
    }
    if let Some(wanted) = options.column.as_ref().filter(|_| !has_times)
        && !columns.names().iter().any(|name| name.written() == wanted)
    {
        let expected = format!("the column {}", excerpt(wanted));
        return Err(Fault::excerpt(columns.line(), expected, columns.heading(), "state no column"));
    }
    if stated.is_none() {
        return Err(no_unit(columns.line()));
    }
    Ok(vec![parsed])
}

const NAME_TIMES: &str = "name the first column `time`, in seconds, in a header line, and mark titles with \
                          #; or state the step in seconds as `step` (on the command line --record-step, in \
                          Python dt)";

/// Refuses a response spectrum: periods in the first column, or a column such as `Sa`. A column `T` beside
/// times is a transverse component.
fn refuse_spectrum(columns: &Columns<'_>, column: usize) -> Result<(), Fault> {
    let is_spectral = |name: &&Name| name.says() == Some(Quantity::Spectrum);
    let is_period = |name: &&Name| is_spectral(name) || columns.width() > 1 && name.text() == "T";
    let periods = columns.names().first().filter(is_period);
    let spectral = periods.or_else(|| columns.names().get(column).filter(is_spectral));
    let Some(name) = spectral else { return Ok(()) };
    let expected = "accelerations of the ground at times";
    let remedy = "this is a response spectrum: use the record itself; if it is a record, name its columns \
                  `time` and `a`";
    Err(Fault::excerpt(columns.line(), expected, name.written(), remedy))
}

/// Takes the first time and the step of times in a unit of some `seconds`. A stated step counts where these
/// are numbers of samples, or in another unit.
fn take_times(
    parsed: &mut Parsed,
    [first_time, step]: [f64; 2],
    seconds: f64,
    options: &RecordOptions,
    line: usize,
) -> Result<(), Fault> {
    (parsed.first_time, parsed.step) = (first_time, step);
    // numbers of samples, and milliseconds whose unit is not written
    let is_other = |stated: f64| stated < 1.0 && (step == 1.0 || step > 1.0 && is_close(step, 1e3 * stated));
    let Some(stated) = options.step.filter(|stated| seconds != 1.0 || is_other(*stated)) else {
        return options.check_step(step, line);
    };
    let contradicts = seconds != 1.0 && !is_close(stated, step);
    parsed.warnings.extend(contradicts.then_some(Warning::StatedStep { step, stated }));
    (parsed.first_time, parsed.step) = (first_time * stated / step, stated);
    Ok(())
}

/// Makes the fault of a number that is not finite in m/s².
fn overflow(number: f64, line: usize) -> Fault {
    Fault::new(line, "a finite acceleration", format!("`{number:e}`"), "check the value and the unit")
}
