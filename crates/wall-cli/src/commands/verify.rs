//! `wall verify`: every formula against a reference of its own.

mod importer;

use std::fmt::Write;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use evidence::verification::page::{number, page, short};
use evidence::verification::{Check, Counts, Formula, library, verify, verify_scenes};
use serde_json::{Value, json};

use crate::output::{self, Console};
use importer::Fmu;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Verify the library of this FMU (FMI 2.0), whose code runs, instead of this program
    #[arg(long, value_name = "FILE")]
    fmu: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Write the verification manual with the results as a page
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the formulas, references and bounds of the manual as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
}

/// Exit code where a number is outside its bound.
const FAILED: u8 = 1;

pub(crate) fn run(console: &Console<'_>, arguments: &Arguments) -> Result<u8> {
    console.check_distinct(&arguments.fmu, arguments.html.iter().chain(&arguments.markdown))?;
    let (subject, formulas) = match &arguments.fmu {
        Some(path) => {
            let fmu = Fmu::open(path)?;
            let values = |scene: &_, quantities: &_| fmu.values(scene, quantities);
            (path.display().to_string(), verify_scenes(values)?)
        }
        None => (format!("wall {}", env!("CARGO_PKG_VERSION")), verify(library)?),
    };
    let counts = Counts::of(&formulas);
    console.save(arguments.html.as_ref(), || page(&subject, &formulas, &counts))?;
    console.save(arguments.markdown.as_ref(), || markdown(&formulas))?;
    let text = if arguments.json {
        serde_json::to_string_pretty(&json(&subject, &formulas, &counts))? + "\n"
    } else {
        let written = output::written("written ", arguments.html.iter().chain(&arguments.markdown));
        format!("{subject}\n\n{}{}\n{written}", table(&formulas), counts.words())
    };
    console.print(&text)?;
    Ok(if counts.failed == 0 { 0 } else { FAILED })
}

fn table(formulas: &[Formula]) -> String {
    let mut text = format!(
        "{:<28} {:<36} {:<10} {:>16} {:>16} {:>6} {:>6}\n",
        "case", "quantity", "unit", "reference", "computed", "error", "bound"
    );
    for formula in formulas {
        let _ = writeln!(text, "{}", formula.title);
        for check in &formula.checks {
            let Check { case, quantity, unit, reference, computed, bound, .. } = check;
            let _ = writeln!(
                text,
                "  {case:<26} {quantity:<36} {unit:<10} {:>16} {:>16} {:>6} {:>6}  {}",
                number(Some(*reference)),
                number(*computed),
                short(check.error()),
                short(Some(*bound)),
                check.word()
            );
        }
        text.push('\n');
    }
    text
}

fn json(subject: &str, formulas: &[Formula], counts: &Counts) -> Value {
    let check = |check: &Check| {
        json!({
            "case": check.case,
            "quantity": check.quantity,
            "unit": check.unit,
            "reference": check.reference,
            "computed": check.computed,
            "scale": check.scale,
            "error": check.error(),
            "bound": check.bound,
            "result": check.word(),
        })
    };
    let formula = |formula: &Formula| {
        json!({
            "title": formula.title,
            "section": formula.section,
            "statement": formula.statement,
            "reference": formula.reference,
            "why": formula.why,
            "checks": formula.checks.iter().map(check).collect::<Vec<_>>(),
        })
    };
    json!({
        "subject": subject,
        "passed": counts.passed,
        "failed": counts.failed,
        "missing": counts.missing,
        "formulas": formulas.iter().map(formula).collect::<Vec<_>>(),
    })
}

/// Most characters of a line of Markdown.
const WIDTH: usize = 110;

/// Formulas, references and bounds, which do not depend on what is verified.
fn markdown(formulas: &[Formula]) -> String {
    let mut text = String::new();
    for (index, Formula { title, section, statement, reference, why, checks }) in formulas.iter().enumerate()
    {
        let paragraphs = [
            format!("{statement}."),
            format!("[Model](model.md#{section}). Reference: {reference}. Bound: {why}."),
        ];
        let paragraphs = paragraphs.map(|paragraph| output::wrapped(&paragraph, WIDTH).join("\n"));
        let _ = writeln!(text, "### {}. {title}\n\n{}\n", index + 1, paragraphs.join("\n\n"));
        text.push_str("| case | quantity | unit | reference | bound |\n|---|---|---|---|---|\n");
        for Check { case, quantity, unit, reference, bound, .. } in checks {
            let reference = number(Some(*reference));
            let _ = writeln!(text, "| {case} | {quantity} | {unit} | {reference} | {bound:.0e} |");
        }
        text.push('\n');
    }
    text
}
