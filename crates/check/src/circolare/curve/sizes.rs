//! Sizes that no wall and no bar has.

use rocking_wall::wall::{Parameters, Warning};

use crate::error::CheckError;

/// The largest sizes that a check takes \[m\].
const LARGEST: [(&str, f64); 4] =
    [("height", 100.0), ("thickness", 10.0), ("bar_diameter", 0.2), ("bar_length", 200.0)];

/// # Errors
/// [`CheckError::Wall`] of the first size that is impossible, with the unit in which it may be meant.
pub(super) fn check(parameters: &Parameters) -> Result<(), CheckError> {
    for warning in parameters.unusual() {
        let Warning::Unusual { name, value, meant, .. } = warning else { continue };
        let limit = LARGEST.iter().find(|(own, largest)| *own == name && value > *largest);
        if let Some((_, largest)) = limit {
            let meant =
                meant.map_or_else(String::new, |(unit, own)| format!("; if it is {unit}, give {own} m"));
            let message =
                format!("{name} = {value} m is impossible: a check takes {largest} m at most{meant}");
            return Err(CheckError::wall(message));
        }
    }
    Ok(())
}
