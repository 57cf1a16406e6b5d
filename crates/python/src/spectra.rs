//! Rocking spectra.

use numpy::PyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::scene::DEFAULT_TAIL;
use rocking_wall::simulation::Excitation;
use study::spectrum::figure::{Shown, svg};
use study::spectrum::{
    MOST_POINTS, PulseForm, QUANTITIES, RockingSpectrum, Size, Slenderness, SpectrumError, common_motion,
    over_pulses, over_walls,
};

use crate::arrays::{Motion, Numbers, samples};
use crate::errors::{of_scene, refused};
use crate::tables;
use crate::walls::Wall;
use crate::watch::threads_of;

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
    threads: Option<&Bound<'_, PyAny>>,
) -> PyResult<Values<'py>> {
    let mut scene = wall.scene.clone();
    if let Some(Motion(record)) = record {
        scene.shake(Excitation::new(record, None), DEFAULT_TAIL, Vec::new());
    }
    let motion = common_motion(&scene).map_err(of_scene)?;
    let size = if sizes.0 { Size::SemiDiagonal } else { Size::Height };
    let slenderness = if slendernesses.0 { Slenderness::Angle } else { Slenderness::Ratio };
    let (columns, rows) = (samples(&sizes.1)?, samples(&slendernesses.1)?);
    check_count(columns.len(), rows.len())?;
    let threads = threads_of(threads)?.get();
    let quantities = [size.quantity(), slenderness.quantity()];
    let mut points = Vec::with_capacity(rows.len());
    // between two rows this thread looks at Ctrl-C
    for row in &rows {
        let row = std::slice::from_ref(row);
        let over = || over_walls(&scene.parameters, &motion, (size, &columns), (slenderness, row), threads);
        points.extend(py.detach(over).map_err(of_spectrum)?.points);
        py.check_signals()?;
    }
    values(py, RockingSpectrum { quantities, columns, rows, points })
}

/// Columns of pulses for each thread between two looks at Ctrl-C.
const COLUMNS_AT_ONCE: usize = 2;

/// Computes the dimensionless spectrum of pulses of one form.
#[pyfunction]
pub(crate) fn spectrum_over_pulses<'py>(
    py: Python<'py>,
    wall: &Wall,
    form: &str,
    columns: &Bound<'py, PyAny>,
    rows: &Bound<'py, PyAny>,
    threads: Option<&Bound<'_, PyAny>>,
) -> PyResult<Values<'py>> {
    let form = PulseForm::from_name(form)
        .ok_or_else(|| refused(format!("form = {form:?} is not one of ricker, sine_cycle, half_sine")))?;
    let (columns, rows) = (samples(columns)?, samples(rows)?);
    check_count(columns.len(), rows.len())?;
    let (parameters, threads) = (&wall.scene.parameters, threads_of(threads)?.get());
    let quantities = [QUANTITIES[4], QUANTITIES[5]];
    let mut points = vec![Vec::with_capacity(columns.len()); rows.len()];
    for columns in columns.chunks(COLUMNS_AT_ONCE * threads) {
        let over = || over_pulses(parameters, form, columns, &rows, threads);
        let found = py.detach(over).map_err(of_spectrum)?.points;
        points.iter_mut().zip(found).for_each(|(row, found)| row.extend(found));
        py.check_signals()?;
    }
    values(py, RockingSpectrum { quantities, columns, rows, points })
}

fn check_count(columns: usize, rows: usize) -> PyResult<()> {
    let found = columns * rows;
    if found == 0 {
        return Err(refused("a spectrum needs at least one value along each axis"));
    }
    if found > MOST_POINTS { Err(refused(SpectrumError::TooManyPoints { found })) } else { Ok(()) }
}

fn of_spectrum(error: SpectrumError) -> PyErr {
    match error {
        SpectrumError::Run { .. } => PyRuntimeError::new_err(error.to_string()),
        _ => refused(error),
    }
}

fn values(py: Python<'_>, spectrum: RockingSpectrum) -> PyResult<Values<'_>> {
    let (title, table) = ("Rocking spectrum".to_owned(), tables::table(py, spectrum.table())?);
    let shown = Shown { spectrum, title, notes: Vec::new(), axes: String::new(), own: None };
    let [columns, rows] =
        [&shown.spectrum.columns, &shown.spectrum.rows].map(|v| PyArray1::from_slice(py, v));
    Ok((columns, rows, table, svg(&shown)))
}
