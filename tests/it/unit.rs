//! Tests the unit: derivatives against differences of what it computes, saved states, early ends.

use fmu_export::{
    Causality, Experiment, Interface, Log, Model as _, ModelExchange as _, StateCodec, Step, Variability,
    VariableId as _,
};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    DampingModel, ForceLaw, IntegerVariable as I, Mechanism, RealVariable as V, TieSide,
};
use rocking_wall::wall::{Parameters, Wall};

use crate::{edited_states, instantiated};

/// Outputs and local variables that remember what has been.
const MEMORY: [V; 5] = [V::ImpulseBottom, V::ImpulseTop, V::OverturnTime, V::UMax, V::TieBreakTime];
/// Communication step [s].
const STEP: f64 = 1e-5;
const INPUTS: [V; 4] = [V::AG, V::ABottom, V::ATop, V::Drift];

/// Outputs and local variables.
fn results() -> impl Iterator<Item = V> {
    let is_one = |variable: &V| matches!(variable.variable().causality, Causality::Output | Causality::Local);
    V::ALL.iter().copied().filter(is_one)
}

/// Those that depend on the present state and inputs.
fn outputs() -> Vec<V> {
    results().filter(|variable| !MEMORY.contains(variable)).collect()
}

fn unit(interface: Interface, reals: &[(V, f64)], choices: &[(I, i32)]) -> Unit {
    let mut unit = instantiated(interface, None, &mut Log::silent());
    for &(variable, value) in choices {
        unit.set_integer(variable, value);
    }
    for &(variable, value) in reals {
        unit.set_real(variable, value);
    }
    unit.initialize(&mut Log::silent()).unwrap();
    unit
}

/// Walls with all that outputs depend on, and a displacement on each of their branches \[m\].
fn walls() -> impl Iterator<Item = (Unit, Vec<f64>)> {
    let tied = [(V::TieStiffness, 3e5), (V::TieSlack, 2e-3), (V::TieHeight, 2.0)];
    // it yields from 0.1 m and breaks at 0.18 m
    let tied = [&tied[..], &[(V::TieStrength, 29.4e3), (V::TieUltimate, 0.08)]].concat();
    // a free-standing block is no strip, and has no overburden
    let models = DampingModel::ALL.iter().filter(|model| **model != DampingModel::FreeStandingBlock);
    models.flat_map(move |model| {
        [Mechanism::Parapet, Mechanism::VerticalSpanning].map(|mechanism| {
            let choices = [
                (I::Mechanism, mechanism.value()),
                (I::DampingModel, model.value()),
                (I::ForceLaw, ForceLaw::Trilinear.value()),
                (I::TieSide, TieSide::Positive.value()),
            ];
            let parapet = mechanism == Mechanism::Parapet;
            let mut reals = vec![(V::Xi, 0.05), (V::UStart, 0.0), (V::Overburden, 2e3)];
            reals.extend(tied.iter().filter(|_| parapet));
            let unit = unit(Interface::ModelExchange, &reals, &choices);
            let u_ins = unit.real(V::UIns);
            let places = [-1.05, -0.6, -0.06, 1e-3, 0.02, 0.06, 0.6, 1.05].map(|share| share * u_ins);
            (unit, places.to_vec())
        })
    })
}

#[test]
fn directional_derivatives_are_those_of_the_outputs() {
    let mut compared = 0;
    for (unit, places) in walls() {
        for place in places {
            let mut at = unit.clone();
            at.set_real(V::U, place);
            at.set_real(V::UDot, 0.07);
            at.update(&mut Log::silent()).unwrap();
            // a drift acts at once, before an event or a completed step remembers it
            for (input, value) in INPUTS.into_iter().zip([0.2, -0.3, 0.4, 1e-3]) {
                at.set_real(input, value);
            }
            for known in [V::U, V::UDot].into_iter().chain(INPUTS) {
                let step = if known == V::U { 1e-6 * unit.real(V::UIns) } else { 1e-6 };
                let moved = |by: f64| {
                    let mut moved = at.clone();
                    match known {
                        V::U => moved.set_states(&[place + by, 0.07]),
                        V::UDot => moved.set_states(&[place, 0.07 + by]),
                        _ => moved.set_real(known, at.real(known) + by),
                    }
                    outputs().iter().map(|&output| moved.real(output)).collect::<Vec<_>>()
                };
                let (below, above) = (moved(-step), moved(step));
                for (index, output) in outputs().into_iter().enumerate() {
                    let found = at.directional_derivative(output, known).unwrap();
                    let expected = (above[index] - below[index]) / (2.0 * step);
                    // rounding of the outputs over the step, and its square times the third derivative
                    let size = above[index].abs().max(1e-3);
                    let allowed = 1e-9 * size / step + 1e-6 * expected.abs();
                    let names = [output, known].map(|variable| variable.variable().name);
                    assert!(
                        (found - expected).abs() <= allowed,
                        "d{names:?} at {place}: {found} for {expected}"
                    );
                    compared += usize::from(expected.abs() > 100.0 * allowed);
                }
                for memory in MEMORY {
                    assert_eq!(at.directional_derivative(memory, known), Some(0.0));
                }
                assert_eq!(at.directional_derivative(V::Mass, known), None);
            }
            assert_eq!(at.directional_derivative(V::U, V::Height), None);
        }
    }
    assert!(compared > 700, "{compared} derivatives are told from 0");
}

/// Choices are read as they are set, and calculated parameters are the facts of the wall.
#[test]
fn parameters_are_read_as_they_are_set() {
    let mut chosen = instantiated(Interface::CoSimulation, None, &mut Log::silent());
    for &choice in I::ALL {
        for value in [2, 1] {
            chosen.set_integer(choice, value);
            assert_eq!(chosen.integer(choice), value, "{}", choice.variable().name);
        }
    }
    let unit = unit(Interface::CoSimulation, &[(V::Xi, 0.05)], &[]);
    let facts = Wall::new(&Parameters { xi: 0.05, ..Parameters::default() }).unwrap().facts();
    let known = V::ALL.iter().filter_map(|&variable| {
        let name = variable.variable().name;
        Some((name, unit.real(variable), facts.iter().find(|fact| fact.name == name)?.value))
    });
    let mut compared = 0;
    for (name, value, fact) in known {
        assert_eq!(value, fact, "{name}");
        compared += 1;
    }
    assert_eq!((compared, unit.real(V::XiUsed)), (10, 0.05));
}

/// A wall that has left its supports has neither reactions nor derivatives of them.
#[test]
fn a_wall_that_has_left_its_supports_does_not_react() {
    for (mut unit, _) in walls() {
        unit.set_real(V::AG, 0.2);
        // a parapet leaves its support at h/4 and lands at h/2, a strip at h₁/2 and h₁
        unit.set_states(&[0.4 * unit.real(V::Height), 0.1]);
        unit.update(&mut Log::silent()).unwrap();
        assert_eq!(unit.real(V::UDot), 0.1, "it has not landed");
        for output in [V::ReactionBottom, V::ReactionTop, V::TieForce] {
            assert_eq!(unit.real(output), 0.0);
            for known in [V::U, V::UDot].into_iter().chain(INPUTS) {
                assert_eq!(unit.directional_derivative(output, known), Some(0.0));
            }
        }
    }
}

/// After a step along which the inputs rise linearly, the derivatives of the outputs go on along it.
#[test]
fn output_derivatives_go_on_along_the_last_step() {
    let start = [(V::UStart, 0.05), (V::UDotStart, 0.1), (V::Xi, 0.05)];
    let tied = [(V::TieStiffness, 3e5), (V::TieSlack, 2e-3), (V::TieHeight, 2.0)];
    let tied = unit(Interface::CoSimulation, &[&start[..], &tied].concat(), &[]);
    let strip = [&start[..], &[(V::Overburden, 2e3)]].concat();
    let strip = unit(
        Interface::CoSimulation,
        &strip,
        &[
            (I::Mechanism, Mechanism::VerticalSpanning.value()),
            (I::DampingModel, DampingModel::ConstantCoefficient.value()),
        ],
    );
    let rates = [(V::ABottom, 3.0), (V::ATop, -2.0), (V::Drift, 0.05)];
    for (mut unit, top) in [(tied, 0.0), (strip, 1.0)] {
        let mut steps = 0;
        let mut step = |unit: &mut Unit| {
            for (input, rate) in rates {
                unit.set_input_derivative(input, rate);
            }
            let from = STEP * f64::from(steps);
            steps += 1;
            unit.do_step(Step { from, duration: STEP, may_end_early: false }, &mut Log::silent()).unwrap();
        };
        step(&mut unit);
        let before = unit.clone();
        step(&mut unit);
        let at = unit.clone();
        step(&mut unit);
        let mut compared = 0;
        for output in results() {
            if output.variable().variability == Variability::Discrete {
                assert_eq!(at.output_derivative(output), Some(0.0));
                continue;
            }
            compared += 1;
            let expected = (unit.real(output) - before.real(output)) / (2.0 * STEP);
            let found = at.output_derivative(output).unwrap();
            let allowed = 1e-6 * expected.abs() + 1e-9 * at.real(output).abs() / STEP;
            let name = output.variable().name;
            assert!((found - expected).abs() <= allowed, "{name}: {found} for {expected}");
            let no_tie = matches!(output, V::TieForce | V::TieElongation | V::TieElongationNegative);
            let none =
                (output == V::ReactionTop && top == 0.0) || (no_tie && (top == 1.0 || output != V::TieForce));
            assert_eq!(expected == 0.0, none, "{name}: {expected}");
        }
        assert_eq!(compared, 12);
        assert_eq!(at.output_derivative(V::Mass), None);
        // on the way back the largest |u| stays
        unit.set_real(V::UDot, -0.1);
        assert_eq!(unit.output_derivative(V::UMax), Some(0.0));
    }
}

/// A state that an importer sets chooses branch and phase as a start there does; peaks and marks stay.
#[test]
fn a_state_that_is_set_chooses_its_branch() {
    let rigid = [(I::ForceLaw, ForceLaw::RigidLinear.value()), (I::DampingModel, DampingModel::None.value())];
    for choices in [&[(I::ForceLaw, ForceLaw::Trilinear.value())][..], &rigid] {
        let started = |displacement: f64, velocity: f64| {
            let start = [(V::UStart, displacement), (V::UDotStart, velocity)];
            unit(Interface::ModelExchange, &start, choices)
        };
        let mut unit = started(0.0, 0.0);
        for (displacement, velocity) in
            [(0.15, 0.0), (0.15, -0.2), (-0.002, 0.1), (-0.1, 0.0), (0.0, -0.1), (0.0, 0.0), (0.02, 0.0)]
        {
            unit.set_real(V::UDot, velocity);
            unit.set_real(V::U, displacement);
            let expected = started(displacement, velocity);
            for output in outputs() {
                let name = output.variable().name;
                assert_eq!(unit.real(output), expected.real(output), "{name} at {displacement}, {velocity}");
            }
            let mut indicators = [[0.0; Unit::EVENT_INDICATORS]; 2];
            unit.event_indicators(&mut indicators[0]);
            expected.event_indicators(&mut indicators[1]);
            assert_eq!(indicators[0][..2], indicators[1][..2], "at {displacement}, {velocity}");
            assert_eq!(unit.real(V::UMax), 0.0, "no event yet");
        }
    }
}

/// Solvers relate their tolerances to u_ins and to the speed of a wall that falls from there.
#[test]
fn nominal_values_are_those_of_a_falling_wall() {
    let unit = unit(Interface::ModelExchange, &[(V::Height, 6.0), (V::Overburden, 2e3)], &[]);
    let (u_ins, f0, mass) = (unit.real(V::UIns), unit.real(V::F0), unit.real(V::EffectiveMass));
    assert_eq!(unit.nominal(V::U), u_ins);
    // k₀ = F₀/u_ins
    let expected = u_ins * (f0 / u_ins / mass).sqrt();
    assert!((unit.nominal(V::UDot) / expected - 1.0).abs() < 1e-15, "{}", unit.nominal(V::UDot));
}

/// A completed step asks for an event where the wall has left its branch or goes beyond its largest |u|, and
/// not again after the update.
#[test]
fn a_completed_step_asks_for_the_event_it_passed() {
    // a1 times u_ins
    let elastic = 0.02 * 0.2;
    let mut unit = unit(Interface::ModelExchange, &[(V::A1, 0.02), (V::UStart, 1.5 * elastic)], &[]);
    assert!((unit.real(V::UIns) - 0.2).abs() < 1e-15);
    for (displacement, event, jumps) in [
        (1.2, false, false),
        (0.9, true, true),
        (0.5, false, false),
        (-0.9, false, false),
        (-1.1, true, true),
        (-1.6, true, false),
    ] {
        unit.set_states(&[displacement * elastic, 0.0]);
        assert_eq!(unit.complete_step(&mut Log::silent()).unwrap(), event, "{displacement} u1");
        if event {
            assert_eq!(unit.update(&mut Log::silent()).unwrap().states_changed, jumps, "{displacement} u1");
            assert!(!unit.complete_step(&mut Log::silent()).unwrap());
        }
    }
}

/// A unit that reads what another one wrote goes on as it does, bit for bit.
#[test]
fn a_unit_goes_on_from_a_saved_state() {
    let text = "[force_law]\nforce_law = \"rigid_linear\"\n\
                [damping]\ndamping_model = \"none\"\n\
                [impact]\nimpact = \"restitution\"\nrestitution = 0.9\n\
                [motion]\nharmonic = { amplitude = 3.0, frequency = 2.0, duration = 1.0 }\n";
    let log = &mut Log::silent();
    for interface in [Interface::CoSimulation, Interface::ModelExchange] {
        let mut written = instantiated(interface, Some(text), log);
        written.setup_experiment(Experiment { start: 2.0, tolerance: Some(1e-9), stop: Some(9.0) });
        for (parameter, value) in [(V::Height, 3.0), (V::UStart, 0.01), (V::UDotStart, -0.2)] {
            written.set_real(parameter, value);
        }
        written.initialize(log).unwrap();
        let step = |unit: &mut Unit, step: u32| {
            let from = 2.0 + 0.003 * f64::from(step);
            for (input, value) in INPUTS.into_iter().zip([0.03, -0.02, 0.01, 1e-4]) {
                unit.set_real(input, value * f64::from(step));
            }
            if interface == Interface::CoSimulation {
                unit.set_input_derivative(V::ABottom, 2.0);
                let step = Step { from, duration: 0.003, may_end_early: false };
                unit.do_step(step, &mut Log::silent()).unwrap();
            } else {
                // through u = 0 at step 20, between two samples of the scene's own motion
                unit.set_time(from + 1e-4);
                unit.set_states(&[0.1 - 0.005 * f64::from(step), -1.0]);
                if unit.complete_step(&mut Log::silent()).unwrap() {
                    unit.update(&mut Log::silent()).unwrap();
                }
            }
        };
        let saved = |unit: &mut Unit| {
            let mut bytes = Vec::new();
            unit.transfer_state(&mut StateCodec::writing(&mut bytes)).unwrap();
            bytes
        };
        (0..30).for_each(|n| step(&mut written, n));
        let (mut read, bytes) = (instantiated(interface, Some(text), log), saved(&mut written));
        let mut codec = StateCodec::reading(&bytes);
        read.transfer_state(&mut codec).unwrap();
        codec.finish().unwrap();
        for n in 30..60 {
            assert_eq!(saved(&mut read), saved(&mut written), "{interface:?} before step {n}");
            for &variable in V::ALL {
                let [read, written] = [&read, &written].map(|unit| unit.real(variable));
                assert_eq!(read, written, "{interface:?}: {} before step {n}", variable.variable().name);
            }
            step(&mut read, n);
            step(&mut written, n);
        }
    }
}

#[test]
fn edited_states_are_refused_or_work() {
    let strip = [
        (I::Mechanism, Mechanism::VerticalSpanning.value()),
        (I::Impact, rocking_wall::variables::Impact::Restitution.value()),
    ];
    for (from, interface, start, choices) in
        [(0, Interface::CoSimulation, 0.1, &[][..]), (1, Interface::ModelExchange, 0.02, &strip)]
    {
        let mut at = unit(interface, &[(V::UStart, start)], choices);
        if interface == Interface::CoSimulation {
            let step = Step { from: 0.0, duration: 0.03, may_end_early: false };
            at.do_step(step, &mut Log::silent()).unwrap();
        }
        let other = instantiated(interface, None, &mut Log::silent());
        assert!(edited_states::are_refused_or_work(&at, &other, from) > 100);
    }
}

/// A step that may end early ends just after overturning, also where time itself is rounded to nanoseconds.
#[test]
fn a_step_ends_just_after_overturning() {
    for start in [0.0, 1e7] {
        // 0.1 ns, or four roundings of time; the second search for the time is a little off the first
        let margin = f64::max(1e-10, 4.0 * f64::EPSILON * start);
        for n in 0..20 {
            let mut unit = instantiated(Interface::CoSimulation, None, &mut Log::silent());
            unit.set_real(V::UStart, 0.19);
            unit.set_real(V::UDotStart, 0.1 + 0.013 * f64::from(n));
            unit.setup_experiment(Experiment { start, ..Experiment::default() });
            unit.initialize(&mut Log::silent()).unwrap();
            let step = Step { from: start, duration: 0.5, may_end_early: true };
            let end = unit.do_step(step, &mut Log::silent()).unwrap().expect("an early end");
            let overturned = unit.real(V::OverturnTime);
            assert!(unit.real(V::URatio) >= 1.0 && end >= overturned, "{end} after {overturned}");
            assert!(
                end - overturned <= 1.001 * margin + 2.0 * f64::EPSILON * end,
                "{end} after {overturned}"
            );
        }
    }
}
