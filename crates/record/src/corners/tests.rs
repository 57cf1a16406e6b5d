//! Tests the parts of a step, one lane wide, on motions in closed form. Most errors of a first guess are
//! mended by the next one or by the general search, at the price of speed: they show here alone.

use super::*;
use crate::line::tests::line;
use crate::table::terms;

/// Where time is a polynomial of fifth degree in u, the guess of a corner's time is that polynomial.
#[test]
fn the_guess_of_a_corner_is_a_quintic_of_the_displacement() {
    // t(s) over the length, with u = u₀ + s rise: a slope of 1 at first, and of some 2 in the end
    let terms = [1.0, 0.3, -0.2, 0.15, 0.05];
    let polynomial = |s: f64| terms.iter().rev().fold(0.0, |sum, term| (sum + term) * s);
    let slope = |s: f64| (1..).zip(terms).map(|(n, term)| f64::from(n) * term * s.powi(n - 1)).sum::<f64>();
    let bend = |s: f64| {
        let of =
            |(n, term): (i32, f64)| if n > 1 { f64::from(n * (n - 1)) * term * s.powi(n - 2) } else { 0.0 };
        (1..).zip(terms).map(of).sum::<f64>()
    };
    let whole = polynomial(1.0);
    for (start, rise, length) in [(0.2, 0.7, 0.02), (-0.4, -0.05, 3.0)] {
        // u̇ = rise/(L t′) and ü = −t″ u̇³ L/rise²
        let end = |s: f64| {
            let v = whole * rise / (length * slope(s));
            [start + s * rise, v, -bend(s) / whole * v.powi(3) * length / (rise * rise)]
        };
        let part = Part { from: end(0.0), to: end(1.0), length, ..part(line(0.0, 0.0)) };
        for s in [0.01, 0.2, 0.5, 0.77, 0.99] {
            let (found, wanted) = (part.share(start + s * rise), polynomial(s) / whole);
            // roundings of u, and some dozen of coefficients up to 15
            let rounding = f64::EPSILON * (2.0 * (start / rise).abs() + 100.0);
            assert!((found - wanted).abs() <= rounding, "{s}: {found} for {wanted}");
        }
    }
}

/// Where the mean velocity is not 0.3 to 3 times that at each end, the guess is the chord.
#[test]
fn the_guess_of_an_uneven_passage_is_its_chord() {
    let (rise, length, s) = (0.25, 0.5, 0.375);
    let even = |w0: f64, w1: f64| {
        // with ratios w of the mean velocity to those at the ends
        let [v0, v1] = [w0, w1].map(|w| rise / (length * w));
        let part = Part { from: [0.0, v0, 0.0], to: [rise, v1, 0.0], length, ..part(line(0.0, 0.0)) };
        part.share(s * rise) != s
    };
    for w in [0.301, 0.7, 2.9] {
        assert!(even(w, 0.9) && even(0.9, w), "{w}");
    }
    for w in [0.299, 3.01, -0.9] {
        assert!(!even(w, 0.9) && !even(0.9, w), "{w}");
    }
}

/// The time of a corner, and u̇ there, are those of the motion, also where the first guess is far off.
#[test]
fn corners_are_found_where_the_motion_passes_them() {
    let (mut found_all, mut all) = (0, 0);
    for [c, k] in [[0.0, 0.0], [3.0, 0.0], [0.0, 900.0], [0.0, -900.0], [6.0, 400.0], [5.0, -400.0]] {
        let line = Line { force_at_zero: 0.4, ..line(c, k) };
        for length in [0.01, 0.016] {
            let terms = terms((c + f64::sqrt(f64::abs(k))) * length);
            for (speed, forcing, rate) in
                [(1.0, 30.0, 0.0), (1.0, -35.0, 2e3), (-0.3, 10.0, -3e3), (-2.0, 8.0, 5e3), (0.5, 60.0, 0.0)]
            {
                // about where corners lie, so that no digits of u are lost
                let u = -0.3 * speed * length;
                let from = [u, speed, line.acceleration([u, speed], forcing)];
                let to = line.after(terms, length, from, rate);
                let part = Part { lanes: true, from, to, length, forcing, rate, ..part(line) };
                for share in [0.02, 0.3, 0.5, 0.9, 0.98] {
                    let time = share * length;
                    let [corner, velocity, _] = line.after(terms, time, from, rate);
                    let (found, found_time, found_velocity) = part.find(corner, terms);
                    all += 1;
                    if !found {
                        continue;
                    }
                    found_all += 1;
                    // the roundings of u over u̇, beside 5·10⁻¹⁶ of the length
                    let rounding = 8.0 * f64::EPSILON * (to[0].abs().max(u.abs()) / velocity.abs() + length);
                    let error = (found_time - time).abs();
                    assert!(error <= rounding, "{c}, {k}, {speed}, {share}: {error:e} of {rounding:e}");
                    let most = line.most(forcing.abs() + rate.abs() * length, [u, speed], [to[0], to[1]]);
                    let rounding = most * rounding + 8.0 * f64::EPSILON * velocity.abs();
                    let error = (found_velocity - velocity).abs();
                    assert!(error <= rounding, "{c}, {k}, {speed}, {share}: {error:e} of {rounding:e}");
                }
            }
        }
    }
    assert_eq!((found_all, all), (300, 300));
}

/// A corner outside the part is not found, nor one at its start, nor one of a lane that does not come to it.
#[test]
fn corners_outside_a_part_are_not_found() {
    let line = line(0.0, 0.0);
    let part = Part { lanes: true, from: [0.0, 1.0, 0.0], to: [0.5, 1.0, 0.0], length: 0.5, ..part(line) };
    assert_eq!(part.find(0.25, 2), (true, 0.25, 1.0));
    for corner in [-0.1, 0.0, 0.5, 0.6] {
        assert!(!part.find(corner, 2).0, "{corner}");
    }
    assert!(!Part { lanes: false, ..part }.find(0.25, 2).0);
}

/// A part of no length.
fn part(line: Line<f64>) -> Part<f64> {
    let (lanes, still) = (false, [0.0; 3]);
    let (length, forcing, rate, impacts) = (0.0, 0.0, 0.0, 0.0);
    Part { lanes, branch: 0.0, line, from: still, to: still, length, forcing, rate, impacts }
}
