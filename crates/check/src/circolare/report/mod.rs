//! The report of a check by the code: what goes into a calculation file, in one page.

mod capacity;
mod drawing;
mod inputs;
mod limit_states;
mod markup;
mod readings;
mod runs;
mod site;
mod verdict;

use crate::circolare::{Demand, Outcome, Records, Side, SideVerdict, Statement, demands};
use crate::error::CheckError;
use ::report::{escaped, template};
use rocking_wall::scene::{SceneError, fingerprint};

use crate::code::{Document, Subject};
use rocking_wall::wall::Wall;

use inputs::Given;
use markup::{section, table};

/// What a report is about.
pub(super) struct Report<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) document: &'a Document<'a>,
    pub(super) statement: &'a Statement,
    pub(super) records: &'a Records,
    pub(super) verdict: &'a Outcome,
}

/// What the sections of a report share.
struct Case<'a> {
    report: &'a Report<'a>,
    wall: Wall,
    given: Given,
    /// Of SLD, SLV and SLC.
    demands: [Option<Demand>; 3],
}

impl Case<'_> {
    /// The sides that are shown, with their names.
    fn sides(&self) -> impl Iterator<Item = (&'static str, Side, &SideVerdict)> {
        let shown = self.report.verdict.sides.iter().take(if self.report.verdict.alike { 1 } else { 2 });
        shown.map(|(side, verdict)| {
            (if self.report.verdict.alike { "both sides" } else { side.name() }, side, verdict)
        })
    }

    /// The side that governs.
    fn governing(&self) -> Option<&SideVerdict> {
        let governs = self.report.verdict.governs.side;
        let sides = &self.report.verdict.sides;
        sides.iter().find(|(side, _)| *side == governs).or(sides.iter().next()).map(|(_, verdict)| verdict)
    }
}

/// Makes the page of a report.
///
/// # Errors
/// Of a demand, or of a record that cannot be read again.
pub(super) fn page(report: &Report<'_>) -> Result<String, CheckError> {
    let wall = Wall::new(report.subject.parameters)?;
    let floors = report.subject.floors;
    let case = Case {
        report,
        given: Given::new(report.document.file.1, report.document.set),
        demands: demands(&wall, floors, report.statement, report.records)?,
        wall,
    };
    let warnings: Vec<_> = report.verdict.warnings.iter().chain(&report.records.warnings).collect();
    let warnings = if warnings.is_empty() {
        "<p>None.</p>\n".to_owned()
    } else {
        let items: Vec<_> = warnings.iter().map(|text| format!("<li>{}</li>\n", escaped(text))).collect();
        format!("<ul>\n{}</ul>\n", items.concat())
    };
    let sections = [
        section("Verdict", &verdict::section(&case)),
        section("Statements of the engineer", &inputs::statements(&case)),
        section("The wall", &(drawing::figure(&case) + &inputs::wall(&case))),
        section("Site and building", &site::values(&case)),
        section("Spectra", &site::figures(&case)?),
        section("Capacity curve", &capacity::section(&case)?),
        limit_states::sections(&case),
        runs::section(&case),
        section("Readings of the code", &readings::section(&case)),
        section("Warnings", &warnings),
        section("Document", &document(report)?),
    ];
    let title = escaped(report.subject.title);
    let passed = if report.verdict.passed { "holds" } else { "fails" };
    let headline = verdict::headline(&report.verdict.headline());
    let date = report.document.date.map_or_else(String::new, escaped);
    let parts = [
        ("title", &*title),
        ("date", &date),
        ("passed", passed),
        ("headline", &headline),
        ("sections", &sections.concat()),
    ];
    Ok(template::page(include_str!("page.html"), &parts))
}

/// Program, version, date, and the fingerprints of what was read.
fn document(report: &Report<'_>) -> Result<String, CheckError> {
    let (name, text) = report.document.file;
    let scene = fingerprint(text.as_bytes());
    let mut files = vec![(name.to_owned(), scene)];
    for path in &report.records.files {
        let bytes = std::fs::read(path).map_err(|error| SceneError::File {
            file: path.display().to_string(),
            reason: format!("{error}; the file could be read earlier in this run"),
        })?;
        files.push((path.display().to_string(), fingerprint(&bytes)));
    }
    // names of files are left out: a copy elsewhere is the same input
    let inputs: Vec<&str> = files
        .iter()
        .map(|(_, hash)| hash.as_str())
        .chain(report.document.set.iter().map(String::as_str))
        .collect();
    let mut rows = vec![
        ["program".to_owned(), format!("wall (rocking-wall) {}", env!("CARGO_PKG_VERSION"))],
        ["date".to_owned(), report.document.date.map_or_else(|| "not given".to_owned(), escaped)],
        ["fingerprint of the inputs".to_owned(), fingerprint(inputs.join("\n").as_bytes())],
    ];
    rows.extend(files.into_iter().map(|(file, hash)| [escaped(&file), hash]));
    rows.extend(report.document.set.iter().map(|set| ["--set".to_owned(), escaped(set)]));
    Ok(table(&[], &rows)
        + "<p>Fingerprints are 128-bit FNV-1a hashes: equal inputs have equal ones. They do not protect \
           against deliberate changes.</p>\n")
}
