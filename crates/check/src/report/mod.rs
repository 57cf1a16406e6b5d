//! The report of a check for a calculation file, in one page: what the reports of all codes share.

mod declared;
mod software;
mod walls;

use files::FileError;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use ::report::escaped;
use ::report::page::Page;
use scene::fingerprint;

use crate::code::verdict::{Section, Verdict};
use crate::error::CheckError;
use crate::file::site::Records;
use crate::words::{Language, Sentence, say};

use crate::sections::origin::Origin;
use crate::words::markup::{as_written, list, paragraph, table};
pub use walls::page_of_walls;

/// Makes the page of a report: the verdict, warnings, the sections of its code, and the fingerprints of what
/// was read.
///
/// # Errors
/// [`CheckError`] of a demand, or of a record that cannot be read again.
pub fn page(verdict: &Verdict<'_>, origin: &Origin<'_>) -> Result<String, CheckError> {
    let language = origin.report.language;
    let headline = format!("\n{}", head(verdict, None, language));
    let page = begun(origin.title, verdict, &headline, origin);
    let page = sections(sheet_head(page, verdict, origin), declared::sections(origin)?, language);
    let page = sections(page, verdict.details.site(language)?, language);
    let page = sections(page, verdict.details.sections(origin)?, language);
    let page = end(page, &verdict.details.symbols(language), &verdict.details.readings(), origin)?;
    Ok(finished(&page, origin.title, origin))
}

/// Begins a page: what it is, the verdict where it is one, and the data of the project.
fn begun(title: &str, verdict: &Verdict<'_>, headline: &str, origin: &Origin<'_>) -> Page {
    let page = Page::new(title).styled(include_str!("page.css"));
    let page = page.styled(&footer("", &origin.footer(None))).text(&(source(origin, verdict) + headline));
    let project = origin.report.project_data();
    if project.is_empty() {
        return page;
    }
    sections(page, vec![Section::new(say!("Project", "Commessa"), project)], origin.report.language)
}

/// Returns a page that says its language, with its title as it is written.
fn finished(page: &Page, title: &str, origin: &Origin<'_>) -> String {
    let [plain, written] = [escaped(title), as_written(title)].map(|title| format!("<h1>{title}</h1>"));
    let language = format!("<html lang=\"{}\"", origin.report.language.name());
    page.html().replacen(&plain, &written, 1).replacen("<html lang=\"en\"", &language, 1)
}

/// The name of a file; folders are the machine's.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

impl Records {
    /// Returns a text with the names of the files of the records, without their folders.
    fn without_folders(&self, text: &str) -> String {
        let named =
            |text: String, path: &PathBuf| text.replace(&path.display().to_string(), &file_name(path));
        self.files.iter().fold(text.to_owned(), named)
    }
}

/// Adds the verdict on a wall and its warnings.
fn sheet_head(page: Page, verdict: &Verdict<'_>, origin: &Origin<'_>) -> Page {
    let (language, records) = (origin.report.language, origin.records);
    // the lines of single runs, which are indented, have a table of their own
    let notes = verdict.notes.iter().filter(|note| !note.starts_with("  ")).cloned();
    let notes: Vec<_> = notes.collect();
    let rows = verdict.markup(language);
    let checks = format!("<div class=\"checks\">{rows}</div>{}", list(&notes, language));
    let mut warnings = list(&verdict.warnings, language);
    // what a reader of records says names files of the user
    let of_records =
        records.warnings.iter().map(|warning| escaped(&records.without_folders(warning.of(language))));
    let of_records: Vec<_> = of_records.map(|warning| format!("<li>{warning}</li>\n")).collect();
    if !of_records.is_empty() {
        warnings = format!("{warnings}<ul>\n{}</ul>\n", of_records.concat());
    }
    if warnings.is_empty() {
        warnings = paragraph(&say!("None.", "Nessuna."), language);
    }
    let mut parts = vec![Section::new(say!("Verdict", "Esito della verifica"), checks)];
    parts.extend(verdict.before.as_ref().map(|before| {
        let heading = say!("Before and after", "Stato di fatto e stato di progetto");
        Section::new(heading, before.markup(&verdict.rows, language))
    }));
    parts.push(Section::new(say!("Warnings", "Avvertenze"), warnings));
    sections(page, parts, language)
}

/// Adds sections.
fn sections(page: Page, sections: Vec<Section>, language: Language) -> Page {
    sections
        .into_iter()
        .fold(page, |page, Section { heading, markup }| page.section(heading.of(language), &markup))
}

/// Adds what ends a report: the readings of the code, what was read, and the box for stamp and signature. The
/// box does not stand alone on its page.
fn end(
    mut page: Page,
    symbols: &str,
    readings: &[Sentence],
    origin: &Origin<'_>,
) -> Result<Page, CheckError> {
    let language = origin.report.language;
    let mut parts = Vec::new();
    if !symbols.is_empty() {
        parts.push(Section::new(say!("Symbols", "Simboli"), symbols.to_owned()));
    }
    if !readings.is_empty() {
        let introduced = say! {
            "Where the code can be read in two ways, this check takes:",
            "Dove la norma si può leggere in due modi, la verifica assume:"
        };
        let markup = paragraph(&introduced, language) + &list(readings, language);
        parts.push(Section::new(say!("Readings of the code", "Interpretazioni della norma"), markup));
    }
    let program = say!("Program (NTC 10.2)", "Codice di calcolo (NTC 10.2)");
    parts.push(Section::new(program, software::section(origin)));
    page = sections(page, parts, language).text("<div class=\"together\">");
    let document = vec![Section::new(say!("Document", "Documento"), document(origin)?)];
    Ok(sections(page, document, language).text(&signed(origin)).text("</div>"))
}

/// The headline of a verdict as markup, of a wall with a name where it stands among others.
fn head(verdict: &Verdict<'_>, wall: Option<&str>, language: Language) -> String {
    let wall = wall.map_or_else(String::new, |name| as_written(name) + "<br>");
    let passed = if verdict.passed { "holds" } else { "fails" };
    let headline = verdict.headline().markup(language);
    format!("<p class=\"verdict {passed}\">{wall}{headline}</p>")
}

/// The rule of style that has a text at the foot of pages of a name; of all pages without one.
fn footer(page: &str, text: &str) -> String {
    // as code points, which no style misreads
    let text = text.chars().fold(String::new(), |mut text, letter| {
        // writing to a String cannot fail
        let _ = write!(text, "\\{:x} ", u32::from(letter));
        text
    });
    let look = "width: 88%; font: 8pt system-ui, sans-serif";
    format!("@page {page} {{ @bottom-left {{ content: \"{text}\"; {look}; }} }}")
}

/// The box for stamp and signature of the designer.
fn signed(origin: &Origin<'_>) -> String {
    let designer = origin.report.designer.as_deref();
    let designer = designer.map_or_else(String::new, |name| format!("<br>{}", as_written(name)));
    let said = [say!("Date", "Data"), say!("Stamp and signature", "Timbro e firma")];
    let [date, signature] = said.map(|said| said.markup(origin.report.language));
    format!("<div class=\"signed\"><p>{date}</p><p>{signature}{designer}</p></div>")
}

/// The code and the date as markup.
fn source(origin: &Origin<'_>, verdict: &Verdict<'_>) -> String {
    let language = origin.report.language;
    let kind = say!("Calculation report", "Relazione di calcolo").markup(language);
    let (source, date) = (escaped((verdict.code.source)().of(language)), origin.date());
    format!(
        "<p class=\"kind\">{kind}</p>\n<p class=\"subtitle\">{source}</p>\n\
         <p class=\"subtitle\">{date}</p>"
    )
}

/// Program, version, date, and the fingerprints of what was read.
fn document(origin: &Origin<'_>) -> Result<String, CheckError> {
    let own = file_name(Path::new(origin.file.name()));
    let mut files = vec![(own, fingerprint(origin.file.text().as_bytes()))];
    for path in origin.file.baseline().iter().chain(&origin.records.files) {
        let bytes = std::fs::read(path).map_err(|error| {
            let reason = format!("{error}; the file could be read earlier in this run");
            FileError::whole(path.display().to_string(), reason)
        })?;
        files.push((file_name(path), fingerprint(&bytes)));
    }
    // names of files are left out: a copy elsewhere is the same input
    let inputs: Vec<&str> =
        files.iter().map(|(_, hash)| hash.as_str()).chain(origin.set.iter().map(String::as_str)).collect();
    let language = origin.report.language;
    let of = |said: Sentence| said.markup(language);
    let date = origin.report.date.as_deref();
    let mut rows = vec![
        [of(say!("program", "programma")), format!("wall (rocking-wall) {}", env!("CARGO_PKG_VERSION"))],
        [of(say!("date", "data")), date.map_or_else(|| of(say!("not given", "non fornito")), as_written)],
        [
            of(say!("fingerprint of the inputs", "impronta dei dati")),
            fingerprint(inputs.join("\n").as_bytes()),
        ],
    ];
    rows.extend(files.into_iter().map(|(file, hash)| [as_written(&file), hash]));
    rows.extend(origin.set.iter().map(|set| ["--set".to_owned(), as_written(set)]));
    let said = say! {
        "Fingerprints are 128-bit FNV-1a hashes: equal inputs have equal ones. They do not protect against \
         deliberate changes.",
        "Le impronte sono hash FNV-1a a 128 bit: dati uguali hanno impronte uguali. Non proteggono da \
         modifiche volute."
    };
    Ok(table(&[], &rows) + &paragraph(&said, language))
}
