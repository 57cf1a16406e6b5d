//! Tests that types have names: no parameter is a tuple, and no name is looked up by a number.

use crate::imports::is_product;
use crate::tidy::files;

/// The functions that Python calls with its own tuples.
const OPEN: [&str; 1] = ["crates/python/src/"];

#[test]
fn no_parameter_is_a_tuple() {
    let mut seen = 0;
    for (name, text) in sources() {
        let found = with_tuples(&text);
        assert!(found.is_empty(), "{name}: {found:?} take tuples: give the type a name, or take its parts");
        seen += signatures(&text).count();
    }
    assert!(seen > 1000, "{seen} signatures");
    for found in
        ["fn f((a, b): (f64, f64)) {", "fn f<T>(x: &'a (T, u8), y: f64) -> T;", "fn f(x: &mut (A, B)) {"]
    {
        assert_eq!(with_tuples(found), ["f"], "{found}");
    }
    for quiet in [
        "fn f([a, b]: [f64; 2]) -> (f64, f64) {",
        "fn f(all: &[(f64, f64)], g: impl Fn((f64, f64)) -> f64, h: (f64)) {",
        "fn f(Pair { a, b }: Pair) { let x: (f64, f64) = (a, b); }",
    ] {
        assert!(with_tuples(quiet).is_empty(), "{quiet}");
    }
}

/// A name that a list gives by the number of a variant is that of another variant once one is added between.
#[test]
fn no_name_is_looked_up_by_the_number_of_a_variant() {
    for (name, text) in sources() {
        assert!(
            !text.contains("][self as usize]"),
            "{name}: a list indexed by `self as usize`: write a match"
        );
    }
}

/// Returns the sources of the crates, but for those functions.
fn sources() -> impl Iterator<Item = (String, String)> {
    let is_source = |name: &str| is_product(name) && (name.starts_with("src/") || name.contains("/src/"));
    let is_open = |name: &str| OPEN.iter().any(|room| name.starts_with(room));
    files().into_iter().filter(move |(name, _)| is_source(name) && !is_open(name))
}

/// Returns the names and the parameters of the functions of a text.
fn signatures(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split("fn ").skip(1).filter_map(|rest| {
        let name = rest.split(['<', '(']).next().filter(|name| !name.is_empty())?;
        // generic parameters may have brackets of their own
        let (mut depth, mut start) = (0_i32, None);
        for (at, letter) in rest.char_indices() {
            match letter {
                '<' if start.is_none() => depth += 1,
                '>' if start.is_none() && !rest[..at].ends_with('-') => depth -= 1,
                '(' if depth == 0 && start.is_none() => (depth, start) = (1, Some(at + 1)),
                '(' => depth += 1,
                ')' if depth == 1 && start.is_some() => return Some((name, &rest[start?..at])),
                ')' => depth -= 1,
                '{' | ';' if start.is_none() => return None,
                _ => {}
            }
        }
        None
    })
}

/// Returns the names of the functions of a text that have a parameter whose type is a tuple.
fn with_tuples(text: &str) -> Vec<&str> {
    let is_tuple = |parameter: &&str| {
        let kind = type_of(parameter).trim_start_matches('&');
        let lifetime = kind.strip_prefix('\'').and_then(|kind| kind.split_once(' '));
        let kind = lifetime.map_or(kind, |(_, kind)| kind).trim_start_matches("mut ");
        let inner = kind.strip_prefix('(').and_then(|kind| kind.strip_suffix(')'));
        inner.is_some_and(|inner| parts(inner).len() > 1)
    };
    let found = signatures(text).filter(|(_, parameters)| parts(parameters).iter().any(is_tuple));
    found.map(|(name, _)| name).collect()
}

/// Returns the type of a parameter: what follows its pattern.
fn type_of(parameter: &str) -> &str {
    let mut depth = 0_i32;
    for (at, letter) in parameter.char_indices() {
        match letter {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            ':' if depth == 0 => return parameter[at + 1..].trim(),
            _ => {}
        }
    }
    ""
}

/// Returns what stands between the commas of a list, without those in brackets.
fn parts(list: &str) -> Vec<&str> {
    let (mut parts, mut depth, mut start) = (Vec::new(), 0_i32, 0);
    for (at, letter) in list.char_indices() {
        match letter {
            '(' | '[' | '{' | '<' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '>' if !list[..at].ends_with(['-', '=']) => depth -= 1,
            ',' if depth == 0 => {
                parts.push(list[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(list[start..].trim());
    parts.retain(|part| !part.is_empty());
    parts
}
