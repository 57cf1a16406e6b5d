//! Capacity against demand.

use check::circolare::figure::governing_over_demand;
use check::circolare::{self, CheckError, Records, demands, in_table, read_table};
use check::points::over_demand;
use check::points::{CapacityOverDemand, Demand, Fractions, SideCheck, check};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use rocking_wall::scene::{Place, SceneError};
use run::records::NamedRecord;

use crate::arrays::{MotionValues, motion, samples};
use crate::errors::{failed, of_scene, refused};
use crate::walls::Wall;

/// Checks a wall against the median spectrum of records, or against a spectrum given by its periods and Sa;
/// returns the sides and the picture.
#[pyfunction]
pub(crate) fn check_wall<'py>(
    py: Python<'py>,
    wall: &Wall,
    records: Vec<MotionValues<'py>>,
    spectrum: Option<[Bound<'py, PyAny>; 2]>,
    damping: f64,
    fractions: [f64; 2],
) -> PyResult<(Vec<Bound<'py, PyDict>>, String)> {
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
        .map_err(|error: check::points::CheckError| refused(error))?;
    let values = sides.iter().map(|side| values(py, side)).collect::<PyResult<_>>()?;
    Ok((values, over_demand(&drawn).picture().svg()))
}

/// Checks a wall by the table `[check]` in a text, with records by their names; returns what
/// `wall check --json` prints, and the picture.
#[pyfunction]
pub(crate) fn check_wall_by_code(
    py: Python<'_>,
    wall: &Wall,
    text: String,
    records: Vec<(String, MotionValues<'_>)>,
) -> PyResult<(String, String)> {
    let record =
        |(name, given): (String, MotionValues<'_>)| Ok(NamedRecord { name, motion: motion(&given)? });
    let records = records.into_iter().map(record).collect::<PyResult<_>>()?;
    let (parameters, floors) = (&wall.scene.parameters, wall.scene.floors.as_ref());
    let checked = py.detach(|| {
        let place = Place::new("check", &text);
        let Some(table) = read_table(&place)? else { unreachable!("the text has a table [check]") };
        let verdict = || -> Result<_, CheckError> {
            let (statement, records) = (table.statement()?, Records::new(records)?);
            let verdict = circolare::check(parameters, floors, &statement, &records)?;
            let plot = governing_over_demand(
                &statement,
                &demands(&wall.equation, floors, &statement, &records)?,
                &verdict,
            )?;
            Ok((verdict, plot))
        };
        verdict().map_err(|error| in_table(error, &place))
    });
    let (verdict, plot) = checked.map_err(|error| match error {
        // the user has not written this text, so its line numbers say nothing
        SceneError::Line { message, .. } | SceneError::File { reason: message, .. } => refused(message),
        other => of_scene(other),
    })?;
    let text = serde_json::to_string(&verdict).map_err(failed)?;
    Ok((text, plot.picture().svg()))
}

/// Returns the numbers of a side by their names in `wall check --json`.
fn values<'py>(py: Python<'py>, side: &SideCheck) -> PyResult<Bound<'py, PyDict>> {
    let values = [
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
    ]
    .into_py_dict(py)?;
    values.set_item("limited_by_tie", side.limited_by_tie)?;
    Ok(values)
}
