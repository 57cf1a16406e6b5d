//! Tests `wall verify formulas`, and that `docs/verification.md` is its manual.

use std::fs;

use crate::command_line::{assert_has, content, folder, json, printed, text, wall};
use crate::root;

#[test]
fn the_manual_is_that_of_the_program() {
    let folder = folder("verify");
    let table = printed(&folder, &["verify", "formulas", "--markdown", "manual.md", "--html", "manual.html"]);
    assert!(table.contains(" 0 FAIL") && !table.contains(" FAIL\n"), "{table}");
    assert!(table.lines().filter(|line| line.ends_with("  PASS")).count() >= 130, "{table}");
    let manual = content(&folder, "manual.md");
    let document = fs::read_to_string(root().join("docs/verification.md")).unwrap();
    let remedy = "docs/verification.md: run cargo xtask figures --verification";
    assert!(document.contains(&format!("<!-- formulas -->\n\n{manual}<!-- end formulas -->")), "{remedy}");
    let page = content(&folder, "manual.html");
    let titles: Vec<_> = manual.lines().filter_map(|line| line.strip_prefix("### ")).collect();
    assert!(titles.len() >= 28);
    assert!(titles.iter().all(|title| page.contains(&format!("<h2>{title}</h2>"))));
}

#[test]
fn results_are_also_json() {
    let value = json(&folder("verify_json"), &["verify", "formulas", "--json"]);
    assert_eq!(value["failed"], 0);
    let of_formula = |formula: &serde_json::Value| formula["checks"].as_array().unwrap().clone();
    let checks: Vec<_> = value["formulas"].as_array().unwrap().iter().flat_map(of_formula).collect();
    assert_eq!(value["passed"], checks.len());
    for check in checks {
        let number = |name: &str| check[name].as_f64().unwrap();
        let error = (number("computed") - number("reference")).abs() / number("scale");
        assert!(error <= number("bound") && error == number("error"), "{check}");
    }
}

#[test]
fn the_help_names_what_can_be_verified() {
    let told = wall(&folder("verify_help"), &["verify"]);
    assert_has(&text(&told.stderr), &["formulas", "tests", "paper", "accuracy", "stability"]);
    assert_eq!((told.code, told.stdout.len()), (2, 0));
}
