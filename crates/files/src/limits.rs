//! The limits of the values of a file, as the schema of its tables states them.

use std::any::TypeId;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

use serde::Deserialize;
use toml::de::{DeValue, ValueDeserializer};
use toml::{Spanned, Value};

use crate::names::unknown_key;
use crate::place::Place;
use crate::schema::{Described, Schema, Tables};
use crate::syntax::{number, parse_document};

/// What is wrong with a value of a file.
#[derive(Debug)]
pub struct Fault {
    /// The keys that lead to the value, from the table on that is read.
    pub keys: Vec<String>,
    /// Where it stands.
    pub span: Range<usize>,
    /// The key, the value, and what it must be.
    pub message: String,
}

/// Words of a schema that limit a number, or the length of a list, and how to say them.
const OF_NUMBER: [(&str, &str); 4] = [
    ("exclusiveMinimum", "above"),
    ("minimum", "at least"),
    ("maximum", "at most"),
    ("exclusiveMaximum", "below"),
];
const OF_LIST: [(&str, &str); 2] = [("minItems", "at least"), ("maxItems", "at most")];

/// Checks a number or a list of numbers, given by itself, against the limits of a key of `T`.
///
/// # Errors
/// The key, the value and its limits; or that `T` does not hold the key.
///
/// ```
/// files::tables! {
///     /// A load.
///     struct LoadTable {
///         /// Force.
///         #[key(minimum = 0)]
///         force: f64,
///     }
/// }
/// let error = files::check_value::<LoadTable>("force", -1.0).unwrap_err();
/// assert_eq!(error, "force = -1 must be at least 0: Force");
/// ```
pub fn check_value<T: Described>(key: &str, value: impl std::fmt::Debug) -> Result<(), String> {
    let (schema, tables) = schema_of::<T>();
    let keys = declared(schema, tables).unwrap_or(schema).get("properties").and_then(Value::as_table);
    if keys.is_none_or(|keys| !keys.contains_key(key)) {
        let known: Vec<_> = keys.into_iter().flat_map(Schema::keys).map(String::as_str).collect();
        return Err(unknown_key(key, "", &known, &tables.groups));
    }
    // TOML writes NaN in small letters
    let text = format!("{key} = {}", format!("{value:?}").to_ascii_lowercase());
    let table = parse_document(&Place::new(key, &text)).map_err(|error| error.reason)?;
    let table = Spanned::new(0..text.len(), DeValue::Table(table));
    fault::<T>(&table).map_or(Ok(()), |fault| Err(fault.message))
}

/// Finds the first value of a table that is outside the limits of the keys of `T`.
pub(crate) fn fault<T: Described>(table: &Spanned<DeValue<'_>>) -> Option<Fault> {
    let (schema, tables) = schema_of::<T>();
    in_value(schema, "", tables, table, &[])
}

/// Returns the schema of `T` and the tables that it refers to, which are made once: many walls are read.
pub(crate) fn schema_of<T: Described>() -> &'static (Value, Tables) {
    made(TypeId::of::<T>(), T::describe)
}

fn made(of: TypeId, describe: fn(&str, &mut Tables) -> Schema) -> &'static (Value, Tables) {
    static MADE: Mutex<Option<HashMap<TypeId, &'static (Value, Tables)>>> = Mutex::new(None);
    // a schema that could not be made is not in the map
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    made.get_or_insert_default().entry(of).or_insert_with(|| {
        let mut tables = Tables::default();
        let schema = describe("", &mut tables).into();
        Box::leak(Box::new((schema, tables)))
    })
}

/// Returns the table that a schema refers to.
fn declared<'a>(schema: &Value, tables: &'a Tables) -> Option<&'a Value> {
    tables.schemas.get(schema.get("$ref")?.as_str()?.rsplit('/').next()?)
}

/// Returns the only one of a schema's forms that a table or a list can have, or else the schema.
fn form_of<'a>(schema: &'a Value, value: &DeValue<'_>) -> &'a Value {
    let kind = match value {
        DeValue::Table(_) => "object",
        DeValue::Array(_) => "array",
        _ => return schema,
    };
    let forms = schema.get("anyOf").and_then(Value::as_array).into_iter().flatten();
    let mut own = forms.filter(|form| form.get("type").and_then(Value::as_str) == Some(kind));
    match (own.next(), own.next()) {
        (Some(form), None) => form,
        _ => schema,
    }
}

fn in_value(
    schema: &Value,
    about: &str,
    tables: &Tables,
    value: &Spanned<DeValue<'_>>,
    keys: &[String],
) -> Option<Fault> {
    let about = schema.get("description").and_then(Value::as_str).unwrap_or(about).trim_end_matches('.');
    let declared = declared(schema, tables);
    let schema = form_of(declared.unwrap_or(schema), value.get_ref());
    let fault = |said: String| {
        let message = format!("{} {said}: {about}", keys.join("."));
        Some(Fault { keys: keys.to_vec(), span: value.span(), message })
    };
    match value.get_ref() {
        DeValue::Table(table) => table.iter().find_map(|(key, value)| {
            let key = key.get_ref().as_ref();
            // who applies a group of parameters checks them by the model description, but not their
            // distributions, which are tables
            let is_parameter = || tables.groups.values().any(|names| names.contains(&key));
            if declared.is_none() && !matches!(value.get_ref(), DeValue::Table(_)) && is_parameter() {
                return None;
            }
            let keys = [keys, &[key.to_owned()]].concat();
            in_value(schema.get("properties")?.get(key)?, about, tables, value, &keys)
        }),
        DeValue::Array(list) => {
            #[allow(clippy::cast_precision_loss, reason = "no list has 2⁵³ items")]
            let limits = outside(schema, list.len() as f64, &OF_LIST);
            let items = |items| list.iter().find_map(|item| in_value(items, about, tables, item, keys));
            match limits {
                Some(limits) => {
                    let values = if limits.ends_with(" 1") { "value" } else { "values" };
                    fault(format!("needs {limits} {values}, found {}", list.len()))
                }
                None => schema.get("items").and_then(items),
            }
        }
        DeValue::Integer(_) | DeValue::Float(_) => {
            let number = f64::deserialize(ValueDeserializer::from(value.clone())).ok()?;
            let forms = schema.get("anyOf").and_then(Value::as_array).into_iter().flatten();
            let limits = [schema].into_iter().chain(forms).find_map(|form| outside(form, number, &OF_NUMBER));
            limits.and_then(|limits| fault(format!("= {} must be {limits}", shown(number))))
        }
        _ => None,
    }
}

/// What a number must be that is outside the limits of a schema.
fn outside(schema: &Value, given: f64, words: &[(&str, &str)]) -> Option<String> {
    let limits = || words.iter().filter_map(|(word, said)| Some((*word, *said, number(schema.get(word)?)?)));
    let holds = |(word, _, limit): (&str, &str, f64)| match word {
        "exclusiveMinimum" => given > limit,
        "exclusiveMaximum" => given < limit,
        "minimum" | "minItems" => given >= limit,
        _ => given <= limit,
    };
    if !limits().all(holds) {
        let said: Vec<_> = limits().map(|(_, said, limit)| format!("{said} {}", shown(limit))).collect();
        return Some(said.join(" and "));
    }
    (!given.is_finite()).then(|| "finite".to_owned())
}

/// Writes a number, one with many zeros with its power of ten.
fn shown(number: f64) -> String {
    let [plain, short] = [format!("{number}"), format!("{number:e}")];
    if short.len() + 2 < plain.len() { short } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_limits_may_be_of_any_size() {
        let schema: Value = toml::from_str::<toml::Table>("maximum = 5_000_000_000").unwrap().into();
        assert_eq!(outside(&schema, 5e9, &OF_NUMBER), None);
        assert_eq!(outside(&schema, 6e9, &OF_NUMBER).as_deref(), Some("at most 5e9"));
    }
}
