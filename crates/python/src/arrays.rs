//! Samples from Python, and arrays to Python.

use ground_motion::{GroundMotion, Unit};
use numpy::{Element, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use run::records::NamedRecord;

use crate::errors::of_motion;

/// A motion, which Python has as the time between samples \[s\], the samples \[m/s²\], and the first samples
/// of the shocks of a sequence after the first one.
pub(crate) struct Motion(pub(crate) GroundMotion);

impl<'py> FromPyObject<'_, 'py> for Motion {
    type Error = PyErr;
    const INPUT_TYPE: PyStaticExpr = <(f64, Bound<'py, PyAny>, Vec<usize>)>::INPUT_TYPE;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let (step, given, later): (f64, Bound<'py, PyAny>, Vec<usize>) = given.extract()?;
        let motion = GroundMotion::new(step, samples(&given)?).and_then(|motion| motion.with_later(&later));
        motion.map(Self).map_err(of_motion)
    }
}

impl<'py> IntoPyObject<'py> for Motion {
    type Target = PyTuple;
    type Output = Bound<'py, PyTuple>;
    type Error = PyErr;
    const OUTPUT_TYPE: PyStaticExpr = <(f64, Numbers<'py>, Bound<'py, PyTuple>)>::OUTPUT_TYPE;

    fn into_pyobject(self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let later = PyTuple::new(py, self.0.shocks()[1..].iter().map(|shock| shock.start))?;
        (self.0.step(), PyArray1::from_slice(py, self.0.samples()), later).into_pyobject(py)
    }
}

/// An array of numbers for Python.
pub(crate) type Numbers<'py> = Bound<'py, PyArray1<f64>>;

/// Makes an array of a value of each point, row by row.
pub(crate) fn grid<'py, P, T: Element>(
    py: Python<'py>,
    rows: &[impl AsRef<[P]>],
    value: fn(&P) -> T,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let rows: Vec<Vec<T>> = rows.iter().map(|row| row.as_ref().iter().map(value).collect()).collect();
    Ok(PyArray2::from_vec2(py, &rows)?)
}

/// Copies the numbers of anything that numpy makes a one-dimensional array of: a list, a slice with strides,
/// an array that is misaligned, in another byte order or of another type of real numbers.
///
/// # Errors
/// `TypeError` for values that are not real numbers, `ValueError` for another shape, for masked values, and
/// for values with a unit of their own.
pub(crate) fn samples(given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = plain(given, None)?;
    let array = given.py().import("numpy")?.call_method1("require", (array, "float64", ["C", "A"]))?;
    let Ok(array) = array.cast::<PyArray1<f64>>() else {
        let shape = array.getattr("shape")?;
        return Err(PyValueError::new_err(format!(
            "expected numbers in one dimension, found the shape {shape}"
        )));
    };
    Ok(array.readonly().as_slice()?.to_vec())
}

/// Makes an array of real numbers without gaps, and without a unit but that of acceleration that is stated.
#[pyfunction]
#[pyo3(signature = (given, unit=None))]
pub(crate) fn plain<'py>(given: &Bound<'py, PyAny>, unit: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
    let numpy = given.py().import("numpy")?;
    if numpy.getattr("ma")?.call_method1("is_masked", (given,))?.is_truthy()? {
        return Err(PyValueError::new_err("values are masked; fill or cut out what is missing"));
    }
    let stated: Option<Unit> = unit.and_then(|unit| unit.parse().ok());
    if let Some(own) = own_unit(given).filter(|own| stated.is_none() || own.parse().ok() != stated) {
        let to = unit.map_or_else(String::new, |unit| format!(" to {unit}"));
        let message =
            format!("the values have a unit of their own, {own}; convert them{to} and give numbers");
        return Err(PyValueError::new_err(message));
    }
    let array = numpy.call_method1("asarray", (given,))?;
    let dtype = array.getattr("dtype")?;
    if !["i", "u", "f"].contains(&dtype.getattr("kind")?.extract::<String>()?.as_str()) {
        return Err(PyTypeError::new_err(format!("expected real numbers, found values of the type {dtype}")));
    }
    Ok(array)
}

/// Returns the unit that values bring along, as those of pint, astropy and xarray do.
fn own_unit(given: &Bound<'_, PyAny>) -> Option<String> {
    let of_attributes = || given.getattr("attrs").ok()?.get_item("units").ok();
    let unit = ["units", "unit"].iter().find_map(|name| given.getattr(*name).ok()).or_else(of_attributes)?;
    Some(unit.to_string()).filter(|unit| !["", "1", "dimensionless", "None"].contains(&unit.trim()))
}

/// Names the motions of records.
pub(crate) fn named_records(records: Vec<(String, Motion)>) -> Vec<NamedRecord> {
    let record = |(name, Motion(motion)): (String, Motion)| NamedRecord::new(name, motion);
    records.into_iter().map(record).collect()
}
