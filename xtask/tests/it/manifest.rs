//! What the manifests promise: metadata for a registry, walls between crates, the minimum Rust version.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::tidy::files;
use crate::{cargo, read};

/// The packages that cargo knows of, with `--no-deps` those of the workspace.
fn packages(arguments: &[&str]) -> Vec<Value> {
    let metadata = cargo(&["metadata", "--format-version", "1", "--locked"], arguments);
    let metadata: Value = serde_json::from_str(&metadata).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// Major and minor number of a version such as 1.89 or 1.89.0.
fn minor(version: &str) -> (u32, u32) {
    let mut numbers = version.split('.').map(|number| number.parse().unwrap());
    (numbers.next().unwrap(), numbers.next().unwrap())
}

#[test]
fn no_dependency_needs_a_newer_rust_than_the_project_states() {
    let packages = packages(&[]);
    let wall = packages.iter().find(|package| package["name"] == "rocking-wall").unwrap();
    let stated = wall["rust_version"].as_str().unwrap();
    let mut compared = 0;
    for package in &packages {
        if let Some(needed) = package["rust_version"].as_str() {
            compared += 1;
            assert!(minor(needed) <= minor(stated), "{} needs Rust {needed}", package["name"]);
        }
    }
    assert!(2 * compared > packages.len(), "{compared} of {} packages state a version", packages.len());
    let workflow = read(".github/workflows/ci.yml");
    assert!(workflow.contains(&format!("cargo +{stated} check")), "the workflow checks another version");
}

#[test]
fn versions_agree() {
    let version = env!("CARGO_PKG_VERSION");
    for package in packages(&["--no-deps"]) {
        assert_eq!(package["version"], version, "{}", package["name"]);
        for dependency in package["dependencies"].as_array().unwrap() {
            let is_ours = dependency["path"].is_string();
            let stated = dependency["req"].as_str().unwrap();
            assert!(!is_ours || [format!("^{version}").as_str(), "*"].contains(&stated), "{dependency}");
        }
    }
    for name in ["modelDescription", "crates/floor/modelDescription"] {
        let description = read(&format!("{name}/modelDescription.xml"));
        assert!(description.contains(&format!("\n  version=\"{version}\"\n")), "{name}");
    }
    let changelog = read("CHANGELOG.md");
    let newest = changelog.lines().find_map(|line| line.strip_prefix("## ")).unwrap();
    assert!(newest == "Unreleased" || newest.starts_with(&format!("{version} – ")), "CHANGELOG.md: {newest}");
    let citation = read("CITATION.cff");
    assert!(citation.contains(&format!("\nversion: {version}\n")), "CITATION.cff has another version");
    let date = changelog.split(&format!("\n## {version} – ")).nth(1).and_then(|rest| rest.lines().next());
    let date = date.unwrap_or_else(|| panic!("CHANGELOG.md does not know {version}"));
    assert!(citation.contains(&format!("\ndate-released: {date}\n")), "CITATION.cff: not of {date}");
}

/// The tests of each crate are built, by the crate or by the package of the tests.
#[test]
fn every_program_of_tests_is_built() {
    let canonical = |path: &Path| path.canonicalize().unwrap();
    let packages = packages(&["--no-deps"]);
    let targets = packages.iter().flat_map(|package| package["targets"].as_array().unwrap());
    let built: BTreeSet<_> =
        targets.map(|target| canonical(Path::new(target["src_path"].as_str().unwrap()))).collect();
    let mut found = 0;
    for (name, _) in files() {
        if let ["crates", _, "tests", _, "main.rs"] = name.split('/').collect::<Vec<_>>()[..] {
            assert!(built.contains(&canonical(&crate::root().join(&name))), "no package builds {name}");
            found += 1;
        }
    }
    assert!(found > 9, "{found}");
}

/// A target whose manifest says `test = false` has no test that would not run.
#[test]
fn no_test_stands_where_none_is_built() {
    let mut compared = 0;
    for package in packages(&["--no-deps"]) {
        for target in package["targets"].as_array().unwrap() {
            let kinds = target["kind"].as_array().unwrap();
            let is_source =
                kinds.iter().any(|kind| ["lib", "rlib", "cdylib", "bin"].iter().any(|own| kind == own));
            if !is_source || target["test"] == true {
                continue;
            }
            compared += 1;
            let head = Path::new(target["src_path"].as_str().unwrap());
            let own = if head.ends_with("lib.rs") { head.parent().unwrap() } else { head };
            let found =
                Command::new("git").args(["grep", "-l", "-F", "#[test]", "--"]).arg(own).output().unwrap();
            let found = String::from_utf8(found.stdout).unwrap();
            assert!(found.is_empty(), "these tests do not run: {found}");
        }
    }
    assert!(compared > 5, "{compared} targets");
}

/// The project has no public home yet: its address is a placeholder.
#[test]
fn the_address_of_the_repository_stands_in_one_place() {
    let root = read("Cargo.toml");
    let address = root.lines().find_map(|line| line.strip_prefix("repository = ")).unwrap().trim_matches('"');
    let list =
        Command::new("git").args(["grep", "-l", "-F", "-e", address]).current_dir(crate::root()).output();
    let list = String::from_utf8(list.unwrap().stdout).unwrap();
    assert_eq!(list.lines().collect::<Vec<_>>(), ["Cargo.toml"]);
}

/// `codemeta.json` says what `Cargo.toml` and `CITATION.cff` say.
#[test]
fn the_metadata_of_the_software_agree_with_the_manifest_and_the_citation() {
    let metadata: Value = serde_json::from_str(&read("codemeta.json")).unwrap();
    let text = |key: &str| metadata[key].as_str().unwrap_or_else(|| panic!("codemeta.json has no {key}"));
    let manifest = read("Cargo.toml");
    for (key, of_cargo) in [("name", "name"), ("description", "description"), ("version", "version")] {
        let line = format!("{of_cargo} = {:?}\n", text(key));
        assert!(manifest.contains(&line), "codemeta.json: Cargo.toml has no {line}");
    }
    let rust = text("runtimePlatform").strip_prefix("Rust ").unwrap();
    assert!(manifest.contains(&format!("rust-version = {rust:?}\n")), "codemeta.json: Rust {rust}");
    let citation = read("CITATION.cff");
    let lists = metadata["keywords"].as_array().unwrap().iter().map(|word| ("  - ", word));
    let licences = metadata["license"].as_array().unwrap().iter().map(|word| ("  - ", word));
    let people = metadata["referencePublication"]["author"].as_array().unwrap().iter();
    let people = people.map(|person| ("    - family-names: ", &person["familyName"]));
    let fields = [
        ("date-released: ", &metadata["datePublished"]),
        ("  - name: ", &metadata["author"][0]["name"]),
        ("  title: ", &metadata["referencePublication"]["name"]),
    ];
    let mut found = 0;
    for (key, value) in fields.into_iter().chain(lists).chain(licences).chain(people) {
        let value = value.as_str().unwrap().trim_start_matches("https://spdx.org/licenses/");
        assert!(citation.contains(&format!("\n{key}{value}\n")), "codemeta.json: {key}{value}");
        found += 1;
    }
    assert_eq!(found, 3 + citation.matches("\n  - ").count() - 1 + citation.matches("family-names").count());
}

#[test]
fn every_crate_has_what_a_registry_shows() {
    let kept = read("xtask/src/release.rs");
    let kept = kept.split("const KEPT").nth(1).unwrap().split("];").next().unwrap();
    for package in packages(&["--no-deps"]) {
        let name = package["name"].as_str().unwrap();
        let is_published = package["publish"].is_null();
        assert_eq!(kept.contains(&format!("\"{name}\"")), !is_published, "{name} in xtask/src/release.rs");
        if !is_published {
            continue;
        }
        for key in ["description", "license", "repository", "rust_version"] {
            assert!(package[key].is_string(), "{name} has no {key}");
        }
        for (key, longest) in [("keywords", 20), ("categories", usize::MAX)] {
            let words = package[key].as_array().unwrap();
            let are_short = words.iter().all(|word| word.as_str().unwrap().len() <= longest);
            assert!((1..=5).contains(&words.len()) && are_short, "{name}: {key} {words:?}");
        }
        assert!(package["metadata"]["docs"]["rs"]["targets"].is_array(), "{name} says nothing to docs.rs");
        let folder = Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap();
        assert_eq!(package["readme"], "README.md", "{name} shows another page");
        let page = std::fs::read_to_string(folder.join("README.md")).unwrap();
        assert!(page.starts_with(&format!("# {name}\n")), "{name}: README.md is not its own");
        for licence in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert!(folder.join(licence).is_file(), "{name} has no {licence}");
        }
    }
}

/// What each crate may know of the others.
const KNOWN: [(&str, &str); 24] = [
    ("fmu-export", ""),
    ("fmu-component", "fmu-export"),
    ("fmu-export-build", "fmu-export"),
    ("rocking-oscillator", ""),
    ("rocking-report", ""),
    ("ground-motion", "rocking-oscillator"),
    ("rocking-files", "ground-motion"),
    ("rocking-floor", "fmu-export rocking-oscillator"),
    ("rocking-floor-fmu", "fmu-component fmu-export rocking-floor"),
    ("rocking-wall", "fmu-export ground-motion rocking-oscillator"),
    ("rocking-wall-fmu", "fmu-component fmu-export rocking-wall"),
    ("rocking-scene", "fmu-export ground-motion rocking-files rocking-wall"),
    ("rocking-record", "rocking-oscillator rocking-wall"),
    ("rocking-run", "ground-motion rocking-files rocking-record rocking-report rocking-scene rocking-wall"),
    ("rocking-fragility", "rocking-files rocking-report rocking-run"),
    (
        "rocking-check",
        "ground-motion rocking-files rocking-record rocking-report rocking-run rocking-scene rocking-wall",
    ),
    (
        "rocking-study",
        "fmu-export ground-motion rocking-files rocking-fragility rocking-record rocking-report \
         rocking-run rocking-scene rocking-wall",
    ),
    (
        "rocking-reliability",
        "ground-motion rocking-check rocking-files rocking-fragility rocking-report rocking-run \
         rocking-scene rocking-study rocking-wall",
    ),
    ("rocking-scene-fmu", "fmu-export-build ground-motion rocking-scene rocking-wall"),
    (
        "rocking-building",
        "fmu-export fmu-export-build ground-motion rocking-files rocking-floor rocking-report rocking-run \
         rocking-scene rocking-scene-fmu rocking-wall",
    ),
    (
        "rocking-evidence",
        "ground-motion rocking-check rocking-files rocking-fragility rocking-record rocking-report \
         rocking-run rocking-scene rocking-study rocking-wall",
    ),
    (
        "rocking-playground",
        "fmu-export ground-motion rocking-check rocking-fragility rocking-report rocking-run \
         rocking-scene rocking-study rocking-wall",
    ),
    (
        "rocking-wall-python",
        "fmu-export ground-motion rocking-building rocking-check rocking-evidence rocking-files \
         rocking-record rocking-reliability rocking-report rocking-run rocking-scene rocking-scene-fmu \
         rocking-study rocking-wall",
    ),
    (
        "rocking-wall-cli",
        "fmu-export-build ground-motion rocking-building rocking-check rocking-evidence rocking-files \
         rocking-reliability rocking-report rocking-run rocking-scene rocking-scene-fmu rocking-study \
         rocking-wall",
    ),
];

/// Crates know what the table says; Cargo holds them to it.
#[test]
fn arrows_between_crates_point_one_way() {
    let ours = packages(&["--no-deps"]);
    for package in &ours {
        let name = package["name"].as_str().unwrap();
        let Some((_, allowed)) = KNOWN.iter().find(|(known, _)| *known == name) else {
            assert!(
                ["xtask", "conformance", "bouncing-ball", "rocking-wall-tests"].contains(&name),
                "{name} is not in the list of what crates know"
            );
            continue;
        };
        for dependency in package["dependencies"].as_array().unwrap() {
            let other = dependency["name"].as_str().unwrap();
            if dependency["kind"].is_null() && ours.iter().any(|ours| ours["name"] == other) {
                assert!(allowed.split(' ').any(|known| known == other), "{name} knows {other}");
            }
        }
    }
    for (name, _) in KNOWN {
        assert!(ours.iter().any(|package| package["name"] == name), "there is no crate {name}");
    }
}

/// Crates and their features behind a `|`, as cargo builds them.
fn built(arguments: &[&str]) -> BTreeSet<String> {
    let tree = ["tree", "--locked", "--prefix", "none", "--format", "{p}|{f}"];
    cargo(&tree, arguments).lines().map(str::to_owned).collect()
}

/// What cargo has built for the Rust tests it takes for the wheel, unless a feature differs somewhere below.
#[test]
fn the_wheel_takes_what_the_tests_have_built() {
    let packages = ["--workspace", "--exclude", "fmu-component", "--exclude", "conformance"];
    let tests = built(&[&packages[..], &["--edges", "normal,build,dev"]].concat());
    let wheel = built(&["--package", "rocking-wall-python", "--edges", "normal,build"]);
    let name = |line: &str| line.split('|').next().map(str::to_owned);
    let shared = wheel.iter().filter(|line| tests.iter().any(|other| name(other) == name(line)));
    let (same, other): (Vec<_>, Vec<_>) = shared.partition(|line| tests.contains(*line));
    assert!(other.is_empty(), "the tests build these with other features: {other:?}");
    assert!(same.len() > 50, "{same:?}");
}

/// Crates outside the workspace have locks of their own, which builds with `--locked` refuse once a crate of
/// the workspace has other dependencies. `cargo metadata --manifest-path fuzz/Cargo.toml` mends one.
#[test]
fn other_locks_have_the_dependencies_of_today() {
    for lock in ["fuzz/Cargo.lock", "tests/peers/Cargo.lock"] {
        let text = read(lock);
        let mut compared = 0;
        for package in packages(&["--no-deps"]) {
            let name = package["name"].as_str().unwrap();
            let Some((_, locked)) = text.split_once(&format!("\nname = \"{name}\"\n")) else { continue };
            let locked = locked.split("[[package]]").next().unwrap();
            // a name, and a version where there are several
            let listed = locked.lines().filter_map(|line| line.trim().strip_prefix('"'));
            let locked: BTreeSet<_> = listed.map(|line| line.split(['"', ' ']).next().unwrap()).collect();
            let dependencies = package["dependencies"].as_array().unwrap();
            let declared = dependencies.iter().filter(|dependency| dependency["kind"] != "dev");
            let names = |optional: bool| {
                let chosen = declared.clone().filter(move |one| optional || one["optional"] == false);
                chosen.map(|dependency| dependency["name"].as_str().unwrap()).collect::<BTreeSet<_>>()
            };
            assert!(names(false).is_subset(&locked), "{lock}: {name} lacks some of {:?}", names(false));
            assert!(locked.is_subset(&names(true)), "{lock}: {name} has more than {:?}", names(true));
            compared += 1;
        }
        assert!(compared > 3, "{lock}: {compared} packages");
    }
}
