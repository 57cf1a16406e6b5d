//! The bilinear floor: loops, corners, energy.

use rocking_floor::floor::{Branch, Floor, Parameters};
use rocking_floor::motion::{FloorState, Load};
use rocking_floor::variables::{Coupling, Hysteresis};

use super::{Driven, assert_close};

const MASS: f64 = 1.0e4;
const STIFFNESS: f64 = 4.0e6;
const YIELD_FORCE: f64 = 2.0e4;
/// Displacement at which the fresh floor yields \[m\].
const LIMIT: f64 = YIELD_FORCE / STIFFNESS;

fn parameters(hardening_ratio: f64, damping_ratio: f64) -> Parameters {
    Parameters {
        mass: MASS,
        stiffness: STIFFNESS,
        damping_ratio,
        damping_coefficient: 0.0,
        hysteresis: Hysteresis::Bilinear,
        yield_force: YIELD_FORCE,
        hardening_ratio,
        coupling: Coupling::Reactions,
        displacement_start: 0.0,
        velocity_start: 0.0,
    }
}

fn settings(hardening_ratio: f64, damping_ratio: f64) -> Vec<(&'static str, f64)> {
    vec![
        ("mass", MASS),
        ("stiffness", STIFFNESS),
        ("yield_force", YIELD_FORCE),
        ("hardening_ratio", hardening_ratio),
        ("damping_ratio", damping_ratio),
    ]
}

/// A kicked elasto-plastic mass: elastic to the limit, then a parabola, then around the new rest.
#[test]
fn a_kick_yields_as_energy_says() {
    let kick = 0.5;
    let floor = Floor::new(&parameters(0.0, 0.0)).unwrap();
    let mut state = FloorState::new(&floor, 0.0, kick, Load::default());
    let corners = state.advance(&floor, Load::default(), 5.0).unwrap().corners;
    assert_eq!(corners, 2);
    assert_eq!(state.branch, Branch::Elastic);
    // M v²/2 = F_y (x_max − x_y/2), and the slip is x_max − x_y
    let slip = 0.5 * MASS * kick * kick / YIELD_FORCE - 0.5 * LIMIT;
    assert_close(state.plastic, slip, 1e-15);
    assert_close(state.hysteretic_energy, YIELD_FORCE * slip, 1e-10);
    // it goes on around the slip with the limit as amplitude
    let omega = (STIFFNESS / MASS).sqrt();
    let amplitude = (state.displacement - state.plastic).hypot(state.velocity / omega);
    assert_close(amplitude, LIMIT, 1e-14);
}

/// Slow cycles trace the loop of the law; its area is the energy said to be lost.
#[test]
fn the_area_of_a_loop_is_the_energy_lost() {
    let hardening = 0.1;
    // critically damped, so that nothing overshoots
    let mut driven = Driven::new(&settings(hardening, 1.0), Hysteresis::Bilinear, Coupling::Reactions);
    // the force of four limits: F_y (1 + 3 α)
    let most = YIELD_FORCE * (1.0 + 3.0 * hardening);
    let mut before = (0.0, 0.0);
    // to a force in 400 s, then 60 s at rest: 60 time constants c/(α k) = 1 s
    let mut load = |driven: &mut Driven, from: f64, to: f64| {
        let (steps, step) = (40_000, 0.01);
        let mut area = 0.0;
        driven.set("reaction_1", -from);
        for n in 0..steps + 6000 {
            if n < steps {
                driven.rate("reaction_1", -(to - from) / (f64::from(steps) * step));
            }
            driven.step(step);
            let now = (driven.get("displacement"), driven.get("spring_force"));
            area += 0.5 * (now.1 + before.1) * (now.0 - before.0);
            before = now;
        }
        area
    };
    load(&mut driven, 0.0, most);
    assert_close(driven.get("displacement"), 4.0 * LIMIT, 1e-9 * LIMIT);
    load(&mut driven, most, -most);
    load(&mut driven, -most, most);
    let before = driven.get("energy_hysteretic");
    let area = load(&mut driven, most, -most) + load(&mut driven, -most, most);
    // the parallelogram: 4 F_y (1 − α) (x_max − x_y)
    let wanted = 4.0 * YIELD_FORCE * (1.0 - hardening) * 3.0 * LIMIT;
    let energy = driven.get("energy_hysteretic") - before;
    assert_close(energy, wanted, 1e-9 * wanted);
    // the trapezoidal rule cuts the corners of a loop that is 4e5 steps long
    assert_close(area, energy, 1e-7 * wanted);
}

/// What the loads have done is stored or lost, under any motion and at any step.
#[test]
fn energy_balances_and_steps_do_not_matter() {
    let floor = Floor::new(&parameters(0.05, 0.02)).unwrap();
    let run = |pieces: u32| {
        let mut state = FloorState::new(&floor, 0.0, 0.1, Load::default());
        let (mut work, mut corners) = (0.0, 0);
        for n in 0..40_u32 {
            // a sawtooth of ±3 m/s², linear within 0.12 s: 1.5 times the yield force
            let (from, rate) = if n % 2 == 0 { (-3.0, 50.0) } else { (3.0, -50.0) };
            let length = 0.12 / f64::from(pieces);
            for piece in 0..pieces {
                let load = Load { value: from + rate * length * f64::from(piece), rate };
                corners += state.advance(&floor, load, length).unwrap().corners;
            }
            work += state.displacement;
        }
        (state, work, corners)
    };
    let (one, mean, corners) = run(1);
    assert!(corners > 40, "{corners} corners");
    for pieces in [3, 64, 1000] {
        let (many, other_mean, same) = run(pieces);
        assert_eq!(same, corners);
        // 40 000 steps of rounding, each some ε of 0.02 m
        assert_close(many.displacement, one.displacement, 1e-12);
        assert_close(many.velocity, one.velocity, 1e-11);
        assert_close(many.plastic, one.plastic, 1e-12);
        assert_close(many.hysteretic_energy, one.hysteretic_energy, 1e-8);
        assert_close(many.damping_energy, one.damping_energy, 1e-8);
        assert_close(other_mean, mean, 1e-11);
    }
    // without a load: the kinetic energy of a kick ends as elastic energy, damping and yielding
    let mut state = FloorState::new(&floor, 0.0, 1.0, Load::default());
    for _ in 0..50 {
        state.advance(&floor, Load::default(), 0.01).unwrap();
        let Floor { stiffness, hardening, .. } = floor;
        let stored = 0.5 * hardening * state.displacement.powi(2)
            + 0.5 * (stiffness - hardening) * (state.displacement - state.plastic).powi(2);
        let kinetic = 0.5 * MASS * state.velocity.powi(2);
        let lost = state.damping_energy + state.hysteretic_energy;
        // of 5000 J
        assert_close(stored + kinetic + lost, 0.5 * MASS, 1e-9);
    }
    assert!(state.hysteretic_energy > 1000.0 && state.damping_energy > 100.0);
}

#[test]
fn a_start_beyond_yielding_was_loaded_monotonically() {
    let beyond = [("displacement_start", 3.0 * LIMIT)];
    let all = [&settings(0.1, 0.05)[..], &beyond].concat();
    let driven = Driven::new(&all, Hysteresis::Bilinear, Coupling::Reactions);
    assert_close(driven.get("spring_force"), YIELD_FORCE * 1.2, 1e-10);
    assert_close(driven.get("displacement_plastic"), 2.0 * LIMIT, 1e-17);
    assert!(!driven.yielding(), "released, it unloads");
    let pushed = [&all[..], &[("velocity_start", 0.1)]].concat();
    assert!(Driven::new(&pushed, Hysteresis::Bilinear, Coupling::Reactions).yielding());
}

/// A slow push on an elasto-plastic floor: at the limit it has nothing left but its mass.
#[test]
fn a_fine_and_a_coarse_step_meet_the_same_corner_at_rest() {
    let floor = Floor::new(&parameters(0.0, 0.0)).unwrap();
    let load = Load { value: YIELD_FORCE / MASS, rate: 0.0 };
    let mut state = FloorState::new(&floor, LIMIT, 0.0, load);
    // in balance at the limit to the bit: neither yields nor unloads, and time passes
    state.advance(&floor, load, 1.0).unwrap();
    assert_close(state.displacement, LIMIT, 1e-16);
    assert_close(state.velocity, 0.0, 1e-15);
}

#[test]
fn a_spring_that_yields_needs_stiffness() {
    let soft = Parameters { stiffness: 0.0, ..parameters(0.1, 0.0) };
    let error = Floor::new(&soft).unwrap_err().to_string();
    assert!(error.contains("stiffness = 0") && error.contains("hysteresis = none"), "{error}");
}

/// Any floor, any load: the same in one step and in pieces, never outside the law, never out of energy.
#[test]
fn whatever_happens_the_law_is_kept() {
    let mut seed = 12_345_u64;
    // xorshift: evenly spread between two limits
    let mut between = |low: f64, high: f64| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut corners = 0;
    for case in 0..300 {
        let hardening = if case % 3 == 0 { 0.0 } else { between(0.0, 0.99) };
        let damping = if case % 4 == 0 { 0.0 } else { between(0.0, 3.0).powi(3) };
        let floor = Floor::new(&parameters(hardening, damping)).unwrap();
        let (position, velocity) = (between(-3.0, 3.0) * LIMIT, between(-1.0, 1.0));
        let mut whole = FloorState::new(&floor, position, velocity, Load::default());
        let mut pieces = whole;
        let mut farthest = 3.0 * LIMIT;
        for _ in 0..30 {
            let duration = 10.0_f64.powf(between(-9.0, 0.5));
            let value = if between(0.0, 1.0) < 0.1 { 0.0 } else { between(-6.0, 6.0) };
            let rate = if between(0.0, 1.0) < 0.3 { 0.0 } else { between(-6.0, 6.0) / duration };
            let lost = whole.damping_energy + whole.hysteretic_energy;
            corners += whole.advance(&floor, Load { value, rate }, duration).unwrap().corners;
            assert!(whole.damping_energy + whole.hysteretic_energy >= lost);
            let stretch = (whole.displacement - whole.plastic).abs();
            assert!(stretch <= LIMIT + 4.0 * f64::EPSILON * (LIMIT + whole.displacement.abs()), "{whole:?}");
            for (from, share) in [(0.0, 0.21), (0.21, 0.49), (0.7, 0.3)] {
                let load = Load { value: value + rate * duration * from, rate };
                pieces.advance(&floor, load, duration * share).unwrap();
            }
            farthest = farthest.max(whole.displacement.abs());
            // rounding of the loads, of up to 12 m/s², over the time they have acted
            let tolerance = 1e-11 * farthest.max(duration * duration);
            assert_close(pieces.displacement, whole.displacement, tolerance);
            assert_close(pieces.plastic, whole.plastic, tolerance);
        }
    }
    assert!(corners > 3000, "{corners} corners");
}
