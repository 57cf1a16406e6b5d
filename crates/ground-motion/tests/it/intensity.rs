//! Intensities that are integrals: closed forms, samples that a refinement adds, scaling.

use std::f64::consts::PI;

use ground_motion::{GroundMotion, STANDARD_GRAVITY, Spectrum, SyntheticMotion};

/// A motion with a sample more in the middle of each step is the same motion.
fn refined(motion: &GroundMotion, parts: u32) -> GroundMotion {
    let pairs = motion.samples().windows(2);
    let between = |pair: &[f64]| {
        let [a, b] = [pair[0], pair[1]];
        (0..parts).map(move |k| a + (b - a) * f64::from(k) / f64::from(parts))
    };
    let mut samples: Vec<f64> = pairs.flat_map(between).collect();
    samples.extend(motion.samples().last());
    GroundMotion::new(motion.step() / f64::from(parts), samples).unwrap()
}

/// a = 1 − t/h over 0 to 2 h: v = t − t²/(2 h), u = t²/2 − t³/(6 h).
#[test]
fn a_ramp_has_closed_forms() {
    let h = 0.75;
    let motion = GroundMotion::new(2.0 * h, vec![1.0, -1.0]).unwrap();
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-15 * (1.0 + expected), "{found}, {expected}");
    };
    near(motion.peak_velocity(), h / 2.0);
    near(motion.peak_displacement(), 2.0 * h * h / 3.0);
    near(motion.arias_intensity(), PI / (2.0 * STANDARD_GRAVITY) * 2.0 * h / 3.0);
    near(motion.cumulative_absolute_velocity(), h);
    assert_eq!(motion.velocities(), [0.0, 0.0]);
    near(motion.displacements()[1], 2.0 * h * h / 3.0);
}

/// The displacement is largest where the velocity passes zero within a step: a = 1, −2 has v = t − 3 t²/2 of
/// its one step, which is zero at t = 2/3, and u = t²/2 − t³/2 is 2/27 there and 0 at the end.
#[test]
fn a_displacement_turns_between_samples() {
    let motion = GroundMotion::new(1.0, vec![1.0, -2.0]).unwrap();
    assert!((motion.peak_displacement() - 2.0 / 27.0).abs() < 1e-16);
    assert!((motion.velocities()[1] + 0.5).abs() < 1e-16 && motion.displacements()[1].abs() < 1e-16);
}

/// Refinement changes nothing, to the roundings of 6,000 sums; the mirror image has the same intensities.
#[test]
fn refinement_and_sign_change_nothing() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let of = |motion: &GroundMotion| {
        [
            motion.peak_velocity(),
            motion.peak_displacement(),
            motion.arias_intensity(),
            motion.cumulative_absolute_velocity(),
            Spectrum::default().housner_intensity(motion).unwrap(),
        ]
    };
    let (own, mirrored) = (of(&motion), of(&motion.scaled(-1.0)));
    for (one, other) in own.iter().zip(of(&refined(&motion, 3))) {
        assert!((one / other - 1.0).abs() < 1e-10, "{one}, {other}");
    }
    assert_eq!(own, mirrored);
}

/// A constant acceleration without damping has Sa = 2 a, so that Housner's intensity is ∫ 2 a T/(2π) dT: the
/// trapezoidal rule is exact for a line.
#[test]
fn housner_of_a_step_is_a_line() {
    let motion = GroundMotion::new(0.02, vec![1.5; 400]).unwrap();
    let spectrum = Spectrum::new(0.0, ground_motion::Maxima::Everywhere).unwrap();
    let expected = 1.5 / PI * (2.5 * 2.5 - 0.1 * 0.1) / 2.0;
    assert!((spectrum.housner_intensity(&motion).unwrap() / expected - 1.0).abs() < 1e-11);
}

/// Motions of zeros and of extreme samples give numbers.
#[test]
fn zeros_have_no_intensity() {
    let motion = GroundMotion::new(0.01, vec![0.0; 5]).unwrap();
    assert_eq!([motion.peak_velocity(), motion.peak_displacement()], [0.0; 2]);
    assert_eq!([motion.arias_intensity(), motion.cumulative_absolute_velocity()], [0.0; 2]);
    // constant acceleration: the velocity has no turning point
    let motion = GroundMotion::new(1.0, vec![-2.0, -2.0]).unwrap();
    assert_eq!([motion.peak_velocity(), motion.peak_displacement()], [2.0, 1.0]);
}

/// Of a(t) = t, ∫ a² is t³/3: 5 % and 95 % of it are reached at the cube roots of these parts of the end. A
/// bisection of a step leaves 2⁻⁵³ of it, the sum of 8 cubes some roundings. Neither scale nor refinement nor
/// zeros before and after change it.
#[test]
fn the_significant_duration_is_between_samples() {
    let ramp: Vec<f64> = (0..=8).map(f64::from).collect();
    let motion = GroundMotion::new(0.5, ramp.clone()).unwrap();
    let expected = 4.0 * (0.95_f64.cbrt() - 0.05_f64.cbrt());
    assert!((motion.significant_duration() - expected).abs() < 1e-13);
    assert!((motion.scaled(-3.0).significant_duration() - expected).abs() < 1e-13);
    assert!((refined(&motion, 5).significant_duration() - expected).abs() < 1e-13);
    let padded = [vec![0.0; 4], ramp, vec![0.0; 4]].concat();
    // from 8 to 0 within a step: the end of the record counts
    let padded = GroundMotion::new(0.5, padded).unwrap().significant_duration();
    assert!(padded > expected && padded < expected + 0.5, "{padded}");
    assert_eq!(GroundMotion::new(0.5, vec![0.0; 9]).unwrap().significant_duration(), 0.0);
}
