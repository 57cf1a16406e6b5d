//! Tests regularised series against series in time, and how close their guesses are.

use super::*;
use rocking_wall::solver::secant::{ByRatio, Scaled};

/// Rate of p \[m/s³\].
const RATE: f64 = 0.3;

/// Returns the start of the motion from u = 1 with u̇ on a line f = f₀ + k u under a forcing p, over a
/// length.
fn start([velocity, length]: [f64; 2], [zero, stiffness]: [f64; 2], forcing: f64) -> Start<f64> {
    let (force, square) = (zero + stiffness, length * length);
    Start {
        velocity: length * velocity,
        driving: square * (forcing - force),
        rate: square * length * RATE,
        half_kappa: -0.5 * zero / force,
        stiffness: stiffness * square,
        damping: 0.1 * length * force.sqrt(),
    }
}

/// Speeds with which u changes by −50 % to +100 % in the step, on lines that rise and fall.
fn starts() -> impl Iterator<Item = ([f64; 2], [f64; 2], f64)> {
    (-25..=50).flat_map(|speed| {
        [[1.0, -0.3], [1.0, 0.0], [0.4, 0.6]].map(|line| ([0.4 * f64::from(speed), 0.05], line, 0.7))
    })
}

/// A step ends where sixteen series in time end.
#[test]
fn steps_are_those_of_series_in_time() {
    let (mut reached, mut worst, most) = (0, 0.0_f64, 1e-13);
    for ([speed, length], [zero, stiffness], forcing) in starts() {
        let whole = Regularised::new(start([speed, length], [zero, stiffness], forcing));
        let Some([rise, velocity]) = whole.end(most) else { continue };
        reached += 1;
        let (mut u, mut v) = (1.0, speed);
        for part in 0..16 {
            let (length, scale) = (length / 16.0, 1.0 / u);
            let now = forcing + RATE * length * f64::from(part);
            let line = [zero * scale, stiffness];
            let mut start = start([v * scale, length], line, now * scale);
            start.rate *= scale;
            let mut series = Scaled::new(start);
            series.extend_to_8::<ByRatio>();
            series.extend_to_10::<ByRatio>();
            series.extend_to_12::<ByRatio>();
            series.extend_to_16::<ByRatio>();
            let [x, slope] = series.end::<ORDER>();
            (v, u) = (u / length * slope, u + u * x);
        }
        worst = worst.max((1.0 + rise - u).abs()).max((velocity - length * v).abs());
    }
    assert!(reached > 140, "{reached}");
    // the tolerance, of which the estimate takes a tenth; the sixteen leave out far less
    assert!(worst <= most, "{worst:e}");
}

/// The first guess of the end is so close that the expansion about it leads there at once.
#[test]
fn first_guesses_of_the_end_are_close() {
    for ([speed, length], line, forcing) in starts() {
        let mut series = Regularised::new(start([speed, length], line, forcing));
        series.extend_to_8();
        let sigma = series.guess();
        let miss = series.at(8, sigma).theta - 1.0;
        assert!(miss.abs() < SMALL_MISS, "{speed} on {line:?}: {miss:e}");
    }
}

/// The first guess of a passage is so close that no other is needed. Slow motions turn before they pass.
#[test]
fn first_guesses_of_a_passage_are_close() {
    for ([speed, length], line, forcing) in starts().filter(|([speed, _], ..)| speed.abs() > 1.0) {
        let mut series = Regularised::new(start([speed, length], line, forcing));
        series.extend_to_8();
        let goal = 0.015 * speed;
        let x = series.guess_of_passage(goal);
        let Values { growth, slope, .. } = series.at(8, x);
        let shift = (goal - growth) / slope;
        assert!(shift.abs() < SMALL_STEP * x, "{speed} on {line:?}: {shift:e} of {x}");
    }
}

/// The motion a small shift on agrees with the series up to terms of third order in the shift.
#[test]
fn a_small_shift_needs_no_new_sum() {
    for ([speed, length], line, forcing) in starts() {
        let mut series = Regularised::new(start([speed, length], line, forcing));
        series.extend_to_8();
        // as `shifted` leaves out the terms after y₅
        (6..=8).for_each(|n| series.y[n] = 0.0);
        let (x, shift) = (0.8, 1e-3);
        let [now, then] = [x, x + shift].map(|x| series.at(8, x));
        let moved = series.shifted(x, [now.growth, now.slope, now.bend], shift);
        // bounds on y‴/6 and y⁗/6 for x up to 1
        let [y3, y4, y5] = [3, 4, 5].map(|n| series.y[n].abs());
        let terms = [y3 + 4.0 * y4 + 10.0 * y5, 4.0 * y4 + 20.0 * y5];
        for (found, expected, bound) in [(moved[0], then.growth, terms[0]), (moved[1], then.slope, terms[1])]
        {
            // and a few roundings
            assert!((found - expected).abs() <= bound * shift.powi(3) + 1e-15, "{found} for {expected}");
        }
    }
}

/// From a guess that misses by up to `SMALL_MISS` the expansion leads to the end of the step.
#[test]
fn a_small_miss_leads_to_the_end() {
    for ([speed, length], line, forcing) in starts() {
        let mut series = Regularised::new(start([speed, length], line, forcing));
        series.extend_to_8();
        let Some(expected) = series.end_from(series.guess(), 1e-13) else { continue };
        for miss in [-0.9 * SMALL_MISS, 0.9 * SMALL_MISS] {
            let found = series.end_from(series.guess() + miss, 1e-13).expect("a series that reaches");
            for (found, expected) in found.into_iter().zip(expected) {
                // third order in the miss, and a few roundings
                assert!((found - expected).abs() <= 1e-15, "{speed} on {line:?}: {found} for {expected}");
            }
        }
    }
}

/// A series whose seventh and eighth terms are small by chance is not taken for exact.
#[test]
fn a_pair_that_is_small_by_chance_ends_no_series() {
    let start = Start {
        velocity: 0.329_743_348_744_494_5,
        driving: -0.044_126_231_109_285_15,
        rate: -2.142_715_727_186_584_8e-4,
        half_kappa: -0.502_251_412_753_074,
        stiffness: -2.452_5e-4,
        damping: 0.010_995_945_853_256_826,
    };
    let mut series = Regularised::new(start);
    series.extend_to_8();
    let sigma = series.guess();
    assert!(series.y[7].abs().max(series.y[8].abs()) < 1e-4 * series.y[5].abs());
    assert_ne!(series.extend(sigma, 3.5e-14), Some(8));
}

/// What a series leaves out is 2N m₁ q/(1 − q), with m₀ and m₁ the larger terms of its last two pairs and
/// q = m₁/m₀. The q of the numerator is 1/100 at least.
#[test]
fn the_last_two_pairs_say_what_a_series_leaves_out() {
    let mut series = Regularised::new(start([1.0, 0.05], [0.4, 0.6], 0.7));
    let sigma = 0.8_f64;
    for (terms, [before, last]) in [
        ([3e-3, 1e-3, 4e-4, 2e-4], [3e-3, 4e-4]),
        ([-1e-3, -3e-3, 2e-4, -4e-4], [3e-3, 4e-4]),
        ([1e-3, 3e-3, 2e-6, 1e-6], [3e-3, 2e-6]),
    ] {
        for (n, term) in (5..).zip(terms) {
            series.y[n] = term / sigma.powi(n.try_into().expect("a small order"));
        }
        let ratio = f64::max(last, 0.01 * before) / before;
        let most = 16.0 * last * ratio / (1.0 - last / before) / CAUTION;
        let reaches = |share: f64| series.reaches::<8>(sigma, share * most);
        assert!(reaches(1.0 + 1e-12) && !reaches(1.0 - 1e-12), "{terms:?}");
    }
}

/// A step that ends when u passes a value ends with that value.
#[test]
fn passages_are_ends_of_shorter_steps() {
    let (mut found, mut worst) = (0, 0.0_f64);
    for ([speed, length], line, forcing) in starts().filter(|([speed, _], ..)| speed.abs() > 1.0) {
        let rise = 0.03 * speed;
        let series = Regularised::new(start([speed, length], line, forcing));
        let Some([share, velocity]) = series.passage(rise, 1e-12) else { continue };
        found += 1;
        let shorter = Regularised::new(start([speed, length * share], line, forcing));
        let end = shorter.end(1e-12).expect("a series that reaches");
        worst = worst.max((end[0] - rise).abs()).max((end[1] - share * velocity).abs());
    }
    assert!(found > 150, "{found}");
    // the tolerance of both
    assert!(worst <= 2e-12, "{worst:e}");
}
