//! Tests that every variable of the model description is wired, and that every wired variable is described.

use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_export::VariableId;
use rocking_wall::variables::{BooleanVariable, IntegerVariable, RealVariable};

const XML: &str = "modelDescription/modelDescription.xml";

/// Variables are named in the matches of the unit, which have no `_` arm for what is left over; parameters
/// are fields.
#[test]
fn every_variable_is_named_where_it_is_wired() {
    let read = |file: &str| std::fs::read_to_string(crate::root().join(file)).unwrap();
    let (wiring, fields) = (read("src/unit/model.rs"), read("src/wall/parameters.rs"));
    let real = RealVariable::ALL.iter().map(|variable| (format!("{variable:?}"), variable.variable().name));
    let integer =
        IntegerVariable::ALL.iter().map(|variable| (format!("{variable:?}"), variable.variable().name));
    for (variant, name) in real.chain(integer) {
        let found = wiring.match_indices(&format!("V::{variant}")).any(|(at, found)| {
            !wiring[at + found.len()..].starts_with(|next: char| next.is_alphanumeric() || next == '_')
        });
        assert!(found || fields.contains(&format!("    pub {name}: ")), "{name} is not wired by name");
    }
    assert_eq!(BooleanVariable::ALL.len(), 1);
    assert!(wiring.contains("BooleanVariable::Overturned =>"));
}

/// Compiles the copied library with another description. It takes its dependencies from the build of these
/// tests: the target folder is the same, and with this package selected too, so are their features.
fn check_with(folder: &Path, xml: &str) -> (bool, String) {
    std::fs::write(folder.join(XML), xml).unwrap();
    let output = Command::new(env!("CARGO"))
        .current_dir(folder)
        .args(["check", "--quiet", "--offline", "--lib", "-p", "rocking-wall", "-p", "rocking-wall-cli"])
        .env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap())
        .output()
        .unwrap();
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &target);
        } else {
            std::fs::copy(entry.path(), target).unwrap();
        }
    }
}

fn workspace_copy() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wiring");
    // nothing may stay of an earlier copy
    let _ = std::fs::remove_dir_all(&folder);
    for part in ["src", "crates", "examples", "modelDescription", "xtask", "tests/conformance"] {
        copy(&crate::root().join(part), &folder.join(part));
    }
    // the manifest names these; empty ones suffice
    for file in ["tests/it/main.rs", "tests/allocation.rs", "benches/step.rs", "benches/record.rs"] {
        std::fs::create_dir_all(folder.join(file).parent().unwrap()).unwrap();
        std::fs::write(folder.join(file), "").unwrap();
    }
    for file in ["Cargo.toml", "Cargo.lock", "build.rs", "clippy.toml"] {
        std::fs::copy(crate::root().join(file), folder.join(file)).unwrap();
    }
    folder
}

/// Removing a variable of any kind breaks the build; adding one breaks it until it is wired.
#[test]
fn the_compiler_holds_description_and_code_together() {
    let folder = workspace_copy();
    let original = std::fs::read_to_string(crate::root().join(XML)).unwrap();
    let (builds, message) = check_with(&folder, &original);
    assert!(builds, "{message}");
    // an input, an output, a parameter, a calculated parameter, an enumeration, a Boolean; renamed, so that
    // the indices of the ModelStructure still hold and only the wiring can object
    for (name, variant) in [
        ("drift", "Drift"),
        ("u_ratio", "URatio"),
        ("a1", "A1"),
        ("omega1", "Omega1"),
        ("solver", "Solver"),
        ("overturned", "Overturned"),
    ] {
        let renamed = original.replace(&format!("name=\"{name}\""), &format!("name=\"{name}_renamed\""));
        assert_ne!(renamed, original, "{name} is in the description");
        let (builds, message) = check_with(&folder, &renamed);
        assert!(!builds, "{name} can be removed and another added unnoticed");
        assert!(message.contains(variant), "{name}: {message}");
    }
    std::fs::write(folder.join(XML), original).unwrap();
}
