//! How ties end: what one has stretched by stays where the wall leaves its supports while it yields, in every
//! path; a fracture is logged and ends a step.

use std::sync::{Arc, Mutex};

use fmu_export::{
    Category, Filter, Interface, Log, Model as _, ModelExchange as _, Status, Step, VariableId as _,
};
use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::{Method, Motion};
use rocking_wall::unit::Unit;
use rocking_wall::variables::{
    BooleanVariable, DampingModel, ForceLaw, RealVariable as V, Rocking, Solver, TieSide,
};
use rocking_wall::wall::{Parameters, Support, Wall};

use crate::yielding::by_hand;
use crate::yielding_unit::{YIELDS, initialized, scene};
use crate::{instantiated, start, still};

/// The wall of the example by hand on a side, whose weak tie it pulls along until it leaves its supports.
fn departing(side: f64) -> Parameters {
    let tie_side = if side > 0.0 { TieSide::Positive } else { TieSide::Negative };
    Parameters { tie_strength: 300.0, u_dot_start: 1.2 * side, tie_side, ..by_hand(1e3) }
}

/// p = ℓ (u_dep − u_y0), with ℓ = 2y/h, u_dep = h/4 and ℓ u_y0 = g₀ + N_y/K.
const STRETCHED: f64 = 5.2 / 3.0 * 0.75 - 0.02 - 300.0 / 2e5;

/// Walls that leave their supports on both sides, by every solver, and the error of p that theirs allows.
fn walls() -> Vec<(Parameters, f64)> {
    let mut walls = Vec::new();
    for side in [1.0, -1.0] {
        let wall = departing(side);
        let bilinear = Parameters { force_law: ForceLaw::Bilinear, ..wall.clone() };
        let secant = Parameters { damping_model: DampingModel::ConstantRatio, xi: 0.02, ..bilinear.clone() };
        let [positive, negative] = [Rocking::OneSidedPositive, Rocking::OneSidedNegative];
        let rocking = if side > 0.0 { positive } else { negative };
        let both = TieSide::Both;
        for parameters in [
            Parameters { tie_side: both, ..wall.clone() },
            Parameters { rocking, ..wall.clone() },
            Parameters { tie_side: both, rocking, ..wall.clone() },
            Parameters { solver: Solver::Adaptive, ..wall.clone() },
            Parameters { solver: Solver::Newmark, ..wall.clone() },
            // one step goes from the elastic tie to beyond the departure
            Parameters { solver: Solver::Newmark, newmark_step: 1.0, ..wall.clone() },
            Parameters { impact: rocking_wall::variables::Impact::None, ..secant },
            bilinear,
            wall,
        ] {
            walls.push((parameters, side));
        }
    }
    walls
}

#[track_caller]
fn assert_stretched([own, other]: [f64; 2], case: &str) {
    // the quotients and products of p round a few times
    assert!((own - STRETCHED).abs() <= 8.0 * f64::EPSILON && other == 0.0, "{case}: {own}, {other}");
}

/// In steps of any length, and in the demands on the tie: while it leaves, falls, and lies at the end.
#[test]
fn steps_and_demands_keep_the_elongation() {
    for (parameters, side) in walls() {
        for step in [1e-3, 0.05, 5.0] {
            let mut simulation = start(&parameters);
            let mut demands = simulation.demands(Support::default(), &[]);
            let (mut last, mut seen) = (0.0, 0);
            while simulation.progress().time < 5.0 {
                simulation.advance_watched(&still(step), &mut demands).unwrap();
                let outputs = simulation.outputs(Support::default());
                let [own, other] = [side, -side].map(|side| outputs.tie_elongation.of(side));
                assert!(own >= last, "{parameters:?}: {own} after {last}");
                last = own;
                if simulation.progress().state.departed {
                    assert_stretched([own, other], &format!("{parameters:?}"));
                    assert_eq!(outputs.tie_force, 0.0);
                    seen += 1;
                }
            }
            assert!(seen > 0 && simulation.progress().tie_break_time().is_none(), "{parameters:?}");
            let yielding = demands.ties[0].yielding.unwrap();
            assert_stretched([side, -side].map(|side| yielding.elongation.of(side)), "demands");
        }
    }
}

/// A tie that breaks before the departure, or at it, keeps the elongation at which it broke.
#[test]
fn a_tie_that_breaks_first_keeps_its_ultimate_elongation() {
    for side in [1.0, -1.0] {
        for tie_ultimate in [0.0, 0.1, STRETCHED - 1e-9] {
            let mut simulation = start(&Parameters { tie_ultimate, ..departing(side) });
            simulation.advance(&still(5.0)).unwrap();
            assert!(simulation.progress().state.departed && simulation.progress().tie_break_time().is_some());
            assert_eq!(simulation.outputs(Support::default()).tie_elongation.of(side), tie_ultimate);
        }
    }
}

/// Whole records keep it, run by the record path.
#[test]
fn records_keep_the_elongation() {
    for (parameters, side) in walls() {
        let wall = Wall::new(&parameters).unwrap();
        let motion =
            Motion::new(wall, Method::new(&parameters, &Wall::new(&parameters).unwrap(), 1e-8).unwrap());
        let state = motion.start_under(0.0, parameters.u_dot_start, 0.0);
        for (step, count) in [(1e-3, 4000), (0.05, 80)] {
            let solver = RecordSolver::new(&motion, step);
            let forcing = vec![0.0; count];
            let start = RunStart { state, factor: 1.0 };
            let outcome = solver.run(start, Forcing::Samples(&forcing), RunEnd::OfRecord).unwrap();
            assert!(outcome.state.departed, "{parameters:?}");
            let yielded = outcome.state.tie.yielded;
            let tie = motion.wall().ties().first().unwrap();
            assert_stretched([side, -side].map(|side| tie.elongation(yielded.of(side))), "record");
        }
    }
}

/// The FMU keeps it, in co-simulation and in Model Exchange, where the departure is met late or just so, and
/// wherever the solver has come from.
#[test]
fn the_unit_keeps_the_elongation() {
    let elongations = |unit: &Unit, side: f64| {
        let both = [V::TieElongation, V::TieElongationNegative].map(|variable| unit.real(variable));
        if side > 0.0 { both } else { [both[1], both[0]] }
    };
    for side in [1.0, -1.0] {
        for interface in [Interface::CoSimulation, Interface::ModelExchange] {
            let prepared = || {
                let mut unit = instantiated(interface, None, &mut Log::silent());
                for &variable in V::ALL {
                    if let Some(value) = departing(side).real(variable) {
                        unit.set_real(variable, value);
                    }
                }
                for &variable in rocking_wall::variables::IntegerVariable::ALL {
                    if let Some(value) = departing(side).integer(variable) {
                        unit.set_integer(variable, value);
                    }
                }
                unit.initialize(&mut Log::silent()).unwrap();
                unit
            };
            if interface == Interface::CoSimulation {
                let mut unit = prepared();
                unit.do_step(Step { from: 0.0, duration: 5.0, may_end_early: false }, &mut Log::silent())
                    .unwrap();
                assert_stretched(elongations(&unit, side), V::TieElongation.variable().name);
                continue;
            }
            for places in [&[0.02, 0.3, 0.75 + 1e-9][..], &[0.3, 0.9], &[0.76], &[0.7, 1.4], &[0.3, 1.6]] {
                let mut unit = prepared();
                unit.update(&mut Log::silent()).unwrap();
                for place in places {
                    unit.set_states(&[side * place, side * 0.5]);
                    unit.complete_step(&mut Log::silent()).unwrap();
                    unit.update(&mut Log::silent()).unwrap();
                }
                assert_stretched(elongations(&unit, side), &format!("{places:?}"));
                // and back, where an importer places the wall
                unit.set_states(&[side * 0.1, side * -0.5]);
                unit.complete_step(&mut Log::silent()).unwrap();
                unit.update(&mut Log::silent()).unwrap();
                assert_stretched(elongations(&unit, side), &format!("{places:?}, back"));
                assert_eq!(unit.real(V::TieForce), 0.0);
            }
        }
    }
}

/// The log names each fracture with its time. A step that may end early ends just after it, and no later one
/// ends for it again.
#[test]
fn fractures_are_logged_and_end_a_step() {
    for interface in [Interface::CoSimulation, Interface::ModelExchange] {
        let texts = Arc::new(Mutex::new(Vec::new()));
        let sink = texts.clone();
        let mut push = move |_: Status, _: Category, text: &str| sink.lock().unwrap().push(text.to_owned());
        let mut log = Log::new(&mut push, Filter::ERRORS.with(Category::Events));
        let mut unit = initialized(interface, &scene(0.0, 0.0, 0.4));
        if interface == Interface::ModelExchange {
            unit.update(&mut log).unwrap();
            unit.set_time(0.04);
            unit.set_states(&[YIELDS + 1e-6, 0.4]);
            unit.update(&mut log).unwrap();
        } else {
            let step = Step { from: 0.0, duration: 0.1, may_end_early: true };
            let end = unit.do_step(step, &mut log).unwrap().expect("an early end");
            // 0.1 ns, and a rounding of times
            assert!((end - unit.real(V::TieBreakTime) - 1e-10).abs() < 1e-15, "{end}");
            assert_eq!((unit.real(V::TieForce), unit.boolean(BooleanVariable::TieBroken)), (0.0, true));
            let rest = Step { from: end, duration: 0.1 - end, may_end_early: true };
            assert_eq!(unit.do_step(rest, &mut log).unwrap(), None);
        }
        let time = unit.real(V::TieBreakTime);
        assert!((0.03..0.08).contains(&time), "{time}");
        assert_eq!(*texts.lock().unwrap(), [format!("a tie broke at t = {time} s")]);
    }
}
