//! Tests that the files of a crate import in one direction; between crates Cargo sees to that.
//!
//! A file imports another where it names something of it after `use`, `crate` or `super`. What a module
//! re-exports counts as the file that defines it. Comments, tests and inline modules of tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::tidy::files;

/// How the head of a module says that its table has an order.
const ORDERED: &str = "only modules above it";

/// The files of some crates, by crate and module path.
struct Sources(BTreeMap<(String, Vec<String>), Source>);

/// A file: its name, its text without comments and tests, and what it uses.
struct Source {
    file: String,
    /// The comment at its head.
    head: String,
    code: String,
    uses: Vec<Vec<String>>,
}

/// A file and one that it imports.
type Arrows = BTreeSet<(String, String)>;

#[test]
fn files_of_a_crate_import_in_one_direction() {
    let sources = Sources::of(files());
    let crates: BTreeSet<_> = sources.0.keys().map(|(place, _)| place.as_str()).collect();
    for looked_at in [
        "",
        "crates/fragility/",
        "crates/report/",
        "crates/scene/",
        "crates/study/",
        "crates/wall-cli/",
        "xtask/",
    ] {
        assert!(crates.contains(looked_at), "{looked_at} is not among {crates:?}");
    }
    let circles = in_circles(&sources.arrows());
    assert!(circles.is_empty(), "these files import each other, move a definition down:\n{circles:#?}");
}

#[test]
fn modules_use_those_above_them_in_their_tables() {
    let sources = Sources::of(files());
    let arrows = sources.arrows();
    let places: BTreeMap<_, _> = sources.0.iter().map(|(place, source)| (&source.file, place)).collect();
    let mut tables = 0;
    for ((place, path), Source { file, head, .. }) in &sources.0 {
        let Some((_, table)) = head.split_once(ORDERED) else { continue };
        tables += 1;
        let listed = listed(table);
        // the module of this table to which a file belongs
        let module_of = |file: &String| {
            let (own_place, own_path) = places[file];
            let is_inside = own_place == place && own_path.starts_with(path);
            is_inside.then(|| own_path.get(path.len()))?
        };
        for module in places.keys().filter_map(|file| module_of(file)) {
            assert!(listed.contains(module), "{file}: its table has no {module}");
        }
        for (from, to) in &arrows {
            let [Some(user), Some(used)] = [from, to].map(module_of) else { continue };
            let place_of = |module: &String| listed.iter().position(|own| own == module);
            let is_above = user == used || place_of(used) < place_of(user);
            assert!(is_above, "{file}: its table has {used} after {user}, but {from} uses {to}");
        }
    }
    assert!(tables > 5, "{tables} tables say {ORDERED:?}");
}

/// Returns the modules of the first column of a table, several of one row in their order.
fn listed(table: &str) -> Vec<String> {
    let rows = table.lines().map(str::trim).skip_while(|line| !line.starts_with('|'));
    let rows = rows.take_while(|line| line.starts_with('|'));
    let cells = rows.filter_map(|row| row.split('|').nth(1));
    cells.flat_map(|cell| cell.split('`').skip(1).step_by(2).map(str::to_owned)).collect()
}

#[test]
fn made_up_circles_are_found() {
    let circles = |made: &[(&str, &str)]| {
        let files = made.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
        in_circles(&Sources::of(files.collect()).arrows()).len()
    };
    let a = ("src/a.rs", "use crate::b::B;");
    assert_eq!(circles(&[a, ("src/b.rs", "fn f() { super::a::g() }")]), 2);
    assert_eq!(circles(&[a, ("src/b.rs", "use super::{c::C, a};"), ("src/c.rs", "")]), 2);
    // through a third file, and one of another folder
    let through = ("src/c/d.rs", "use super::super::a::A;");
    assert_eq!(circles(&[a, ("src/b.rs", "use crate::c::d::D;"), through, ("src/e.rs", "use crate::a;")]), 3);
    // what a module re-exports is of the file that defines it
    let face = ("src/c/mod.rs", "mod d;\npub(crate) use d::{D, E as F};");
    assert_eq!(circles(&[a, ("src/b.rs", "use crate::c::F;"), through, face]), 3);
    // what it defines is its own; its own files may name that
    let defines = ("src/c/mod.rs", "mod d;\nstruct G;");
    assert_eq!(circles(&[a, ("src/b.rs", "use crate::c::G;"), through, defines]), 0);
    let names_a = ("src/c/mod.rs", "use crate::a::A;\nstruct G;");
    assert_eq!(circles(&[a, ("src/b.rs", "use crate::c::G;"), names_a]), 3);
    assert_eq!(circles(&[("src/c/mod.rs", "use d::D;\nstruct G;"), ("src/c/d.rs", "use super::G;")]), 0);
    // comments and tests do not count
    for quiet in
        ["// use crate::a::A;", "#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}", "use other::a::A;", ""]
    {
        assert_eq!(circles(&[a, ("src/b.rs", quiet)]), 0, "{quiet}");
    }
    // crates do not mix
    assert_eq!(circles(&[a, ("crates/x/src/b.rs", "use crate::a::A;"), ("crates/x/src/a.rs", "")]), 0);
}

/// Returns the arrows between files that stand on a circle, or between circles.
fn in_circles(arrows: &Arrows) -> Arrows {
    let mut left = arrows.clone();
    loop {
        let [users, used]: [BTreeSet<_>; 2] =
            [left.iter().map(|(from, _)| from).collect(), left.iter().map(|(_, to)| to).collect()];
        let both = left.iter().filter(|(from, to)| used.contains(from) && users.contains(to)).cloned();
        let both: Arrows = both.collect();
        if both.len() == left.len() {
            return left;
        }
        left = both;
    }
}

impl Sources {
    /// Keeps the sources of crates among files: names and texts.
    fn of(files: Vec<(String, String)>) -> Self {
        let mut sources = BTreeMap::new();
        for (name, text) in files {
            let at = if name.starts_with("src/") { Some(0) } else { name.find("/src/").map(|at| at + 1) };
            let Some(at) = at.filter(|_| is_product(&name)) else { continue };
            let path = name[at + 4..name.len() - 3].split('/').map(str::to_owned);
            let mut path: Vec<_> = path.collect();
            // a program beside a library is a file of its own
            path.pop_if(|last| ["lib", "mod"].contains(&last.as_str()));
            let head = text.lines().map_while(|line| line.strip_prefix("//!"));
            let (head, code) = (head.flat_map(|line| [line, "\n"]).collect(), code(&text));
            let uses = uses(&code);
            sources.insert((name[..at].to_owned(), path), Source { file: name, head, code, uses });
        }
        Self(sources)
    }

    /// Finds which file imports which. Those of a folder may name what the module of the folder defines.
    fn arrows(&self) -> Arrows {
        let mut arrows = Arrows::new();
        for ((place, path), source) in &self.0 {
            let targets = source.paths().into_iter().filter_map(|named| self.defines(place, path, &named));
            let outside = targets.filter(|target| !path.starts_with(target));
            let to = outside.map(|target| self.0[&(place.clone(), target)].file.clone());
            arrows.extend(to.map(|to| (source.file.clone(), to)));
        }
        arrows
    }

    /// Finds the module that defines what a path names, as seen from another; `None` for other crates.
    fn defines(&self, place: &str, module: &[String], named: &[String]) -> Option<Vec<String>> {
        let (first, mut rest) = named.split_first()?;
        let mut full = module.to_vec();
        match first.as_str() {
            "crate" => full.clear(),
            "self" => {}
            "super" => full.truncate(module.len().checked_sub(1)?),
            _ if self.is_module(place, &[module, &named[..1]].concat()) => rest = named,
            _ => return None,
        }
        while let [first, others @ ..] = rest
            && first == "super"
        {
            full.pop()?;
            rest = others;
        }
        full.extend_from_slice(rest);
        let length = (0..=full.len()).rev().find(|length| self.is_module(place, &full[..*length]))?;
        let (target, names) = full.split_at(length);
        // what a module only hands on, of its own modules
        let uses = &self.0[&(place.to_owned(), target.to_vec())].uses;
        let mut handed_on = uses.iter().filter(|path| path.last() == names.first());
        let exported = handed_on.find_map(|path| {
            let is_deeper = |found: &Vec<String>| found.len() > target.len() && found.starts_with(target);
            self.defines(place, target, &path[..path.len() - 1]).filter(is_deeper)
        });
        Some(exported.unwrap_or_else(|| target.to_vec()))
    }

    fn is_module(&self, place: &str, path: &[String]) -> bool {
        self.0.contains_key(&(place.to_owned(), path.to_vec()))
    }
}

/// Returns whether a file is Rust of a crate, and not of its tests.
pub(crate) fn is_product(name: &str) -> bool {
    let is_test = name.contains("/tests/") || name.ends_with("/tests.rs") || name.starts_with("fuzz/");
    Path::new(name).extension().is_some_and(|found| found == "rs") && !is_test
}

/// Returns a text without comments, and without what is compiled for tests only.
fn code(text: &str) -> String {
    let mut kept = String::new();
    let (mut is_next, mut depth, mut skips) = (false, 0_i32, false);
    for line in text.lines() {
        let bare = line.trim();
        let opened = |line: &str| {
            let count = |letter| i32::try_from(line.matches(letter).count()).expect("a line is short");
            count('{') - count('}')
        };
        if skips {
            depth += opened(line);
            skips = depth > 0 || !line.contains('}');
        } else if bare.starts_with("#[cfg(test)]") || bare.starts_with("#[cfg(all(test") {
            is_next = true;
        } else if is_next && !bare.starts_with("#[") {
            (is_next, depth, skips) = (false, opened(line), !bare.ends_with(';'));
        } else if !is_next && !bare.starts_with("//") {
            kept.push_str(line.split(" // ").next().unwrap_or_default());
            kept.push('\n');
        }
    }
    kept
}

impl Source {
    /// Returns the paths that it names: those of its `use`, and those that begin with `crate` or `super`.
    fn paths(&self) -> Vec<Vec<String>> {
        let mut paths: Vec<_> = self.uses.iter().map(|path| path[..path.len() - 1].to_vec()).collect();
        let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == ':';
        for word in self.code.split(|letter| !is_letter(letter)) {
            let path = word.split("::").filter(|part| !part.is_empty()).map(str::to_owned);
            // what ends with `::` goes on in braces, which `uses` reads
            let is_own = word.starts_with("crate::") || word.starts_with("super::");
            let is_own = is_own && !word.ends_with("::");
            paths.extend(is_own.then(|| path.collect()));
        }
        paths
    }
}

/// Returns what a text uses: each path, and after it the name that it has here.
fn uses(code: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    let mut starts = code.match_indices("use ").map(|(at, _)| at).collect::<Vec<_>>();
    starts.retain(|at| *at == 0 || code[..*at].ends_with(['\n', ' ', '\t', ')']));
    for at in starts {
        let Some((statement, _)) = code[at + 4..].split_once(';') else { continue };
        let statement: String = statement.split_whitespace().collect::<Vec<_>>().join(" ");
        expand(&statement, &mut Vec::new(), &mut found);
    }
    found
}

/// Adds the paths of a tree of them, such as `a::{b, c::D as E}`, after the parts that lead to it.
fn expand(tree: &str, before: &mut Vec<String>, found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let Some((head, body)) = tree.split_once('{') else {
        let (path, own) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut path: Vec<_> =
            before.iter().cloned().chain(path.split("::").map(|part| part.trim().to_owned())).collect();
        path.retain(|part| !part.is_empty());
        let name = if own.is_empty() { path.last().cloned() } else { Some(own.trim().to_owned()) };
        path.extend(name);
        found.extend((path.len() > 1).then_some(path));
        return;
    };
    let length = before.len();
    before.extend(head.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned));
    let (mut depth, mut part) = (0, String::new());
    for letter in body.chars() {
        match letter {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(&std::mem::take(&mut part), before, found);
                continue;
            }
            _ => {}
        }
        part.push(letter);
    }
    if !part.trim().is_empty() {
        expand(&part, before, found);
    }
    before.truncate(length);
}
