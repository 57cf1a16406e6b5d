//! The walls of a study: objects, or parameters by their names.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking_wall::wall::Parameters;
use run::wall_parameters::{check_parameter, wall_parameters};
use run::walls::{NamedWall, assumed, with_curve};
use scene::{GROUPS, KINEMATICS, POINTS, Scene, parameter_text};

use crate::errors::refused;
use crate::walls::{Wall, set_all};

/// Makes the walls of a study, and warns of what the study does not use of them.
pub(crate) fn named_walls(
    given: &[(String, Bound<'_, PyAny>)],
    warnings: &mut Vec<String>,
) -> PyResult<Vec<NamedWall>> {
    let mut unused: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut walls = Vec::with_capacity(given.len());
    for (name, wall) in given {
        if let Ok(wall) = wall.cast::<Wall>() {
            let wall = wall.get();
            let names = unused_names(wall);
            if !names.is_empty() {
                unused.push((name, names));
            }
            let (parameters, floors) = (wall.scene.parameters.clone(), wall.scene.floors.clone());
            let (assumed, curve) = (wall.assumed.clone(), wall.scene.curve.clone());
            let wall = NamedWall { floors, assumed, ..NamedWall::new(name.clone(), parameters) };
            walls.push(with_curve(wall, curve, &mut Vec::new(), warnings));
        } else {
            walls.push(of_parameters(name, wall.cast::<PyDict>()?)?);
        }
    }
    if let Some((first, names)) = unused.first() {
        let also = if unused.len() > 1 { format!(", {} walls", unused.len()) } else { String::new() };
        warnings.push(format!(
            "wall {first:?}{also}: the study does not use {}; its models set damping and impact, its records \
             the motion, and every wall starts upright and at rest",
            names.join(", ")
        ));
    }
    Ok(walls)
}

/// Lists the values given for a wall that a study does not use.
fn unused_names(wall: &Wall) -> Vec<&'static str> {
    let default = Parameters::default();
    let given = |name: &&'static str| match *name {
        "u_start" => wall.start.is_some_and(|start| start != 0.0),
        name => parameter_text(&wall.scene.parameters, name) != parameter_text(&default, name),
    };
    let names = GROUPS.iter().flat_map(|(_, names)| names.iter().copied());
    let not_of_study = names.filter(|name| wall_parameters().all(|of_study| of_study != *name));
    let motion = wall.scene.excitation.is_some().then_some("the motion of its scene");
    not_of_study.filter(given).chain(motion).collect()
}

/// Makes a wall of parameters by their names, as a row of a table of walls.
fn of_parameters(name: &str, parameters: &Bound<'_, PyDict>) -> PyResult<NamedWall> {
    for (key, _) in parameters {
        let key: String = key.extract()?;
        check_parameter(&key, &[KINEMATICS, POINTS])
            .map_err(|message| PyTypeError::new_err(format!("wall {name:?}: {message}")))?;
    }
    let mut scene = Scene::default();
    let refuse = |error: PyErr| refused(format!("wall {name:?}: {}", error.value(parameters.py())));
    set_all(&mut scene, parameters).map_err(refuse)?;
    let assumed = assumed(|_, name| parameters.contains(name).is_ok_and(|is_stated| is_stated));
    Ok(NamedWall { assumed, ..NamedWall::new(name, scene.parameters) })
}
