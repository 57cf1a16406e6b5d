//! Records, pulses and response spectra.

use std::path::PathBuf;

use ground_motion::{
    GroundMotion, GroundMotionError, Maxima, Pulse, Record, RecordOptions, Shape, Spectrum, SyntheticMotion,
    Unit, Warning,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use run::record_facts::figure::{self, Drawn};

use crate::arrays::{MotionValues, Numbers, motion, of_motion_values, samples};
use crate::errors::{of_motion, refused};

/// A channel of a record file: its motion, its name, and warnings.
type Channel<'py> = ((f64, Numbers<'py>), Option<String>, Vec<String>);

/// Reads the channels of a record file.
#[pyfunction]
pub(crate) fn read_channels<'py>(
    py: Python<'py>,
    path: PathBuf,
    unit: Option<&str>,
    dt: Option<f64>,
    column: Option<String>,
    channel: Option<String>,
    format: Option<&str>,
) -> PyResult<Vec<Channel<'py>>> {
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
        (of_motion_values(py, &record.motion), record.channel, warnings)
    };
    Ok(records.into_iter().map(channel).collect())
}

/// Warns of a channel, such as that of a trace, whose code is vertical.
#[pyfunction]
pub(crate) fn warnings_of_channel(code: &str) -> Vec<String> {
    ground_motion::is_vertical_channel(code).then(|| Warning::Vertical.to_string()).into_iter().collect()
}

/// Samples a motion given by a formula.
#[pyfunction]
pub(crate) fn pulse<'py>(
    py: Python<'py>,
    shape: &str,
    amplitude: f64,
    frequency: f64,
    centre: Option<f64>,
    phase: f64,
    duration: Option<f64>,
) -> PyResult<(f64, Numbers<'py>)> {
    let shape = match shape {
        "ricker" => Shape::Ricker { centre: centre.unwrap_or(1.5 / frequency) },
        "harmonic" => Shape::Harmonic { phase, end: duration },
        "sine_cycle" => Shape::SineCycle,
        "half_sine" => Shape::HalfSine,
        _ => {
            return Err(refused(format!(
                "shape = {shape:?} is not one of ricker, harmonic, sine_cycle, half_sine"
            )));
        }
    };
    let pulse = Pulse { shape, amplitude, frequency };
    made(py, pulse.motion(duration))
}

/// Makes a synthetic motion.
#[pyfunction]
pub(crate) fn synthetic(
    py: Python<'_>,
    seed: u64,
    duration: f64,
    dt: f64,
    pga: f64,
) -> PyResult<(f64, Numbers<'_>)> {
    made(py, SyntheticMotion { seed, duration, step: dt, peak: pga }.motion())
}

/// Copies a motion and converts it to m/s².
#[pyfunction]
pub(crate) fn in_si<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    unit: &str,
) -> PyResult<(f64, Numbers<'py>)> {
    let unit: Unit = unit.parse().map_err(of_motion)?;
    let (step, given) = given;
    let samples = samples(&given)?.into_iter().map(|sample| unit.to_si(sample)).collect();
    made(py, GroundMotion::new(step, samples))
}

/// Multiplies a motion by a factor.
#[pyfunction]
pub(crate) fn scaled<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    factor: f64,
) -> PyResult<(f64, Numbers<'py>)> {
    made(py, motion(&given)?.checked_scaled(factor))
}

/// Scales a motion to a peak acceleration.
#[pyfunction]
pub(crate) fn scaled_to<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    pga: f64,
) -> PyResult<(f64, Numbers<'py>)> {
    made(py, motion(&given)?.scaled_to_peak(pga))
}

/// Cuts out the part of a motion between two times.
#[pyfunction]
pub(crate) fn trimmed<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    start: f64,
    end: f64,
) -> PyResult<(f64, Numbers<'py>)> {
    made(py, motion(&given)?.trimmed(start, end))
}

fn made(py: Python<'_>, motion: Result<GroundMotion, GroundMotionError>) -> PyResult<(f64, Numbers<'_>)> {
    Ok(of_motion_values(py, &motion.map_err(of_motion)?))
}

/// Computes Sa at periods.
#[pyfunction]
pub(crate) fn spectrum<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    periods: &Bound<'py, PyAny>,
    damping: f64,
    at_samples: bool,
) -> PyResult<Numbers<'py>> {
    let (motion, periods) = (motion(&given)?, samples(periods)?);
    let of = of_damping(damping, at_samples)?;
    let accelerations = py.detach(|| of.accelerations(&motion, &periods)).map_err(of_motion)?;
    Ok(PyArray1::from_vec(py, accelerations))
}

/// Computes `AvgSA` over periods.
#[pyfunction]
pub(crate) fn average_sa<'py>(
    py: Python<'py>,
    given: MotionValues<'py>,
    periods: &Bound<'py, PyAny>,
    damping: f64,
    at_samples: bool,
) -> PyResult<f64> {
    let (motion, periods) = (motion(&given)?, samples(periods)?);
    let of = of_damping(damping, at_samples)?;
    py.detach(|| of.average(&motion, &periods)).map_err(of_motion)
}

fn of_damping(damping: f64, at_samples: bool) -> PyResult<Spectrum> {
    let maxima = if at_samples { Maxima::AtSamples } else { Maxima::Everywhere };
    Spectrum::new(damping, maxima).map_err(of_motion)
}

/// Draws a record above its response spectrum, as SVG.
#[pyfunction]
pub(crate) fn picture(py: Python<'_>, given: MotionValues<'_>, name: String) -> PyResult<String> {
    let motion = motion(&given)?;
    let drawn = py.detach(|| Drawn::new(name, &motion, &Spectrum::default())).map_err(of_motion)?;
    Ok(figure::picture(&[drawn], ground_motion::spectrum::DAMPING).svg())
}
