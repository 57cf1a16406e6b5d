//! The class `Wall`: a scene whose motion is given run by run.

use std::path::{Path, PathBuf};

use check::Subject;
use files::{TomlFile, check_value};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::simulation::Excitation;
use rocking_wall::solver::Method;
use rocking_wall::wall::{OF_RECTANGLE, Parameters, Wall as Equation};
use run::capacity::{plot, with_curve};
use run::walls::{assumed, read_scene};
use scene::response::Response;
use scene::{
    Curve, Document, Floors, GROUPS, KINEMATICS, MotionTable, OF_BODY, POINTS, Scene, StoreyTable,
    SupportsTable, apply_curve, parameter_text, set_names, to_toml,
};
use scene_fmu::General;

use crate::arrays::Motion;
use crate::errors::{of_file, of_scene, refused};
use crate::responses;

/// A wall, valid since it was made.
#[pyclass(frozen, module = "rocking_wall._native")]
pub(crate) struct Wall {
    pub(crate) scene: Scene,
    pub(crate) equation: Equation,
    /// The start where it was given by name; else a record finds the wall upright.
    pub(crate) start: Option<f64>,
    /// Parameters without which a code does not check a wall, and that nobody stated.
    pub(crate) assumed: Vec<&'static str>,
}

/// A wall as values that pickle can send: its scene file without the motion, all of its parameters as texts,
/// its start where it was given, the motions of the bottom support and, where it has its own, of the top one,
/// with what is known of them, the parameters that nobody stated, and whether it is an oscillator.
type Values = (
    String,
    Vec<(String, String)>,
    Option<f64>,
    Option<(Motion, Option<Motion>)>,
    Vec<String>,
    Vec<String>,
    bool,
);

/// The solver in words, u and F at the corners of the restoring force, warnings, and the capacity curve.
type Description = (String, Vec<(f64, f64)>, Vec<String>, String);

#[pymethods]
impl Wall {
    /// Makes a wall; `tables` are those of a scene that have parts, openings and loads, and ties, and `curve`
    /// is its `[force_law]` with a capacity curve.
    #[new]
    #[pyo3(signature = (parameters, tables=None, curve=None))]
    fn new(parameters: &Bound<'_, PyDict>, tables: Option<&str>, curve: Option<&str>) -> PyResult<Self> {
        let mut scene = Scene { title: "rocking wall".into(), ..Scene::default() };
        let mut assumed = assumed(|_, _| false);
        set_tables(&mut scene, &mut assumed, tables)?;
        Self::of(scene, None, assumed, parameters, curve)
    }

    /// Reads a scene file.
    #[staticmethod]
    fn from_toml(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let (scene, assumed) = read_scene(&path).map_err(of_scene)?;
        Self::of(scene, None, assumed, &PyDict::new(py), None)
    }

    /// Returns the same wall with other values of some parameters.
    #[pyo3(signature = (parameters, tables=None, curve=None))]
    fn replaced(
        &self,
        parameters: &Bound<'_, PyDict>,
        tables: Option<&str>,
        curve: Option<&str>,
    ) -> PyResult<Self> {
        let (mut scene, mut assumed) = (self.scene.clone(), self.assumed.clone());
        set_tables(&mut scene, &mut assumed, tables)?;
        Self::of(scene, self.start, assumed, parameters, curve)
    }

    /// Returns the same wall on floors of storeys, given as mass, stiffness, period and damping ratio.
    fn on_storeys(
        &self,
        storeys: Vec<[Option<f64>; 4]>,
        bottom: Option<usize>,
        top: Option<usize>,
        drift: bool,
    ) -> PyResult<Self> {
        let table = |[mass, stiffness, period, damping_ratio]: [Option<f64>; 4]| StoreyTable {
            mass,
            stiffness,
            period,
            damping_ratio,
        };
        let tables: Vec<_> = storeys.into_iter().map(table).collect();
        let supports = SupportsTable { bottom, top, drift: Some(drift) };
        let floors = Floors::new(&tables, supports).map_err(|(index, message)| match index {
            Some(index) => refused(format!("storey {}: {message}", index + 1)),
            None => refused(message),
        })?;
        floors.supports(self.scene.parameters.mechanism).map_err(of_scene)?;
        let scene = Scene { floors: Some(floors), ..self.scene.clone() };
        Ok(Self { scene, equation: self.equation.clone(), start: self.start, assumed: self.assumed.clone() })
    }

    /// Returns the values of the wall, to send them.
    fn sent(&self) -> Values {
        let motion = self.scene.excitation.as_ref();
        let motion =
            motion.map(|motion| (Motion(motion.bottom().clone()), motion.top().cloned().map(Motion)));
        let parameters = self.parameters().into_iter().map(|(name, text)| (name.to_owned(), text)).collect();
        let assumed = self.assumed.iter().map(|name| (*name).to_owned()).collect();
        let notes = self.scene.motion_notes.clone();
        let is_oscillator = self.scene.is_of_oscillator();
        (to_toml(&self.scene, ""), parameters, self.start, motion, notes, assumed, is_oscillator)
    }

    /// Makes a wall from its values.
    #[staticmethod]
    fn received(values: Values) -> PyResult<Self> {
        let (text, parameters, start, motion, motion_notes, assumed, is_oscillator) = values;
        let mut scene = Scene::parse("a wall that was sent", &text, Path::new(".")).map_err(of_scene)?;
        let bar = scene.parameters.bar;
        for (name, text) in &parameters {
            // the text of the scene leaves out what a law of points does not use
            if scene.parameters.multilinear.is_none() || name != "force_law" {
                scene.set(name, text).map_err(of_scene)?;
            }
        }
        // stiffness and strength that are set take the place of the bar
        scene.parameters.bar = bar;
        if let Some((bottom, top)) = motion {
            scene.excitation = Some(Excitation::new(bottom.0, top.map(|Motion(top)| top)));
        }
        scene.motion_notes = motion_notes;
        scene.curve =
            is_oscillator.then(|| Curve::of_oscillator(&scene.parameters)).transpose().map_err(refused)?;
        let equation = Equation::new(&scene.parameters).map_err(refused)?;
        let assumed = self::assumed(|_, name| assumed.iter().all(|own| own != name));
        Ok(Self { scene, equation, start, assumed })
    }

    /// Returns whether another wall has the same parameters, start, storeys, motion, inputs and times.
    fn equals(&self, other: &Self) -> bool {
        let (a, b) = (&self.scene, &other.scene);
        self.start == other.start
            && a.parameters == b.parameters
            && a.floors == b.floors
            && a.excitation == b.excitation
            && a.inputs == b.inputs
            && [a.stop_time, a.output_step] == [b.stop_time, b.output_step]
            && a.thresholds == b.thresholds
    }

    #[getter]
    fn title(&self) -> &str {
        &self.scene.title
    }

    /// Returns the parameters as texts of a scene file.
    #[getter]
    fn parameters(&self) -> Vec<(&'static str, String)> {
        let Parameters { profile, further_ties, .. } = &self.scene.parameters;
        let (has_parts, has_ties) = (profile.is_some(), !further_ties.is_empty());
        let names = GROUPS.iter().flat_map(|(_, names)| names.iter());
        let of_others = |name: &str| OF_RECTANGLE.contains(&name) || OF_BODY.contains(&name);
        let names = names.filter(|name| !(has_parts && of_others(name)));
        let names = names.filter(|name| !(has_ties && name.starts_with("tie_")));
        names.filter_map(|name| Some((*name, parameter_text(&self.scene.parameters, name)?))).collect()
    }

    /// Returns a parameter, or a number that follows from the parameters, by its name in the model
    /// description: a number, the name of a choice, or the points of a law.
    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let parameters = &self.scene.parameters;
        if let Some(fact) = self.equation.facts().into_iter().find(|fact| fact.name == name) {
            return fact.value.into_bound_py_any(py);
        }
        let points = parameters.multilinear.as_deref().map(<[_]>::to_vec);
        let text = match name {
            POINTS => return points.into_bound_py_any(py),
            KINEMATICS => Some(parameters.kinematics.name().to_owned()),
            "force_law" if points.is_some() => Some("multilinear".to_owned()),
            _ => parameter_text(parameters, name),
        };
        let Some(text) = text else {
            return Err(PyAttributeError::new_err(format!("{name:?} is not a parameter of a wall")));
        };
        match text.parse::<f64>() {
            Ok(number) => number.into_bound_py_any(py),
            Err(_) => text.trim_matches('"').into_bound_py_any(py),
        }
    }

    /// Returns name, symbol, value and unit of the numbers that follow from the parameters.
    fn facts(&self) -> Vec<(String, &'static str, f64, &'static str)> {
        let facts = self.equation.facts().into_iter();
        facts.map(|fact| (fact.name.into_owned(), fact.symbol, fact.value, fact.unit)).collect()
    }

    /// Returns the solver in words, u and F at the corners of the restoring force, what is unusual about the
    /// wall, and the wall to scale with the capacity curve of u > 0, as two SVGs.
    fn description(&self) -> PyResult<Description> {
        let Self { scene, equation, .. } = self;
        let method = Method::new(&scene.parameters, equation, scene.parameters.tolerance).map_err(refused)?;
        let of_floors = scene.floors.iter().flat_map(|floors| floors.warnings(equation));
        let warnings = scene.warnings_of(equation).map(ToString::to_string);
        let warnings = warnings.chain(of_floors).chain(scene.doubts().iter().cloned()).collect();
        let corners = equation.capacity_corners(1.0);
        let points = corners.iter().map(|point| (point.displacement, point.force)).collect();
        let curve = with_curve(plot(&[("u > 0", points)], Vec::new()), scene.curve.as_ref()).picture();
        let picture = run::drawing::svg(equation, &scene.parameters) + &curve;
        Ok((method.to_string(), equation.backbone(), warnings, picture))
    }

    /// Runs the wall under a motion, under that of its scene, or in free vibration.
    #[pyo3(signature = (record, *, top, tail, stop_time, output_step, thresholds, hold))]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        record: Option<Motion>,
        top: Option<Motion>,
        tail: f64,
        stop_time: Option<f64>,
        output_step: Option<f64>,
        thresholds: Option<Vec<f64>>,
        hold: bool,
    ) -> PyResult<Bound<'py, PyDict>> {
        let mut scene = self.scene.clone();
        if let Some(Motion(record)) = record {
            check_value::<MotionTable>("tail", tail).map_err(refused)?;
            scene.shake(Excitation::new(record, top.map(|Motion(top)| top)), tail, Vec::new());
            scene.parameters.u_start = self.start.unwrap_or(0.0);
        }
        if hold {
            scene.excitation = scene.excitation.map(Excitation::held);
        }
        scene.set_output(stop_time, output_step, thresholds).map_err(of_scene)?;
        let response = py.detach(|| Response::of(&scene)).map_err(of_scene)?;
        let of_floors = scene.floors.iter().flat_map(|floors| floors.warnings(&self.equation));
        let of_motion = scene.excitation.as_ref().and_then(Excitation::warning);
        let more = of_floors
            .chain(of_motion.map(|warning| warning.to_string()))
            .chain(scene.doubts().iter().cloned());
        responses::values(py, &response, more)
    }

    /// Writes the FMU of the scene, made from the general one at `base`; returns the number of its variables.
    fn package(&self, py: Python<'_>, path: PathBuf, base: PathBuf) -> PyResult<usize> {
        py.detach(|| {
            let unit = General::open(&base).and_then(|general| scene_fmu::of_scene(&self.scene, general));
            let unit = unit.map_err(|error| of_file(error, &base))?;
            run::file::to_file(&path, &unit.archive.to_bytes().map_err(refused)?).map_err(refused)?;
            Ok(unit.variables)
        })
    }
}

impl Wall {
    fn of(
        mut scene: Scene,
        start: Option<f64>,
        mut assumed: Vec<&'static str>,
        parameters: &Bound<'_, PyDict>,
        curve: Option<&str>,
    ) -> PyResult<Self> {
        set_all(&mut scene, parameters)?;
        scene.curve = scene.curve.and_then(|curve| curve.after_change(&scene.parameters));
        curve.map_or(Ok(()), |curve| set_curve(&mut scene, parameters, curve))?;
        assumed.retain(|name| parameters.contains(name).is_ok_and(|is_stated| !is_stated));
        let start = if parameters.contains("u_start")? { Some(scene.parameters.u_start) } else { start };
        let equation = Equation::new(&scene.parameters).map_err(refused)?;
        Method::new(&scene.parameters, &equation, scene.parameters.tolerance).map_err(refused)?;
        Ok(Self { scene, equation, start, assumed })
    }
}

impl<'a> From<&'a Wall> for Subject<'a> {
    fn from(wall: &'a Wall) -> Self {
        Self { assumed: &wall.assumed, ..Self::from(&wall.scene) }
    }
}

/// Gives the wall of a scene the parts and the ties of `tables`, those that are given. Parts state what a
/// rectangle has.
fn set_tables(scene: &mut Scene, assumed: &mut Vec<&'static str>, tables: Option<&str>) -> PyResult<()> {
    let Some(tables) = tables else { return Ok(()) };
    let file = TomlFile::new("the tables of a wall", tables).map_err(|error| of_scene(error.into()))?;
    let given = Scene::of(&file, Path::new(".")).map_err(of_scene)?.parameters;
    let own = &mut scene.parameters;
    if file.get(&["geometry"]).is_some() {
        assumed.retain(|name| !OF_RECTANGLE.contains(name));
        let Parameters { height, thickness, width, density, ref profile, .. } = given;
        let profile = profile.clone();
        *own = Parameters { height, thickness, width, density, profile, ..own.clone() };
    }
    if file.get(&["tie"]).is_some() {
        own.set_ties(&given.ties().collect::<Vec<_>>());
        own.apply_bars().map_err(refused)?;
    }
    Ok(())
}

/// Gives the wall of a scene the force law of a capacity curve, the text of a table `[force_law]`.
fn set_curve(scene: &mut Scene, parameters: &Bound<'_, PyDict>, text: &str) -> PyResult<()> {
    let file = TomlFile::new("the capacity curve of a wall", text).map_err(|error| of_scene(error.into()))?;
    let document: Document = file.read().map_err(|error| of_scene(error.into()))?;
    let has_oscillator = file.get(&["force_law", "oscillator"]).is_some();
    let is_other = |group: &str| group == "force_law" || group == "geometry" && has_oscillator;
    let others = GROUPS.iter().filter(|(group, _)| is_other(group)).flat_map(|(_, names)| names.iter());
    for name in others.filter(|name| **name != "gravity").chain([&POINTS]) {
        if parameters.contains(name)? {
            return Err(refused(format!("{name} is not of the capacity curve or oscillator; leave one out")));
        }
    }
    let tables = [&document.force_law, &document.geometry];
    let curve = apply_curve(&mut scene.parameters, tables, &file, Path::new("."));
    scene.curve = curve.map_err(|error| of_scene(error.into()))?;
    Ok(())
}

/// Sets parameters by name, as a scene file does.
pub(crate) fn set_all(scene: &mut Scene, parameters: &Bound<'_, PyDict>) -> PyResult<()> {
    let mut law_of_points = scene.parameters.multilinear.is_some();
    for (name, value) in parameters {
        let name: String = name.extract()?;
        if name == POINTS {
            continue;
        }
        let is_truth = value.get_type().name()?.to_string().starts_with("bool");
        let text = match value.extract::<String>() {
            Ok(text) => text,
            Err(_) if is_truth => return Err(not_a_value(&name, &value)),
            Err(_) => format!("{:?}", value.extract::<f64>().map_err(|_| not_a_value(&name, &value))?),
        };
        if name == "force_law" {
            law_of_points = text == "multilinear";
            if law_of_points {
                continue;
            }
        }
        let known = set_names().any(|known| known == name);
        let unknown = |error: scene::SceneError| PyTypeError::new_err(error.to_string());
        scene.set(&name, &text).map_err(if known { of_scene } else { unknown })?;
    }
    let points = parameters.get_item(POINTS)?.map(|points| points.extract::<Vec<[f64; 2]>>()).transpose();
    let points = points.map_err(|_| PyTypeError::new_err("points must be pairs [[u/u_ins, F/F0], ...]"))?;
    match (law_of_points, points) {
        (true, Some(points)) => {
            (scene.parameters.multilinear, scene.curve) = (Some(points.into()), None);
        }
        (true, None) if scene.parameters.multilinear.is_none() => {
            return Err(refused(format!(
                "force_law = \"multilinear\" needs {POINTS} = [[u/u_ins, F/F0], ...] beside it"
            )));
        }
        (false, Some(_)) => {
            return Err(refused(format!("{POINTS} needs force_law = \"multilinear\" beside it")));
        }
        _ => {}
    }
    Ok(())
}

fn not_a_value(name: &str, value: &Bound<'_, PyAny>) -> PyErr {
    let found = value.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!("{name} must be a number or a name, found a value of the type {found}"))
}
