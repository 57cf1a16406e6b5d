//! The notices inside the FMU and the Python package name every crate in them.

use std::collections::BTreeSet;
use std::process::Command;

/// Crates of this workspace.
const OURS: [&str; 14] = [
    "fmu-export",
    "fmu-export-build",
    "ground-motion",
    "rocking-building",
    "rocking-figures",
    "rocking-floor",
    "rocking-oscillator",
    "rocking-playground",
    "rocking-record",
    "rocking-scene-fmu",
    "rocking-study",
    "rocking-study-folder",
    "rocking-wall",
    "rocking-wall-python",
];

/// Crates that programs above the unit link, and the unit must not.
const ABOVE_THE_UNIT: [&str; 10] = [
    "argmin",
    "clap",
    "fearless_simd",
    "kuva",
    "parquet",
    "pyo3",
    "rocking-building",
    "rocking-record",
    "rocking-study",
    "serde_json",
];

/// The crates that a package links.
fn crates(package: &[&str]) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .current_dir(crate::root())
        .args(["tree", "--offline", "--locked", "--edges", "normal,no-proc-macro"])
        .args(["--prefix", "none", "--format", "{p} {l}", "--package"])
        .args(package)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    tree.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}

/// Checks that a file names crates.
fn check_names(crates: &BTreeSet<String>, notices: &str) {
    let text = std::fs::read_to_string(crate::root().join(notices)).unwrap();
    let named: BTreeSet<_> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for name in crates {
        assert!(
            OURS.contains(&name.as_str()) || named.contains(name.as_str()),
            "{notices} does not name {name}"
        );
    }
}

#[test]
fn every_linked_crate_is_named() {
    let crates = crates(&["rocking-wall", "--features", "fmu"]);
    check_names(&crates, "modelDescription/documentation/licenses/notices.txt");
    assert!(crates.contains("nalgebra"), "{crates:?}");
    let locked = std::fs::read_to_string(crate::root().join("Cargo.lock")).unwrap();
    for other in ABOVE_THE_UNIT {
        assert!(locked.contains(&format!("\nname = \"{other}\"\n")), "nothing here links {other}");
        assert!(!crates.contains(other), "the unit links {other}");
    }
}

#[test]
fn every_crate_in_the_python_package_is_named() {
    let crates = crates(&["rocking-wall-python"]);
    check_names(&crates, "crates/python/licenses/notices.txt");
    assert!(crates.contains("pyo3") && !crates.contains("rocking-wall-cli"), "{crates:?}");
}

#[test]
fn every_crate_in_the_page_that_computes_is_named() {
    let crates = crates(&["rocking-playground", "--target", "wasm32-unknown-unknown"]);
    check_names(&crates, "crates/playground/src/page/notices.txt");
}
