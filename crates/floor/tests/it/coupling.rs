//! Reactions and impulses of walls, saved states, derivatives.

use std::sync::{Arc, Mutex};

use fmu_export::{
    Category, Causality, Filter, Log, Model, StateCodec, Status, Step, Variability, VariableId,
};
use rocking_floor::unit::Unit;
use rocking_floor::variables::{Coupling, Hysteresis, RealVariable};

use super::{Driven, assert_close, edited_states, real};

/// A floor on rollers: what the walls gain, it loses.
#[test]
fn impulses_conserve_momentum() {
    let settings = [("mass", 4000.0), ("stiffness", 0.0), ("velocity_start", 0.3)];
    let mut driven = Driven::new(&settings, Hysteresis::None, Coupling::Impulses);
    let mut given = 0.0;
    for n in 0..1000_i32 {
        let step = if n % 3 == 0 { 0.002 } else { 0.0005 };
        for wall in 1..=8 {
            let impulse = f64::from((n * 7 + wall * 13) % 29 - 14);
            driven.set(&format!("impulse_{wall}"), impulse);
            given += impulse;
        }
        driven.step(step);
        // of 1200 N s; a thousand additions
        assert_close(4000.0 * driven.get("velocity"), 4000.0 * 0.3 - given, 1e-9);
        assert_close(driven.get("impulse_bottom"), 0.0, 1e-10);
    }
}

/// The mean force of an impulse over its step does what a held reaction of that force does.
#[test]
fn an_impulse_is_a_mean_force() {
    let step = 0.004;
    let mut by_impulse = Driven::new(&[], Hysteresis::None, Coupling::Impulses);
    let mut by_force = Driven::linear(&[]);
    for n in 0..200 {
        let force = 1e4 * f64::from(n).sin();
        by_impulse.set("impulse_2", force * step);
        by_force.set("reaction_2", force);
        by_impulse.step(step);
        by_force.step(step);
        for name in ["displacement", "velocity", "acceleration", "impulse_bottom"] {
            let wanted = by_force.get(name);
            assert_close(by_impulse.get(name), wanted, 1e-13 * (1e-3 + wanted.abs()) * 10.0);
        }
    }
}

/// ∫ of the base's reaction, by Simpson's rule on its samples, is its impulse.
#[test]
fn the_base_gives_what_its_reaction_says() {
    let settings = [("displacement_start", 0.01), ("a_g", 2.0), ("reaction_5", 3e4)];
    let (mut driven, count) = (Driven::linear(&settings), 200_i32);
    let step = 0.1 / f64::from(count);
    let (mut sampled, mut summed) = (driven.get("reaction_bottom"), 0.0);
    for n in 1..=count {
        driven.rate("a_g", 15.0);
        driven.rate("reaction_5", -2e5);
        driven.step(step);
        let weight = if n == count { 1.0 } else { f64::from(2 + 2 * (n % 2)) };
        sampled += weight * driven.get("reaction_bottom");
        summed += driven.get("impulse_bottom");
    }
    let sampled = sampled * step / 3.0;
    // Simpson: 2e5 N (ω h)⁴/180 over 0.1 s is 1e-5 of … N s
    assert_close(sampled, summed, 1e-5);
    assert!(summed.abs() > 100.0);
}

#[test]
fn the_walls_sign_is_negated_once() {
    let mut driven = Driven::linear(&[]);
    driven.set("reaction_1", 2e4);
    assert_eq!(driven.get("acceleration"), -1.0, "the floor, 20 t, feels the opposite at once");
    assert_eq!(driven.get("acceleration_absolute"), -1.0);
    driven.set("a_g", 3.0);
    assert_eq!(driven.get("acceleration"), -4.0);
    assert_eq!(driven.get("acceleration_absolute"), -1.0);
    // impulses are no business of this coupling
    driven.set("impulse_1", 1e9);
    assert_eq!(driven.get("acceleration"), -4.0);
}

#[test]
fn inputs_of_the_other_coupling_are_warned_of_once() {
    let texts = Arc::new(Mutex::new(Vec::new()));
    let sink = texts.clone();
    let mut push = move |_: Status, _: Category, text: &str| sink.lock().unwrap().push(text.to_owned());
    let mut log = Log::new(&mut push, Filter::ERRORS.with(Category::Warning));
    let mut driven = Driven::linear(&[]);
    driven.set("impulse_4", 1.0);
    for n in 0..3 {
        let step = Step { from: f64::from(n), duration: 1.0, may_end_early: false };
        driven.unit.do_step(step, &mut log).unwrap();
    }
    let texts = texts.lock().unwrap();
    assert_eq!(texts.len(), 1, "{texts:?}");
    assert!(texts[0].contains("coupling = reactions"), "{texts:?}");
}

/// Directional derivatives against central differences; the floor is piecewise linear, so differences are
/// exact to rounding.
#[test]
fn derivatives_are_those_of_the_outputs() {
    let yielding = [("displacement_start", 0.02), ("velocity_start", 0.5), ("damping_ratio", 0.1)];
    for (hysteresis, coupling) in [
        (Hysteresis::None, Coupling::Reactions),
        (Hysteresis::Bilinear, Coupling::Reactions),
        (Hysteresis::Bilinear, Coupling::Impulses),
    ] {
        let mut driven = Driven::new(&yielding, hysteresis, coupling);
        driven.step(0.001);
        assert_eq!(driven.yielding(), hysteresis == Hysteresis::Bilinear);
        let of = |causality: Causality| {
            RealVariable::ALL.iter().copied().filter(move |id| id.variable().causality == causality)
        };
        for input in of(Causality::Input) {
            let at = |value: f64| {
                let mut unit = driven.unit.clone();
                unit.set_real(input, value);
                unit
            };
            let (low, high) = (at(-64.0), at(64.0));
            for output in of(Causality::Output) {
                let wanted = (high.real(output) - low.real(output)) / 128.0;
                let found = driven.unit.directional_derivative(output, input).unwrap();
                assert!(
                    (found - wanted).abs() <= 1e-13 * (1.0 + wanted.abs()),
                    "{output:?} by {input:?}: {found} {wanted}"
                );
            }
        }
    }
}

/// Output derivatives against a tiny step with the same rates.
#[test]
fn output_derivatives_are_rates() {
    for hysteresis in [Hysteresis::None, Hysteresis::Bilinear] {
        let start =
            [("displacement_start", 0.02), ("velocity_start", 0.5), ("a_g", 1.0), ("reaction_1", 1e4)];
        let mut driven = Driven::new(&start, hysteresis, Coupling::Reactions);
        let step = |unit: &mut Unit, from: f64, duration: f64| {
            unit.set_input_derivative(real("a_g"), 7.0);
            unit.set_input_derivative(real("reaction_1"), -3e5);
            unit.do_step(Step { from, duration, may_end_early: false }, &mut Log::silent()).unwrap();
        };
        step(&mut driven.unit, 0.0, 0.01);
        assert_eq!(driven.yielding(), hysteresis == Hysteresis::Bilinear);
        let tiny = 1e-6;
        let mut later = driven.unit.clone();
        step(&mut later, 0.01, tiny);
        for &output in RealVariable::ALL {
            let variable = output.variable();
            let rate = driven.unit.output_derivative(output);
            if variable.causality != Causality::Output {
                assert_eq!(rate, None, "{}", variable.name);
                continue;
            }
            let rate = rate.expect(variable.name);
            if variable.variability == Variability::Discrete {
                assert_eq!(rate, 0.0);
                continue;
            }
            let difference = (later.real(output) - driven.unit.real(output)) / tiny;
            // first order in ω dt = 3e-5, and rounding over dt
            assert_close(difference, rate, 1e-3 * rate.abs().max(1.0));
        }
    }
}

#[test]
fn a_step_that_fails_leaves_all_as_it_was() {
    let mut driven = Driven::new(&[], Hysteresis::Bilinear, Coupling::Reactions);
    driven.step(0.01);
    driven.set("a_g", 1e300);
    driven.rate("a_g", 1e300);
    let values = |unit: &Unit| -> Vec<_> {
        RealVariable::ALL.iter().map(|&variable| unit.real(variable).to_bits()).collect()
    };
    let before = values(&driven.unit);
    let failed =
        driven.unit.do_step(Step { from: 0.01, duration: 1e300, may_end_early: false }, &mut Log::silent());
    assert!(failed.is_err());
    assert_eq!(values(&driven.unit), before);
}

#[test]
fn edited_states_are_refused_or_work() {
    for (from, hysteresis, start) in [(0, Hysteresis::None, 0.01), (1, Hysteresis::Bilinear, 0.1)] {
        let mut driven = Driven::new(&[("displacement_start", start)], hysteresis, Coupling::Reactions);
        driven.step(0.03);
        let other = Unit::new().expect("the start values make a floor");
        assert!(edited_states::are_refused_or_work(&driven.unit, &other, from) > 100);
    }
}

/// A parameter beyond its limits is named where a state is read, and the message says which.
#[test]
fn a_parameter_of_a_state_beyond_its_limits_is_named() {
    let mut bytes = Vec::new();
    let mut driven = Driven::new(&[("yield_force", 54321.0)], Hysteresis::Bilinear, Coupling::Reactions);
    driven.unit.transfer_state(&mut StateCodec::writing(&mut bytes)).expect("it can be written");
    let at = bytes.windows(8).position(|found| found == 54321.0_f64.to_le_bytes()).expect("it is there");
    bytes[at..at + 8].copy_from_slice(&(-1.0_f64).to_le_bytes());
    let mut other = Unit::new().expect("the start values make a floor");
    let error = other.transfer_state(&mut StateCodec::reading(&bytes)).unwrap_err();
    assert!(error.to_string().contains("yield_force = -1.0 N is below its minimum"), "{error}");
}
