//! Ties of any stiffness.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::response::Fate;
use run::polarity::Polarities;
use study::tie::figure::picture;
use study::tie::{Outcome, Row, TieError, TieStudy, table};

use crate::arrays::{Motion, grid, samples};
use crate::errors::{of_scene, refused};
use crate::tables;
use crate::walls::Wall;
use crate::watch::threads_of;

/// Runs for each thread between two looks at Ctrl-C.
const RUNS_AT_ONCE: usize = 4;

/// Runs a wall with a tie of each stiffness under each motion; returns the outcomes by stiffness and motion,
/// their table, the picture, and whether one sign of the motions stands for both.
#[pyfunction]
pub(crate) fn tie_of_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    records: Vec<Motion>,
    stiffness: Option<Bound<'py, PyAny>>,
    both_polarities: bool,
    threads: Option<&Bound<'_, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>, String, bool)> {
    let records = records.into_iter().map(|Motion(record)| record).collect();
    let given = stiffness.as_ref().map(samples).transpose()?.unwrap_or_default();
    let study = TieStudy::new(wall.scene.clone(), records, both_polarities).map_err(refused)?;
    let stiffnesses = study.stiffnesses(&given).map_err(refused)?;
    let threads = threads_of(threads)?.get();
    let at_once = (RUNS_AT_ONCE * threads).div_ceil(study.motions());
    let mut rows = Vec::with_capacity(stiffnesses.len());
    for stiffnesses in stiffnesses.chunks(at_once) {
        rows.extend(py.detach(|| study.rows(stiffnesses, threads)).map_err(of_tie)?);
        py.check_signals()?;
    }
    let is_alike = study.polarities() == Polarities::Alike;
    Ok((outcomes(py, &rows)?, tables::table(py, table(&rows))?, picture(&rows).svg(), is_alike))
}

fn of_tie(error: TieError) -> PyErr {
    match error {
        TieError::Run(error) => of_scene(error),
        other => refused(other),
    }
}

fn outcomes<'py>(py: Python<'py>, rows: &[Row]) -> PyResult<Bound<'py, PyDict>> {
    let of: Vec<&[Outcome]> = rows.iter().map(|row| &row.outcomes[..]).collect();
    let values = PyDict::new(py);
    values.set_item("stiffness", PyArray1::from_iter(py, rows.iter().map(|row| row.stiffness)))?;
    values.set_item("force", grid(py, &of, |outcome| outcome.force)?)?;
    values.set_item("u_ratio_max", grid(py, &of, |outcome| outcome.u_ratio)?)?;
    values.set_item("falls", grid(py, &of, |outcome| outcome.fate.falls())?)?;
    values.set_item("falls_away_from_tie", grid(py, &of, |outcome| outcome.away)?)?;
    let comes_back = |outcome: &Outcome| matches!(outcome.fate, Fate::ComesBack { .. });
    values.set_item("beyond_u_ins_and_back", grid(py, &of, comes_back)?)?;
    values.set_item("strength_reached", grid(py, &of, |outcome| outcome.reached)?)?;
    Ok(values)
}
