//! ESM and ITACA records in the DYNA ASCII form (`.ASC`).
//!
//! 64 header lines `KEY: value`, then one sample a line:
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

use super::Unit;
use super::error::{Fault, excerpt};
use super::fields::{DAMAGED, Line, check_count, real};
use super::record::{Parsed, ReadOptions, check_stated_step, lines};

const HEADER_LINES: usize = 64;

/// The stated peak may be rounded, or that of samples with more digits.
const PEAK_TOLERANCE: f64 = 0.01;

/// Whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| line.starts_with("EVENT_NAME:"))
        || head.iter().any(|line| line.starts_with("SAMPLING_INTERVAL_S:"))
}

/// The header as keys and values with their lines.
struct Header<'a>(Vec<(usize, &'a str, &'a str)>);

impl<'a> Header<'a> {
    fn read(lines: &mut impl Iterator<Item = Line<'a>>) -> Result<Self, Fault> {
        let mut entries = Vec::with_capacity(HEADER_LINES);
        for (number, line) in lines.take(HEADER_LINES) {
            let Some((key, value)) = line.split_once(':') else {
                let expected = format!("{HEADER_LINES} header lines `KEY: value`, {} so far", entries.len());
                return Err(Fault::new(
                    number,
                    expected,
                    excerpt(line),
                    "check that this is an ESM or ITACA file",
                ));
            };
            entries.push((number, key.trim(), value.trim()));
        }
        let last_line = entries.last().map_or(1, |(number, ..)| *number);
        if entries.len() < HEADER_LINES {
            let expected = format!("{HEADER_LINES} header lines `KEY: value`");
            let found =
                if entries.is_empty() { "an empty file".to_owned() } else { entries.len().to_string() };
            return Err(Fault::new(
                last_line,
                expected,
                found,
                "check that this is a whole ESM or ITACA file",
            ));
        }
        Ok(Self(entries))
    }

    fn optional(&self, key: &str) -> Option<(usize, &'a str)> {
        let entry = self.0.iter().find(|(_, name, value)| *name == key && !value.is_empty());
        entry.map(|&(number, _, value)| (number, value))
    }

    fn get(&self, key: &str) -> Result<(usize, &'a str), Fault> {
        self.optional(key).ok_or_else(|| {
            let line = self.0.iter().find(|(_, name, _)| *name == key).map_or(HEADER_LINES, |entry| entry.0);
            Fault::new(line, format!("a value for {key}"), "none", "complete the header")
        })
    }

    fn number(&self, key: &str, is_sound: impl Fn(f64) -> bool) -> Result<(usize, f64), Fault> {
        let (line, value) = self.get(key)?;
        let number = real(value).filter(|value| value.is_finite() && is_sound(*value));
        number.map(|number| (line, number)).ok_or_else(|| {
            Fault::new(line, format!("{key} as a sound number"), excerpt(value), "correct the header")
        })
    }
}

/// Reads the text of an ESM or ITACA file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let mut rest = lines(text);
    let header = Header::read(&mut rest)?;
    let quantity =
        header.optional("DATA_TYPE").filter(|(_, value)| !value.eq_ignore_ascii_case("ACCELERATION"));
    if let Some((line, value)) = quantity {
        let remedy = "use the acceleration file of this record";
        return Err(Fault::new(line, "an acceleration record", excerpt(value), remedy));
    }
    let (step_line, step) = header.number("SAMPLING_INTERVAL_S", |step| step > 0.0)?;
    check_stated_step(options.step, step, step_line)?;
    let (count_line, count) = header.get("NDATA")?;
    let count = count.parse().map_err(|_| {
        Fault::new(count_line, "NDATA as a whole number", excerpt(count), "correct the header")
    })?;
    let (unit_line, unit) = header.get("UNITS")?;
    let unit = Unit::settled(unit, unit_line, options.unit)?;

    let mut samples = Vec::new();
    let mut last_line = header.0.last().map_or(1, |(number, ..)| *number);
    for (number, line) in rest {
        last_line = number;
        let value = real(line).map(|value| unit.to_si(value)).filter(|value| value.is_finite());
        samples.push(value.ok_or_else(|| Fault::new(number, "one finite number", excerpt(line), DAMAGED))?);
    }
    check_count(samples.len(), count, &format!("NDATA on line {count_line}"), last_line)?;
    let notes = ["EVENT_NAME", "EVENT_DATE_YYYYMMDD", "STATION_NAME", "STREAM"];
    let notes =
        notes.iter().filter_map(|key| header.optional(key)).map(|(_, value)| value.to_owned()).collect();
    let mut parsed = Parsed::new(step, samples, unit, last_line, notes);
    if header.optional("PGA_CM/S^2").is_some() {
        let (line, peak) = header.number("PGA_CM/S^2", |_| true)?;
        parsed.stated_peak = Some(Unit::CentimetrePerSecondSquared.to_si(peak.abs()));
        check_peak(&parsed, line)?;
    }
    Ok(parsed)
}

/// The samples must have the peak the header states: a wrong unit or a missing part shows here.
fn check_peak(parsed: &Parsed, line: usize) -> Result<(), Fault> {
    // Half a unit of the last of the six decimals the files have, in m/s².
    const ROUNDING: f64 = 0.5e-8;
    let peak = parsed.samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
    match parsed.stated_peak {
        Some(stated) if (peak - stated).abs() > PEAK_TOLERANCE * stated + ROUNDING => {
            let expected = format!("the peak of the samples, {:.6} cm/s2", peak * 100.0);
            let remedy = "the samples or their unit do not belong to this header: fetch the file again";
            Err(Fault::new(line, expected, format!("{:.6}", stated * 100.0), remedy))
        }
        _ => Ok(()),
    }
}
