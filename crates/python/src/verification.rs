//! Every formula against a reference of its own.

use evidence::verification::{Check, library, verify};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::failed;
use crate::tables::Column::{Flags, Names, Numbers};
use crate::tables::table;

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(|| verify(library)).map_err(failed)?;
    let rows = || formulas.iter().flat_map(|one| one.checks.iter().map(|check| (one.title.as_str(), check)));
    let names = |name: fn(&Check) -> &str| Names(rows().map(|(_, check)| name(check).into()).collect());
    let numbers = |number: fn(&Check) -> f64| Numbers(rows().map(|(_, check)| number(check)).collect());
    let columns = [
        ("formula", Names(rows().map(|(title, _)| title.into()).collect())),
        ("case", names(|check| &check.case)),
        ("quantity", names(|check| &check.quantity)),
        ("unit", names(|check| check.unit)),
        ("reference", numbers(|check| check.reference)),
        ("computed", numbers(|check| check.computed.unwrap_or(f64::NAN))),
        ("error", numbers(|check| check.error().unwrap_or(f64::NAN))),
        ("bound", numbers(|check| check.bound)),
        ("passes", Flags(rows().map(|(_, check)| check.passes()).collect())),
    ];
    table(py, columns)
}
