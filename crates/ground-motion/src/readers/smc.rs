//! USGS SMC records (`.smc`).
//!
//! 11 lines of text, 48 integers (8I10), 50 reals (5E15.7), comment lines that start with `|`, then samples
//! in cm/s² (8E10.4) without blanks between:
//!
//! ```text
//! 2 CORRECTED ACCELEROGRAM
//! *
//! …
//! |a comment
//!  1.9103E-1 6.5384E-1-5.4811E-1 9.0551E-3 7.4138E-1 1.0646E+0 7.6002E-1 1.1296E+0
//! ```
//!
//! Integer 16 is the number of comment lines, integer 17 that of samples, real 2 the samples a second, reals
//! 30 and 32 the largest and the smallest sample.

use crate::error::{DAMAGED, Fault, UNEVEN};
use crate::fields::{Layout, Numbered, after, find, untrimmed_lines};
use crate::options::RecordOptions;
use crate::parsed::Parsed;
use crate::vertical::is_vertical;

const TEXT_LINES: usize = 11;
const INTEGERS: (usize, Layout) = (48, Layout { per_line: 8, width: 10 });
const REALS: (usize, Layout) = (50, Layout { per_line: 5, width: 15 });
const DATA: Layout = Layout { per_line: 8, width: 10 };

/// Reals of this size and more stand for unknown values (1.7E38).
const UNKNOWN: f64 = 1e38;

/// Returns whether the first line is that of such a file: a digit and what the file holds.
pub(super) fn recognises(head: &[&str]) -> bool {
    let kind = head.first().and_then(|line| line.trim_start().strip_prefix(|c: char| c.is_ascii_digit()));
    let kinds = ["CORRECTED ACC", "UNCORRECTED ACC", "VELOCITY", "DISPLACEMENT", "RESPONSE", "FOURIER"];
    kind.is_some_and(|kind| {
        kind.starts_with(' ') && kinds.iter().any(|word| find(kind.trim(), word) == Some(0))
    })
}

/// Reads the text of an SMC file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let mut rest = untrimmed_lines(text).peekable();
    let (first_line, first) = rest.peek().copied().unwrap_or((1, ""));
    if find(first, "CORRECTED ACC").is_none() {
        let expected = "an accelerogram, `2 CORRECTED ACCELEROGRAM`";
        return Err(Fault::excerpt(
            first_line,
            expected,
            first.trim(),
            "use the accelerogram of this record",
        ));
    }
    let unit = options.unit_of("cm/s2", first_line)?;
    let header: Vec<Numbered<'_>> = rest.by_ref().take(TEXT_LINES).collect();
    let text_end = header.last().map_or(1, |(number, _)| *number);
    let (count, layout) = INTEGERS;
    let (integers, _) = layout.numbers(&mut rest, count, text_end)?;
    let (comments, samples) =
        (layout.count_among(&integers, 16, text_end)?, layout.count_among(&integers, 17, text_end)?);
    let reals_line = rest.peek().map_or(text_end, |(number, _)| *number);
    let (count, layout) = REALS;
    let (reals, _) = layout.numbers(&mut rest, count, text_end)?;
    let frequency = reals.get(1).copied().filter(|frequency| *frequency > 0.0 && *frequency < UNKNOWN);
    let Some(frequency) = frequency else {
        if find(first, "UNCORRECTED").is_some() {
            let expected = "evenly spaced samples and their number a second as real 2 of the header";
            return Err(Fault::new(reals_line, expected, "pairs of times and accelerations", UNEVEN));
        }
        return Err(Fault::missing(reals_line, "the samples a second as real 2 of the header"));
    };
    let mut parsed = Parsed::new(1.0 / frequency, unit, text_end);
    options.check_step(parsed.step, reals_line)?;
    for _ in 0..comments {
        let Some((number, line)) = rest.next() else { break };
        parsed.last_line = number;
        if !line.starts_with('|') {
            let expected = format!("{comments} comment lines that start with `|`, as integer 16 says");
            return Err(Fault::excerpt(number, expected, line.trim(), DAMAGED));
        }
    }
    parsed.read(DATA, &mut rest, samples, text_end + 3)?;
    let direction = header.iter().find_map(|(_, line)| after(line, "component="));
    parsed.is_vertical = direction.is_some_and(is_vertical);
    parsed.keep_header(header.iter().map(|(_, line)| line.trim()).filter(|line| *line != "*"));
    let extremes =
        [29, 31].iter().filter_map(|&place| reals.get(place)).filter(|value| value.abs() < UNKNOWN);
    parsed.stated_peak = extremes.map(|value| unit.to_si(value.abs())).reduce(f64::max);
    Ok(vec![parsed])
}
