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

use std::iter::Peekable;

use crate::error::{Fault, excerpt};
use crate::fields::{Line, lines, real};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;

/// Most lines of a header, and of the titles above it.
const HEADER_LINES: usize = 80;
const TITLE_LINES: usize = 3;

/// Tolerance of the stated peak, which may be rounded or come from samples with more digits.
const PEAK_TOLERANCE: f64 = 0.01;

/// Returns whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.iter().take(1 + TITLE_LINES).any(|line| line.starts_with("EVENT_NAME:"))
        || head.iter().any(|line| line.starts_with("SAMPLING_INTERVAL_S:"))
}

/// The header: lines, keys and values.
struct Header<'a>(Vec<(usize, &'a str, &'a str)>);

impl<'a> Header<'a> {
    /// Reads the lines `KEY: value` that precede the samples, below a title if there is one.
    fn read(lines: &mut Peekable<impl Iterator<Item = Line<'a>>>) -> Result<Self, Fault> {
        let mut entries = Vec::new();
        let mut titles = 0;
        while let Some(&(number, line)) = lines.peek() {
            match line.split_once(':') {
                Some((key, value)) if entries.len() < HEADER_LINES => {
                    entries.push((number, key.trim(), value.trim()));
                }
                None if entries.is_empty() && titles < TITLE_LINES && real(line).is_none() => titles += 1,
                _ => break,
            }
            lines.next();
        }
        if entries.is_empty() {
            let (line, found) = match lines.peek() {
                Some(&(number, line)) => (number, excerpt(line)),
                None => (1, "none up to the end".to_owned()),
            };
            let remedy = "check that this is an ESM or ITACA file";
            return Err(Fault::new(line, "header lines `KEY: value`", found, remedy));
        }
        Ok(Self(entries))
    }

    fn optional(&self, key: &str) -> Option<(usize, &'a str)> {
        let entry = self.0.iter().find(|(_, name, value)| *name == key && !value.is_empty());
        entry.map(|&(number, _, value)| (number, value))
    }

    fn get(&self, key: &str) -> Result<(usize, &'a str), Fault> {
        self.optional(key).ok_or_else(|| {
            let last = self.0.last().map_or(1, |entry| entry.0);
            let line = self.0.iter().find(|(_, name, _)| *name == key).map_or(last, |entry| entry.0);
            Fault::new(line, format!("a value for {key}"), "none", "complete the header")
        })
    }

    fn number(&self, key: &str, is_sound: impl Fn(f64) -> bool) -> Result<(usize, f64), Fault> {
        let (line, value) = self.get(key)?;
        let number = real(value).filter(|value| value.is_finite() && is_sound(*value));
        number.map(|number| (line, number)).ok_or_else(|| {
            Fault::excerpt(line, format!("{key} as a sound number"), value, "correct the header")
        })
    }
}

/// Reads the text of an ESM or ITACA file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Parsed, Fault> {
    let mut rest = lines(text).peekable();
    let header = Header::read(&mut rest)?;
    // before DYNA 1.0: `UNPROCESSED ACCELERATION`
    let is_acceleration = |value: &str| {
        let quantity = value.rsplit_once("PROCESSED ").map_or(value, |(_, quantity)| quantity);
        quantity.eq_ignore_ascii_case("ACCELERATION")
    };
    let quantity = header.optional("DATA_TYPE").filter(|(_, value)| !is_acceleration(value));
    if let Some((line, value)) = quantity {
        let remedy = "use the acceleration file of this record";
        return Err(Fault::excerpt(line, "an acceleration record", value, remedy));
    }
    let (step_line, step) = header.number("SAMPLING_INTERVAL_S", |step| step > 0.0)?;
    options.check_step(step, step_line)?;
    let (count_line, count) = header.get("NDATA")?;
    let count = count
        .parse()
        .map_err(|_| Fault::excerpt(count_line, "NDATA as a whole number", count, "correct the header"))?;
    let (unit_line, unit) = header.get("UNITS")?;
    let unit = options.unit_of(unit, unit_line)?;

    let mut parsed = Parsed::new(step, unit, header.0.last().map_or(1, |(number, ..)| *number));
    for (number, line) in rest {
        parsed.push(real(line), number, line, "one finite number")?;
    }
    parsed.check_count(count, &format!("NDATA on line {count_line}"))?;
    // the last letter of a stream is its direction, HNZ; before DYNA 1.0 it is a component, UP
    let stream = header.optional("STREAM").is_some_and(|(_, stream)| stream.ends_with(['Z', 'z']));
    parsed.is_vertical =
        stream || header.optional("COMPONENT").is_some_and(|(_, component)| is_vertical(component));
    let described = ["EVENT_NAME", "EVENT_DATE_YYYYMMDD", "STATION_NAME", "STREAM", "COMPONENT"];
    parsed.keep_header(described.iter().filter_map(|key| Some(header.optional(key)?.1)));
    if header.optional("PGA_CM/S^2").is_some() {
        let (line, peak) = header.number("PGA_CM/S^2", |_| true)?;
        let stated = Unit::CentimetrePerSecondSquared.to_si(peak.abs());
        parsed.stated_peak = Some(stated);
        check_peak(&parsed.samples, stated, line)?;
    }
    Ok(parsed)
}

/// Refuses samples without the peak that the header states: a wrong unit or a missing part shows here.
fn check_peak(samples: &[f64], stated: f64, line: usize) -> Result<(), Fault> {
    // Half a unit of the last of the six decimals the files have, in m/s².
    const ROUNDING: f64 = 0.5e-8;
    let peak = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
    if (peak - stated).abs() <= PEAK_TOLERANCE * stated + ROUNDING {
        return Ok(());
    }
    let expected = format!("the peak of the samples, {:.6} cm/s2", peak * 100.0);
    let remedy = "the samples or their unit do not belong to this header: fetch the file again";
    Err(Fault::new(line, expected, format!("{:.6}", stated * 100.0), remedy))
}
