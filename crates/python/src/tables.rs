//! Tables for Python: columns by their names.

use std::borrow::Cow;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::{Cell, Table};

/// A column of a table.
pub(crate) enum Column<'a> {
    Names(Vec<Cow<'a, str>>),
    Numbers(Vec<f64>),
    Counts(Vec<usize>),
    Flags(Vec<bool>),
}

impl<'a> Column<'a> {
    /// Makes a column for cells like this one.
    pub(crate) fn of(cell: &Cell<'a>) -> Self {
        match cell {
            Cell::Text(_) => Self::Names(Vec::new()),
            Cell::Empty | Cell::Number(_) | Cell::Rounded(..) | Cell::Between(_) => Self::Numbers(Vec::new()),
            Cell::Count(_) => Self::Counts(Vec::new()),
            Cell::Flag(_) => Self::Flags(Vec::new()),
        }
    }

    /// Adds a cell: a number that is not known is NaN, and one that is above the levels infinite.
    pub(crate) fn push(&mut self, cell: &Cell<'a>) {
        match (self, cell) {
            (Self::Names(names), Cell::Text(name)) => names.push(name.clone()),
            (Self::Numbers(numbers), Cell::Number(number) | Cell::Rounded(number, _)) => {
                numbers.push(*number);
            }
            (Self::Numbers(numbers), Cell::Empty) => numbers.push(f64::NAN),
            (Self::Numbers(numbers), Cell::Between([least, most])) => {
                let is_known = least == most || *most == f64::INFINITY;
                numbers.push(if is_known { *most } else { f64::NAN });
            }
            (Self::Counts(counts), Cell::Count(count)) => counts.push(*count),
            (Self::Flags(flags), Cell::Flag(flag)) => flags.push(*flag),
            _ => unreachable!("the cells of a column are alike"),
        }
    }
}

/// Returns the named columns of a table of at least one row.
pub(crate) fn columns_of(table: &Table) -> impl Iterator<Item = (&str, Column<'_>)> {
    let named = table.columns.iter().enumerate().filter(|(_, column)| !column.name.is_empty());
    named.map(|(index, column)| {
        let mut cells = Column::of(&table.rows[0][index]);
        table.rows.iter().for_each(|row| cells.push(&row[index]));
        (&*column.name, cells)
    })
}

/// Makes a table of its columns: names as lists, the others as arrays of their type.
pub(crate) fn table<'py, 'a>(
    py: Python<'py>,
    columns: impl IntoIterator<Item = (impl AsRef<str>, Column<'a>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (name, column) in columns {
        let name = name.as_ref();
        match column {
            Column::Names(names) => table.set_item(name, names)?,
            Column::Numbers(numbers) => table.set_item(name, PyArray1::from_vec(py, numbers))?,
            Column::Counts(counts) => {
                #[allow(clippy::cast_possible_wrap, reason = "nothing is counted up to 2⁶³")]
                let counts = counts.into_iter().map(|count| count as i64);
                table.set_item(name, PyArray1::from_iter(py, counts))?;
            }
            Column::Flags(flags) => table.set_item(name, PyArray1::from_vec(py, flags))?,
        }
    }
    Ok(table)
}
