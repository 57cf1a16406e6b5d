//! What the check takes: the wall's parameters and the statements of the engineer, with where they come from.

use crate::circolare::{Activation, LARGEST_CONFIDENCE_FACTOR, LimitState, Method, RecordScale, Source};
use ::report::escaped;
use fmu_export::VariableId;
use rocking_wall::scene::{GROUPS, parameter_text};
use rocking_wall::variables::{IntegerVariable, Mechanism, RealVariable};
use rocking_wall::wall::{COMPUTABLE, Parameters, usage};

use super::Case;
use super::markup::{formula, number, table};

/// What the scene and the command line state.
pub(super) struct Given {
    scene: toml::Table,
    set: Vec<String>,
}

impl Given {
    /// Collects what the text of a scene, which has been read before, and `--set` state.
    pub(super) fn new(text: &str, set: &[String]) -> Self {
        let name =
            |set: &String| set.split_once('=').map_or(set.as_str(), |(name, _)| name).trim().to_owned();
        Self { scene: text.parse().unwrap_or_default(), set: set.iter().map(name).collect() }
    }

    /// Returns where a parameter of a group comes from.
    fn parameter(&self, group: &str, name: &str) -> &'static str {
        let stated = |name| self.scene.get(group).is_some_and(|group| group.get(name).is_some());
        if self.set.iter().any(|set| set == name) {
            "--set"
        } else if stated(name) || (name == "force_law" && stated("points")) {
            "scene"
        } else {
            "default"
        }
    }

    /// The value of a key of the table `[check]`.
    fn check(&self, key: &str) -> Option<&toml::Value> {
        self.scene.get("check")?.get(key)
    }

    /// The text or number of a key of the table `[check]`, or of one of its tables, as markup.
    pub(super) fn text(&self, keys: &[&str]) -> Option<String> {
        let at = |value: &'_ toml::Value| match value {
            toml::Value::String(text) => Some(escaped(text)),
            other => rocking_wall::scene::number(other).map(number),
        };
        let table = self.scene.get("check");
        keys.iter().try_fold(table?, |value, key| value.get(key)).and_then(at)
    }

    /// Returns where a statement comes from.
    fn statement(&self, keys: &[&str]) -> String {
        let stated = keys.iter().find(|key| self.check(key).is_some());
        stated.map_or_else(|| "default".to_owned(), |key| format!("[check] {key}"))
    }
}

/// The groups that the static check uses, and those that only runs use.
const STATIC: [&str; 3] = ["geometry", "force_law", "tie"];
const DYNAMIC: [&str; 3] = ["damping", "impact", "solver"];

/// The parameters of the wall that matter.
pub(super) fn wall(case: &Case<'_>) -> String {
    let parameters = case.report.subject.parameters;
    let is_dynamic = case.report.verdict.dynamic.is_some();
    let is_law = case.report.statement.before_activation == Some(Activation::Law);
    let mut rows = Vec::new();
    for (group, names) in GROUPS {
        if !(STATIC.contains(&group) || is_dynamic && DYNAMIC.contains(&group)) {
            continue;
        }
        for name in names {
            let matters = usage(parameters).any(|usage| usage.name == *name && usage.matters);
            let no_tie = group == "tie" && case.wall.tie().is_none();
            // a wall that is rigid or a beam before it rocks has no elastic branch of its law
            let replaced = *name == "a1" && !is_dynamic && !is_law;
            if matters && !no_tie && !replaced {
                rows.extend(parameter(case, group, name));
            }
        }
    }
    if let Some(points) = &parameters.multilinear {
        let points: Vec<_> =
            points.iter().map(|[u, f]| format!("({}, {})", number(*u), number(*f))).collect();
        let name = format!("Corners of the force law, {}", formula("u/u_ins, F/F0"));
        rows.push([name, points.join(" "), "scene".into()]);
    }
    table(&["parameter", "value", "from"], &rows)
}

fn parameter(case: &Case<'_>, group: &str, name: &str) -> Option<[String; 3]> {
    let parameters = case.report.subject.parameters;
    let real = RealVariable::from_name(name).map(VariableId::variable);
    let variable = real.or(IntegerVariable::from_name(name).map(VariableId::variable))?;
    let unit = variable.unit.filter(|unit| *unit != "1").unwrap_or_default().replace("m/s2", "m/s²");
    let text = parameter_text(parameters, name)?;
    let computed = COMPUTABLE.contains(&name) && text == "-1.0";
    let (value, from) = if computed {
        (computed_value(case, parameters, name), "computed".to_owned())
    } else {
        let value = text.parse().map_or_else(|_| text.trim_matches('"').replace('_', " "), number);
        (value, case.given.parameter(group, name).to_owned())
    };
    let unit = unit.replace("m3", "m³");
    // the conditions under which it matters hold
    let description = variable.description.split("; where ").next().unwrap_or_default();
    let value = format!("<span class=\"value\">{value} {unit}</span>");
    Some([format!("{} <small>{name}</small>", escaped(description)), value, from])
}

/// The number that the geometry gives where a parameter leaves it to that.
fn computed_value(case: &Case<'_>, parameters: &Parameters, name: &str) -> String {
    match name {
        "restitution" => number(case.wall.restitution()),
        _ if parameters.damping_model.ratio_name() == Some(name) => number(case.wall.damping_ratio()),
        _ => "–".to_owned(),
    }
}

/// Describes the statements of the engineer, and where each comes from.
pub(super) fn statements(case: &Case<'_>) -> String {
    let (given, statement) = (&case.given, case.report.statement);
    let mut rows = Vec::new();
    let mut state = |said: String, keys: &[&str]| rows.push([said, given.statement(keys)]);
    state(activation(case), &["before_activation"]);
    if case.report.subject.parameters.overburden > 0.0 {
        state(overburden(case), &["overburden_mass"]);
    }
    state(confidence(case), &["confidence_factor", "knowledge_level"]);
    let compression = if statement.compression_considered {
        "The hinges are set back for the compressive strength of the masonry."
    } else {
        "The limited compressive strength of the masonry is neglected: hinges are at the edges."
    };
    state(compression.into(), &["compression_considered"]);
    state(
        format!("Behaviour factor {} = {}.", formula("q"), number(statement.behaviour_factor)),
        &["behaviour_factor"],
    );
    if let Some(class) = statement.use_class {
        state(format!("Use class {class:?}."), &["use_class"]);
    }
    let method = match statement.method {
        Method::Nonlinear => "SLV and SLC by displacement decide (C8.7.1.2.1.8).",
        Method::Linear => "SLV with q decides (C8.7.1.2.1.7).",
        Method::Dynamic => "The runs under records decide (C8.7.1.2.1.9).",
    };
    state(method.into(), &["method"]);
    if case.report.verdict.dynamic.is_some() {
        let scale = match statement.record_scale {
            RecordScale::Ag => format!("The peak of each record is brought to {}.", formula("a_g S")),
            RecordScale::None => "The records are taken as they are.".to_owned(),
        };
        state(scale, &["record_scale"]);
    }
    for (given, xi) in
        statement.states.iter().flatten().filter_map(|given| Some((given, given.building_damping?)))
    {
        let said =
            format!("The building has the damping {} = {} in {}.", formula("ξ_k"), number(xi), given.state);
        state(said, &[given.state.key(), "building_damping"]);
    }
    if let Some(u) = statement.state(LimitState::Slc).and_then(|given| given.displacement) {
        let said =
            format!("Something else becomes unstable at {} = {} m and limits SLC.", formula("u"), number(u));
        rows.push([said, "[check] SLC displacement".to_owned()]);
    }
    let missing = LimitState::ALL.into_iter().filter(|state| statement.state(*state).is_none());
    let taken = |said: String| [said, "method of the check".to_owned()];
    let missing: Vec<_> = missing.map(|state| state.to_string()).collect();
    let one_body = "There is one resultant of the forces on each body (C8.7.1.1), so that e* = 1.".to_owned();
    rows.push(taken(one_body.replace("e*", &formula("e*"))));
    if statement.states.iter().flatten().any(|state| matches!(state.source, Source::Code(_))) {
        rows.push(taken(format!(
            "The shape of each spectrum ({}) is held at that of the site while {} varies.",
            formula("F0, T_C*, S, T_B, T_C, T_D, T_k, ξ_k"),
            formula("a_g")
        )));
    }
    if !missing.is_empty() {
        rows.push([
            format!("Not checked, for want of a site: {} (NTC 8.3, 7.3.6).", missing.join(", ")),
            "[check]".to_owned(),
        ]);
    }
    table(&["statement", "from"], &rows)
}

fn activation(case: &Case<'_>) -> String {
    let statement = case.report.statement;
    match statement.before_activation {
        Some(Activation::Law) => {
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is elastic as its force law."
                .into()
        }
        Some(Activation::Beam) => format!(
            "The wall is a free element (C8.7.1.2.1.5); before it rocks it is a uniform beam with {} = {} \
             MPa.",
            formula("E"),
            number(1e-6 * statement.young_modulus.unwrap_or(f64::NAN))
        ),
        Some(Activation::Rigid) => {
            "The wall is held by transverse walls before it rocks (C8.7.1.2.1.5): it is rigid.".into()
        }
        None => "The wall rocks to one side, against transverse walls that hold it before: it is rigid \
                 (C8.7.1.2.1.5)."
            .into(),
    }
}

fn overburden(case: &Case<'_>) -> String {
    if case.report.subject.parameters.mechanism == Mechanism::VerticalSpanning {
        return "The top is held: the mass of the overburden does not move with the wall.".into();
    }
    let r = case.report.statement.overburden_mass.unwrap_or(0.0);
    let meaning = if r == 0.0 { ": its inertia goes elsewhere" } else { "" };
    format!(
        "The share {} = {} of the overburden's mass moves with the wall{meaning}.",
        formula("r"),
        number(r)
    )
}

fn confidence(case: &Case<'_>) -> String {
    let (given, statement) = (&case.given, case.report.statement);
    let factor = statement.confidence_factor;
    let level = given.text(&["knowledge_level"]);
    let level = level.map_or_else(String::new, |level| format!(" (level of knowledge {level})"));
    let why = if statement.compression_considered {
        "hinges are set back for compression, so that the level of knowledge reached counts (C8.5.4)"
    } else if factor > LARGEST_CONFIDENCE_FACTOR {
        "more than that of LC1"
    } else {
        "that of LC1, which applies where the compressive strength is neglected (C8.7.1.2.1.3)"
    };
    format!("FC = {}{level}: {why}.", number(factor))
}
