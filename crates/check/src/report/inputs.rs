//! The wall of a report: its drawing, and its parameters with where they come from.

use ::report::escaped;
use fmu_export::VariableId;
use rocking_wall::scene::{GROUPS, parameter_text};
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::{COMPUTABLE, Parameters, Wall, usage};

use super::markup::{formula, stated, table};
use super::{Origin, drawing};

impl Origin<'_> {
    /// Returns where a parameter of a group comes from.
    fn of_parameter(&self, group: &str, name: &str) -> &'static str {
        let is_set = |set: &String| set.split_once('=').map_or(set.as_str(), |set| set.0).trim() == name;
        let has_points = name == "force_law" && self.file.states(&[group, "points"]);
        if let Some(wall) = self.wall {
            // a table of walls, and scenes that they name, state parameters without a key of the file
            let usual = parameter_text(&Parameters::default(), name);
            let is_own = parameter_text(&wall.parameters, name) != usual;
            return if is_own || self.file.wall_states(wall.entry, group, name) { "file" } else { "default" };
        }
        if self.set.iter().any(is_set) {
            "--set"
        } else if has_points || self.file.states(&[group, name]) {
            "scene"
        } else {
            "default"
        }
    }
}

/// The wall to scale, and its parameters that matter to the check: of these groups and names.
pub(crate) fn the_wall(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    is_used: &dyn Fn(&str, &str) -> bool,
) -> String {
    let mut rows = Vec::new();
    for (group, names) in GROUPS {
        for name in names {
            let matters = usage(parameters).any(|usage| usage.name == *name && usage.matters);
            let no_tie = group == "tie" && wall.tie().is_none();
            if matters && !no_tie && is_used(group, name) {
                rows.extend(parameter(wall, parameters, origin, group, name));
            }
        }
    }
    if let Some(points) = &parameters.multilinear {
        let points: Vec<_> =
            points.iter().map(|[u, f]| format!("({}, {})", stated(*u), stated(*f))).collect();
        let name = format!("Corners of the force law, {}", formula("u/u_ins, F/F0"));
        rows.push([name, points.join(" "), "scene".into()]);
    }
    drawing::figure(wall, parameters) + &table(&["parameter", "value", "from"], &rows)
}

fn parameter(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    group: &str,
    name: &str,
) -> Option<[String; 3]> {
    let real = RealVariable::from_name(name).map(VariableId::variable);
    let variable = real.or(IntegerVariable::from_name(name).map(VariableId::variable))?;
    let unit = variable.unit.filter(|unit| *unit != "1").unwrap_or_default().replace("m/s2", "m/s²");
    let text = parameter_text(parameters, name)?;
    let computed = COMPUTABLE.contains(&name) && text == "-1.0";
    let (value, from) = if computed {
        (computed_value(wall, parameters, name), "computed".to_owned())
    } else {
        let value = text.parse().map_or_else(|_| text.trim_matches('"').replace('_', " "), stated);
        (value, origin.of_parameter(group, name).to_owned())
    };
    let unit = unit.replace("m3", "m³");
    // the conditions under which it matters hold
    let description = variable.description.split("; where ").next().unwrap_or_default();
    let value = format!("<span class=\"value\">{value} {unit}</span>");
    Some([format!("{} <small translate=\"no\">{name}</small>", escaped(description)), value, from])
}

/// The number that the geometry gives where a parameter leaves it to that.
fn computed_value(wall: &Wall, parameters: &Parameters, name: &str) -> String {
    match name {
        "restitution" => stated(wall.restitution()),
        _ if parameters.damping_model.ratio_name() == Some(name) => stated(wall.damping_ratio()),
        _ => "–".to_owned(),
    }
}
