//! The linear floor against textbook solutions.

use fmu_export::{Environment, Interface, Log, Model};
use rocking_floor::unit::Unit;
use rocking_floor::variables::{Hysteresis, IntegerVariable};

use super::{Driven, assert_close, real};

const MASS: f64 = 2.0e4;
const STIFFNESS: f64 = 2.0e7;

/// A hundred steps add their rounding; each is a few ε of the amplitude, and the phase ω t is rounded to ε as
/// well.
const HUNDRED_STEPS: f64 = 1e-12;

fn floor(damping_ratio: f64, more: &[(&str, f64)]) -> Driven {
    let own = [("mass", MASS), ("stiffness", STIFFNESS), ("damping_ratio", damping_ratio)];
    Driven::linear(&[&own[..], more].concat())
}

#[test]
fn free_vibration_below_at_and_above_critical_damping() {
    let (u, v) = (0.02, -0.3);
    let omega = (STIFFNESS / MASS).sqrt();
    for ratio in [0.0, 0.05, 0.9, 1.0, 1.5, 20.0] {
        let mut driven = floor(ratio, &[("displacement_start", u), ("velocity_start", v)]);
        for n in 1..=100 {
            driven.step(0.007);
            let t = f64::from(n) * 0.007;
            let decay = ratio * omega;
            let wanted = if ratio < 1.0 {
                let damped = omega * (1.0 - ratio * ratio).sqrt();
                (-decay * t).exp() * (u * (damped * t).cos() + (v + decay * u) / damped * (damped * t).sin())
            } else if ratio == 1.0 {
                (-omega * t).exp() * (u + (v + omega * u) * t)
            } else {
                let root = omega * (ratio * ratio - 1.0).sqrt();
                let (slow, fast) = (-omega * omega / (decay + root), -decay - root);
                ((v - fast * u) * (slow * t).exp() - (v - slow * u) * (fast * t).exp()) / (slow - fast)
            };
            assert_close(driven.get("displacement"), wanted, HUNDRED_STEPS * u);
        }
    }
}

#[test]
fn a_step_load_settles_at_its_static_displacement_after_overshooting() {
    let load = 4.0e5;
    let mut driven = floor(0.0, &[("reaction_3", load)]);
    let omega = (STIFFNESS / MASS).sqrt();
    driven.step(std::f64::consts::PI / omega);
    // twice the static displacement, and towards −x: the floor feels the opposite of the force on the wall
    assert_close(driven.get("displacement"), -2.0 * load / STIFFNESS, 1e-16);
    let mut damped = floor(0.3, &[("reaction_3", load)]);
    damped.step(100.0);
    assert_close(damped.get("displacement"), -load / STIFFNESS, 1e-15);
    assert_close(damped.get("reaction_bottom"), load, 1e-8);
}

#[test]
fn a_mass_without_a_spring_follows_newton_and_a_damper() {
    let settings = [("mass", 500.0), ("stiffness", 0.0), ("a_g", 2.0)];
    let mut free = Driven::linear(&settings);
    free.rate("a_g", 3.0);
    free.step(2.0);
    // absolutely it stays where it was: the base slides away beneath it
    assert_close(free.get("displacement"), -(2.0 * 2.0 + 3.0 * 8.0 / 6.0), 1e-14);
    assert_close(free.get("displacement_absolute"), 0.0, 1e-14);
    assert_close(free.get("velocity_absolute"), 0.0, 1e-14);
    assert_eq!(free.get("acceleration_absolute"), 0.0);
    let dashpot = [("damping_coefficient", 1500.0), ("velocity_start", 1.2)];
    let mut damped = Driven::linear(&[&settings[..2], &dashpot].concat());
    damped.step(0.8);
    let decay: f64 = 3.0 * 0.8;
    assert_close(damped.get("velocity"), 1.2 * (-decay).exp(), 1e-15);
    assert_close(damped.get("displacement"), -1.2 / 3.0 * (-decay).exp_m1(), 1e-15);
    // all that was lost is the damper's
    let lost = 0.5 * 500.0 * 1.44 * -(-2.0 * decay).exp_m1();
    assert_close(damped.get("energy_damping"), lost, 1e-11);
}

#[test]
fn steps_do_not_matter_where_inputs_are_linear() {
    let start = [("displacement_start", 0.01), ("a_g", 1.5), ("reaction_1", 2.0e4), ("reaction_8", -1.0e4)];
    let run = |lengths: &[f64]| {
        let mut driven = floor(0.05, &start);
        for &length in lengths {
            driven.rate("a_g", -4.0);
            driven.rate("reaction_8", 9.0e4);
            driven.step(length);
        }
        driven
    };
    let one = run(&[0.5]);
    let many = run(&[0.5 / 64.0; 64]);
    let uneven = run(&[0.3, 1e-12, 1e-4, 0.1999 - 1e-12]);
    for other in [many, uneven] {
        for (name, size) in [
            ("displacement", 0.01),
            ("velocity", 0.3),
            ("acceleration", 10.0),
            ("displacement_absolute", 0.1),
            ("velocity_absolute", 0.7),
            ("energy_damping", 1e3),
        ] {
            assert_close(other.get(name), one.get(name), HUNDRED_STEPS * size);
        }
    }
}

#[test]
fn rest_stays_rest() {
    let mut driven = floor(0.05, &[]);
    for _ in 0..100 {
        driven.step(0.01);
    }
    for name in ["displacement", "velocity", "acceleration", "energy_damping", "impulse_bottom"] {
        assert_eq!(driven.get(name), 0.0, "{name}");
    }
}

/// The FMU of a storey contains its values; what they do not state has its start value.
#[test]
fn a_floor_reads_the_values_inside_its_fmu() {
    let made = |text: &str| {
        let environment = Environment {
            interface: Interface::CoSimulation,
            instance_name: "storey",
            resources: None,
            payload: Some(text.as_bytes()),
        };
        Unit::instantiate(environment, &mut Log::silent()).map_err(|failure| failure.to_string())
    };
    let unit = made("mass = 2e3\n\n# yields\nhysteresis = \"bilinear\"\nvelocity_start = -0.3\n").unwrap();
    assert_eq!(unit.real(real("mass")), 2000.0);
    assert_eq!(unit.real(real("velocity")), -0.3);
    assert_eq!(unit.real(real("stiffness")), Unit::new().unwrap().real(real("stiffness")));
    assert_eq!(unit.integer(IntegerVariable::Hysteresis), Hysteresis::Bilinear.value());
    for (text, words) in [
        ("mass 3", ["line 1", "name = value"]),
        ("\nmass = 0", ["line 2", "mass = 0"]),
        ("mass = nan", ["line 1", "mass = nan"]),
        ("a_g = 1", ["line 1", "a_g = 1"]),
        ("hysteresis = \"cubic\"", ["line 1", "cubic"]),
        ("colour = 1", ["line 1", "colour"]),
    ] {
        let message = made(text).err().unwrap();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
}
