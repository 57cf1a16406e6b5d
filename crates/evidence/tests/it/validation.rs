//! Tests the comparison with published tests.

use evidence::validation::{Decay, DecayComparison, PublishedTest, Push, PushComparison, Test};
use rocking_wall::wall::{Parameters, Wall};

use crate::root;

fn case(name: &str) -> PublishedTest {
    PublishedTest::read(&root().join("tests/data/validation").join(name)).unwrap()
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
