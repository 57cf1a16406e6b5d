//! Checks of walls by building codes, and of formulas against references.

use check::{CheckError, CheckFile, Subject, read};
use evidence::verification::{page, verify};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::table::Column;
use run::records::NamedRecord;

use crate::arrays::Motion;
use crate::errors::{failed, of_scene, refused};
use crate::tables::table;
use crate::walls::Wall;

/// Checks a wall by the table `[check]` in a text, with records by their names; returns what its verdict says
/// and its numbers as JSON, its rows, and its picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    text: String,
    records: Vec<(String, Motion)>,
) -> PyResult<(String, String, Bound<'py, PyDict>, String)> {
    let record = |(name, Motion(motion)): (String, Motion)| NamedRecord { name, motion };
    let records = records.into_iter().map(record).collect();
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

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(verify).map_err(failed)?;
    let mut rows = page::all(&formulas);
    rows.columns.insert(0, Column::text("formula", ""));
    rows.columns.push(Column::count("passes", ""));
    let own = formulas.iter().flat_map(|one| one.comparisons.iter().map(|row| (&one.title, row.passes())));
    for (row, (title, passes)) in rows.rows.iter_mut().zip(own) {
        row.insert(0, title.clone().into());
        row.push(passes.into());
    }
    table(py, rows)
}
