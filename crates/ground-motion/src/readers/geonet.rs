//! GeoNet records, New Zealand: raw (`.V1A`) and corrected (`.V2A`), in mm/s².
//!
//! For each of three components up to 16 lines of text, 40 integers (10I8), 60 reals (10F8), then the
//! accelerations in columns of eight characters that may touch. In corrected records as many velocities and
//! displacements follow:
//!
//! ```text
//! Corrected accelerogram 20180212_211554_WPWS_20 GNS Science
//! …
//! Component S16W  Longitudinal Accelerometer Axis
//! …
//!     2018       2      12      21      15     540       0       0    2018       2
//! …
//!      0.0    -0.0     0.0    -0.0     0.0    -0.0     0.0    -0.0     0.0    -0.0
//! ```
//!
//! Integer 31 is the number of raw samples, 34 that of the corrected ones, 35 and 36 those of velocities and
//! displacements. Real 26 is the step, 31 the raw peak, 36 the corrected one.

use std::iter::Peekable;

use super::one_by_one;
use crate::error::Fault;
use crate::fields::{Layout, Numbered, find, real, untrimmed_lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::vertical::is_vertical;

const LAYOUT: Layout = Layout { per_line: 10, width: 8 };
const TEXT_LINES: usize = 16;
const INTEGERS: usize = 40;
const REALS: usize = 60;

/// Returns whether the first line is that of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    let has = |line: &str, word: &str| find(line, word).is_some();
    head.first().is_some_and(|line| has(line, "CORRECTED ACCELEROGRAM") && has(line, "GNS SCIENCE"))
}

/// Reads the components of a GeoNet file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    one_by_one(untrimmed_lines(text).peekable(), |rest| component(rest, options))
}

/// Reads the next component.
fn component<'a>(
    rest: &mut Peekable<impl Iterator<Item = Numbered<'a>>>,
    options: &RecordOptions,
) -> Result<Parsed, Fault> {
    let (first, title) = rest.peek().copied().unwrap_or((1, ""));
    if !recognises(&[title]) {
        let expected = "the first line of a component, `Corrected accelerogram … GNS Science`";
        return Err(Fault::excerpt(first, expected, title.trim(), "check that this is a GeoNet file"));
    }
    let mut header: Vec<Numbered<'a>> = Vec::new();
    while let Some(line) = rest.next_if(|(_, line)| header.len() < TEXT_LINES && !is_numbers(line)) {
        header.push(line);
    }
    let last = header.last().map_or(first, |(number, _)| *number);
    let is_raw = find(title, "UNCORRECTED").is_some();
    let (integers, integers_end) = LAYOUT.numbers(rest, INTEGERS, last)?;
    let (reals, reals_end) = LAYOUT.numbers(rest, REALS, integers_end)?;
    let count = |place: usize| LAYOUT.count_among(&integers, place, last);
    let step = reals[25];
    if step <= 0.0 {
        let expected = "the step in s as real 26 of the header";
        return Err(Fault::new(integers_end + 3, expected, step.to_string(), "correct the header"));
    }
    options.check_step(step, integers_end + 3)?;
    let unit = options.unit_of("mm/s2", first)?;
    let mut parsed = Parsed::new(step, unit, reals_end);
    let samples = count(if is_raw { 31 } else { 34 })?;
    let (numbers, line) = LAYOUT.numbers(rest, samples, last + 4)?;
    parsed.samples = numbers.into_iter().map(|value| unit.to_si(value)).collect();
    parsed.last_line = line;
    for &place in if is_raw { &[][..] } else { &[35, 36] } {
        LAYOUT.numbers(rest, count(place)?, last + 4)?;
    }
    LAYOUT.check_ended(rest.peek().copied(), samples, last + 4)?;
    let name = header.iter().find_map(|(_, line)| line.trim_start().strip_prefix("Component"));
    let name = name.and_then(|name| name.split_whitespace().next()).unwrap_or_default();
    parsed.is_vertical = is_vertical(name);
    parsed.channel = Some(name.to_owned());
    let peak = reals[if is_raw { 30 } else { 35 }].abs();
    parsed.stated_peak = (peak > 0.0).then(|| unit.to_si(peak));
    parsed.keep_header(header.iter().map(|(_, line)| line.trim()));
    Ok(parsed)
}

/// Returns whether a line is a full one of the header's numbers.
fn is_numbers(line: &str) -> bool {
    LAYOUT.fields(line).count() == LAYOUT.per_line && LAYOUT.fields(line).all(|field| real(field).is_some())
}
