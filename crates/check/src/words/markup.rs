//! Tables and lists as markup.

use std::fmt::Write;

use ::report::escaped;
use ::report::table::{Cell, Column, Table};

use super::formulas;
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

/// A paragraph of the user.
pub(crate) fn as_paragraph(text: &str) -> String {
    format!("<p>{}</p>\n", as_written(text))
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

/// A table whose rows become cards on a narrow screen, each cell with its heading; with a class for each row.
pub(crate) fn cards(heads: &[String], rows: &[(&str, Vec<String>)]) -> String {
    let mut text =
        format!("<table class=\"cards\">\n<thead><tr><th>{}</th></tr></thead>\n", heads.join("</th><th>"));
    for (class, cells) in rows {
        let _ = write!(text, "<tr class=\"{class}\">");
        for (head, cell) in heads.iter().zip(cells) {
            let _ = write!(text, "<td><span class=\"head\">{head}</span><span>{cell}</span></td>");
        }
        text += "</tr>\n";
    }
    text + "</table>\n"
}

/// The columns of a table that people see as cards, with formulas; but for the columns of some headings.
pub(crate) fn table_as_cards(table: &Table, class: impl Fn(usize) -> &'static str, without: &str) -> String {
    let shown = table.columns.iter().enumerate();
    let shown = shown.filter(|(_, column)| !column.heading.is_empty() && column.heading != without);
    let shown: Vec<_> = shown.collect();
    let heads: Vec<_> =
        shown.iter().map(|(_, column)| formulas::markup(&column.heading.replace('\n', " "))).collect();
    let cell = |row: &[Cell<'_>], at: usize, column: &Column| {
        let words = column.words(&row[at]);
        if column.is_of_user { as_written(&words) } else { formulas::markup(&words) }
    };
    let row = |(index, row): (usize, &Vec<Cell<'static>>)| {
        (class(index), shown.iter().map(|(at, column)| cell(row, *at, column)).collect())
    };
    let rows: Vec<(&str, Vec<String>)> = table.rows.iter().enumerate().map(row).collect();
    cards(&heads, &rows)
}

/// Numbers of a line with equal digits: as many significant ones as the others, or as many decimals where
/// none has four.
pub(crate) fn aligned(mut cells: Vec<String>) -> Vec<String> {
    let is_number =
        |cell: &String| cell.chars().all(|letter| letter.is_ascii_digit() || ",.−-".contains(letter));
    let numbers = || cells.iter().filter(|cell| *cell != "–");
    if !numbers().all(is_number) {
        return cells;
    }
    let decimals = |cell: &str| cell.find([',', '.']).map_or(0, |at| cell.len() - at - 1);
    let significant = |cell: &str| {
        let digits: String = cell.chars().filter(char::is_ascii_digit).collect();
        digits.trim_start_matches('0').len()
    };
    let is_rounded = numbers().any(|cell| significant(cell) >= 4 && decimals(cell) > 0);
    let most = numbers().map(|cell| decimals(cell)).max().unwrap_or(0);
    let mark = if cells.iter().any(|cell| cell.contains(',')) { ',' } else { '.' };
    for cell in cells.iter_mut().filter(|cell| *cell != "–") {
        while if is_rounded { significant(cell) < 4 && decimals(cell) < most } else { decimals(cell) < most }
        {
            if !cell.contains(mark) {
                cell.push(mark);
            }
            cell.push('0');
        }
    }
    cells
}

/// Headings of a table as markup.
pub(crate) fn heads<const N: usize>(heads: [Sentence; N], language: Language) -> [String; N] {
    heads.map(|head| head.markup(language))
}
