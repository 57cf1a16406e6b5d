//! The parameters of the wall of a report, with where they come from.

use ::report::escaped;
use rocking_wall::variables::TieSide;
use rocking_wall::wall::{Bar, BarNumber, Damping, Parameters, Wall, is_computable, usage};
use scene::{GROUPS, parameter_text, variable};

use super::origin::Origin;
use crate::words::formulas::formula;
use crate::words::ledger::Unit;
use crate::words::markup::{heads, table};
use crate::words::others::{choice, described, mechanism};
use crate::words::{Language, Sentence, say};

/// Lengths that are read in mm.
const SMALL: [&str; 2] = ["tie_slack", "tie_ultimate"];
/// What a bar and its anchor make.
const OF_BAR: [&str; 3] = ["tie_stiffness", "tie_strength", "tie_ultimate"];

impl Origin<'_> {
    /// Returns where a number of the bar of the tie comes from.
    fn of_bar(&self, number: &BarNumber) -> Sentence {
        if self.file.states(&["check", "tie", "bar", number.key()]) {
            say!("file", "file dei dati")
        } else {
            self.of_parameter(&["tie", "bar", number.key()], number.usual.name)
        }
    }

    /// Returns where a parameter comes from, by its keys in a scene.
    fn of_parameter(&self, keys: &[&str], name: &str) -> Sentence {
        let is_set = |set: &String| set.split('=').next().map(str::trim) == Some(name);
        match self.wall {
            Some(wall) if wall.stated.as_ref().is_none_or(|stated| stated.contains(&name)) => {
                say!("file", "file dei dati")
            }
            None if self.set.iter().any(is_set) => say!("command line", "riga di comando"),
            None if self.file.states(keys) || self.file.body_states(name) => say!("file", "file dei dati"),
            _ => say!("default", "valore predefinito"),
        }
    }
}

/// A parameter of a report.
struct Shown {
    /// What it is, as markup.
    what: String,
    /// Its key in a file.
    key: String,
    /// Its value, as markup.
    value: String,
    /// Where it comes from.
    from: Sentence,
}

/// The parameters of the wall that matter to the check: of these groups and names.
pub(crate) fn of_wall(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    is_used: &dyn Fn(&str, &str) -> bool,
) -> String {
    let language = origin.report.language;
    let all = all(wall, parameters, origin, is_used).into_iter();
    let rows: Vec<_> = all.map(|one| [one.what, one.value, one.from.markup(language)]).collect();
    let parts = [say!("parameter", "parametro"), say!("value", "valore"), say!("from", "provenienza")];
    format!("<div class=\"from\">{}</div>", table(&heads(parts, language), &rows))
}

/// The keys by which a file states the parameters of the wall: what each is, its key, and its origin.
pub(crate) fn keys(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    is_used: &dyn Fn(&str, &str) -> bool,
) -> Vec<[String; 3]> {
    let language = origin.report.language;
    let all = all(wall, parameters, origin, is_used).into_iter();
    all.map(|one| [one.what, code(&one.key), one.from.markup(language)]).collect()
}

/// A key as markup, which no language replaces.
pub(crate) fn code(key: &str) -> String {
    format!("<code translate=\"no\">{}</code>", escaped(key))
}

fn all(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    is_used: &dyn Fn(&str, &str) -> bool,
) -> Vec<Shown> {
    let mut rows = Vec::new();
    let of_group = |parameters: &Parameters, group: &str, names: &[&str]| {
        let matters = |name: &str| usage(parameters).any(|usage| usage.name == name && usage.matters);
        let names = names.iter().filter(|name| matters(name) && is_used(group, name));
        names.filter_map(|name| parameter(wall, parameters, origin, group, name)).collect::<Vec<_>>()
    };
    let has_several = wall.ties().len() > 1;
    for (group, names) in GROUPS.into_iter().filter(|(group, _)| *group != "tie") {
        rows.extend(of_group(parameters, group, names));
    }
    let of_ties = GROUPS.into_iter().filter(|(group, _)| *group == "tie" && !wall.ties().is_empty());
    for (group, names) in of_ties {
        let ties = parameters.ties().filter(|tie| tie.stiffness > 0.0);
        for (number, tie) in ties.enumerate() {
            let alone = parameters.tied_by(tie);
            let mut own = of_group(&alone, group, names);
            if has_several {
                own.extend(bar(&alone, origin));
                let tie = say!("Tie {number}", "Catena {number}", number = number + 1);
                let tie = tie.markup(origin.report.language);
                for row in &mut own {
                    row.what = format!("{tie}: {}", row.what);
                }
            }
            rows.extend(own);
        }
    }
    let language = origin.report.language;
    if let Some(points) = &parameters.multilinear {
        let between = if language == Language::It { "; " } else { ", " };
        let points = points.iter().map(|point| point.map(|end| language.stated(end)).join(between));
        let points: Vec<_> = points.map(|point| format!("({point})")).collect();
        let name = say!("Corners of the force law, `u/u_ins, F/F0`", "Vertici della legge, `u/u_ins, F/F0`");
        let from = origin.of_parameter(&["force_law", "force_law"], "force_law");
        let (what, value) = (name.markup(language), points.join(" "));
        rows.push(Shown { what, key: "points".to_owned(), value, from });
    }
    if !has_several {
        rows.extend(bar(parameters, origin));
    }
    rows
}

/// The numbers of the bar and anchor that make the tie.
fn bar(parameters: &Parameters, origin: &Origin<'_>) -> Vec<Shown> {
    let Some(bar) = parameters.bar.filter(|_| parameters.weaker_part().is_some()) else { return Vec::new() };
    let numbers = Bar::NUMBERS.iter().enumerate();
    let language = origin.report.language;
    let row = |(index, number): (usize, &BarNumber)| {
        let given = bar.get(index)?;
        let of_number = unit_for_people(number.usual.unit);
        let unit = if number.key() == "diameter" { Unit::MILLIMETRES } else { of_number };
        let what = described(number.text, number.usual.name).markup(language);
        let (key, value) = (format!("bar.{}", number.key()), value_in(given, unit, language));
        Some(Shown { what, key, value, from: origin.of_bar(number) })
    };
    numbers.filter_map(row).collect()
}

/// The unit in which people read a number in an SI unit, and the factor to it.
fn unit_for_people(unit: &'static str) -> Unit {
    match unit {
        "N" => Unit::KILONEWTONS,
        "N/m" => Unit::KILONEWTONS_PER_METRE,
        "Pa" => Unit::MEGAPASCALS,
        "m/s2" => Unit::ACCELERATION,
        "kg.m2" => Unit { name: "kg m²", factor: 1.0 },
        "kg/m3" => Unit { name: "kg/m³", factor: 1.0 },
        "1" => Unit::NONE,
        name => Unit { name, factor: 1.0 },
    }
}

fn value_in(value: f64, unit: Unit, language: Language) -> String {
    value_of(&language.stated(unit.factor * value), unit.name)
}

fn value_of(text: &str, unit: &str) -> String {
    format!("<span class=\"value\">{}</span>", format!("{text} {unit}").trim_end())
}

/// Mechanism, h, b and O in a table of walls.
pub(crate) fn overview(wall: &Wall, parameters: &Parameters, language: Language) -> Vec<(String, String)> {
    vec![
        (say!("mechanism", "cinematismo").markup(language), mechanism(parameters).of(language).to_owned()),
        (formula("h") + " [m]", language.stated(parameters.height)),
        (formula("b") + " [m]", language.stated(parameters.thickness)),
        (formula("O") + " [kN]", language.shown(1e-3 * wall.body().overburden)),
    ]
}

fn parameter(
    wall: &Wall,
    parameters: &Parameters,
    origin: &Origin<'_>,
    group: &str,
    name: &str,
) -> Option<Shown> {
    let variable = variable(name)?;
    let text = parameter_text(parameters, name)?;
    let number: Option<f64> = text.parse().ok();
    let unit = match unit_for_people(variable.unit.unwrap_or_default()) {
        // slack and elongation of a tie
        unit if unit == Unit::METRES && SMALL.contains(&name) && number >= Some(0.0) => Unit::MILLIMETRES,
        unit => unit,
    };
    let is_of_bar = parameters.weaker_part().is_some() && OF_BAR.contains(&name);
    let language = origin.report.language;
    let computed = say!("computed", "calcolato");
    let stated = || origin.of_parameter(&[group, name], name);
    let (value, from) = match number {
        _ if is_computable(name) && text == "-1.0" => {
            (value_of(&computed_value(wall, name, language), unit.name), computed)
        }
        Some(number) if is_of_bar => (value_of(&language.shown(unit.factor * number), unit.name), computed),
        Some(number) => (value_in(number, unit, language), stated()),
        None => {
            let said = match name {
                "mechanism" => mechanism(parameters),
                "tie_side" => match parameters.tie_side {
                    TieSide::Positive => say!("to the outside (u > 0)", "verso l'esterno (u > 0)"),
                    TieSide::Negative => say!("to the inside (u < 0)", "verso l'interno (u < 0)"),
                    TieSide::Both => say!("both", "entrambi"),
                },
                _ => choice(text.trim_matches('"')),
            };
            (value_of(&escaped(said.of(language)), ""), stated())
        }
    };
    let what = described(variable.description, name).markup(language);
    Some(Shown { what, key: name.to_owned(), value, from })
}

/// The number that the geometry gives where a parameter leaves it to that.
fn computed_value(wall: &Wall, name: &str, language: Language) -> String {
    if name == "restitution" {
        return language.stated(wall.restitution().positive);
    }
    let Damping { model, ratio } = wall.damping();
    let ratio = ratio.filter(|_| model.ratio_name() == Some(name));
    ratio.map_or("–".to_owned(), |ratio| language.stated(ratio))
}
