//! The reproduction in words and as a page: tables and figures beside the printed numbers.

use std::fmt::Write;

use report::page::Page;
use report::plot::Plot;
use report::table::Digits;
use report::{escaped, wrapped};

use super::collapse::{Collapses, MEDIANS};
use super::{Figure, PaperTable, Reproduction};
use crate::comparison::{Headings, STYLE, html, table};

/// Words for a page without records.
const MISSING: &str =
    "<p>Figure 15 needs records: <code>wall verify paper --records FOLDER</code> adds it.</p>";
const HEADINGS: Headings = ["number", "of", "", "printed", "computed", "deviation", "", ""];

/// Says of each table how many numbers agree, and why; and which figures there are.
pub fn summary(reproduction: &Reproduction) -> String {
    let mut text = String::new();
    for table in &reproduction.tables {
        let (agree, all) = (table.agreeing(), table.rows.len());
        let _ = writeln!(text, "{:<24}{agree:>4} of {all:>3} numbers round to print", table.name);
        for line in table.notes.lines().flat_map(|note| wrapped(note, 96)) {
            let _ = writeln!(text, "    {line}");
        }
    }
    let numbers: Vec<String> = reproduction.figures.iter().map(|figure| figure.number.to_string()).collect();
    text + "Figures " + &numbers.join(", ") + "\n"
}

/// Writes the page; `collapses` are Figure 15, which needs records.
pub fn page(reproduction: &Reproduction, collapses: Option<&Collapses>) -> String {
    let Reproduction { tables, figures } = reproduction;
    let agree: usize = tables.iter().map(PaperTable::agreeing).sum();
    let all: usize = tables.iter().map(|table| table.rows.len()).sum();
    let figures = || figures.iter().chain(collapses.map(|collapses| &collapses.figure));
    let link = |figure: &Figure| format!("<a href=\"#figure-{0}\">{0}</a> ", figure.number);
    let mut page = Page::new("Modelling rocking response via equivalent viscous damping, reproduced")
        .styled(STYLE)
        .text(&format!(
            "<p>U. Tomassetti, F. Graziotti, L. Sorrentino and A. Penna. Every table and figure below was \
             computed when this page was written. Of {all} printed numbers, {agree} agree to the last \
             printed digit. The others are shaded, and the notes say why.</p>\n\
             <p>Computed numbers have one digit more than print.</p>\n\
             <nav>Figures {}</nav>",
            figures().map(link).collect::<String>()
        ))
        .text(if collapses.is_some() { "" } else { MISSING });
    for PaperTable { name, title, notes: words, rows } in tables {
        let table = html(&table(rows, HEADINGS, Digits::AtMost(6)));
        page = page.section(&format!("{name}: {title}"), &(notes(words) + &table));
    }
    for figure in figures() {
        page = page.text(&drawn(figure));
    }
    if let Some(Collapses { table, note, .. }) = collapses {
        page = page.section(MEDIANS, &(notes(note) + &table.html()));
    }
    page.html()
}

fn notes(notes: &str) -> String {
    notes.lines().map(|note| ["<p>", &escaped(note), "</p>\n"].concat()).collect()
}

/// Draws a figure with its notes.
pub(crate) fn drawn(Figure { number, title, notes: words, charts }: &Figure) -> String {
    // two or four panels are laid out in rows of two
    let width = if matches!(charts.len(), 2 | 4) { " style=\"max-width: 900px\"" } else { "" };
    let charts: String = charts.iter().map(Plot::figure).collect();
    format!(
        "<section id=\"figure-{number}\"><h2>Figure {number}: {}</h2>\n{}<div class=\"figures\"{width}>\n\
         {charts}</div></section>",
        escaped(title),
        notes(words)
    )
}
