//! Volume 1 records: raw accelerograms of RENADIC (Chile, `.v1`) and BHRC (Iran, `.V1`), in g/10.
//!
//! For each channel lines of text, 100 integers, 50 reals, then times and accelerations in pairs or, at BHRC,
//! accelerations alone, ten numbers a line in columns that may touch, and a closing line:
//!
//! ```text
//! CHAN  1: L        (STA CHN:  1)
//! UNIVERSIDAD DE CHILE - RENADIC
//! …
//! NO. OF POINTS =   5652  RECORD LENGTH = 28.260 SEC
//! UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  =  0.132 G, AT  11.895 SEC
//! …
//!   0.000  0.062  0.005  0.049  0.010  0.035  0.015  0.003  0.020 -0.038
//! /&  ----------  END OF DATA FOR CHANNEL 1  ----------
//! ```
//!
//! The stated length is the number of points times the step.

use std::iter::Peekable;

use super::one_by_one;
use crate::error::{CUT_SHORT, Fault, UNEVEN, excerpt};
use crate::fields::{Layout, Numbered, after, find, leading_number, positive, real, untrimmed_lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::unit::Unit;
use crate::vertical::is_vertical;
use crate::warning::Warning;

/// Longest text above the numbers of a channel.
const TEXT_LINES: usize = 30;
const REALS: usize = 50;
const PER_LINE: usize = 10;

/// Start of the first line of BHRC.
const BHRC: &str = "* VOL1DS FILE:";

/// Returns whether the first lines are those of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    let has = |line: &&str, word: &str| find(line, word).is_some();
    head.first().is_some_and(|line| has(line, BHRC))
        || head.iter().take(TEXT_LINES).any(|line| has(line, "RENADIC"))
}

/// Reads the channels of a volume 1 file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    one_by_one(untrimmed_lines(text).peekable(), |rest| channel(rest, options))
}

/// Reads the next channel.
fn channel<'a>(
    rest: &mut Peekable<impl Iterator<Item = Numbered<'a>>>,
    options: &RecordOptions,
) -> Result<Parsed, Fault> {
    let mut header: Vec<Numbered<'a>> = Vec::new();
    while let Some(line) = rest.next_if(|(_, line)| header.len() < TEXT_LINES && !is_integers(line)) {
        header.push(line);
    }
    let (count_line, count, length) = count_and_length(&header)?;
    let has_times = !header.iter().any(|(_, line)| find(line, BHRC).is_some());
    let units = header.iter().find(|(_, line)| find(line, "UNITS").is_some() && find(line, "G/10").is_some());
    let Some(&(unit_line, units)) = units else {
        let units = header.iter().find(|(_, line)| find(line, "UNITS").is_some());
        let found = units.map_or("", |(_, line)| line);
        return Err(Fault::in_header(count_line, "`UNITS ARE SEC AND G/10`", found));
    };
    let unit = options.unit_of(Unit::StandardGravity.name(), unit_line)?;
    skip_headers(rest);
    let total = if has_times { count.saturating_mul(2) } else { count };
    // right-justified columns fill the first line
    let width = rest.peek().map_or(0, |(_, line)| line.len() / total.clamp(1, PER_LINE));
    let layout = Layout { per_line: PER_LINE, width: width.max(2) };
    // a number that is cut leaves a line of another length
    let mut ends_whole = true;
    let mut watched = rest.by_ref().inspect(|(_, line)| ends_whole = line.len() % layout.width == 0);
    let (numbers, last_line) = layout.numbers(&mut watched, total, count_line)?;
    layout.check_ended(rest.peek().copied(), total, count_line)?;
    let step = if has_times { uniform_step(&numbers, length, count_line)? } else { length / count as f64 };
    options.check_step(step, count_line)?;
    let mut parsed = Parsed::new(step, unit, last_line);
    let samples = numbers.into_iter().skip(usize::from(has_times)).step_by(if has_times { 2 } else { 1 });
    parsed.samples = samples.map(|tenths| unit.to_si(tenths) / 10.0).collect();
    match rest.peek() {
        Some((_, line)) if line.starts_with("/&") => drop(rest.next()),
        None if ends_whole => parsed.warnings.push(Warning::Unclosed),
        other => {
            let found = other.map_or_else(|| "the end of the file".to_owned(), |(_, line)| excerpt(line));
            let expected = "the line `/&` that closes the channel";
            return Err(Fault::new(last_line, expected, found, CUT_SHORT));
        }
    }
    if let Some(peak) = after(units, "MAX") {
        parsed.state_peak(peak);
    }
    let name = header.iter().find_map(|(_, line)| name_of(line)).unwrap_or_default();
    // BHRC numbers its channels: V2
    parsed.is_vertical = is_vertical(name.trim_end_matches(|c: char| c.is_ascii_digit()));
    parsed.channel = Some(name.to_owned());
    parsed.keep_header(header.iter().map(|(_, line)| line.trim()));
    Ok(parsed)
}

/// Reads the number of points and the length (s) from their line.
fn count_and_length(header: &[Numbered<'_>]) -> Result<(usize, usize, f64), Fault> {
    let expected = "the number of points and the length, `NO. OF POINTS = 5652  RECORD LENGTH = 28.260 SEC`";
    let stated = header.iter().find(|(_, line)| find(line, "NO. OF POINTS").is_some());
    let Some(&(number, line)) = stated else {
        let last = header.last().map_or(1, |(number, _)| *number);
        return Err(Fault::new(last, expected, "none", "check that this is a volume 1 file"));
    };
    let count = after(line, "NO. OF POINTS").and_then(|text| leading_number(text).0.parse().ok());
    let length = after(line, "LENGTH").or_else(|| after(line, "DURATION"));
    let length = length.and_then(|text| positive(leading_number(text).0));
    match (count, length) {
        (Some(count), Some(length)) if count > 1 => Ok((number, count, length)),
        _ => Err(Fault::in_header(number, expected, line.trim())),
    }
}

/// Skips the integers, which have no point, and 50 reals, which have one each and are fewer on a line than
/// the samples. BHRC cuts their lines.
fn skip_headers<'a>(rest: &mut Peekable<impl Iterator<Item = Numbered<'a>>>) {
    while rest.next_if(|(_, line)| is_integers(line)).is_some() {}
    let mut reals = 0;
    while reals < REALS {
        let is_header = |line: &str| !line.starts_with("/&") && line.matches('.').count() < PER_LINE;
        match rest.next_if(|(_, line)| is_header(line)) {
            Some((_, line)) => reals += line.matches('.').count(),
            None => break,
        }
    }
}

/// Finds the step of pairs whose times have three decimals; refuses times that are not uniform.
fn uniform_step(pairs: &[f64], length: f64, count_line: usize) -> Result<f64, Fault> {
    const ROUNDING: f64 = 0.000_5;
    let times = || pairs.iter().copied().step_by(2);
    let (count, first) = (pairs.len() / 2, pairs[0]);
    let last = pairs[2 * (count - 1)];
    let (mean, stated) = ((last - first) / (count - 1) as f64, length / count as f64);
    // the length, where the rounded times agree with it, has more digits
    let agrees = (mean - stated).abs() * (count - 1) as f64 <= 2.0 * ROUNDING;
    let step = if agrees { stated } else { mean };
    let is_off = |(index, time): (usize, f64)| {
        (time - first - index as f64 * step).abs() > 2.0 * ROUNDING * (1.0 + 1e-6) + 1e-9
    };
    match times().enumerate().find(|&(index, time)| is_off((index, time))) {
        None if step > 0.0 => Ok(step),
        off => {
            let (index, time) = off.unwrap_or_default();
            let expected =
                format!("uniform times, {:.3} s at point {}", first + index as f64 * step, index + 1);
            Err(Fault::new(count_line, expected, format!("{time:.3} s"), UNEVEN))
        }
    }
}

/// Finds the name of a channel: `L` in `CHAN  1: L        (STA CHN:  1)`, `L1` in `COMP L1`.
fn name_of(line: &str) -> Option<&str> {
    let line = line.trim();
    let name =
        line.strip_prefix("COMP ").or_else(|| line.strip_prefix("CHAN")?.split_once(':').map(|(_, n)| n));
    name?.split_whitespace().next()
}

/// Returns whether a line has several whole numbers only. Text may be one number.
fn is_integers(line: &str) -> bool {
    let mut words = line.split_whitespace();
    !line.contains('.') && words.clone().count() > 3 && words.all(|word| real(word).is_some())
}
