//! Text records of AFAD, Türkiye, formerly the Turkish National Strong Motion Network.
//!
//! Header lines, the last of which names the columns, then the three components side by side:
//!
//! ```text
//! STRONG GROUND MOTION RECORDS OF TURKIYE
//! …
//! NUMBER OF DATA          : 28683
//! SAMPLING INTERVAL (sec) : 0.01
//! RAW PGA VALUES (gal)    : (N-S) 13.200332 (E-W) 12.163827 (U-D) 9.840572
//! …
//!        N-S          E-W          U-D
//!     0.000909     -0.000191    -0.000092
//! ```
//!
//! AFAD's newer files (`.asc`) are in the form of ESM.

use super::components::{components, finish, push_row};
use super::header::{count, step};
use crate::error::Fault;
use crate::fields::{Numbered, after, find, lines, real};
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Longest header.
const HEADER_LINES: usize = 40;

const COUNT: &str = "NUMBER OF DATA";

/// Returns whether the first line is that of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.first().is_some_and(|line| find(line, "STRONG GROUND MOTION RECORDS OF TURK").is_some())
}

/// Reads the components of an AFAD file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let is_row = |line: &str| line.split_whitespace().all(|word| real(word).is_some());
    let header: Vec<Numbered<'_>> =
        lines(text).take(HEADER_LINES).take_while(|(_, line)| !is_row(line)).collect();
    let step = step(&header, "SAMPLING INTERVAL (sec)", |step| step, options)?;
    let (count_line, count) = count(&header, COUNT)?;
    let peaks = header.iter().find(|(_, line)| find(line, "PGA VALUES").is_some());
    let in_brackets = |&(number, line): &Numbered<'_>| {
        let unit = line.split_once('(')?.1.split_once(')')?.0;
        Some((number, unit.to_owned()))
    };
    let Some((unit_line, unit)) = peaks.and_then(in_brackets) else {
        return Err(Fault::missing(count_line, "the unit in `RAW PGA VALUES (gal)`"));
    };
    let unit = options.unit_of(&unit, unit_line)?;
    let &(names_line, names) = header.last().unwrap_or(&(1, ""));
    if names.contains(':') {
        let expected = "the names of the columns, `N-S E-W U-D`";
        return Err(Fault::excerpt(names_line, expected, names, "complete the header"));
    }
    let mut channels = components([step, 0.0], unit, names.split_whitespace(), names_line)?;
    for (channel, name) in channels.iter_mut().zip(names.split_whitespace()) {
        let stated = peaks.and_then(|(_, line)| after(line, &format!("({name})")));
        if let Some(text) = stated {
            channel.state_peak(text);
        }
    }
    for (number, line) in lines(text).skip(header.len()) {
        push_row(&mut channels, line.split_whitespace(), number)?;
    }
    let stated_by = format!("{COUNT} on line {count_line}");
    finish(channels, count, &stated_by, &header.iter().map(|(_, line)| *line))
}
