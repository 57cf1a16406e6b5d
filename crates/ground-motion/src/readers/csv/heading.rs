//! The header line of a table: what its columns are called, and the units in brackets.

use crate::error::{Fault, excerpt};
use crate::fields::Line;
use crate::options::RecordOptions;
use crate::unit::Unit;

use super::cells::Separator;

/// A header line is searched among this many lines before the first number.
const TITLE_LINES: usize = 20;

/// A header line whose first column is the time.
pub(super) struct Heading<'a> {
    /// Its number.
    pub(super) line: usize,
    /// The line.
    text: &'a str,
    /// The names of the columns.
    names: Vec<String>,
    /// What separates the numbers of its rows.
    pub(super) separator: Separator,
}

impl<'a> Heading<'a> {
    /// Finds the header line of a table, below lines of titles: the one above the first number, or else the
    /// first that names the time.
    pub(super) fn find(content: impl Iterator<Item = Line<'a>>) -> Option<Self> {
        let titles = content.take_while(|(_, line)| !starts_a_number(line)).take(TITLE_LINES);
        let titles: Vec<_> = titles.collect();
        let mut candidates = titles.last().into_iter().chain(&titles);
        candidates.find_map(|&(number, line)| Self::of(number, line))
    }

    /// Returns whether a line is a row of numbers below these names.
    pub(super) fn fits(&self, row: &str) -> bool {
        starts_a_number(row) && self.separator.cells(row).count() == self.columns()
    }

    fn of(line: usize, text: &'a str) -> Option<Self> {
        let split = |separator: char| text.split(separator).map(|name| unquoted(name).to_owned());
        let (names, separator): (Vec<String>, _) = if text.contains(';') {
            (split(';').collect(), Separator::Semicolon)
        } else if text.contains(',') {
            (split(',').collect(), Separator::Comma)
        } else if text.contains('\t') {
            (split('\t').filter(|name| !name.is_empty()).collect(), Separator::Blanks)
        } else {
            (words(text), Separator::Blanks)
        };
        let (first, _) = name_and_unit(names.first()?);
        let is_time = ["time", "time_s", "t", "t_s"].contains(&first.to_lowercase().as_str());
        (is_time && names.len() > 1).then_some(Self { line, text, names, separator })
    }

    /// Returns the number of columns.
    pub(super) fn columns(&self) -> usize {
        self.names.len()
    }

    /// Finds the index of the column to read, and the unit that the header line states for it; column 0 is
    /// the time.
    pub(super) fn chosen(&self, options: &RecordOptions) -> Result<(usize, Option<Unit>), Fault> {
        let column = self.column(options.column.as_deref())?;
        let (_, time_unit) = name_and_unit(&self.names[0]);
        let of_first = time_unit.and_then(|unit| unit.split_once(" in ")).map(|(_, unit)| unit);
        let is_second =
            |unit: &str| ["s", "sec", "secs", "second", "seconds"].contains(&unit.to_lowercase().as_str());
        if let Some(unit) = time_unit.filter(|unit| of_first.is_none() && !is_second(unit)) {
            let remedy = "write the times in seconds, and so in the header line";
            return Err(Fault::excerpt(self.line, "times in s", unit, remedy));
        }
        let (_, unit) = name_and_unit(&self.names[column]);
        let unit = unit.or(of_first).map(|word| options.unit_of(word, self.line)).transpose()?;
        Ok((column, unit))
    }

    fn column(&self, wanted: Option<&str>) -> Result<usize, Fault> {
        let refused =
            |expected: String, remedy: &str| Err(Fault::excerpt(self.line, expected, self.text, remedy));
        let Some(wanted) = wanted else {
            let remedy = match self.separator {
                Separator::Blanks => {
                    "state the name of the column to read (on the command line --column); between blanks, \
                     each name must be one word"
                }
                Separator::Comma | Separator::Semicolon => {
                    "state the name of the column to read (on the command line --column)"
                }
            };
            return match self.names.len() {
                2 => Ok(1),
                _ => refused("one column beside `time`".to_owned(), remedy),
            };
        };
        let is_wanted = |name: &str| name == wanted || name_and_unit(name).0 == wanted;
        let mut matches = (1..self.names.len()).filter(|&column| is_wanted(&self.names[column]));
        match (matches.next(), matches.next()) {
            (Some(column), None) => Ok(column),
            (None, _) => refused(format!("a column {}", excerpt(wanted)), "state one of these columns"),
            (Some(_), Some(_)) => {
                refused(format!("one column {}", excerpt(wanted)), "give each column its own name")
            }
        }
    }
}

/// Splits a line of names at blanks; a bracket belongs to the name before it, `time [s]`.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut depth = 0_usize;
    for word in text.split_whitespace() {
        let continues = depth > 0 || word.starts_with(['(', '[']);
        match words.last_mut().filter(|_| continues) {
            Some(before) => before.extend([" ", word]),
            None => words.push(word.to_owned()),
        }
        depth += word.matches(['(', '[']).count();
        depth = depth.saturating_sub(word.matches([')', ']']).count());
    }
    words
}

/// Splits `a_g [m/s2]` or `a_g (m/s2)` into the name and what is in its bracket.
pub(super) fn name_and_unit(name: &str) -> (&str, Option<&str>) {
    for (opening, closing) in [('[', ']'), ('(', ')')] {
        if let Some((before, unit)) = name.strip_suffix(closing).and_then(|text| text.split_once(opening)) {
            return (before.trim(), Some(unit.trim()));
        }
    }
    (name, None)
}

pub(super) fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// Returns whether a line starts as a number does.
fn starts_a_number(line: &str) -> bool {
    line.trim_start().starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | ','))
}
