//! Tests the type of ground motions.

use ground_motion::{GroundMotion, Unit};
use proptest::prelude::*;

/// Velocity and displacement at each sample of a record, integrated without error from the values at time
/// zero.
pub(crate) fn integrated(motion: &GroundMotion, start: [f64; 2]) -> Vec<[f64; 2]> {
    let step = motion.step();
    let mut history = vec![start];
    let [mut velocity, mut displacement] = start;
    for pair in motion.samples().windows(2) {
        displacement += step * velocity + step * step * (2.0 * pair[0] + pair[1]) / 6.0;
        velocity += step * (pair[0] + pair[1]) / 2.0;
        history.push([velocity, displacement]);
    }
    history
}

#[test]
fn is_linear_between_samples_and_zero_outside() {
    let motion = GroundMotion::new(0.5, vec![1.0, 3.0, -2.0]).unwrap();
    assert_eq!(motion.duration(), 1.0);
    assert_eq!(motion.peak(), 3.0);
    for (time, expected) in [
        (-1e-12, 0.0),
        (0.0, 1.0),
        (0.25, 2.0),
        (0.5, 3.0),
        (0.75, 0.5),
        (1.0, -2.0),
        (1.0 + 1e-12, 0.0),
        (f64::INFINITY, 0.0),
        (f64::NEG_INFINITY, 0.0),
        (f64::NAN, 0.0),
    ] {
        assert_eq!(motion.at(time), expected, "at {time} s");
    }
}

#[test]
fn refuses_what_is_no_motion() {
    for (step, samples, message) in [
        (0.0, vec![0.0, 1.0], "found 0 s"),
        (-0.01, vec![0.0, 1.0], "found -0.01 s"),
        (f64::NAN, vec![0.0, 1.0], "found NaN s"),
        (f64::INFINITY, vec![0.0, 1.0], "found inf s"),
        (f64::MAX, vec![0.0, 1.0, 2.0], "time step"),
        (0.01, vec![], "found 0"),
        (0.01, vec![1.0], "found 1"),
        (0.01, vec![0.0, f64::NAN], "sample 1"),
        (0.01, vec![f64::INFINITY, 0.0], "sample 0"),
        (0.01, vec![0.0, -1e6, 1e6_f64.next_up()], "sample 2"),
    ] {
        let error = GroundMotion::new(step, samples).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn scales_to_a_factor_or_a_peak() {
    let motion = GroundMotion::new(0.01, vec![0.0, 1.5, -2.0]).unwrap();
    assert_eq!(motion.scaled(-2.0).samples(), [0.0, -3.0, 4.0]);
    assert_eq!(motion.scaled(0.0).peak(), 0.0);
    // pga / peak and its product with the peak are each rounded once.
    let peak = motion.scaled_to_peak(0.3).unwrap().peak();
    assert!((peak - 0.3).abs() <= 0.3 * 2.0 * f64::EPSILON, "{peak}");
    assert_eq!(motion.scaled(-5e5).samples(), [0.0, -7.5e5, 1e6]);
    for factor in [f64::NAN, f64::INFINITY, f64::MAX, (-5e5_f64).next_down()] {
        assert!(motion.checked_scaled(factor).unwrap_err().to_string().contains("cannot be scaled by"));
    }
    for peak in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(motion.scaled_to_peak(peak).unwrap_err().to_string().contains("target peak"));
    }
    let zeros = GroundMotion::new(0.01, vec![0.0, 0.0]).unwrap();
    assert!(zeros.scaled_to_peak(1.0).unwrap_err().to_string().contains("every sample"));
}

#[test]
fn trims_to_the_nearest_samples() {
    let motion = GroundMotion::new(0.1, vec![0.0, 1.0, 2.0, 3.0, 4.0]).unwrap();
    for (from, to, expected) in [
        (0.0, 0.4, &[0.0, 1.0, 2.0, 3.0, 4.0][..]),
        (0.1, 0.3, &[1.0, 2.0, 3.0]),
        (0.14, 0.27, &[1.0, 2.0, 3.0]),
        (0.3, 0.4, &[3.0, 4.0]),
    ] {
        let trimmed = motion.trimmed(from, to).unwrap();
        assert_eq!((trimmed.step(), trimmed.samples()), (0.1, expected), "{from} s ... {to} s");
    }
    for (from, to) in [
        (-0.1, 0.4),
        (0.0, 0.5),
        (0.2, 0.2),
        (0.3, 0.1),
        (0.0, f64::INFINITY),
        (f64::NAN, 0.4),
        (0.0, f64::NAN),
    ] {
        let error = motion.trimmed(from, to).unwrap_err().to_string();
        assert!(error.contains("cannot trim a ground motion of 0.4 s"), "{error}");
    }
}

#[test]
fn units_have_their_usual_spellings() {
    for (unit, spellings) in [
        (
            Unit::MetrePerSecondSquared,
            &[
                "m/s2",
                "m/s^2",
                "m/s²",
                "M/S/S",
                "m/sec^2",
                "m/s**2",
                "m s-2",
                " m/sec/sec ",
                "meter / second ** 2",
            ][..],
        ),
        (
            Unit::CentimetrePerSecondSquared,
            &["cm/s2", "cm/s^2", "CM/SEC/SEC", "cm/sec2", "gal", "Gal", "galileo"],
        ),
        (Unit::MillimetrePerSecondSquared, &["mm/s2", "mm/s²", "MM/SEC**2", "millimetre per second squared"]),
        (Unit::StandardGravity, &["g", "G", "(g)", "standard_gravity"]),
    ] {
        for spelling in spellings {
            assert_eq!(spelling.parse::<Unit>().unwrap(), unit, "{spelling}");
        }
        assert_eq!(unit.to_string().parse::<Unit>().unwrap(), unit);
    }
    for spelling in ["", "m", "m/s", "cm/s", "km/s2", "mg", "%g", "ft/s2", "/s2", "Gm/s2"] {
        let error = spelling.parse::<Unit>().unwrap_err().to_string();
        assert!(error.contains(&format!("`{spelling}`")) && error.contains("cm/s2"), "{error}");
    }
    assert_eq!(Unit::ALL.map(|unit| unit.to_si(1.0)), [1.0, 0.01, 0.001, 9.806_65]);
}

proptest! {
    #[test]
    fn passes_through_its_samples(step in 1e-4..0.1, samples in prop::collection::vec(-10.0..10.0, 2..200)) {
        let motion = GroundMotion::new(step, samples.clone()).unwrap();
        for (sample, index) in samples.iter().zip(0_u32..) {
            // The quotient of the time and the step is off by at most two roundings of the index, up to 200;
            // neighbours differ by up to 20.
            let error = (motion.at(f64::from(index) * step) - sample).abs();
            prop_assert!(error <= 20.0 * 200.0 * 2.0 * f64::EPSILON, "sample {index}: {error}");
        }
    }
}
