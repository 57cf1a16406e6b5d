//! The project's own solvers.

use rocking_wall::variables::{DampingModel, Solver};

use crate::measure::Rows;
use crate::problem::{Problem, run, start, with_solver};

const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
const SUBSTEPS: [u32; 4] = [1, 4, 16, 64];

pub(crate) fn measure(problem: &Problem, rows: &mut Rows) {
    let step = problem.motion.step();
    if problem.parameters.damping_model == DampingModel::ConstantCoefficient {
        solver(problem, rows, "exact", Solver::Exact, 1e-9, step);
    }
    for tolerance in TOLERANCES {
        solver(problem, rows, &format!("adaptive {tolerance:.0e}"), Solver::Adaptive, tolerance, step);
    }
    for count in SUBSTEPS {
        let step = step / f64::from(count);
        solver(problem, rows, &format!("newmark {step:.3e} s"), Solver::Newmark, 1e-9, step);
    }
}

fn solver(problem: &Problem, rows: &mut Rows, setting: &str, solver: Solver, tolerance: f64, step: f64) {
    let parameters = with_solver(&problem.parameters, solver, tolerance, step);
    let ready = start(&parameters);
    rows.measure(problem, "rocking-wall", setting, |history| {
        let mut simulation = ready.clone().map_err(|error| error.to_string())?;
        run(&mut simulation, &problem.motion, history).map_err(|error| error.to_string())
    });
}
