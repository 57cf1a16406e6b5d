//! The page of documentation of a unit that has some of the variables.

/// Returns `page` without the rows and list items that are about a variable that the unit does not have, and
/// without the tables that this leaves empty. A row is about the variable that its first `<code>` names.
pub(crate) fn without(page: &str, is_gone: impl Fn(&str) -> bool) -> String {
    let is_about = |item: &str| {
        let name = item.split_once("<code>").and_then(|(_, rest)| rest.split_once("</code>"));
        name.is_some_and(|(name, _)| is_gone(name))
    };
    let rows = retain(page, "<tr>", "</tr>\n", |row| !is_about(row));
    let items = retain(&rows, "<li>", "</li>\n", |item| !is_about(item));
    retain(&items, "<div class=\"wide\">", "</div>\n", |table| table.contains("<td>"))
}

/// Keeps the elements from `start` to `end` that are wanted, and all text between; leading blanks go with an
/// element.
fn retain(text: &str, start: &str, end: &str, is_wanted: impl Fn(&str) -> bool) -> String {
    let mut kept = String::new();
    let mut rest = text;
    while let Some((before, from)) = rest.split_once(start) {
        let (element, after) = from.split_once(end).unwrap_or((from, ""));
        if is_wanted(element) {
            kept.extend([before, start, element, end]);
        } else {
            kept.push_str(before.trim_end_matches(' '));
        }
        rest = after;
    }
    kept + rest
}
