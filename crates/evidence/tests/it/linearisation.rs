//! Tests full rotations beside small ones: Housner's block, Figures 2 and 3 of the paper.

use evidence::reproduce::rotations::{Rotations, STARTS, periods, wall};
use rocking_wall::variables::Mechanism;
use rocking_wall::wall::Parameters;
use run::rotations::period;

/// Integrates f over 0…1 by the tanh-sinh rule (Takahasi and Mori, 1974), which tolerates singular
/// derivatives at the ends.
fn quadrature(f: impl Fn(f64) -> f64) -> f64 {
    let step = 1.0 / 64.0;
    let term = |index: i32| {
        let t = f64::from(index) * step;
        let inner = std::f64::consts::FRAC_PI_2 * t.sinh();
        let weight = std::f64::consts::FRAC_PI_2 * t.cosh() / inner.cosh().powi(2);
        0.5 * weight * f(1.0 / (1.0 + (-2.0 * inner).exp()))
    };
    step * (-200..=200).map(term).sum::<f64>()
}

/// Housner's block from the energy integral, θ̇² = 2p² (cos(α − θ) − cos(α − θ₀)), independent of the
/// program.
#[test]
fn the_quarter_period_of_housners_block() {
    for (thickness, start) in [(0.4, 0.9), (0.4, 0.1), (1.2, 0.5), (0.04, 0.99)] {
        let wall = Parameters { thickness, ..wall(Mechanism::Parapet) };
        let alpha = libm::atan2(thickness, wall.height);
        let radius = 0.5 * thickness.hypot(wall.height);
        let p = (0.75 * wall.gravity / radius).sqrt();
        let first = start * alpha;
        // θ = θ₀ (1 − y²), and cos a − cos b = 2 sin((a + b)/2) sin((b − a)/2) does not cancel
        let quarter = quadrature(|y| {
            let fallen = first * y * y;
            let drop = 2.0 * libm::sin(alpha - first + 0.5 * fallen) * libm::sin(0.5 * fallen);
            2.0 * first * y / (p * (2.0 * drop).sqrt())
        });
        let found = period(&wall, start).unwrap().trigonometric / 4.0;
        // the tolerance of 1e-12 u_ins over the velocity at the impact, at most 1e-11 here
        assert!((found / quarter - 1.0).abs() < 1e-10, "b = {thickness}, {start}: {found} {quarter}");
    }
}

#[test]
fn figure_2_of_the_paper() {
    let parapet = Rotations::of(Mechanism::Parapet).unwrap();
    assert!((parapet.trigonometric.impacts[0] - 1.56459).abs() < 1e-5);
    assert!((parapet.linear.impacts[0] - 1.56059).abs() < 1e-5);
    let apart = parapet.largest_difference();
    assert!((0.085..0.09).contains(&apart), "{apart}");
    let strip = Rotations::of(Mechanism::VerticalSpanning).unwrap();
    // the time to the first impact 1.97 % short, and more as the amplitude falls
    let ratio = |impact: usize| strip.linear.impacts[impact] / strip.trigonometric.impacts[impact];
    let short = 1.0 - ratio(0);
    assert!((0.019..0.022).contains(&short), "{short}");
    assert!((1..10).all(|n| ratio(n) < ratio(n - 1)));
    let apart = strip.largest_difference();
    assert!((0.38..0.40).contains(&apart), "{apart}");
    // they differ in phase, not in size
    assert!(strip.largest_amplitude_difference() < 2e-3, "{}", strip.largest_amplitude_difference());
    assert!(parapet.largest_amplitude_difference() < 2e-4);
}

#[test]
fn figure_3_of_the_paper() {
    for start in STARTS {
        let periods = periods(Mechanism::Parapet, &[0.1, 0.2, 0.3], start).unwrap();
        for (period, expected) in periods.iter().zip([0.9975, 0.990, 0.977]) {
            let ratio = period.over_housner().unwrap();
            assert!((ratio - expected).abs() < 5e-4, "{period:?}");
            // both periods are acosh over a rate: √cos α is exact
            assert!((ratio - period.slenderness.cos().sqrt()).abs() < 1e-12, "{period:?}");
        }
    }
}

/// The error of small rotations is O(α²): halving α divides it by 4.
#[test]
fn small_rotations_are_the_limit() {
    for mechanism in [Mechanism::Parapet, Mechanism::VerticalSpanning] {
        let angles = [0.08, 0.04, 0.02, 0.01];
        let periods = periods(mechanism, &angles, 0.6).unwrap();
        let errors: Vec<f64> = periods.iter().map(|period| 1.0 - period.ratio()).collect();
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            // the next term is O(α⁴), relatively α² = 0.0064 at most
            assert!((order - 2.0).abs() < 0.02, "{mechanism:?}: {errors:?}");
        }
    }
}
