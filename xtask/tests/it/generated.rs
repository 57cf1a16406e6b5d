//! Parts of documents that are derived stand between marks. `cargo xtask generate` writes them, and its
//! `--check` runs this test as it is.

use ground_motion::Format;

use crate::{read, root};

/// Makes a table of Markdown.
fn table(head: &str, rows: impl IntoIterator<Item = [String; 2]>) -> String {
    let columns = head.split('|').count();
    let rows = rows.into_iter().map(|cells| format!("| {} |\n", cells.join(" | ")));
    format!("| {head} |\n{}|\n{}", "|---".repeat(columns), rows.collect::<String>())
}

/// The commands of `wall` with their purposes, and the parts of those that have some.
fn commands() -> String {
    let row = |command: &clap::Command| {
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        // details come after a colon or a question
        let about = about.split_inclusive('?').next().and_then(|about| about.split(": ").next());
        let about = about.unwrap_or_default();
        let parts: Vec<_> = command.get_subcommands().map(|part| format!("`{}`", part.get_name())).collect();
        let parts = if parts.is_empty() {
            String::new()
        } else {
            format!("{} {}", if about.ends_with('?') { "" } else { ":" }, parts.join(", "))
        };
        [format!("`{}`", command.get_name()), format!("{about}{parts}")]
    };
    table("command | purpose", wall::command().get_subcommands().map(row))
}

/// By what people know the files of a format: their ending, their origin.
fn files(format: Format) -> &'static str {
    match format {
        Format::At2 => "NGA-West and older",
        Format::Esm => "`.ASC`; ITACA before DYNA 1.2; AFAD `.asc` (Türkiye)",
        Format::Knet => "`.EW`, `.NS` …",
        Format::KnetCsv => "NIED's CSV with `RelativeTime(s)`",
        Format::Cosmos => "`.V2c`",
        Format::Csmip => "`.V2`, also of CDMG",
        Format::Smc => "`.smc`; not the unevenly spaced pairs of film",
        Format::Geonet => "`.V1A`, `.V2A` (New Zealand)",
        Format::Afad => "text with three columns (Türkiye)",
        Format::Cwa => "`.dat`, `.txt`, formerly of CWB (Taiwan)",
        Format::Unam => "`ARCHIVO ESTANDAR DE ACELERACION` 2.0 (Mexico)",
        Format::Volume1 => "volume 1, `.v1` (Chile, Iran)",
        Format::Fdsn => "SLIST, TSPAIR and GeoCSV of data centres, and of ObsPy",
        Format::Csv => "or text: one column, or times and accelerations",
        Format::Numbers => "several a line, as for OpenSees",
    }
}

/// The formats of records with their files.
fn formats() -> String {
    let row = |format: Format| {
        [format!("{} | {}", format.description(), files(format)), format!("`{}`", format.name())]
    };
    table("format | files | `--format`", Format::ALL.map(row))
}

/// The names of the formats, as an item of a list.
fn listed() -> String {
    let mut lines = vec![String::new()];
    for name in Format::listed().split(' ') {
        if lines[lines.len() - 1].len() + name.len() > 105 {
            lines.push(String::new());
        }
        let line = lines.last_mut().unwrap();
        *line += if line.is_empty() { "  " } else { " " };
        *line += name;
    }
    lines.join("\n") + " or text\n  "
}

#[test]
fn derived_parts_are_up_to_date() {
    for (document, mark, derived) in [
        ("README.md", "commands", commands()),
        ("docs/records.md", "formats", formats()),
        ("crates/ground-motion/README.md", "formats", listed()),
    ] {
        let text = read(document);
        let (begin, end) = (format!("<!-- {mark} -->\n"), format!("<!-- end {mark} -->"));
        let (before, rest) = text.split_once(&begin).unwrap();
        let (_, after) = rest.split_once(&end).unwrap();
        let expected = [before, &begin, &derived, &end, after].concat();
        if std::env::var_os("ROCKING_WALL_GENERATE").is_some() {
            std::fs::write(root().join(document), expected).unwrap();
        } else {
            assert_eq!(text, expected, "{document} is stale: run `cargo xtask generate`");
        }
    }
}
