//! Every formula against a reference of its own.

use evidence::verification::{library, verify};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::{Column, Digits, Table};

use crate::errors::failed;
use crate::tables;

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(|| verify(library)).map_err(failed)?;
    let any = Digits::AtMost(6);
    let mut table = Table::new([
        Column::text("formula", ""),
        Column::text("case", ""),
        Column::text("quantity", ""),
        Column::text("unit", ""),
        Column::number("reference", "", any),
        Column::number("computed", "", any),
        Column::number("error", "", any),
        Column::number("bound", "", any),
        Column::number("passes", "", any),
    ]);
    for (formula, check) in formulas.iter().flat_map(|one| one.checks.iter().map(move |check| (one, check))) {
        table.row([
            formula.title.clone().into(),
            check.case.clone().into(),
            check.quantity.clone().into(),
            check.unit.into(),
            check.reference.into(),
            check.computed.into(),
            check.error().into(),
            check.bound.into(),
            check.passes().into(),
        ]);
    }
    tables::table(py, table)
}
