//! Viscous damping that matches restitution.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use report::chart;
use rocking_wall::variables::DampingModel;
use study::calibration::figure::{charts, printed};
use study::calibration::{
    Calibration, CalibrationError, Coefficient, Fit, Grid, calibrate, calibrated_models, model_named,
};

use crate::arrays::samples;
use crate::errors::{failed, refused};
use crate::tables::Column::{Counts, Names, Numbers};
use crate::tables::table;
use crate::walls::Wall;
use crate::watch::{self, Threads};

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
    threads: Option<Threads>,
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
    let threads = watch::count(threads);
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
    Ok((tables(py, &found)?, charts(&found).iter().map(|drawn| chart::picture(drawn).svg()).collect()))
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

/// The fits, as `wall calibrate --csv` writes them; x of each a₁ and u₀ with what the paper prints; the laws.
fn tables<'py>(py: Python<'py>, found: &[Calibration]) -> PyResult<[Bound<'py, PyDict>; 3]> {
    let fits: Vec<(&str, &Fit)> =
        found.iter().flat_map(|one| one.fits.iter().map(|fit| (one.model.name(), fit))).collect();
    let of = |value: fn(&Fit) -> f64| Numbers(fits.iter().map(|(_, fit)| value(fit)).collect());
    let fits = [
        ("damping_model", Names(fits.iter().map(|(model, _)| (*model).into()).collect())),
        ("a1", of(|fit| fit.a1)),
        ("u0_over_u_ins", of(|fit| fit.start)),
        ("restitution", of(|fit| fit.restitution)),
        ("damping", of(|fit| fit.damping)),
        ("error", of(|fit| fit.error)),
        ("samples", Counts(fits.iter().map(|(_, fit)| fit.samples).collect())),
    ];
    let rows: Vec<(DampingModel, &Coefficient)> =
        found.iter().flat_map(|one| one.coefficients.iter().map(|row| (one.model, row))).collect();
    let of = |value: fn(&Coefficient) -> f64| Numbers(rows.iter().map(|(_, row)| value(row)).collect());
    let paper = rows.iter().map(|(model, row)| printed(*model, row.a1).unwrap_or(f64::NAN));
    let coefficients = [
        ("damping_model", Names(rows.iter().map(|(model, _)| model.name().into()).collect())),
        ("a1", of(|row| row.a1)),
        ("u0_over_u_ins", of(|row| row.start)),
        ("x", of(|row| row.x)),
        ("x_paper", Numbers(paper.collect())),
    ];
    let laws = || found.iter().flat_map(|one| one.laws.iter().map(|law| (one.model.name(), law)));
    let laws = [
        ("damping_model", Names(laws().map(|(model, _)| model.into()).collect())),
        ("u0_over_u_ins", Numbers(laws().map(|(_, (start, _))| *start).collect())),
        ("q", Numbers(laws().map(|(_, (_, law))| law.q).collect())),
        ("r", Numbers(laws().map(|(_, (_, law))| law.r).collect())),
    ];
    Ok([table(py, fits)?, table(py, coefficients)?, table(py, laws)?])
}
