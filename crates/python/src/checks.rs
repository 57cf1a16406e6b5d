//! Checks of walls by building codes.

use check::{CheckError, CheckFile, Subject, read};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use run::records::NamedRecord;

use crate::arrays::{MotionValues, motion};
use crate::errors::{of_scene, refused};
use crate::tables::table;
use crate::walls::Wall;

/// Checks a wall by the table `[check]` in a text, with records by their names; returns the fields of a
/// verdict.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    text: String,
    records: Vec<(String, MotionValues<'_>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let record =
        |(name, given): (String, MotionValues<'_>)| Ok(NamedRecord { name, motion: motion(&given)? });
    let records = records.into_iter().map(record).collect::<PyResult<_>>()?;
    let subject = Subject::from(&wall.scene);
    let checked = py.detach(|| {
        let code = read(&CheckFile::parse("check", &text)?.with_records(records))?;
        let verdict = code.check(subject)?;
        let picture = verdict.details.figure()?.plot.picture().svg();
        let texts = [verdict.code.name.to_owned(), verdict.headline(), verdict.json().to_string(), picture];
        let side = verdict.at("both sides");
        let table = verdict.table();
        Ok((
            texts,
            (verdict.passed, verdict.governs, side, verdict.zeta),
            table,
            verdict.notes,
            verdict.warnings,
        ))
    });
    let (texts, (passed, governs, side, zeta), rows, notes, warnings) =
        checked.map_err(|error: CheckError| match error {
            CheckError::Scene(error) => of_scene(error),
            other => refused(other),
        })?;
    let [code, headline, numbers, picture] = texts;
    let fields = PyDict::new(py);
    for (name, text) in [("code", code), ("headline", headline), ("numbers", numbers), ("_picture", picture)]
    {
        fields.set_item(name, text)?;
    }
    fields.set_item("passed", passed)?;
    fields.set_item("governs", governs)?;
    fields.set_item("side", side)?;
    fields.set_item("zeta", zeta)?;
    fields.set_item("table", table(py, rows)?)?;
    fields.set_item("notes", notes)?;
    fields.set_item("warnings", warnings)?;
    Ok(fields)
}
