//! Numbers that are given, or left to be computed from the geometry.

use super::error::ParameterError;
use super::ratio::Ratio;

/// Returns whether a parameter is computed from the geometry where it is not given: e, and ratios of damping.
pub fn is_computable(name: &str) -> bool {
    name == "restitution" || Ratio::ALL.iter().any(|ratio| ratio.name() == name)
}

/// Value of such a parameter that asks for the computed number.
pub const COMPUTED: f64 = -1.0;

/// Returns the number that is given; `None` for one to be computed.
///
/// # Errors
/// [`ParameterError::NotGiven`] for a negative number other than [`COMPUTED`].
pub(super) fn given(name: &'static str, value: f64) -> Result<Option<f64>, ParameterError> {
    match value {
        COMPUTED => Ok(None),
        0.0.. => Ok(Some(value)),
        _ => Err(ParameterError::NotGiven { name, value }),
    }
}
