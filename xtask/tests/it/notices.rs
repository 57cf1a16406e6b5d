//! The notices inside the FMU and the Python package name every crate in them.

use std::collections::BTreeSet;

use crate::{cargo, read};

/// Crates that programs above the unit link, and the unit must not.
const ABOVE_THE_UNIT: [&str; 17] = [
    "argmin",
    "clap",
    "fearless_simd",
    "parquet",
    "pyo3",
    "rocking-building",
    "rocking-check",
    "rocking-evidence",
    "rocking-files",
    "rocking-fragility",
    "rocking-record",
    "rocking-reliability",
    "rocking-run",
    "rocking-scene",
    "rocking-study",
    "serde_json",
    "toml",
];

/// The crates that a package links: those of this workspace, and others.
fn crates(package: &[&str]) -> [BTreeSet<String>; 2] {
    // not `--offline`: the crates of another target are fetched where nobody has built for it
    let tree = ["tree", "--locked", "--edges", "normal,no-proc-macro", "--prefix", "none", "--package"];
    let tree = cargo(&tree, package);
    let root = crate::root().canonicalize().unwrap().display().to_string();
    let (ours, others): (Vec<_>, Vec<_>) = tree.lines().partition(|line| line.contains(&root));
    let names = |lines: Vec<&str>| {
        lines.iter().filter_map(|line| line.split(' ').next()).map(str::to_owned).collect()
    };
    [names(ours), names(others)]
}

/// Checks that a file names crates.
fn check_names(crates: &BTreeSet<String>, notices: &str) {
    let text = read(notices);
    let named: BTreeSet<_> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for name in crates {
        assert!(named.contains(name.as_str()), "{notices} does not name {name}");
    }
}

#[test]
fn every_linked_crate_is_named() {
    let [ours, others] = crates(&["rocking-floor-fmu"]);
    check_names(&others, "crates/floor/modelDescription/documentation/licenses/license.txt");
    assert!(ours.contains("fmu-export") && !ours.contains("rocking-wall"), "{ours:?}");
    let [ours, others] = crates(&["rocking-wall-fmu"]);
    check_names(&others, "modelDescription/documentation/licenses/license.txt");
    assert!(others.contains("nalgebra") && ours.contains("ground-motion"), "{ours:?}, {others:?}");
    let locked = read("Cargo.lock");
    for other in ABOVE_THE_UNIT {
        assert!(locked.contains(&format!("\nname = \"{other}\"\n")), "nothing here links {other}");
        assert!(!ours.contains(other) && !others.contains(other), "the unit links {other}");
    }
}

#[test]
fn every_crate_in_the_component_is_named() {
    for (package, folder) in [("rocking-wall-fmu", ""), ("rocking-floor-fmu", "crates/floor/")] {
        let [_, others] = crates(&[package, "--target", "wasm32-wasip2"]);
        check_names(&others, &format!("{folder}modelDescription/documentation/licenses/license.txt"));
        assert!(others.contains("wit-bindgen"), "{others:?}");
    }
}

#[test]
fn every_crate_in_the_python_package_is_named() {
    let [ours, others] = crates(&["rocking-wall-python"]);
    check_names(&others, "crates/python/licenses/notices.txt");
    assert!(others.contains("pyo3") && !ours.contains("rocking-wall-cli"), "{ours:?}, {others:?}");
}

#[test]
fn every_crate_in_the_playground_is_named() {
    let [_, others] = crates(&["rocking-playground", "--target", "wasm32-unknown-unknown"]);
    check_names(&others, "crates/playground/src/page/notices.txt");
    assert!(others.contains("toml"), "{others:?}");
}
