//! The crate `ode_solvers`: Dormand–Prince of order 5 and 8.
//!
//! It has no event handling, so the force's corners are left to its step control. A run is made in one go
//! with dense output at the samples, and once more restarted at each sample, where the slope of the forcing
//! jumps.
//!
//! Time is the third state: version 0.6.2 evaluates the twelfth stage of its order 8 at the start of the step
//! (c₁₂ = 0, not 1), which leaves order 1 of a forced motion, while a system that does not name the time
//! keeps its order.

use ode_solvers::{Dop853, Dopri5, OutputType, System, Vector3};

use crate::measure::Rows;
use crate::problem::{Equation, Problem};

const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];
/// Defaults of the crate, except the numbers of steps.
const SAFETY: f64 = 0.9;
const MOST_STEPS: u32 = 20_000_000;
/// The stiffness test is off: it rejects walls that the method can solve.
const STIFFNESS_TEST: u32 = u32::MAX;

struct Rocking<'a>(&'a Equation);

impl System<f64, Vector3<f64>> for Rocking<'_> {
    fn system(&self, _time: f64, state: &Vector3<f64>, rate: &mut Vector3<f64>) {
        rate[0] = state[1];
        rate[1] = self.0.acceleration(self.0.line_of(state[0]), state[2], state[0], state[1]);
        rate[2] = 1.0;
    }
}

/// Names a method of the crate: both have the same constructor, but no common trait.
macro_rules! integrate {
    (
        $method:ident, $beta:expr, $factors:expr, $equation:expr, $span:expr, $state:expr, $tolerance:expr,
        $output:expr
    ) => {{
        let ([from, to], absolute) = ($span, $tolerance * $equation.u_ins);
        let mut stepper = $method::from_param(
            Rocking($equation),
            from,
            to,
            $equation.step,
            $state,
            $tolerance,
            absolute,
            SAFETY,
            $beta,
            $factors[0],
            $factors[1],
            to - from,
            0.0,
            MOST_STEPS,
            STIFFNESS_TEST,
            $output,
        );
        stepper.integrate().map_err(|error| error.to_string())?;
        stepper.y_out().clone()
    }};
}

type Method = fn(&Equation, [f64; 2], Vector3<f64>, f64, OutputType) -> Result<Vec<Vector3<f64>>, String>;

fn dopri5(
    equation: &Equation,
    span: [f64; 2],
    state: Vector3<f64>,
    tolerance: f64,
    output: OutputType,
) -> Result<Vec<Vector3<f64>>, String> {
    Ok(integrate!(Dopri5, 0.04, [0.2, 10.0], equation, span, state, tolerance, output))
}

fn dop853(
    equation: &Equation,
    span: [f64; 2],
    state: Vector3<f64>,
    tolerance: f64,
    output: OutputType,
) -> Result<Vec<Vector3<f64>>, String> {
    Ok(integrate!(Dop853, 0.0, [0.333, 6.0], equation, span, state, tolerance, output))
}

pub(crate) fn measure(problem: &Problem, rows: &mut Rows) {
    let methods: [(&str, Method); 2] = [("dopri5", dopri5), ("dop853", dop853)];
    for (name, method) in methods {
        for tolerance in TOLERANCES {
            let setting = format!("{name} {tolerance:.0e}");
            rows.measure(problem, "ode_solvers", &setting, |history| {
                whole(&problem.equation, method, tolerance, history)
            });
            let setting = format!("{name} {tolerance:.0e} by sample");
            rows.measure(problem, "ode_solvers", &setting, |history| {
                by_sample(&problem.equation, method, tolerance, history)
            });
        }
    }
}

fn whole(equation: &Equation, method: Method, tolerance: f64, history: &mut Vec<f64>) -> Result<(), String> {
    let count = equation.forcing.len();
    // half a sample more: version 0.6.2 takes an output at the very end from an earlier step
    let end = (count as f64 - 0.5) * equation.step;
    let states = method(equation, [0.0, end], Vector3::zeros(), tolerance, OutputType::Dense)?;
    history.clear();
    history.extend(states.iter().take(count).map(|state| state[0]));
    if let Some(first) = history.first_mut() {
        // version 0.6.2 puts the end of its first step here
        *first = 0.0;
    }
    Ok(())
}

fn by_sample(
    equation: &Equation,
    method: Method,
    tolerance: f64,
    history: &mut Vec<f64>,
) -> Result<(), String> {
    let mut state = Vector3::zeros();
    history.clear();
    history.push(0.0);
    for index in 1..equation.forcing.len() {
        let span = [index - 1, index].map(|index| index as f64 * equation.step);
        state[2] = span[0];
        let states = method(equation, span, state, tolerance, OutputType::Sparse)?;
        state = *states.last().ok_or("no output")?;
        history.push(state[0]);
    }
    Ok(())
}
