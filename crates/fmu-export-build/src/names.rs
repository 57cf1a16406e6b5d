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

/// `text` as rustdoc's Markdown: brackets as they are.
pub(crate) fn markdown(text: &str) -> String {
    text.replace('[', "\\[").replace(']', "\\]").replace('<', "\\<")
}

/// What a generated enum begins with. Its items are described in the words of the model description.
pub(crate) const DERIVE: &str = "#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]\n\
    #[allow(clippy::doc_markdown, reason = \"the words of the model description\")]\n";
