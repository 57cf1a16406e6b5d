//! Tests the parts of a step, one lane wide, on motions in closed form. Most errors of a first guess are
//! mended by the next one or by the general search, at the price of speed: they show here alone.

use super::*;
use crate::line::tests::line;
use crate::numbering::LaneBranches;
use crate::table::terms;

/// A first guess is so close that the correction about it is the last, where ü and the jerk change u̇ as they
/// do in the steps of a record.
#[test]
fn the_guess_of_a_corner_is_close() {
    let length = 0.01;
    for [c, k] in [[0.0, 0.0], [1.0, 0.0], [0.0, 20.0], [0.0, -20.0]] {
        let line = line(c, k);
        let terms = terms((c + f64::sqrt(f64::abs(k))) * length);
        for speed in [1.0, -0.3] {
            for (bend, twist) in [(0.5, 0.0), (0.5, 0.005), (-0.5, -0.005), (-0.5, 0.005), (0.0, 0.0)] {
                let from = [0.2, speed, bend * speed / length];
                let rate = twist * speed / (length * length);
                let part = Part { from, length, rate, ..part(line) };
                for share in [0.3, 0.7, 0.98] {
                    let time = share * length;
                    let miss = part.guess(line.after(terms, time, from, rate)[0]) - time;
                    assert!(miss.abs() < SMALL_SHIFT * length, "{c}, {k}, {bend}, {twist}: {miss:e}");
                }
            }
        }
    }
}

/// The time of a corner, and u̇ there, are those of the motion, also where the first guess is far off.
#[test]
fn corners_are_found_where_the_motion_passes_them() {
    let (mut found_all, mut all) = (0, 0);
    for [c, k] in [[0.0, 0.0], [3.0, 0.0], [0.0, 900.0], [0.0, -900.0], [6.0, 400.0], [5.0, -400.0]] {
        let line = LinearBranch { force_at_zero: 0.4, ..line(c, k) };
        for length in [0.01, 0.016] {
            let terms = terms((c + f64::sqrt(f64::abs(k))) * length);
            for (speed, forcing, rate) in
                [(1.0, 30.0, 0.0), (1.0, -35.0, 2e3), (-0.3, 10.0, -3e3), (-2.0, 8.0, 5e3), (0.5, 60.0, 0.0)]
            {
                // about where corners lie, so that no digits of u are lost
                let u = -0.3 * speed * length;
                let from = [u, speed, line.acceleration([u, speed], forcing)];
                let [to_u, to_v, _] = line.after(terms, length, from, rate);
                let to = [to_u, to_v];
                let part = Part { lanes: true, from, to, length, forcing, rate, ..part(line) };
                for share in [0.02, 0.3, 0.5, 0.9, 0.98] {
                    let time = share * length;
                    let [corner, velocity, _] = line.after(terms, time, from, rate);
                    let Passage { found, time: found_time, velocity: found_velocity } =
                        part.find(corner, terms);
                    all += 1;
                    if !found {
                        continue;
                    }
                    found_all += 1;
                    // the roundings of u over u̇, beside 5·10⁻¹⁶ of the length
                    let rounding = 8.0 * f64::EPSILON * (to[0].abs().max(u.abs()) / velocity.abs() + length);
                    let error = (found_time - time).abs();
                    assert!(error <= rounding, "{c}, {k}, {speed}, {share}: {error:e} of {rounding:e}");
                    let most = line.most(forcing.abs() + rate.abs() * length, [u, speed], to);
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
    let part = Part { lanes: true, from: [0.0, 1.0, 0.0], to: [0.5, 1.0], length: 0.5, ..part(line) };
    let Passage { found, time, velocity } = part.find(0.25, 2);
    assert_eq!((found, time, velocity), (true, 0.25, 1.0));
    for corner in [-0.1, 0.0, 0.5, 0.6] {
        assert!(!part.find(corner, 2).found, "{corner}");
    }
    assert!(!Part { lanes: false, ..part }.find(0.25, 2).found);
}

/// A part of no length.
fn part(line: LinearBranch<f64>) -> Part<f64> {
    let (length, forcing, rate, impacts) = (0.0, 0.0, 0.0, 0.0);
    Part {
        lanes: false,
        branch: LaneBranches::default().load((), 0),
        line,
        from: [0.0; 3],
        to: [0.0; 2],
        length,
        forcing,
        rate,
        impacts,
    }
}
