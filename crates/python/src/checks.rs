//! Capacity against demand.

use figures::capacity::over_demand;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use study::check::{CapacityOverDemand, Demand, Fractions, SideCheck, check, governing};

use crate::arrays::{Given, motion, samples};
use crate::errors::refused;
use crate::walls::Wall;

/// Checks a wall against the median spectrum of records, or against a spectrum given by its periods and Sa;
/// returns the sides, the governing one and the picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    records: Vec<Given<'py>>,
    spectrum: Option<[Bound<'py, PyAny>; 2]>,
    damping: f64,
    fractions: [f64; 2],
) -> PyResult<(Vec<Bound<'py, PyDict>>, f64, String)> {
    let demand = if let Some([periods, accelerations]) = spectrum {
        let (periods, accelerations) = (samples(&periods)?, samples(&accelerations)?);
        if periods.len() != accelerations.len() {
            let found = format!("{} periods and {} values of Sa", periods.len(), accelerations.len());
            return Err(refused(format!("the spectrum has {found}; give one Sa for each period")));
        }
        Demand::of_points(periods.into_iter().zip(accelerations).collect())
    } else {
        let motions = records.iter().map(motion).collect::<PyResult<_>>()?;
        py.detach(|| Demand::of_records(motions, wall.scene.floors.as_ref(), &wall.equation, damping))
    };
    let demand = demand.map_err(refused)?;
    let [displacement, secant] = fractions;
    let (sides, drawn) = py
        .detach(|| {
            let sides =
                check(&wall.equation, Fractions { displacement, secant }, |period| demand.at(period))?;
            let drawn = CapacityOverDemand::new(&wall.equation, &demand, &sides)?;
            Ok((sides, drawn))
        })
        .map_err(|error: study::check::CheckError| refused(error))?;
    let values = sides.iter().map(|side| values(py, side)).collect::<PyResult<_>>()?;
    Ok((
        values,
        governing(&sides, |side| side.acceleration_ratio.min(side.displacement_ratio)).sign,
        over_demand(&drawn).picture().svg(),
    ))
}

/// Returns the numbers of a side by their names in `wall check --json`.
fn values<'py>(py: Python<'py>, side: &SideCheck) -> PyResult<Bound<'py, PyDict>> {
    let values = PyDict::new(py);
    for (name, value) in [
        ("sign", side.sign),
        ("onset_acceleration", side.onset_acceleration),
        ("zero_displacement", side.zero_displacement),
        ("displacement_capacity", side.displacement_capacity),
        ("secant_displacement", side.secant[0]),
        ("secant_acceleration", side.secant[1]),
        ("secant_period", side.secant_period),
        ("peak_acceleration", side.peak_acceleration),
        ("displacement_demand", side.displacement_demand),
        ("acceleration_ratio", side.acceleration_ratio),
        ("displacement_ratio", side.displacement_ratio),
    ] {
        values.set_item(name, value)?;
    }
    values.set_item("limited_by_tie", side.limited_by_tie)?;
    Ok(values)
}
