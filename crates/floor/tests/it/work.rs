//! What a step costs: the spans that it looks at.

use rocking_floor::floor::{Floor, Parameters};
use rocking_floor::motion::{FloorState, Load, MOST_SPANS, MotionError, Work};
use rocking_floor::variables::Hysteresis;

fn bilinear() -> Parameters {
    Parameters { hysteresis: Hysteresis::Bilinear, mass: 2e4, ..Parameters::default() }
}

/// The spans of a step \[s\]: the floor turns every π/ω, a little less where it yields; a few more for its
/// corners.
fn expected(floor: &Floor, duration: f64) -> f64 {
    3.0 * (1.05 * duration * floor.omega() / std::f64::consts::PI + 8.0)
}

/// Yielding creeps to rest at the limit, where the branches disagree by rounding: the floor stays elastic
/// there instead of changing its branch without end.
#[test]
fn a_floor_at_rest_at_its_limit_stays_on_one_branch() {
    let creeping = [
        (9.4e13, 2.0e12, 7.3e-4, 0.05),
        (92_568_572_353_110.7, 2_039_091_153_779.615_7, 7.238_208_842_123_778e-4, 0.026_844_589_267_044_295),
    ];
    for (stiffness, yield_force, hardening_ratio, damping_ratio) in creeping {
        let parameters = Parameters { stiffness, yield_force, hardening_ratio, damping_ratio, ..bilinear() };
        let floor = Floor::new(&parameters).unwrap();
        let mut state = FloorState::new(&floor, -100.0, 0.0, Load::default());
        let Work { corners, spans } = state.advance(&floor, Load::default(), 0.08).unwrap();
        assert!(corners <= 2 && (spans as f64) < expected(&floor, 0.08), "{corners} {spans}");
        // it is where the spring has no force, to 32 ε of the displacements
        let rounding = 32.0 * f64::EPSILON * stiffness * (state.displacement.abs() + state.plastic.abs());
        assert!(state.spring_force(&floor).abs() < rounding, "{state:?}");
    }
}

/// No floor within the limits of the description is followed more often than it turns, whatever pushes it.
#[test]
fn a_step_looks_at_as_many_spans_as_the_floor_turns() {
    let mut seed = 1_u64;
    let mut uniform = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut between = move |low: f64, high: f64| low + (high - low) * uniform();
    let mut compared = 0;
    for _ in 0..2000 {
        let mut power = |low, high| 10_f64.powf(between(low, high));
        let parameters = Parameters {
            mass: power(1.0, 8.0),
            stiffness: power(0.0, 15.0),
            yield_force: power(0.0, 13.0),
            hardening_ratio: power(-6.0, -0.01),
            damping_ratio: power(-3.0, 0.0),
            displacement_start: -power(-3.0, 2.0),
            ..bilinear()
        };
        let (duration, value, rate) = (power(-5.0, 0.0), power(-3.0, 4.0), -power(-3.0, 6.0));
        let floor = Floor::new(&parameters).unwrap();
        let most = expected(&floor, duration);
        if most > 3000.0 {
            continue;
        }
        let mut state = FloorState::new(&floor, parameters.displacement_start, 0.0, Load::default());
        for load in [Load::default(), Load { value, rate: 0.0 }, Load { value, rate }] {
            let Work { corners, spans } = state.advance(&floor, load, duration).unwrap();
            assert!(spans as f64 <= most && corners <= spans, "{spans} for {most}: {parameters:?} {load:?}");
            compared += usize::from(corners > 0);
        }
    }
    assert!(compared > 500, "{compared} steps passed corners");
}

#[test]
fn a_step_with_too_many_turns_is_refused() {
    // 1000 rad/s
    let floor = Floor::new(&Parameters { stiffness: 2e10, damping_ratio: 0.0, ..bilinear() }).unwrap();
    let turns = |count: f64| count * std::f64::consts::PI / floor.omega();
    let work = |duration| {
        let mut state = FloorState::new(&floor, 1e-9, 0.0, Load::default());
        state.advance(&floor, Load::default(), duration)
    };
    let most = MOST_SPANS as f64;
    let within = work(turns(most - 2.0)).unwrap();
    assert!(within.spans <= MOST_SPANS && within.spans + 4 > MOST_SPANS, "{within:?}");
    let refused = work(turns(most + 2.0)).unwrap_err();
    assert!(matches!(refused, MotionError::TooManySpans { .. }));
    let message = refused.to_string();
    for part in ["more than 50000 times", "157.08", "use smaller steps"] {
        assert!(message.contains(part), "{message}");
    }
}
