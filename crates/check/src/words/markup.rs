//! Tables and lists as markup.

use std::fmt::Write;

use ::report::escaped;

use super::names::Sides;
use super::{Language, Sentence, above, say, side};

/// A list of texts.
pub(crate) fn list(texts: &[Sentence], language: Language) -> String {
    let items = texts.iter().map(|text| ["<li>", &text.markup(language), "</li>\n"].concat());
    if texts.is_empty() { String::new() } else { format!("<ul>\n{}</ul>\n", items.collect::<String>()) }
}

/// The headline of a side, above a level where levels are stated \[m\].
pub(crate) fn side_head(of: Sides, level: Option<f64>, language: Language) -> String {
    let name = match of {
        Sides::Alike => say!("Both sides", "Entrambi i versi"),
        Sides::One(_) => say!("Side {name}", "Verso {name}", name = side(of)),
    };
    format!("<h3>{}</h3>\n", above(name, level).markup(language))
}

/// What the user writes stands as it is in every language.
pub(crate) fn as_written(text: &str) -> String {
    format!("<span translate=\"no\">{}</span>", escaped(text))
}

/// A paragraph.
pub(crate) fn paragraph(text: &Sentence, language: Language) -> String {
    format!("<p>{}</p>\n", text.markup(language))
}

/// A table of markup; without heads if there are none.
pub(crate) fn table<const N: usize>(heads: &[String], rows: &[[String; N]]) -> String {
    let mut text = [::report::SCROLLS, "<table>\n"].concat();
    if !heads.is_empty() {
        let _ = writeln!(text, "<thead><tr><th>{}</th></tr></thead>", heads.join("</th><th>"));
    }
    for row in rows {
        let _ = writeln!(text, "<tr><td>{}</td></tr>", row.join("</td><td>"));
    }
    text + "</table></div>\n"
}

/// Headings of a table as markup.
pub(crate) fn heads<const N: usize>(heads: [Sentence; N], language: Language) -> [String; N] {
    heads.map(|head| head.markup(language))
}
