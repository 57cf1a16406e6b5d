//! The parameters of the model description, and the schema of studies.

use fmu_export::{Causality, Kind, Variable, VariableId};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::scene::{GROUPS, variable};
use rocking_wall::variables::RealVariable;
use study::document::StudyFile;

use crate::errors::failed;

/// Lists the parameters: name, group, unit, description, limits or choices, default.
#[pyfunction]
pub(crate) fn variables(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let names = GROUPS.iter().flat_map(|(group, names)| names.iter().map(move |name| (*group, *name)));
    names.filter_map(|(group, name)| Some(entry(py, group, variable(name)?))).collect()
}

/// Lists what follows from the parameters: name, description, unit.
#[pyfunction]
pub(crate) fn calculated() -> Vec<(&'static str, &'static str, &'static str)> {
    let all = RealVariable::ALL.iter().map(|variable| variable.variable());
    let calculated = all.filter(|variable| variable.causality == Causality::CalculatedParameter);
    calculated.map(|variable| (variable.name, variable.description, unit(variable))).collect()
}

/// Returns the JSON schema of a study file.
#[pyfunction]
pub(crate) fn study_schema() -> PyResult<String> {
    let mut schema = StudyFile::schema();
    check::complete(&mut schema);
    serde_json::to_string(&schema).map_err(failed)
}

/// Returns the unit of a variable; the description writes "1" for what has none.
fn unit(variable: &Variable) -> &'static str {
    variable.unit.filter(|unit| *unit != "1").unwrap_or_default()
}

fn entry<'py>(py: Python<'py>, group: &str, variable: &Variable) -> PyResult<Bound<'py, PyDict>> {
    let values = PyDict::new(py);
    values.set_item("name", variable.name)?;
    values.set_item("group", group)?;
    values.set_item("description", variable.description)?;
    values.set_item("unit", unit(variable))?;
    match variable.kind {
        Kind::Real { start, min, max } => {
            values.set_item("default", start)?;
            values.set_item("limits", (min, max))?;
            values.set_item("choices", Vec::<&str>::new())?;
        }
        Kind::Enumeration { start, items } => {
            let default = items.iter().find(|item| Some(item.value) == start);
            values.set_item("default", default.map(|item| item.name))?;
            values.set_item("limits", (None::<f64>, None::<f64>))?;
            values.set_item("choices", items.iter().map(|item| item.name).collect::<Vec<_>>())?;
        }
        Kind::Integer { .. } | Kind::Boolean { .. } | Kind::String { .. } => {}
    }
    Ok(values)
}
