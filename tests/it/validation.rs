//! Tests the comparison with published tests, and that `docs/validation.md` shows it.

use std::fs;
use std::path::Path;

use rocking_wall::wall::{Parameters, Wall};
use study::validation::{Case, Decay, DecayComparison, Push, PushComparison, Test};

use crate::command_line::{folder, refused, text, wall};
use crate::root;

fn case(name: &str) -> Case {
    Case::read(&root().join("tests/data/validation").join(name)).unwrap()
}

fn pushed() -> (Push, PushComparison) {
    let case = case("brick_wall_12.toml");
    let Test::Push(push) = case.test else { panic!("not a push") };
    let comparison = push.compare(&case.parameters).unwrap();
    (push, comparison)
}

fn released() -> (Parameters, Decay, DecayComparison) {
    let case = case("brick_wall_11.toml");
    let Test::Decay(decay) = case.test else { panic!("not a decay") };
    let comparison = decay.compare(&case.parameters).unwrap();
    (case.parameters, decay, comparison)
}

#[track_caller]
fn assert_rounded(found: &[f64], expected: &[f64], half: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= half, "{found} for {expected}");
    }
}

/// The document and its pictures are those of this program.
#[test]
fn the_document_shows_what_the_program_computes() {
    let document = fs::read_to_string(root().join("docs/validation.md")).unwrap();
    let folder = folder("validation");
    let mut cases = 0;
    for entry in fs::read_dir(root().join("tests/data/validation")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        cases += 1;
        let name = path.file_stem().unwrap().to_str().unwrap();
        let output = wall(&folder, &["validate", path.to_str().unwrap(), "--plot", "plot.svg"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let table = text(&output.stdout);
        let remedy = "run cargo xtask figures --validation";
        assert!(document.contains(table.trim_matches('\n')), "{name}: {remedy}\n{table}");
        assert!(document.contains(&format!("images/{name}.svg")), "{name}");
        let drawn = fs::read_to_string(folder.join("plot.svg")).unwrap();
        let kept = fs::read_to_string(root().join(format!("docs/images/{name}.svg"))).unwrap();
        assert!(drawn == kept, "docs/images/{name}.svg: {remedy}");
    }
    assert_eq!(cases, 2);
}

/// Strength, the largest force, and the points over the rigid line, computed by hand from the points.
#[test]
fn the_push_has_its_numbers() {
    let (push, comparison) = pushed();
    assert_rounded(&[comparison.strength, comparison.instability], &[0.146_667, 1.0], 5e-7);
    let largest = push.points.iter().map(|[_, force]| *force).fold(0.0, f64::max);
    assert_rounded(&[largest / comparison.strength], &[0.939], 5e-4);
    let rigid = &comparison.laws[0];
    let over: Vec<f64> = push.points.iter().zip(&rigid.forces).map(|([_, p], force)| p / force).collect();
    assert!(over[3..10].iter().all(|ratio| (0.975..=1.0255).contains(ratio)), "{over:?}");
    assert_rounded(&over[10..], &[0.922, 0.887], 6e-4);
    // each softening within 5 % of F0 where it is fitted; the chord is the best
    assert!(comparison.laws[1..].iter().all(|law| law.difference.largest < 0.05));
    let rms: Vec<f64> = comparison.laws[1..].iter().map(|law| law.difference.rms).collect();
    assert!(rms[2] < rms[1] && rms[1] < rms[0], "{rms:?}");
}

/// The law of a₃ by its formula, at each point.
#[test]
fn trilinear_laws_have_their_formulas() {
    let (push, comparison) = pushed();
    for law in &comparison.laws[1..] {
        let a3 = law.a3;
        let rotated = |x: f64| 1.0 - x / a3;
        for ([x, _], force) in push.points.iter().zip(&law.forces) {
            let softened = match law.name {
                "parallel" => a3 - x,
                "rotated" => rotated(*x),
                "chord" => (1.0 - push.a1) * (a3 - x) / (a3 - push.a1),
                name => panic!("{name}"),
            };
            let expected = (push.d1 * x / push.a1).min(push.d1).min(softened);
            assert!((force / comparison.strength - expected).abs() < 1e-12, "{} at {x}", law.name);
        }
    }
}

/// Restitution from peak to peak by hand: e² = (1 − (1 − A′)²)/(1 − (1 − A)²).
#[test]
fn the_decay_has_its_numbers() {
    let (_, decay, comparison) = released();
    // peaks are known to three digits
    assert_rounded(&comparison.implied, &[0.913, 0.887, 0.867, 0.922, 0.838], 2e-3);
    let whole = Decay { start: 0.0, restitution: Some(0.9), ..decay };
    let whole = whole.compare(&case("brick_wall_11.toml").parameters).unwrap();
    assert_rounded(&whole.implied[..1], &[0.826], 2e-3);
    // no passage precedes the release
    assert!(whole.half_cycles[0].is_none() && whole.half_cycles[1..] == comparison.half_cycles);
    let e: Vec<f64> = comparison.models.iter().map(|model| model.restitution).collect();
    assert!((0.885..=0.905).contains(&e[0]) && comparison.is_fitted && !whole.is_fitted, "{e:?}");
    assert_rounded(&e[4..], &[0.9 * 0.958, 0.958], 5e-4);
    let half_cycles = comparison.half_cycles.iter().map(|time| time.unwrap());
    let ratios: Vec<f64> = half_cycles.zip(&comparison.rigid_half_cycles).map(|(a, b)| a / b).collect();
    assert!((ratios[0] - 1.265).abs() < 0.005 && ratios.iter().all(|ratio| *ratio > 1.2), "{ratios:?}");
}

/// The peaks with restitution follow the energy of the rigid law, (1 − A′)² = 1 − e² (1 − (1 − A)²), and the
/// time between passages is 2 acosh(1/(1 − A))/√(k₀/m_eff) with k₀/m_eff = 3 g/h₁.
#[test]
fn peaks_and_times_have_their_closed_form() {
    let (parameters, _, comparison) = released();
    let rate = (3.0 * parameters.gravity / (0.5 * parameters.height)).sqrt();
    assert!((Wall::new(&parameters).unwrap().rocking_rate() / rate - 1.0).abs() < 1e-12);
    for model in comparison.models.iter().filter(|model| model.damping.is_none()) {
        let mut peak = comparison.peaks[0];
        for (k, found) in model.peaks.iter().enumerate().skip(1) {
            peak = 1.0 - (1.0 - model.restitution.powi(2) * (1.0 - (1.0 - peak).powi(2))).sqrt();
            assert!((found - peak).abs() < 1e-9, "{}: {found} for {peak}", model.name);
            let time = 2.0 * (1.0 / (1.0 - peak)).acosh() / rate;
            assert!((model.half_cycles[k - 1] - time).abs() < 1e-7, "{}: {time}", model.name);
        }
    }
}

#[test]
fn tests_that_cannot_be_used_are_refused() {
    let folder = folder("validate_refused");
    let data = root().join("tests/data/validation");
    let copy = |name: &str, from: &str, to: &str| {
        let text = fs::read_to_string(data.join(name)).unwrap();
        assert!(text.contains(from));
        fs::write(folder.join("test.toml"), text.replace(from, to)).unwrap();
    };
    fs::copy(data.join("brick_wall_11.csv"), folder.join("brick_wall_11.csv")).unwrap();
    fs::write(folder.join("short.csv"), "time_s,displacement_over_thickness\n0,0.5\n0,0.4\n").unwrap();
    fs::write(
        folder.join("beyond.csv"),
        "time_s,displacement_over_thickness\n0,0.5\n0.7,-1.1\n1,0\n1.2,0.4\n",
    )
    .unwrap();
    for (from, to, words) in [
        ("[decay]", "[push]", &["test.toml", "line"][..]),
        ("start = 0.64", "start = 9", &["start = 9", "fewer than two peaks"]),
        ("start = 0.64", "start = 2.1", &["start = 2.1", "fewer than two peaks"]),
        ("a1 = 0.03", "a1 = -0.1", &["test.toml, line", "a1 = -0.1", "limit"]),
        ("start = 0.64", "start = 0.64\nrestitution = 0", &["restitution = 0", "above 0"]),
        ("start = 0.64", "start = 0.64\nrestitution = 1.2", &["restitution = 1.2", "at most 1"]),
        ("brick_wall_11.csv", "beyond.csv", &["|d|/t = 1.1", "u_ins = 1 t"]),
        ("brick_wall_11.csv", "none.csv", &["none.csv", "cannot be read"]),
        ("brick_wall_11.csv", "short.csv", &["short.csv, line 3", "above"]),
        ("thickness = 0.11", "thickness = -1", &["test.toml, line", "thickness"]),
    ] {
        copy("brick_wall_11.toml", from, to);
        refused(&folder, &["validate", "test.toml", "--plot", "plot.svg"], words);
    }
    fs::copy(data.join("brick_wall_12.csv"), folder.join("brick_wall_12.csv")).unwrap();
    for (from, to, words) in [
        ("fit_from = 0.058", "fit_from = 0.5", &["fit_from = 0.5", "fewer than two points"][..]),
        ("d1 = 0.94", "d1 = 5", &["d1 = 5", "limit"]),
    ] {
        copy("brick_wall_12.toml", from, to);
        refused(&folder, &["validate", "test.toml"], words);
    }
    assert!(!Path::new(&folder).join("plot.svg").exists());
}
