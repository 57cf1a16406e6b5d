//! The report of a check for a calculation file, in one page: what the reports of all codes share.

mod decimals;
pub(crate) mod drawing;
pub(crate) mod inputs;
pub(crate) mod language;
pub(crate) mod markup;
mod origin;
pub(crate) mod project;
mod walls;

use std::fmt::Write as _;
use std::path::Path;

use ::report::escaped;
use ::report::page::Page;
use rocking_wall::scene::{SceneError, fingerprint};

use crate::error::CheckError;
use crate::site::Records;
use crate::verdict::Verdict;

pub(crate) use inputs::{overview, the_wall};
pub use language::{Language, terms};
use language::{translated, with_symbols};
use markup::{list, table};
pub use origin::{Figure, Origin};
use project::as_written;
pub use project::{ReportTable, report_schema};
pub use walls::page_of_walls;

/// Makes the page of a report: the verdict, warnings, the sections of its code, and the fingerprints of what
/// was read.
///
/// # Errors
/// [`CheckError`] of a demand, or of a record that cannot be read again.
pub fn page(verdict: &Verdict<'_>, origin: &Origin<'_>) -> Result<String, CheckError> {
    let page = begun(origin.title, verdict, &format!("\n{}", head(verdict, None)), origin);
    let page = sections(sheet_head(page, verdict, origin), verdict.details.site()?);
    let page = sections(page, verdict.details.sections(origin)?);
    let page = end(page, &verdict.details.symbols(), &verdict.details.readings(), origin)?;
    Ok(finished(&page, origin.title, origin))
}

/// Begins a page: what it is, the verdict where it is one, and the data of the project.
fn begun(title: &str, verdict: &Verdict<'_>, headline: &str, origin: &Origin<'_>) -> Page {
    let page = Page::new(title).styled(include_str!("page.css"));
    let page = page.styled(&footer("", &origin.footer(None))).text(&(source(origin, verdict) + headline));
    let project = origin.report.project_data();
    if project.is_empty() { page } else { page.section("Project", &project) }
}

/// Returns a page in its language, with its symbols as formulas, its title and the files of the user as they
/// are written.
fn finished(page: &Page, title: &str, origin: &Origin<'_>) -> String {
    let [plain, written] = [escaped(title), as_written(title)].map(|title| format!("<h1>{title}</h1>"));
    let page = page.html().replacen(&plain, &written, 1);
    let mut page = with_symbols(&translated(page, origin.report.language));
    for (index, path) in origin.records.files.iter().enumerate() {
        page = page.replace(&mark(index), &as_written(&file_name(path)));
    }
    page
}

/// Stands for the name of a file until a page is translated: no word, symbol or number.
fn mark(index: usize) -> String {
    format!("\u{e000}{index}\u{e001}")
}

/// The name of a file; folders are the machine's.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

impl Records {
    /// Returns a text with a mark in place of each file of the records.
    fn marked(&self, text: &str) -> String {
        let files = self.files.iter().enumerate();
        files.fold(text.to_owned(), |text, (index, path)| {
            with_word(&text, &path.display().to_string(), &mark(index))
        })
    }
}

/// Replaces a word where it does not belong to a longer one: the record `r` is not in every word with an r.
/// Folders before a path with folders are part of the same file.
fn with_word(text: &str, word: &str, new: &str) -> String {
    let is_bare = !word.contains(['/', '\\']);
    let belongs =
        |c: char| c.is_alphanumeric() || matches!(c, '_' | '-') || is_bare && matches!(c, '/' | '\\');
    let (mut written, mut rest) = (String::new(), text);
    while let Some(at) = rest.find(word).filter(|_| !word.is_empty()) {
        let (before, after) = (&rest[..at], &rest[at + word.len()..]);
        let goes_on = after.strip_prefix('.').unwrap_or(after).starts_with(belongs);
        written += before;
        let is_part = written.ends_with(belongs) || goes_on;
        written += if is_part { word } else { new };
        rest = after;
    }
    written + rest
}

/// Adds the verdict on a wall and its warnings.
fn sheet_head(page: Page, verdict: &Verdict<'_>, origin: &Origin<'_>) -> Page {
    // the lines of single runs, which are indented, have a table of their own
    let notes = verdict.notes.iter().filter(|note| !note.starts_with("  "));
    let notes: Vec<_> = notes.map(|note| origin.records.marked(note)).collect();
    let checks = format!("<div class=\"checks\">{}</div>{}", verdict.html(), list(&notes));
    let warnings = verdict.warnings.iter().chain(&origin.records.warnings);
    let warnings: Vec<_> = warnings.map(|warning| origin.records.marked(warning)).collect();
    let warnings = if warnings.is_empty() { "<p>None.</p>\n".to_owned() } else { list(&warnings) };
    page.section("Verdict", &checks).section("Warnings", &warnings)
}

fn sections(page: Page, sections: Vec<(String, String)>) -> Page {
    sections.into_iter().fold(page, |page, (heading, markup)| page.section(&heading, &markup))
}

/// Adds what ends a report: the readings of the code, what was read, and the box for stamp and signature. The
/// box does not stand alone on its page.
fn end(mut page: Page, symbols: &str, readings: &[String], origin: &Origin<'_>) -> Result<Page, CheckError> {
    if !symbols.is_empty() {
        page = page.section("Symbols", symbols);
    }
    if !readings.is_empty() {
        let items = readings.iter().map(|reading| ["<li>", reading, "</li>\n"].concat());
        let items = items.collect::<String>();
        let introduced = "<p>Where the code can be read in two ways, this check takes:</p>";
        page = page.section("Readings of the code", &format!("{introduced}\n<ul>\n{items}</ul>\n"));
    }
    let page = page.text("<div class=\"together\">").section("Document", &document(origin)?);
    Ok(page.text(&signed(origin)).text("</div>"))
}

/// The headline of a verdict as markup, of a wall with a name where it stands among others.
fn head(verdict: &Verdict<'_>, wall: Option<&str>) -> String {
    let wall = wall.map_or_else(String::new, |name| as_written(name) + "<br>");
    let passed = if verdict.passed { "holds" } else { "fails" };
    let headline = escaped(&verdict.headline());
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
    format!("<div class=\"signed\"><p>Date</p><p>Stamp and signature{designer}</p></div>")
}

/// The code and the date as markup.
fn source(origin: &Origin<'_>, verdict: &Verdict<'_>) -> String {
    let (source, date) = (escaped(verdict.code.source), origin.date());
    format!(
        "<p class=\"kind\">Calculation report</p>\n<p class=\"subtitle\">{source}</p>\n\
         <p class=\"subtitle\">{date}</p>"
    )
}

/// Program, version, date, and the fingerprints of what was read.
fn document(origin: &Origin<'_>) -> Result<String, CheckError> {
    let own = file_name(Path::new(origin.file.name()));
    let mut files = vec![(own, fingerprint(origin.file.text().as_bytes()))];
    for path in &origin.records.files {
        let bytes = std::fs::read(path).map_err(|error| SceneError::File {
            file: path.display().to_string(),
            reason: format!("{error}; the file could be read earlier in this run"),
        })?;
        files.push((file_name(path), fingerprint(&bytes)));
    }
    // names of files are left out: a copy elsewhere is the same input
    let inputs: Vec<&str> =
        files.iter().map(|(_, hash)| hash.as_str()).chain(origin.set.iter().map(String::as_str)).collect();
    let mut rows = vec![
        ["program".to_owned(), format!("wall (rocking-wall) {}", env!("CARGO_PKG_VERSION"))],
        ["date".to_owned(), origin.report.date.as_deref().map_or_else(|| "not given".to_owned(), as_written)],
        ["fingerprint of the inputs".to_owned(), fingerprint(inputs.join("\n").as_bytes())],
    ];
    rows.extend(files.into_iter().map(|(file, hash)| [as_written(&file), hash]));
    rows.extend(origin.set.iter().map(|set| ["--set".to_owned(), as_written(set)]));
    Ok(table(&[], &rows)
        + "<p>Fingerprints are 128-bit FNV-1a hashes: equal inputs have equal ones. They do not protect \
           against deliberate changes.</p>\n")
}

#[cfg(test)]
mod tests {
    use super::with_word;

    #[test]
    fn a_file_is_marked_where_it_stands_by_itself() {
        let text = "r: the record r.csv of a/r is shorter than r. Error of 'r', rr";
        let written = "*: the record r.csv of a/r is shorter than *. Error of '*', rr";
        assert_eq!(with_word(text, "r", "*"), written);
        assert_eq!(with_word("x a/r y ./a/r", "a/r", "*"), "x * y ./*");
    }
}
