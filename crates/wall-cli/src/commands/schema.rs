//! `wall schema`: the JSON schemas of scenes, studies and buildings, with their parameters from the model
//! descriptions.

use anyhow::Result;
use clap::{Args, ValueEnum};
use fmu_export::{Causality, Kind, Variable, VariableId};
use rocking_floor::variables as floor;
use rocking_wall::scene::{DEFAULT_THRESHOLDS, GROUPS, KINEMATICS, MOST_THRESHOLDS, POINTS, input_names};
use rocking_wall::variables::{IntegerVariable, RealVariable};
use rocking_wall::wall::Kinematics;
use run::model::{EnergyLoss, damping_models, label};
use serde_json::{Map, Value, json};

use crate::output::Console;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Kind of file
    #[arg(value_enum, default_value_t = File::Scene)]
    file: File,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum File {
    /// A wall and its motion
    Scene,
    /// An incremental dynamic analysis
    Study,
    /// Storeys and walls
    Building,
}

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<()> {
    let schema = match arguments.file {
        File::Scene => scene()?,
        File::Study => study()?,
        File::Building => building()?,
    };
    console.print(&(serde_json::to_string_pretty(&schema)? + "\n"))
}

/// Makes the schema of scenes. What they hold besides parameters is in the file, as for the others; tests
/// compare the keys with those that the readers accept.
fn scene() -> Result<Value> {
    let mut schema: Value = serde_json::from_str(include_str!("scene.schema.json"))?;
    add_check(&mut schema)?;
    let of_study: Value = serde_json::from_str(include_str!("study.schema.json"))?;
    for table in ["Records", "Synthetic"] {
        schema["$defs"][table] = of_study["$defs"][table].clone();
    }
    let properties = &mut schema["properties"];
    properties["inputs"]["items"]["enum"] = input_names().collect();
    properties["thresholds"]["default"] = json!(DEFAULT_THRESHOLDS);
    properties["thresholds"]["maxItems"] = json!(MOST_THRESHOLDS);
    for (group, names) in GROUPS {
        properties[group] = table(group, names);
    }
    Ok(schema)
}

/// Adds the tables of a check by a code, which scenes and studies may have.
fn add_check(schema: &mut Value) -> Result<()> {
    let tables: Map<String, Value> = serde_json::from_str(include_str!("check.schema.json"))?;
    for (name, table) in tables {
        schema["$defs"][name] = table;
    }
    Ok(())
}

/// Makes the schema of studies, whose walls take some tables of a scene.
fn study() -> Result<Value> {
    let mut schema: Value = serde_json::from_str(include_str!("study.schema.json"))?;
    add_check(&mut schema)?;
    let of_scene: Value = serde_json::from_str(include_str!("scene.schema.json"))?;
    for table in ["StoreyTable", "SupportsTable"] {
        schema["$defs"][table] = of_scene["$defs"][table].clone();
    }
    schema["$defs"]["ModelName"]["enum"] = EnergyLoss::all().map(EnergyLoss::name).collect();
    schema["$defs"]["Model"]["properties"]["model"]["enum"] =
        damping_models().map(|model| label(model).name).collect();
    for (name, number) in parameters(&["xi", "c_bar"]) {
        schema["$defs"]["Model"]["properties"][name] = number;
    }
    let properties = &mut schema["$defs"]["Wall"]["properties"];
    for (group, names) in GROUPS.iter().filter(|(group, _)| !["damping", "start"].contains(group)) {
        // the models of the study set the impact
        let names: Vec<_> = names.iter().copied().filter(|name| *name != "impact").collect();
        properties[*group] = table(group, &names);
    }
    Ok(schema)
}

/// Makes the schema of buildings, whose storeys take the parameters of a floor.
fn building() -> Result<Value> {
    let mut schema: Value = serde_json::from_str(include_str!("building.schema.json"))?;
    let properties = &mut schema["properties"]["floor"]["items"]["properties"];
    let real = floor::RealVariable::ALL.iter().map(|id| id.variable());
    let all = real.chain(floor::IntegerVariable::ALL.iter().map(|id| id.variable()));
    // reactions couple the members of a building
    for variable in all.filter(|v| v.causality == Causality::Parameter && v.name != "coupling") {
        properties[variable.name] = parameter(variable).unwrap_or_default();
    }
    Ok(schema)
}

/// Makes the schemas of parameters by their names.
fn parameters(names: &[&str]) -> Map<String, Value> {
    let find = |name: &str| {
        let real = RealVariable::from_name(name).map(VariableId::variable);
        real.or_else(|| IntegerVariable::from_name(name).map(VariableId::variable))
    };
    let member = |name: &&str| Some(((*name).to_owned(), parameter(find(name)?)?));
    names.iter().filter_map(member).collect()
}

/// Makes the schema of a table of parameters.
fn table(group: &str, names: &[&str]) -> Value {
    let mut members = parameters(names);
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
    json!({ "type": "object", "additionalProperties": false, "properties": members })
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

fn parameter(variable: &Variable) -> Option<Value> {
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
    use ::building::Building;
    use rocking_wall::scene::Scene;
    use study::document::StudyFile;

    /// The keys that an object of a schema lists, in order.
    fn listed(object: &Value) -> Vec<&str> {
        let mut keys: Vec<_> = object["properties"].as_object().unwrap().keys().map(String::as_str).collect();
        keys.sort_unstable();
        keys
    }

    /// Compares the keys of an object with those that a message about the unknown key `x` names.
    fn assert_keys(object: &Value, error: &str) {
        let (_, names) = error.split_once("; it holds ").unwrap();
        let mut known: Vec<_> = names.split(", ").collect();
        known.sort_unstable();
        assert_eq!(listed(object), known, "{error}");
    }

    #[test]
    fn the_schema_has_the_keys_of_scene_files() {
        for (table, place) in [
            ("StoreyTable", "[[storeys]]\nx = 1"),
            ("SupportsTable", "[supports]\nx = 1"),
            ("MotionTable", "[motion]\nx = 1"),
            ("TopTable", "[motion.top]\nx = 1"),
            ("RickerTable", "[motion]\nricker = { x = 1 }"),
            ("HarmonicTable", "[motion]\nharmonic = { x = 1 }"),
            ("SineTable", "[motion]\nhalf_sine = { x = 1 }"),
            ("SyntheticTable", "[motion]\nsynthetic = { x = 1 }"),
        ] {
            let error = Scene::parse("scene", place, ".".as_ref()).unwrap_err().to_string();
            assert_keys(&scene().unwrap()["$defs"][table], &error);
        }
        let error = Scene::parse("scene", "x = 1", ".".as_ref()).unwrap_err().to_string();
        assert_keys(&scene().unwrap(), &error);
    }

    #[test]
    fn the_schema_has_the_keys_of_checks() {
        for (table, text) in [
            ("Check", "[check]\nx = 1"),
            ("LimitState", "[check]\ncode = \"\"\nSLV = { x = 1 }"),
            ("CheckBuilding", "[check]\ncode = \"\"\nbuilding = { x = 1 }"),
            ("CheckMode", "[check]\ncode = \"\"\nbuilding = { modes = [{ x = 1 }] }"),
        ] {
            let text = text
                .replace("\"\"", "\"circolare-2019\"")
                .replace("[check]\nx", "[check]\ncode = \"circolare-2019\"\nx");
            let error =
                check::read(&check::CheckFile::parse("scene", &text).unwrap()).unwrap_err().to_string();
            assert_keys(&scene().unwrap()["$defs"][table], &error);
        }
    }

    #[test]
    fn the_schema_has_the_keys_of_study_files() {
        let schema = study().unwrap();
        let error = |text: &str| StudyFile::parse("study", text).unwrap_err().to_string();
        assert_keys(&schema, &error("x = 1"));
        for (table, place) in [
            ("Intensity", "intensity = { x = 1 }"),
            ("Levels", "levels = { x = 1 }"),
            ("Records", "records = { x = 1 }"),
            ("Synthetic", "records = { synthetic = { x = 1 } }"),
            ("Report", "report = { x = 1 }"),
            ("Wall", "walls = [{ x = 1 }]"),
            ("Class", "classes = [{ x = 1 }]"),
        ] {
            assert_keys(&schema["$defs"][table], &error(place));
        }
        let rest = "levels = { method = \"grid\", values = [1] }\nrecords = { synthetic = { count = 1 } }\n";
        let model = error(&format!("models = [{{ x = 1 }}]\n{rest}walls = []"));
        let mut known: Vec<_> = model.rsplit("holds ").next().unwrap().split(", ").collect();
        known.sort_unstable();
        assert_eq!(listed(&schema["$defs"]["Model"]), known, "{model}");
        for name in schema["$defs"]["ModelName"]["enum"].as_array().unwrap() {
            StudyFile::parse("study", &format!("models = [{name}]\n{rest}walls = []")).unwrap();
        }
        // a table of a wall takes what its schema lists and refuses the key of another table
        let walls = schema["$defs"]["Wall"]["properties"].as_object().unwrap();
        for (group, table) in walls.iter().filter(|(_, table)| table["properties"].is_object()) {
            let wall = |key: &str, value: &Value| {
                let wall =
                    format!("models = []\n{rest}[[walls]]\nname = \"a\"\n[walls.{group}]\n{key} = {value}");
                StudyFile::parse("study", &wall)
            };
            for (key, value) in table["properties"].as_object().unwrap() {
                let default = &value["default"];
                assert!(default.is_null() || wall(key, default).is_ok(), "{group}.{key}");
            }
            assert!(wall("xi", &json!(0.1)).is_err() && wall("impact", &json!("none")).is_err());
        }
    }

    #[test]
    fn the_schema_has_the_keys_of_building_files() {
        let schema = building().unwrap();
        let error = |text: &str| format!("{:#}", Building::parse("b.toml".as_ref(), text).unwrap_err());
        let parts = &schema["properties"];
        assert_keys(&schema, &error("x = 1"));
        assert_keys(&parts["wall"]["items"], &error("[[wall]]\nx = 1"));
        let floor = error("[[floor]]\nname = \"a\"\nx = 1");
        let mut known: Vec<_> = floor.rsplit("keys are ").next().unwrap().split(", ").collect();
        known.sort_unstable();
        assert_eq!(listed(&parts["floor"]["items"]), known);
    }

    /// The documents explain every key of studies and buildings.
    #[test]
    fn documents_name_every_key() {
        let read = |name: &str| {
            std::fs::read_to_string(format!("{}/../../docs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
        };
        let (study, building) = (study().unwrap(), building().unwrap());
        let tables =
            study["$defs"].as_object().unwrap().values().filter(|table| table["properties"].is_object());
        let of_study = [&study].into_iter().chain(tables);
        let parts = ["floor", "wall"].map(|part| &building["properties"][part]["items"]);
        let of_building = [&building].into_iter().chain(parts);
        for (name, objects) in
            [("model.md", of_study.collect::<Vec<_>>()), ("coupling.md", of_building.collect())]
        {
            let text = read(name);
            for key in objects.into_iter().flat_map(listed) {
                assert!(text.contains(&format!("`{key}`")), "docs/{name} has no `{key}`");
            }
        }
    }
}
