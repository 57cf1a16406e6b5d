//! The project's own solvers: over the whole record, several runs together, and step by step as in
//! co-simulation.

use record::{Forcing, RecordSolver, RunEnd, RunStart};
use rocking_wall::solver::{Method, Motion};
use rocking_wall::variables::{DampingModel, Solver};
use rocking_wall::wall::{ParameterError, Parameters, Support, Wall};

use crate::measure::Rows;
use crate::problem::{Problem, run, start, with_solver};

const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const SUBSTEPS: [u32; 4] = [1, 4, 16, 64];
/// Runs at once: the scene itself, then others with factors down to 0.65.
const BATCH: usize = 64;
/// Largest distance over `u_ins` at the end between a run of a batch and one by itself \[-\]: their roundings
/// differ, and walls amplify them up to 1e5 times here.
const AGREEMENT: f64 = 1e-9;

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
    over_record(problem, rows, setting, parameters, 1);
    over_record(problem, rows, &format!("{setting} {BATCH} at once"), parameters, BATCH);
    by_step(problem, rows, &format!("{setting} by step"), parameters);
}

/// Measures one run, or several together, of which the first is the scene. The time is that of one run, with
/// nothing recorded. The history is that of the scene alone; a batch must agree with it.
fn over_record(problem: &Problem, rows: &mut Rows, setting: &str, parameters: &Parameters, count: usize) {
    let motion = Wall::new(parameters).and_then(|wall| {
        let method = Method::new(parameters, &wall, parameters.tolerance)?;
        Ok(Motion::new(wall, method))
    });
    let length = problem.motion.samples().len();
    let record = |history: &mut Vec<f64>| {
        history.clear();
        history.resize(length, 0.0);
        let (solver, starts) = prepared(problem, motion.as_ref(), 1)?;
        let samples = Forcing::Samples(problem.motion.samples());
        let mut observe = |index: usize, u, _| history[index] = u;
        let outcome = solver.run_observed(starts[0], samples, RunEnd::OfRecord, &mut observe);
        outcome.map(|_| ()).map_err(|error| error.to_string())
    };
    let alone = || {
        let (solver, starts) = prepared(problem, motion.as_ref(), 1)?;
        let outcome = solver.run(starts[0], Forcing::Samples(problem.motion.samples()), RunEnd::OfRecord);
        std::hint::black_box(outcome.map_err(|error| error.to_string())?);
        Ok(())
    };
    let at_once = || {
        let (solver, starts) = prepared(problem, motion.as_ref(), count)?;
        let batch = solver.batch(Forcing::Samples(problem.motion.samples()));
        let outcomes = batch.run(&starts, RunEnd::OfRecord);
        outcomes.map_err(|error| error.to_string())
    };
    if count == 1 {
        rows.measure_many(problem, "rocking-wall", setting, 1, record, alone);
    } else {
        let checked = |history: &mut Vec<f64>| {
            record(history)?;
            let u = at_once()?[0].state.displacement;
            let apart = (u - history[length - 1]).abs() / problem.equation.u_ins;
            if apart <= AGREEMENT {
                Ok(())
            } else {
                Err(format!("ends {apart:e} u_ins from the run by itself"))
            }
        };
        rows.measure_many(problem, "rocking-wall", setting, count, checked, || {
            std::hint::black_box(at_once()?);
            Ok(())
        });
    }
}

/// The solver and the starts of so many runs, the first of them the scene.
fn prepared<'a>(
    problem: &Problem,
    motion: Result<&'a Motion, &ParameterError>,
    count: usize,
) -> Result<(RecordSolver<'a>, Vec<RunStart>), String> {
    let motion = motion.map_err(ToString::to_string)?;
    let participation = motion.wall().body().forcing(Support::rigid(1.0));
    let state = motion.start(0.0, 0.0, Support::default());
    let start = |run| RunStart { state, factor: participation * (1.0 - 0.35 * run as f64 / BATCH as f64) };
    Ok((RecordSolver::new(motion, problem.motion.step()), (0..count).map(start).collect()))
}

fn by_step(problem: &Problem, rows: &mut Rows, setting: &str, parameters: &Parameters) {
    let ready = start(parameters);
    rows.measure(problem, "rocking-wall", setting, |history| {
        let mut simulation = ready.clone().map_err(|error| error.to_string())?;
        run(&mut simulation, &problem.motion, history).map_err(|error| error.to_string())
    });
}
