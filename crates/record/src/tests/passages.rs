//! Tests when the series of one lane pass a displacement, on branches with secant damping.

use rocking_wall::solver::secant::{ByRatio, ByStiffness, SecantBranch, Start};

use crate::curved::OneLane;

/// The motion from u = 1 on a line f = f₀ + k u over a length, with damping that follows the law.
fn start<L: OneLane>(velocity: f64, length: f64, [force_at_zero, stiffness]: [f64; 2]) -> Start<f64> {
    let own = [0.0, force_at_zero, stiffness];
    let (anchor, force, factor) = (0.0, force_at_zero, 0.02);
    let branch = SecantBranch { anchor, force, stiffness, own, force_at_zero, factor };
    branch.start::<L>([1.0, velocity], [0.7, 0.3 * length], length).0
}

/// Compares times of passages, and u̇ then, with those found by halving. Returns how many were found.
fn found_by_halving<L: OneLane>() -> u32 {
    let (mut found, mut worst, length, most) = (0, 0.0_f64, 0.05, 1e-13);
    for speed in (-25..=50).filter(|speed: &i32| speed.abs() > 3) {
        for line in [[1.0, -0.3], [1.0, 0.0], [0.4, 0.6]] {
            let velocity = 0.1 * f64::from(speed);
            for share in [0.1, 0.25, 0.4, 0.6, 0.9] {
                let rise = share * length * velocity;
                let end = |share: f64| L::end(start::<L>(velocity, share * length, line), most);
                let passage = L::passage(start::<L>(velocity, length, line), rise, most);
                let Some([share, slope]) = passage else { continue };
                found += 1;
                let (mut low, mut high) = (0.0, 1.1 * share);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    let passed = (end(middle).expect("a series that reaches")[0] / rise) > 1.0;
                    if passed { high = middle } else { low = middle }
                }
                let [_, velocity] = end(high).expect("a series that reaches");
                worst = worst.max(((share - high) * slope).abs()).max((velocity - high * slope).abs());
            }
        }
    }
    // the tolerance of both
    assert!(worst <= 2.0 * most, "{worst:e}");
    found
}

#[test]
fn passages_are_found_by_halving() {
    assert_eq!([found_by_halving::<ByRatio>(), found_by_halving::<ByStiffness>()], [1035; 2]);
}

/// A corner is looked for within twice the part, where the series still holds.
#[test]
fn passages_are_looked_for_within_two_parts() {
    let (velocity, length) = (0.3, 0.02);
    // ü is small, so that u = 1 + u̇ t
    let passage = |parts: f64, most: f64| {
        let start = start::<ByStiffness>(velocity, length, [1.0, -0.3]);
        ByStiffness::passage(start, parts * length * velocity, most)
    };
    for parts in [0.2, 0.9, 1.1, 1.9] {
        let [time, _] = passage(parts, 1e-9).expect("a passage");
        assert!((time / parts - 1.0).abs() < 1e-3, "{parts}: {time}");
    }
    assert_eq!([2.1, 5.0, -0.5].map(|parts| passage(parts, 1e-9)), [None; 3]);
}

/// What a series leaves out counts at the time of the passage, not at the end of the part.
#[test]
fn passages_count_what_is_left_out_at_their_time() {
    let (velocity, line) = (2.0, [1.0, -0.3]);
    let passes = |length: f64, share: f64, most: f64| {
        let start = start::<ByStiffness>(velocity, length, line);
        let time = ByStiffness::passage(start, share * length * velocity, most)?[0];
        // the series that ends there
        assert!(ByStiffness::end(self::start::<ByStiffness>(velocity, time * length, line), most).is_some());
        Some(time)
    };
    for (length, share, most) in [(0.4, 0.2, 1e-10), (0.1, 0.9, 1e-10), (0.1, 1.5, 1e-8)] {
        assert!(passes(length, share, most).is_some(), "{length}, {share}");
        assert!(passes(length, share, 1e-30).is_none(), "{length}, {share}");
    }
    assert!(ByStiffness::end(start::<ByStiffness>(velocity, 0.4, line), 1e-10).is_none());
    assert!(passes(0.4, 0.9, 1e-10).is_none() && passes(0.1, 1.9, 1e-13).is_none());
}
