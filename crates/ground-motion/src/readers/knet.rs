//! K-NET and KiK-net records (`.EW`, `.NS`, `.UD`, `.EW1` …).
//!
//! 17 header lines whose labels fill 18 characters, then counts of the recorder, eight a line:
//!
//! ```text
//! Origin Time       2000/01/01 00:00:00
//! …
//! Sampling Freq(Hz) 100Hz
//! Duration Time(s)  60
//! Dir.              E-W
//! Scale Factor      3920(gal)/6182761
//! Max. Acc. (gal)   12.345
//! Last Correction   2000/01/01 00:00:15
//! Memo.
//!   -12085   -12085   -12070   -12060   -12068   -12083   -12085   -12077
//! ```
//!
//! The recorder has a large offset: acceleration = (count − mean count) · scale factor.

use super::header::{number, required};
use crate::error::{DAMAGED, Fault};
use crate::fields::{Numbered, check_count, leading_number, lines, positive};
use crate::motion::floor_index;
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;

const HEADER_LINES: usize = 17;

const FREQUENCY: &str = "Sampling Freq(Hz)";
const DURATION: &str = "Duration Time(s)";

/// Returns whether the first lines are such a header.
pub(super) fn recognises(head: &[&str]) -> bool {
    let starts = |label: &str| head.iter().take(HEADER_LINES).any(|line| line.starts_with(label));
    starts("Origin Time") || (starts(FREQUENCY) && starts("Scale Factor"))
}

/// Reads the text of a K-NET or KiK-net file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let header: Vec<Numbered<'_>> = lines(text).take(HEADER_LINES).collect();
    let (frequency_line, frequency) = number(field(&header, FREQUENCY)?, FREQUENCY)?;
    let step = 1.0 / frequency;
    options.check_step(step, frequency_line)?;
    let (duration_line, duration) = number(field(&header, DURATION)?, DURATION)?;
    let (factor_line, factor) = field(&header, "Scale Factor")?;
    let Some((numerator, unit, denominator)) = scale(factor) else {
        return Err(Fault::in_header(factor_line, "a scale factor `3920(gal)/6182761`", factor));
    };
    let unit = options.unit_of(unit, factor_line)?;

    let mut parsed = Parsed::new(step, unit, header.last().map_or(1, |(number, _)| *number));
    let mut counts: Vec<i32> = Vec::new();
    for (number, line) in lines(text).skip(HEADER_LINES) {
        parsed.last_line = number;
        for word in line.split_ascii_whitespace() {
            let count = word.parse();
            counts.push(count.map_err(|_| Fault::excerpt(number, "a whole number", word, DAMAGED))?);
        }
    }
    let stated_by = format!("{DURATION} on line {duration_line}, {duration} s at {frequency} Hz,");
    check_count(counts.len(), floor_index((duration * frequency).round()), &stated_by, parsed.last_line)?;
    // 2^24 counts of 2^31 stay below 2^56
    let sum: i64 = counts.iter().copied().map(i64::from).sum();
    let mean = sum as f64 / counts.len().max(1) as f64;
    let sample = |count: i32| unit.to_si((f64::from(count) - mean) * numerator / denominator);
    parsed.samples = counts.into_iter().map(sample).collect();
    // 3 and 6 are the vertical directions of KiK-net
    parsed.is_vertical =
        field(&header, "Dir.").is_ok_and(|(_, text)| is_vertical(text) || matches!(text, "3" | "6"));
    parsed.keep_header(header.iter().map(|(_, line)| *line));
    let peak = field(&header, "Max. Acc. (gal)").ok().and_then(|(_, text)| positive(leading_number(text).0));
    parsed.stated_peak = peak.map(|peak| Unit::CentimetrePerSecondSquared.to_si(peak));
    Ok(vec![parsed])
}

/// Finds the value after a label, and its line.
fn field<'a>(header: &[Numbered<'a>], label: &str) -> Result<Numbered<'a>, Fault> {
    let found = header.iter().find_map(|&(number, line)| Some((number, line.strip_prefix(label)?.trim())));
    required(header, label, found)
}

/// Reads numerator, unit and denominator of `3920(gal)/6182761`.
fn scale(text: &str) -> Option<(f64, &str, f64)> {
    let (numerator, rest) = text.split_once('(')?;
    let (unit, denominator) = rest.split_once(')')?;
    let denominator = denominator.trim().strip_prefix('/')?;
    Some((positive(numerator.trim())?, unit, positive(denominator.trim())?))
}
