//! `wall schema`: the JSON schemas of scenes, studies and buildings.

use anyhow::Result;
use building::Building;
use clap::{Args, ValueEnum};
use files::{Schema, file_schema};
use scene::Document;
use study::document::StudyFile;

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
    console.print(&(serde_json::to_string_pretty(&schema(arguments.file))? + "\n"))
}

fn schema(file: File) -> Schema {
    let mut schema = match file {
        File::Scene => file_schema::<Document>("Scene of rocking-wall"),
        File::Study => StudyFile::schema(),
        File::Building => Building::schema(),
    };
    check::complete(&mut schema);
    if let File::Scene = file {
        schema["properties"]
            .as_table_mut()
            .map(|own| own.insert("report".into(), check::report_schema().into()));
    }
    schema
}

#[cfg(test)]
mod tests {
    use serde_json::Value as Json;
    use study::codes::NoCodes;
    use toml::Value;

    use super::*;

    /// A number or a text as JSON and TOML write them.
    fn in_json(value: &Value) -> Json {
        serde_json::to_value(value).unwrap()
    }

    /// The keys of a schema and its tables, without the parameters of walls.
    fn keys(schema: &Schema) -> impl Iterator<Item = &str> {
        let tables = schema["$defs"].as_table().unwrap().values().filter_map(Value::as_table);
        let lists =
            schema["properties"].as_table().unwrap().values().filter_map(|key| key.get("items")?.as_table());
        let all = tables
            .chain(lists.filter(|list| list.contains_key("properties")))
            .chain([schema])
            .map(|table| table["properties"].as_table().unwrap());
        all.flat_map(|properties| properties.keys().map(String::as_str))
    }

    /// The documents explain every key of studies and buildings.
    #[test]
    fn documents_name_every_key() {
        for (name, file) in [("model.md", File::Study), ("coupling.md", File::Building)] {
            let path = format!("{}/../../docs/{name}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(path).unwrap();
            let schema = schema(file);
            for key in keys(&schema) {
                assert!(text.contains(&format!("`{key}`")), "docs/{name} has no `{key}`");
            }
            for key in
                check::report_schema()["properties"].as_table().unwrap().keys().filter(|_| name == "model.md")
            {
                assert!(text.contains(&format!("`{key}`")), "docs/{name} has no `{key}` of [report]");
            }
        }
    }

    /// A wall of a study takes the defaults of its parameters, and refuses the keys of another table.
    #[test]
    fn readers_take_the_defaults_of_their_schema() {
        let schema = schema(File::Study);
        let rest =
            "levels = { method = \"grid\", values = [1] }\nmodels = [\"CR\"]\n[[walls]]\nname = \"a\"\n";
        let groups = schema["$defs"]["WallTable"]["properties"].as_table().unwrap();
        let mut count = 0;
        for (group, table) in groups.iter().filter(|(_, table)| table.get("properties").is_some()) {
            let read = |key: &str, value: Json| {
                StudyFile::parse("study", &format!("{rest}[walls.{group}]\n{key} = {value}"), &NoCodes)
            };
            for (key, parameter) in table["properties"].as_table().unwrap() {
                if let Some(default) = parameter.get("default") {
                    count += 1;
                    read(key, in_json(default)).unwrap_or_else(|error| panic!("{group}.{key}: {error}"));
                }
            }
            let of_models = [("damping_model", "none"), ("impact", "none")];
            assert!(of_models.into_iter().all(|(key, value)| read(key, value.into()).is_err()), "{group}");
        }
        assert!(count > 15, "{count}");
    }
}
