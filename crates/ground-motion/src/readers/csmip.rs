//! CSMIP and CDMG volume 2 records (`.V2`).
//!
//! For each channel 25 lines of text, 100 integers, 100 reals, then acceleration, velocity and displacement
//! in columns of ten characters that may touch, and a closing line:
//!
//! ```text
//! Corrected accelerogram   …
//! Chan  1: 360 Deg
//! Peak acceleration =    77.280    cm/sec/sec  at   30.585   sec.
//!  12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)
//!   -.000010  -.000009  -.000010  -.000009  -.000008  -.000008  -.000007  -.000010
//!  12000 points of veloc data equally spaced at  .005 sec, in cm/sec.  (8f10.7)
//! /&  ----------  End of data for channel  1  ----------
//! ```
//!
//! The headings state all that is needed, so the integers and reals are skipped. Velocity and displacement
//! are read only to check that they are complete.

use super::volume_2::{self, Channel, Dialect, Scale, in_heading};
use crate::error::Fault;
use crate::fields::{Layout, Numbered, after, find, leading_number, positive, unit_word};
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Returns whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| find(line, "CORRECTED ACCELEROGRAM").is_some())
        || head.iter().any(|line| is_heading(line))
}

fn is_heading(line: &str) -> bool {
    ["POINTS OF", "EQUALLY SPACED", " DATA "].iter().all(|words| find(line, words).is_some())
}

/// Reads every channel of a CSMIP file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let dialect = Dialect {
        is_heading,
        acceleration: "ACCEL",
        // Old files state no format; their numbers have this one.
        layout: Some(Layout { per_line: 8, width: 10 }),
        scale,
        name: |line| after(line, "CHAN").filter(|_| find(line, "CHAN") == Some(0)),
        closing: ["/&", "`/& End of data for channel`"],
        needs_closing: true,
        data: [
            "a heading `12000 points of accel data equally spaced at .005 sec, in cm/sec2. (8f10.6)`",
            "use the corrected data (volume 2) of this record",
        ],
    };
    volume_2::parse(text, options, &dialect)
}

/// Takes step and unit from the heading, and the peak from the text before it.
fn scale(
    channel: &Channel<'_>,
    heading: Numbered<'_>,
    _count: usize,
    options: &RecordOptions,
) -> Result<Scale, Fault> {
    let (number, line) = heading;
    let step = after(line, "SPACED AT").and_then(|text| positive(leading_number(text).0));
    let step = step.ok_or_else(|| in_heading(heading, "a step in sec"))?;
    options.check_step(step, number)?;
    let listed = || after(line, ", IN ")?.split_ascii_whitespace().next().map(str::to_owned);
    let word = unit_word(line).or_else(listed);
    let word = word.ok_or_else(|| in_heading(heading, "a unit, `in cm/sec2`"))?;
    let unit = options.unit_of(word.trim_end_matches(['.', ',', ')']), number)?;
    Ok(Scale { step, unit, peak: channel.peak })
}
