//! The project's own solvers, over the record in one go, several runs at once, and step by step as a co-simulation does.

use rocking_wall::solver::record::{RecordSolver, Scaled};
use rocking_wall::solver::{Method, Motion};
use rocking_wall::variables::{DampingModel, Solver};
use rocking_wall::wall::{ParameterError, Parameters, Support, Wall};

use crate::measure::Rows;
use crate::problem::{Problem, run, start, with_solver};

const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const SUBSTEPS: [u32; 4] = [1, 4, 16, 64];
/// Runs at once: the scene itself, then seven with smaller factors.
const LANES: usize = 8;

pub(crate) fn measure(problem: &Problem, rows: &mut Rows) {
    let step = problem.motion.step();
    let with = |solver, tolerance, step| with_solver(&problem.parameters, solver, tolerance, step);
    if problem.parameters.damping_model == DampingModel::ConstantCoefficient {
        both_ways(problem, rows, "exact", &with(Solver::Exact, 1e-9, step));
    }
    for tolerance in TOLERANCES {
        both_ways(
            problem,
            rows,
            &format!("adaptive {tolerance:.0e}"),
            &with(Solver::Adaptive, tolerance, step),
        );
    }
    for count in SUBSTEPS {
        let step = step / f64::from(count);
        by_step(problem, rows, &format!("newmark {step:.3e} s"), &with(Solver::Newmark, 1e-9, step));
    }
}

fn both_ways(problem: &Problem, rows: &mut Rows, setting: &str, parameters: &Parameters) {
    over_record::<1>(problem, rows, setting, parameters);
    over_record::<LANES>(problem, rows, &format!("{setting} {LANES} at once"), parameters);
    by_step(problem, rows, &format!("{setting} by step"), parameters);
}

/// `N` runs at once; the history is that of the first, which is the scene, and the time is that of one run without it.
fn over_record<const N: usize>(problem: &Problem, rows: &mut Rows, setting: &str, parameters: &Parameters) {
    let motion = Wall::new(parameters).and_then(|wall| {
        let method = Method::new(parameters, &wall, parameters.tolerance)?;
        Ok(Motion::new(wall, method))
    });
    let length = problem.motion.samples().len();
    let record = |history: &mut Vec<f64>| {
        history.clear();
        history.resize(length, 0.0);
        follow::<N>(problem, motion.as_ref(), |index, u| history[index] = u)
    };
    rows.measure_many(problem, "rocking-wall", setting, N, record, || {
        follow::<N>(problem, motion.as_ref(), |_, _| {})
    });
}

/// Makes `N` runs; `observe` is shown the samples of the first.
fn follow<const N: usize>(
    problem: &Problem,
    motion: Result<&Motion, &ParameterError>,
    mut observe: impl FnMut(usize, f64),
) -> Result<(), String> {
    let motion = motion.map_err(ToString::to_string)?;
    let participation = motion.wall().body().forcing(Support::rigid(1.0));
    let factors = std::array::from_fn(|lane| participation * (1.0 - 0.05 * lane as f64));
    let forcing = Scaled::<N>::new(problem.motion.samples(), factors);
    let states = [motion.start(0.0, 0.0, Support::default()); N];
    let passages = RecordSolver::new(motion, problem.motion.step())
        .run(states, &forcing, false, |index, u, _| observe(index, u[0]))
        .map_err(|error| error.to_string())?;
    std::hint::black_box(passages);
    Ok(())
}

fn by_step(problem: &Problem, rows: &mut Rows, setting: &str, parameters: &Parameters) {
    let ready = start(parameters);
    rows.measure(problem, "rocking-wall", setting, |history| {
        let mut simulation = ready.clone().map_err(|error| error.to_string())?;
        run(&mut simulation, &problem.motion, history).map_err(|error| error.to_string())
    });
}
