//! The class `Building`: storeys and walls as one system.

use std::path::PathBuf;

use building::coupled::{Coupled, Settings};
use building::histories::{History, Peak};
use building::{BuildingError, Parts};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use report::palette::{DARK_GREY, SERIES};
use report::plot::stacked;
use run::figure::{cut, histories};

use crate::arrays::Motion;
use crate::errors::{failed, of_file, refused};
use crate::watch::stoppable;

/// A building ready to run.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Building {
    building: building::Building,
    parts: Parts,
}

#[pymethods]
impl Building {
    /// Reads the file of a building, and the scenes of its walls.
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| {
            let building = building::Building::read(&path)?;
            let parts = Parts::read(&building)?;
            Ok(Self { building, parts })
        })
        .map_err(|error: BuildingError| of_file(error, &path))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.building.title
    }

    #[getter]
    fn floors(&self) -> Vec<&str> {
        self.building.floors.iter().map(|floor| floor.name.as_str()).collect()
    }

    #[getter]
    fn walls(&self) -> Vec<&str> {
        self.building.walls.iter().map(|wall| wall.name.as_str()).collect()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.parts.warnings.clone()
    }

    /// Runs the building under a motion of the ground.
    fn run<'py>(
        &self,
        py: Python<'py>,
        ground: Motion,
        tail: f64,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let settings = Settings::new(&ground.0, tail, tolerance).map_err(refused)?;
        let run = stoppable(py, || Coupled::run(&self.parts, &ground.0, settings))?.map_err(failed)?;
        self.values(py, &run)
    }
}

impl Building {
    fn values<'py>(&self, py: Python<'py>, run: &Coupled) -> PyResult<Bound<'py, PyDict>> {
        let (floors, walls) = (PyDict::new(py), PyDict::new(py));
        for (floor, history) in self.building.floors.iter().zip(&run.floors) {
            let values = PyDict::new(py);
            for (name, history) in [("acceleration", &history.acceleration), ("drift", &history.drift)] {
                set(&values, name, history)?;
            }
            floors.set_item(&floor.name, values)?;
        }
        for ((wall, history), own) in self.building.walls.iter().zip(&run.walls).zip(&self.parts.walls) {
            let values = PyDict::new(py);
            for (name, history) in [
                ("u", &history.displacement),
                ("u_ratio", &history.ratio),
                ("reaction_bottom", &history.reaction_bottom),
                ("reaction_top", &history.reaction_top),
            ] {
                set(&values, name, history)?;
            }
            let (at, [u_max, ratio]) = history.reported(own, &run.times);
            values.set_item("u_peak", peak(py, at)?)?;
            values.set_item("u_ratio_peak", peak(py, Peak { value: ratio.copysign(at.value), ..at })?)?;
            values.set_item("u_max", u_max)?;
            values.set_item("overturn_time", history.overturn_time)?;
            values.set_item("falls", history.fate(&run.times).falls())?;
            values.set_item("tie_elongation", history.tie_elongation)?;
            values.set_item("tie_break_time", history.tie_break_time)?;
            walls.set_item(&wall.name, values)?;
        }
        let values = PyDict::new(py);
        values.set_item("title", &self.building.title)?;
        values.set_item("time", PyArray1::from_slice(py, &run.times))?;
        values.set_item("ground", PyArray1::from_slice(py, &run.ground.values))?;
        values.set_item("floors", floors)?;
        values.set_item("walls", walls)?;
        values.set_item("step", run.step)?;
        values.set_item("change", run.change)?;
        values.set_item("_picture", picture(run))?;
        Ok(values)
    }
}

/// Sets a history and its peak.
fn set(values: &Bound<'_, PyDict>, name: &str, history: &History) -> PyResult<()> {
    values.set_item(name, PyArray1::from_slice(values.py(), &history.values))?;
    values.set_item(format!("{name}_peak"), peak(values.py(), history.peak)?)
}

fn peak(py: Python<'_>, Peak { value, time }: Peak) -> PyResult<Bound<'_, PyDict>> {
    [("value", value), ("time", time)].into_py_dict(py)
}

/// Draws the accelerations of ground and floors above u/`u_ins` of the walls, as SVG.
fn picture(run: &Coupled) -> String {
    let over_time =
        |history: &History| run.times.iter().copied().zip(history.values.iter().copied()).collect::<Vec<_>>();
    let color = |index: usize| SERIES[index % SERIES.len()].0;
    let mut floors = vec![(over_time(&run.ground), DARK_GREY)];
    let own = run.floors.iter().enumerate();
    floors.extend(own.map(|(index, floor)| (over_time(&floor.acceleration), color(index))));
    let walls = run.walls.iter().enumerate();
    let walls: Vec<_> = walls.map(|(index, wall)| (cut(over_time(&wall.ratio)), color(index))).collect();
    let end = run.times.last().copied().unwrap_or_default();
    let drawn = |lines: &[(Vec<(f64, f64)>, &'static str)], label: &str, shown: &[f64]| {
        let lines: Vec<_> = lines.iter().map(|(points, color)| (&points[..], *color)).collect();
        histories(&lines, [0.0, end], label, shown)
    };
    let mut plots = vec![drawn(&floors, "acceleration (m/s²)", &[])];
    if !walls.is_empty() {
        plots.push(drawn(&walls, "u / u_ins", &[-1.0, 1.0]));
    }
    stacked(&plots)
}
