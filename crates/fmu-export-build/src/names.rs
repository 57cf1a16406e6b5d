//! Names and texts of the description as Rust has them.

use crate::variable::Variable;

/// First line of a generated module.
pub(crate) const HEAD: &str = "// Generated from the model description: change that instead.\n";

/// `name` as a Rust type or variant: `u_dot_start` becomes `UDotStart`. `None` if that is not a Rust name.
pub(crate) fn camel_case(name: &str) -> Option<String> {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    let camel: String = words
        .flat_map(|word| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters)
        })
        .collect();
    let starts_well = camel.starts_with(|c: char| c.is_ascii_alphabetic());
    (starts_well && camel != "Self").then_some(camel)
}

/// `name` as a Rust type or variant: the checks have refused what cannot be one.
pub(crate) fn camel(name: &str) -> String {
    camel_case(name).unwrap_or_default()
}

/// The enum of an enumeration variable.
pub(crate) fn type_name(variable: &Variable) -> String {
    camel(variable.declared_type.as_deref().unwrap_or_default())
}

/// The field of a parameter: its name, with `_` for what Rust names cannot contain, and never `__`, which
/// rustc warns of: `tank[1].count` becomes `tank_1_count`.
pub(crate) fn field(parameter: &Variable) -> String {
    let mut field = parameter.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
    while field.contains("__") {
        field = field.replace("__", "_");
    }
    field
}

/// `text` as rustdoc's Markdown: identifiers in backticks, brackets as they are.
pub(crate) fn markdown(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let core = word.trim_matches(|c: char| !c.is_alphanumeric() && c != '_');
        let letters: Vec<char> = core.chars().collect();
        let camel = letters.windows(2).any(|pair| pair[0].is_lowercase() && pair[1].is_uppercase());
        let numbered = core.contains(|c: char| c.is_ascii_digit()) && core.contains(char::is_alphabetic);
        let escaped = |text: &str| text.replace('[', "\\[").replace(']', "\\]").replace('<', "\\<");
        match word.find(core) {
            Some(at) if !core.is_empty() && (core.contains('_') || camel || numbered) => {
                let (before, after) = (escaped(&word[..at]), escaped(&word[at + core.len()..]));
                format!("{before}`{core}`{after}")
            }
            _ => escaped(word),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}
