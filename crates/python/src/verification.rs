//! Every formula against a reference of its own.

use evidence::verification::{page, verify};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::Column;

use crate::errors::failed;
use crate::tables;

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(verify).map_err(failed)?;
    let mut table = page::all(&formulas);
    table.columns.insert(0, Column::text("formula", ""));
    table.columns.push(Column::count("passes", ""));
    let own = formulas.iter().flat_map(|one| one.comparisons.iter().map(|row| (&one.title, row.passes())));
    for (row, (title, passes)) in table.rows.iter_mut().zip(own) {
        row.insert(0, title.clone().into());
        row.push(passes.into());
    }
    tables::table(py, table)
}
