//! Ties that yield in the FMU: Model Exchange, saved states, derivatives.

use fmu_export::{Interface, Log, Model as _, ModelExchange as _, StateCodec, Step, VariableId as _};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{BooleanVariable, RealVariable as V, TieSide};
use rocking_wall::wall::Parameters;

use crate::cases::{rows, text};
use crate::yielding::by_hand;
use crate::{instantiated, start, still};

/// Where the tie of the example by hand engages, yields and breaks on its first way out \[m\].
const ENGAGES: f64 = 0.02 / 2.6 * 1.5;
pub(crate) const YIELDS: f64 = 0.035 / 2.6 * 1.5;
const BREAKS: f64 = 0.085 / 2.6 * 1.5;
const SIDES: [V; 2] = [V::TieElongation, V::TieElongationNegative];

/// The scene of the example by hand, with ties on both sides.
pub(crate) fn scene(tie_ultimate: f64, u_start: f64, u_dot_start: f64) -> String {
    format!(
        "geometry = {{ height = 3.0, thickness = 0.3 }}\nforce_law = {{ force_law = \"rigid_linear\" }}\n\
         damping = {{ damping_model = \"none\" }}\n\
         start = {{ u_start = {u_start:?}, u_dot_start = {u_dot_start:?} }}\n\
         [impact]\nimpact = \"restitution\"\nrestitution = 0.9\n[tie]\ntie_side = \"both\"\n\
         tie_height = 2.6\ntie_stiffness = 2e5\ntie_slack = 0.02\ntie_strength = 3e3\n\
         tie_ultimate = {tie_ultimate:?}\n"
    )
}

pub(crate) fn initialized(interface: Interface, scene: &str) -> Unit {
    let mut unit = instantiated(interface, Some(scene), &mut Log::silent());
    unit.initialize(&mut Log::silent()).unwrap();
    unit
}

/// A unit for Model Exchange after its first event.
fn exchange(tie_ultimate: f64, u_start: f64, u_dot_start: f64) -> Unit {
    let mut unit = initialized(Interface::ModelExchange, &scene(tie_ultimate, u_start, u_dot_start));
    unit.update(&mut Log::silent()).unwrap();
    unit
}

fn indicators(unit: &Unit) -> [f64; 3] {
    let mut indicators = [0.0; 3];
    unit.event_indicators(&mut indicators);
    indicators
}

/// Completes a step that ends at a motion, and handles the event that is asked for; returns whether states
/// were said to have changed.
fn step_to(unit: &mut Unit, motion: [f64; 2]) -> bool {
    unit.set_states(&motion);
    let asks = unit.complete_step(&mut Log::silent()).unwrap();
    asks && unit.update(&mut Log::silent()).unwrap().states_changed
}

/// Moves a unit to a time by the classical Runge-Kutta method, through the events that its indicators show.
pub(crate) fn integrate(unit: &mut Unit, time: &mut f64, end: f64, step: f64) {
    while *time < end {
        let from = [unit.real(V::U), unit.real(V::UDot)];
        let mut reach = |length: f64| {
            let mut slope = |share: f64, rates: [f64; 2]| {
                let by = share * length;
                unit.set_time(*time + by);
                unit.set_states(&[from[0] + by * rates[0], from[1] + by * rates[1]]);
                [unit.real(V::UDot), unit.real(V::UDdot)]
            };
            let first = slope(0.0, [0.0; 2]);
            let second = slope(0.5, first);
            let third = slope(0.5, second);
            let fourth = slope(1.0, third);
            let sum = |i: usize| first[i] + 2.0 * (second[i] + third[i]) + fourth[i];
            unit.set_time(*time + length);
            unit.set_states(&[0, 1].map(|i| from[i] + length / 6.0 * sum(i)));
            indicators(unit).into_iter().fold(f64::INFINITY, f64::min)
        };
        let mut length = step.min(end - *time);
        let mut low = 0.0;
        if reach(length) <= 0.0 {
            while low < 0.5 * (low + length) && 0.5 * (low + length) < length {
                let middle = 0.5 * (low + length);
                if reach(middle) <= 0.0 { length = middle } else { low = middle }
            }
            reach(length);
        }
        *time = if length >= end - *time { end } else { *time + length };
        unit.set_time(*time);
        if unit.complete_step(&mut Log::silent()).unwrap() {
            unit.update(&mut Log::silent()).unwrap();
        }
    }
}

/// An importer's solver follows ties as the wall's own does: reference cases, and the example by hand with
/// both its fractures.
#[test]
fn model_exchange_follows_ties_that_yield() {
    for name in ["y01_free_cdc", "y13_start_beyond_yield"] {
        let scene = text(&format!("{name}.toml"));
        let mut unit = initialized(Interface::ModelExchange, &scene);
        unit.update(&mut Log::silent()).unwrap();
        let (mut time, mut compared) = (0.0, 0);
        let (u_ins, lever) = (unit.real(V::UIns), 2.0 * unit.real(V::TieHeight) / unit.real(V::Height));
        for row in rows(name).iter().filter(|row| row.time <= 4.0).step_by(10) {
            // an elastic branch of 60 rad/s: the error of a step is (ω h)⁵/120, of some 10⁴ steps 1e-9
            integrate(&mut unit, &mut time, row.time, 4e-4);
            let [_, positive, negative] = row.tie.unwrap();
            let errors = [
                (unit.real(V::U) - row.displacement) / u_ins,
                (unit.real(SIDES[0]) - positive) / (lever * u_ins),
                (unit.real(SIDES[1]) - negative) / (lever * u_ins),
            ];
            assert!(errors.iter().all(|error| error.abs() < 1e-6), "{name} at {time}: {errors:?}");
            compared += 1;
        }
        assert!(compared > 30 && unit.real(SIDES[0]) > 0.0, "{name}");
    }
    for tie_ultimate in [0.05, 0.0] {
        let (mut unit, mut time) = (exchange(tie_ultimate, 0.0, 0.5), 0.0);
        let parameters = Parameters { tie_side: TieSide::Both, ..by_hand(tie_ultimate) };
        let mut steps = start(&parameters);
        for tenth in 1..15 {
            integrate(&mut unit, &mut time, 0.1 * f64::from(tenth), 1e-3);
            steps.advance(&still(0.1)).unwrap();
            let apart = unit.real(V::U) - steps.progress().state.displacement;
            // the wall of the brittle tie has fallen by then
            let falls = steps.progress().state.overturned;
            assert!(falls || apart.abs() < 1e-9, "{apart:e} at {time}");
        }
        let apart = unit.real(V::TieBreakTime) - steps.progress().tie_break_time().unwrap();
        assert!(apart.abs() < 1e-9 && unit.boolean(BooleanVariable::TieBroken), "{apart:e}");
        assert_eq!(unit.boolean(BooleanVariable::Overturned), tie_ultimate == 0.0);
    }
}

/// Engaging, yielding, unloading and the fracture each report changed states. p grows with u on the yielding
/// branch, and is remembered from completed steps and events on.
#[test]
fn each_event_of_a_tie_reports_changed_states() {
    for side in [1.0, -1.0] {
        let [own, other] = if side > 0.0 { SIDES } else { [SIDES[1], SIDES[0]] };
        let mut unit = exchange(0.05, 0.0, side * 0.5);
        let beyond = 1.0 + 1e-9;
        let mut step = |displacement: f64, velocity: f64| {
            let changed = step_to(&mut unit, [side * displacement, side * velocity]);
            assert_eq!(unit.real(other), 0.0);
            (changed, unit.real(V::TieForce), unit.real(own))
        };
        let near = |found: f64, wanted: f64| assert!((found - wanted).abs() <= 1e-5, "{found} for {wanted}");
        let (changed, force, _) = step(ENGAGES * beyond, 0.4);
        assert!(changed);
        near(force, 0.0);
        let (changed, force, _) = step(0.5 * (ENGAGES + YIELDS), 0.4);
        assert!(!changed);
        near(force, 1500.0);
        let (changed, force, elongation) = step(YIELDS * beyond, 0.4);
        assert!(changed && force == 3e3 && elongation < 1e-9);
        let (changed, force, elongation) = step(0.03, 0.2);
        assert!(!changed && force == 3e3);
        near(elongation, (0.03 - YIELDS) * 5.2 / 3.0);
        // it turns back: from now on it pulls from 0.03 m inwards
        let (changed, force, elongation) = step(0.03, -1e-6);
        assert!(changed);
        near(force, 3e3);
        near(elongation, (0.03 - YIELDS) * 5.2 / 3.0);
        let slack = 0.03 - (YIELDS - ENGAGES);
        assert!(
            step(slack * (1.0 - 1e-9), -0.1).0 && step(slack * beyond, 0.1).0 && step(0.03 * beyond, 0.1).0
        );
        let (changed, force, elongation) = step(BREAKS * beyond, 0.1);
        assert!(changed);
        assert_eq!((force, elongation), (0.0, 0.05));
        assert!(unit.boolean(BooleanVariable::TieBroken) && unit.real(V::TieBreakTime) == 0.0);
    }
}

/// On a yielding branch one indicator is u̇ over the speed of a falling wall, the other the distance to the
/// fracture. A trial step leaves no trace, beyond the turning point and beyond the fracture.
#[test]
fn a_trial_step_leaves_no_trace() {
    for side in [1.0, -1.0] {
        let mut unit = exchange(0.05, 0.0, side * 0.5);
        step_to(&mut unit, [side * 0.03, side * 0.4]);
        let before = (indicators(&unit), unit.real(V::UDdot), SIDES.map(|elongation| unit.real(elongation)));
        let [u_ins, rate] = [0.15, (1.5_f64 * 9.81 / 3.0).sqrt()];
        let wanted = [0.4 / (u_ins * rate), (BREAKS - 0.03) / u_ins];
        let [lower, upper, _] = before.0;
        let found = if side > 0.0 { [lower, upper] } else { [upper, lower] };
        assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-11), "{found:?}");
        for (displacement, velocity) in [(0.04, -0.1), (0.06, 0.1), (0.01, -0.3), (-0.02, -0.3)] {
            unit.set_states(&[side * displacement, side * velocity]);
            // the branch goes on in a straight line: no kink at u_f, nor where the wall has turned back
            assert_eq!(unit.real(V::TieForce), 3e3);
            let opposite = unit.real(if side > 0.0 { SIDES[1] } else { SIDES[0] });
            assert_eq!(opposite, 0.0, "at {displacement}");
        }
        unit.set_states(&[side * 0.03, side * 0.4]);
        let after = (indicators(&unit), unit.real(V::UDdot), SIDES.map(|elongation| unit.real(elongation)));
        assert_eq!(after, before);
        // a completed step beyond a point that has turned back meanwhile: the farthest end of a step counts
        step_to(&mut unit, [side * 0.035, side * 1e-3]);
        step_to(&mut unit, [side * 0.034, side * -0.01]);
        let yielded = (0.035 - YIELDS) * 5.2 / 3.0;
        let found = unit.real(if side > 0.0 { SIDES[0] } else { SIDES[1] });
        assert!((found - yielded).abs() < 1e-15, "{found} for {yielded}");
    }
}

/// The farthest end of a step counts too where the other side has gone farther.
#[test]
fn a_tie_remembers_its_own_side() {
    let mut unit = exchange(10.0, -0.1, 0.0);
    for (displacement, velocity) in [(-0.09, 0.2), (-0.04, 0.4), (0.001, 0.4), (0.015, 0.4), (0.022, 0.4)] {
        step_to(&mut unit, [displacement, velocity]);
    }
    step_to(&mut unit, [0.04, 1e-3]);
    step_to(&mut unit, [0.039, -0.01]);
    let wanted = [0.04, 0.1].map(|reach| (reach - YIELDS) * 5.2 / 3.0);
    let found = SIDES.map(|elongation| unit.real(elongation));
    assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-15), "{found:?}");
}

/// A solver that finds the fracture, or the turning point, late has passed further corners, and each of them
/// counts.
#[test]
fn an_event_that_is_met_late_passes_every_corner() {
    for side in [1.0, -1.0] {
        let mut unit = exchange(0.05, 0.0, side * 0.5);
        step_to(&mut unit, [side * 0.03, side * 0.4]);
        let mut fallen = unit.clone();
        // past u_f, u_ins and the departure at h/4 at once
        step_to(&mut fallen, [side * 0.8, side * 0.4]);
        assert!(fallen.boolean(BooleanVariable::TieBroken) && fallen.boolean(BooleanVariable::Overturned));
        assert_eq!((fallen.real(V::TieForce), fallen.real(V::ReactionBottom)), (0.0, 0.0));
        // an elastic tie is lost at the departure alone, and for good
        let mut departed = exchange(-1.0, 0.0, side * 0.5);
        for place in [0.8, 0.1] {
            step_to(&mut departed, [side * place, side * (0.5 - place)]);
            assert_eq!((departed.real(V::TieForce), departed.real(V::ReactionBottom)), (0.0, 0.0), "{place}");
            assert_eq!(departed.directional_derivative(V::TieForce, V::U), Some(0.0));
        }
        // back beyond u = 0 at once: with the impact there
        step_to(&mut unit, [side * -1e-6, side * -0.3]);
        let lost = unit.real(V::ImpulseBottom) / unit.real(V::Mass);
        assert!((lost - side * 0.03).abs() < 1e-3, "{lost}");
        assert!(unit.real(if side > 0.0 { SIDES[0] } else { SIDES[1] }) > 0.01);
    }
}

/// A state that is set like an input yields beyond U, and from the next event on it is broken beyond u_f.
#[test]
fn a_state_that_is_set_chooses_what_the_tie_does() {
    for (displacement, velocity, force, broken) in [
        (0.01, 0.1, 0.0, false),
        (0.5 * (ENGAGES + YIELDS), 0.1, 1500.0, false),
        (0.03, 0.1, 3e3, false),
        (0.03, -0.1, 3e3, false),
        (0.06, -0.1, 0.0, true),
    ] {
        let mut unit = exchange(0.05, 0.0, 0.0);
        unit.set_real(V::UDot, velocity);
        unit.set_real(V::U, displacement);
        let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-9, "{found} for {wanted}");
        near(unit.real(V::TieForce), force);
        assert!(!unit.boolean(BooleanVariable::TieBroken), "no event yet");
        unit.update(&mut Log::silent()).unwrap();
        near(unit.real(V::TieForce), force);
        assert_eq!(unit.boolean(BooleanVariable::TieBroken), broken);
        let elongation = if broken { 0.05 } else { (5.2 / 3.0 * (displacement - YIELDS)).max(0.0) };
        near(unit.real(SIDES[0]), elongation);
        // back at 0 the state was never far, as far as there was no event
        let mut unit = exchange(0.05, 0.0, 0.0);
        unit.set_real(V::U, displacement);
        unit.set_real(V::U, 0.0);
        unit.update(&mut Log::silent()).unwrap();
        assert_eq!(unit.real(SIDES[0]), 0.0);
    }
}

/// Per branch: slack, pulling, yielding, broken; and along the last step.
#[test]
fn derivatives_are_those_of_the_branch() {
    let (stiffness, lever) = (2e5, 5.2 / 3.0);
    for side in [1.0, -1.0] {
        let [own, other] = if side > 0.0 { SIDES } else { [SIDES[1], SIDES[0]] };
        let (k, f0) = (10_594.8, 1589.22);
        assert!((k * 0.15_f64 - f0).abs() < 1e-9);
        for (displacement, pulls, yields) in
            [(0.01, 0.0, 0.0), (0.015, 1.0, 0.0), (0.03, 0.0, 1.0), (0.06, 0.0, 0.0)]
        {
            let mut unit = exchange(0.05, 0.0, 0.0);
            unit.set_real(V::UDot, side * 0.3);
            unit.set_real(V::U, side * displacement);
            unit.update(&mut Log::silent()).unwrap();
            let speed = unit.real(V::UDot);
            for (output, by_u) in [
                (V::TieForce, side * stiffness * lever * pulls),
                (V::RestoringForce, stiffness * lever * lever * pulls - k),
                (own, side * lever * yields),
                (other, 0.0),
            ] {
                let name = output.variable().name;
                let found = unit.directional_derivative(output, V::U).unwrap();
                let near = |found: f64, wanted: f64| {
                    assert!(
                        (found - wanted).abs() <= 1e-12 * (wanted.abs() + k),
                        "{name}: {found} for {wanted}"
                    );
                };
                near(found, by_u);
                near(unit.output_derivative(output).unwrap(), by_u * speed);
                for input in [V::UDot, V::ABottom, V::AG] {
                    assert_eq!(unit.directional_derivative(output, input), Some(0.0), "{name}");
                }
            }
            for discrete in [V::TieBreakTime, V::UMax] {
                assert_eq!(unit.directional_derivative(discrete, V::U), Some(0.0));
            }
            assert_eq!(unit.output_derivative(V::TieBreakTime), Some(0.0));
        }
    }
}

/// A state that is saved while a tie yields, after it has unloaded, or after a fracture goes on bit for bit.
#[test]
fn a_unit_goes_on_from_a_state_with_stretched_ties() {
    let saved = |unit: &mut Unit| {
        let mut bytes = Vec::new();
        unit.transfer_state(&mut StateCodec::writing(&mut bytes)).unwrap();
        bytes
    };
    for interface in [Interface::CoSimulation, Interface::ModelExchange] {
        for (tie_ultimate, at) in
            [(0.05, 0.03), (0.05, 0.1), (10.0, 0.1), (10.0, 0.25), (0.05, 0.3), (10.0, 1.0)]
        {
            let (text, mut time) = (scene(tie_ultimate, 0.0, 0.5), 0.0);
            let mut written = initialized(interface, &text);
            let go_on = |unit: &mut Unit, time: &mut f64, until: f64| {
                if interface == Interface::ModelExchange {
                    return integrate(unit, time, until, 0.01);
                }
                let step = Step { from: *time, duration: until - *time, may_end_early: false };
                unit.do_step(step, &mut Log::silent()).unwrap();
                *time = until;
            };
            if interface == Interface::ModelExchange {
                written.update(&mut Log::silent()).unwrap();
            }
            go_on(&mut written, &mut time, at);
            let (mut read, bytes) =
                (instantiated(interface, Some(&text), &mut Log::silent()), saved(&mut written));
            let mut codec = StateCodec::reading(&bytes);
            read.transfer_state(&mut codec).unwrap();
            codec.finish().unwrap();
            let mut times = [time, time];
            for until in [at, at + 0.013, at + 0.4, at + 2.0] {
                for (unit, time) in [&mut read, &mut written].into_iter().zip(&mut times) {
                    go_on(unit, time, until);
                }
                assert_eq!(saved(&mut read), saved(&mut written), "{interface:?} after {at} s, at {until} s");
                for &variable in V::ALL {
                    let [read, written] = [&read, &written].map(|unit| unit.real(variable));
                    assert_eq!(read, written, "{}", variable.variable().name);
                }
            }
            assert!(written.real(SIDES[0]) > 0.0);
        }
    }
}
