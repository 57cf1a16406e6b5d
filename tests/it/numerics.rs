//! Orders, energy, dimensionless groups, work.

use proptest::prelude::*;
use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::simulation::{Progress, Simulation};
use rocking_wall::solver::{Method, Motion, Segment, Work};
use rocking_wall::variables::{DampingModel, ForceLaw, Impact, Mechanism, Softening, Solver};
use rocking_wall::wall::{Parameters, Ratio, Support, Wall};
use scene::Scene;
use scene::response::Response;

use crate::configuration::mostly;
use crate::properties::{COMPARED, motions};
use crate::record_path::alone;
use crate::{start, still};

fn parapet() -> Parameters {
    Parameters {
        damping_model: DampingModel::ConstantCoefficient,
        restitution: 0.9,
        xi: 0.05,
        u_start: 0.0,
        ..Parameters::default()
    }
}

/// Returns u/u_ins at the end of a run under p(t) = strength F₀/m_eff sin(ωt), sampled `count` times over
/// `duration`. `corrected` uses the nodes p − (Δt²/12) p″, which raise the order of straight lines from 2
/// to 4.
fn end_of_run(
    parameters: &Parameters,
    tolerance: Option<f64>,
    forced: &Forced,
    count: u32,
    corrected: bool,
) -> f64 {
    let wall = Wall::new(parameters).unwrap();
    let step = forced.duration / f64::from(count);
    let method = match tolerance {
        None => Method::Newmark { step },
        Some(_) if wall.has_constant_damping() => Method::Exact,
        Some(tolerance) => Method::Adaptive { tolerance },
    };
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    let raise = if corrected { 1.0 + (forced.rate * step).powi(2) / 12.0 } else { 1.0 };
    let sample =
        |index: u32| forced.strength * onset * raise * libm::sin(forced.rate * step * f64::from(index));
    let forcing: Vec<f64> = (0..=count).map(sample).collect();
    let motion = Motion::new(wall, method);
    let state = motion.start_under(forced.start * motion.wall().displacement_scale(), 0.0, 0.0);
    let solver = RecordSolver::new(&motion, step);
    let start = RunStart { state, factor: 1.0 };
    let passage = solver.run(start, Forcing::Samples(&forcing), RunEnd::OfRecord).unwrap();
    passage.state.displacement / motion.wall().displacement_scale()
}

struct Forced {
    strength: f64,
    rate: f64,
    duration: f64,
    /// Start over u_ins.
    start: f64,
}

/// Slope of log error over log step, by least squares.
fn order(errors: &[(f64, f64)]) -> f64 {
    let points: Vec<(f64, f64)> = errors.iter().map(|(step, error)| (step.ln(), error.ln())).collect();
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), point| (x + point.0 / n, y + point.1 / n));
    let (xy, xx) = points
        .iter()
        .fold((0.0, 0.0), |(xy, xx), point| (xy + (point.0 - x) * (point.1 - y), xx + (point.0 - x).powi(2)));
    xy / xx
}

fn observed(
    parameters: &Parameters,
    forced: &Forced,
    tolerance: Option<f64>,
    corrected: bool,
    coarsest: u32,
) -> f64 {
    let reference = end_of_run(parameters, Some(1e-14), forced, coarsest << 12, true);
    let error = |halvings: u32| {
        let count = coarsest << halvings;
        let error = (end_of_run(parameters, tolerance, forced, count, corrected) - reference).abs();
        (forced.duration / f64::from(count), error)
    };
    // smaller errors are the rounding of the 65,536 steps of the reference
    order(&(0..7).map(error).filter(|(_, error)| *error > 1e-13).collect::<Vec<_>>())
}

/// Newmark's linear acceleration is of order 2 inside a branch; a corner it does not locate costs h³ once, an
/// impact it locates on its cubic costs no more.
#[test]
fn newmark_is_of_second_order() {
    let inside = Forced { strength: 0.01, rate: 3.0, duration: 2.0, start: 0.0 };
    let across = Forced { strength: 0.3, rate: 2.0, duration: 1.5, start: 0.2 };
    let impact = Parameters { impact: Impact::Restitution, ..parapet() };
    for (name, parameters, forced) in
        [("branch", &parapet(), &inside), ("corner", &parapet(), &across), ("impact", &impact, &inside)]
    {
        let observed = observed(parameters, forced, None, false, 256);
        assert!((observed - 2.0).abs() < 0.2, "{name}: order {observed}");
    }
}

/// With secant damping the coefficient lags by one step: order 1.
#[test]
fn newmark_is_of_first_order_with_secant_damping() {
    let tilted = Forced { strength: 0.1, rate: 2.0, duration: 0.8, start: 0.5 };
    for damping_model in DampingModel::ALL.iter().copied() {
        let parameters = Parameters { damping_model, ..parapet() };
        if Wall::new(&parameters).unwrap().has_constant_damping() {
            continue;
        }
        let observed = observed(&parameters, &tilted, None, false, 256);
        assert!((observed - 1.0).abs() < 0.2, "{}: order {observed}", damping_model.name());
    }
}

/// Under samples of a smooth motion, the exact and the adaptive solver have the order of the straight lines
/// between samples: 2, and 4 with corrected nodes, across corners too. An impact scales u̇ inside a step,
/// where the corrected line has compensated its error h² of p in u but not yet in u̇: order 3.
#[test]
fn located_corners_keep_the_order_of_the_motion() {
    let across = Forced { strength: 0.3, rate: 2.0, duration: 1.5, start: 0.2 };
    let ratio = Parameters { damping_model: DampingModel::ConstantRatio, ..parapet() };
    let impact = Parameters { impact: Impact::Restitution, ..parapet() };
    for (name, parameters, best) in [("CDC", &parapet(), 4.0), ("CDR", &ratio, 4.0), ("impact", &impact, 3.0)]
    {
        for (corrected, theory) in [(false, 2.0), (true, best)] {
            let observed = observed(parameters, &across, Some(1e-14), corrected, 16);
            assert!((observed - theory).abs() < 0.2, "{name}, corrected {corrected}: order {observed}");
        }
    }
}

/// ∫p u̇ dt = ½ u̇² + ∫F du + ∫c u̇² dt, the integrals by Boole's rule on states the solver gives.
#[test]
fn work_is_stored_or_dissipated() {
    let parameters = parapet();
    let wall = Wall::new(&parameters).unwrap();
    let damping = wall.elastic_damping() / wall.body().effective_mass;
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    let factor = wall.body().forcing(Support::rigid(1.0));
    let mut simulation = start(&parameters);
    let forcing = |time: f64| 1.6 * onset * libm::sin(4.0 * time);
    let (step, mut input, mut lost, mut largest) = (2e-4, 0.0, 0.0, 0.0_f64);
    let weights = [7.0, 32.0, 12.0, 32.0, 7.0].map(|weight| weight / 90.0 * step);
    for index in 0..20_000_u32 {
        let time = f64::from(index) * step;
        let ends = [forcing(time), forcing(time + step)];
        let at = |part: u32| ends[0] + (ends[1] - ends[0]) * f64::from(part) / 4.0;
        for part in 0..=4_u32 {
            let velocity = simulation.progress().state.velocity;
            input += weights[part as usize] * at(part) * velocity;
            lost += weights[part as usize] * damping * velocity * velocity;
            if part < 4 {
                let support = |part: u32| Support::rigid(at(part) / factor);
                let segment = Segment { duration: step / 4.0, from: support(part), to: support(part + 1) };
                simulation.advance(&segment).unwrap();
            }
        }
        let state = simulation.progress().state;
        let stored = wall.energy(state.displacement, state.velocity);
        largest = largest.max(stored);
        // a kink of ü inside a step costs Boole's rule h⁴ of the jump of the jerk, 2e-14 of the energy here
        // at each of some hundred
        assert!(
            (input - stored - lost).abs() <= 1e-10 * largest,
            "{input} for {stored} and {lost} at {time} s"
        );
    }
    let peak = simulation.progress().state.peaks.largest() / wall.displacement_scale();
    assert!(peak > 0.1 && lost > 0.1 * largest, "the wall rocks and loses: {peak}, {lost}");
}

/// A parapet and a strip with equal dimensionless groups move alike (physics of the model: u/u_ins over
/// t √(k₀/m_eff) depends on a₁, a₃, d₁, softening, ξ, e and λ m_eff a_g/F₀ alone).
#[test]
fn equal_groups_move_alike() {
    let law = (0..3_i32, 0.005_f64..0.1, 0.85_f64..1.0, 0.5_f64..0.7, 0..3_i32);
    let damping = (1..DampingModel::ALL.len(), 0.0_f64..0.1, 0.7_f64..0.99, any::<bool>());
    let shape = (0.3_f64..20.0, 0.3_f64..20.0, 0.2_f64..0.8);
    mostly(COMPARED, (law, damping, shape, motions()), |(law, damping, shape, motion)| {
        let (law, a1, a3, d1, softening) = law;
        let (model, xi, e, impact) = damping;
        let (parapet_height, strip_height, hinge_ratio) = shape;
        let force_law = ForceLaw::ALL[usize::try_from(law).unwrap()];
        let model = DampingModel::ALL[model];
        let rigid = force_law == ForceLaw::RigidLinear;
        prop_assume!(model.ratio() != Some(Ratio::CBar));
        let damping_model = if rigid { DampingModel::None } else { model };
        let common = Parameters {
            force_law,
            a1,
            a3,
            d1,
            xi,
            damping_model,
            softening: Softening::ALL[usize::try_from(softening).unwrap()],
            impact: if impact { Impact::Restitution } else { Impact::None },
            restitution: e,
            tolerance: 1e-13,
            ..parapet()
        };
        let parapet =
            Parameters { height: parapet_height, thickness: 0.1 * parapet_height, ..common.clone() };
        let strip = Parameters {
            mechanism: Mechanism::VerticalSpanning,
            height: strip_height,
            thickness: 0.05 * strip_height * hinge_ratio,
            hinge_ratio,
            ..common
        };
        let one = normalised(&parapet, &motion, 1.0);
        let changed = normalised(&parapet, &motion, 1.0 + 1e-8);
        let other = normalised(&strip, &motion, 1.0);
        let standing = one
            .iter()
            .zip(&changed)
            .zip(&other)
            .take_while(|((a, b), c)| a.abs() <= 1.0 && b.abs() <= 1.0 && c.abs() <= 1.0)
            .count();
        let apart = |a: &[f64], b: &[f64]| {
            a.iter().zip(b).take(standing).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let amplification = 1.0 + apart(&one, &changed) / 1e-8;
        if amplification >= 1e5 {
            return Ok([0, one.len()]);
        }
        let allowed = 1e-11_f64.max(100.0 * f64::EPSILON * amplification);
        let difference = apart(&one, &other);
        prop_assert!(difference <= allowed, "differs by {difference:e}, allowed {allowed:e}");
        Ok([standing, one.len()])
    });
}

/// Returns u/u_ins under a piecewise linear motion, in units of F₀/m_eff and of the wall's own time scale.
fn normalised(parameters: &Parameters, motion: &[f64], factor: f64) -> Vec<f64> {
    let wall = Wall::new(parameters).unwrap();
    let onset = wall.body().strength.positive / wall.body().effective_mass;
    let step = 0.3 / wall.rocking_rate();
    let forcing: Vec<f64> = motion.iter().map(|p| factor * onset * p).collect();
    let (history, _) = alone(parameters, &forcing, step, 1.0);
    history.into_iter().map(|u| u / wall.displacement_scale()).collect()
}

/// Pins the work of the committed scenes: a change that costs more shows here first.
#[test]
fn work_of_the_scenes() {
    let expected = [
        ("plain_parapet", Work { pieces: 3085, corners: 85, impacts: 0 }),
        ("shaken_parapet", Work { pieces: 8046, corners: 46, impacts: 0 }),
        ("rigid_block", Work { pieces: 18139, corners: 448, impacts: 448 }),
        ("quadrilinear_strip", Work { pieces: 35644, corners: 44, impacts: 0 }),
        ("tied_facade", Work { pieces: 6242, corners: 571, impacts: 540 }),
        ("strip_between_floors", Work { pieces: 3000, corners: 0, impacts: 0 }),
    ];
    let scenes = crate::root().join("scenes");
    let work = |name: &str| {
        let scene = Scene::read(&scenes.join(name).with_extension("toml")).unwrap();
        Response::of(&scene).unwrap().summary.work
    };
    for (name, expected) in expected {
        assert_eq!(work(name), expected, "{name}");
    }
}

/// A Newmark step goes through ordinary corners: it is one piece, whatever branches it crosses.
#[test]
fn newmark_locates_no_ordinary_corner() {
    let free = Parameters { solver: Solver::Newmark, newmark_step: 0.01, u_start: 0.15, ..parapet() };
    let mut simulation = start(&free);
    for _ in 0..500 {
        simulation.advance(&still(0.01)).unwrap();
    }
    let Progress { state, work, .. } = *simulation.progress();
    assert!(state.peaks.negative > 0.04, "{state:?}");
    assert_eq!(work, Work { pieces: 500, corners: 0, impacts: 0 });
}

/// On the elastic branch the adaptive solver has the closed form, whatever its tolerance.
#[test]
fn the_adaptive_solver_takes_the_elastic_branch_exactly() {
    let by = |solver: Solver| {
        let elastic = Parameters { solver, tolerance: 1e-3, a1: 0.5, u_start: 0.05, ..parapet() };
        let mut simulation = start(&elastic);
        for n in 0..200 {
            let [from, to] = [n, n + 1].map(|n| Support::rigid(0.05 * libm::sin(0.1 * f64::from(n))));
            simulation.advance(&Segment { duration: 0.02, from, to }).unwrap();
        }
        *simulation.progress()
    };
    let exact = by(Solver::Exact);
    assert!(exact.state.peaks.negative > 0.0 && exact.work.corners == 0, "{exact:?}");
    assert_eq!(by(Solver::Adaptive), exact);
}

/// One step of five minutes is that of thousands, rocking freely from corner to corner, and on the elastic
/// branch under an acceleration that grows, where a piece ends after a period.
#[test]
fn a_long_step_is_that_of_many() {
    for (a1, u_start, most) in [(0.02, 0.5, 0.0), (0.5, 0.02, 0.2)] {
        let free = Parameters { damping_model: DampingModel::None, a1, u_start, ..parapet() };
        let slow = Parameters { height: 40.0, thickness: 2.0, ..free };
        let after = |steps: u32| {
            let at = |n: u32| Support::rigid(most * f64::from(n) / f64::from(steps));
            let mut simulation = Simulation::new(&slow, None, 0.0, at(0)).unwrap();
            for n in 0..steps {
                let duration = 300.0 / f64::from(steps);
                simulation.advance(&Segment { duration, from: at(n), to: at(n + 1) }).unwrap();
            }
            *simulation.progress()
        };
        let (one, many) = (after(1), after(3000));
        assert!(one.work.corners == many.work.corners && one.work.pieces > 20, "{one:?}");
        // thousands of roundings of u and of the time
        let apart = (one.state.displacement - many.state.displacement).abs();
        assert!(apart <= 1e-10, "{one:?} {many:?}");
    }
}
