//! ESM and ITACA records in the DYNA ASCII form (`.ASC`).
//!
//! Header lines `KEY: value`, then one sample a line:
//!
//! ```text
//! EVENT_NAME: SOMEWHERE
//! …
//! SAMPLING_INTERVAL_S: 0.005000
//! NDATA: 19128
//! UNITS: cm/s^2
//! PGA_CM/S^2: -123.456789
//! DATA_TYPE: ACCELERATION
//! …
//! USER5:
//! 0.001234
//! ```
//!
//! ESM and ITACA have 64 header lines, ITACA before DYNA 1.2 has 55 or 43, AFAD of Türkiye 63, or a title
//! above.

use super::header::{count, step, value};
use crate::error::{DAMAGED, Fault};
use crate::fields::{Numbered, check_count, lines, real, rounding};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;

/// Most lines of a header, and of the titles above it.
const HEADER_LINES: usize = 80;
const TITLE_LINES: usize = 3;

/// Returns whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.iter().take(1 + TITLE_LINES).any(|line| line.starts_with("EVENT_NAME:"))
        || head.iter().any(|line| line.starts_with("SAMPLING_INTERVAL_S:"))
}

/// Returns whether a line above the header is neither part of it nor a sample.
fn is_title(line: &str) -> bool {
    !line.contains(':') && real(line).is_none()
}

/// Reads the text of an ESM or ITACA file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let mut rest = lines(text).peekable();
    let mut titles = 0;
    while rest.next_if(|(_, line)| titles < TITLE_LINES && is_title(line)).is_some() {
        titles += 1;
    }
    let mut header: Vec<Numbered<'_>> = Vec::new();
    while let Some(line) = rest.next_if(|(_, line)| header.len() < HEADER_LINES && line.contains(':')) {
        header.push(line);
    }
    if header.is_empty() {
        let (line, found) = rest.peek().copied().or(lines(text).last()).unwrap_or_default();
        let remedy = "check that this is an ESM or ITACA file";
        return Err(Fault::excerpt(line, "header lines `KEY: value`", found, remedy));
    }
    let optional = |key: &str| value(&header, key).ok();
    // before DYNA 1.0: `UNPROCESSED ACCELERATION`
    let is_acceleration = |value: &str| {
        let quantity = value.rsplit_once("PROCESSED ").map_or(value, |(_, quantity)| quantity);
        quantity.eq_ignore_ascii_case("ACCELERATION")
    };
    let quantity = optional("DATA_TYPE").filter(|(_, value)| !is_acceleration(value));
    if let Some((line, value)) = quantity {
        let remedy = "use the acceleration file of this record";
        return Err(Fault::excerpt(line, "an acceleration record", value, remedy));
    }
    let step = step(&header, "SAMPLING_INTERVAL_S", |step| step, options)?;
    let (count_line, count) = count(&header, "NDATA")?;
    let (unit_line, unit) = value(&header, "UNITS")?;
    let unit = options.unit_of(unit, unit_line)?;

    let mut parsed = Parsed::new(step, unit, header.last().map_or(1, |(number, _)| *number));
    for (number, line) in rest {
        parsed.push(real(line), number, || Fault::no_number(number, "one finite number", line, DAMAGED))?;
    }
    check_count(parsed.samples.len(), count, &format!("NDATA on line {count_line}"), parsed.last_line)?;
    // the last letter of a stream is its direction, HNZ; before DYNA 1.0 it is a component, UP
    let stream = optional("STREAM").is_some_and(|(_, stream)| stream.ends_with(['Z', 'z']));
    parsed.is_vertical = stream || optional("COMPONENT").is_some_and(|(_, component)| is_vertical(component));
    let described = ["EVENT_NAME", "EVENT_DATE_YYYYMMDD", "STATION_NAME", "STREAM", "COMPONENT"];
    parsed.keep_header(described.iter().filter_map(|key| Some(optional(key)?.1)));
    if let Some((line, text)) = optional("PGA_CM/S^2") {
        let peak = real(text).filter(|peak| peak.is_finite());
        let peak = peak.ok_or_else(|| Fault::in_header(line, "a number for `PGA_CM/S^2`", text))?;
        let unit = Unit::CentimetrePerSecondSquared;
        (parsed.stated_peak, parsed.peak_rounding) =
            (Some(unit.to_si(peak.abs())), unit.to_si(rounding(text)));
    }
    Ok(vec![parsed])
}
