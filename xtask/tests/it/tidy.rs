//! What keeps the sources readable: widths, lengths, and `unsafe` in one place.

use std::path::Path;
use std::process::Command;

use crate::read;

/// Columns of code, comments and documents.
const COLUMNS: usize = 110;
/// A Rust file has fewer lines.
const LINES: usize = 400;
/// Kinds of files with lines that people read.
const ENDINGS: [&str; 10] = [".rs", ".md", ".toml", ".py", ".c", ".html", ".xml", ".css", ".js", ".yml"];
/// Texts of others, and descriptions whose lines a test counts.
const EXEMPT: [&str; 2] = ["/licenses/", "fmu-export-build/tests/it/"];
/// Where `unsafe` may stand: the C boundary, that of WebAssembly, tests that load libraries
/// or count allocations, and the fuzzer, which calls as C does.
const UNSAFE: [&str; 7] = [
    "crates/fmu-export/src/ffi",
    "crates/fmu-export/tests",
    "crates/playground/src/boundary.rs",
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
        if is_rust(name) && text.lines().count() >= LINES {
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
    // what users run is named where they look
    let promised = read(".github/SECURITY.md");
    for place in UNSAFE.iter().filter(|place| place.contains("/src/")) {
        assert!(promised.contains(&format!("`{place}`")), "SECURITY.md does not name {place}");
    }
}

#[test]
fn no_test_measures_time() {
    // `tests/peers` is a program that measures
    let is_test = |name: &str| {
        (name.contains("tests/") || name.ends_with("tests.rs")) && !name.starts_with("tests/peers/")
    };
    let clocks = ["Instant::", "SystemTime::", "perf_counter", "time.time("];
    let tests: Vec<_> = files().into_iter().filter(|(name, _)| is_test(name)).collect();
    assert!(tests.len() > 100, "git lists {} files of tests", tests.len());
    for (name, text) in tests.iter().filter(|(name, _)| name != "xtask/tests/it/tidy.rs") {
        let clock = clocks.iter().find(|clock| text.contains(*clock));
        assert!(clock.is_none(), "{name} has {clock:?}");
    }
}

/// `ClusterFuzzLite` starts from the same texts as `cargo xtask fuzz`.
#[test]
fn fuzzers_have_one_list_of_seeds() {
    let (job, build) = (read("xtask/src/fuzz.rs"), read(".clusterfuzzlite/build.sh"));
    let rows = job.lines().filter_map(|line| line.trim().strip_prefix("(\"")?.strip_suffix("]),"));
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split('"').step_by(2).collect()).collect();
    assert!(rows.len() >= 5, "{rows:?}");
    // the first word of a row is the target; one has no texts to start from
    for row in rows.iter().filter(|row| row.len() > 1) {
        let seeds = format!("\nseeds {}\n", row.join(" "));
        assert!(build.contains(&seeds), "build.sh has no line {seeds:?}");
    }
}

/// Modules that open files are those that the heads of their crates list.
#[test]
fn files_are_opened_where_the_heads_say() {
    const OPENS: [&str; 3] = ["read_text(", "Scene::read(", "std::fs::"];
    let opens = |text: &str| OPENS.iter().any(|word| text.contains(word));
    let modules = files().into_iter().filter(|(name, text)| is_rust(name) && opens(text));
    let modules: Vec<String> = modules.map(|(name, _)| name).collect();
    let lists: [(&str, &[&str], &str); 3] = [
        (
            "run",
            &["file.rs", "records.rs", "selection.rs", "wall_table.rs"],
            "Only [`mod@file`], [`walls`], [`selection`] and [`records`] open files",
        ),
        (
            "study",
            &["document/compare.rs", "document/hazard.rs", "loaded.rs"],
            "Only [`document`], [`loaded`] and [`folder`] open files",
        ),
        ("evidence", &["validation/case.rs"], "Only [`validation`] opens files"),
    ];
    for (name, expected, words) in lists {
        let src = format!("crates/{name}/src/");
        let found: Vec<_> = modules
            .iter()
            .filter_map(|module| module.strip_prefix(&src))
            .filter(|module| !module.starts_with("folder/"))
            .collect();
        assert_eq!(found, expected, "{name}");
        assert!(read(&format!("{src}lib.rs")).contains(words), "{name}");
    }
}
