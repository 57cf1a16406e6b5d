//! The schemas of scenes and studies, and what follows from the parameters of a wall.

use files::file_schema;
use fmu_export::{Causality, VariableId};
use pyo3::prelude::*;
use rocking_wall::variables::RealVariable;
use scene::Document;
use study::document::StudyFile;

use crate::errors::failed;

/// Returns the JSON schemas of a scene, with the parameters of a wall, and of a study.
#[pyfunction]
pub(crate) fn schemas() -> PyResult<[String; 2]> {
    let [mut scene, mut study] = [file_schema::<Document>("Scene of rocking-wall"), StudyFile::schema()];
    check::complete(&mut scene);
    check::complete(&mut study);
    Ok([serde_json::to_string(&scene).map_err(failed)?, serde_json::to_string(&study).map_err(failed)?])
}

/// Lists what follows from the parameters: name, description, unit.
#[pyfunction]
pub(crate) fn calculated() -> Vec<(&'static str, &'static str, &'static str)> {
    let all = RealVariable::ALL.iter().map(|variable| variable.variable());
    let calculated = all.filter(|variable| variable.causality == Causality::CalculatedParameter);
    // the description writes "1" for what has no unit
    let unit = |unit: Option<&'static str>| unit.filter(|unit| *unit != "1").unwrap_or_default();
    calculated.map(|variable| (variable.name, variable.description, unit(variable.unit))).collect()
}
