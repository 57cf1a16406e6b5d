//! Tests demands: extremes and crossings against closed forms and dense sampling, half cycles, and the
//! program's output.

use proptest::prelude::*;
use rocking_wall::simulation::Simulation;
use rocking_wall::solver::{Demands, Extremes, Instant, Segment};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism};
use rocking_wall::wall::{Ends, Parameters, Support, Wall};
use scene::Scene;
use scene::response::Response;

use crate::configuration::{configuration, mostly};
use crate::properties::{onset, walls};

fn undamped(law: ForceLaw) -> Parameters {
    Parameters { force_law: law, damping_model: DampingModel::None, ..Parameters::default() }
}

/// Free motion in steps of 10 ms.
fn free(parameters: &Parameters, steps: u32, fractions: &[f64]) -> (Simulation, Demands) {
    let mut simulation = crate::start(parameters);
    let mut demands = simulation.demands(Support::default(), fractions);
    for _ in 0..steps {
        simulation.advance_watched(&crate::still(0.01), &mut demands).unwrap();
    }
    (simulation, demands)
}

/// 1e-11 of the value is ten times the stated accuracy, which allows for rounding of the motion. Times are
/// accurate to 1e-6 of the time scale.
#[track_caller]
fn assert_instant(found: Instant, value: f64, time: f64, scale: f64) {
    assert!((found.value - value).abs() <= 1e-11 * value.abs(), "{} for {value}", found.value);
    assert!((found.time - time).abs() <= 1e-5 * scale, "{} s for {time} s", found.time);
}

#[test]
fn of_extremes_of_one_size_the_highest_is_the_largest() {
    let [low, high] = [-0.2, 0.2].map(|value| Instant { value, time: 1.0 - value });
    let larger = Instant { value: -0.3, time: 0.7 };
    assert_eq!(Extremes { highest: high, lowest: low }.largest(), high);
    assert_eq!(Extremes { highest: high, lowest: larger }.largest(), larger);
}

/// u = u₀ cos ωt; no extreme falls on a sample at 10 ms.
#[test]
fn elastic_vibration_has_its_closed_form() {
    let start = 1e-3;
    let parameters = Parameters { u_start: start, ..undamped(ForceLaw::Bilinear) };
    let (simulation, demands) = free(&parameters, 60, &[0.004, 0.1]);
    let omega = simulation.wall().omega1();
    let quarter = std::f64::consts::FRAC_PI_2 / omega;
    let scale = 1.0 / omega;
    assert_instant(demands.displacement.lowest, -start, 2.0 * quarter, scale);
    assert_instant(demands.velocity.lowest, -start * omega, quarter, scale);
    assert_instant(demands.velocity.highest, start * omega, 3.0 * quarter, scale);
    assert_instant(demands.acceleration.highest, start * omega * omega, 2.0 * quarter, scale);
    let mass = simulation.wall().body().mass;
    assert_instant(demands.reaction_bottom.highest, mass * start * omega * omega, 2.0 * quarter, scale);
    assert_eq!(demands.reaction_top.highest.value, 0.0);
    assert_eq!((demands.crossings[0].first.unwrap().time, demands.crossings[1].first), (0.0, None));
    assert_eq!(demands.half_cycles, 0, "it never leaves the elastic branch");
}

/// A limit state that the start just reaches is reached at the start. Some u/`u_ins` are a rounding below
/// their fraction here.
#[test]
fn a_start_on_a_limit_state_reaches_it() {
    let mut below = 0;
    for n in 1..100 {
        let (thickness, fraction) = (0.37 + 1e-3 * f64::from(n), f64::from(n) / 100.0);
        let wall = Parameters { thickness, ..undamped(ForceLaw::Bilinear) };
        let u_ins = Wall::new(&wall).unwrap().body().instability.positive;
        let u_start = fraction * u_ins;
        let (_, demands) = free(&Parameters { u_start, ..wall }, 2, &[fraction]);
        assert_eq!(demands.crossings[0].first, Some(Instant { value: u_start, time: 0.0 }));
        below += u32::from(u_start / u_ins < fraction);
    }
    assert!(below > 0, "no fraction is rounded down");
}

/// u/u_ins = 1 − cosh pt + (v₀/p) sinh pt from u = 0.
#[test]
fn crossings_of_a_rigid_wall_have_their_closed_form() {
    let wall = undamped(ForceLaw::RigidLinear);
    let rate = Wall::new(&wall).unwrap().rocking_rate();
    let velocity = 0.9;
    let parameters = Parameters { u_start: 0.0, u_dot_start: velocity * rate * 0.2, ..wall };
    let (_, demands) = free(&parameters, 100, &[0.3, 0.5, 0.6]);
    // e^{pt} = y solves (1 − v) y² − 2 (1 − x) y + (1 + v) = 0; the smaller root comes first
    let time = |x: f64| {
        let discriminant = (1.0 - x).powi(2) - (1.0 - velocity * velocity);
        ((1.0 - x - discriminant.sqrt()) / (1.0 - velocity)).ln() / rate
    };
    for (crossing, fraction) in demands.crossings.iter().zip([0.3, 0.5]) {
        let first = crossing.first.unwrap();
        // times are sums of steps of 10 ms
        assert!((first.time - time(fraction)).abs() < 1e-13, "{fraction}: {} s", first.time);
        assert!((first.value - 0.2 * fraction).abs() < 1e-15);
    }
    // it turns at 1 − √(1 − v²) = 0.564
    assert_eq!(demands.crossings[2].first, None);
    let turn = 0.2 * (1.0 - (1.0 - velocity * velocity).sqrt());
    assert!((demands.displacement.highest.value - turn).abs() < 1e-12);
}

/// The fraction 1 is overturning, to the bit.
#[test]
fn the_last_threshold_is_overturning() {
    let mut scene = Scene::default();
    scene.parameters = Parameters { u_start: 0.0, u_dot_start: 1.5, ..scene.parameters };
    let response = Response::of(&scene).unwrap();
    let crossing = response.demands.crossings[3];
    assert_eq!(crossing.fraction, 1.0);
    assert_eq!(crossing.first.map(|first| first.time), response.summary.overturn_time);
    assert!(
        response.summary.overturned
            && response.demands.displacement.highest.value == crossing.first.unwrap().value
    );
}

/// A rigid block counts one excursion per impact, a wall with an elastic branch two per cycle and none at the
/// end.
#[test]
fn half_cycles_are_excursions() {
    let parameters =
        Parameters { impact: Impact::Restitution, restitution: 0.9, ..undamped(ForceLaw::RigidLinear) };
    let (simulation, demands) = free(&parameters, 400, &[]);
    // the first excursion had begun; the last is under way
    assert_eq!(demands.half_cycles, simulation.progress().work.impacts + 1);
    let damped = Parameters { xi: 0.05, ..Parameters::default() };
    let (simulation, demands) = free(&damped, 3000, &[]);
    let corners = simulation.progress().work.corners;
    // out through a corner and back through it; the start was outside
    assert_eq!(2 * demands.half_cycles, corners + 1, "{corners} corners");
}

/// A motion about the end of the elastic branch that never comes to u = 0 is one half cycle, on either side.
#[test]
fn a_swing_on_one_side_is_one_half_cycle() {
    for side in [1.0, -1.0] {
        let upright = Parameters { u_start: 0.0, ..undamped(ForceLaw::Bilinear) };
        let wall = Wall::new(&upright).unwrap();
        let elastic = wall.branches().iter().find(|branch| branch.lower < 0.0 && branch.upper > 0.0).unwrap();
        // in equilibrium at 0.8 of the elastic end
        let support = Support::rigid(-0.8 * side * onset(&wall));
        let parameters = Parameters { u_start: 1.05 * side * elastic.upper, ..upright };
        let mut simulation = Simulation::new(&parameters, None, 0.0, support).unwrap();
        let mut demands = simulation.demands(support, &[]);
        for _ in 0..500 {
            let segment = Segment { duration: 0.01, from: support, to: support };
            simulation.advance_watched(&segment, &mut demands).unwrap();
        }
        let corners = simulation.progress().work.corners;
        assert!(corners > 4, "{corners} corners");
        let Extremes { highest, lowest } = demands.displacement;
        assert!(side * lowest.value > 0.0 && side * highest.value > 0.0);
        assert_eq!(demands.half_cycles, 1);
    }
}

/// The impulses of a step are the integrals of the reactions, here by Simpson's rule on 200 parts of one
/// branch. A wall that leaves its supports within the step has those up to there, as in parts.
#[test]
fn impulses_are_integrals_of_the_reactions() {
    let with = |drift: f64| {
        [[0.4, -0.3, drift], [-0.2, 0.5, -2.0 * drift]].map(|[bottom, top, drift]| Support {
            bottom,
            top,
            drift,
        })
    };
    for (mechanism, damping_model, drift) in [
        (Mechanism::Parapet, DampingModel::ConstantRatio, 1e-3),
        (Mechanism::VerticalSpanning, DampingModel::ConstantRatio, 1e-3),
        (Mechanism::VerticalSpanning, DampingModel::ConstantCoefficient, 1e-3),
        (Mechanism::VerticalSpanning, DampingModel::ConstantCoefficient, 0.0),
    ] {
        let supports = with(drift);
        let at = |part: u32| supports[0].towards(supports[1], f64::from(part) / 200.0);
        for (start, duration, departs) in [(0.5, 0.1, false), (0.97, 1.5, true)] {
            let (xi, overburden, u_start) = (0.05, 2e3, 0.0);
            let parameters = Parameters::default();
            let wall = Parameters { mechanism, damping_model, xi, overburden, u_start, ..parameters };
            let upright = Simulation::new(&wall, None, 0.0, supports[0]).unwrap();
            let u_ins = upright.wall().body().instability.positive;
            // pushed outwards where it is to leave its supports
            let u_dot_start = if departs { 2.0 * u_ins } else { 0.0 };
            let wall = Parameters { u_start: start * u_ins, u_dot_start, ..wall };
            let mut whole = Simulation::new(&wall, None, 0.0, supports[0]).unwrap();
            let mut parts = whole.clone();
            let (mut sum, mut integral) = (Ends::default(), Ends::default());
            for part in 0..200 {
                let weight =
                    duration / 200.0 / 3.0 * if part == 0 { 1.0 } else { f64::from(2 + 2 * (part % 2)) };
                let reactions = parts.outputs(at(part)).reactions;
                integral.bottom += weight * reactions.bottom;
                integral.top += weight * reactions.top;
                let segment = Segment { duration: duration / 200.0, from: at(part), to: at(part + 1) };
                let impulses = parts.advance(&segment).unwrap().impulses;
                sum.bottom += impulses.bottom;
                sum.top += impulses.top;
            }
            let last = parts.outputs(supports[1]).reactions;
            integral.bottom += duration / 600.0 * last.bottom;
            integral.top += duration / 600.0 * last.top;
            let [from, to] = supports;
            let done = whole.advance(&Segment { duration, from, to }).unwrap();
            assert_eq!(done.departed, departs, "{mechanism:?}");
            let size = upright.wall().body().weight * duration;
            let apart = |other: Ends| {
                (done.impulses.bottom - other.bottom).abs().max((done.impulses.top - other.top).abs()) / size
            };
            assert!(apart(sum) < 1e-12, "{mechanism:?}, departs {departs}: {:e}", apart(sum));
            assert!(departs || apart(integral) < 1e-10, "{mechanism:?}: {:e}", apart(integral));
        }
    }
}

/// The least and most of a quantity.
fn widen(range: &mut [f64; 2], value: f64) {
    *range = [range[0].min(value), range[1].max(value)];
}

proptest! {
    #![proptest_config(configuration())]

    /// Watching a run changes no bit of it, although a run that nobody watches takes quiet steps at once.
    #[test]
    fn watching_changes_no_bit(
        parameters in walls(),
        start in prop::sample::select(vec![0.0, 0.02, -0.5, 0.999]),
        step in prop::sample::select(vec![1e-4, 2e-3, 0.01, 1.0]),
        motion in prop::collection::vec(-1.2_f64..1.2, 8..200),
    ) {
        let wall = Wall::new(&parameters).unwrap();
        let u_start = start * wall.body().instability.positive;
        let mut watched = crate::start(&Parameters { u_start, ..parameters });
        let mut demands = watched.demands(Support::default(), &[]);
        let mut alone = watched.clone();
        for ends in motion.windows(2) {
            let [from, to] = [ends[0], ends[1]].map(|part| Support::rigid(onset(&wall) * part));
            let segment = Segment { duration: step, from, to };
            let expected = watched.advance_watched(&segment, &mut demands).unwrap();
            prop_assert_eq!(alone.advance(&segment).unwrap(), expected);
            prop_assert_eq!(alone.progress(), watched.progress());
            let bits = |run: &Simulation| {
                [run.progress().state.displacement, run.progress().state.velocity].map(f64::to_bits)
            };
            prop_assert_eq!(bits(&alone), bits(&watched));
        }
    }
}

/// No dense sample exceeds the extremes, and the extremes exceed the dense samples by no more than sampling
/// misses, which only a smooth u̇ bounds.
#[test]
fn extremes_hold_between_samples() {
    let motions = prop::collection::vec((-1.5_f64..1.5, -1.5_f64..1.5, -1e-3_f64..1e-3), 8..20);
    // smooth were 0.31
    mostly(0.2, (walls(), motions), |(parameters, motion)| {
        const PARTS: u32 = 400;
        let step = 0.04;
        let mut simulation = crate::start(&parameters);
        let onset = onset(simulation.wall());
        let supports: Vec<_> = motion
            .iter()
            .map(|&(bottom, top, drift)| Support { bottom: onset * bottom, top: onset * top, drift })
            .collect();
        // the watched one includes the drift from the start, the other one from its first small step on
        let mut demands = simulation.demands(supports[0], &[0.01, 0.1]);
        let mut dense = simulation.clone();
        let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 5];
        let mut most = [0.0_f64; 5];
        let branches = simulation.wall().branches();
        let stiffest = branches.iter().map(|branch| branch.stiffness.abs()).fold(0.0, f64::max);
        for ends in supports.windows(2) {
            let at = |part: u32| ends[0].towards(ends[1], f64::from(part) / f64::from(PARTS));
            if dense.progress().state.overturned {
                break;
            }
            let segment = Segment { duration: step, from: ends[0], to: ends[1] };
            simulation.advance_watched(&segment, &mut demands).unwrap();
            for part in 0..PARTS {
                let (from, to) = (at(part), at(part + 1));
                dense.advance(&Segment { duration: step / f64::from(PARTS), from, to }).unwrap();
                if dense.progress().state.overturned {
                    break;
                }
                let outputs = dense.outputs(to);
                let values = [
                    outputs.displacement,
                    outputs.velocity,
                    outputs.acceleration,
                    outputs.reactions.bottom,
                    outputs.reactions.top,
                ];
                for ((range, most), value) in ranges.iter_mut().zip(&mut most).zip(values) {
                    widen(range, value);
                    *most = most.max(value.abs());
                }
            }
        }
        let found = [
            demands.displacement,
            demands.velocity,
            demands.acceleration,
            demands.reaction_bottom,
            demands.reaction_top,
        ];
        // rounding may change the motion, so the two solutions may differ by 1e-6 of the largest value
        for (index, (extremes, (range, most))) in found.iter().zip(ranges.iter().zip(&most)).enumerate() {
            let ([low, high], Extremes { highest, lowest }) = (range, extremes);
            prop_assert!(highest.value >= high - 1e-6 * most, "{index}: {} for {high}", highest.value);
            prop_assert!(lowest.value <= low + 1e-6 * most, "{index}: {} for {low}", lowest.value);
        }
        // Between samples δ apart, a smooth u̇ exceeds them by at most its size times (ωδ)²/8. That of a
        // rigid wall has a kink at u = 0, and one that ends at overturning ends between samples.
        let turn = stiffest.sqrt() * step / f64::from(PARTS);
        let wall = simulation.wall();
        let is_smooth = turn < 0.1 && !wall.is_rigid() && wall.passage_factor(1.0) == 1.0;
        let is_smooth = is_smooth && !dense.progress().state.overturned;
        if is_smooth {
            let [low, high] = ranges[1];
            let missed = (0.125 * turn * turn + 1e-3) * most[1];
            prop_assert!(demands.velocity.highest.value <= high.max(0.0) + missed);
            prop_assert!(demands.velocity.lowest.value >= low.min(0.0) - missed);
        }
        Ok([usize::from(is_smooth), 1])
    });
}

/// The limit states of a scene are used, and are kept when the scene is written.
#[test]
fn a_scene_states_its_limit_states() {
    let read = |text: &str| Scene::parse("scene", text, std::path::Path::new(".")).unwrap();
    let scene = read("thresholds = [0.25, 0.75]\n");
    let response = Response::of(&scene).unwrap();
    let fractions: Vec<f64> = response.demands.crossings.iter().map(|crossing| crossing.fraction).collect();
    assert_eq!(fractions, [0.25, 0.75]);
    assert_eq!(read(&scene::to_toml(&scene, "")).thresholds, scene.thresholds);
    assert_eq!(read("").thresholds, [0.1, 0.4, 0.6, 1.0]);
}
