//! Fields of CSV files.

/// Quotes a text where RFC 4180 asks for it.
pub fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

/// Writes a number with all its digits, or nothing.
pub fn optional(number: Option<f64>) -> String {
    number.map_or_else(String::new, |number| format!("{number:?}"))
}
