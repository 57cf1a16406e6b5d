//! USGS SMC records (`.smc`).
//!
//! 11 lines of text, 48 integers (8I10), 50 reals (5E15.7), comment lines that start with `|`, then samples in cm/s²
//! (8E10.4) without blanks between:
//!
//! ```text
//! 2 CORRECTED ACCELEROGRAM
//! *
//! …
//! |a comment
//!  1.9103E-1 6.5384E-1-5.4811E-1 9.0551E-3 7.4138E-1 1.0646E+0 7.6002E-1 1.1296E+0
//! ```
//!
//! Integer 16 is the number of comment lines, integer 17 that of samples, real 2 the samples a second, reals 30 and 32
//! the largest and the smallest sample.

use super::Unit;
use super::error::{Fault, excerpt};
use super::fields::{DAMAGED, Layout, Line, find};
use super::record::{Parsed, ReadOptions, check_stated_step, notes, untrimmed_lines};

const TEXT_LINES: usize = 11;
const INTEGERS: (usize, Layout) = (48, Layout { per_line: 8, width: 10 });
const REALS: (usize, Layout) = (50, Layout { per_line: 5, width: 15 });
const DATA: Layout = Layout { per_line: 8, width: 10 };

/// Reals at least so large stand for what is not known (1.7E38).
const UNKNOWN: f64 = 1e38;

/// Whether the first line is that of such a file: a digit and what the file holds.
pub(super) fn recognises(head: &[&str]) -> bool {
    let kind = head.first().and_then(|line| line.trim_start().strip_prefix(|c: char| c.is_ascii_digit()));
    let kinds = ["CORRECTED ACC", "UNCORRECTED ACC", "VELOCITY", "DISPLACEMENT", "RESPONSE", "FOURIER"];
    kind.is_some_and(|kind| {
        kind.starts_with(' ') && kinds.iter().any(|word| find(kind.trim(), word) == Some(0))
    })
}

/// Reads the text of an SMC file.
pub(super) fn parse(text: &str, options: &ReadOptions) -> Result<Parsed, Fault> {
    let mut rest = untrimmed_lines(text).peekable();
    let Some(&(first_line, first)) = rest.peek() else {
        return Err(Fault::new(1, "an SMC file", "an empty file", "check that this is the right file"));
    };
    if find(first, "CORRECTED ACC").is_none() {
        let expected = "an accelerogram, `2 CORRECTED ACCELEROGRAM`";
        return Err(Fault::new(
            first_line,
            expected,
            excerpt(first.trim()),
            "use the accelerogram of this record",
        ));
    }
    let unit = Unit::settled("cm/s2", first_line, options.unit)?;
    let header: Vec<Line<'_>> = rest.by_ref().take(TEXT_LINES).collect();
    let text_end = header.last().map_or(1, |(number, _)| *number);
    let integers = block(&mut rest, INTEGERS, text_end)?;
    let (comments, count) = (whole(&integers, 16, text_end)?, whole(&integers, 17, text_end)?);
    let reals_line = rest.peek().map_or(text_end, |(number, _)| *number);
    let reals = block(&mut rest, REALS, text_end)?;
    let frequency = reals.get(1).copied().filter(|frequency| *frequency > 0.0 && *frequency < UNKNOWN);
    let Some(frequency) = frequency else {
        let expected = "the samples a second as real 2 of the header";
        return Err(Fault::new(reals_line, expected, "none", "complete the header"));
    };
    let step = 1.0 / frequency;
    check_stated_step(options.step, step, reals_line)?;
    let mut last_line = text_end;
    for _ in 0..comments {
        let Some((number, line)) = rest.next() else { break };
        last_line = number;
        if !line.starts_with('|') {
            let expected = format!("{comments} comment lines that start with `|`, as integer 16 says");
            return Err(Fault::new(number, expected, excerpt(line.trim()), DAMAGED));
        }
    }
    let stated = text_end + 3;
    let mut samples = Vec::new();
    let end = DATA.read(&mut rest, count, stated, |value, line, field| {
        samples.push(unit.checked_to_si(value, line, field)?);
        Ok(())
    })?;
    DATA.check_ended(rest.peek().copied(), count, stated)?;
    last_line = last_line.max(end);
    let described = header.iter().map(|(_, line)| line.trim()).filter(|line| *line != "*");
    let mut parsed = Parsed::new(step, samples, unit, last_line, notes(described));
    let extremes =
        [29, 31].iter().filter_map(|&place| reals.get(place)).filter(|value| value.abs() < UNKNOWN);
    parsed.stated_peak = extremes.map(|value| unit.to_si(value.abs())).reduce(f64::max);
    Ok(parsed)
}

/// The numbers of one part of the header.
fn block<'a>(
    lines: &mut impl Iterator<Item = Line<'a>>,
    (count, layout): (usize, Layout),
    after: usize,
) -> Result<Vec<f64>, Fault> {
    let mut numbers = Vec::with_capacity(count);
    layout.read(lines, count, after, |value, _, _| {
        numbers.push(value);
        Ok(())
    })?;
    Ok(numbers)
}

/// Integer `place` of the header, from 1, where it counts something.
fn whole(integers: &[f64], place: usize, text_end: usize) -> Result<usize, Fault> {
    let value = integers.get(place - 1).copied().unwrap_or(f64::NAN);
    if value >= 0.0 && value.fract() == 0.0 {
        return Ok(super::floor_index(value));
    }
    let line = text_end + place.div_ceil(INTEGERS.1.per_line);
    Err(Fault::new(line, format!("a count as integer {place}"), value.to_string(), "correct the header"))
}
