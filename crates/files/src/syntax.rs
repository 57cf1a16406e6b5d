//! Parses TOML, and says what is wrong with a text that is none.

use toml::de::DeTable;
use toml::{Spanned, Value};

use crate::error::FileError;
use crate::place::Place;

/// Parses a TOML text whose tables are read one by one.
///
/// # Errors
/// [`FileError`] where the text is not TOML.
pub(crate) fn parse_document<'a>(place: &Place<'a>) -> Result<DeTable<'a>, FileError> {
    DeTable::parse(place.text()).map(Spanned::into_inner).map_err(|error| {
        let span = error.span().unwrap_or(0..0);
        let text = place.text();
        let message = if error.message().starts_with("duplicate key") {
            let key = text[span.clone()].trim_matches(['"', '\'']);
            let line = text.lines().nth(place.line(span.clone()) - 1).unwrap_or_default().trim();
            let table = line.strip_prefix('[').map(|table| table.trim_matches(['[', ']']));
            let of_list = table.map(|table| format!(" (tables of a list have two brackets: [[{table}]])"));
            format!("{key} is given twice; leave one out{}", of_list.unwrap_or_default())
        } else {
            let line = text.lines().nth(place.line(span.clone()) - 1).unwrap_or_default();
            if error.message().starts_with("cannot extend") {
                let message = format!("`{}` adds to a value that is given above; leave one out", shown(line));
                return place.error(span, message);
            }
            if DeTable::parse(line).is_ok() {
                return place.error(span, OPEN);
            }
            format!("cannot read `{}`: {SYNTAX}", shown(line).replace('\r', "\\r"))
        };
        place.error(span, message)
    })
}

/// What a text that is not TOML may lack.
const SYNTAX: &str = "a line is key = value, [table] or # comment; a number has a decimal point and no unit, \
                      and digits on both sides of its point; a text stands in straight quotes, a path with \
                      /; lists and tables are closed";

/// What a text lacks whose reader stops at a line that is right by itself, or behind the last one.
const OPEN: &str = "a list, table or text above is not closed; close it with ], } or its quotes";

/// What is expected where a number stands.
pub const NUMBER: &str = "a number with a decimal point, without a unit and without quotes";

/// Shortens a text for a message.
pub(crate) fn shown(text: &str) -> String {
    text.trim().chars().take(60).collect()
}

/// Reads a number, whole or not.
pub fn number(value: &Value) -> Option<f64> {
    #[allow(clippy::cast_precision_loss, reason = "a whole number beyond 2⁵³ is beyond every limit too")]
    match value {
        Value::Float(number) => Some(*number),
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
}
