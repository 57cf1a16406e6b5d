//! COSMOS volume 2 records (`.V2`, `.V2c`).
//!
//! Lines of text, then headers and data that state their own counts and Fortran formats:
//!
//! ```text
//! Corrected acceleration    (Format v01.20 with 13 text lines)
//! …
//!  100 Integer-header values follow on  10 lines, Format= (10I8)
//!  100 Real-header values follow on  20 lines, Format= (5F15.6)
//!    6 Comment line(s) follow, each starting with a "|":
//!    42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)
//! End-of-data for Chan … acceleration
//! ```
//!
//! Real header 62 is the sample interval in ms, 64 the peak. A file may hold several channels.

use super::volume_2::{self, Channel, Dialect, REALS, Scale, in_heading};
use crate::error::Fault;
use crate::fields::{Numbered, after, find, leading_real};
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Places of the sample interval (ms) and the peak among the real headers, from 1.
const INTERVAL: usize = 62;
const PEAK: usize = 64;

/// The number that stands for an unknown value.
const UNKNOWN: f64 = -999.0;

/// Returns whether the first lines are those of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| find(line, "(FORMAT V").is_some())
        || head.iter().any(|line| find(line, REALS).is_some())
}

/// Reads every acceleration of a COSMOS file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let dialect = Dialect {
        is_heading: |line| find(line, " PTS,").is_some() && find(line, "FORMAT=").is_some(),
        acceleration: "ACCELERATION PTS",
        layout: None,
        scale,
        // `Sta Chan   1: 90 Deg (Rcrdr Chan  1) Location: …`
        name: |line| after(line, "STA CHAN")?.split('(').next(),
        closing: ["END-OF-DATA", "`End-of-data`"],
        needs_closing: false,
        data: [
            "acceleration data, `42000 acceleration pts, approx 210 secs, units=cm/sec2(04),Format=(1E15.6)`",
            "use the whole acceleration file of this record",
        ],
    };
    volume_2::parse(text, options, &dialect)
}

/// Takes the unit from the heading, and interval and peak from the real headers.
fn scale(
    channel: &Channel<'_>,
    heading: Numbered<'_>,
    count: usize,
    options: &RecordOptions,
) -> Result<Scale, Fault> {
    let (number, line) = heading;
    let word = after(line, "UNITS=").and_then(|text| text.split(['(', ',']).next());
    let word = word.ok_or_else(|| in_heading(heading, "a unit, `units=cm/sec2(04)`"))?;
    let unit = options.unit_of(word, number)?;
    let real = |place: usize| channel.reals.get(place - 1).copied().filter(|value| *value != UNKNOWN);
    let Some(interval) = real(INTERVAL).filter(|interval| *interval > 0.0) else {
        let expected = format!("the sample interval in ms as real header {INTERVAL}");
        return Err(Fault::missing(channel.reals_line.max(1), expected));
    };
    let step = interval / 1000.0;
    options.check_step(step, channel.reals_line)?;
    if let Some(approximate) = after(line, "APPROX").and_then(leading_real) {
        let duration = count as f64 * step;
        // The heading rounds to whole seconds, up or down.
        if (duration - approximate).abs() > 1.0 + 0.01 * approximate {
            let expected = format!(
                "about {duration} s, {count} points at the {interval} ms of real header {INTERVAL} \
                 after line {}",
                channel.reals_line
            );
            let remedy = "the headers disagree: fetch the file again";
            return Err(Fault::new(number, expected, format!("approx {approximate} s"), remedy));
        }
    }
    Ok(Scale { step, unit, peak: real(PEAK).map(|peak| unit.to_si(peak.abs())) })
}
