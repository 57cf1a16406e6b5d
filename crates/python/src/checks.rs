//! The check of a wall by a code.

use check::CheckError;
use check::code::{Given, Subject, in_table, read};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::scene::{Place, SceneError};
use run::records::NamedRecord;
use serde_json::json;

use crate::arrays::{self, motion};
use crate::errors::{of_scene, refused};
use crate::tables::{columns_of, table};
use crate::walls::Wall;

/// Checks a wall by the table `[check]` in a text, with records by their names; returns the verdict as JSON,
/// its rows, and the picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    text: String,
    records: Vec<(String, arrays::Given<'py>)>,
) -> PyResult<(String, Bound<'py, PyDict>, String)> {
    let record =
        |(name, given): (String, arrays::Given<'_>)| Ok(NamedRecord { name, motion: motion(&given)? });
    let records = records.into_iter().map(record).collect::<PyResult<_>>()?;
    let checked = py.detach(|| {
        let place = Place::new("check", &text);
        let both = || -> Result<_, CheckError> {
            let Some(code) = read(&place, Given { records, ..Given::default() })? else {
                unreachable!("the text has a table [check]")
            };
            let subject = Subject::from(&wall.scene);
            Ok((code.check(&subject)?, code.plot(&subject)?))
        };
        both().map_err(|error| in_table(error, &place))
    });
    let (verdict, plot) = checked.map_err(|error| match error {
        // the user has not written this text, so its line numbers say nothing
        SceneError::Line { message, .. } | SceneError::File { reason: message, .. } => refused(message),
        other => of_scene(other),
    })?;
    let values = json!({
        "code": verdict.code,
        "passed": verdict.passed,
        "governs": verdict.governs,
        "side": verdict.side,
        "zeta_E": verdict.zeta,
        "headline": verdict.headline,
        "values": verdict.values,
        "warnings": verdict.warnings,
    });
    Ok((values.to_string(), table(py, columns_of(&verdict.rows))?, plot.picture().svg()))
}
