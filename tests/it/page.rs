//! The variables of a unit, and the page of documentation inside its FMU.

use fmu_export::{Kind, Model, Variable, VariableId};

/// Every variable, in the order of the description: value references count from 1 in it.
pub(crate) fn variables<M: Model>() -> Vec<&'static Variable> {
    fn of<V: VariableId>() -> impl Iterator<Item = &'static Variable> {
        V::ALL.iter().map(|variable| variable.variable())
    }
    let mut all: Vec<_> =
        of::<M::Real>().chain(of::<M::Integer>()).chain(of::<M::Boolean>()).chain(of::<M::Text>()).collect();
    all.sort_by_key(|variable| variable.reference);
    all
}

/// Returns the one row of a variable behind its name, which has its default.
pub(crate) fn row<'a>(page: &'a str, variable: &Variable) -> &'a str {
    let name = variable.name;
    let head = format!("<tr><td><code>{name}</code></td>");
    assert_eq!(page.matches(&head).count(), 1, "{name} has one row in documentation/index.html");
    let row = page.split(&head).nth(1).and_then(|rest| rest.split("</tr>").next()).unwrap_or_default();
    // The columns are unit, default and meaning; without a default there is no such column.
    let cells: Vec<_> = row.split("<td>").skip(1).map(|cell| cell.trim_end_matches("</td>")).collect();
    let default = match &variable.kind {
        Kind::Real { start, .. } => start.map(|start| cells[1].parse() == Ok(start)),
        Kind::Enumeration { start, items } => start.map(|start| {
            items.iter().any(|item| item.value == start && cells[1] == format!("<code>{}</code>", item.name))
        }),
        Kind::Boolean { start } => start.map(|start| cells[1] == start.to_string()),
        Kind::Integer { start, .. } => start.map(|start| cells[1] == start.to_string()),
        Kind::String { start } => start.map(|start| cells[1] == start),
    };
    assert_ne!(default, Some(false), "{name}: the page's default {:?} is not the description's", cells[1]);
    assert_eq!(cells.len(), if default.is_some() { 3 } else { 2 }, "{name}: {row}");
    row
}

/// Checks that a page shows the same without a network.
pub(crate) fn assert_needs_nothing_from_outside(page: &str) {
    for text in ["http://", "https://", "<script", "<img", "<link", "url("] {
        assert!(!page.contains(text), "{text}");
    }
}
