//! Tables for Python: columns by their names.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A column of a table.
pub(crate) enum Column<'a> {
    Names(Vec<&'a str>),
    Numbers(Vec<f64>),
    Counts(Vec<usize>),
    Flags(Vec<bool>),
}

/// Makes a table of its columns: names as lists, the others as arrays of their type.
pub(crate) fn table<'py, 'a>(
    py: Python<'py>,
    columns: impl IntoIterator<Item = (&'static str, Column<'a>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = PyDict::new(py);
    for (name, column) in columns {
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
