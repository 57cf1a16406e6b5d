//! Every formula within its bound, and a planted error.

use evidence::Comparison;
use evidence::verification::verify;
use scene::Scene;

use crate::root;

#[test]
fn every_formula_is_within_its_bound() {
    let formulas = verify().unwrap();
    let numbers: Vec<_> = formulas.iter().flat_map(|formula| &formula.comparisons).collect();
    for number in &numbers {
        let part = number.error() / number.allowed;
        println!("{:<24}{:<24}{part:.1e} of {:.0e}", number.case, number.quantity, number.allowed);
        assert!(number.passes(), "{number:?}");
    }
    assert!(formulas.len() >= 28 && numbers.len() >= 130, "{} formulas, {}", formulas.len(), numbers.len());
    let model = std::fs::read_to_string(root().join("docs/model.md")).unwrap();
    let anchor =
        |line: &str| line.trim_start_matches('#').trim().to_lowercase().replace('/', "").replace(' ', "-");
    for formula in &formulas {
        assert!(model.lines().any(|line| anchor(line) == formula.section), "{}", formula.section);
    }
}

/// A number that is off by ten times its bound, or not a number, fails.
#[test]
fn a_wrong_number_fails() {
    for formula in verify().unwrap() {
        for number in formula.comparisons {
            let off = number.computed + 10.0 * number.allowed * number.scale;
            for computed in [off, f64::NAN, f64::INFINITY] {
                assert!(!Comparison { computed, ..number.clone() }.passes(), "{number:?}");
            }
        }
    }
}

/// Scenes named like a reference case are that case.
#[test]
fn cases_are_those_of_the_tests() {
    let mut compared = 0;
    for (name, text) in verify().unwrap().iter().flat_map(|formula| &formula.scenes) {
        let file = root().join(format!("tests/data/cases/{name}.toml"));
        let Ok(case) = Scene::read(&file) else { continue };
        let scene = Scene::parse(name, text, root()).unwrap();
        assert_eq!(scene.parameters, case.parameters, "{name}");
        assert_eq!(format!("{:?}", scene.excitation), format!("{:?}", case.excitation));
        compared += 1;
    }
    assert_eq!(compared, 12);
}

/// The formulas have the coefficient of every damping model, and the ratio that e predicts.
#[test]
fn every_damping_model_is_verified() {
    let formulas = include_str!("../../src/verification/formulas.toml");
    for model in run::model::damping_models() {
        let scenes = formulas.matches(&format!("damping_model = {:?}", model.name())).count();
        let name = model.name();
        assert!(scenes >= 2, "formulas.toml: add scenes damped_ and ratio_ of {name}, in references.py too");
    }
}
