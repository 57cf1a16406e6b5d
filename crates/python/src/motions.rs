//! Records, pulses and response spectra.

use std::path::PathBuf;

use ground_motion::{
    GroundMotion, GroundMotionError, Maxima, Pulse, Record, RecordOptions, Shape, Spectrum, SyntheticMotion,
    Unit, Warning,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use run::record_facts::figure::{self, Drawn};

use crate::arrays::{Motion, Numbers, plain, samples};
use crate::errors::of_motion;

/// A channel of a record file: its motion, its name, and warnings.
type Channel = (Motion, Option<String>, Vec<String>);

/// Reads the channels of a record file.
#[pyfunction]
pub(crate) fn read_channels(
    py: Python<'_>,
    path: PathBuf,
    unit: Option<&str>,
    dt: Option<f64>,
    column: Option<String>,
    channel: Option<String>,
    format: Option<&str>,
) -> PyResult<Vec<Channel>> {
    let options = RecordOptions {
        unit: unit.map(str::parse).transpose().map_err(of_motion)?,
        step: dt,
        column,
        channel,
        format: format.map(str::parse).transpose().map_err(of_motion)?,
    };
    let records = py.detach(|| ground_motion::read_channels(path, &options)).map_err(of_motion)?;
    let channel = |record: Record| {
        let warnings = record.check().warnings.iter().map(ToString::to_string).collect();
        (Motion(record.motion), record.channel, warnings)
    };
    Ok(records.into_iter().map(channel).collect())
}

/// Warns of a time step \[s\] that no record has, and of a channel whose code is vertical.
#[pyfunction]
pub(crate) fn warnings_of(step: f64, channel: &str) -> Vec<String> {
    let vertical = ground_motion::is_vertical_channel(channel).then_some(Warning::Vertical);
    Warning::of_step(step).into_iter().chain(vertical).map(|warning| warning.to_string()).collect()
}

/// Samples a motion given by a formula.
#[pyfunction]
pub(crate) fn pulse(
    shape: &str,
    amplitude: f64,
    frequency: f64,
    centre: Option<f64>,
    phase: f64,
    duration: Option<f64>,
) -> PyResult<Motion> {
    let shape = match shape {
        "ricker" => Shape::Ricker { centre: centre.unwrap_or(1.5 / frequency) },
        "harmonic" => Shape::Harmonic { phase, end: duration },
        "sine_cycle" => Shape::SineCycle,
        "half_sine" => Shape::HalfSine,
        _ => unreachable!("the package names the shapes that there are"),
    };
    let pulse = Pulse { shape, amplitude, frequency };
    made(pulse.motion(duration))
}

/// Makes a synthetic motion.
#[pyfunction]
pub(crate) fn synthetic(seed: u64, duration: f64, dt: f64, pga: f64) -> PyResult<Motion> {
    made(SyntheticMotion { seed, duration, step: dt, peak: pga }.motion())
}

/// Copies a motion and converts it to m/s².
#[pyfunction]
pub(crate) fn in_si(given: (f64, Bound<'_, PyAny>), unit: &str) -> PyResult<Motion> {
    let (step, given) = given;
    let of: Unit = unit.parse().map_err(of_motion)?;
    let samples = samples(&plain(&given, Some(unit))?)?.into_iter().map(|sample| of.to_si(sample)).collect();
    made(GroundMotion::new(step, samples))
}

/// Multiplies a motion by a factor.
#[pyfunction]
pub(crate) fn scaled(given: Motion, factor: f64) -> PyResult<Motion> {
    made(given.0.checked_scaled(factor))
}

/// Scales a motion to a peak acceleration.
#[pyfunction]
pub(crate) fn scaled_to(given: Motion, pga: f64) -> PyResult<Motion> {
    made(given.0.scaled_to_peak(pga))
}

/// Joins motions to a sequence, with a pause \[s\] between them.
#[pyfunction]
pub(crate) fn sequence(given: Vec<Motion>, pause: f64) -> PyResult<Motion> {
    let shocks: Vec<_> = given.into_iter().map(|Motion(shock)| shock).collect();
    made(GroundMotion::sequence(&shocks, pause))
}

/// Cuts out the part of a motion between two times.
#[pyfunction]
pub(crate) fn trimmed(given: Motion, start: f64, end: f64) -> PyResult<Motion> {
    made(given.0.trimmed(start, end))
}

fn made(motion: Result<GroundMotion, GroundMotionError>) -> PyResult<Motion> {
    motion.map(Motion).map_err(of_motion)
}

/// Computes Sa at periods.
#[pyfunction]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    given: Motion,
    periods: &Bound<'py, PyAny>,
    damping: f64,
    at_samples: bool,
) -> PyResult<Numbers<'py>> {
    let (periods, of) = (samples(periods)?, of_damping(damping, at_samples)?);
    let accelerations = py.detach(|| of.accelerations(&given.0, &periods)).map_err(of_motion)?;
    Ok(PyArray1::from_vec(py, accelerations))
}

/// Computes `AvgSA` over periods.
#[pyfunction]
pub(crate) fn average_sa(
    py: Python<'_>,
    given: Motion,
    periods: &Bound<'_, PyAny>,
    damping: f64,
    at_samples: bool,
) -> PyResult<f64> {
    let (periods, of) = (samples(periods)?, of_damping(damping, at_samples)?);
    py.detach(|| of.average(&given.0, &periods)).map_err(of_motion)
}

/// Computes Housner's spectrum intensity.
#[pyfunction]
pub(crate) fn housner(py: Python<'_>, given: Motion, damping: f64, at_samples: bool) -> PyResult<f64> {
    let of = of_damping(damping, at_samples)?;
    py.detach(|| of.housner_intensity(&given.0)).map_err(of_motion)
}

/// Computes PGV, PGD, Arias intensity and CAV.
#[pyfunction]
pub(crate) fn intensities(given: Motion) -> [f64; 4] {
    let motion = given.0;
    let (arias, cav) = (motion.arias_intensity(), motion.cumulative_absolute_velocity());
    [motion.peak_velocity(), motion.peak_displacement(), arias, cav]
}

/// Computes the velocity of the ground at the samples.
#[pyfunction]
pub(crate) fn velocity(py: Python<'_>, given: Motion) -> Numbers<'_> {
    PyArray1::from_vec(py, given.0.velocities())
}

/// Computes the displacement of the ground at the samples.
#[pyfunction]
pub(crate) fn displacement(py: Python<'_>, given: Motion) -> Numbers<'_> {
    PyArray1::from_vec(py, given.0.displacements())
}

fn of_damping(damping: f64, at_samples: bool) -> PyResult<Spectrum> {
    let maxima = if at_samples { Maxima::AtSamples } else { Maxima::Everywhere };
    Spectrum::new(damping, maxima).map_err(of_motion)
}

/// Draws a record above its response spectrum, as SVG.
#[pyfunction]
pub(crate) fn picture(py: Python<'_>, given: Motion, name: String) -> PyResult<String> {
    let drawn = py.detach(|| Drawn::new(name, &given.0, &Spectrum::default())).map_err(of_motion)?;
    Ok(figure::picture(&[drawn], ground_motion::spectrum::DAMPING))
}
