//! Tests pulses and harmonics: the double integral of the record equals that of the formula.

use std::f64::consts::PI;

use ground_motion::{GroundMotion, GroundMotionError, Pulse, Shape};

use crate::motion::integrated;

const RICKER: Pulse = Pulse { shape: Shape::Ricker { centre: 2.0 }, amplitude: 2.0065, frequency: 0.8 };
const HARMONIC: Pulse =
    Pulse { shape: Shape::Harmonic { phase: 0.4, end: Some(7.3) }, amplitude: 1.2, frequency: 1.1 };

/// Velocity and displacement of the Ricker pulse: a is −A/(2π²f²) times the second derivative of exp(−z²).
fn ricker_motion(time: f64) -> [f64; 2] {
    let rate = PI * RICKER.frequency;
    let z = rate * (time - 2.0);
    let gaussian = RICKER.amplitude * (-z * z).exp();
    [gaussian * z / rate, -gaussian / (2.0 * rate * rate)]
}

/// Velocity and displacement of A sin(ωt + φ) from rest.
fn sine_motion(pulse: Pulse, phase: f64, time: f64) -> [f64; 2] {
    let omega = 2.0 * PI * pulse.frequency;
    let velocity = (phase.cos() - (omega * time + phase).cos()) / omega;
    let displacement =
        time * phase.cos() / omega - ((omega * time + phase).sin() - phase.sin()) / (omega * omega);
    [pulse.amplitude * velocity, pulse.amplitude * displacement]
}

/// Largest differences in velocity and displacement over all samples.
fn largest_error(motion: &GroundMotion, exact: impl Fn(f64) -> [f64; 2]) -> [f64; 2] {
    let history = integrated(motion, exact(0.0));
    history.iter().zip(0_u32..).fold([0.0_f64; 2], |largest, (state, index)| {
        let exact = exact(f64::from(index) * motion.step());
        [0, 1].map(|i| largest[i].max((state[i] - exact[i]).abs()))
    })
}

#[test]
fn double_integral_is_of_fourth_order() {
    let ricker = |step| largest_error(&RICKER.sampled(None, step).unwrap(), ricker_motion);
    let harmonic =
        |step| largest_error(&HARMONIC.sampled(None, step).unwrap(), |t| sine_motion(HARMONIC, 0.4, t));
    for (name, coarse, fine) in
        [("Ricker", ricker(0.02), ricker(0.01)), ("harmonic", harmonic(0.02), harmonic(0.01))]
    {
        for i in [0, 1] {
            let order = (coarse[i] / fine[i]).log2();
            assert!(
                (3.9..4.2).contains(&order),
                "{name}, {i}: order {order} from {} to {}",
                coarse[i],
                fine[i]
            );
        }
    }
}

#[test]
fn the_default_step_leaves_rounding_only() {
    // Relative error (ωΔt)⁴/240 = 4e-13 at 2000 steps a period, and at most 12 000 roundings of 1e-16 in a
    // sum.
    let tolerance = 5e-12;
    let [velocity, displacement] = largest_error(&RICKER.motion(Some(8.0)).unwrap(), ricker_motion);
    let rate = PI * RICKER.frequency;
    assert!(velocity <= tolerance * RICKER.amplitude / rate, "{velocity}");
    // The displacement accumulates the velocity's error over the record's 4.6 s.
    assert!(displacement <= tolerance * 4.6 * RICKER.amplitude / rate, "{displacement}");
    let [velocity, displacement] =
        largest_error(&HARMONIC.motion(None).unwrap(), |t| sine_motion(HARMONIC, 0.4, t));
    let omega = 2.0 * PI * HARMONIC.frequency;
    assert!(velocity <= tolerance * HARMONIC.amplitude / omega, "{velocity}");
    assert!(displacement <= tolerance * 7.3 * HARMONIC.amplitude / omega, "{displacement}");
}

#[test]
fn ends_exactly_where_the_motion_does() {
    let cycle = Pulse { shape: Shape::SineCycle, amplitude: 3.0, frequency: 1.7 };
    let half = Pulse { shape: Shape::HalfSine, ..cycle };
    let endless = Pulse { shape: Shape::Harmonic { phase: 0.0, end: None }, ..cycle };
    for (pulse, duration, end) in [
        (HARMONIC, None, 7.3),
        (HARMONIC, Some(5.55), 5.55),
        (HARMONIC, Some(20.0), 7.3),
        (endless, Some(20.0), 20.0),
        (cycle, None, 1.0 / 1.7),
        (half, None, 0.5 / 1.7),
        (RICKER, Some(3.0), 3.0),
    ] {
        let motion = pulse.motion(duration).unwrap();
        // The end is the product of a quotient: two roundings.
        assert!(
            (motion.duration() - end).abs() <= 2.0 * f64::EPSILON * end,
            "{pulse:?} {}",
            motion.duration()
        );
        assert!(motion.step() <= 1e-3 && motion.step() <= 1.0 / (2000.0 * pulse.frequency));
        assert_eq!(motion.at(end * (1.0 + 1e-12)), 0.0);
    }
    // The harmonic stops at full value: A sin(2π f 7.3 + φ), by the factor 1 + (ωΔt)²/12 of the corrected
    // nodes.
    let last = *HARMONIC.motion(None).unwrap().samples().last().unwrap();
    let exact = 1.2 * (2.0 * PI * 1.1 * 7.3 + 0.4).sin();
    assert!((last / exact - 1.0).abs() < 1e-6 && exact.abs() > 0.1, "{last} {exact}");
}

#[test]
fn single_pulses_leave_the_velocity_of_their_area() {
    let cycle = Pulse { shape: Shape::SineCycle, amplitude: 3.0, frequency: 1.7 };
    let half = Pulse { shape: Shape::HalfSine, ..cycle };
    for pulse in [cycle, half] {
        let [velocity, displacement] =
            largest_error(&pulse.motion(None).unwrap(), |t| sine_motion(pulse, 0.0, t));
        // As above: 4e-13 and at most 2000 roundings of 1e-16.
        assert!(velocity <= 1e-12 && displacement <= 1e-12, "{pulse:?}: {velocity} {displacement}");
    }
    let peak = half.motion(None).unwrap().peak();
    assert!((peak / 3.0 - 1.0).abs() < 1e-6, "{peak}");
}

#[test]
fn refuses_parameters_outside_their_limits() {
    let with_shape = |shape| Pulse { shape, ..RICKER };
    for (pulse, duration, name) in [
        (Pulse { amplitude: f64::NAN, ..RICKER }, None, "amplitude"),
        (Pulse { frequency: 0.0, ..RICKER }, None, "frequency"),
        (Pulse { frequency: -1.0, ..RICKER }, None, "frequency"),
        (Pulse { frequency: f64::INFINITY, ..RICKER }, None, "frequency"),
        (with_shape(Shape::Ricker { centre: -0.1 }), None, "centre"),
        (with_shape(Shape::Ricker { centre: f64::NAN }), None, "centre"),
        (with_shape(Shape::Harmonic { phase: f64::NAN, end: None }), Some(1.0), "phase"),
        (with_shape(Shape::Harmonic { phase: 0.0, end: Some(0.0) }), None, "end"),
        (RICKER, Some(-1.0), "duration"),
        (RICKER, Some(f64::NAN), "duration"),
    ] {
        let error = pulse.motion(duration).unwrap_err();
        assert!(matches!(error, GroundMotionError::Parameter { .. }), "{error}");
        assert!(error.to_string().starts_with(name), "{error}");
    }
    let endless = with_shape(Shape::Harmonic { phase: 0.0, end: None });
    assert!(matches!(endless.motion(None), Err(GroundMotionError::Endless)));
    for pulse in [Pulse { frequency: 1e-300, ..RICKER }, with_shape(Shape::Ricker { centre: f64::MAX })] {
        assert!(matches!(pulse.motion(None), Err(GroundMotionError::TooManySamples { .. })));
    }
    for step in [0.0, f64::NAN] {
        assert!(matches!(RICKER.sampled(None, step), Err(GroundMotionError::Step { .. })));
    }
}
