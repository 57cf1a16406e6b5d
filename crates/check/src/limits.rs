//! The limits of numbers in a table, as its schema states them.

use rocking_wall::scene::{Described, Schema};
use toml::Value;

/// Finds the first number of a table that is outside the limits of the keys of `T`: the keys that lead to it,
/// and what it must be.
pub(crate) fn fault<T: Described>(table: &Value) -> Option<(Vec<String>, String)> {
    let mut tables = Schema::new();
    let schema = T::describe("", &mut tables);
    in_value(&schema.into(), &tables, table, Vec::new())
}

/// The number of a value of TOML.
fn number(value: &Value) -> Option<f64> {
    #[allow(clippy::cast_precision_loss, reason = "limits are small numbers")]
    value.as_float().or(value.as_integer().map(|whole| whole as f64))
}

fn in_value(
    schema: &Value,
    tables: &Schema,
    value: &Value,
    keys: Vec<String>,
) -> Option<(Vec<String>, String)> {
    let name = schema.get("$ref").and_then(|path| path.as_str()?.rsplit('/').next());
    let schema = name.and_then(|name| tables.get(name)).unwrap_or(schema);
    match value {
        Value::Table(table) => table.iter().find_map(|(key, value)| {
            let keys = [&keys[..], std::slice::from_ref(key)].concat();
            in_value(schema.get("properties")?.get(key)?, tables, value, keys)
        }),
        Value::Array(list) => {
            list.iter().find_map(|item| in_value(schema.get("items")?, tables, item, keys.clone()))
        }
        _ => {
            let number = number(value)?;
            let forms = schema.get("anyOf").and_then(Value::as_array).into_iter().flatten();
            let wrong = [schema].into_iter().chain(forms).find_map(|form| outside(form, number))?;
            let about = schema.get("description")?.as_str()?.trim_end_matches('.');
            let message = format!("{} = {number} must be {wrong}: {about}", keys.join("."));
            Some((keys, message))
        }
    }
}

/// What a number must be that is outside the limits of a schema.
fn outside(schema: &Value, given: f64) -> Option<String> {
    if !given.is_finite() {
        return Some("finite".to_owned());
    }
    let words = [("exclusiveMinimum", "above"), ("minimum", "at least"), ("maximum", "at most")];
    let stated = words.into_iter().filter_map(|(word, said)| {
        let limit = number(schema.get(word)?)?;
        let holds = match word {
            "exclusiveMinimum" => given > limit,
            "minimum" => given >= limit,
            _ => given <= limit,
        };
        Some((format!("{said} {limit}"), holds))
    });
    let (said, holds): (Vec<String>, Vec<bool>) = stated.unzip();
    holds.contains(&false).then(|| said.join(" and "))
}
