//! The crate `diffsol`: Tsitouras 5(4), TR-BDF2 and BDF, with its root finding at the force's corners.
//!
//! The right-hand side stays on its line until a root ends it, as the crate's manual recommends, so that each
//! step is smooth.

use std::cell::Cell;

use diffsol::{
    NalgebraLU, NalgebraMat, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverStopReason, Vector,
};

use crate::measure::Rows;
use crate::problem::{Equation, Problem};

const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];
/// Steps of one run, and corners among them.
const MOST_STEPS: usize = 5_000_000;

/// Part of a sample within which two times are the same.
const SAME_TIME: f64 = 1e-9;

type Matrix = NalgebraMat<f64>;
type Linear = NalgebraLU<f64>;

#[derive(Clone, Copy)]
enum Method {
    Tsit45,
    TrBdf2,
    Bdf,
}

/// What the steps stop at besides corners.
#[derive(Clone, Copy, PartialEq)]
enum Stops {
    /// Nothing: samples are interpolated.
    None,
    /// Each sample, where the slope of the forcing jumps.
    Samples,
}

pub(crate) fn measure(problem: &Problem, rows: &mut Rows) {
    let methods = [("tsit45", Method::Tsit45), ("tr_bdf2", Method::TrBdf2), ("bdf", Method::Bdf)];
    for (name, method) in methods {
        // implicit methods are slowest at the last one, which is stricter than the comparison asks for
        let settings = if matches!(method, Method::Tsit45) { &TOLERANCES[..] } else { &TOLERANCES[..3] };
        for &tolerance in settings {
            for (words, stops) in [("", Stops::None), (" by sample", Stops::Samples)] {
                if stops == Stops::Samples && !matches!(method, Method::Tsit45) {
                    // an implicit method does not benefit from it and keeps its own steps
                    continue;
                }
                let setting = format!("{name} {tolerance:.0e}{words}");
                rows.measure(problem, "diffsol", &setting, |history| {
                    solve(&problem.equation, method, tolerance, stops, history)
                });
            }
        }
    }
}

fn solve(
    equation: &Equation,
    method: Method,
    tolerance: f64,
    stops: Stops,
    history: &mut Vec<f64>,
) -> Result<(), String> {
    let line = Cell::new(equation.line_of(0.0));
    let words = |error: diffsol::error::DiffsolError| error.to_string();
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol([tolerance * equation.u_ins, tolerance * equation.u_ins])
        .h0(equation.step)
        .rhs_implicit(
            |x: &[f64], _p: &[f64], t: f64, y: &mut [f64]| {
                y[0] = x[1];
                y[1] = equation.acceleration(line.get(), t, x[0], x[1]);
            },
            |x: &[f64], _p: &[f64], _t: f64, v: &[f64], y: &mut [f64]| {
                let [by_u, by_v] = equation.jacobian(line.get(), x[0], x[1]);
                y[0] = v[1];
                y[1] = by_u * v[0] + by_v * v[1];
            },
        )
        .init(|_p: &[f64], _t: f64, y: &mut [f64]| y.fill(0.0), 2)
        .root(
            |x: &[f64], _p: &[f64], _t: f64, g: &mut [f64]| {
                // distances to the ends of the line; an outer line has one
                let (index, last) = (line.get(), equation.corners.len());
                g[0] = if index > 0 { x[0] - equation.corners[index - 1] } else { 1.0 };
                g[1] = if index < last { equation.corners[index] - x[0] } else { 1.0 };
            },
            2,
        )
        .build()
        .map_err(words)?;
    // the default is 50 in a run, and each corner may cost one
    problem.ode_options.max_nonlinear_solver_failures = MOST_STEPS;
    match method {
        Method::Tsit45 => follow(problem.tsit45().map_err(words)?, equation, &line, stops, history),
        Method::TrBdf2 => {
            follow(problem.tr_bdf2::<Linear>().map_err(words)?, equation, &line, stops, history)
        }
        Method::Bdf => follow(problem.bdf::<Linear>().map_err(words)?, equation, &line, stops, history),
    }
}

fn follow<'a, Eqn, S>(
    mut solver: S,
    equation: &Equation,
    line: &Cell<usize>,
    stops: Stops,
    history: &mut Vec<f64>,
) -> Result<(), String>
where
    Eqn: OdeEquations<T = f64> + 'a,
    Eqn::V: Vector<T = f64>,
    S: OdeSolverMethod<'a, Eqn>,
{
    let words = |error: diffsol::error::DiffsolError| error.to_string();
    let count = equation.forcing.len();
    let time_of = |index: usize| index as f64 * equation.step;
    history.clear();
    history.push(0.0);
    let mut state = solver.interpolate(0.0).map_err(words)?;
    let mut aim = if stops == Stops::Samples { 1 } else { count - 1 };
    solver.set_stop_time(time_of(aim)).map_err(words)?;
    for _ in 0..MOST_STEPS {
        let reason = solver.step().map_err(words)?;
        let until = match reason {
            OdeSolverStopReason::RootFound(time, _) => time,
            _ => solver.state().t,
        };
        while history.len() < count && time_of(history.len()) <= until {
            solver.interpolate_inplace(time_of(history.len()), &mut state).map_err(words)?;
            history.push(state.get_index(0));
        }
        if let OdeSolverStopReason::RootFound(time, side) = reason {
            solver.state_mut_back(time).map_err(words)?;
            cross(&mut solver, equation, line, side);
            // a corner within a rounding of the stop is at the stop
            if time_of(aim) - time <= SAME_TIME * equation.step && history.len() == aim {
                history.push(solver.state().y.get_index(0));
            }
        }
        if history.len() == count {
            return Ok(());
        }
        if reason != OdeSolverStopReason::InternalTimestep {
            if stops == Stops::Samples {
                aim = history.len();
            }
            solver.set_stop_time(time_of(aim)).map_err(words)?;
        }
    }
    Err(format!("gave up after {MOST_STEPS} steps"))
}

/// Changes to the neighbouring line and moves the state by one rounding into it, where its root function has
/// a sign.
fn cross<'a, Eqn, S>(solver: &mut S, equation: &Equation, line: &Cell<usize>, side: usize)
where
    Eqn: OdeEquations<T = f64> + 'a,
    Eqn::V: Vector<T = f64>,
    S: OdeSolverMethod<'a, Eqn>,
{
    let index = line.get();
    let (corner, direction) =
        if side == 0 { (equation.corners[index - 1], -1.0) } else { (equation.corners[index], 1.0) };
    line.set(if side == 0 { index - 1 } else { index + 1 });
    solver.state_mut().y.set_index(0, corner + direction * 4.0 * f64::EPSILON * corner.abs());
}
