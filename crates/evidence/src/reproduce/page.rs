//! The page of `wall reproduce`: tables and figures beside the printed numbers.

use std::fmt::Write;

use report::plot::Plot;
use report::{escaped, template};

use super::collapse::Collapses;
use super::{Cell, Figure, Reproduction, Table, Value};

/// Words for a page without records.
const MISSING: &str = "<p>Figure 15 needs records: <code>wall reproduce --records FOLDER</code> adds it.</p>";

/// Writes the page; `collapses` are Figure 15, which needs records.
pub fn page(reproduction: &Reproduction, collapses: Option<&Collapses>) -> String {
    let tables: String = reproduction.tables.iter().map(table).collect();
    let drawn = || reproduction.figures.iter().chain(collapses.map(|collapses| &collapses.figure));
    let mut figures: String = drawn().map(figure).collect();
    figures.extend(collapses.map(|collapses| table(&collapses.table)));
    let [agree, all] =
        reproduction.tables.iter().map(Table::counts).fold([0, 0], |a, b| [a[0] + b[0], a[1] + b[1]]);
    let mut links = String::new();
    for figure in drawn() {
        let _ = write!(links, "<a href=\"#figure-{0}\">{0}</a> ", figure.number);
    }
    template::page(
        include_str!("page.html"),
        &[
            ("title", "Modelling rocking response via equivalent viscous damping, reproduced"),
            ("agree", &agree.to_string()),
            ("all", &all.to_string()),
            ("links", &links),
            ("missing", if collapses.is_some() { "" } else { MISSING }),
            ("tables", &tables),
            ("figures", &figures),
        ],
    )
}

fn notes(notes: &[String]) -> String {
    let mut text = String::new();
    for note in notes {
        let _ = writeln!(text, "<p>{}</p>", escaped(note));
    }
    text
}

fn table(table: &Table) -> String {
    let mut text = format!(
        "<section><h2>{}: {}</h2>\n{}<div class=\"scroll\"><table><tr>",
        escaped(table.name),
        escaped(table.title),
        notes(&table.notes)
    );
    for column in &table.columns {
        let _ = write!(text, "<th>{}</th>", escaped(column));
    }
    text.push_str("</tr>\n");
    for row in &table.rows {
        text.push_str("<tr>");
        text.extend(row.iter().map(cell));
        text.push_str("</tr>\n");
    }
    text + "</table></div></section>\n"
}

fn cell(cell: &Cell) -> String {
    match cell {
        Cell::Text(words) => format!("<td>{}</td>", escaped(words)),
        Cell::Value(value) => {
            let Value { computed, printed, decimals } = *value;
            let class = if value.agrees() { "number" } else { "number off" };
            let finer = decimals + 1;
            let deviation = shown(computed - printed, finer);
            let printed = shown(printed, decimals);
            format!(
                "<td class=\"{class}\"><b>{printed:.decimals$}</b> {computed:.finer$}<br>\
                 <i>{deviation:+.finer$}</i></td>"
            )
        }
    }
}

/// Formats a number; one that shows as zero has no minus sign.
fn shown(value: f64, decimals: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a few decimals")]
    let half = 0.5 * 10.0_f64.powf(-(decimals as f64));
    if value.abs() < half { 0.0 } else { value }
}

fn figure(figure: &Figure) -> String {
    let charts: String = figure.charts.iter().map(Plot::figure).collect();
    format!(
        "<section id=\"figure-{0}\"><h2>Figure {0}: {1}</h2>\n{2}<div class=\"figures{3}\">\n{charts}</div>\
         </section>\n",
        figure.number,
        escaped(figure.title),
        notes(&figure.notes),
        // two or four panels are laid out in rows of two
        if matches!(figure.charts.len(), 2 | 4) { " two" } else { "" }
    )
}
