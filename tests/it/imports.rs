//! Imports point one way: no file names what is defined in a file that, directly or through others, names it
//! back.
//!
//! A name is followed through `pub use` to the file that defines it. A parent that only declares and
//! re-exports its children is therefore in no circle with them; one that defines what they use is. Modules of
//! tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// A `use` behind another, followed this far.
const MOST_REEXPORTS: usize = 8;

/// The modules of one crate: their paths (`["solver", "run"]`; the root is empty) and what they name.
type Modules = BTreeMap<Vec<String>, Names>;

/// What one file names.
#[derive(Default)]
struct Names {
    /// Paths in use declarations and in code.
    paths: Vec<Vec<String>>,
    /// Names that others may find here, by the paths they come from; `*` for all of a module.
    exports: Vec<(String, Vec<String>)>,
}

#[test]
fn no_file_imports_in_a_circle() {
    let root = crate::root();
    let mut sources = vec![root.join("src"), root.join("xtask/src")];
    let crates = std::fs::read_dir(root.join("crates")).unwrap();
    sources.extend(crates.map(|folder| folder.unwrap().path().join("src")));
    for folder in sources {
        let mut modules = Modules::new();
        read(&folder, &[], &mut modules);
        assert!(modules.contains_key(&vec![]), "{} has neither lib.rs nor main.rs", folder.display());
        let circle = circle(&arrows(&modules));
        assert!(circle.is_empty(), "{}: {}", folder.display(), circle.join(" -> "));
    }
}

/// The layers of the unit, from the ground up: none knows a later one.
#[test]
fn the_layers_of_the_unit_are_in_order() {
    const LAYERS: [&str; 8] =
        ["choices", "wall", "variables", "solver", "simulation", "scene", "response", "unit"];
    let mut modules = Modules::new();
    read(&crate::root().join("src"), &[], &mut modules);
    let layer = |name: &str| LAYERS.iter().position(|layer| name.split("::").next() == Some(layer));
    for (from, to) in arrows(&modules) {
        for to in to {
            if let (Some(lower), Some(upper)) = (layer(&from), layer(&to)) {
                assert!(upper <= lower, "{from} imports {to}");
            }
        }
    }
}

#[test]
fn a_planted_circle_is_found() {
    let crate_of = |files: &[(&str, &str)]| -> Vec<String> {
        let path = |name: &str| name.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
        circle(&arrows(&files.iter().map(|(name, text)| (path(name), names(text))).collect()))
    };
    let chain = [("", "mod a; mod b;"), ("a", "use crate::b::B; pub struct A;"), ("b", "pub struct B;")];
    assert!(crate_of(&chain).is_empty());
    // two files that name each other, by a use, by a path in code, within braces
    for back in ["use crate::a::A;", "fn f() { crate::a::f() }", "use crate::{a::{self, A}};"] {
        let circle = [chain[0], chain[1], ("b", back)];
        assert_eq!(crate_of(&circle).len(), 3, "{back}");
    }
    // a child that uses what its parent defines, while the parent uses the child
    let parent = "mod c; use c::C; pub struct P;";
    assert_eq!(crate_of(&[("", "mod p;"), ("p", parent), ("p::c", "use super::P;")]).len(), 3);
    // not so where the parent only hands on, where the text is a comment or a string, or in a module of tests
    let parent = "mod c; mod d; pub use c::C; pub use d::D;";
    assert!(crate_of(&[("", "mod p;"), ("p", parent), ("p::c", "use super::D;"), ("p::d", "")]).is_empty());
    for quiet in
        ["// use crate::a::A;", "const A: &str = \"crate::a::A\";", "#[cfg(test)] mod t { use crate::a::A; }"]
    {
        assert!(crate_of(&[chain[0], chain[1], ("b", quiet)]).is_empty(), "{quiet}");
    }
}

/// Reads the files of a folder and of those in it.
fn read(folder: &Path, path: &[String], modules: &mut Modules) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            // a program of its own
            if name != "bin" {
                read(&entry.path(), &[path, &[name]].concat(), modules);
            }
        } else if let Some(stem) = name.strip_suffix(".rs") {
            let is_root = ["lib", "main", "mod"].contains(&stem);
            let module = if is_root { path.to_vec() } else { [path, &[stem.to_owned()]].concat() };
            modules.insert(module, names(&std::fs::read_to_string(entry.path()).unwrap()));
        }
    }
}

/// For each file the files that define what it names.
fn arrows(modules: &Modules) -> BTreeMap<String, BTreeSet<String>> {
    let shown = |module: &[String]| if module.is_empty() { "root".to_owned() } else { module.join("::") };
    let targets = |module: &Vec<String>, names: &Names| {
        let found = names.paths.iter().filter_map(|path| resolve(modules, module, path, MOST_REEXPORTS));
        found.filter(|target| target != module).map(|target| shown(&target)).collect()
    };
    modules.iter().map(|(module, names)| (shown(module), targets(module, names))).collect()
}

/// The module that defines what a path names in a module; `None` for what is not of this crate.
fn resolve(modules: &Modules, module: &[String], path: &[String], depth: usize) -> Option<Vec<String>> {
    let mut place = module.to_vec();
    let mut rest = path;
    match rest.first()?.as_str() {
        "crate" => (place, rest) = (vec![], &rest[1..]),
        "self" => rest = &rest[1..],
        "super" => {
            while rest.first().is_some_and(|part| part == "super") {
                place.pop();
                rest = &rest[1..];
            }
        }
        first if modules.contains_key(&[&place[..], &[first.to_owned()]].concat()) => {}
        _ => return None,
    }
    while let Some(first) = rest.first() {
        let child = [&place[..], std::slice::from_ref(first)].concat();
        if !modules.contains_key(&child) {
            break;
        }
        (place, rest) = (child, &rest[1..]);
    }
    let exports = &modules.get(&place)?.exports;
    let by = |wanted: &str| exports.iter().find(|(name, _)| name == wanted).map(|(_, path)| path);
    if let (Some(name), Some(depth)) = (rest.first(), depth.checked_sub(1))
        && let Some(path) = by(name).or_else(|| by("*"))
        && let Some(target) = resolve(modules, &place, path, depth)
    {
        return Some(target);
    }
    Some(place)
}

/// A circle of arrows, the first file again at its end; empty where there is none.
fn circle(arrows: &BTreeMap<String, BTreeSet<String>>) -> Vec<String> {
    fn visit<'a>(
        arrows: &'a BTreeMap<String, BTreeSet<String>>,
        at: &'a str,
        way: &mut Vec<&'a str>,
        done: &mut BTreeSet<&'a str>,
    ) -> Option<Vec<String>> {
        if let Some(first) = way.iter().position(|seen| *seen == at) {
            return Some(way[first..].iter().chain([&at]).map(|name| (*name).to_owned()).collect());
        }
        if !done.contains(at) {
            way.push(at);
            for next in arrows.get(at).into_iter().flatten() {
                if let Some(found) = visit(arrows, next, way, done) {
                    return Some(found);
                }
            }
            way.pop();
            done.insert(at);
        }
        None
    }
    let mut done = BTreeSet::new();
    arrows.keys().find_map(|start| visit(arrows, start, &mut vec![], &mut done)).unwrap_or_default()
}

/// What a source text names.
fn names(text: &str) -> Names {
    let tokens = without_tests(&tokens(text));
    let mut names = Names::default();
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at] == "use" {
            let public = at > 0 && (tokens[at - 1] == "pub" || tokens[at - 1] == ")");
            at = tree(&tokens, at + 1, &[], &mut |exported, path| {
                if public {
                    names.exports.push((exported, path.clone()));
                }
                names.paths.push(path);
            });
        } else if is_name(&tokens[at]) && tokens.get(at + 1).is_some_and(|next| next == "::") {
            let mut path = vec![tokens[at].clone()];
            while tokens.get(at + 1).is_some_and(|next| next == "::")
                && tokens.get(at + 2).is_some_and(|next| is_name(next))
            {
                path.push(tokens[at + 2].clone());
                at += 2;
            }
            names.paths.push(path);
            at += 1;
        } else {
            at += 1;
        }
    }
    names
}

/// The leaves of a use tree, with the names they get; returns the place after it.
fn tree(
    tokens: &[String],
    mut at: usize,
    before: &[String],
    leaf: &mut impl FnMut(String, Vec<String>),
) -> usize {
    let mut path = before.to_vec();
    while let Some(token) = tokens.get(at) {
        match token.as_str() {
            "::" => {}
            "{" => loop {
                at = tree(tokens, at + 1, &path, leaf);
                if tokens.get(at).is_none_or(|token| token != ",") {
                    return at + 1;
                }
            },
            "}" | "," | ";" => break,
            "as" => {
                leaf(tokens[at + 1].clone(), path);
                return at + 2;
            }
            "self" if !path.is_empty() => {}
            "*" => {
                leaf("*".to_owned(), path);
                return at + 1;
            }
            name => path.push(name.to_owned()),
        }
        at += 1;
    }
    if path.len() > before.len() || tokens.get(at.wrapping_sub(1)).is_some_and(|token| token == "self") {
        leaf(path.last().cloned().unwrap_or_default(), path);
    }
    at
}

fn is_name(token: &str) -> bool {
    token.starts_with(|first: char| first.is_alphabetic() || first == '_')
}

/// The tokens without what stands behind `#[cfg(test)]`.
fn without_tests(tokens: &[String]) -> Vec<String> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        if !tokens[at..].iter().take(MARK.len()).eq(MARK.iter()) {
            kept.push(tokens[at].clone());
            at += 1;
            continue;
        }
        let mut depth = 0;
        for token in &tokens[at..] {
            at += 1;
            match token.as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 && (token == "}" || token == ";") {
                break;
            }
        }
    }
    kept
}

/// Names, `::` and single characters, without comments, strings and characters in quotes.
fn tokens(text: &str) -> Vec<String> {
    let text: Vec<char> = text.chars().collect();
    let starts = |at: usize, mark: &str| mark.chars().enumerate().all(|(i, c)| text.get(at + i) == Some(&c));
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let from = at;
        if starts(at, "//") {
            at += text[at..].iter().position(|&c| c == '\n').unwrap_or(text.len() - at);
        } else if text[at] == '"' {
            at += 1;
            while at < text.len() && text[at] != '"' {
                at += if text[at] == '\\' { 2 } else { 1 };
            }
            at += 1;
        } else if starts(at, "r\"") || starts(at, "r#\"") {
            let hashes = usize::from(text[at + 1] == '#');
            let end = if hashes == 1 { "\"#" } else { "\"" };
            at += 2 + hashes;
            while at < text.len() && !starts(at, end) {
                at += 1;
            }
            at += end.len();
        } else if text[at] == '\'' && (text.get(at + 2) == Some(&'\'') || text.get(at + 1) == Some(&'\\')) {
            at += if text[at + 1] == '\\' { 3 } else { 2 };
            while text.get(at - 1).is_some_and(|&c| c != '\'') || at < from + 3 {
                at += 1;
            }
        } else if starts(at, "::") {
            at += 2;
            tokens.push("::".to_owned());
        } else if text[at].is_alphanumeric() || text[at] == '_' {
            while at < text.len() && (text[at].is_alphanumeric() || text[at] == '_') {
                at += 1;
            }
            tokens.push(text[from..at].iter().collect());
        } else {
            if !text[at].is_whitespace() {
                tokens.push(text[at].to_string());
            }
            at += 1;
        }
    }
    tokens
}
