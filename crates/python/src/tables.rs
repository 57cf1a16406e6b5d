//! Tables for Python: columns by their names.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::{Cell, Table};

/// Makes a table for Python: words as lists; numbers, counts and flags as arrays of their type.
pub(crate) fn table(py: Python<'_>, Table { columns, rows }: Table) -> PyResult<Bound<'_, PyDict>> {
    let values = PyDict::new(py);
    for (place, column) in columns.iter().enumerate().filter(|(_, column)| !column.name.is_empty()) {
        let cells = || rows.iter().map(|row| &row[place]);
        if column.is_text || cells().any(|cell| matches!(cell, Cell::Text(_))) {
            values.set_item(&column.name, cells().map(text).collect::<Vec<_>>())?;
        } else if let Some(counts) = all(cells(), count) {
            values.set_item(&column.name, PyArray1::from_vec(py, counts))?;
        } else if let Some(flags) = all(cells(), flag) {
            values.set_item(&column.name, PyArray1::from_vec(py, flags))?;
        } else {
            values.set_item(&column.name, PyArray1::from_iter(py, cells().map(number)))?;
        }
    }
    Ok(values)
}

/// Returns the values of cells if there are some and all are of one kind.
fn all<'a, T>(
    cells: impl Iterator<Item = &'a Cell<'static>>,
    value: fn(&Cell<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    cells.map(value).collect::<Option<Vec<T>>>().filter(|values| !values.is_empty())
}

fn text<'a>(cell: &'a Cell<'_>) -> &'a str {
    if let Cell::Text(text) = cell { text } else { "" }
}

fn count(cell: &Cell<'_>) -> Option<i64> {
    if let Cell::Count(count) = cell { i64::try_from(*count).ok() } else { None }
}

fn flag(cell: &Cell<'_>) -> Option<bool> {
    if let Cell::Flag(flag) = cell { Some(*flag) } else { None }
}

/// Returns a number: 1 or 0 for a flag among empty cells, NaN for one that is not known, infinity for one
/// that is above the levels.
fn number(cell: &Cell<'_>) -> f64 {
    match cell {
        Cell::Number(number) | Cell::Rounded(number, _) => *number,
        Cell::Flag(flag) => f64::from(*flag),
        Cell::Between([least, most]) if least == most || *most == f64::INFINITY => *most,
        _ => f64::NAN,
    }
}
