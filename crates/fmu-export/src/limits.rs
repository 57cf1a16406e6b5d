//! Which values a variable may have.

use crate::failure::Failure;
use crate::variable::{Causality, Item, Kind, Variable};

/// The smallest size of a parameter that is not 0: products and quotients of smaller ones underflow to 0, or
/// overflow.
const SMALLEST: f64 = 1e-100;

/// Returns `value` if it is finite.
pub(crate) fn finite(variable: &Variable, value: f64) -> Result<f64, Failure> {
    if value.is_finite() { Ok(value) } else { Err(not_finite(variable, value)) }
}

#[cold]
fn not_finite(variable: &Variable, value: f64) -> Failure {
    Failure(format!("{} = {value:?} is not a finite number", variable.name))
}

/// Checks that `value` is finite and within the limits of `variable`. A parameter is 0, or not closer to 0
/// than 1e-100 in its unit.
///
/// # Errors
/// [`Failure`] with the name, the value and the limit.
pub fn check_real(variable: &Variable, value: f64) -> Result<(), Failure> {
    finite(variable, value)?;
    match variable.kind {
        Kind::Real { min: Some(min), .. } if value < min => {
            Err(beyond(variable, value, "below its minimum", min))
        }
        Kind::Real { max: Some(max), .. } if value > max => {
            Err(beyond(variable, value, "above its maximum", max))
        }
        _ if variable.causality == Causality::Parameter && value != 0.0 && value.abs() < SMALLEST => {
            Err(beyond(variable, value, "not 0, but closer to it than the smallest size", SMALLEST))
        }
        _ => Ok(()),
    }
}

/// Returns `value` if it is within the limits of `variable`, or one of its items.
pub(crate) fn check_integer(variable: &Variable, value: i64) -> Result<i32, Failure> {
    match (variable.kind, i32::try_from(value)) {
        (Kind::Integer { min: Some(min), .. }, _) if value < i64::from(min) => {
            Err(beyond(variable, value, "below its minimum", min.into()))
        }
        (Kind::Integer { max: Some(max), .. }, _) if value > i64::from(max) => {
            Err(beyond(variable, value, "above its maximum", max.into()))
        }
        (Kind::Enumeration { items, .. }, _) if items.iter().all(|item| i64::from(item.value) != value) => {
            Err(no_item(variable, value, items))
        }
        (_, Ok(value)) => Ok(value),
        (_, Err(_)) => Err(Failure(format!("{} = {value} needs more than 32 bits", variable.name))),
    }
}

// Debug, because Display spells 1e300 out.
#[cold]
fn beyond<T: std::fmt::Debug>(variable: &Variable, value: T, beyond: &str, limit: T) -> Failure {
    let unit = match variable.unit {
        None | Some("1") => String::new(),
        Some(unit) => format!(" {unit}"),
    };
    Failure(format!("{} = {value:?}{unit} is {beyond}, {limit:?}{unit}", variable.name))
}

#[cold]
fn no_item(variable: &Variable, value: i64, items: &[Item]) -> Failure {
    let items: Vec<_> = items.iter().map(|item| format!("{} = {}", item.name, item.value)).collect();
    Failure(format!("{} = {value} is not one of its items: {}", variable.name, items.join(", ")))
}
