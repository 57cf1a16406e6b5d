//! The project's own record.

use ground_motion::{GroundMotionError, SyntheticMotion};

use crate::motion::integrated;

/// FNV-1a-64 over the bits of the samples.
fn digest(samples: &[f64]) -> u64 {
    samples.iter().flat_map(|a| a.to_bits().to_le_bytes()).fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[test]
fn is_the_same_on_every_platform() {
    let motion = SyntheticMotion::default().motion().unwrap();
    assert_eq!(digest(motion.samples()), 0xe434_bbc5_d312_bdb0, "{:x}", digest(motion.samples()));
}

#[test]
fn agrees_with_an_independent_program() {
    // The recipe of the module's description, written once more in Python with its own mathematical library.
    let motion = SyntheticMotion::default().motion().unwrap();
    for (index, expected) in [
        (1, -1.496_488_590_652_543e-8),
        (2, -2.287_621_483_541_883_4e-6),
        (1000, 0.072_045_025_672_670_17),
        (2000, -1.977_747_235_970_746_2),
        (6000, -1.789_050_687_361_794e-5),
    ] {
        // Libraries differ in the last bit of a logarithm or sine, and the noise is of the order of the peak.
        let error = (motion.samples()[index] - expected).abs();
        assert!(error <= 1e-13 * motion.peak(), "sample {index}: off by {error}");
    }
}

#[test]
fn has_the_stated_length_and_peak() {
    let motion = SyntheticMotion::default().motion().unwrap();
    assert_eq!((motion.step(), motion.samples().len()), (0.005, 6001));
    // The peak is a quotient times the old peak: two roundings.
    assert!((motion.peak() - 3.5).abs() <= 3.5 * 2.0 * f64::EPSILON, "{}", motion.peak());
    assert_eq!(motion.samples()[0], 0.0);
    let short = SyntheticMotion { duration: 12.0, step: 0.01, peak: 1.0, ..SyntheticMotion::default() };
    assert_eq!(short.motion().unwrap().samples().len(), 1201);
}

#[test]
fn ends_at_rest_where_it_began() {
    // The high-pass filter rings down for 0.2 of 30 s by exp(−ζ ω 6 s) = 0.0045; before that it is no further
    // out than its peak.
    for seed in 0..20 {
        let motion = SyntheticMotion { seed, ..SyntheticMotion::default() }.motion().unwrap();
        let history = integrated(&motion, [0.0, 0.0]);
        for i in [0, 1] {
            let largest = history.iter().fold(0.0_f64, |largest, state| largest.max(state[i].abs()));
            let last = history.last().unwrap()[i].abs();
            assert!(last <= 0.01 * largest, "seed {seed}, {i}: {last} of {largest}");
        }
    }
}

#[test]
fn shakes_in_the_middle_and_differs_from_seed_to_seed() {
    let motion = |seed| SyntheticMotion { seed, ..SyntheticMotion::default() }.motion().unwrap();
    for seed in 0..20 {
        let motion = motion(seed);
        let energy = |from: f64, to: f64| {
            motion.trimmed(from, to).unwrap().samples().iter().map(|a| a * a).sum::<f64>() / (to - from)
        };
        // Mean squares: the envelope's squares are 0.2, 1 and below 1e-3 in the mean of these intervals.
        assert!(energy(0.0, 3.0) < energy(3.0, 10.5), "seed {seed}");
        assert!(energy(22.0, 30.0) < 0.05 * energy(3.0, 10.5), "seed {seed}");
    }
    assert_ne!(motion(1), motion(2));
}

#[test]
fn refuses_values_outside_their_limits() {
    let default = SyntheticMotion::default();
    for motion in [
        SyntheticMotion { duration: 9.0, ..default },
        SyntheticMotion { duration: f64::NAN, ..default },
        SyntheticMotion { duration: 1e9, ..default },
        SyntheticMotion { step: 0.0, ..default },
        SyntheticMotion { step: 0.03, ..default },
        SyntheticMotion { step: f64::NAN, ..default },
    ] {
        assert!(matches!(motion.motion(), Err(GroundMotionError::Parameter { .. })), "{motion:?}");
    }
    for peak in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(SyntheticMotion { peak, ..default }.motion(), Err(GroundMotionError::Peak { .. })));
    }
}
