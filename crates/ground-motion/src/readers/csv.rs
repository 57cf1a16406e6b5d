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
//! [`CSV_HEADER`].

mod cells;
mod heading;
mod times;

use crate::error::{Fault, excerpt};
use crate::fields::{Line, lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;

use cells::{Numbers, Separator};
use heading::{Heading, name_and_unit, unquoted};
use times::Times;

/// Header of a table of the ground's acceleration in m/s². Importers of FMUs find the input `a_g` by its
/// name, so that no unit may follow it. They take the first column for the time whatever its name is, so the
/// unit stands there.
pub const CSV_HEADER: &str = "time (a_g in m/s2),a_g";

const FORMS: &str = "a header line such as `time,a_g` and rows of numbers, times and accelerations in two \
                     columns, or one column of numbers (or the header of another format)";

const COMMENTS: [char; 2] = ['#', '%'];

/// Returns whether one of the first lines is the header line of a table, and the next one a row of it.
pub(super) fn recognises(head: &[&str]) -> bool {
    let content = head.iter().enumerate().map(|(index, line)| (index, line.trim_start()));
    let mut content = content.filter(|(_, line)| !line.starts_with(COMMENTS));
    let Some(heading) = Heading::find(content.clone()) else { return false };
    content.find(|(index, _)| *index > heading.line).is_some_and(|(_, row)| heading.fits(row))
}

/// Returns the lines that are no comments.
fn content(text: &str) -> impl Iterator<Item = Line<'_>> + Clone {
    lines(text).filter(|(_, line)| !line.starts_with(COMMENTS))
}

/// Reads the text of a table or a column.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Parsed, Fault> {
    let mut rows = content(text);
    let Some((number, first)) = rows.next() else {
        let found = if lines(text).next().is_some() { "comments only" } else { "an empty file" };
        return Err(Fault::new(1, FORMS, found, "check that this is the right file"));
    };
    let heading = Heading::find(content(text));
    let chosen = heading.as_ref().map(|heading| heading.chosen(options)).transpose()?;
    let row = if is_name(first) { rows.next().map(|(_, row)| row) } else { Some(first) };
    let separator = row.and_then(Separator::of_row);
    let stated = match chosen {
        Some((_, unit)) => unit,
        // what is in the brackets of a title need not be a unit
        None if separator.is_none() => match name_and_unit(unquoted(first)) {
            (_, Some(word)) if word.parse::<Unit>().is_ok() => Some(options.unit_of(word, number)?),
            _ => None,
        },
        None => None,
    };
    let stated = stated.or(options.unit);
    // Without a unit the values stay as they are, and the file is refused once the rest is sound.
    let unit = stated.unwrap_or(Unit::MetrePerSecondSquared);
    let parsed = match (&heading, chosen, separator) {
        (Some(heading), Some((column, _)), _) => {
            let Heading { line, separator, .. } = *heading;
            let columns = heading.columns();
            table(text, options, unit, &Table { line, first_row: line + 1, separator, columns, column })?
        }
        (_, _, Some(_)) if is_name(first) => {
            let remedy = "the first column must be `time`, in seconds, with a header line that names the \
                          columns; mark titles with #";
            return Err(Fault::excerpt(number, FORMS, first, remedy));
        }
        (_, _, Some(separator)) => pairs(text, options, unit, separator, (number, first))?,
        (_, _, None) => column(text, options, unit)?,
    };
    if stated.is_none() {
        let remedy = "give `unit` (on the command line --unit): m/s2, cm/s2, mm/s2 or g; or write it into a \
                      header line, `t [s],a [g]`";
        return Err(Fault::new(number, "a stated unit (this file has none)", "no unit", remedy));
    }
    Ok(parsed)
}

/// Reads one column of samples.
fn column(text: &str, options: &RecordOptions, unit: Unit) -> Result<Parsed, Fault> {
    let mut parsed = Parsed::new(f64::NAN, unit, 1);
    let (mut numbers, mut name) = (Numbers::new(None), None);
    let mut first_row = usize::MAX;
    for (number, line) in content(text) {
        parsed.last_line = number;
        if parsed.samples.is_empty() && name.is_none() && is_name(line) {
            name = Some((number, unquoted(line)));
            continue;
        }
        first_row = first_row.min(number);
        parsed.samples.push(numbers.sample(line, number, unit)?);
    }
    if let Some(wanted) = &options.column
        && name.is_none_or(|(_, name)| name != wanted)
    {
        let found = name.map_or_else(|| "one column without a name".to_owned(), |(_, name)| excerpt(name));
        let line = name.map_or(1, |(number, _)| number);
        return Err(Fault::new(line, format!("the column {}", excerpt(wanted)), found, "state no column"));
    }
    let Some(step) = options.step else {
        let remedy = "state the step in seconds as `step` (on the command line --record-step, in Python \
                      dt), or give the file a first column `time`";
        return Err(Fault::new(parsed.last_line, "a stated step (one column has none)", "no step", remedy));
    };
    parsed.step = step;
    keep_header(&mut parsed, text, first_row);
    Ok(parsed)
}

/// What is known of a table before its rows.
struct Table {
    /// Its header line, or else its first row.
    line: usize,
    first_row: usize,
    separator: Separator,
    columns: usize,
    /// Index of the column to read.
    column: usize,
}

/// Reads times and accelerations without a header line.
fn pairs(
    text: &str,
    options: &RecordOptions,
    unit: Unit,
    separator: Separator,
    (line, first): Line<'_>,
) -> Result<Parsed, Fault> {
    let columns = separator.cells(first).count();
    if columns != 2 {
        let remedy = "name the columns in a header line that starts with `time`, or write one sample a \
                      line; where decimals have a comma, separate the columns by semicolons";
        let expected = "two columns, times and accelerations, or one";
        return Err(Fault::new(line, expected, format!("{columns} in {}", excerpt(first)), remedy));
    }
    if let Some(wanted) = &options.column {
        let expected = format!("a header line with the column {}", excerpt(wanted));
        return Err(Fault::excerpt(line, expected, first, "state no column: only one can be read"));
    }
    let has_point = |(_, row): (usize, &str)| row.contains('.');
    if separator == Separator::Comma && !first.contains(char::is_whitespace) && !content(text).any(has_point)
    {
        let remedy = "write decimal points, separate columns by semicolons, or add a header line such as \
                      `time,a_g`";
        return Err(Fault::excerpt(
            line,
            "commas that either separate or stand before decimals",
            first,
            remedy,
        ));
    }
    table(text, options, unit, &Table { line, first_row: line, separator, columns, column: 1 })
}

/// Reads the rows of a table; they start with the time.
fn table(text: &str, options: &RecordOptions, unit: Unit, table: &Table) -> Result<Parsed, Fault> {
    let &Table { line, first_row, separator, columns, column } = table;
    let mut parsed = Parsed::new(f64::NAN, unit, line);
    let (mut times, mut numbers) = (Times::default(), Numbers::new(Some(separator)));
    for (number, row) in content(text).skip_while(|(number, _)| *number < first_row) {
        let found = separator.cells(row).count();
        if found != columns {
            let expected = format!("{columns} values, one for each column");
            let found = format!("{found} in {}", excerpt(row));
            let remedy = match separator {
                Separator::Comma => {
                    "complete the row; where decimals have a comma, separate the columns by semicolons"
                }
                Separator::Semicolon => "complete the row",
                Separator::Blanks => {
                    "complete the row; between blanks, each name in the header line must be one word"
                }
            };
            return Err(Fault::new(number, expected, found, remedy));
        }
        let mut cells = separator.cells(row);
        times.push(numbers.real(cells.next().unwrap_or_default(), number)?, number)?;
        parsed.samples.push(numbers.sample(cells.nth(column - 1).unwrap_or_default(), number, unit)?);
        parsed.last_line = number;
    }
    let Some((first_time, step)) = times.uniform()? else {
        let found = parsed.samples.len().to_string();
        let remedy = "check that the file is complete";
        return Err(Fault::new(parsed.last_line, "at least two rows", found, remedy));
    };
    options.check_step(step, line)?;
    (parsed.first_time, parsed.step) = (first_time, step);
    keep_header(&mut parsed, text, first_row);
    Ok(parsed)
}

/// Keeps the comments, titles and names above the first row.
fn keep_header(parsed: &mut Parsed, text: &str, first_row: usize) {
    let header = lines(text).take_while(|(number, _)| *number < first_row);
    parsed.keep_header(header.map(|(_, line)| line.trim_start_matches(COMMENTS).trim_start()));
}

/// Returns whether a line names its column: it starts with a letter and is not a number, as `nan` and `inf`
/// are.
fn is_name(line: &str) -> bool {
    unquoted(line).starts_with(char::is_alphabetic) && line.parse::<f64>().is_err()
}
