//! Response spectra: closed forms, refinement, scaling, limits.

use std::f64::consts::{PI, TAU};

use ground_motion::spectrum::{AVERAGE_PERIODS, DAMPING};
use ground_motion::{GroundMotion, Maxima, RecordOptions, Spectrum, SyntheticMotion, Unit, Warning, parse};

fn everywhere(damping: f64) -> Spectrum {
    Spectrum::new(damping, Maxima::Everywhere).unwrap()
}

/// A constant acceleration a answers with a (1 + exp(−π ξ / √(1 − ξ²))) after half a period, between the
/// samples.
#[test]
fn a_step_overshoots_as_in_the_textbooks() {
    for (damping, period, step) in
        [(0.05, 0.7, 0.02), (0.05, 0.3, 0.13), (0.2, 5.0, 0.005), (0.9, 0.05, 0.03)]
    {
        let motion = GroundMotion::new(step, vec![2.0; 1000]).unwrap();
        let overshoot = 1.0 + (-PI * damping / f64::sqrt(1.0 - damping * damping)).exp();
        let (found, expected) = (everywhere(damping).acceleration(&motion, period).unwrap(), 2.0 * overshoot);
        // A thousand roundings, and the square of the velocity left at the turning point.
        let error = (found / expected - 1.0).abs();
        assert!(error < 1e-11, "ξ = {damping}, T = {period} s: {found}, not {expected}");
    }
}

/// A triangle of height a and duration 2 d is a box of duration d passed twice: without damping the free
/// vibration after it has the amplitude Sa = a ω d (sin(ω d / 2) / (ω d / 2))².
#[test]
fn the_free_vibration_after_the_end_counts() {
    for (half, period) in [(0.1, 1.0), (0.1, 0.9), (0.05, 2.0)] {
        let motion = GroundMotion::new(half, vec![0.0, 3.0, 0.0]).unwrap();
        let omega = TAU / period;
        let box_part = 2.0 / (omega * half) * f64::sin(omega * half / 2.0);
        let expected = 3.0 * omega * half * box_part * box_part;
        let found = everywhere(0.0).acceleration(&motion, period).unwrap();
        assert!(
            (found - expected).abs() < 1e-11 * expected,
            "d = {half} s, T = {period} s: {found}, {expected}"
        );
        let inside = Spectrum::new(0.0, Maxima::AtSamples).unwrap().acceleration(&motion, period).unwrap();
        assert!(inside < 0.9 * expected, "the maximum lies after the end: {inside}, {expected}");
    }
}

/// Linear interpolation does not change the motion, so the true maximum stays and those at samples grow
/// towards it.
#[test]
fn refinement_changes_nothing_but_sampled_maxima() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let refined = |parts: u32| {
        let mut samples = Vec::new();
        for pair in motion.samples().windows(2) {
            samples
                .extend((0..parts).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / f64::from(parts)));
        }
        samples.push(*motion.samples().last().unwrap());
        GroundMotion::new(motion.step() / f64::from(parts), samples).unwrap()
    };
    let (fine, sampled) = (refined(10), Spectrum::new(DAMPING, Maxima::AtSamples).unwrap());
    for period in [0.03, 0.1, 0.2, 0.37, 1.0, 1.4, 3.0] {
        let omega = TAU / period;
        let truth = everywhere(DAMPING).acceleration(&motion, period).unwrap();
        let again = everywhere(DAMPING).acceleration(&fine, period).unwrap();
        assert!((again / truth - 1.0).abs() < 1e-9, "T = {period} s: {truth}, refined {again}");
        for (motion, sampled) in [(&motion, &sampled), (&fine, &sampled)] {
            let found = sampled.acceleration(motion, period).unwrap();
            // Near its maximum the displacement turns no faster than that of an oscillator and a ground of
            // twice Sa.
            let missed = 3.0 * (omega * motion.step()).powi(2) / 8.0;
            assert!(
                found <= truth * (1.0 + 1e-12) && found >= truth * (1.0 - missed),
                "T = {period} s: {found}"
            );
        }
    }
}

#[test]
fn a_stiff_oscillator_follows_the_ground_and_a_soft_one_stays() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let spectrum = Spectrum::default();
    assert_eq!(spectrum.acceleration(&motion, 0.0).unwrap(), motion.peak());
    // The static answer, and the inertia of a ground that bends once a sample, (T / 2π)² a'' with a'' up to 4
    // a / step².
    let stiff = spectrum.acceleration(&motion, 0.001).unwrap();
    assert!((stiff / motion.peak() - 1.0).abs() < 0.02, "{stiff}, {}", motion.peak());
    assert!(spectrum.acceleration(&motion, 100.0).unwrap() < 0.01 * motion.peak());
}

#[test]
fn the_average_is_the_geometric_mean_and_scales_with_the_motion() {
    let motion = SyntheticMotion::default().motion().unwrap();
    let spectrum = Spectrum::default();
    let values = spectrum.accelerations(&motion, &AVERAGE_PERIODS).unwrap();
    let product: f64 = values.iter().product();
    let average = spectrum.average(&motion, &AVERAGE_PERIODS).unwrap();
    assert!((average / product.powf(1.0 / 7.0) - 1.0).abs() < 1e-14);
    let scaled = spectrum.average(&motion.scaled(-2.5), &AVERAGE_PERIODS).unwrap();
    assert!((scaled / average - 2.5).abs() < 1e-12, "{scaled}, {average}");
    assert_eq!(spectrum.average(&motion.scaled(0.0), &AVERAGE_PERIODS).unwrap(), 0.0);
    assert_eq!(spectrum.average(&motion, &[0.5]).unwrap(), {
        let single = spectrum.acceleration(&motion, 0.5).unwrap();
        single.ln().exp()
    });
}

#[test]
fn refuses_what_is_no_oscillator() {
    let motion = GroundMotion::new(1.0, vec![0.0, 1.0]).unwrap();
    for damping in [-0.01, 1.0, f64::NAN] {
        assert!(
            Spectrum::new(damping, Maxima::Everywhere).unwrap_err().to_string().contains("damping ratio")
        );
    }
    for period in [-1.0, 1e-4, 101.0, f64::NAN, f64::INFINITY] {
        let error = Spectrum::default().acceleration(&motion, period).unwrap_err().to_string();
        assert!(error.contains("period is") && error.contains("0.001 to 100 s"), "{error}");
    }
    let error = Spectrum::default().acceleration(&motion, 0.001).unwrap_err().to_string();
    assert!(error.contains("time step in s") && error.contains("500 periods"), "{error}");
    assert!(Spectrum::default().average(&motion, &[]).unwrap_err().to_string().contains("1 or more"));
}

/// A sine of 1 Hz under a smooth envelope: sound; then damaged in the ways the check looks for.
#[test]
fn the_check_finds_what_is_wrong_with_a_record() {
    let sound = |index: u32| {
        let time = 0.01 * f64::from(index);
        let envelope = f64::sin(PI * time / 20.0).powi(2);
        300.0 * envelope * f64::sin(TAU * time)
    };
    let findings = |unit: Unit, samples: Vec<f64>| {
        let lines: Vec<_> = samples.iter().map(ToString::to_string).collect();
        let options = RecordOptions { unit: Some(unit), step: Some(0.01), ..RecordOptions::default() };
        parse("x.csv", lines.join("\n").into_bytes(), &options).unwrap().check()
    };
    let samples: Vec<f64> = (0..=2000).map(sound).collect();
    let gal = Unit::CentimetrePerSecondSquared;
    let check = findings(gal, samples.clone());
    assert_eq!(check.warnings, []);
    assert!((check.peak_velocity - 3.0 / TAU).abs() < 0.05 && check.mean.abs() < 1e-3, "{check:?}");

    let shifted = findings(gal, samples.iter().map(|a| a + 3.0).collect());
    assert!(
        matches!(shifted.warnings[..], [Warning::Baseline { last, .. }] if (last - 0.6).abs() < 0.01),
        "{shifted:?}"
    );
    let cut = findings(gal, samples[..1200].to_vec());
    assert!(cut.warnings.iter().any(|finding| matches!(finding, Warning::MissingTail { .. })), "{cut:?}");
    let late = findings(gal, samples[825..].to_vec());
    assert!(late.warnings.iter().any(|finding| matches!(finding, Warning::MissingStart { .. })), "{late:?}");
    let strong = findings(Unit::StandardGravity, samples);
    let [Warning::Unit { others, .. }] = &strong.warnings[..] else { panic!("{strong:?}") };
    assert_eq!(others, &[gal, Unit::MillimetrePerSecondSquared]);
    assert!(
        strong.warnings[0].to_string().ends_with("Credible would be cm/s2 or mm/s2"),
        "{}",
        strong.warnings[0]
    );
    assert_eq!(findings(gal, vec![0.0; 10]).warnings, [Warning::NoMotion]);
}
