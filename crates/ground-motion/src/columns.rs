//! Columns of text: the tables that people have in files, whatever separates their cells.
//!
//! Records, response spectra and tables of walls are read from them. A file has one of two forms:
//!
//! - [`Columns::of_numbers`]: rows of numbers, with or without a line of names above them;
//! - [`Columns::of_texts`]: a line of names, and rows of numbers and words.
//!
//! Semicolons, commas, tabs or blanks separate the cells, which may stand in quotes. Decimals have a point,
//! or a comma where that cannot be a separator. Above the rows, lines that start with `#` or `%` are
//! comments; among them a blank has to follow. Rows without any content, such as `,,`, are skipped, and so
//! are empty columns at the end.

mod cells;
mod heading;
mod lines;

pub use crate::error::Fault;
pub use crate::quantity::Measured;
pub use cells::{Numbers, TextRow, Thousands};
pub use heading::Name;
pub(crate) use heading::unit_of_title;
pub(crate) use lines::{COMMENTS, is_comment, is_comment_above, refuse_unclear};

use std::ops::Range;

use crate::error::excerpt;
use crate::fields::{Numbered, all_lines};
use crate::options::RecordOptions;
use crate::quantity::Quantity;
use crate::unit::Unit;
use cells::{Separator, cells};
use lines::{content, first_line, lines, refuse_foreign};

/// A line of names is searched among this many lines before the first number.
const TITLE_LINES: usize = 20;

/// What the columns of a file are called, what separates them, and their rows.
///
/// ```
/// use ground_motion::columns::{Columns, Numbers};
///
/// let text = "# a spectrum\nT [s];Sa [g]\n0;0,2\n0,5;0,45\n";
/// let columns = Columns::of_numbers(text, |name| name.text() == "T", "periods and Sa")?;
/// assert_eq!(columns.names()[1].unit(), Some("g"));
/// let mut numbers = Numbers::new(&columns);
/// for row in columns.rows() {
///     let row = row?;
///     let cells: Vec<_> = row.cells().collect();
///     assert!(numbers.real(&cells[1], row.line)? >= 0.2);
/// }
/// # Ok::<(), ground_motion::columns::Fault>(())
/// ```
#[derive(Clone, Debug)]
pub struct Columns<'a> {
    text: &'a str,
    names: Vec<Name>,
    /// The line or comment that names the columns, or else the first row.
    heading: Numbered<'a>,
    first_row: usize,
    separator: Separator,
    width: usize,
}

impl<'a> Columns<'a> {
    /// Finds the columns of a text with rows of numbers. Above these may stand titles, a line of names, and a
    /// row of units.
    ///
    /// A line names the columns if `is_first` knows its first name, or if it has as many names as the first
    /// row has cells. So does the last comment above the rows, if it has as many names, and `is_first` knows
    /// the first one, or that states a unit of time, or any a unit of acceleration. `forms` says in messages
    /// what the file should have.
    ///
    /// # Errors
    /// [`Fault`] if there are no rows, or if it cannot be told what separates their cells.
    pub fn of_numbers(text: &'a str, is_first: impl Fn(&Name) -> bool, forms: &str) -> Result<Self, Fault> {
        let first = first_line(text, forms)?;
        let titles: Vec<Numbered<'a>> =
            content(text).take_while(|(_, line)| !starts_a_number(line)).take(TITLE_LINES).collect();
        let is_row = |line: &str| starts_a_number(line.trim_start_matches('|'));
        refuse_foreign(content(text).take(titles.len() + 1), is_row)?;
        let row = content(text).nth(titles.len()).filter(|(_, line)| starts_a_number(line));
        let of_row = row.map_or(Separator::None, |(_, line)| Separator::of_row(line));
        let width = row.map_or(0, |(_, line)| filled(of_row, line));
        let names = |line: &str| heading::names(line, Separator::of_names(line, false));
        let is_heading = |&&(_, line): &&Numbered<'a>| {
            let names = names(line);
            names.len() > 1 && is_first(&names[0])
        };
        let unit_row =
            titles.last().filter(|(_, line)| titles.len() > 1 && heading::is_unit_row(&names(line)));
        let titles_only = &titles[..titles.len() - usize::from(unit_row.is_some())];
        let found = titles_only.last().filter(is_heading).or_else(|| titles_only.iter().find(is_heading));
        let fits = |&&(_, line): &&Numbered<'a>| width > 1 && names(line).len() == width;
        let found = found.or_else(|| titles_only.last().filter(fits));
        let has_commas = |line| Separator::of_names(line, false) == Separator::Comma;
        if let Some(row) = row.filter(|_| !found.is_some_and(|(_, line)| has_commas(line))) {
            refuse_ambiguous_commas(text, row, width)?;
        }
        if let Some(&(number, line)) = found {
            let mut names = names(line);
            if let Some((_, units)) = unit_row {
                heading::add_units(&mut names, units);
            }
            let first_row = unit_row.map_or(number, |(number, _)| *number) + 1;
            let (separator, width) = (Separator::of_names(line, false), names.len());
            let heading = (number, line);
            return Ok(Self { text, names, heading, first_row, separator, width });
        }
        let Some((number, line)) = row else {
            let remedy = "write rows of numbers below a line that names the columns";
            return Err(Fault::excerpt(first.0, forms, first.1, remedy));
        };
        let (heading, separator) = ((number, line), of_row);
        let mut columns = Self { text, names: Vec::new(), heading, first_row: number, separator, width };
        if of_row == Separator::None {
            // one column has a name of any number of words
            if let Some(&title) = titles.first() {
                (columns.heading, columns.first_row) = (title, title.0 + 1);
                columns.names = vec![Name::of(title.1)];
            }
            return Ok(columns);
        }
        if !titles.is_empty() {
            let remedy = "name the columns in the line above the numbers; mark titles with #";
            return Err(Fault::excerpt(first.0, forms, first.1, remedy));
        }
        if let Some(comment) = lines(text).take_while(|(line, _)| *line < number).last() {
            let named = names(comment.1.trim_start_matches(COMMENTS).trim());
            let is_time = |name: &Name| matches!(name.stated(), Some((_, Quantity::Time(_))));
            let counts = |first| is_first(first) || is_time(first) || named.iter().any(Name::is_acceleration);
            if named.len() == width && counts(&named[0]) {
                (columns.heading, columns.names) = (comment, named);
            }
        }
        Ok(columns)
    }

    /// Finds the columns of a text whose first line names them.
    ///
    /// # Errors
    /// [`Fault`] if there is no such line, or if two columns have one name.
    pub fn of_texts(text: &'a str, forms: &str) -> Result<Self, Fault> {
        refuse_foreign(content(text).take(1), |_| true)?;
        let heading = first_line(text, forms)?;
        let separator = Separator::of_names(heading.1, true);
        let names = heading::names(heading.1, separator);
        if names.first().is_some_and(|name| name.written().is_empty()) {
            return Err(index_column(heading));
        }
        refuse_twins(&names, heading.0)?;
        let (first_row, width) = (heading.0 + 1, names.len());
        Ok(Self { text, names, heading, first_row, separator, width })
    }

    /// Returns the names of the columns; none where neither a line nor a comment has them.
    pub fn names(&self) -> &[Name] {
        &self.names
    }

    /// Returns the line of the names, or else of the first row.
    pub fn line(&self) -> usize {
        self.heading.0
    }

    /// Returns the text of that line.
    pub(crate) fn heading(&self) -> &'a str {
        self.heading.1
    }

    /// Returns whether a comment names the columns.
    pub(crate) fn are_named_by_a_comment(&self) -> bool {
        self.heading.1.starts_with(COMMENTS) && !self.names.is_empty()
    }

    /// Counts the columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Returns the comments and lines above the first row, without the marks of comments.
    pub fn header(&self) -> impl Iterator<Item = &'a str> {
        let first_row = self.first_row;
        let header = lines(self.text).take_while(move |(number, _)| *number < first_row);
        header.map(|(_, line)| line.trim_start_matches(COMMENTS).trim_start())
    }

    /// Returns the lines below the heading, also blank ones.
    pub(crate) fn lines_below(&self) -> impl Iterator<Item = Numbered<'a>> + Clone {
        let first_row = self.first_row;
        all_lines(self.text).skip_while(move |(number, _)| *number < first_row)
    }

    /// Returns the rows that have content.
    ///
    /// # Errors
    /// [`Fault`] of a row with more or fewer cells than there are columns.
    pub fn rows(&self) -> impl Iterator<Item = Result<TextRow<'a>, Fault>> {
        let Self { text, first_row, separator, width, .. } = *self;
        let rows = lines(text).skip_while(move |(number, _)| *number < first_row);
        rows.filter_map(move |(line, text)| {
            let row = TextRow { line, text, separator, width };
            if text.starts_with(COMMENTS) {
                return refuse_unclear((line, text)).err().map(Err);
            }
            if separator != Separator::None && row.all_cells().all(|cell| cell.is_empty()) {
                return None;
            }
            Some(row.checked())
        })
    }

    /// Reads the numbers of a column; `take` takes each behind that of the first column, which is 0 where the
    /// first column itself is read, and its line.
    ///
    /// # Errors
    /// [`Fault`] of a cell that is no number, or of `take`.
    pub fn read(
        &self,
        column: usize,
        mut take: impl FnMut(f64, f64, usize) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let (mut numbers, mut thousands) = (Numbers::new(self), Thousands::default());
        for row in self.rows() {
            let row = row?;
            let mut cells = row.cells();
            let mut first = 0.0;
            if column > 0 {
                first = numbers.real(&cells.next().unwrap_or_default(), row.line)?;
            }
            let cell = cells.nth(column.saturating_sub(1)).unwrap_or_default();
            let value = numbers.real(&cell, row.line)?;
            thousands.push(&cell, row.line);
            take(first, value, row.line)?;
        }
        thousands.check()
    }

    /// Finds the only one of some columns whose unit has an SI value by `unit`; `what` says what it measures.
    /// # Errors
    /// [`Fault`] if there is none or more than one.
    pub fn measuring(
        &self,
        columns: Range<usize>,
        what: &str,
        unit: impl Fn(Measured) -> Option<f64>,
    ) -> Result<(usize, f64), Fault> {
        let mut found = columns.filter_map(|at| Some((at, unit(self.names.get(at)?.measured()?)?)));
        if let (Some(only), None) = (found.next(), found.next()) {
            return Ok(only);
        }
        let remedy = "name each column in a header line with its unit in brackets, displacements first";
        Err(Fault::excerpt(self.heading.0, format!("one column of {what}"), self.heading.1, remedy))
    }

    /// Finds the column to read beside the first: the one that is wanted by its name, or else the only one.
    /// Where there are more, it is the only one that states an acceleration while all others state something
    /// else. `first` is what the first column is, for messages.
    ///
    /// # Errors
    /// [`Fault`] if none or more than one could be meant; it lists the names.
    pub fn beside_the_first(&self, wanted: Option<&str>, first: &str) -> Result<usize, Fault> {
        let (line, text) = self.heading;
        let Some(wanted) = wanted else { return self.only_one(first) };
        let is_wanted = |name: &Name| name.written() == wanted || name.text() == wanted;
        let mut matches = (1..self.names.len()).filter(|&column| is_wanted(&self.names[column]));
        if let (Some(column), None) = (matches.next(), matches.next()) {
            return Ok(column);
        }
        let expected = format!("one column {} beside the first, {first}", excerpt(wanted));
        let remedy = "state the name of one of these columns; none if a header line does not name them";
        Err(Fault::excerpt(line, expected, text, remedy))
    }

    /// Returns how many seconds the unit of the first column has: one where it has no name or no unit.
    /// Refuses a column that `is_first` does not know, and another unit than s unless it `may_differ`.
    pub(crate) fn seconds(
        &self,
        is_first: impl Fn(&Name) -> bool,
        may_differ: bool,
        [expected, remedy]: [&str; 2],
    ) -> Result<f64, Fault> {
        let Some(name) = self.names.first() else { return Ok(1.0) };
        if name.written().is_empty() {
            return Err(index_column(self.heading));
        }
        match name.stated().filter(|_| is_first(name)) {
            Some((_, Quantity::Time(seconds))) if seconds == 1.0 || may_differ => Ok(seconds),
            None if is_first(name) => Ok(1.0),
            _ => {
                let expected = format!("{expected} in the first column");
                let of_unit_row = name.unit().filter(|unit| !name.written().contains(unit));
                let found = of_unit_row.map(|unit| format!("{} [{unit}]", name.written()));
                let found = found.as_deref().unwrap_or(name.written());
                Err(Fault::excerpt(self.heading.0, expected, found, remedy))
            }
        }
    }

    /// Returns the unit of a column of accelerations: the one that its name or the first states, or else the
    /// one that the user does. Refuses names of other quantities, and units that are not read.
    pub(crate) fn unit(&self, column: usize, options: &RecordOptions) -> Result<Option<Unit>, Fault> {
        let of_first = || self.names[0].unit()?.split_once(" in ").map(|(_, unit)| unit);
        let name = self.names.get(column);
        // round brackets may also have a direction
        let is_stated = name.is_some_and(|name| name.written().contains('['));
        let mut unit = name.and_then(Name::unit);
        if let Some(name) = name.filter(|_| self.width > 1) {
            name.refuse_other_quantity(self.heading.0)?;
            unit = unit.or_else(of_first);
        } else {
            // what is in the round brackets of a title need not be a unit
            unit = unit.filter(|unit| is_stated || Quantity::of(unit).is_some());
        }
        match unit {
            Some(unit) if is_stated && Quantity::of(unit).is_none() => {
                Err(Quantity::Other.refused(unit, self.heading.0))
            }
            Some(unit) => options.unit_of(unit, self.heading.0).map(Some),
            None => match self.unit_above() {
                Some((unit, line)) => options.unit_of(&unit, line).map(Some),
                None => Ok(options.unit),
            },
        }
    }

    /// Finds the unit of samples that a title or a comment above the rows states.
    fn unit_above(&self) -> Option<(String, usize)> {
        let mut above = lines(self.text).take_while(|(line, _)| *line < self.first_row);
        above.find_map(|(line, text)| {
            let unit = (line != self.heading.0).then(|| unit_of_title(text, self.width <= 2))??;
            Some((unit, line))
        })
    }

    /// Finds the only column beside the first.
    fn only_one(&self, first: &str) -> Result<usize, Fault> {
        let (line, text) = self.heading;
        refuse_twins(&self.names, line)?;
        let (accelerations, others): (Vec<usize>, Vec<usize>) =
            (1..self.names.len()).partition(|&column| self.names[column].is_acceleration());
        match (self.width, &accelerations[..]) {
            (2, _) => Ok(1),
            (_, &[column]) if others.iter().all(|&other| self.names[other].is_another_quantity()) => {
                Ok(column)
            }
            _ => {
                let found = format!("{} columns in {}", self.width, excerpt(text));
                let remedy = "name the columns in a header line, by one word each between blanks, and \
                              state the one to read: `column = …` in [check] or [records], --column of \
                              `wall record` and `wall simulate`; or write one sample a line; where \
                              decimals have a comma, separate columns by semicolons";
                Err(Fault::new(line, format!("one column beside {first}"), found, remedy))
            }
        }
    }
}

/// Refuses rows such as `0,5`, from the first one on: one number, or two.
fn refuse_ambiguous_commas(text: &str, (line, first): Numbered<'_>, width: usize) -> Result<(), Fault> {
    let mut rows = content(text).skip_while(|(number, _)| *number < line);
    let is_comma = Separator::of_row(first) == Separator::Comma && width == 2;
    let is_clear = |(_, row): Numbered<'_>| row.contains(['.', '"']);
    if !is_comma || first.contains(char::is_whitespace) || rows.any(is_clear) {
        return Ok(());
    }
    let expected = "commas that either separate or stand before decimals";
    let remedy = "write decimal points, separate columns by semicolons, or add a header line such as \
                  `time,a_g`";
    Err(Fault::excerpt(line, expected, first, remedy))
}

/// Makes the fault of a first column without a name.
fn index_column((line, heading): Numbered<'_>) -> Fault {
    let remedy = "delete the first column, an index without a name (pandas: index=False)";
    Fault::excerpt(line, "a name for the first column", heading, remedy)
}

/// Refuses two columns of one name.
fn refuse_twins(names: &[Name], line: usize) -> Result<(), Fault> {
    let mut named = names.iter().enumerate().filter(|(_, name)| !name.written().is_empty());
    let Some((_, name)) = named.find(|(at, name)| names[..*at].contains(name)) else { return Ok(()) };
    let found = format!("two columns {}", excerpt(name.written()));
    let remedy = "delete one of them, or give each its own name";
    Err(Fault::new(line, "columns with names of their own", found, remedy))
}

/// Counts the cells of a row without the empty ones at its end.
fn filled(separator: Separator, row: &str) -> usize {
    let filled = cells(row, separator).enumerate().filter(|(_, cell)| !cell.is_empty());
    filled.last().map_or(0, |(at, _)| at + 1)
}

/// Returns whether a line starts as a number does; it may stand in quotes.
fn starts_a_number(line: &str) -> bool {
    let line = line.trim_start().trim_start_matches('"').trim_start();
    // `,T [s]` is none
    let digits = line.trim_start_matches(['+', '-']).trim_start_matches(['.', ',']);
    digits.starts_with(|c: char| c.is_ascii_digit()) || line.parse::<f64>().is_ok()
}
