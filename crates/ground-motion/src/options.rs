//! What the user states about a record file.

use serde::Deserialize;

use crate::error::Fault;
use crate::format::Format;
use crate::quantity::Quantity;
use crate::unit::Unit;

/// How to read a record file. Most formats need none of this.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(default)]
pub struct RecordOptions {
    /// Unit of the samples. Needed where the file does not state it; must not contradict a file that does.
    pub unit: Option<Unit>,
    /// Time between samples (s). Needed where the file does not state it; must not contradict a file that
    /// does.
    pub step: Option<f64>,
    /// Name of the column to read, for tables with several.
    pub column: Option<String>,
    /// Channel to read, by its number or its whole name; needed where a file has several.
    pub channel: Option<String>,
    /// Format of the file; found from its content if none is given.
    pub format: Option<Format>,
}

impl RecordOptions {
    /// Finds the unit of a file that writes `word` on `line`. Where the word is no unit, the unit that the
    /// user states counts; where it is one, of whatever quantity, the user's must not contradict it.
    pub(crate) fn unit_of(&self, word: &str, line: usize) -> Result<Unit, Fault> {
        match (Quantity::of(word), self.unit) {
            (Some(Quantity::Acceleration(unit)), Some(given)) if unit != given => {
                let expected = format!("the stated unit {given}");
                let remedy = "state no unit (leave out --unit): the file has its own";
                Err(Fault::new(line, expected, unit.name(), remedy))
            }
            (Some(Quantity::Acceleration(unit)), _) => Ok(unit),
            (Some(other), _) => Err(other.refused(word, line)),
            (None, Some(given)) => Ok(given),
            (None, None) => Err(Fault::excerpt(line, "a unit of acceleration", word, STATE_THE_UNIT)),
        }
    }

    /// Refuses a stated step that is not the file's own.
    pub(crate) fn check_step(&self, step: f64, line: usize) -> Result<(), Fault> {
        match self.step {
            Some(stated) if !is_close(stated, step) => {
                let expected = format!("the stated step of {stated} s");
                Err(Fault::new(line, expected, format!("{step} s"), "state no step: the file has its own"))
            }
            _ => Ok(()),
        }
    }
}

/// Returns whether two steps are the same. Either may be rounded in the fourth digit: 0.0029 for 1/350.
pub(crate) fn is_close(stated: f64, step: f64) -> bool {
    const TOLERANCE: f64 = 1e-3;
    (stated - step).abs() <= TOLERANCE * step
}

/// The remedy for a file whose unit is not known.
pub(crate) const STATE_THE_UNIT: &str =
    "state the unit as `unit` (on the command line --unit): m/s2, cm/s2, mm/s2 or g";

/// Makes the fault of numbers whose unit neither the file nor the user states.
pub(crate) fn no_unit(line: usize) -> Fault {
    let remedy = format!("{STATE_THE_UNIT}; or write it into a header line, `t [s],a [g]`");
    Fault::new(line, "a stated unit (this file has none)", "no unit", remedy)
}
