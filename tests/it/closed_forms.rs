//! Closed forms from the theory, to 1e-12 of their scale.

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::Segment;
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, RestitutionSource};
use rocking_wall::wall::{Parameters, Support, equivalence, restitution};

/// Relative to the scale of the quantity.
const TOLERANCE: f64 = 1e-12;

fn undamped() -> Parameters {
    Parameters { damping_model: DampingModel::None, impact: Impact::None, ..Parameters::default() }
}

fn free(simulation: &mut Simulation, duration: f64) {
    let still = Support::default();
    simulation.advance(&Segment { duration, from: still, to: still }).expect("a free motion");
}

fn start(parameters: &Parameters) -> Simulation {
    Simulation::new(parameters, None, 0.0, Support::default()).expect("a valid wall")
}

/// u = e^{−ξωt} (A cos ω_d t + B sin ω_d t), under-, over- and critically damped, in steps of any size.
#[test]
fn elastic_free_vibration() {
    for xi in [0.0, 0.05, 0.7, 1.0, 2.0] {
        for (displacement, velocity) in [(0.004, 0.0), (0.0, 0.02), (-0.003, 0.01)] {
            let parameters = Parameters {
                damping_model: DampingModel::ConstantCoefficient,
                xi,
                a1: 0.05,
                u_start: displacement,
                u_dot_start: velocity,
                ..undamped()
            };
            for step in [0.001, 0.013, 0.37, 5.0] {
                let mut simulation = start(&parameters);
                let omega = simulation.wall().omega1();
                let expected = |t: f64| {
                    let s = xi * omega;
                    let (even, odd) = if xi < 1.0 {
                        let damped = omega * (1.0 - xi * xi).sqrt();
                        ((damped * t).cos(), (damped * t).sin() / damped)
                    } else if xi == 1.0 {
                        (1.0, t)
                    } else {
                        let damped = omega * (xi * xi - 1.0).sqrt();
                        ((damped * t).cosh(), (damped * t).sinh() / damped)
                    };
                    (-s * t).exp() * (displacement * even + (velocity + s * displacement) * odd)
                };
                let mut steps = 0;
                while f64::from(steps) * step < 5.0 {
                    free(&mut simulation, step);
                    steps += 1;
                    let time = f64::from(steps) * step;
                    let found = simulation.progress().state.displacement;
                    // the expected phase ω t itself has a rounding error of ε ω t
                    let error = (found - expected(time)).abs() / 0.01;
                    assert!(error < TOLERANCE, "xi {xi}, step {step}, t {time}: off by {error:e}");
                }
            }
        }
    }
}

/// Rigid-linear release: u = u_ins − (u_ins − u₀) cosh(t √(k₀/m_eff)), so a quarter period lasts
/// acosh(1/(1 − u₀/u_ins))/√(k₀/m_eff): Eq. (5) with the frequency of the linearised wall.
#[test]
fn rigid_quarter_period() {
    for ratio in [0.01, 0.3, 0.9, 0.999] {
        let parameters = Parameters { force_law: ForceLaw::RigidLinear, u_start: 0.2 * ratio, ..undamped() };
        let mut simulation = start(&parameters);
        let rate = simulation.wall().rocking_rate();
        let u_ins = simulation.wall().body().instability.positive;
        let start_ratio = simulation.progress().state.displacement / u_ins;
        let quarter = equivalence::housner_period(rate, start_ratio) / 4.0;
        free(&mut simulation, 0.5 * quarter);
        let expected = u_ins * (1.0 - (1.0 - start_ratio) * (rate * 0.5 * quarter).cosh());
        let found = simulation.progress().state.displacement;
        assert!((found - expected).abs() / u_ins < TOLERANCE, "u0 = {ratio} u_ins: {found} for {expected}");
        free(&mut simulation, 0.5 * quarter);
        let state = simulation.progress().state;
        let speed = rate * u_ins * (1.0 - (1.0 - start_ratio).powi(2)).sqrt();
        assert!(state.displacement.abs() / u_ins < TOLERANCE, "u0 = {ratio} u_ins: {}", state.displacement);
        assert!((state.velocity + speed).abs() / speed < TOLERANCE, "u0 = {ratio} u_ins: {}", state.velocity);
    }
}

/// Restitution: after n impacts the amplitude obeys 1 − (1 − uₙ/u_ins)² = e²ⁿ (1 − (1 − u₀/u_ins)²), behind
/// Eq. (13).
#[test]
fn decay_by_restitution() {
    let e = 0.9;
    let parameters = Parameters {
        force_law: ForceLaw::RigidLinear,
        impact: Impact::Restitution,
        restitution: e,
        u_start: 0.18,
        ..undamped()
    };
    let mut simulation = start(&parameters);
    let rate = simulation.wall().rocking_rate();
    let u_ins = simulation.wall().body().instability.positive;
    let energy = 1.0 - (1.0 - 0.18 / u_ins).powi(2);
    let mut amplitude = 0.18 / u_ins;
    for n in 1..=12 {
        let next = 1.0 - (1.0 - e.powi(2 * n) * energy).sqrt();
        let quarter = |ratio: f64| equivalence::housner_period(rate, ratio) / 4.0;
        free(&mut simulation, quarter(amplitude) + quarter(next));
        let state = simulation.progress().state;
        let found = state.displacement.abs() / u_ins;
        assert!((found - next).abs() < TOLERANCE, "after {n} impacts: {found} for {next}");
        assert_eq!(simulation.progress().work.impacts, u64::from(n.unsigned_abs()));
        amplitude = next;
    }
    assert!(
        (equivalence::priestley(e, 0.9, 2)
            - (0.9_f64 / (1.0 - (1.0 - 0.9_f64.powi(4) * 0.99).sqrt())).ln() / (2.0 * std::f64::consts::PI))
            .abs()
            < TOLERANCE
    );
}

/// Table 5 of the paper: the analytic and calibrated e of the nine walls, to the last printed digit.
#[test]
fn restitution_of_table_5() {
    // h, b, vertical spanning, e_an, e_exp
    let rows = [
        (6.0, 1.2, false, 0.942, 0.895),
        (1.5, 0.3, false, 0.942, 0.895),
        (3.0, 0.3, false, 0.985, 0.935),
        (12.0, 1.2, false, 0.985, 0.935),
        (3.0, 0.6, false, 0.942, 0.895),
        (6.0, 0.6, false, 0.985, 0.935),
        (5.0, 0.3, true, 0.979, 0.881),
        (3.75, 0.24, true, 0.976, 0.878),
        (3.4, 0.36, true, 0.935, 0.842),
    ];
    for (h, b, vertical, e_an, e_exp) in rows {
        // the vertical spanning walls follow with h₁ = 0.58 h
        let height: f64 = if vertical { 0.58 * h } else { h };
        let angle = (b / height).atan();
        let (found, ratio) = if vertical {
            (restitution::analytic_vertical_spanning(angle), 0.90)
        } else {
            (restitution::analytic_parapet(angle), 0.95)
        };
        assert!((found - e_an).abs() <= 0.000_501, "h = {h}, b = {b}: e_an = {found}, printed {e_an}");
        assert!((found * ratio - e_exp).abs() <= 0.001, "h = {h}, b = {b}: e_exp = {}", found * ratio);
    }
}

/// Eq. (3) is the conservation of angular momentum at h₁ = h/2, and only there.
#[test]
fn momentum_equals_eq_3_at_mid_height() {
    let wall = |hinge_ratio, source| {
        let parameters = Parameters {
            mechanism: rocking_wall::variables::Mechanism::VerticalSpanning,
            thickness: 0.1,
            height: 2.68,
            hinge_ratio,
            restitution_source: source,
            u_start: 0.0,
            ..undamped()
        };
        rocking_wall::wall::Wall::new(&parameters).expect("a valid wall").restitution()
    };
    let (momentum, analytic) = (RestitutionSource::Momentum, RestitutionSource::Analytic);
    assert!((wall(0.5, momentum) - wall(0.5, analytic)).abs() < TOLERANCE);
    assert!((wall(0.6, momentum) - wall(0.6, analytic)).abs() > 1e-4);
}
