//! Tests that documents name files and functions that exist.

use std::path::Path;

use crate::tidy::files;
use crate::{read, root};

const ENDINGS: [&str; 7] = [".rs", ".py", ".c", ".toml", ".xml", ".html", ".md"];

/// Returns whether a word in backquotes is the path of a committed file.
fn is_path(word: &str) -> bool {
    let is_made = word.starts_with("fmu_out/") || word.contains('*') || word.contains(' ');
    word.contains('/') && !is_made && ENDINGS.iter().any(|ending| word.ends_with(ending))
}

/// Returns the words in backquotes.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// Returns whether a text has a name that is no part of a longer one.
fn has_name(text: &str, name: &str) -> bool {
    let goes_on = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    text.match_indices(name).any(|(at, _)| {
        !goes_on(text[..at].chars().next_back()) && !goes_on(text[at + name.len()..].chars().next())
    })
}

#[test]
fn documents_name_what_exists() {
    let is_document = |name: &str| Path::new(name).extension().is_some_and(|ending| ending == "md");
    let documents: Vec<_> = files().into_iter().filter(|(name, _)| is_document(name)).collect();
    assert!(documents.len() > 15, "git lists {} documents", documents.len());
    let (mut paths, mut links, mut rows) = (0, 0, 0);
    for (document, text) in documents {
        let path = root().join(&document);
        for (index, line) in text.lines().enumerate() {
            let place = format!("{document}:{}", index + 1);
            for word in quoted(line).filter(|word| is_path(word)) {
                let is_here = root().join(word).is_file() || path.with_file_name(word).is_file();
                assert!(is_here, "{place}: there is no {word}");
                paths += 1;
            }
            for link in line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()) {
                let is_here = link.is_empty() || link.contains("://") || path.with_file_name(link).exists();
                assert!(is_here, "{place}: there is no {link}");
                links += 1;
            }
            // a row of a table: a file, and what it holds
            let mut cells = line.split('|').skip(1);
            let (Some(first), Some(second)) = (cells.next(), cells.next()) else { continue };
            let Some(file) = quoted(first).find(|word| is_path(word)) else { continue };
            let source = read(file);
            for name in quoted(second) {
                assert!(has_name(&source, name), "{place}: {file} has no {name}");
                rows += 1;
            }
        }
    }
    assert!(paths > 80 && links > 70 && rows > 40, "{paths} paths, {links} links, {rows} names in tables");
}

/// What README says of errors is what docs/accuracy.md measured.
#[test]
fn the_readme_states_the_errors_that_were_measured() {
    let table = read("docs/accuracy.md");
    let rows = table.lines().filter(|line| line.starts_with("| Table 5, wall "));
    let errors = |cell: usize| rows.clone().map(move |row| row.split('|').nth(cell).unwrap().trim().parse());
    let (own, newmark): (Vec<f64>, Vec<f64>) =
        (errors(4).collect::<Result<_, _>>().unwrap(), errors(5).collect::<Result<_, _>>().unwrap());
    let walls: std::collections::BTreeSet<_> = rows.clone().map(|row| row.split(',').nth(1)).collect();
    assert!(own.len() == 6 && walls.len() == 3, "{own:?}, {walls:?}");
    assert!(own.iter().all(|error| *error <= 1e-11), "{own:?}");
    let least = newmark.iter().copied().fold(f64::INFINITY, f64::min);
    let most = newmark.iter().copied().fold(0.0, f64::max);
    let range = format!("off by {} to {} %", 100.0 * least, 100.0 * most);
    let paper = read("paper/paper.md");
    for (name, text) in [("README.md", read("README.md")), ("paper/paper.md", paper.clone())] {
        assert!(text.replace('\n', " ").contains(&range), "{name}: {range}");
    }
    let fastest = table.split("wall 5 CDC").nth(1).unwrap().split("fastest setting").nth(1).unwrap();
    let tools = fastest.lines().skip(2).take(5).map(|line| line.split_whitespace());
    for mut words in tools {
        let (tool, ratio) = (words.next().unwrap(), words.next_back().unwrap().parse::<f64>().unwrap());
        let stated = format!("{ratio:.0} ({tool})");
        assert!(paper.contains(&stated), "paper/paper.md: {stated}");
    }
}

/// The paper cites what its bibliography has, and the bibliography has nothing else.
#[test]
fn the_paper_cites_its_bibliography() {
    let (paper, list) = (read("paper/paper.md"), read("paper/paper.bib"));
    let cited: std::collections::BTreeSet<_> = paper
        .split('@')
        .skip(1)
        .filter_map(|rest| rest.split(|c: char| !c.is_alphanumeric()).next())
        .collect();
    let listed = list.lines().filter_map(|line| line.strip_prefix('@')?.split(['{', ',']).nth(1));
    assert_eq!(cited, listed.collect());
}

/// The answers for the badge have statuses that it knows, reasons, and files that exist.
#[test]
fn the_answers_for_the_badge_name_what_exists() {
    let answers: serde_json::Value = serde_json::from_str(&read(".bestpractices.json")).unwrap();
    let answers = answers.as_object().unwrap();
    let statuses = answers.iter().filter_map(|(key, value)| Some((key.strip_suffix("_status")?, value)));
    let mut count = 0;
    for (criterion, status) in statuses {
        assert!(["Met", "Unmet", "N/A", "?"].contains(&status.as_str().unwrap()), "{criterion}: {status}");
        let reason = answers[&format!("{criterion}_justification")].as_str().unwrap();
        assert!(!reason.is_empty(), "{criterion} has no reason");
        for file in quoted(reason) {
            assert!(root().join(file).is_file(), "{criterion}: there is no {file}");
        }
        count += 1;
    }
    assert!(count == 67 && answers.len() == 2 * count, "{count} criteria");
}

#[test]
fn every_equation_of_the_paper_has_its_place() {
    let text = read("docs/architecture.md");
    let section = text.split("\n### ").find(|section| section.starts_with("Equations of the paper")).unwrap();
    for equation in 1..=23 {
        assert!(section.contains(&format!("({equation})")), "Eq. ({equation}) is not in the table");
    }
}

/// The modules of the wall are those that its head lists, in the same order.
#[test]
fn modules_are_listed_as_in_the_source() {
    let (text, source) = (read("docs/architecture.md"), read("src/lib.rs"));
    let modules = |lines: &str, start: &str| -> Vec<String> {
        let rows = lines.lines().filter_map(|line| line.strip_prefix(start)?.split('|').next());
        rows.flat_map(quoted).map(str::to_owned).collect()
    };
    let start = "Modules of `rocking-wall`";
    let section = text.split("\n### ").find(|section| section.starts_with(start)).unwrap();
    let listed = modules(&source, "//! | ");
    assert!(listed.len() >= 5, "{listed:?}");
    let table = section.split("\n\n").find(|part| part.starts_with("| module")).unwrap();
    assert_eq!(modules(table, "| "), listed);
}

/// The page of the export layer holds the example, so that a reader needs nothing else.
#[test]
fn the_readme_of_the_export_layer_is_its_example() {
    let page = read("crates/fmu-export/README.md");
    for (language, file) in [("xml", "modelDescription.xml"), ("rust", "build.rs"), ("rust", "src/lib.rs")] {
        let text = read(&format!("examples/fmu/{file}"));
        assert!(page.contains(&format!("```{language}\n{text}```\n")), "README.md has another {file}");
    }
    // the signatures are those of the traits
    let traits = read("crates/fmu-export/src/model.rs").replace("(&self, _", "(&self, ");
    let traits = traits.replace("&mut self, _", "&mut self, ").replace(", _", ", ");
    let signatures: Vec<_> =
        page.lines().filter(|line| line.starts_with("fn ") && !line.contains('{')).collect();
    assert!(signatures.len() > 10, "{signatures:?}");
    for signature in signatures {
        assert!(traits.contains(&format!("    {signature}")), "model.rs has no {signature}");
    }
    let lines = |name: &str| read(&format!("examples/fmu/{name}")).lines().count();
    assert!(lines("modelDescription.xml") + lines("build.rs") + lines("src/lib.rs") < 150, "it is long");
}
