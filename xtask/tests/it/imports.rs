//! Tests that imports within a crate point one way; between crates Cargo sees to that.

use std::path::Path;

/// Crates, and their modules from the ground up: none names a later one.
const LAYERS: [(&str, &[&str]); 2] = [
    ("src", &["choices", "wall", "variables", "solver", "simulation", "scene", "response", "unit"]),
    ("crates/wall-cli/src", &["output", "args", "commands"]),
];

#[test]
fn no_layer_names_a_later_one() {
    for (folder, layers) in LAYERS {
        for (index, layer) in layers.iter().enumerate() {
            let texts = texts(&crate::root().join(folder), layer);
            // `lib.rs` includes these two as they are generated
            let is_generated = ["choices", "variables"].contains(layer);
            assert!(!texts.is_empty() || is_generated, "there is no {folder}/{layer}");
            for (file, text) in texts {
                for later in &layers[index + 1..] {
                    assert!(!names(&text, later), "{file} names {later}, which stands above {layer}");
                }
            }
        }
    }
}

#[test]
fn a_planted_name_is_found() {
    for found in ["use crate::unit::Unit;", "fn f() { crate::unit::f() }", "use crate::unit;"] {
        assert!(names(found, "unit"), "{found}");
    }
    for quiet in ["// use crate::unit::Unit;", "use crate::units::Unit;", "use fmu::unit::Unit;"] {
        assert!(!names(quiet, "unit"), "{quiet}");
    }
    assert!(std::panic::catch_unwind(|| names("use crate::{unit::Unit};", "unit")).is_err());
}

/// Returns whether code names a module of its own crate.
fn names(text: &str, module: &str) -> bool {
    let code = text.lines().filter_map(|line| line.split("//").next());
    code.flat_map(|line| line.split("crate::").skip(1)).any(|rest| {
        assert!(!rest.starts_with('{'), "crate::{rest}: write one `use` for each module");
        rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next() == Some(module)
    })
}

/// The files of a module, with their texts.
fn texts(folder: &Path, module: &str) -> Vec<(String, String)> {
    let mut texts = Vec::new();
    let mut paths = vec![folder.join(module), folder.join(module).with_extension("rs")];
    while let Some(path) = paths.pop() {
        if path.is_dir() {
            paths.extend(std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.is_file() {
            texts.push((path.display().to_string(), std::fs::read_to_string(&path).unwrap()));
        }
    }
    texts
}
