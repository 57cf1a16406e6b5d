//! Results of a run.

use figures::plot::Picture;
use figures::response;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::response::{Response, Sample};
use rocking_wall::solver::{Crossing, Extremes, Instant, TieDemands};

use crate::arrays::samples;

/// A column of the history and its value at a sample.
type Column = (&'static str, fn(&Sample) -> f64);

/// The columns of the history, those of `wall simulate --csv`.
const COLUMNS: [Column; 11] = [
    ("time", |sample| sample.time),
    ("u", |sample| sample.outputs.displacement),
    ("u_dot", |sample| sample.outputs.velocity),
    ("u_ddot", |sample| sample.outputs.acceleration),
    ("u_ratio", |sample| sample.outputs.ratio),
    ("restoring_force", |sample| sample.outputs.restoring_force),
    ("damping_force", |sample| sample.outputs.damping_force),
    ("reaction_bottom", |sample| sample.outputs.reactions.bottom),
    ("reaction_top", |sample| sample.outputs.reactions.top),
    ("a_bottom", |sample| sample.support.bottom),
    ("a_top", |sample| sample.support.top),
];

/// Returns the history, the peaks and the demands of a run, and its warnings with `more` of them.
pub(crate) fn values<'py>(
    py: Python<'py>,
    response: &Response,
    more: impl Iterator<Item = String>,
) -> PyResult<Bound<'py, PyDict>> {
    let history = PyDict::new(py);
    for (name, value) in COLUMNS {
        history.set_item(name, PyArray1::from_iter(py, response.samples.iter().map(value)))?;
    }
    if response.demands.tie.is_some() {
        let forces = response.samples.iter().map(|sample| sample.outputs.tie_force);
        history.set_item("tie_force", PyArray1::from_iter(py, forces))?;
    }
    let summary = &response.summary;
    let warnings: Vec<_> = response.warnings.iter().map(ToString::to_string).chain(more).collect();
    let values = PyDict::new(py);
    values.set_item("history", history)?;
    values.set_item("u_max", summary.u_max)?;
    values.set_item("u_ratio_max", summary.u_ratio_max)?;
    values.set_item("overturned", summary.overturned)?;
    values.set_item("overturn_time", summary.overturn_time)?;
    values.set_item("put_to_rest", summary.put_to_rest)?;
    values.set_item("pieces", summary.work.pieces)?;
    values.set_item("corners", summary.work.corners)?;
    values.set_item("impacts", summary.work.impacts)?;
    values.set_item("demands", demands(py, response)?)?;
    values.set_item("warnings", warnings)?;
    Ok(values)
}

/// Returns the demands, as `wall simulate --json` prints them.
fn demands<'py>(py: Python<'py>, response: &Response) -> PyResult<Bound<'py, PyDict>> {
    let demands = &response.demands;
    let values = PyDict::new(py);
    for (name, Extremes { highest, lowest }) in [
        ("u", demands.displacement),
        ("u_dot", demands.velocity),
        ("u_ddot", demands.acceleration),
        ("reaction_bottom", demands.reaction_bottom),
        ("reaction_top", demands.reaction_top),
    ] {
        let both = PyDict::new(py);
        for (end, at) in [("highest", highest), ("lowest", lowest)] {
            both.set_item(end, instant(py, at)?)?;
        }
        values.set_item(name, both)?;
    }
    let mut thresholds = Vec::new();
    for Crossing { fraction, first } in &demands.crossings {
        let threshold = PyDict::new(py);
        threshold.set_item("fraction", fraction)?;
        threshold.set_item("time", first.map(|first| first.time))?;
        threshold.set_item("u", first.map(|first| first.value))?;
        thresholds.push(threshold);
    }
    values.set_item("thresholds", thresholds)?;
    if let Some(TieDemands { force, strength }) = demands.tie {
        values.set_item("tie_force", instant(py, force)?)?;
        values.set_item("tie_strength", strength.map(|at| instant(py, at)).transpose()?)?;
    }
    values.set_item("half_cycles", demands.half_cycles)?;
    values.set_item("residual", response.residual)?;
    Ok(values)
}

fn instant(py: Python<'_>, Instant { value, time }: Instant) -> PyResult<Bound<'_, PyDict>> {
    let instant = PyDict::new(py);
    instant.set_item("value", value)?;
    instant.set_item("time", time)?;
    Ok(instant)
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
    let ratios = response::cut(over_time(samples(u_ratio)?));
    let last = |points: &[(f64, f64)]| points.last().map_or(0.0, |point| point.0);
    let mut motion = over_time(samples(a_bottom)?);
    let end = if ratios.len() < motion.len() { last(&ratios) + AFTER_FALL } else { f64::INFINITY };
    motion.retain(|point| point.0 <= end);
    let end = last(&motion);
    let (motion, history) = (response::motion(&motion, None, end), response::history(&ratios, end));
    Ok(Picture::stacked(&[motion, history]).svg())
}
