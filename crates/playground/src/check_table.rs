//! The table `[check]` of a scene file, from the fields of the page.

use std::fmt::Write;

use serde_json::Value;

use crate::request::Fields;

/// Returns the table `[check]` of the fields, one key in a line; nothing where no code is chosen.
pub(crate) fn table(fields: &Fields) -> String {
    let given = || fields.iter().filter(|(_, text)| !text.trim().is_empty());
    if !given().any(|(name, _)| name == "code") {
        return String::new();
    }
    given().fold("\n[check]\n".to_owned(), |mut table, (name, text)| {
        let _ = writeln!(table, "{} = {}", key(name), value(text.trim()));
        table
    })
}

/// The key of a field; one that the motion has too is told from it by its name.
pub(crate) fn key(field: &str) -> &str {
    field.strip_prefix("check.").unwrap_or(field)
}

/// A text of a field as a value of TOML: a number, true or false, a list, or a text.
fn value(text: &str) -> String {
    match text.parse::<f64>() {
        // a number of storeys is whole
        Ok(number) if number.fract() == 0.0 && number.abs() < 1e15 => format!("{number:.0}"),
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ if text == "true" || text == "false" => text.to_owned(),
        _ if serde_json::from_str::<Vec<Value>>(text).is_ok() => text.to_owned(),
        // a string of JSON is one of TOML
        _ => Value::from(text).to_string(),
    }
}
