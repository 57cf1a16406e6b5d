//! `wall schema`: the JSON schema of scene files, from the model description.

use anyhow::Result;
use fmi2_export::{Kind, Variable, VariableId};
use rocking_wall::scene::{
    DEFAULT_THRESHOLDS, GROUPS, KINEMATICS, MOST_THRESHOLDS, MotionTable, POINTS, input_names,
};
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::Kinematics;
use serde_json::{Map, Value, json};

use crate::output;

pub(crate) fn run() -> Result<()> {
    output::to_stdout(&(serde_json::to_string_pretty(&schema()?)? + "\n"))
}

pub(crate) fn schema() -> Result<Value> {
    let mut properties = Map::new();
    properties.insert("title".into(), json!({ "type": "string", "description": "Title, for people." }));
    properties.insert(
        "inputs".into(),
        json!({
            "type": "array",
            "uniqueItems": true,
            "items": { "enum": input_names().collect::<Vec<_>>() },
            "description": "Inputs that stay variables of the scene's FMU: by default a_g, and none for a scene with its own motion."
        }),
    );
    for (name, description) in [
        ("stop_time", "End of the run [s]; by default the motion's duration and tail, or 30 s."),
        ("output_step", "Step of the output [s]; by default the motion's own, or 0.01 s."),
    ] {
        properties.insert(
            name.into(),
            json!({ "type": "number", "exclusiveMinimum": 0, "description": description }),
        );
    }
    properties.insert(
        "thresholds".into(),
        json!({
            "type": "array",
            "maxItems": MOST_THRESHOLDS,
            "items": { "type": "number", "exclusiveMinimum": 0, "maximum": 1 },
            "default": DEFAULT_THRESHOLDS,
            "description": "Limit states as fractions of u_ins, whose first crossings a run reports."
        }),
    );
    for (group, names) in GROUPS {
        let mut members: Map<String, Value> =
            names.iter().filter_map(|name| Some(((*name).to_owned(), parameter(name)?))).collect();
        if group == "geometry" {
            members.insert(
                KINEMATICS.into(),
                json!({
                    "enum": Kinematics::ALL.map(Kinematics::name),
                    "default": Kinematics::default().name(),
                    "description": "Small rotations, or full ones (rigid_linear without damping, not in an FMU)."
                }),
            );
        }
        if group == "force_law" {
            extend_force_law(&mut members);
        }
        properties.insert(
            group.into(),
            json!({ "type": "object", "additionalProperties": false, "properties": members }),
        );
    }
    let motion = serde_json::to_value(schemars::schema_for!(MotionTable))?;
    properties.insert("motion".into(), json!({ "$ref": "#/$defs/MotionTable" }));
    let mut definitions = Map::new();
    let mut motion = motion;
    if let Some(object) = motion.as_object_mut() {
        object.remove("$schema");
        if let Some(Value::Object(inner)) = object.remove("$defs") {
            definitions.extend(inner);
        }
    }
    definitions.insert("MotionTable".into(), motion);
    Ok(json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Scene of rocking-wall",
        "type": "object",
        "additionalProperties": false,
        "properties": properties,
        "$defs": definitions,
    }))
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
