//! Minimum of a scalar function.

use argmin::core::{CostFunction, Executor};
use argmin::solver::brent::BrentOpt;

use super::error::CalibrationError;

const MOST_ITERATIONS: u64 = 100;

/// A scalar function for the minimiser.
struct Cost<F>(F);

impl<F: Fn(f64) -> Result<f64, CalibrationError>> CostFunction for Cost<F> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, parameter: &f64) -> Result<f64, argmin::core::Error> {
        Ok((self.0)(*parameter)?)
    }
}

/// Finds the minimum of a function on an interval by Brent's method; returns its place and its value.
pub(super) fn minimum(
    function: impl Fn(f64) -> Result<f64, CalibrationError>,
    [low, high]: [f64; 2],
    tolerance: f64,
) -> Result<(f64, f64), CalibrationError> {
    let solver = BrentOpt::new(low, high).set_tolerance(tolerance, tolerance * (high - low));
    let executor = Executor::new(Cost(function), solver).timer(false);
    match executor.configure(|state| state.max_iters(MOST_ITERATIONS)).run() {
        Ok(result) => Ok((result.state.best_param.unwrap_or(f64::NAN), result.state.best_cost)),
        Err(error) => Err(error
            .downcast::<CalibrationError>()
            .unwrap_or_else(|error| CalibrationError::Minimiser(error.to_string()))),
    }
}
