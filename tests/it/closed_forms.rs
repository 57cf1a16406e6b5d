//! Closed forms from the theory, to 1e-12 of their scale.

use rocking_wall::simulation::Simulation;
use rocking_wall::solver::{Phase, Segment};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, RestitutionSource};
use rocking_wall::wall::{Parameters, Support, equivalence, restitution};

use crate::{start, still};

/// Relative to the scale of the quantity.
const TOLERANCE: f64 = 1e-12;

fn undamped() -> Parameters {
    Parameters { damping_model: DampingModel::None, impact: Impact::None, ..Parameters::default() }
}

fn free(simulation: &mut Simulation, duration: f64) {
    simulation.advance(&still(duration)).expect("a free motion");
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

/// Moves a wall under a forcing linear between two values, as fractions of that at which it uplifts.
fn force(simulation: &mut Simulation, duration: f64, ends: [f64; 2]) {
    let body = simulation.wall().body();
    let onset = body.strength.positive / body.effective_mass / body.forcing(Support::rigid(1.0));
    let [from, to] = ends.map(|end| Support::rigid(onset * end));
    simulation.advance(&Segment { duration, from, to }).expect("a bounded motion");
}

/// A rigid wall at rest that the forcing lifts: with τ from uplift on, r the rate and Δ the jump of the
/// forcing there, and ω² = k₀/m_eff, u = Δ/ω² (cosh ωτ − 1) + r/ω³ (sinh ωτ − ωτ). Nothing but one piece of
/// motion happens. It leaves rest at the start of a step, within one, or where e = 0 has stopped it before.
#[test]
fn rest_ends_where_the_forcing_leaves_its_band() {
    let rigid = Parameters {
        force_law: ForceLaw::RigidLinear,
        impact: Impact::Restitution,
        restitution: 0.0,
        u_start: 0.0,
        ..undamped()
    };
    let slender = Parameters { height: 10.0, thickness: 0.01, ..rigid.clone() };
    // forcing and rate far from 1, so that their sums differ from their products
    let slow = Parameters { gravity: 1e-8, ..rigid.clone() };
    let mut compared = 0;
    for (wall, released) in [(&rigid, 0.0), (&slender, 0.0), (&slow, 0.0), (&rigid, 1e-4), (&slow, 1e-4)] {
        for index in 0..400_u32 {
            let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
            let spread = |factor: f64| (factor * f64::from(index)).fract();
            // ramps within a step, and jumps at its start
            let jumps = released == 0.0 && index % 4 > 1;
            let (from, to) = if released > 0.0 {
                (0.0, 1.02 + 0.5 * spread(0.377))
            } else if jumps {
                (1.02 + 0.2 * spread(0.618), 0.95 + spread(0.377))
            } else {
                (-0.95 + 1.8 * spread(0.618), 1.02 + 0.5 * spread(0.377))
            };
            let u_ins = start(wall).wall().body().instability.positive;
            let mut simulation = start(&Parameters { u_start: released * u_ins, ..wall.clone() });
            let rate = simulation.wall().rocking_rate();
            let (onset, duration) = (u_ins * rate * rate, 0.5 / rate);
            force(&mut simulation, duration, [from * sign, to * sign]);
            let growth = onset * (to - from) / duration;
            let (leaving, jump) =
                if jumps { (0.0, onset * (from - 1.0)) } else { (onset * (1.0 - from) / growth, 0.0) };
            let (after, scale) = (rate * (duration - leaving), onset / (rate * rate));
            let expected =
                jump / (rate * rate) * (after.cosh() - 1.0) + growth / rate.powi(3) * (after.sinh() - after);
            let (state, work) = (simulation.progress().state, simulation.progress().work);
            let error = (sign * state.displacement - expected).abs() / scale;
            assert!(error < TOLERANCE, "{from} to {to}: off by {error:e}");
            // the fall to u = 0 is another piece
            let falls = u64::from(released > 0.0);
            assert_eq!((work.pieces, work.corners), (falls + 1, falls), "{from} to {to}");
            compared += 1;
        }
    }
    assert_eq!(compared, 2000);
}

/// At the very edge of its band a wall rests: under a constant forcing, under one that goes back, and up to
/// the other edge.
#[test]
fn rest_goes_on_at_the_edge_of_its_band() {
    let rigid = Parameters { force_law: ForceLaw::RigidLinear, u_start: 0.0, ..undamped() };
    for sign in [1.0, -1.0] {
        let mut simulation = start(&rigid);
        let band = simulation.wall().rest_band();
        let body = simulation.wall().body();
        let edge = band[usize::from(sign > 0.0)];
        let support = Support::rigid(edge / body.forcing(Support::rigid(1.0)));
        assert_eq!(body.forcing(support), edge, "the very edge");
        let rest = Support::default();
        for to in [support, rest] {
            simulation.advance(&Segment { duration: 0.1, from: support, to }).expect("rest");
            let progress = simulation.progress();
            assert_eq!((progress.state.phase, progress.work.pieces), (Phase::Resting, 0), "{to:?}");
        }
        let beyond = rest.towards(support, -1.5);
        simulation.advance(&Segment { duration: 0.1, from: support, to: beyond }).expect("uplift");
        let progress = simulation.progress();
        assert!(sign * progress.state.displacement < 0.0, "{}", progress.state.displacement);
        assert_eq!((progress.work.pieces, progress.work.corners), (1, 0));
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

/// A rigid wall that keeps nearly all of its velocity is put to rest at the 100,000th impact of a segment.
/// The step says so.
#[test]
fn too_many_impacts_end_at_rest() {
    let mut simulation = start(&Parameters {
        force_law: ForceLaw::RigidLinear,
        impact: Impact::Restitution,
        restitution: 0.9999,
        u_start: 1e-6,
        ..undamped()
    });
    let step = simulation.advance(&still(1e3)).expect("it ends at rest");
    let progress = simulation.progress();
    assert!(step.put_to_rest);
    assert_eq!((progress.state.phase, progress.work.impacts), (Phase::Resting, 100_000));
    let step = simulation.advance(&still(1e3)).expect("it rests");
    assert!(!step.put_to_rest);
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

/// The moments about the new base hinge give Eq. (3) at h₁ = h/2, and only there.
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
        rocking_wall::wall::Wall::new(&parameters).expect("a valid wall").restitution().positive
    };
    let (momentum, analytic) = (RestitutionSource::Momentum, RestitutionSource::Analytic);
    assert!((wall(0.5, momentum) - wall(0.5, analytic)).abs() < TOLERANCE);
    assert!((wall(0.6, momentum) - wall(0.6, analytic)).abs() > 1e-4);
}
