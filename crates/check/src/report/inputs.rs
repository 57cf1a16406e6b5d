//! The wall of a report: its drawing, and its parameters with where they come from.

use ::report::escaped;
use rocking_wall::scene::{GROUPS, parameter_text, variable};
use rocking_wall::variables::{Mechanism, TieSide};
use rocking_wall::wall::{Bar, BarNumber, Damping, Parameters, Wall, is_computable, usage};

use super::markup::{formula, kilonewtons, shown, stated, table};
use super::{Origin, drawing};

/// Lengths that are read in mm.
const SMALL: [&str; 2] = ["tie_slack", "tie_ultimate"];
/// What a bar and its anchor make.
const OF_BAR: [&str; 3] = ["tie_stiffness", "tie_strength", "tie_ultimate"];

impl Origin<'_> {
    /// Returns where a number of the bar of the tie comes from.
    fn of_bar(&self, number: &BarNumber) -> &'static str {
        if self.file.states(&["check", "tie", "bar", number.key()]) {
            "[check] tie"
        } else {
            self.of_parameter(&["tie", "bar", number.key()], number.usual.name)
        }
    }

    /// Returns where a parameter comes from, by its keys in a scene.
    fn of_parameter(&self, keys: &[&str], name: &str) -> &'static str {
        let is_set = |set: &String| set.split('=').next().map(str::trim) == Some(name);
        match self.wall {
            Some(wall) if wall.stated.as_ref().is_none_or(|stated| stated.contains(&name)) => "file",
            None if self.set.iter().any(is_set) => "--set",
            None if self.file.states(keys) => "scene",
            _ => "default",
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
        let from = origin.of_parameter(&["force_law", "force_law"], "force_law");
        rows.push([name, points.join(" "), from.into()]);
    }
    rows.extend(bar(parameters, origin));
    let rows = table(&["parameter", "value", "from"], &rows);
    format!("{}<div class=\"from\">{rows}</div>", drawing::figure(wall, parameters))
}

/// The numbers of the bar and anchor that make the tie.
fn bar(parameters: &Parameters, origin: &Origin<'_>) -> Vec<[String; 3]> {
    let Some(bar) = parameters.bar.filter(|_| parameters.weaker_part().is_some()) else { return Vec::new() };
    let numbers = Bar::NUMBERS.iter().enumerate();
    let row = |(index, number): (usize, &BarNumber)| {
        let given = bar.get(index)?;
        let unit = if number.key() == "diameter" { ("mm", 1e3) } else { unit_for_people(number.usual.unit) };
        let name = described(number.text, number.usual.name);
        Some([name, value_in(given, unit), origin.of_bar(number).to_owned()])
    };
    numbers.filter_map(row).collect()
}

/// A parameter with its name. Its description says first what it is; behind a semicolon, for who states it,
/// what follows from some values.
fn described(description: &str, name: &str) -> String {
    let what = description.split("; ").next().unwrap_or_default();
    format!("{} <small translate=\"no\">{name}</small>", escaped(what))
}

/// The unit in which people read a number in an SI unit, and the factor to it.
fn unit_for_people(unit: &str) -> (&str, f64) {
    match unit {
        "N" => ("kN", 1e-3),
        "N/m" => ("kN/m", 1e-3),
        "Pa" => ("MPa", 1e-6),
        "m/s2" => ("m/s²", 1.0),
        "kg/m3" => ("kg/m³", 1.0),
        "1" => ("", 1.0),
        unit => (unit, 1.0),
    }
}

fn value_in(value: f64, (unit, factor): (&str, f64)) -> String {
    format!("<span class=\"value\">{} {unit}</span>", stated(factor * value))
}

/// Mechanism, h, b and O in a table of walls.
pub(crate) fn overview(wall: &Wall, parameters: &Parameters) -> Vec<(String, String)> {
    vec![
        ("mechanism".into(), mechanism(parameters.mechanism).into()),
        (formula("h") + " [m]", stated(parameters.height)),
        (formula("b") + " [m]", stated(parameters.thickness)),
        (formula("O") + " [kN]", kilonewtons(wall.body().overburden)),
    ]
}

fn parameter(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    group: &str,
    name: &str,
) -> Option<[String; 3]> {
    let variable = variable(name)?;
    let text = parameter_text(parameters, name)?;
    let number: Option<f64> = text.parse().ok();
    let unit = match unit_for_people(variable.unit.unwrap_or_default()) {
        // slack and elongation of a tie
        ("m", _) if SMALL.contains(&name) && number >= Some(0.0) => ("mm", 1e3),
        unit => unit,
    };
    let is_of_bar = parameters.weaker_part().is_some() && OF_BAR.contains(&name);
    let (value, from) = match number {
        _ if is_computable(name) && text == "-1.0" => {
            let value = computed_value(wall, name);
            (format!("<span class=\"value\">{value} {}</span>", unit.0), "computed")
        }
        Some(number) if is_of_bar => {
            (format!("<span class=\"value\">{} {}</span>", shown(unit.1 * number), unit.0), "computed")
        }
        Some(number) => (value_in(number, unit), origin.of_parameter(&[group, name], name)),
        None => {
            let value = if name == "mechanism" {
                mechanism(parameters.mechanism).to_owned()
            } else if name == "tie_side" {
                let said = match parameters.tie_side {
                    TieSide::Positive => "to the outside (u &gt; 0)",
                    TieSide::Negative => "to the inside (u &lt; 0)",
                    TieSide::Both => "both",
                };
                said.to_owned()
            } else {
                text.trim_matches('"').replace('_', " ")
            };
            (format!("<span class=\"value\">{value}</span>"), origin.of_parameter(&[group, name], name))
        }
    };
    Some([described(variable.description, name), value, from.to_owned()])
}

/// The mechanism, as codes name it.
fn mechanism(mechanism: Mechanism) -> &'static str {
    match mechanism {
        Mechanism::Parapet => "simple overturning",
        Mechanism::VerticalSpanning => "vertical bending (strip)",
    }
}

/// The number that the geometry gives where a parameter leaves it to that.
fn computed_value(wall: &Wall, name: &str) -> String {
    if name == "restitution" {
        return stated(wall.restitution());
    }
    let Damping { model, ratio } = wall.damping();
    ratio.filter(|_| model.ratio_name() == Some(name)).map_or("–".to_owned(), stated)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::language::{Language, translated};
    use rocking_wall::variables::DampingModel;

    /// A description that is worded anew, so that other words stand before its semicolon, is translated anew.
    #[test]
    fn what_each_parameter_is_stands_in_the_terms() {
        let names = GROUPS.into_iter().flat_map(|(_, names)| names.iter().copied());
        let of_bar = Bar::NUMBERS.map(|number| (number.text, number.usual.name));
        let of_wall = names.filter_map(|name| Some((variable(name)?.description, name)));
        let missing = of_wall.chain(of_bar).filter(|(description, name)| {
            let english = described(description, name);
            translated(english.clone(), Language::It) == english
        });
        assert_eq!(missing.collect::<Vec<_>>(), []);
    }
    #[test]
    fn damping_models_stand_in_the_terms() {
        for model in DampingModel::ALL {
            let english = model.name().replace('_', " ");
            assert_ne!(translated(english.clone(), Language::It), english, "add {english} to terms.tsv");
        }
    }
}
