//! What keeps the sources readable: widths, lengths, and `unsafe` in one place.

use std::path::Path;
use std::process::Command;

/// Columns of code, comments and documents.
const COLUMNS: usize = 110;
/// Lines of a Rust file.
const LINES: usize = 400;
/// Kinds of files with lines that people read.
const ENDINGS: [&str; 11] =
    [".rs", ".md", ".toml", ".py", ".c", ".html", ".xml", ".css", ".js", ".yml", ".schema.json"];
/// Texts of others, and descriptions whose lines a test counts.
const EXEMPT: [&str; 2] = ["/licenses/", "fmu-export-build/tests/it/"];
/// Where `unsafe` may stand: the C boundary and what loads it, that of WebAssembly, tests that load libraries
/// or count allocations, and the fuzzer, which calls as C does.
const UNSAFE: [&str; 8] = [
    "crates/fmu-export/src/ffi",
    "crates/fmu-export/tests",
    "crates/playground/src/boundary.rs",
    "crates/wall-cli/src/commands/verify/importer.rs",
    "tests/",
    "crates/floor/tests",
    "fuzz/",
    // names the word
    "xtask/tests/it/tidy.rs",
];

/// The files of the project with their texts.
pub(crate) fn files() -> Vec<(String, String)> {
    let list = Command::new("git").args(["ls-files"]).current_dir(crate::root()).output().unwrap();
    let list = String::from_utf8(list.stdout).unwrap();
    let wanted = |name: &&str| {
        let is_data = EXEMPT.iter().any(|part| name.contains(part));
        ENDINGS.iter().any(|ending| name.ends_with(ending)) && !is_data
    };
    let files = list.lines().filter(wanted).map(|name| (name.to_owned(), crate::root().join(name)));
    // a file that is deleted but not yet committed is still in the list
    files.filter_map(|(name, path)| Some((name, std::fs::read_to_string(path).ok()?))).collect()
}

fn is_rust(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending == "rs")
}

#[test]
fn lines_and_files_are_short() {
    let files = files();
    assert!(files.len() > 300, "git lists {} files", files.len());
    let mut long = Vec::new();
    for (name, text) in &files {
        for (index, line) in text.lines().enumerate().filter(|(_, line)| line.chars().count() > COLUMNS) {
            long.push(format!("{name}:{} has {} columns", index + 1, line.chars().count()));
        }
        if is_rust(name) && text.lines().count() > LINES {
            long.push(format!("{name} has {} lines", text.lines().count()));
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn unsafe_code_stands_at_the_c_boundary() {
    for (name, text) in files().iter().filter(|(name, _)| is_rust(name)) {
        let is_unsafe = text.lines().any(|line| {
            let code = line.split("//").next().unwrap_or_default();
            ["unsafe {", "unsafe fn", "unsafe impl", "unsafe extern", "unsafe("]
                .iter()
                .any(|word| code.contains(word))
        });
        let allowed = UNSAFE.iter().any(|folder| name.starts_with(folder));
        assert!(allowed || !is_unsafe, "{name} has unsafe code");
    }
}
