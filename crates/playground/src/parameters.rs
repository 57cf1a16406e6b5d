//! What the page's fields need to know of the model description.

use fmu_export::{Kind, VariableId};
use rocking_wall::scene::{GROUPS, parameter_text};
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::Parameters;
use serde_json::{Value, json};

/// Describes every parameter: name, table, meaning, unit, default and the names of its choices.
pub(crate) fn described() -> Value {
    let names = GROUPS.iter().flat_map(|(group, names)| names.iter().map(move |name| (group, name)));
    names.map(|(group, name)| described_one(group, name)).collect()
}

fn described_one(group: &str, name: &str) -> Value {
    let real = RealVariable::from_name(name).map(VariableId::variable);
    let variable = real.or_else(|| IntegerVariable::from_name(name).map(VariableId::variable));
    let Some(variable) = variable else { return Value::Null };
    let default = parameter_text(&Parameters::default(), name).unwrap_or_default();
    let choices: Vec<Value> = match variable.kind {
        Kind::Enumeration { items, .. } => {
            items.iter().map(|item| json!({ "name": item.name, "meaning": item.description })).collect()
        }
        _ => Vec::new(),
    };
    json!({
        "name": name,
        "group": group,
        "meaning": variable.description,
        "unit": variable.unit.filter(|unit| *unit != "1"),
        // a whole number without `.0`, a name without quotes
        "default": default.trim_matches('"').trim_end_matches(".0"),
        "choices": choices,
    })
}
