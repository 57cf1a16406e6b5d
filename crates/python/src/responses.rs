//! Results of a run.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use report::plot::stacked;
use run::figure;
use scene::response::{COLUMNS, Column, Response, TieSample};

use crate::arrays::samples;
use crate::errors::failed;

/// Returns the history of a run, what `wall simulate --json` prints of it, and its warnings and `more`.
pub(crate) fn values<'py>(
    py: Python<'py>,
    response: &Response,
    more: impl Iterator<Item = String>,
) -> PyResult<Bound<'py, PyDict>> {
    let history = PyDict::new(py);
    history.set_item("time", PyArray1::from_iter(py, response.samples.iter().map(|sample| sample.time)))?;
    let is_common = |column: &Column<'_>| COLUMNS.iter().any(|(name, ..)| *name == column.name);
    for Column { name, value, .. } in response.columns().into_iter().filter(is_common) {
        history.set_item(name, PyArray1::from_iter(py, (0..response.samples.len()).map(value)))?;
    }
    if response.ties.len() > 1 {
        let forces = |samples: &Vec<TieSample>| PyArray1::from_iter(py, samples.iter().map(|of| of.force));
        history.set_item("tie_forces", PyTuple::new(py, response.ties.iter().map(forces))?)?;
    }
    let text = serde_json::to_string(response).map_err(failed)?;
    let values = py.import("json")?.call_method1("loads", (text,))?.cast_into::<PyDict>()?;
    let warnings: Vec<_> = response.warnings.iter().map(ToString::to_string).chain(more).collect();
    values.set_item("history", history)?;
    values.set_item("warnings", warnings)?;
    Ok(values)
}

/// Seconds that are drawn after a fall.
const AFTER_FALL: f64 = 2.0;

/// Draws the motion of the bottom support above u/`u_ins`, as SVG; the axes end soon after a fall.
#[pyfunction]
pub(crate) fn picture_of_response(
    time: &Bound<'_, PyAny>,
    a_bottom: &Bound<'_, PyAny>,
    u_ratio: &Bound<'_, PyAny>,
) -> PyResult<String> {
    let times = samples(time)?;
    let over_time = |values: Vec<f64>| times.iter().copied().zip(values).collect::<Vec<_>>();
    let ratios = figure::cut(over_time(samples(u_ratio)?));
    let last = |points: &[(f64, f64)]| points.last().map_or(0.0, |point| point.0);
    let mut motion = over_time(samples(a_bottom)?);
    let end = if ratios.len() < motion.len() { last(&ratios) + AFTER_FALL } else { f64::INFINITY };
    motion.retain(|point| point.0 <= end);
    let end = last(&motion);
    let (motion, history) = (figure::motion(&motion, None, end), figure::history(&ratios, end));
    Ok(stacked(&[motion, history]))
}
