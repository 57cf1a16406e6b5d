//! Tests the motion along a line, and where u goes on it, one lane wide.

use oscillator::{KinematicState, Oscillator};

use super::*;
use crate::table::{LONGEST, terms};

/// Over any part of its step the series of a line is the closed form of the oscillator.
#[test]
fn series_of_a_line_are_its_closed_form() {
    let step = 0.02;
    for [c, k] in
        [[0.0, 0.0], [3.0, 0.0], [0.0, 200.0], [0.0, -300.0], [4.0, 250.0], [7.0, -200.0], [20.0, 900.0]]
    {
        let (line, reach) = (line(c, k), (c + f64::sqrt(f64::abs(k))) * step);
        assert!(reach <= LONGEST);
        let oscillator = Oscillator::new(c, k);
        for ([u, v], rate) in [([0.3, -0.8], 40.0), ([-0.1, 2.0], -90.0), ([0.0, 0.0], 25.0)] {
            let a = line.acceleration([u, v], 1.7);
            let start = KinematicState { displacement: u, velocity: v, acceleration: a };
            for share in [0.1, 0.5, 1.0] {
                let time = share * step;
                let [found_u, found_v, found_a] = line.after(terms(reach), time, [u, v, a], rate);
                let end = oscillator.propagate(start, rate, time);
                // a dozen roundings of the terms of ü, and of these over the time
                let size = a.abs() + (rate.abs() + c * a.abs() + k.abs() * v.abs()) * time;
                let rounding = 12.0 * f64::EPSILON;
                let near = |found: f64, wanted: f64, size: f64| {
                    assert!((found - wanted).abs() <= rounding * size, "{c}, {k}: {found} for {wanted}");
                };
                near(found_a, end.acceleration, size);
                near(found_v, end.velocity, v.abs() + size * time);
                near(found_u, end.displacement, u.abs() + (v.abs() + size * time) * time);
            }
        }
    }
}

/// The bound on |ü| is γ (P + c V + f̂), with the larger |u̇| and |f| of both instants.
#[test]
fn accelerations_are_bounded_by_the_larger_end() {
    let line = LinearBranch { growth: 1.25, force_at_zero: -2.0, ..line(0.5, 3.0) };
    // |f| = |−2 + 3u|: 1.1 and 4.4
    for (from, to) in [([0.3, -1.5], [-0.8, 0.2]), ([-0.8, 0.2], [0.3, -1.5]), ([-0.8, -1.5], [0.3, 0.2])] {
        let most = line.most(0.7, from, to);
        assert!((most - 1.25 * (0.7 + 0.5 * 1.5 + 4.4)).abs() <= 4.0 * f64::EPSILON * most, "{most}");
    }
}

/// u leaves its branch with u̇ of one sign where both ends have the same one and |u̇₀| + |u̇₁| > A L
/// (docs/record-path.md, §3).
#[test]
fn a_sign_is_kept_by_velocities_that_outweigh_the_bound() {
    // A L = 3
    let leaves = |v0: f64, v1: f64, u: f64| course([0.0, v0], [u, v1], bounds([-1.0, 1.0])).leaves;
    for sign in [1.0, -1.0] {
        for u in [sign, 2.0 * sign] {
            assert!(leaves(sign * 1.25, sign * 2.0, u) && leaves(sign * 3.01, sign * 1e-9, u));
            // |u̇₀| + |u̇₁| = A L does not suffice
            assert!(!leaves(sign * 1.0, sign * 1.5, u) && !leaves(sign * 1.0, sign * 2.0, u));
            assert!(!leaves(sign * 5.0, sign * -5.0, u));
            assert!(!leaves(sign * 5.0, 0.0, u) && !leaves(0.0, sign * 5.0, u));
        }
        assert!(!leaves(sign * 1.25, sign * 2.0, 0.99 * sign));
    }
}

/// Where u̇ may change its sign, u keeps A L²/8 away from the ends of its branch, but for the end from which
/// it moves away with |u̇₀| of A L/2 or more.
#[test]
fn margins_are_kept_from_the_ends_ahead_and_from_those_that_may_be_reached_again() {
    // A L = 3, A L²/8 = 0.1875
    let stays = |from: [f64; 2], to: [f64; 2]| course(from, to, bounds([-1.0, 1.0])).stays;
    for sign in [1.0, -1.0] {
        let mirrored = |[u, v]: [f64; 2]| [sign * u, sign * v];
        let stays = |from: [f64; 2], to: [f64; 2]| stays(mirrored(from), mirrored(to));
        // turns with a margin on both sides
        assert!(stays([0.81, 1.0], [0.81, -1.0]) && !stays([0.82, 1.0], [0.81, -1.0]));
        assert!(!stays([0.81, 1.0], [0.82, -1.0]));
        // leaves a corner for good, or may come back to it
        assert!(stays([-1.0, 1.5], [-0.9, -1.0]) && !stays([-1.0, 1.49], [-0.9, -1.0]));
        assert!(stays([-1.0, 1.5], [0.81, -1.0]) && !stays([-1.0, 1.5], [0.82, -1.0]));
        // moves towards the corner it starts from
        assert!(!stays([-1.0, -1.5], [-0.9, 1.0]));
        // keeps its sign, up to the end of the branch
        assert!(stays([-1.0, 2.0], [0.999, 1.5]) && !stays([-1.0, 2.0], [1.0, 1.5]));
        assert!(!stays([-1.001, 2.0], [0.999, 1.5]));
        // faster than the bound holds for
        assert!(stays([0.0, 5.0], [0.5, 4.0]) && !stays([0.0, 5.1], [0.5, 4.0]));
        assert!(!stays([0.0, 4.0], [0.5, 5.1]));
    }
    // u may come to its limits, not to the ends of the branch
    let narrow = Bounds { within: [-0.5, 0.5], ..bounds([-1.0, 1.0]) };
    assert!(
        course([-0.5, 2.0], [0.5, 1.5], narrow).stays && !course([-0.5, 2.0], [0.501, 1.5], narrow).stays
    );
}

/// Finds where u goes over 0.5 s without forces, with A = γ P = 6 m/s².
fn course(from: [f64; 2], to: [f64; 2], bounds: Bounds<f64>) -> Course<bool> {
    LinearBranch { growth: 2.0, ..line(0.0, 0.0) }.course(from, to, 3.0, 0.5, &bounds)
}

fn bounds(ends: [f64; 2]) -> Bounds<f64> {
    Bounds { ends, within: ends, speed: 5.0 }
}

/// A line through the origin, with the γ of a step of no length.
pub(crate) fn line(c: f64, k: f64) -> LinearBranch<f64> {
    LinearBranch { c, k, force_at_zero: 0.0, growth: 1.0 }
}
