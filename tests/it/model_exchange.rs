//! Tests what an importer's solver meets: events with all that they did, the damping beyond a branch, the
//! scene's own motion.

use fmu_export::{Experiment, Interface, Log, Model as _, ModelExchange as _};
use rocking_wall::simulation::{Handled, Simulation};
use rocking_wall::solver::{Event, INDICATORS, Phase, Work};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, RealVariable, Rocking, Softening};
use rocking_wall::wall::{BranchDamping, Ends, Parameters, Support, Wall};
use scene::Scene;

use crate::{instantiated, secant_models, start};

/// A rigid parapet that starts at 0.02 m, with restitution 0.9.
fn rigid() -> Parameters {
    Parameters {
        force_law: ForceLaw::RigidLinear,
        damping_model: DampingModel::None,
        impact: Impact::Restitution,
        restitution: 0.9,
        u_start: 0.02,
        ..Parameters::default()
    }
}

/// Sets the motion and handles the event there.
fn event_at(simulation: &mut Simulation, displacement: f64, velocity: f64) -> Handled {
    simulation.set_motion(displacement, velocity);
    let before = simulation.progress().work;
    let handled = simulation.handle_event(&mut false, Support::default());
    let mut work = before;
    work.add(handled.event.work);
    assert_eq!(simulation.progress().work, work, "the simulation counts the event's work");
    handled
}

/// At a corner the velocity decides: outwards the wall is on the branch beyond, inwards it stays.
#[test]
fn a_wall_at_a_corner_goes_where_it_moves() {
    let mut simulation = start(&Parameters { u_start: 0.0, ..Parameters::default() });
    for side in [1.0, -1.0] {
        let places = simulation.wall().corners().iter().map(|corner| corner.displacement);
        let corner = places.filter(|place| place * side > 0.0).fold(f64::INFINITY, |a, b| a.min(b.abs()));
        event_at(&mut simulation, 0.0, 0.0);
        let inner = simulation.progress().state.branch;
        event_at(&mut simulation, side * corner, -0.1 * side);
        assert_eq!(simulation.progress().state.branch, inner);
        event_at(&mut simulation, side * corner, 0.1 * side);
        assert_ne!(simulation.progress().state.branch, inner);
        event_at(&mut simulation, side * corner, -0.1 * side);
        assert_eq!(simulation.progress().state.branch, inner);
        // a wall that moves back counts as beyond only from half a margin past the corner
        let margin = 1e-12 * simulation.wall().displacement_scale();
        for (share, beyond) in [(0.49, false), (0.51, true)] {
            event_at(&mut simulation, 0.0, 0.0);
            event_at(&mut simulation, side * (corner + share * margin), -0.1 * side);
            assert_eq!(simulation.progress().state.branch != inner, beyond, "{share}");
        }
    }
}

/// Beyond u = 0 by δ the wall has gained p δ of energy on the old side, and lost as much on the new one.
#[test]
fn an_impact_reports_its_jump_and_impulse() {
    let mut simulation = start(&rigid());
    let body = simulation.wall().body();
    let (mass, strength) = (body.mass, body.strength.positive / body.effective_mass);
    let (late, speed) = (1e-6, 0.3);
    let arriving: f64 = speed * speed - 2.0 * strength * late;
    let after = -(0.81 * arriving - 2.0 * strength * late).sqrt();
    let Handled { event, impulses, changed } = event_at(&mut simulation, -late, -speed);
    let jump = event.velocity_jump;
    assert!((jump - (after + speed)).abs() <= 1e-15, "{jump} for {}", after + speed);
    let work = Work { pieces: 0, corners: 1, impacts: 1 };
    assert_eq!(event, Event { velocity_jump: jump, work, ..Event::default() });
    assert_eq!((impulses, changed), (Ends { bottom: mass * jump, top: 0.0 }, true));
    assert_eq!(simulation.progress().state.velocity, -speed + jump);
    // nothing more happens there
    assert_eq!(event_at(&mut simulation, -late, -speed), Handled::default());
    // without a jump of the force, and without forcing, a correction would be of order δ²
    let mut bilinear = start(&Parameters { force_law: ForceLaw::Bilinear, ..rigid() });
    event_at(&mut bilinear, -late, -speed);
    assert_eq!(bilinear.progress().state.velocity, -0.9 * speed);
}

/// One update passes every corner on the way, and each mark is reported once.
#[test]
fn an_event_reports_every_corner_on_the_way() {
    let bilinear = Parameters { force_law: ForceLaw::Bilinear, xi: 0.0, ..Parameters::default() };
    let bilinear = Parameters { damping_model: DampingModel::ConstantCoefficient, ..bilinear };
    let mut simulation = start(&Parameters { u_start: 0.1, ..bilinear });
    let two = Event { work: Work { corners: 2, ..Work::default() }, ..Event::default() };
    assert_eq!(event_at(&mut simulation, -0.1, -0.1).event, two);
    assert_eq!(simulation.progress().overturn_time, None);
    simulation.set_time(2.0);
    let (u_ins, end) = (simulation.wall().body().instability.negative, simulation.wall().corners()[0]);
    let overturned = event_at(&mut simulation, -1.01 * u_ins, -0.1).event;
    assert!(overturned.overturned && !overturned.departed && !overturned.stopped, "{overturned:?}");
    assert_eq!(simulation.progress().overturn_time, Some(2.0));
    // the first time counts
    assert!(!event_at(&mut simulation, -0.9 * u_ins, 0.1).event.overturned);
    simulation.set_time(2.5);
    assert!(!event_at(&mut simulation, -1.01 * u_ins, -0.1).event.overturned);
    assert_eq!(simulation.progress().overturn_time, Some(2.0));
    let landed = event_at(&mut simulation, end.displacement - 0.01, -0.1);
    assert!(!landed.event.overturned && landed.event.departed && landed.event.stopped, "{landed:?}");
    let state = simulation.progress().state;
    assert_eq!((state.phase, state.displacement, state.velocity), (Phase::Landed, end.displacement, 0.0));
    // all at once
    let mut simulation = start(&rigid());
    simulation.set_time(3.0);
    let end = simulation.wall().corners().last().unwrap().displacement;
    let fallen = event_at(&mut simulation, end + 0.01, 1.0).event;
    let work = Work { corners: 3, ..Work::default() };
    let expected = Event { overturned: true, departed: true, stopped: true, work, ..Event::default() };
    assert_eq!(fallen, expected);
    assert_eq!(simulation.progress().overturn_time, Some(3.0));
}

/// Each indicator is the distance to its corner or to the edge of the band of rest, over its scale, and 1e-12
/// more: positive on the branch, and zero that much beyond.
#[test]
fn indicators_are_distances_to_the_next_event() {
    let near = |found: [f64; INDICATORS], expected: [f64; INDICATORS]| {
        let apart = found.iter().zip(expected).map(|(a, b)| (a - b - 1e-12).abs()).fold(0.0, f64::max);
        assert!(apart <= 1e-15, "{found:?} for {expected:?}");
    };
    let still = Support::default();
    let damping_model = DampingModel::None;
    let mut simulation =
        start(&Parameters { a1: 0.05, u_start: 0.15, damping_model, ..Parameters::default() });
    let body = simulation.wall().body().clone();
    let (u_ins, rate) = (body.instability.positive, simulation.wall().rocking_rate());
    // between u₁ = 0.01 m and the end of the force at u_ins
    near(simulation.indicators(false, still), [0.14 / u_ins, (u_ins - 0.15) / u_ins, 0.0]);
    simulation.set_motion(0.005, -0.3);
    near(simulation.indicators(false, still), [-0.005 / u_ins, (u_ins - 0.005) / u_ins, 0.145 / u_ins]);
    // beyond its largest |u|, u̇ outwards counts
    near(
        simulation.indicators(true, still),
        [-0.005 / u_ins, (u_ins - 0.005) / u_ins, -0.3 / (u_ins * rate)],
    );
    let simulation = start(&Parameters { u_start: 0.0, ..rigid() });
    let onset = body.strength.positive / body.effective_mass;
    let pushed = Support::rigid(0.25 * onset / body.forcing(Support::rigid(1.0)));
    near(simulation.indicators(false, pushed), [0.625, 0.375, 0.0]);
    // at transverse walls the band has one end
    let rocking = Rocking::OneSidedPositive;
    let simulation = start(&Parameters { u_start: 0.0, rocking, ..rigid() });
    near(simulation.indicators(false, pushed), [1.0, 0.75, 0.0]);
    let end = simulation.wall().corners().last().unwrap().displacement;
    let mut simulation = start(&rigid());
    event_at(&mut simulation, end + 0.01, 1.0);
    assert_eq!(simulation.indicators(false, still), [1.0; INDICATORS], "it has landed");
}

/// Only steps outwards beyond the largest |u| so far raise it, and an event on the way back ends that.
#[test]
fn peaks_rise_with_completed_steps() {
    let mut simulation = start(&Parameters { u_start: 0.1, u_dot_start: 0.1, ..Parameters::default() });
    let mut rising = false;
    let still = Support::default();
    simulation.handle_event(&mut rising, still);
    assert!(rising, "it moves outwards from its start");
    for (displacement, rises, largest) in
        [(0.11, true, 0.11), (0.12, true, 0.12), (0.115, true, 0.12), (0.13, false, 0.12)]
    {
        simulation.set_motion(displacement, 0.1);
        simulation.complete_step(rises);
        assert_eq!(simulation.progress().state.peaks.largest(), largest);
    }
    simulation.set_motion(0.12, -0.1);
    simulation.handle_event(&mut rising, still);
    assert!(!rising && simulation.progress().state.peaks.largest() == 0.12);
}

/// Beyond the inner end of a curved branch, C has the first two derivatives of the branch's own there, so
/// that the two part with the third power of the distance; the slope that comes with C is its own.
#[test]
fn damping_goes_on_smoothly_beyond_a_branch() {
    let mut compared = 0;
    for damping_model in secant_models() {
        for softening in [Softening::Parallel, Softening::Rotated] {
            let wall = Wall::new(&Parameters {
                damping_model,
                softening,
                force_law: ForceLaw::Trilinear,
                xi: 0.05,
                ..Parameters::default()
            });
            let wall = wall.unwrap();
            let curved = |damping| !matches!(damping, BranchDamping::Constant(_));
            for branch in wall.branches().iter().filter(|branch| curved(branch.damping)) {
                compared += 1;
                let is_outside = branch.lower >= 0.0;
                let (inner, outer) =
                    if is_outside { (branch.lower, branch.upper) } else { (branch.upper, branch.lower) };
                let (size, slope) = (branch.damping_at(inner), branch.damping_slope(inner).abs());
                let apart = |inwards: f64| {
                    let place = inner * (1.0 - inwards);
                    (branch.continued_damping(place).0 - branch.damping_at(place)).abs() / size
                };
                let order = (apart(2e-3) / apart(1e-3)).log2();
                assert!((order - 3.0).abs() < 0.02, "{damping_model:?}: order {order}");
                // beyond the inner end, inside, and beyond the outer one
                let near = [-3.0, -1.0, -0.5, 0.1, 0.9, 0.999].map(|share| inner * (1.0 + 0.3 * share));
                let across = [0.1, 0.5, 0.99, 1.1, 1.5].map(|share| inner + share * (outer - inner));
                for place in near.into_iter().chain(across) {
                    slope_is_that_of_the_value(branch, place, size + slope * inner.abs());
                }
                // beyond u₃, where F/u changes its sign
                let beyond = 1.2 * wall.force_end().of(inner).copysign(inner);
                let expected = match branch.damping {
                    BranchDamping::SecantStiffness(factor) => factor * branch.own.at(beyond) / beyond,
                    _ => branch.damping_at(beyond),
                };
                assert!((branch.continued_damping(beyond).0 - expected).abs() <= 1e-15 * size);
                assert!(branch.own.slope == 0.0 || expected <= 0.0, "{expected}");
                let (bounded, _) = branch.continued_damping(-1e3 * inner);
                assert!(bounded.abs() <= 20.0 * (size + slope * inner.abs()), "{bounded} for {size}");
            }
        }
    }
    // at least four branches of each softening
    assert!(compared >= 8 * secant_models().count(), "{compared} branches");
}

#[track_caller]
fn slope_is_that_of_the_value(branch: &rocking_wall::wall::Branch, place: f64, size: f64) {
    let step = 1e-5 * place.abs();
    let (value, slope) = branch.continued_damping(place);
    let [below, above] = [place - step, place + step].map(|place| branch.continued_damping(place).0);
    let rounded = (above - below) / (2.0 * step);
    // central differences err by step² of the third derivative, and by rounding over the step
    let allowed = 1e-6 * size / place.abs();
    assert!((slope - rounded).abs() <= allowed, "{value} at {place}: slope {slope} for {rounded}");
}

/// A rigid wall at rest shows the motion of its support in its reaction. The unit announces every sample as
/// an event, and goes linearly between; time runs from the start of the simulation.
#[test]
fn the_scenes_own_motion_goes_on_from_sample_to_sample() {
    const START: f64 = 5.0;
    let text = "[force_law]\nforce_law = \"rigid_linear\"\n\
                [damping]\ndamping_model = \"none\"\n\
                [start]\nu_start = 0.0\n\
                [motion]\nharmonic = { amplitude = 0.5, frequency = 20.0, duration = 0.02 }\n";
    let scene = Scene::parse("scene", text, std::path::Path::new(".")).unwrap();
    let motion = scene.support_motion().unwrap().unwrap();
    let mut unit = instantiated(Interface::ModelExchange, Some(text), &mut Log::silent());
    unit.setup_experiment(Experiment { start: START, ..Experiment::default() });
    unit.initialize(&mut Log::silent()).unwrap();
    let mass = unit.real(RealVariable::Mass);
    let (step, mut samples) = (motion.step(), 0_u32);
    let mut update = unit.update(&mut Log::silent()).unwrap();
    while let Some(next) = update.next_event {
        samples += 1;
        let expected = START + f64::from(samples) * step;
        assert!((next - expected).abs() <= 1e-14 * START, "{next} s for {expected} s");
        for time in [next - 0.9 * step, next - 0.5 * step, next - 0.1 * step] {
            unit.set_time(time);
            let reaction = unit.real(RealVariable::ReactionBottom);
            let expected = mass * motion.segment(time - START, 0.0).from.bottom;
            assert!((reaction - expected).abs() <= 1e-9 * mass, "{time} s: {reaction} N for {expected} N");
        }
        // an importer that is early by 1e-9 of its time has come to the sample
        let margin = 1e-9 * next;
        unit.set_time(next - 1.1 * margin);
        let early = unit.update(&mut Log::silent()).unwrap();
        assert!(early.next_event == Some(next) && !early.states_changed, "{early:?}");
        unit.set_time(if samples % 2 == 0 { next } else { next - 0.9 * margin });
        update = unit.update(&mut Log::silent()).unwrap();
        assert!(update.states_changed, "solvers restart at a sample");
    }
    assert_eq!(samples as usize, motion.bottom().samples().len() - 1);
}
