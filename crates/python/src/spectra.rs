//! Rocking spectra.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rocking_wall::scene::DEFAULT_TAIL;
use rocking_wall::simulation::Excitation;
use study::spectrum::figure::{Shown, svg};
use study::spectrum::{
    MOST_POINTS, Point, PulseForm, RockingSpectrum, Size, Slenderness, SpectrumError, common_motion,
    over_pulses, over_walls,
};

use crate::arrays::{Given, Numbers, grid, motion, samples};
use crate::errors::{of_scene, refused};
use crate::walls::Wall;
use crate::watch::{self, Threads};

/// Columns and rows, and of each row and column: u/`u_ins`, whether the wall rocked, the time of overturning.
type Values<'py> = (
    Numbers<'py>,
    Numbers<'py>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<bool>>,
    Bound<'py, PyArray2<f64>>,
);

/// Computes the spectrum of a record, or of the motion of the wall's scene, over walls.
#[pyfunction]
pub(crate) fn spectrum_over_walls<'py>(
    py: Python<'py>,
    wall: &Wall,
    record: Option<Given<'py>>,
    sizes: (bool, Bound<'py, PyAny>),
    slendernesses: (bool, Bound<'py, PyAny>),
    threads: Option<Threads>,
) -> PyResult<Values<'py>> {
    let mut scene = wall.scene.clone();
    if let Some(record) = &record {
        scene.shake(Excitation::new(motion(record)?, None), DEFAULT_TAIL, Vec::new());
    }
    let motion = common_motion(&scene).map_err(of_scene)?;
    let size = if sizes.0 { Size::SemiDiagonal } else { Size::Height };
    let slenderness = if slendernesses.0 { Slenderness::Angle } else { Slenderness::Ratio };
    let (columns, rows) = (samples(&sizes.1)?, samples(&slendernesses.1)?);
    check_count(columns.len(), rows.len())?;
    let threads = watch::count(threads).get();
    let mut points = Vec::with_capacity(rows.len());
    // between two rows this thread looks at Ctrl-C
    for row in &rows {
        let row = std::slice::from_ref(row);
        let over = || over_walls(&scene.parameters, &motion, (size, &columns), (slenderness, row), threads);
        points.extend(py.detach(over).map_err(of_spectrum)?.points);
        py.check_signals()?;
    }
    values(py, RockingSpectrum { columns, rows, points })
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
    threads: Option<Threads>,
) -> PyResult<Values<'py>> {
    let form = PulseForm::from_name(form)
        .ok_or_else(|| refused(format!("form = {form:?} is not one of ricker, sine_cycle, half_sine")))?;
    let (columns, rows) = (samples(columns)?, samples(rows)?);
    check_count(columns.len(), rows.len())?;
    let (parameters, threads) = (&wall.scene.parameters, watch::count(threads).get());
    let mut points = vec![Vec::with_capacity(columns.len()); rows.len()];
    for columns in columns.chunks(COLUMNS_AT_ONCE * threads) {
        let over = || over_pulses(parameters, form, columns, &rows, threads);
        let found = py.detach(over).map_err(of_spectrum)?.points;
        points.iter_mut().zip(found).for_each(|(row, found)| row.extend(found));
        py.check_signals()?;
    }
    values(py, RockingSpectrum { columns, rows, points })
}

/// Draws a spectrum, as SVG, from its values row by row.
#[pyfunction]
pub(crate) fn picture_of_spectrum(
    columns: Vec<f64>,
    rows: Vec<f64>,
    points: Vec<Vec<(f64, bool, f64)>>,
    title: String,
    labels: [String; 2],
) -> String {
    let point = |(ratio, rocked, time): (f64, bool, f64)| Point {
        ratio,
        rocked,
        overturning: (!time.is_nan()).then_some(time),
    };
    let points = points.into_iter().map(|row| row.into_iter().map(point).collect()).collect();
    let spectrum = RockingSpectrum { columns, rows, points };
    svg(&Shown {
        spectrum,
        title,
        notes: Vec::new(),
        labels,
        names: ["", ""],
        axes: String::new(),
        own: None,
    })
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
    let RockingSpectrum { columns, rows, points } = spectrum;
    Ok((
        PyArray1::from_vec(py, columns),
        PyArray1::from_vec(py, rows),
        grid(py, &points, |point| point.ratio)?,
        grid(py, &points, |point| point.rocked)?,
        grid(py, &points, |point| point.overturning.unwrap_or(f64::NAN))?,
    ))
}
