//! Every formula against a reference of its own.

use evidence::Comparison;
use evidence::verification::{page, verify};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::failed;
use crate::tables::Column::{Flags, Names};
use crate::tables::{columns_of, table};

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(verify).map_err(failed)?;
    let rows = || formulas.iter().flat_map(|one| one.comparisons.iter().map(|row| (&*one.title, row)));
    let titles = Names(rows().map(|(title, _)| title.into()).collect());
    let passes = Flags(rows().map(|(_, row)| Comparison::passes(row)).collect());
    let numbers = page::all(&formulas);
    table(py, [("formula", titles)].into_iter().chain(columns_of(&numbers)).chain([("passes", passes)]))
}
