//! The cells of a row: what separates them, and how their numbers are written.

use std::borrow::Cow;

use super::lines::Quotes;
use super::{Columns, filled};
use crate::error::{Fault, excerpt};
use crate::fields::real;

/// What separates the cells of a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Separator {
    /// Nothing: a row is one cell.
    None,
    /// A comma; decimals have points, except in quotes.
    Comma,
    /// A semicolon.
    Semicolon,
    /// A tab, in rows that may have empty cells.
    Tab,
    /// Blanks or tabs, any number of them.
    Blanks,
}

impl Separator {
    /// Finds what separates the numbers of a row. A comma beside a blank separates numbers. In a row with
    /// blanks, any other comma is a decimal comma.
    pub(super) fn of_row(row: &str) -> Self {
        let (whole, row) = (row, &*Quotes::of(row).outside);
        let is_beside = |before: &str, after: &str| {
            let edge = |c: char| c.is_whitespace() || c == '"';
            before.is_empty() || before.ends_with(edge) || after.starts_with(edge) || after.is_empty()
        };
        let separates = |(at, _): (usize, &str)| is_beside(&row[..at], &row[at + 1..]);
        if row.contains(';') {
            Self::Semicolon
        } else if row.match_indices(',').any(separates) {
            Self::Comma
        } else if row.contains(char::is_whitespace) {
            Self::Blanks
        } else if whole.contains(',') {
            Self::Comma
        } else {
            Self::None
        }
    }

    /// Finds what separates names, and the rows below them. Rows of texts may have empty cells between tabs.
    pub(super) fn of_names(line: &str, of_texts: bool) -> Self {
        let line = Quotes::of(line).outside;
        match line {
            _ if line.contains(';') => Self::Semicolon,
            _ if line.contains(',') => Self::Comma,
            _ if line.contains('\t') && of_texts => Self::Tab,
            _ => Self::Blanks,
        }
    }

    fn is(self, c: char) -> bool {
        match self {
            Self::None => false,
            Self::Comma => c == ',',
            Self::Semicolon => c == ';',
            Self::Tab => c == '\t',
            Self::Blanks => c.is_whitespace(),
        }
    }
}

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub struct TextRow<'a> {
    /// Its line, from 1.
    pub line: usize,
    pub(super) text: &'a str,
    pub(super) separator: Separator,
    pub(super) width: usize,
}

impl<'a> TextRow<'a> {
    /// Returns the cells, one for each column, without blanks around them and without quotes.
    pub fn cells(&self) -> impl Iterator<Item = Cow<'a, str>> {
        self.all_cells().take(self.width)
    }

    pub(super) fn all_cells(&self) -> impl Iterator<Item = Cow<'a, str>> {
        cells(self.text, self.separator)
    }

    /// Refuses a number of cells that is not that of the columns; empty ones at the end do not count.
    pub(super) fn checked(self) -> Result<Self, Fault> {
        let Self { line, text, separator, width } = self;
        let all = self.all_cells().count();
        if all == width || all > width && filled(separator, text) <= width {
            return Ok(self);
        }
        let expected = format!("one value for each column, {width} in all");
        let remedy = "complete the row; where decimals have a comma, separate columns by semicolons; between \
                      blanks, names are one word each; comments start with # or %";
        Err(Fault::new(line, expected, format!("{all} in {}", excerpt(text)), remedy))
    }
}

/// Splits a row into its cells, without blanks around them and without quotes.
pub(super) fn cells(row: &str, separator: Separator) -> impl Iterator<Item = Cow<'_, str>> {
    let mut rest = Some(row);
    std::iter::from_fn(move || {
        let mut row = rest.take()?;
        if separator == Separator::Blanks {
            row = row.trim_start();
            if row.is_empty() {
                return None;
            }
        }
        let may_close = row.trim_start().starts_with('"');
        let mut is_open = false;
        let end = row.find(|c: char| {
            is_open ^= may_close && c == '"';
            !is_open && separator.is(c)
        });
        let Some(end) = end else { return Some(unquoted(row)) };
        let mut after = row[end..].chars();
        after.next();
        rest = Some(after.as_str());
        Some(unquoted(&row[..end]))
    })
}

/// Strips blanks and quotes from a cell; doubled quotes inside stand for one, and a line break for a blank.
pub(super) fn unquoted(cell: &str) -> Cow<'_, str> {
    let cell = cell.trim();
    match cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"')) {
        Some(inner) if inner.contains(['"', '\r', '\n']) => {
            let line = inner.trim().replace("\r\n", " ").replace(['\r', '\n'], " ");
            Cow::Owned(line.replace("\"\"", "\""))
        }
        Some(inner) => Cow::Borrowed(inner.trim()),
        None => Cow::Borrowed(cell),
    }
}

/// Finds whole numbers with marks between thousands, as Germans write them: `931` above `1.053`.
///
/// ```
/// use ground_motion::columns::Thousands;
///
/// let mut column = Thousands::default();
/// for (line, cell) in ["931", "1.053", "12", "7"].into_iter().enumerate() {
///     column.push(cell, line + 1);
/// }
/// assert_eq!(column.check().unwrap_err().line(), 2);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Thousands {
    /// The first number with a mark, and its line.
    marked: Option<(String, usize)>,
    /// How many numbers are whole, and whether one of them has three digits.
    whole: usize,
    has_hundreds: bool,
    /// Whether a number cannot be one of these, such as `0.125` and `1.5`.
    has_decimals: bool,
}

impl Thousands {
    /// Takes the next number of a column.
    pub fn push(&mut self, cell: &str, line: usize) {
        let digits = cell.trim_start_matches(['+', '-']);
        let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        match digits.split_once(['.', ',']) {
            None => {
                self.whole += 1;
                self.has_hundreds |= digits.len() == 3;
                self.has_decimals |= digits.len() > 3 || !is_digits(digits);
            }
            Some((whole, rest)) => {
                let is_one = is_digits(whole) && whole.len() <= 3 && !whole.starts_with('0');
                self.has_decimals |= !(is_one && rest.len() == 3 && is_digits(rest));
                self.marked.get_or_insert_with(|| (cell.to_owned(), line));
            }
        }
    }

    /// Refuses a column in which every mark can stand between thousands, beside whole numbers, some of three
    /// digits: `1.053` after `931`. One or two whole numbers can have zeros as decimals.
    ///
    /// # Errors
    /// [`Fault`] of the first number with a mark.
    pub fn check(self) -> Result<(), Fault> {
        match self.marked {
            Some((cell, line)) if self.whole > 2 && self.has_hundreds && !self.has_decimals => {
                let expected = "numbers without marks between thousands";
                let remedy = "beside whole numbers of three digits this may be one above 999: write no marks \
                              between thousands, or all numbers with decimals";
                Err(Fault::excerpt(line, expected, &cell, remedy))
            }
            _ => Ok(()),
        }
    }
}

/// Reads numbers whose decimals are all written alike.
#[derive(Clone, Debug)]
pub struct Numbers {
    separator: Separator,
    /// The first decimal mark, and its line.
    mark: Option<(char, usize)>,
}

impl Numbers {
    /// Makes a reader for the cells of some columns.
    pub fn new(columns: &Columns<'_>) -> Self {
        Self { separator: columns.separator, mark: None }
    }

    /// Reads the finite number in a cell. The letter of an exponent may be D, as Fortran writes it.
    ///
    /// # Errors
    /// [`Fault`] if it is none, or if its decimals are not written as those before.
    pub fn real(&mut self, cell: &str, line: usize) -> Result<f64, Fault> {
        let cell = cell.trim();
        let mut plain = Cow::Borrowed(cell);
        if self.separator != Separator::None
            && let Some(mark) = cell.chars().find(|c| matches!(c, '.' | ','))
        {
            let (first, first_line) = *self.mark.get_or_insert((mark, line));
            if mark != first {
                let expected = format!("`{first}` before the decimals, as on line {first_line}");
                let remedy = "write all decimals alike, and no marks between thousands";
                return Err(Fault::excerpt(line, expected, cell, remedy));
            }
            if mark == ',' {
                plain = Cow::Owned(cell.replacen(',', ".", 1));
            }
        }
        let value = real(&plain).filter(|value| value.is_finite());
        value.ok_or_else(|| {
            let remedy = "correct the value: decimals have a point, or a comma between semicolons, tabs or \
                          blanks; write minus signs as `-`, no marks between thousands, and times in s, not \
                          as dates";
            Fault::no_number(line, "a finite number", cell, remedy)
        })
    }
}
