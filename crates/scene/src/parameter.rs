//! Parameters of a scene: names, groups, kinds and limits come from the model description.

use std::path::Path;

use files::{FileError, NUMBER, TomlFile, number, suggestion, unknown_key};
use fmu_export::{Causality, Kind, Variable, VariableId, check_real};
use rocking_wall::variables::{GROUPS, IntegerVariable, RealVariable};
use rocking_wall::wall::{Bar, Kinematics, OF_RECTANGLE, ParameterError, Parameters};
use toml::Value;

use crate::body::{BODY, LOAD, OF_BODY, OPENING, PART, apply_body};
use crate::curve::{Curve, CurveTable, apply_curve};
use crate::error::SceneError;
use crate::keys::{
    BAR, Group, KINEMATICS, KINEMATICS_GROUP, MULTILINEAR, OF_BAR, POINTS, TIE_GROUP, TieTables,
};
use crate::schema::{BarTable, groups};

/// Returns the names of the inputs of the model description.
pub fn input_names() -> impl Iterator<Item = &'static str> {
    let inputs = RealVariable::ALL.iter().map(|variable| variable.variable());
    inputs.filter(|variable| variable.causality == Causality::Input).map(|variable| variable.name)
}

/// Returns the value of a parameter as text that a scene or an XML start attribute can hold; `None` for other
/// variables.
pub fn parameter_text(parameters: &Parameters, name: &str) -> Option<String> {
    if let Some(variable) = RealVariable::from_name(name) {
        return parameters.real(variable).map(|value| format!("{value:?}"));
    }
    let variable = IntegerVariable::from_name(name)?;
    let Kind::Enumeration { items, .. } = variable.variable().kind else { return None };
    let value = parameters.integer(variable)?;
    items.iter().find(|item| item.value == value).map(|item| format!("{:?}", item.name))
}

/// Applies the tables of a wall: groups with their names, and its ties. Returns the capacity curve that is
/// its force law, if it has one; a file of it is looked up in `folder`.
///
/// # Errors
/// [`FileError`] of a key or a value that cannot be used, or of a row of the curve.
pub fn apply_tables(
    parameters: &mut Parameters,
    groups: &[(&str, &Group)],
    ties: &TieTables,
    file: &TomlFile<'_>,
    folder: &Path,
) -> Result<Option<Curve>, FileError> {
    groups.iter().try_for_each(|(name, group)| apply_group(parameters, name, group, file))?;
    apply_ties(parameters, ties, file)?;
    let none = Group::default();
    let of = |name: &str| groups.iter().find(|(own, _)| *own == name).map_or(&none, |(_, group)| *group);
    apply_curve(parameters, [of("force_law"), of(KINEMATICS_GROUP)], file, folder)
}

/// Applies one table of a file, but for a capacity curve.
///
/// # Errors
/// [`FileError`] of a key or a value that cannot be used.
pub fn apply_group(
    parameters: &mut Parameters,
    group: &str,
    entries: &Group,
    file: &TomlFile<'_>,
) -> Result<(), FileError> {
    let place = file.place();
    let names = GROUPS.iter().find(|(name, _)| *name == group).map_or(&[][..], |(_, names)| *names);
    let names_of_curve = files::names::<CurveTable>();
    let (mut law, mut points, mut bar, mut has_curve) = (None, None, None, false);
    for (key, value) in entries.iter() {
        let own = value.get_ref();
        match (group, key.get_ref().as_str()) {
            ("force_law", POINTS) => points = Some(value),
            ("force_law", "force_law") if own.as_str() == Some(MULTILINEAR) => law = Some(value),
            (TIE_GROUP, BAR) if own.is_array() => {
                let message = "bar is one table: write [tie.bar] below its [tie] or [[tie]]";
                return Err(place.error(value.span(), message));
            }
            (TIE_GROUP, BAR) => bar = Some(value),
            ("force_law", name) if names_of_curve.contains(&name) => has_curve = true,
            ("geometry", PART | OPENING | LOAD | BODY) => {}
            (_, name) if names.contains(&name) || (group, name) == (KINEMATICS_GROUP, KINEMATICS) => {
                set(parameters, name, own).map_err(|message| place.error(value.span(), message))?;
            }
            (_, name) => {
                let groups = groups();
                let known = groups.get(group).map_or(&[][..], Vec::as_slice);
                return Err(place.error(key.span(), unknown_key(name, group, known, &groups)));
            }
        }
    }
    match (law, points) {
        (Some(_), Some(points)) => {
            let message = || {
                let given = shown(points.get_ref());
                let expected = "a list of pairs [u/u_ins, F/F0] of numbers, from the first corner outwards";
                place.error(points.span(), format!("{POINTS} = {given}: expected {expected}"))
            };
            parameters.multilinear = Some(read_points(points.get_ref()).ok_or_else(message)?.into());
        }
        (Some(_), None) if has_curve => {}
        (Some(value), None) | (None, Some(value)) => {
            let message = format!(
                "force_law = {MULTILINEAR:?} goes with {POINTS} = [[u/u_ins, F/F0], ...] from the first \
                 corner outwards; give both"
            );
            return Err(place.error(value.span(), message));
        }
        (None, None) => {}
    }
    if group == "geometry" {
        apply_body(parameters, entries, file)?;
    }
    let Some(bar) = bar else { return Ok(()) };
    if let Some(key) = entries.keys().find(|key| OF_BAR.contains(&key.get_ref().as_str())) {
        let message = format!("{} follows from [tie.bar]; leave out one of them", key.get_ref());
        return Err(place.error(key.span(), message));
    }
    let own = file.find(BAR, &bar.span());
    let read = own.map(|own| file.read_value::<BarTable>(own)).transpose();
    let read = read.map_err(|fault| place.error(fault.span, fault.message))?;
    parameters.bar = read.map(|BarTable(bar)| bar);
    follow_bar(parameters).map_err(|message| place.error(bar.span(), message))
}

/// Applies the ties of a file: the first sets the parameters `tie_…`.
///
/// # Errors
/// [`FileError`] of a key or a value that cannot be used, of one of several ties that has no stiffness.
fn apply_ties(parameters: &mut Parameters, ties: &TieTables, file: &TomlFile<'_>) -> Result<(), FileError> {
    let refused = |number: usize, message: String| {
        let key = ties.get(number).and_then(|tie| tie.keys().next());
        match key {
            Some(key) => file.place().error(key.span(), message),
            None => FileError::whole(file.place().name(), message),
        }
    };
    let mut further = Vec::new();
    for (number, table) in ties.iter().enumerate() {
        let mut alone = Parameters { width: parameters.width, ..Parameters::default() };
        let of_tie = if number == 0 { &mut *parameters } else { &mut alone };
        apply_group(of_tie, TIE_GROUP, table, file)?;
        let missing = [
            (of_tie.tie_stiffness == 0.0, "no stiffness: give tie_stiffness or [tie.bar], or leave it out"),
            (of_tie.tie_height == 0.0, "no height: give tie_height"),
        ];
        if let (true, Some((_, what))) =
            (ties.is_list, missing.into_iter().find(|(is_missing, _)| *is_missing))
        {
            return Err(refused(number, format!("tie {} of {} has {what}", number + 1, ties.len())));
        }
        if number > 0 {
            further.extend(alone.ties().next());
        }
    }
    parameters.further_ties = further.into();
    Ok(())
}

/// Gives the ties the numbers of their bars, once these are complete.
fn follow_bar(parameters: &mut Parameters) -> Result<(), String> {
    match parameters.apply_bars() {
        Err(ParameterError::BarNeeds { .. }) => return Ok(()),
        applied => applied.map_err(|error| error.to_string())?,
    }
    for name in OF_BAR {
        if let Some(variable) = RealVariable::from_name(name) {
            let value = parameters.real(variable).unwrap_or_default();
            check_limits(variable.variable(), value).map_err(|error| format!("of this bar {error}"))?;
        }
    }
    Ok(())
}

/// Returns the names by which parameters are set one by one.
pub fn set_names() -> impl Iterator<Item = &'static str> {
    let names = GROUPS.iter().flat_map(|(_, names)| names.iter().copied());
    names.chain([KINEMATICS]).chain(Bar::NUMBERS.map(|number| number.usual.name))
}

/// Sets a parameter from text: a number, or the name of an item with or without quotes.
/// Tells the curve of the force law.
pub(crate) fn set_from_text(
    parameters: &mut Parameters,
    curve: &mut Option<Curve>,
    name: &str,
    text: &str,
) -> Result<(), SceneError> {
    let refused = |message| SceneError::Value { message };
    curve.as_ref().map_or(Ok(()), |curve| curve.refuse(name)).map_err(refused)?;
    if set_names().all(|known| known != name) {
        let all: Vec<_> = set_names().collect();
        let meant = suggestion(name, all.iter().copied());
        let message = format!("there is no parameter {name:?}{meant}; the parameters are {}", all.join(", "));
        return Err(SceneError::Value { message });
    }
    let value = if let Ok(number) = text.trim().parse::<f64>() {
        Value::Float(number)
    } else {
        Value::String(text.trim().trim_matches('"').to_owned())
    };
    if name == "force_law" {
        parameters.multilinear = None;
    }
    if parameters.profile.is_some() {
        let whose = if OF_RECTANGLE.contains(&name) { "a rectangle" } else { "a body by its integrals" };
        if OF_RECTANGLE.contains(&name) || OF_BODY.contains(&name) {
            let message =
                format!("{name} is that of {whose}, and the wall has parts; change these in its file");
            return Err(SceneError::Value { message });
        }
    }
    if !parameters.further_ties.is_empty() && (name.starts_with("tie_") || name.starts_with("bar_")) {
        let message =
            format!("{name} is that of one tie, and the wall has several; change these in its file");
        return Err(SceneError::Value { message });
    }
    if OF_BAR.contains(&name) {
        parameters.bar = None;
    }
    set(parameters, name, &value).and_then(|()| follow_bar(parameters)).map_err(refused)?;
    *curve = curve.take().and_then(|curve| curve.after_change(parameters));
    Ok(())
}

fn set(parameters: &mut Parameters, name: &str, value: &Value) -> Result<(), String> {
    if name == KINEMATICS {
        let text = value.as_str();
        let found = Kinematics::ALL.into_iter().find(|kinematics| Some(kinematics.name()) == text);
        let names = Kinematics::ALL.map(Kinematics::name).join(", ");
        parameters.kinematics =
            found.ok_or_else(|| format!("{name} = {} is not one of {names}", shown(value)))?;
        return Ok(());
    }
    if let Some(index) = Bar::NUMBERS.iter().position(|number| number.usual.name == name) {
        let number = real(name, value)?;
        parameters.bar.get_or_insert_default().set(index, number);
        return Ok(());
    }
    if let Some(variable) = RealVariable::from_name(name) {
        let number = real(name, value)?;
        check_limits(variable.variable(), number)?;
        if parameters.set_real(variable, number) {
            return Ok(());
        }
    }
    if let Some(variable) = IntegerVariable::from_name(name)
        && let Kind::Enumeration { items, .. } = variable.variable().kind
    {
        let item = value.as_str().and_then(|text| items.iter().find(|item| item.name == text));
        if item.is_some_and(|item| parameters.set_integer(variable, item.value)) {
            return Ok(());
        }
        let names: Vec<_> = items.iter().map(|item| item.name).collect();
        return Err(format!("{name} = {} is not one of {}", shown(value), names.join(", ")));
    }
    Err(format!("{name} is not a parameter"))
}

/// Reads the number of a key.
fn real(name: &str, value: &Value) -> Result<f64, String> {
    number(value).ok_or_else(|| format!("{name} = {}: expected {NUMBER}", shown(value)))
}

/// Formats a value as the file states it.
fn shown(value: &Value) -> String {
    match value {
        Value::String(text) => format!("{text:?}"),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(truth) => truth.to_string(),
        Value::Datetime(time) => time.to_string(),
        Value::Array(_) => "[…]".to_owned(),
        Value::Table(_) => "{…}".to_owned(),
    }
}

/// Checks a number against the limits of a variable of the model description.
///
/// # Errors
/// A message with name, value and limit.
pub fn check_limits(variable: &Variable, number: f64) -> Result<(), String> {
    check_real(variable, number).map_err(|failure| failure.0)
}

fn read_points(value: &Value) -> Option<Vec<[f64; 2]>> {
    let pair = |item: &Value| match item.as_array()?.as_slice() {
        [u, f] => Some([number(u)?, number(f)?]),
        _ => None,
    };
    value.as_array()?.iter().map(pair).collect()
}
