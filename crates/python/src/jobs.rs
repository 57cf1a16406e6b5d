//! What is computed of a wall beside its runs: checks by codes, rocking spectra, ties of any stiffness,
//! damping that matches restitution; and of formulas beside references.

use check::{AtLevel, CheckError, CheckFile, Code, Language, Origin, Subject, at_level, page, read};
use evidence::verification::{self, verify};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::plot::Plot;
use report::table::Column;
use rocking_wall::simulation::Excitation;
use run::polarity::Polarities;
use scene::response::Fate;
use scene::{DEFAULT_TAIL, to_toml};
use study::calibration::figure::charts;
use study::calibration::{self, CalibrationError, Grid, calibrate, calibrated_models, model_named};
use study::spectrum::figure::{Shown, svg};
use study::spectrum::{
    PulseForm, RecordPulses, RockingSpectrum, Size, Slenderness, SpectrumError, common_motion, over_pulses,
    over_walls,
};
use study::tie::{self, Outcome, Row, TieError, TieStudy};

use crate::arrays::{Motion, Numbers, grid, named_records, samples};
use crate::errors::{failed, of_scene, refused};
use crate::tables::table;
use crate::walls::Wall;
use crate::watch::{stoppable, threads_of};

/// Checks a wall by the table `[check]` in a text, with records by their names; returns what its verdict says
/// and its numbers as JSON, its rows, and its picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    text: String,
    records: Vec<(String, Motion)>,
) -> PyResult<(String, String, Bound<'py, PyDict>, String)> {
    let (records, subject) = (named_records(records), Subject::from(wall));
    let checked = stoppable(py, || {
        let code = read(&CheckFile::parse("check", &text)?.with_records(records))?;
        let verdict = code.check(subject)?;
        let picture = verdict.details.figure(Language::En)?.plot.picture();
        Ok((verdict.summary().to_string(), verdict.json().to_string(), verdict.table(), picture))
    })?;
    let (summary, numbers, rows, picture) = checked.map_err(of_check)?;
    Ok((summary, numbers, table(py, rows)?, picture))
}

/// Makes the report of a check, by the tables `[check]` and `[report]` in a text, as a page.
#[pyfunction]
pub(crate) fn check_report(
    py: Python<'_>,
    wall: &Wall,
    text: String,
    records: Vec<(String, Motion)>,
    title: Option<String>,
) -> PyResult<String> {
    let records = named_records(records);
    let text = to_toml(&wall.scene, "") + "\n" + &text;
    let made = stoppable(py, || {
        let file = CheckFile::parse("wall.toml", &text)?.with_records(records);
        let (code, report) = (read(&file)?, file.report()?);
        let verdict = code.check(Subject::from(wall))?;
        let title = title.as_deref().unwrap_or(&wall.scene.title);
        let program = concat!("rocking_wall ", env!("PACKAGE_VERSION"));
        page(&verdict, &Origin::new(title, &file, code.records(), &report, program))
    })?;
    made.map_err(of_check)
}

fn of_check(error: CheckError) -> PyErr {
    match error {
        CheckError::File(error) => of_scene(error.into()),
        CheckError::Scene(error) => of_scene(error),
        other => refused(other),
    }
}

/// Checks every formula; returns the table of the numbers.
#[pyfunction]
pub(crate) fn verify_formulas(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let formulas = py.detach(verify).map_err(failed)?;
    let mut rows = verification::page::all(&formulas);
    rows.columns.insert(0, Column::text("formula", ""));
    rows.columns.push(Column::count("passes", ""));
    let own = formulas.iter().flat_map(|one| one.comparisons.iter().map(|row| (&one.title, row.passes())));
    for (row, (title, passes)) in rows.rows.iter_mut().zip(own) {
        row.insert(0, title.clone().into());
        row.push(passes.into());
    }
    table(py, rows)
}

/// Columns, rows, the table of `wall study spectrum --csv`, and the picture.
type Values<'py> = (Numbers<'py>, Numbers<'py>, Bound<'py, PyDict>, String);

/// Computes the spectrum of a record, or of the motion of the wall's scene, over walls.
#[pyfunction]
pub(crate) fn spectrum_over_walls<'py>(
    py: Python<'py>,
    wall: &Wall,
    record: Option<Motion>,
    sizes: (bool, Bound<'py, PyAny>),
    slendernesses: (bool, Bound<'py, PyAny>),
    threads: Option<i64>,
) -> PyResult<Values<'py>> {
    let mut scene = wall.scene.clone();
    if let Some(Motion(record)) = record {
        scene.shake(Excitation::new(record, None), DEFAULT_TAIL, Vec::new());
    }
    let motion = common_motion(&scene).map_err(of_scene)?;
    let size = if sizes.0 { Size::SemiDiagonal } else { Size::Height };
    let slenderness = if slendernesses.0 { Slenderness::Angle } else { Slenderness::Ratio };
    let (parameters, threads) = (&scene.parameters, threads_of(threads)?.get());
    spectrum(py, [&sizes.1, &slendernesses.1], |columns, rows| {
        over_walls(parameters, &motion, size, columns, slenderness, rows, threads)
    })
}

/// Computes the dimensionless spectrum of pulses of one form.
#[pyfunction]
pub(crate) fn spectrum_over_pulses<'py>(
    py: Python<'py>,
    wall: &Wall,
    form: &str,
    columns: &Bound<'py, PyAny>,
    rows: &Bound<'py, PyAny>,
    threads: Option<i64>,
) -> PyResult<Values<'py>> {
    let form = PulseForm::from_name(form).map_err(|message| refused(format!("form = {message}")))?;
    let (parameters, threads) = (&wall.scene.parameters, threads_of(threads)?.get());
    spectrum(py, [columns, rows], |columns, rows| over_pulses(parameters, form, columns, rows, threads))
}

/// Finds the pulses of a record for a wall; returns their table.
#[pyfunction]
pub(crate) fn record_pulses<'py>(
    py: Python<'py>,
    wall: &Wall,
    record: Motion,
    threads: Option<i64>,
) -> PyResult<Bound<'py, PyDict>> {
    let (mut scene, threads) = (wall.scene.clone(), threads_of(threads)?.get());
    scene.shake(Excitation::new(record.0, None), DEFAULT_TAIL, Vec::new());
    let motion = common_motion(&scene).map_err(of_scene)?;
    let found = stoppable(py, || RecordPulses::new(&scene.parameters, motion, threads))?;
    table(py, found.map_err(refused)?.table())
}

/// Computes a spectrum along the values of its axes.
fn spectrum<'py>(
    py: Python<'py>,
    axes: [&Bound<'py, PyAny>; 2],
    over: impl FnOnce(&[f64], &[f64]) -> Result<RockingSpectrum, SpectrumError> + Send,
) -> PyResult<Values<'py>> {
    let (columns, rows) = (samples(axes[0])?, samples(axes[1])?);
    if columns.is_empty() || rows.is_empty() {
        return Err(refused("a spectrum needs at least one value along each axis"));
    }
    let spectrum = stoppable(py, || over(&columns, &rows))?.map_err(|error| match error {
        SpectrumError::Run { .. } => failed(error),
        _ => refused(error),
    })?;
    let (title, table) = ("Rocking spectrum".to_owned(), table(py, spectrum.table())?);
    let shown = Shown { spectrum, title, notes: Vec::new(), axes: String::new(), own: None };
    let [columns, rows] =
        [&shown.spectrum.columns, &shown.spectrum.rows].map(|v| PyArray1::from_slice(py, v));
    Ok((columns, rows, table, svg(&shown)))
}

/// A limit state, a text with the table `[check]`, and records by their names.
type OfCheck = (String, String, Vec<(String, Motion)>);

/// Outcomes, table, picture, whether one sign stands for both, and warnings of a study of a tie.
type TieValues<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, String, bool, Vec<String>);

/// Runs a wall whose tie has each value of a parameter under each motion, or under the records of a check at
/// the level of a limit state; returns the outcomes by value and motion, their table, the picture, whether
/// one sign of the motions stands for both, and what is to be known of the records.
#[pyfunction]
pub(crate) fn tie_of_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    records: Vec<Motion>,
    level: Option<OfCheck>,
    varied: (String, Option<Bound<'py, PyAny>>),
    both_polarities: bool,
    threads: Option<i64>,
) -> PyResult<TieValues<'py>> {
    let AtLevel { scene, motions, both_signs, warnings, .. } = if let Some((state, text, named)) = level {
        let code = || read(&CheckFile::parse("check", &text)?.with_records(named_records(named)));
        let at = |code: Box<dyn Code>| at_level(&*code, &wall.scene, &wall.assumed, &state);
        code().and_then(at).map_err(of_check)?
    } else {
        let motions = records.into_iter().map(|Motion(record)| record).collect();
        AtLevel::as_given(wall.scene.clone(), motions)
    };
    let (parameter, given) = varied;
    let given = given.as_ref().map(samples).transpose()?.unwrap_or_default();
    let varied = tie::ALL.iter().find(|varied| varied.parameter == parameter);
    let varied = varied.unwrap_or_else(|| unreachable!("the package names those that there are"));
    let study = TieStudy::new(scene, varied, &given, motions, both_polarities || both_signs);
    let study = study.map_err(refused)?;
    let threads = threads_of(threads)?.get();
    let rows = stoppable(py, || study.rows(threads))?.map_err(|error| match error {
        TieError::Run(error) => of_scene(error),
        other => refused(other),
    })?;
    let is_alike = study.polarities() == Polarities::Alike;
    let table = table(py, tie::table(&study, &rows))?;
    Ok((outcomes(py, &rows)?, table, tie::figure::picture(&study, &rows), is_alike, warnings))
}

fn outcomes<'py>(py: Python<'py>, rows: &[Row]) -> PyResult<Bound<'py, PyDict>> {
    let of: Vec<&[Outcome]> = rows.iter().map(|row| &row.outcomes[..]).collect();
    let values = PyDict::new(py);
    values.set_item("values", PyArray1::from_iter(py, rows.iter().map(|row| row.value)))?;
    values.set_item("force", grid(py, &of, |outcome| outcome.force)?)?;
    values.set_item("u_ratio_max", grid(py, &of, |outcome| outcome.u_ratio)?)?;
    values.set_item("falls", grid(py, &of, |outcome| outcome.fate.falls())?)?;
    values.set_item("falls_away_from_tie", grid(py, &of, |outcome| outcome.away)?)?;
    let comes_back = |outcome: &Outcome| matches!(outcome.fate, Fate::ComesBack { .. });
    values.set_item("beyond_u_ins_and_back", grid(py, &of, comes_back)?)?;
    values.set_item("strength_reached", grid(py, &of, |outcome| outcome.reached)?)?;
    values.set_item("elongation", grid(py, &of, |outcome| outcome.elongation)?)?;
    values.set_item("broken", grid(py, &of, |outcome| outcome.broken)?)?;
    Ok(values)
}

/// Calibrates damping models of a wall; returns the tables of fits, coefficients and laws, and the charts.
#[pyfunction]
pub(crate) fn calibrate_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    models: Option<Vec<String>>,
    restitution: Option<Bound<'py, PyAny>>,
    a1: Option<Bound<'py, PyAny>>,
    start: &Bound<'py, PyAny>,
    step: f64,
    threads: Option<i64>,
) -> PyResult<([Bound<'py, PyDict>; 3], Vec<String>)> {
    let usual = Grid::default();
    let grid = Grid {
        restitution: restitution.as_ref().map_or(Ok(usual.restitution), samples)?,
        a1: a1.as_ref().map_or(Ok(usual.a1), samples)?,
        start: samples(start)?,
        step,
    };
    let parameters = &wall.scene.parameters;
    let models = match models {
        Some(names) => names
            .iter()
            .map(|name| model_named(name))
            .collect::<Result<_, _>>()
            .map_err(|error| refused(format!("models: {error}")))?,
        None => calibrated_models(parameters),
    };
    let threads = threads_of(threads)?;
    let all = || {
        models
            .iter()
            .map(|&model| calibrate(parameters, model, &grid, threads))
            .collect::<Result<Vec<_>, _>>()
    };
    let found = stoppable(py, all)?.map_err(|error| match error {
        CalibrationError::Run { .. } | CalibrationError::Minimiser(_) => failed(error),
        _ => refused(error),
    })?;
    let tables = [calibration::table::fits, calibration::table::coefficients, calibration::table::laws]
        .map(|of| table(py, of(&found)));
    let [fits, coefficients, laws] = tables;
    Ok(([fits?, coefficients?, laws?], charts(&found).iter().map(Plot::figure_file).collect()))
}
