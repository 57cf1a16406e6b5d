//! Closed forms and series against a reference: the Taylor series of the equation itself, in short steps.

use super::*;

/// Rounding of the closed forms.
const ROUNDING: f64 = 2e-14;

/// Damping \[1/s\] and stiffness \[1/s²\]: free, oscillating, close to critical damping on both sides, beyond
/// it, a dashpot, softening.
const OSCILLATORS: [[f64; 2]; 11] = [
    [0.0, 0.0],
    [0.0, 9.0],
    [0.6, 9.0],
    [5.99, 9.0],
    [6.0, 9.0],
    [6.000_000_1, 9.0],
    [6.01, 9.0],
    [10.0, 9.0],
    [3.0, 0.0],
    [0.0, -9.0],
    [0.8, -9.0],
];

/// Times \[s\] before and beyond those up to which series serve.
const TIMES: [f64; 8] = [1e-6, 1e-3, 0.08, 0.16, 0.3, 0.45, 0.9, 2.5];

/// Oscillators so slow that series serve for 25 s, mostly by their damping and mostly by their stiffness.
const SLOW: [[f64; 2]; 2] = [[0.03, 1e-6], [2e-3, 1.4e-3]];

fn cases() -> impl Iterator<Item = ([f64; 2], f64)> {
    let usual = OSCILLATORS.into_iter().flat_map(|parameters| TIMES.map(|time| (parameters, time)));
    usual.chain(SLOW.map(|parameters| (parameters, 25.0)))
}

const START: KinematicState = KinematicState { displacement: 0.7, velocity: -1.3, acceleration: 2.1 };
const RATE: f64 = -4.3;

fn close(found: f64, wanted: f64, scale: f64) -> bool {
    (found - wanted).abs() <= ROUNDING * scale.max(wanted.abs())
}

fn make([c, k]: [f64; 2]) -> Oscillator {
    Oscillator::new(c, k)
}

/// Follows ∫u, u, u̇, ü by Taylor series of steps of which the terms fall faster than 0.1ⁿ/n!.
fn reference([c, k]: [f64; 2], start: KinematicState, rate: f64, time: f64) -> [f64; 4] {
    let steps =
        (1..10_000_u32).find(|&steps| f64::from(steps) >= 10.0 * time * (c + k.abs().sqrt())).unwrap();
    let step = time / f64::from(steps);
    let KinematicState { displacement, velocity, acceleration } = start;
    let mut now = [0.0, displacement, velocity, acceleration];
    for _ in 0..steps {
        // ∫u and its derivatives: u⁽ⁿ⁺²⁾ = −c u⁽ⁿ⁺¹⁾ − k u⁽ⁿ⁾ from the fourth derivative of u on
        let mut derivatives = now.to_vec();
        derivatives.push(rate - c * now[3] - k * now[2]);
        for n in 5..20 {
            derivatives.push(-c * derivatives[n - 1] - k * derivatives[n - 2]);
        }
        now = [0, 1, 2, 3].map(|first| {
            let terms = derivatives[first..].iter().enumerate().rev();
            terms.fold(0.0, |sum, (n, derivative)| sum * step / (n as f64 + 1.0) + derivative)
        });
    }
    now
}

/// Returns the sizes to which rounding refers: the sums of the parts of ∫u, u, u̇ and ü, each as large as it
/// may become.
fn scales([c, k]: [f64; 2], start: KinematicState, rate: f64, time: f64) -> [f64; 4] {
    let [u, v, a] = [start.displacement, start.velocity, start.acceleration].map(f64::abs);
    // each derivative adds at most this, as does each integral the time
    let fast = c + k.abs().sqrt();
    let growth = if k < 0.0 { ((-k).sqrt() * time).exp() } else { 1.0 };
    let acceleration = growth * (a + (c * a + k.abs() * v + rate.abs()) * time);
    let velocity = growth * v + acceleration * time;
    let displacement = u + velocity * time;
    [displacement * time, displacement, velocity, acceleration + fast * velocity]
}

fn assert_close(found: KinematicState, wanted: [f64; 4], scales: [f64; 4], what: &str) {
    let found = [found.displacement, found.velocity, found.acceleration];
    for (n, found) in found.into_iter().enumerate() {
        let (wanted, scale) = (wanted[n + 1], scales[n + 1]);
        assert!(close(found, wanted, scale), "{what}, derivative {n}: {found:e} for {wanted:e}");
    }
}

#[test]
fn every_way_gives_the_motion_of_the_equation() {
    for (parameters, time) in cases() {
        let oscillator = make(parameters);
        let what = format!("c, k = {parameters:?} at {time} s");
        let wanted = reference(parameters, START, RATE, time);
        let scales = scales(parameters, START, RATE, time);
        assert_close(oscillator.propagate(START, RATE, time), wanted, scales, &what);
        let integral = oscillator.displacement_integral(START, RATE, time);
        assert!(close(integral, wanted[0], scales[0]), "{what}: {integral:e} for {:e}", wanted[0]);
        let series = [
            oscillator.series_from(START, RATE, time).map(|series| series.at(time)),
            oscillator.series_at(START, RATE, time),
        ];
        let [c, k] = parameters;
        for found in series {
            assert_eq!(found.is_some(), c * time + k.abs() * time * time <= 1.0, "{what}");
            if let Some(found) = found {
                assert_close(found, wanted, scales, &what);
            }
        }
    }
}

/// G and H are u and ∫u after a unit impulse, J and K after a load that grows at a unit rate.
#[test]
fn green_s_functions_are_those_of_an_impulse_and_a_ramp() {
    let rest = KinematicState { displacement: 0.0, velocity: 0.0, acceleration: 0.0 };
    for (parameters, time) in cases() {
        let impulse = KinematicState { velocity: 1.0, acceleration: -parameters[0], ..rest };
        let Green { g, h, j, k } = make(parameters).green(time);
        for (integral, u, start, rate) in [(h, g, impulse, 0.0), (k, j, rest, 1.0)] {
            let wanted = reference(parameters, start, rate, time);
            let scales = scales(parameters, start, rate, time);
            let what = format!("c, k = {parameters:?} at {time} s, rate {rate}");
            assert!(close(u, wanted[1], scales[1]), "{what}: {u:e} for {:e}", wanted[1]);
            assert!(close(integral, wanted[0], scales[0]), "{what}: {integral:e} for {:e}", wanted[0]);
        }
    }
}

/// At c t + |k| t² = 1, too, the series serve, and they end with the first term below 1e-18 of the sum.
#[test]
fn series_have_the_terms_they_need() {
    for (parameters, time) in [([0.0, 1.0], 1.0), ([1.0, 0.0], 1.0), ([0.5, -2.0], 0.5)] {
        assert!(make(parameters).series_from(START, RATE, time).is_some(), "{parameters:?}");
        assert!(make(parameters).series_at(START, RATE, time).is_some(), "{parameters:?}");
    }
    for (parameters, time) in [([0.0, 1.0], 1.0), ([0.5, -2.0], 0.5), ([0.6, 9.0], 0.01), ([0.0, 9.0], 1e-7)]
    {
        let [c, k] = parameters;
        let ratio = (c + f64::abs(k).sqrt()) * time;
        // a term of ü with tⁿ is at most xⁿ/n! of the first ones
        let mut needed = 3;
        let mut term = ratio;
        while term >= 1e-18 {
            needed += 1;
            term = (1..=needed - 2).fold(1.0, |product, n| product * ratio / n as f64);
        }
        let series = make(parameters).series_from(START, RATE, time).unwrap();
        assert_eq!(series.order, needed, "c, k = {parameters:?} at {time} s");
    }
}

/// A softening oscillator on its decaying mode keeps its digits where the growing mode is 3e6 times as large.
#[test]
fn a_decaying_motion_keeps_its_digits() {
    let start = KinematicState { displacement: 1.0, velocity: -3.0, acceleration: 9.0 };
    let KinematicState { displacement, velocity, acceleration } =
        make([0.0, -9.0]).propagate(start, 0.0, 2.5);
    let decayed = (-7.5_f64).exp();
    assert!(close(displacement, decayed, 1.0), "{displacement:e}");
    assert!(close(velocity, -3.0 * decayed, 0.0) && close(acceleration, 9.0 * decayed, 0.0));
}

#[test]
fn regimes_have_their_frequency_or_rates_and_a_longest_piece() {
    for [c, k] in OSCILLATORS {
        let oscillator = Oscillator::new(c, k);
        assert_eq!([oscillator.damping(), oscillator.stiffness()], [c, k]);
        let discriminant = k - c * c / 4.0;
        match oscillator.regime() {
            Regime::Oscillating(omega) => {
                assert!(discriminant >= 0.0);
                assert!(close(omega, discriminant.sqrt(), 0.0));
                // a little more than the period
                let longest = oscillator.longest_piece();
                assert!(omega == 0.0 || close(longest, 7.0 / omega, 0.0), "{longest} s");
                assert!(longest >= 1e300 || omega > 0.0, "{longest} s");
            }
            Regime::Exponential(slow, fast) => {
                assert!(discriminant < 0.0);
                assert!(close(slow + fast, -c, c.max(1.0)) && close(slow * fast, k, 1.0));
                assert!(slow > fast);
                let longest = if k < 0.0 { 36.0 / slow } else { f64::INFINITY };
                assert_eq!(oscillator.longest_piece(), longest);
            }
        }
    }
    // r₁ − r₂ = 2/s: the modes have parted after 0.25 s
    let softening = Oscillator::new(0.0, -1.0);
    assert!(softening.is_spread(0.25) && !softening.is_spread(0.249));
    assert!(!Oscillator::new(0.0, 1.0).is_spread(10.0));
}

/// The bounds hold, and without damping are reached by a motion that starts with ü or with the jerk alone.
#[test]
fn bounds_are_reached_without_damping_and_hold_with_it() {
    for parameters in OSCILLATORS {
        for length in TIMES {
            let Bounds { acceleration, jerk } = make(parameters).bounds(START, RATE, length);
            for part in 0..=20 {
                let time = length * f64::from(part) / 20.0;
                let now = make(parameters).propagate(START, RATE, time);
                let what = format!("c, k = {parameters:?} at {time} s of {length} s");
                assert!(now.acceleration.abs() <= acceleration * (1.0 + ROUNDING), "{what}");
                assert!(make(parameters).jerk(now, RATE).abs() <= jerk * (1.0 + ROUNDING), "{what}");
            }
        }
    }
    let at = |acceleration: f64| KinematicState { displacement: 0.3, velocity: 0.0, acceleration };
    let near = |found: Bounds, [acceleration, jerk]: [f64; 2]| {
        close(found.acceleration, acceleration, 0.0) && close(found.jerk, jerk, 0.0)
    };
    // ω = 3: ü = 2 cos 3t, or (6/3) sin 3t
    let stiff = Oscillator::new(0.0, 9.0);
    assert!(near(stiff.bounds(at(-2.0), 0.0, 10.0), [2.0, 6.0]));
    assert!(near(stiff.bounds(at(0.0), -6.0, 10.0), [2.0, 6.0]));
    // ü = 2 cosh 3t, its rate 6 sinh 3t ≤ 18 t cosh 3t; beyond 3t = 1 as for shorter times
    let softening = Oscillator::new(0.0, -9.0);
    let cosh = 3.0_f64.cosh();
    assert!(near(softening.bounds(at(-2.0), 0.0, 1.0), [2.0 * cosh, 18.0 * cosh]));
    let Bounds { acceleration: a, jerk } = softening.bounds(at(-2.0), 0.0, 1.0 / 3.0);
    assert!((a / (2.0 * 1.0_f64.cosh()) - 1.0).abs() < 2e-5 && close(jerk, 3.0 * a, 0.0));
    // ü = 5 sinh(3t)/3 ≤ 5 t cosh 3t, its rate 5 cosh 3t
    assert!(near(softening.bounds(at(0.0), 5.0, 1.0), [5.0 * cosh, (5.0 + 45.0) * cosh]));
}

#[test]
fn known_responses() {
    for t in [1e-6_f64, 1e-3, 0.3, 0.9, 1.1, 2.0, 30.0] {
        let free = Oscillator::new(0.0, 0.0).green(t);
        assert!(close(free.g, t, 0.0) && close(free.k, t.powi(4) / 24.0, 0.0));
        let undamped = Oscillator::new(0.0, 9.0).green(t);
        assert!(close(undamped.g, (3.0 * t).sin() / 3.0, 1.0));
        assert!(close(undamped.h, 2.0 * (1.5 * t).sin().powi(2) / 9.0, 1.0), "{t}");
        let critical = Oscillator::new(6.0, 9.0).green(t);
        assert!(close(critical.g, t * (-3.0 * t).exp(), t));
        let dashpot = Oscillator::new(3.0, 0.0).green(t);
        assert!(close(dashpot.g, -(-3.0 * t).exp_m1() / 3.0, 0.0));
        let over = Oscillator::new(10.0, 9.0).green(t);
        assert!(close(over.g, -(-t).exp() * (-8.0 * t).exp_m1() / 8.0, t));
    }
}
