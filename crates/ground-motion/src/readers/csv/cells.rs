//! The cells of a row: what separates them, and how their decimals are written.

use crate::error::Fault;
use crate::unit::Unit;

/// What separates the numbers of a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Separator {
    /// A comma; decimals have points.
    Comma,
    /// A semicolon.
    Semicolon,
    /// Blanks or tabs, any number of them.
    Blanks,
}

impl Separator {
    /// Finds what separates the numbers of a row; `None` for a single word. A comma beside a blank separates
    /// numbers. In a row with blanks, any other comma is a decimal comma.
    pub(super) fn of_row(row: &str) -> Option<Self> {
        let beside_blank = |(at, _): (usize, &str)| {
            row[..at].ends_with(char::is_whitespace) || row[at + 1..].starts_with(char::is_whitespace)
        };
        if row.contains(';') {
            Some(Self::Semicolon)
        } else if row.match_indices(',').any(beside_blank) {
            Some(Self::Comma)
        } else if row.contains(char::is_whitespace) {
            Some(Self::Blanks)
        } else {
            row.contains(',').then_some(Self::Comma)
        }
    }

    /// Returns the cells of a row.
    pub(super) fn cells(self, row: &str) -> impl Iterator<Item = &str> {
        let separates = move |c: char| match self {
            Self::Comma => c == ',',
            Self::Semicolon => c == ';',
            Self::Blanks => c.is_whitespace(),
        };
        row.split(separates).filter(move |cell| self != Self::Blanks || !cell.is_empty())
    }
}

/// Reads numbers whose decimals are all written alike.
pub(super) struct Numbers {
    /// What separates them; `None` in a single column, whose decimals have points.
    separator: Option<Separator>,
    /// The first decimal mark, and its line.
    mark: Option<(char, usize)>,
}

impl Numbers {
    pub(super) fn new(separator: Option<Separator>) -> Self {
        Self { separator, mark: None }
    }

    /// Reads the number in a cell.
    pub(super) fn real(&mut self, cell: &str, line: usize) -> Result<f64, Fault> {
        let cell = cell.trim();
        if let Some(mark) = cell.chars().find(|c| matches!(c, '.' | ',')) {
            let (first, first_line) = *self.mark.get_or_insert((mark, line));
            let takes_commas = matches!(self.separator, Some(Separator::Semicolon | Separator::Blanks));
            if takes_commas && mark != first {
                let expected = format!("`{first}` before the decimals, as on line {first_line}");
                let remedy = "write all decimals alike, and no marks between thousands";
                return Err(Fault::excerpt(line, expected, cell, remedy));
            }
            if takes_commas && mark == ',' {
                return finite(cell.replacen(',', ".", 1).parse(), cell, line, DECIMALS);
            }
        }
        let remedy = match self.separator {
            Some(Separator::Comma) => COMMAS,
            Some(Separator::Semicolon | Separator::Blanks) => DECIMALS,
            None => COLUMN,
        };
        finite(cell.parse(), cell, line, remedy)
    }

    /// Reads the sample (m/s²) in a cell.
    pub(super) fn sample(&mut self, cell: &str, line: usize, unit: Unit) -> Result<f64, Fault> {
        let sample = Some(unit.to_si(self.real(cell, line)?)).filter(|sample| sample.is_finite());
        sample.ok_or_else(|| {
            Fault::excerpt(line, "a finite acceleration", cell, "check the value and the unit")
        })
    }
}

const COMMAS: &str = "correct the value; commas separate columns here, so decimals have a point";
const DECIMALS: &str = "correct the value; write no marks between thousands";
const COLUMN: &str = "correct the value; in one column decimals have a point";

fn finite<E>(value: Result<f64, E>, cell: &str, line: usize, remedy: &str) -> Result<f64, Fault> {
    let value = value.ok().filter(|value| value.is_finite());
    value.ok_or_else(|| Fault::excerpt(line, "a finite number", cell, remedy))
}
