//! Viscous damping that matches restitution.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::variables::DampingModel;
use study::calibration::figure::charts;
use study::calibration::{
    Calibration, CalibrationError, Grid, calibrate, calibrated_models, model_named, table,
};

use crate::arrays::samples;
use crate::errors::{failed, refused};
use crate::tables;
use crate::walls::Wall;
use crate::watch::threads_of;

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
    threads: Option<&Bound<'_, PyAny>>,
) -> PyResult<([Bound<'py, PyDict>; 3], Vec<String>)> {
    let mut grid = Grid { start: samples(start)?, step, ..Grid::default() };
    if let Some(restitution) = &restitution {
        grid.restitution = samples(restitution)?;
    }
    if let Some(a1) = &a1 {
        grid.a1 = samples(a1)?;
    }
    let parameters = &wall.scene.parameters;
    let models = match models {
        Some(names) => names.iter().map(|name| model(name)).collect::<PyResult<_>>()?,
        None => calibrated_models(parameters),
    };
    let threads = threads_of(threads)?;
    let mut found = Vec::with_capacity(models.len());
    for model in models {
        grid.check(model).map_err(of_calibration)?;
        let mut fits = Vec::new();
        // between two values of a1 this thread looks at Ctrl-C
        for &a1 in &grid.a1 {
            let grid = Grid { a1: vec![a1], ..grid.clone() };
            let part = py.detach(|| calibrate(parameters, model, &grid, threads)).map_err(of_calibration)?;
            // a law with an a1 of its own has one part
            let is_own = part.fits.iter().any(|fit| fit.a1 != a1);
            fits.extend(part.fits);
            py.check_signals()?;
            if is_own {
                break;
            }
        }
        found.push(Calibration::new(model, fits));
    }
    let tables = [table::fits, table::coefficients, table::laws].map(|of| tables::table(py, of(&found)));
    let [fits, coefficients, laws] = tables;
    Ok((
        [fits?, coefficients?, laws?],
        charts(&found).iter().map(|drawn| drawn.figure_file().svg()).collect(),
    ))
}

fn model(name: &str) -> PyResult<DampingModel> {
    model_named(name).map_err(|error| refused(format!("models: {error}")))
}

fn of_calibration(error: CalibrationError) -> PyErr {
    match error {
        CalibrationError::Run { .. } | CalibrationError::Minimiser(_) => failed(error),
        _ => refused(error),
    }
}
