//! The verification manual with its results: on a terminal, as JSON, as Markdown, as a page.

use std::fmt::Write;

use report::page::Page;
use report::table::{Digits, Table};
use report::{escaped, wrapped};
use serde_json::{Value, json};

use super::Formula;
use crate::Comparison;
use crate::comparison::{Headings, STYLE, html, table};

const HEADINGS: Headings = ["case", "quantity", "unit", "reference", "computed", "error", "bound", "result"];
/// Most characters of a line of Markdown.
const WIDTH: usize = 110;

/// Returns the table of numbers.
fn numbers<'a>(comparisons: impl IntoIterator<Item = &'a Comparison>, headings: Headings) -> Table {
    table(comparisons, headings, Digits::Exponent(9))
}

/// Returns the table of all numbers, in the order of the formulas.
pub fn all(formulas: &[Formula]) -> Table {
    numbers(formulas.iter().flat_map(|formula| &formula.comparisons), HEADINGS)
}

/// Counts the numbers that pass and those that fail.
pub fn counts(formulas: &[Formula]) -> [usize; 2] {
    let all = || formulas.iter().flat_map(|formula| &formula.comparisons);
    let passed = all().filter(|comparison| comparison.passes()).count();
    [passed, all().count() - passed]
}

fn counted(formulas: &[Formula]) -> String {
    let [passed, failed] = counts(formulas);
    format!("{passed} PASS, {failed} FAIL: numbers of {} formulas", formulas.len())
}

/// Returns the numbers of each formula under its title, and how many pass.
pub fn text(formulas: &[Formula]) -> String {
    let table = all(formulas).text();
    let mut lines = table.lines();
    let mut text = lines.next().map_or_else(String::new, |head| format!("  {head}\n"));
    for Formula { title, comparisons, .. } in formulas {
        let _ = writeln!(text, "{title}");
        for line in lines.by_ref().take(comparisons.len()) {
            let _ = writeln!(text, "  {line}");
        }
        text.push('\n');
    }
    text + &counted(formulas) + "\n"
}

/// Returns the formulas with their numbers as JSON.
pub fn json(subject: &str, formulas: &[Formula]) -> Value {
    let [passed, failed] = counts(formulas);
    let formula = |formula: &Formula| {
        json!({
            "title": formula.title,
            "section": formula.section,
            "statement": formula.statement,
            "reference": formula.reference,
            "why": formula.why,
            "checks": numbers(&formula.comparisons, HEADINGS).json(),
        })
    };
    let formulas: Vec<_> = formulas.iter().map(formula).collect();
    json!({ "subject": subject, "passed": passed, "failed": failed, "formulas": formulas })
}

/// Returns formulas, references and bounds as Markdown, without what was computed.
pub fn markdown(formulas: &[Formula]) -> String {
    let headings = ["case", "quantity", "unit", "reference", "", "", "bound", ""];
    let mut text = String::new();
    for (index, Formula { title, section, statement, reference, why, comparisons, .. }) in
        formulas.iter().enumerate()
    {
        let _ = writeln!(text, "### {}. {title}\n", index + 1);
        let origin = format!("[Model](model.md#{section}). Reference: {reference}. Bound: {why}.");
        for paragraph in [format!("{statement}."), origin] {
            let _ = writeln!(text, "{}\n", wrapped(&paragraph, WIDTH).join("\n"));
        }
        let _ = writeln!(text, "{}", numbers(comparisons, headings).markdown());
    }
    text
}

/// Writes the manual with the results of `subject`.
pub fn page(subject: &str, formulas: &[Formula]) -> String {
    let mut page = Page::new("Verification manual").styled(STYLE).text(&format!(
        "<p>{}: {}.</p>\n<p>Each number that is computed stands beside a reference that does not come from \
         this program. The error is relative to the reference or, where that is near zero, to the size of \
         its terms.</p>",
        escaped(subject),
        counted(formulas)
    ));
    for (index, Formula { title, statement, reference, why, comparisons, .. }) in formulas.iter().enumerate()
    {
        let [statement, reference, why] = [statement, reference, why].map(|text| escaped(text));
        let words = format!("<p>{statement}.</p>\n<p>Reference: {reference}. Bound: {why}.</p>\n");
        let table = html(&numbers(comparisons, HEADINGS));
        page = page.section(&format!("{}. {title}", index + 1), &(words + &table));
    }
    page.html()
}
