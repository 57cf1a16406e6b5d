//! What the page's fields need to know of the model description.

use fmu_export::Kind;
use report::number;
use rocking_wall::wall::{Bar, Damping, Parameters, Wall, is_computable, usage};
use scene::{GROUPS, Scene, parameter_text, variable};
use serde_json::{Value, json};

use crate::request::Fields;

/// Describes every parameter: name, meaning, unit, default and the names of its choices.
pub(crate) fn described() -> Value {
    let names = GROUPS.iter().flat_map(|(_, names)| names.iter());
    let of_bar = Bar::NUMBERS.iter().map(|number| {
        json!({
            "name": number.usual.name,
            "meaning": number.text,
            "unit": Some(number.usual.unit).filter(|unit| !unit.is_empty()),
            "default": "",
            "choices": [],
        })
    });
    names.map(|name| described_one(name)).chain(of_bar).collect()
}

/// Lists the parameters that do not matter beside the others. Texts that are not values stand for defaults.
pub(crate) fn unused(fields: &Fields) -> Value {
    let mut scene = Scene::default();
    for (name, text) in fields {
        // the run reports what is wrong with it
        let _ = scene.set(name, text);
    }
    usage(&scene.parameters).filter(|usage| !usage.matters).map(|usage| usage.name).collect()
}

/// Returns the numbers that are computed where they are not given.
pub(crate) fn computed(wall: &Wall) -> Value {
    let Damping { model, ratio } = wall.damping();
    let ratio = model.ratio_name().zip(ratio);
    let all = [("restitution", wall.restitution().positive)].into_iter().chain(ratio);
    all.map(|(name, value)| (name, number(value, 3))).collect()
}

fn described_one(name: &str) -> Value {
    let Some(variable) = variable(name) else { return Value::Null };
    let default = parameter_text(&Parameters::default(), name).unwrap_or_default();
    let is_computable = is_computable(name);
    let choices: Vec<Value> = match variable.kind {
        Kind::Enumeration { items, .. } => {
            items.iter().map(|item| json!({ "name": item.name, "meaning": item.description })).collect()
        }
        _ => Vec::new(),
    };
    json!({
        "name": name,
        "meaning": variable.description,
        "unit": variable.unit.filter(|unit| *unit != "1"),
        // a whole number without `.0`, a name without quotes; nothing where a number is computed
        "default": if is_computable { "" } else { default.trim_matches('"').trim_end_matches(".0") },
        "computable": is_computable,
        "choices": choices,
    })
}
