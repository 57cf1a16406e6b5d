//! `wall schema`: the JSON schema of scene files, from the model description.

use anyhow::Result;
use fmi2_export::{Kind, Variable, VariableId};
use rocking_wall::scene::{DEFAULT_THRESHOLDS, GROUPS, KINEMATICS, MOST_THRESHOLDS, POINTS, input_names};
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::Kinematics;
use serde_json::{Map, Value, json};

use crate::output;

pub(crate) fn run() -> Result<()> {
    output::to_stdout(&(serde_json::to_string_pretty(&schema()?)? + "\n"))
}

/// What a scene holds besides parameters; its test compares the keys with those that scenes accept.
const SKELETON: &str = include_str!("scene.schema.json");

pub(crate) fn schema() -> Result<Value> {
    let mut schema: Value = serde_json::from_str(SKELETON)?;
    let properties = &mut schema["properties"];
    properties["inputs"]["items"]["enum"] = input_names().collect();
    properties["thresholds"]["default"] = json!(DEFAULT_THRESHOLDS);
    properties["thresholds"]["maxItems"] = json!(MOST_THRESHOLDS);
    for (group, names) in GROUPS {
        let mut members: Map<String, Value> =
            names.iter().filter_map(|name| Some(((*name).to_owned(), parameter(name)?))).collect();
        if group == "geometry" {
            members.insert(
                KINEMATICS.into(),
                json!({
                    "enum": Kinematics::ALL.map(Kinematics::name),
                    "default": Kinematics::default().name(),
                    "description":
                        "Small rotations, or full ones (rigid_linear without damping, not in an FMU)."
                }),
            );
        }
        if group == "force_law" {
            extend_force_law(&mut members);
        }
        properties[group] = json!({ "type": "object", "additionalProperties": false, "properties": members });
    }
    Ok(schema)
}

/// The law of points, which only scenes know.
fn extend_force_law(members: &mut Map<String, Value>) {
    if let Some(items) = members.get_mut("force_law").and_then(|law| law.get_mut("enum")?.as_array_mut()) {
        items.push("multilinear".into());
    }
    members.insert(
        POINTS.into(),
        json!({
            "type": "array",
            "minItems": 2,
            "items": { "type": "array", "minItems": 2, "maxItems": 2, "items": { "type": "number" } },
            "description": "Corners [u/u_ins, F/F0] of a multilinear law after the origin."
        }),
    );
}

fn parameter(name: &str) -> Option<Value> {
    let variable: &Variable = RealVariable::from_name(name)
        .map(VariableId::variable)
        .or_else(|| IntegerVariable::from_name(name).map(VariableId::variable))?;
    let unit = variable.unit.map_or(String::new(), |unit| format!(" [{unit}]"));
    let description = format!("{}{unit}", variable.description);
    Some(match variable.kind {
        Kind::Real { start, min, max } => {
            let mut value = json!({ "type": "number", "description": description });
            for (key, number) in [("default", start), ("minimum", min), ("maximum", max)] {
                if let Some(number) = number {
                    value[key] = number.into();
                }
            }
            value
        }
        Kind::Enumeration { start, items } => {
            let names: Vec<_> = items.iter().map(|item| item.name).collect();
            let default = items.iter().find(|item| Some(item.value) == start).map(|item| item.name);
            json!({ "enum": names, "default": default, "description": description })
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_wall::scene::Scene;

    /// The error of an unknown key lists those known.
    #[test]
    fn the_schema_has_the_keys_of_scene_files() {
        for (table, place) in [
            ("MotionTable", "[motion]\nx = 1"),
            ("TopTable", "[motion.top]\nx = 1"),
            ("RickerTable", "[motion]\nricker = { x = 1 }"),
            ("HarmonicTable", "[motion]\nharmonic = { x = 1 }"),
            ("SineTable", "[motion]\nhalf_sine = { x = 1 }"),
            ("SyntheticTable", "[motion]\nsynthetic = { x = 1 }"),
        ] {
            let error = Scene::parse("scene", place, ".".as_ref()).unwrap_err().to_string();
            let (names, _) = error.split_once(", in `").unwrap();
            let mut known: Vec<_> = names.split('`').skip(3).step_by(2).collect();
            known.sort_unstable();
            let schema = schema().unwrap();
            let listed = schema["$defs"][table]["properties"].as_object().unwrap();
            let mut listed: Vec<_> = listed.keys().map(String::as_str).collect();
            listed.sort_unstable();
            assert_eq!(listed, known, "{table}: {error}");
        }
    }
}
