//! K-NET and KiK-net records as CSV, as NIED offers them beside its own format.
//!
//! Header lines that start with `#`, the last of which names the columns, then clock times, times from the
//! start of the record and the components:
//!
//! ```text
//! #SamplingFrequency(Hz)
//! #100
//! #DurationTime(s)
//! #60
//! …
//! #Time,RelativeTime(s),N-S(gal),E-W(gal),U-D(gal)
//! 2011/03/11 14:48:19.00,0.00,0.12,-0.04,0.01
//! ```

use super::components::{MOST, components, finish, push_timed_row};
use super::header::{number, required};
use crate::error::Fault;
use crate::fields::{Numbered, find, lines, real};
use crate::motion::floor_index;
use crate::options::RecordOptions;
use crate::parsed::Parsed;

/// Longest header.
const HEADER_LINES: usize = 60;

const TIME: &str = "RelativeTime(s)";
const FREQUENCY: &str = "SamplingFrequency(Hz)";
const DURATION: &str = "DurationTime(s)";

/// Returns whether one of the first lines names the columns of such a file.
pub(super) fn recognises(head: &[&str]) -> bool {
    head.iter().any(|line| names_columns(line))
}

fn names_columns(line: &str) -> bool {
    let mut cells = line.split(',').skip(1);
    cells.next().is_some_and(|cell| find(cell.trim(), TIME) == Some(0)) && cells.next().is_some()
}

/// Reads the components of such a file.
pub(super) fn parse(text: &str, options: &RecordOptions) -> Result<Vec<Parsed>, Fault> {
    let end = lines(text).take(HEADER_LINES).position(|(_, line)| names_columns(line));
    let header: Vec<Numbered<'_>> = lines(text).take(end.map_or(0, |end| end + 1)).collect();
    let Some(&(names_line, names)) = header.last() else {
        let expected = format!("a line that names the columns, `#Time,{TIME},N-S(gal)`");
        return Err(Fault::new(1, expected, "none", "check that this is a K-NET file as CSV"));
    };
    let mut times = lines(text).skip(header.len()).map(|(_, line)| real(line.split(',').nth(1)?.trim()));
    let (step_line, step) = match (below(&header, FREQUENCY)?, times.next().flatten(), times.next().flatten())
    {
        (Some((line, frequency)), ..) => (line, 1.0 / frequency),
        // a table without the header of NIED
        (None, Some(first), Some(second)) if second > first => (names_line, second - first),
        _ => {
            let expected = format!("{FREQUENCY}, or two samples at rising {TIME}");
            return Err(Fault::new(names_line, expected, "none", "complete the file"));
        }
    };
    options.check_step(step, step_line)?;
    let columns: Vec<(&str, &str)> = names.split(',').skip(2).take(MOST + 1).map(name_and_unit).collect();
    let unit = options.unit_of(columns[0].1, names_line)?;
    if let Some((_, other)) = columns.iter().find(|(_, other)| *other != columns[0].1) {
        return Err(Fault::in_header(names_line, format!("one unit for all components, {unit}"), other));
    }
    let names = columns.iter().map(|(name, _)| *name);
    let mut channels = components([step, 0.0], unit, names, names_line)?;
    for (index, (number, line)) in lines(text).skip(header.len()).enumerate() {
        let cells = line.split(',').map(str::trim).skip(1);
        push_timed_row(&mut channels, cells, number, index as f64 * step)?;
    }
    let found = channels[0].samples.len();
    let (stated, stated_by) = match below(&header, DURATION)? {
        Some((line, duration)) => {
            let stated = floor_index((duration / step).round());
            let stated_by = format!("{DURATION} on line {line}, {duration} s at steps of {step} s,");
            // some files have a sample at the end of the duration
            (if found.checked_sub(1) == Some(stated) { found } else { stated }, stated_by)
        }
        None => (found, String::new()),
    };
    finish(channels, stated, &stated_by, &header.iter().map(|(_, line)| line.trim_start_matches('#')))
}

/// Reads the positive number on the line below a label; `None` without the label.
fn below(header: &[Numbered<'_>], label: &str) -> Result<Option<(usize, f64)>, Fault> {
    let place = header.iter().position(|(_, line)| line.trim_start_matches('#').starts_with(label));
    let Some(place) = place else { return Ok(None) };
    let value = header.get(place + 1).map(|(line, value)| (*line, value.trim_start_matches('#').trim()));
    number(required(header, label, value)?, label).map(Some)
}

/// Splits `N-S(gal)`.
fn name_and_unit(cell: &str) -> (&str, &str) {
    let cell = cell.trim();
    cell.split_once('(').map_or((cell, ""), |(name, unit)| (name.trim(), unit.trim_end_matches(')')))
}
