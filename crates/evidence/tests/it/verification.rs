//! Every formula within its bound, references that are those of the reference cases, and a planted error.

use evidence::verification::{Quantity, VerificationError, library, verify, verify_scenes};
use rocking_wall::scene::Scene;

use crate::root;

#[test]
fn every_formula_is_within_its_bound() {
    let formulas = verify(library).unwrap();
    let checks: Vec<_> = formulas.iter().flat_map(|formula| &formula.checks).collect();
    for check in &checks {
        let part = check.error().unwrap() / check.bound;
        println!("{:<24}{:<24}{part:.1e} of {:.0e}", check.case, check.quantity, check.bound);
        assert!(check.passes(), "{check:?}");
    }
    assert!(formulas.len() >= 28 && checks.len() >= 130, "{} formulas, {}", formulas.len(), checks.len());
    let model = std::fs::read_to_string(root().join("docs/model.md")).unwrap();
    let anchor =
        |line: &str| line.trim_start_matches('#').trim().to_lowercase().replace('/', "").replace(' ', "-");
    for formula in &formulas {
        assert!(model.lines().any(|line| anchor(line) == formula.section), "{}", formula.section);
    }
}

/// A formula that is off by 1e-6, or not a number, fails. A number that is missing does not.
#[test]
fn a_wrong_number_fails() {
    let failures = |change: fn(f64) -> Option<f64>| {
        let values = |scene: &Scene, quantities: &[Quantity]| {
            let values = library(scene, quantities)?;
            Ok::<_, VerificationError>(values.into_iter().map(|value| change(value?)).collect())
        };
        let formulas = verify_scenes(values).unwrap();
        let checks = formulas.iter().flat_map(|formula| formula.checks.clone());
        checks.fold([0, 0], |[all, failed], check| [all + 1, failed + usize::from(!check.passes())])
    };
    let [all, failed] = failures(|value| Some(value + 1e-6 * value.abs().max(1.0)));
    assert_eq!(all, failed);
    let [all, failed] = failures(|_| Some(f64::NAN));
    assert_eq!(all, failed);
    assert_eq!(failures(|_| None)[1], 0);
}

/// Scenes named like a reference case are that case.
#[test]
fn cases_are_those_of_the_tests() {
    let mut compared = 0;
    let values = |scene: &Scene, quantities: &[Quantity]| {
        let file = root().join(format!("tests/data/cases/{}.toml", scene.title.replace(' ', "_")));
        if file.is_file() {
            let case = Scene::read(&file).unwrap();
            assert_eq!(scene.parameters, case.parameters, "{}", scene.title);
            assert_eq!(format!("{:?}", scene.excitation), format!("{:?}", case.excitation));
            compared += 1;
        }
        Ok::<_, VerificationError>(vec![None; quantities.len()])
    };
    verify_scenes(values).unwrap();
    assert_eq!(compared, 12);
}
