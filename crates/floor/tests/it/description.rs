//! The documentation and the notices against the description and the build.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use fmu_export::{Kind, Variable, VariableId};
use rocking_floor::variables::{BooleanVariable, IntegerVariable, RealVariable};

const PAGE: &str = include_str!("../../modelDescription/documentation/index.html");
const XML: &str = include_str!("../../modelDescription/modelDescription.xml");

fn variables() -> Vec<&'static Variable> {
    let reals = RealVariable::ALL.iter().map(|variable| variable.variable());
    let choices = IntegerVariable::ALL.iter().map(|variable| variable.variable());
    reals.chain(choices).chain(BooleanVariable::ALL.iter().map(|variable| variable.variable())).collect()
}

#[test]
fn the_documentation_lists_every_variable_with_its_default() {
    for variable in variables() {
        let head = format!("<tr><td><code>{}</code></td>", variable.name);
        assert_eq!(PAGE.matches(&head).count(), 1, "{}", variable.name);
        let row = PAGE.split(&head).nth(1).and_then(|rest| rest.split("</tr>").next()).unwrap_or_default();
        let default = match &variable.kind {
            Kind::Real { start, .. } => start.map(|start| {
                let cell = row.split("<td>").nth(2).unwrap_or_default().trim_end_matches("</td>");
                cell.parse() == Ok(start)
            }),
            Kind::Enumeration { start, items } => start.and_then(|start| {
                let item = items.iter().find(|item| item.value == start)?;
                Some(row.contains(&format!("<td><code>{}</code></td>", item.name)))
            }),
            Kind::Integer { .. } | Kind::Boolean { .. } | Kind::String { .. } => None,
        };
        assert_ne!(default, Some(false), "{}: {row}", variable.name);
        assert!(row.contains(variable.description), "{}: {row}", variable.name);
    }
    assert_eq!(PAGE.matches("<tr><td><code>").count(), variables().len() + 2, "and the two couplings");
    for text in ["http://", "https://", "<script", "<img", "<link", "url("] {
        assert!(!PAGE.contains(text), "{text}");
    }
}

#[test]
fn the_description_is_of_this_version_and_dateless() {
    assert!(XML.contains(&format!("version=\"{}\"", env!("CARGO_PKG_VERSION"))));
    assert!(XML.contains("guid=\"{fingerprint}\"") && !XML.contains("generationDateAndTime="));
    let references: BTreeSet<_> = variables().iter().map(|variable| variable.reference).collect();
    assert!(references.into_iter().eq(1..=48));
}

#[test]
fn every_linked_crate_is_named_in_the_notices() {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--package", "rocking-floor", "--features", "fmu"])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let notices =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("modelDescription/documentation/licenses/notices.txt");
    let notices = std::fs::read_to_string(notices).unwrap();
    let named: BTreeSet<_> = notices.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let tree = String::from_utf8(output.stdout).unwrap();
    let linked: BTreeSet<_> = tree.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(linked.contains("fmu-export") && !linked.contains("rocking-wall"), "{linked:?}");
    for name in linked {
        let own = ["rocking-floor", "fmu-export", "rocking-oscillator"].contains(&name);
        assert!(own || named.contains(name), "notices.txt does not name {name}");
    }
}
