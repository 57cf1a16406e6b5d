//! Formats that are known by name and not read, so that none of them is taken for another.

use crate::error::{Fault, UNEVEN};
use crate::fields::find;

/// Refuses a text in such a format.
pub(super) fn refuse(head: &[&str]) -> Result<(), Fault> {
    let has = |lines: usize, word: &str| head.iter().take(lines).any(|line| find(line, word).is_some());
    let csmnc = has(20, "EQUALLY SPACED INTERVALS OF") && (has(20, "OBSERVING POINT") || has(20, "COMP."));
    let by_hand = "this format is not read: write its samples one a line and state their step and unit (on \
                   the command line --record-step and --unit), or make a table, `t [s],a [cm/s2]`";
    let (found, remedy) = match () {
        () if csmnc => ("a record of CSMNC, China", by_hand),
        () if has(1, "SIMBAD") => ("a record of SIMBAD, Italy", by_hand),
        // its times are those at which the film was read
        () if has(1, "OF UNCORRECTED ACCELEROGRAM DATA OF") => ("volume 1 of USC or USGS", UNEVEN),
        () => return Ok(()),
    };
    Err(Fault::new(1, "a record in a format that is read", found, remedy))
}
