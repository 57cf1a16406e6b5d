//! Checks of walls by building codes.

use check::{CheckError, CheckFile, Subject, read};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::records::NamedRecord;

use crate::arrays::{MotionValues, motion};
use crate::errors::{of_scene, refused};
use crate::tables::table;
use crate::walls::Wall;

/// Checks a wall by the table `[check]` in a text, with records by their names; returns what its verdict says
/// and its numbers as JSON, its rows, and its picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    text: String,
    records: Vec<(String, MotionValues<'_>)>,
) -> PyResult<(String, String, Bound<'py, PyDict>, String)> {
    let record =
        |(name, given): (String, MotionValues<'_>)| Ok(NamedRecord { name, motion: motion(&given)? });
    let records = records.into_iter().map(record).collect::<PyResult<_>>()?;
    let subject = Subject::from(&wall.scene);
    let checked = py.detach(|| {
        let code = read(&CheckFile::parse("check", &text)?.with_records(records))?;
        let verdict = code.check(subject)?;
        let picture = verdict.details.figure()?.plot.picture().svg();
        Ok((verdict.summary().to_string(), verdict.json().to_string(), verdict.table(), picture))
    });
    let (summary, numbers, rows, picture) = checked.map_err(|error: CheckError| match error {
        CheckError::Scene(error) => of_scene(error),
        other => refused(other),
    })?;
    Ok((summary, numbers, table(py, rows)?, picture))
}
