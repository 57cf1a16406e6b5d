//! `wall verify`: every formula against a reference of its own.

mod importer;

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use clap::Args;
use figures::{escaped, template};
use serde_json::{Value, json};
use study::verification::{Check, Formula, library, verify, verify_scenes};

use crate::output;
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

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode> {
    output::check_distinct(&arguments.fmu, arguments.html.iter().chain(&arguments.markdown))?;
    let (subject, formulas) = match &arguments.fmu {
        Some(path) => {
            let fmu = Fmu::open(path)?;
            let values = |scene: &_, quantities: &_| fmu.values(scene, quantities);
            (path.display().to_string(), verify_scenes(values)?)
        }
        None => (format!("wall {}", env!("CARGO_PKG_VERSION")), verify(library)?),
    };
    let counts = Counts::of(&formulas);
    output::save(arguments.html.as_ref(), || page(&subject, &formulas, &counts))?;
    output::save(arguments.markdown.as_ref(), || markdown(&formulas))?;
    let text = if arguments.json {
        serde_json::to_string_pretty(&json(&subject, &formulas, &counts))? + "\n"
    } else {
        let written = output::written("written ", arguments.html.iter().chain(&arguments.markdown));
        format!("{subject}\n\n{}{}\n{written}", table(&formulas), counts.words())
    };
    output::to_stdout(&text)?;
    Ok(if counts.failed == 0 { ExitCode::SUCCESS } else { ExitCode::from(FAILED) })
}

/// Numbers that pass, fail, or are missing.
struct Counts {
    passed: usize,
    failed: usize,
    missing: usize,
    formulas: usize,
}

impl Counts {
    fn of(formulas: &[Formula]) -> Self {
        let checks = || formulas.iter().flat_map(|formula| &formula.checks);
        let failed = checks().filter(|check| !check.passes()).count();
        let missing = checks().filter(|check| check.computed.is_none()).count();
        Self { passed: checks().count() - failed - missing, failed, missing, formulas: formulas.len() }
    }

    fn words(&self) -> String {
        let Self { passed, failed, missing, formulas } = self;
        let absent = if *missing > 0 { format!(", {missing} not in the FMU") } else { String::new() };
        format!("{passed} PASS, {failed} FAIL{absent}: numbers of {formulas} formulas")
    }
}

/// The result of a check in a word.
fn word(check: &Check) -> &'static str {
    match check.computed {
        None => "none",
        Some(_) if check.passes() => "PASS",
        Some(_) => "FAIL",
    }
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.9e}"))
}

fn short(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.0e}"))
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
                word(check)
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
            "result": word(check),
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

fn page(subject: &str, formulas: &[Formula], counts: &Counts) -> String {
    let mut sections = String::new();
    for (index, Formula { title, statement, reference, why, checks, .. }) in formulas.iter().enumerate() {
        let [title, statement, reference, why] = [title, statement, reference, why].map(|text| escaped(text));
        let _ = write!(
            sections,
            "<section><h2>{}. {title}</h2>\n<p>{statement}.</p>\n\
             <p>Reference: {reference}. Bound: {why}.</p>\n\
             <div class=\"scroll\"><table><tr><th>case</th><th>quantity</th><th>unit</th>\
             <th>reference</th><th>computed</th><th>error</th><th>bound</th><th>result</th></tr>\n",
            index + 1
        );
        for check in checks {
            let word = word(check);
            let _ = writeln!(
                sections,
                "<tr class=\"{word}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
                 <td>{}</td><td>{word}</td></tr>",
                escaped(&check.case),
                escaped(&check.quantity),
                check.unit,
                number(Some(check.reference)),
                number(check.computed),
                short(check.error()),
                short(Some(check.bound))
            );
        }
        sections.push_str("</table></div></section>\n");
    }
    let (subject, counts) = (escaped(subject), counts.words());
    let parts = [("title", "Verification manual"), ("subject", &*subject), ("counts", &counts)];
    let parts = [&parts[..], &[("sections", &sections)]].concat();
    template::page(include_str!("../pages/verify.html"), &parts)
}
